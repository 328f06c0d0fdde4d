"""Programs translated to C and Fortran behave as in the emulator with doubles: cards, typed lines and refusals."""

import shutil
import subprocess
from pathlib import Path

import pytest

from emulator.errors import CompileError, EmulatorError
from emulator.language.cards import deck_from_lines
from emulator.language.compiler import compile_deck
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from emulator.numbers import numbers
from emulator.translation.writers import translated
from modern.bench.decisions import compare

COMMANDS = {"c": ("gcc", "c"), "fortran": ("gfortran", "f90")}
MISSING = {
    language: pytest.mark.skipif(not shutil.which(compiler), reason=f"no {compiler}")
    for language, (compiler, _) in COMMANDS.items()
}
LANGUAGES = pytest.mark.parametrize("language", [pytest.param(name, marks=MISSING[name]) for name in COMMANDS])

LINES = ["1.5 2", "  -3"]
PROGRAMS = {
    "loops": """K=0|DO 5 I=8,5|5 K=K+1|DO 6 I=1,10,4|DO 6 J=I,9|6 K=K+1|PUNCH 9,K,I,J|9 FORMAT(3I4)|END""",
    "arithmetic": """1 READ 9,A,I|B=A**2/4.-SQRT(A)*(-A)**I|C=A-B*C1-A**(I-1)|N=I*I/7-3*I|B=-B|PUNCH 9,B,N|GO TO 1
        9 FORMAT(E14.8,I4)|END""",
    "four digits": """N=9999|M=N*N|N=N+2|I=-N/0|K=A1*1.5-7.|PUNCH 9,N,M,I,K|A1=-123456.75|K=A1|PUNCH 8,K,K,K,K
        9 FORMAT(4I6)|8 FORMAT(I3,I1,I8,I2)|END""",
    "texts": """READ 8,A,I|PUNCH 7|PUNCH 8,A,I|IF(SENSE SWITCH 1)4,5|4 STOP|5 PUNCH 6,A,A|IF(SENSE SWITCH 2)4,4
        6 FORMAT(6H'A=@$*,F7.2/)|7 FORMAT(/5HNO. 1/)|8 FORMAT(3HABC,2X,F4.1,I3)|END""",
    "fields": """A=-1.5E-7|B=123456.789|C=.3|D=0.|DO 2 I=1,3|PUNCH 9,A,B,C,D|A=A*1.E5|D=-D|2 B=B*1.E-8
        9 FORMAT(F6.2,E9.2,F20.16,E16.3)|END""",
    "blanks": """1 READ 9,A,B,I,C|PUNCH 8,A,B,I,C|GO TO 1|9 FORMAT(F8.3,E10.3,I4,F5.0)|8 FORMAT(2E16.8,I6,E14.8)|END""",
    "groups": """DIMENSION X(3),Y(2,2),L(2)|1 READ 9,X,Y|L(1)=1|L(2)=-2|PUNCH 8,(X(I),L(2),I=1,3)
        PUNCH 7,Y,((Y(I,J),J=1,2),I=1,2)
        9 FORMAT(4F6.1)|8 FORMAT(3HX =,2(F8.3,I3,1X)/)|7 FORMAT(1HA/(1HB,2F7.2))|END""",
    "typewriter": """ACCEPT 9,A,I|TYPE 9,A,I|PAUSE 12|ACCEPT 9,B,J|PRINT 8,B,J|GO TO (1,2,1),I|1 STOP|2 PUNCH 9,A,J
        9 FORMAT(F4.1,I3)|8 FORMAT(4HB = ,F6.2/40X,40X,5HABCDE,I3,1HF)|END""",
    "functions": """A=2.5|B=-2.5|X=SIN(A)|Y=COSF(A)|Z=ATAN(A)|PUNCH 9,X,Y,Z|X=EXP(B)|Y=LOGF(B)|Z=B**A|PUNCH 9,X,Y,Z
        9 FORMAT(3E15.8)|END""",
    "last card": """1 READ 9,A|PUNCH 9,A|IF(SENSE SWITCH 9)2,1|2 IF(SENSE SWITCH 9)1,3|3 STOP|9 FORMAT(F5.1)|END""",
    "zeros": """A=1.|B=A*A|C=A-A*B|D=B-A|Z=-D|PUNCH 9,C,D,Z|9 FORMAT(3E15.8)|IF(1./0.)1,2,3
        1 STOP|2 STOP|3 PUNCH 9,A|END""",
}
REFUSED = {
    "subscript": "DIMENSION X(3)|I=4|X(1)=2.|X(I)=X(1)|END",
    "copy of element N+1": "DIMENSION X(3)|I=4|X(1)=X(I)|PUNCH 9,I|IF(X(1))1,1,1|1 STOP|9 FORMAT(I3)|END",
    "undefined": "IF(A)1,1,1|1 STOP|END",
    "undefined integer": "N=K+1|IF(N)1,1,1|1 STOP|END",
    "not a number": "A=0.|B=A/A|PUNCH 9,A|IF(B)1,1,1|1 STOP|9 FORMAT(F5.1)|END",
    "out of range": "A=1.E60|B=A*A|PUNCH 9,B|STOP|9 FORMAT(E14.8)|END",
    "mode": "I=1|PUNCH 9,I|STOP|9 FORMAT(F5.1)|END",
    "no field": "I=1|PUNCH 9,I|STOP|9 FORMAT()|END",
    "computed GO TO": "I=3|GO TO (1,1),I|1 STOP|END",
    "middle of a data set": "READ 9,A|READ 9,A,B,A|1 STOP|9 FORMAT(F5.1/F5.1)|END",
    "bad number": "READ 8,A|READ 9,A|STOP|8 FORMAT(2X,F3.0)|9 FORMAT(F9.3)|END",
}
DATA = {
    "arithmetic": ["4.             3", "-9.           12", "1.E-3         -2"],
    "texts": ["XYZ--12.5 42"],
    "blanks": ["  1 2 3   1 5E 2", " -.5     15-3       7", "", "1234567.12345678  -99", "    -0    0       -1"],
    "groups": ["   1.5  -2.   3.   4.", "5.", "   6.  7."],
    "last card": ["1.", "2.", "3."],
    "middle of a data set": ["1.", "2.", "3."],
    "bad number": ["  1.", "1X3"],
}


