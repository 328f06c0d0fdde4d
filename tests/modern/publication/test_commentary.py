"""The commentary: every card in one block, every variable explained, every name, number and range true."""

import re
import tomllib
from contextlib import suppress
from html import escape

import pytest

from emulator.errors import EmulatorError
from emulator.language.cards import deck_from_text
from emulator.language.objectcode import Line, Program
from emulator.machine.result import Options
from emulator.machine.session import Session
from emulator.numbers.arithmetic import FIXED_POINT
from modern.edition import programs
from modern.edition.chapter6 import EXAMPLES, input_deck
from modern.publication.commentary import commentary
from modern.publication.facing import facing
from modern.publication.site.made import make
from modern.publication.uses import uses
from modern.thesis.job import run_hull
from tests.support.commands import call
from tests.support.paths import ROOT

WORDS = {"DATA", "NOT", "ACCEPTABLE", "ERROR", "IN", "PROGRAM", "BOUNDARY", "POINTS", "INSIDE", "CONVEX", "HULL", "HAS"}
WORDS |= {"BEEN", "DETERMINED", "AX", "BY", "CZ", "IF", "PUNCH", "FORMAT", "FORTRAN", "FORMATs", "I4", "E14", "TO", "H"}


@pytest.mark.parametrize("program", programs.NAMES)
def test_every_card_belongs_to_exactly_one_block(program: str) -> None:
    covered = [number for block in commentary(program).blocks for number in block.cards]
    assert covered == [card.number for card in facing(program).cards]


@pytest.mark.parametrize("program", programs.TEXTS)
def test_the_first_and_last_cards_in_the_file_of_the_commentary_are_those_of_its_blocks(program: str) -> None:
    rows = tomllib.loads((ROOT / "fortran_src/commentary" / f"{program}.toml").read_text(encoding="utf-8"))["block"]
    cards = facing(program).cards
    ends = [(cards[b.cards[0] - 1].place, cards[b.cards[-1] - 1].place) for b in commentary(program).blocks]
    assert ends == [(row["first"], row["last"]) for row in rows]


@pytest.mark.parametrize("program", programs.TEXTS)
def test_every_variable_is_explained_and_every_integer_has_limits(program: str) -> None:
    names = {name.name: name.floating for name in uses(program).names if not name.function}
    explained = {gloss.name: gloss.limits is None for gloss in commentary(program).variables}
    assert explained == names


@pytest.mark.parametrize("program", programs.TEXTS)
def test_names_statements_and_steps_in_the_text_exist(program: str) -> None:
    table = (ROOT / "docs/reference/concordance.md").read_text()
    labels, names = {card.label for card in facing(program).cards}, {name.name for name in uses(program).names}
    remarks = commentary(program)
    for block in remarks.blocks:
        assert all(f"| {step} |" in table for step in block.steps), block.title
        assert 80 <= len(block.text) <= 600, block.title
    for text in (*(block.text for block in remarks.blocks), *(gloss.text for gloss in remarks.variables)):
        numbers = {int(number) for number in re.findall(r"\b[1-9]\d\d+\b(?!,)", text)}
        assert numbers <= labels, text
        capitals = set(re.findall(r"\b[A-Z]{2,}\d*\b|\b[A-Z]\d\b", text))
        assert capitals <= names | WORDS, text


def test_integers_stay_within_their_limits_in_every_run_that_ends() -> None:
    """Compare every integer variable with its limits after each statement of the examples and grounds."""
    limits = {text: {g.name: g.limits for g in commentary(text).variables if g.limits} for text in programs.TEXTS}
    outside: list[str] = []
    stored: set[tuple[str, str]] = set()
    values: set[tuple[str, str, int]] = set()

    def watch(program: Program, session: Session) -> None:
        name, storage = program.source.removesuffix(".f"), program.storage
        fields = [(storage.name_of(at).split("(")[0], at) for at in range(len(session.state.values))]
        integers = [(variable, at) for variable, at in fields if variable in limits[name]]
        scalars = [(variable, at) for variable, at in integers if storage.name_of(at) == variable]

        def look(line: Line, machine: Session) -> None:
            stored_array = [(v, at) for v, at in integers if at == machine.state.stored]
            for variable, at in scalars + stored_array:
                if machine.state.kinds[at] == FIXED_POINT:
                    values.add((name, variable, int(machine.state.values[at])))

        session.tracer = look

    paths = sorted((ROOT / "fortran_src/grounds").glob("*.deck"))
    for deck in [*map(input_deck, EXAMPLES), *(deck_from_text(path.name, path.read_text()) for path in paths)]:
        values.clear()
        with suppress(EmulatorError):
            # A run that never ends counts planes down without a limit (known fault 1).
            if all(
                step.result.ending.normal for step in run_hull(deck, programs.program, watch=watch, options=SHORT).steps
            ):
                stored |= {(program, name) for program, name, _ in values}
                outside += [
                    f"{deck.source}: {p} {v} = {n}" for p, v, n in sorted(values) if not within(limits[p][v], n)
                ]
    assert outside == []
    assert stored == {(text, name) for text in limits for name in limits[text]}


def test_the_listing_on_the_site_explains_every_block_and_every_variable() -> None:
    html = "".join(part.html for part in make("facing", "program2"))
    remarks = commentary("program2")
    for text in (*(block.title for block in remarks.blocks), *(gloss.text for gloss in remarks.variables)):
        assert escape(text) in html
    place = {card.number: card.place for card in facing("program2").cards}
    assert all(f'id="about-{place[block.cards.start]}"' in html for block in remarks.blocks)


@pytest.mark.parametrize("arguments", [(), ("--layers", "corrected")])
def test_the_command_prints_the_commentary_of_a_listed_program_only(arguments: tuple[str, ...], capsys) -> None:
    code, out, err = call(capsys, "listing", "program2", "--commentary", *arguments)
    if arguments:
        assert (code, out, err.count("\n")) == (2, "", 1)
        assert "--commentary: only program1" in err
    else:
        assert code == 0
        shown = ("102 READ 4", "The first triangle", "   NETC=1", "  262        END", "    NETC  The number")
        positions = [out.index(text) for text in shown]
        assert positions == sorted(positions)


SHORT = Options(limit=20_000)


def within(limits: tuple[int, int] | None, number: int) -> bool:
    return limits is not None and limits[0] <= number <= limits[1]
