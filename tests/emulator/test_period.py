"""Programs in the style of the time (tests/data/period), compared with output that does not come from the emulator."""

from collections.abc import Iterator

import pytest

from emulator.language import tree
from emulator.language.cards import RECORD_MARKS, Deck, deck_from_lines, read_deck
from emulator.language.compiler import compile_deck, translate
from emulator.language.formats import Literal, Slash, parse_format
from emulator.language.parser import parse
from emulator.language.statements import capitals
from emulator.machine.machine import Machine
from emulator.machine.operator import FromFile
from emulator.machine.result import Options, Result
from tests.support.deckwork import ComparedMachine, MakeMachine, agreed, program
from tests.support.paths import DATA

PERIOD = DATA / "period"
PROGRAMS = sorted(PERIOD.glob("*.f"))
EMPTY = Deck("no deck", ())


RUNS = [path.stem for path in sorted(PERIOD.glob("*.output"))]


def deck_of(program: str) -> Deck:
    """Return the source deck, converted to capitals."""
    return read_deck(str(PERIOD / f"{program}.f"), capitals)


def ran(program: str, switches: set[int]) -> Result:
    """Run a program with its deck and operator, on both engines and on the kernel alone if nobody types."""
    data, operator = PERIOD / f"{program}.deck", PERIOD / f"{program}.operator"
    deck = read_deck(str(data)) if data.exists() else EMPTY
    options = Options(switches=frozenset(switches), hopper="any")
    made = compile_deck(deck_of(program))
    if operator.exists():
        return Machine(made, deck, options).run(FromFile(operator.name, operator.read_text(encoding="ascii")))
    result = ComparedMachine(made, deck, options).run()
    assert agreed(made, [deck], options) == 1
    return result


@pytest.mark.parametrize("name", RUNS)
def test_output_agrees_with_the_independent_computation(name: str) -> None:
    """The name of a file has the sense switches that are on, and its lines begin with P (punched) or T (typed)."""
    program, *switches = name.split("-")
    result = ran(program, set(map(int, switches)))
    lines = (PERIOD / f"{name}.output").read_text(encoding="ascii").splitlines()
    assert list(result.punched) == [line[1:] for line in lines if line[0] == "P"]
    assert list(result.typed) == [line[1:] for line in lines if line[0] == "T"]
    assert result.ending.normal


def statements() -> Iterator[tree.Body]:
    for path in PROGRAMS:
        yield from (statement.body for statement in parse(deck_of(path.stem)).statements)


def test_all_programs_compile_without_a_message_and_are_described() -> None:
    assert {path.stem for path in PROGRAMS} >= {"fibon", "job", "pi", "stats", "table", "tictac"}
    for path in PROGRAMS:
        assert translate(deck_of(path.stem))[1] == ()
    text = (PERIOD / "README.md").read_text(encoding="utf-8")
    assert [path.name for path in PROGRAMS if f"| `{path.name}` |" not in text] == []


def test_programs_cover_every_statement_and_specification() -> None:
    bodies = list(statements())
    assert {type(body) for body in bodies} == set(tree.Body.__args__)
    assert {body.verb for body in bodies if isinstance(body, tree.InputOutput)} == {
        *("READ", "ACCEPT", "PUNCH", "PRINT", "TYPE")
    }
    assert {body.switch for body in bodies if isinstance(body, tree.IfSwitch)} == {1, 2, 3, 4}
    specs = [spec for body in bodies if isinstance(body, tree.Format) for spec in parse_format(body)[0].specs]
    fields = {spec.kind for spec in specs if not isinstance(spec, (Literal, Slash))}
    assert fields == {"E", "F", "I"}
    assert {spec.skip for spec in specs if isinstance(spec, Literal)} == {True, False}
    assert any(isinstance(spec, Slash) for spec in specs)


@pytest.mark.parametrize("mark", RECORD_MARKS)
def test_a_record_mark_ends_a_statement_and_a_typed_line(engines: MakeMachine, mark: str) -> None:
    """TIC3D of 1962 ends each statement so, and its texts are typed up to the mark (executed)."""
    deck = ["READ 5,|", "TYPE 5|", "PUNCH 5,|", "5 FORMAT(8H        )|", "END|"]
    made = program(*(line.replace("|", mark) for line in deck))
    result = engines(made, deck_from_lines("data", [f"HALLO{mark} X"]), Options()).run()
    assert (result.typed, result.punched) == (("HALLO",), (f"HALLO{mark} X",))


def test_sense_switch_9_is_on_once_after_the_last_card(engines: MakeMachine) -> None:
    """PDQ FORTRAN, executed: the test turns the indicator off."""
    made = program(
        *("DO 5 I=1,5", "IF(SENSE SWITCH 9)1,2", "1 PUNCH 7,I", "IF(SENSE SWITCH 9)3,5", "3 PUNCH 8,I", "GO TO 5"),
        *(
            "2 READ 9,K",
            "PUNCH 9,K",
            "5 CONTINUE",
            "7 FORMAT(4HLAST,I4)",
            "8 FORMAT(5HAGAIN,I4)",
            "9 FORMAT(I4)",
            "END",
        ),
    )
    result = engines(made, deck_from_lines("data", ["   1", "   2", "   3"]), Options(hopper="any")).run()
    assert result.punched == ("   1", "   2", "   3", "LAST   4")
    assert result.ending.kind == "hopper"