def cards_of(text: str) -> list[str]:
    return [card.strip() for line in text.splitlines() for card in line.split("|")]


def run_translated(name: str, text: str, language: str, folder: Path) -> None:
    """Compile and run a program, and compare it with the emulator."""
    deck, data = deck_from_lines("deck.f", cards_of(text)), DATA.get(name, [])
    machine = Machine(
        compile_deck(deck), deck_from_lines("data", data), Options(numbers("float64"), hopper="any"), keyboard=LINES
    )
    try:
        expected = machine.run()
        is_normal = expected.ending.normal
    except EmulatorError:
        expected, is_normal = machine.result(), False
    compiler, ending = COMMANDS[language]
    source, executable, lines = folder / f"deck.{ending}", folder / "deck", folder / "lines"
    source.write_text(translated(deck, language), encoding="ascii")
    lines.write_text("".join(f"{line}\n" for line in LINES), encoding="ascii")
    strict = ("-Wall", "-Wextra", "-Werror", "-Wno-unused-but-set-variable") if language == "c" else ("-std=f2018",)
    command = [compiler, "-O1", *strict, "-ffp-contract=off", "-o", str(executable), str(source), "-lm"]
    subprocess.run(command, check=True, cwd=folder)
    process = subprocess.run(
        [str(executable), "-a", str(lines), "-s", "2"],
        input="".join(f"{card}\n" for card in data),
        capture_output=True,
        encoding="ascii",
        timeout=10,
        check=False,
    )
    messages = [line for line in process.stderr.splitlines() if line.startswith("deck.f: ")]
    typed = [line for line in process.stderr.splitlines() if line not in messages]
    assert (process.stdout.splitlines(), typed) == (list(expected.punched), list(expected.typed))
    assert process.returncode == (0 if is_normal else 2), messages
    assert len(messages) == (not is_normal) + text.count("PAUSE")


@LANGUAGES
@pytest.mark.parametrize("name", PROGRAMS)
def test_translated_programs_punch_and_type_what_the_emulator_does(name: str, language: str, tmp_path: Path) -> None:
    run_translated(name, PROGRAMS[name], language, tmp_path)


@LANGUAGES
@pytest.mark.parametrize("name", REFUSED)
def test_translated_programs_refuse_what_the_emulator_refuses(name: str, language: str, tmp_path: Path) -> None:
    run_translated(name, REFUSED[name], language, tmp_path)


@LANGUAGES
def test_programs_of_the_thesis_take_the_same_decisions(language: str, tmp_path: Path) -> None:
    command = f"{COMMANDS[language][0]} -O2 -ffp-contract=off"
    counts = compare(13, tmp_path, [command])[command]
    assert counts.counts["decisions"] > 3_000
    assert counts.first == {}


def test_translation_names_the_place_of_an_error_and_keeps_the_order() -> None:
    with pytest.raises(CompileError, match=r"deck\.f: card 1, column 4"):
        translated(deck_from_lines("deck.f", ["A=+*B", "END"]), "fortran")
    text = translated(deck_from_lines("deck.f", ["DIMENSION X(3)", "10 X(I+1)=B-C*D", "GO TO 10", "END"]), "c")
    assert '#line 2 "deck.f" /* X(I+1)=B-C*D */\nL10:;\n    X(I + 1) = -(C*D - B);\n' in text
    assert "#define X(i) X_[index_of(__LINE__, i, 3)]" in text
