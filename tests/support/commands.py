"""The command line called in this process, as the tests of commands do it."""

from modern.cli.main import main

DECK = " 4\n" + "".join(
    f"{x}{y}{z}\n"
    for x, y, z in (
        ("+.00000000E+00", "+.00000000E+00", "+.00000000E+00"),
        ("+.10000000E+01", "+.00000000E+00", "+.00000000E+00"),
        ("+.00000000E+00", "+.10000000E+01", "+.00000000E+00"),
        ("+.00000000E+00", "+.00000000E+00", "+.10000000E+01"),
    )
)
PROGRAM = "    1 READ 2,X\n      PUNCH 2,X\n      GO TO 1\n    2 FORMAT (E14.8)\n      END\n"
"""A good data deck, and a program that copies cards."""


def call(capsys, *arguments: str) -> tuple[int, str, str]:
    """Exit code, standard output and standard error of one command; what was put out before does not count."""
    capsys.readouterr()
    try:
        code = main(list(arguments))
    except SystemExit as left:
        code = int(left.code or 0)
    out, err = capsys.readouterr()
    return code, out, err
