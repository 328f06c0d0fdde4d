"""Programs in the style of the time (tests/data/period), compared with tests/support/period_outputs.py."""

from collections.abc import Callable, Iterator
from fractions import Fraction

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
from tests.support.period_outputs import PERIOD, Eight, Lines, e_field, f_field, fibon, job, pi, stats, table, tictac

PROGRAMS = sorted(PERIOD.glob("*.f"))
EMPTY = Deck("no deck", ())


RUNS = [
    *((program, set(), computed) for program, computed in (("table", table), ("pi", pi), ("fibon", fibon))),
    *(("stats", switches, stats) for switches in (set(), {3})),
    *(("table", {1}, table), ("pi", {2}, pi), ("job", set(), job), ("tictac", set(), tictac)),
]


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


@pytest.mark.parametrize(("program", "switches", "computed"), RUNS, ids=[f"{p} {sorted(s)}" for p, s, _ in RUNS])
def test_output_agrees_with_the_independent_computation(
    program: str, switches: set[int], computed: Callable[[frozenset[int]], Lines]
) -> None:
    result = ran(program, switches)
    cards, typed = computed(frozenset(switches))
    assert list(result.punched) == cards
    assert list(result.typed) == typed
    assert result.ending.normal


def test_independent_e_fields_agree_with_fortran_ii_d() -> None:
    """Every number of compiler_runs/e in every E field, except E-00 and numbers too large for the field."""
    widths = dict(zip("ABCDEFGHIJK", ("14.8 16.8 16.5 20.2 10.3 9.2 12.5 13.7 10.4 14.0 14.4").split(), strict=True))
    runs = DATA / "compiler_runs"
    numbers = iter((runs / "e.deck").read_text(encoding="ascii").split())
    compared = 0
    for line in (runs / "e.iid").read_text(encoding="ascii").splitlines():
        if line.startswith("A"):
            x = Eight(next(numbers))
        if line[0] in widths and line.endswith("*") and x.x and line[1:-1].strip():
            width, decimals = map(int, widths[line[0]].split("."))
            assert e_field(x, width, decimals) == line[1:-1].replace("E-00", "E+00")
            compared += 1
    assert compared == 7 * 11 - 7


def test_independent_arithmetic_agrees_with_known_values() -> None:
    """Two roots and a difference from II-D, a field of the manual's page 39, pi, and a known root."""
    assert [str(Eight(n).root().x * 10**7) for n in (2, 10)] == ["14142135", "31622776"]
    assert (Eight(1) - Eight(".99999999")).x == Fraction(1, 10**7)
    assert (Eight("10000000") - Eight(".5")).x == 10**7
    assert f_field(Eight("-.8"), 6, 3) == " -.800"
    assert abs(Fraction(pi(frozenset())[0][1][-9:]) - Fraction("3.14159265")) < Fraction(1, 10**6)
    assert abs(Fraction(job(frozenset())[1][2][5:17]) - Fraction("2.0945514815")) < Fraction(1, 10**7)


def statements() -> Iterator[tree.Body]:
    for path in PROGRAMS:
        yield from (statement.body for statement in parse(deck_of(path.stem)).statements)


def test_all_programs_compile_without_a_message() -> None:
    assert {path.stem for path in PROGRAMS} >= {"fibon", "job", "pi", "stats", "table", "tictac"}
    for path in PROGRAMS:
        assert translate(deck_of(path.stem))[1] == ()


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


def test_every_program_is_described() -> None:
    text = (PERIOD / "README.md").read_text(encoding="utf-8")
    assert [path.name for path in PROGRAMS if f"| `{path.name}` |" not in text] == []


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
