"""The command line called in this process, as the tests of commands do it."""

from __future__ import annotations

import pytest

from modern.cli.main import main


def call(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    """Exit code, standard output and standard error of one command; what was put out before does not count."""
    capsys.readouterr()
    try:
        code = main(list(arguments))
    except SystemExit as left:
        code = int(left.code or 0)
    out, err = capsys.readouterr()
    return code, out, err
