"""Check the evidence for each emendation (row of the apparatus) of the listings.

The *ground* of a row names its evidence.  :func:`check_row` removes the row and tests the ground, by its kind:

``parse``     without the row, the deck does not compile
``print``     without the row, a printed result is no longer reproduced
``deck``      without the row, the program punches different cards for a data deck
``forced``    with the row, the card equals a similar card in which names are exchanged; without the row, it does not.
              If the ground names the first and the last card of an ``equation``, the cards from the first to the last
              must also compute V (thesis p. 15) with the row, and must not compute it without the row
``cosmetic``  the row changes only the look of a card: the object code is the same with and without the row
``page``      someone who read the page has reported the card as the row has it

If a row consists of several steps (:mod:`modern.edition.readings`), each step is also undone alone, and the ground must
fail then too.

To judge a row of an optional layer, this layer and the layers that the row's ground names are added to all three
programs.  The result with all rows of the layer is compared with the result without the judged row.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from importlib.util import find_spec

from emulator.errors import CompileError, EmulatorError
from emulator.language.cards import Deck, deck_from_lines, deck_from_text
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program
from emulator.language.statements import Source, sources
from emulator.machine.endings import Ending
from emulator.machine.machine import Machine
from emulator.machine.result import LOOP_WINDOW, Options
from modern.edition import chapter6, programs
from modern.edition import sources as provenance
from modern.edition.apparatus import Row, built_without
from modern.edition.page_answers import page_readings
from modern.edition.readings import Step, steps, without_step
from modern.edition.reproduce import EXACT, State, reproduce
from modern.formats.deck import exact_points
from modern.thesis.job import run_hull

LISTED = Options(limit=200_000)
# The tables and cards of the optional layers need 60,000 digits of memory.
LAYERED = Options(limit=1_000_000, core=60_000)
# A run without a row is stopped, and counts as different, after this many times the statements of the run with the row.
LIMIT_FACTOR = 4


@dataclass(frozen=True, slots=True)
class Proof:
    """The result of a check: its subject, such as the id of a row, True if the check holds, and a message."""

    subject: str
    holds: bool
    message: str


def check_decks() -> Iterator[Proof]:
    """Check that witness and rows build each committed deck, character by character."""
    for entry in programs.BUILT_INS:
        built, committed = programs.built(entry.name), programs.committed(entry.name)
        same = built.text() == committed.text()
        compiles = _compiles(entry.name, built, same)
        rows = sum(row.layer in entry.layers for row in programs.text(entry.text).rows)
        yield Proof(
            f"{entry.name}.f",
            same and compiles,
            f"the {len(built.cards)} cards {'equal' if same else 'DIFFER from'} the witness with {rows} rows applied"
            + ("" if compiles else ", and do NOT compile"),
        )


def check_layers() -> Iterator[Proof]:
    """Check the programs with each optional layer.  Their decks are not committed; SOURCES.toml has their hashes.

    With the layer ``corrected`` the programs must also give the exact hull for each deck that a correction names.  The
    exact hulls need numpy.  If numpy is not installed, they are not compared.
    """
    table = provenance.sources().layered
    for layer in dict.fromkeys(layer for _, layer, _ in table):
        of_layer = [(name, sha) for name, found, sha in table if found == layer]
        cards = {name: programs.deck(name, (layer,)).text() for name, _ in of_layer}
        faults = [
            f"{name} has other cards than SOURCES.toml records"
            for name, sha in of_layer
            if provenance.digest(cards[name]) != sha
        ]
        decks = _decks_of(layer) if layer == "corrected" and find_spec("numpy") else ()
        faults += [f"deck {name} does not give the exact hull" for name in decks if not _exact_with(layer, name)]
        message = f"{len(of_layer)} programs have the cards that SOURCES.toml records"
        message += f", and {len(decks)} decks give the exact hull" if decks else ""
        yield Proof(f"layer {layer}", not faults, faults[0] if faults else message)


def _decks_of(layer: str) -> tuple[str, ...]:
    all_rows = (row for name in programs.TEXTS for row in programs.text(name).rows)
    rows = (row for row in all_rows if row.layer == layer and row.kind == "correction")
    named = (str(row.ground["deck"]) for row in rows if row.ground.get("kind") == "deck")
    return tuple(dict.fromkeys((*named, *(f"example{number}" for number in chapter6.EXAMPLES))))


def _exact_with(layer: str, name: str) -> bool:
    # Not imported at the top, because these modules need numpy, and the other checks do not.
    from modern.comparison.difference import disagreement
    from modern.comparison.outcome import from_cards, from_judge
    from modern.exact_hull import exact_hull

    deck = ground_deck(name)
    assert deck is not None
    points = [tuple(map(Fraction, point)) for point in exact_points(deck)[0].values()]
    try:
        run = run_hull(deck, programs.loader((layer,)), LAYERED)
    except EmulatorError:
        return False
    outcome, judge = from_cards(layer, run, points), from_judge(exact_hull(points), points)
    return outcome.determined and disagreement(outcome, judge, points).agrees


def _compiles(name: str, built: Deck, same: bool) -> bool:
    try:
        # Every row is compared with the committed deck, so the compiled program of that deck is shared.
        return bool(programs.program(name) if same else compile_deck(built))
    except CompileError:
        return False


def check_row(row: Row) -> Proof:
    """Check the ground of a row of a listing, with the row, without it, and without each of its steps."""
    kind = str(row.ground.get("kind", ""))
    test = {
        "parse": _parse,
        "print": _print,
        "deck": _deck,
        "forced": _forced,
        "cosmetic": _cosmetic,
        "page": _page,
    }.get(kind)
    if test is None:
        return Proof(row.id, False, f"unknown kind of ground: {kind!r}")
    holds, message = test(row, None)
    if holds and row.layer == "ocr":
        row_steps = steps(row) or ()
        for step in row_steps if len(row_steps) > 1 else ():
            if not test(row, step)[0]:
                pair = step.pair
                return Proof(row.id, False, f"{kind}: the change of {pair.witness!r} to {pair.lemma!r} is not needed")
    return Proof(row.id, holds, f"{kind}: {message}")


def _name(row: Row) -> str:
    return str(row.ground.get("program", "program1_examples" if row.layer == "examples" else row.text))


def layers_for(row: Row) -> tuple[str, ...]:
    """Return the optional layers with which a row is judged: its own layer and the layers that its ground names.

    A row of a layer of the committed deck needs none.
    """
    if row.layer in programs.built_in(_name(row)).layers:
        return ()
    return (row.layer, *(str(layer) for layer in row.ground.get("layers", ())))


def _built(row: Row) -> Deck:
    return programs.built(_name(row), layers_for(row))


def _without(row: Row, step: Step | None) -> Deck:
    """Return the deck without one step of a row, or without the row and the rows that depend on it."""
    if step is None:
        dependents, _ = built_without(programs.text(row.text), row.id)
        return programs.built(_name(row), layers_for(row), dependents)
    return programs.built(_name(row), layers_for(row), (), without_step(row, step))


def _compiled(row: Row, step: Step | None) -> tuple[Program | None, str]:
    """Return the program without a row or without one step of it.  If it does not compile, return the first error."""
    try:
        return compile_deck(_without(row, step)), ""
    except CompileError as error:
        return None, error.diagnostics[0].message
    except EmulatorError as error:
        return None, str(error)


def _whole(row: Row) -> Program:
    return programs.with_layers(_name(row), layers_for(row))


def _parse(row: Row, step: Step | None) -> tuple[bool, str]:
    program, message = _compiled(row, step)
    return program is None, f"without the row: {message}" if message else "without the row the deck still compiles"


def _cosmetic(row: Row, step: Step | None) -> tuple[bool, str]:
    whole = _whole(row)
    program, message = _compiled(row, step)
    if program is None:
        return False, f"without the row the deck does not compile: {message}"
    same = program.code == whole.code and program.formats == whole.formats
    return same, f"the object code is {'the same' if same else 'not the same'} with and without the row"


def _page(row: Row, step: Step | None) -> tuple[bool, str]:
    for reading in page_readings():
        if reading.row == row.id:
            same = reading.card == row.lemma
            return same, f"page {reading.page}, read by {reading.reader}, {'has' if same else 'has NOT'} this card"
    return False, "readings.csv has no reading of the page for this row"


def _print(row: Row, step: Step | None) -> tuple[bool, str]:
    name = _name(row)
    number = programs.built_in(name).number
    state: State = "listing" if name == "program1" else "examples"
    examples = row.ground.get("examples", ())
    if not examples:
        return False, "the ground names no example"
    program, message = _compiled(row, step)
    if program is None:
        return False, f"without the row the deck does not compile: {message}"
    for example in examples:
        with_row, without_row = _printed(example, state, number), _exact(example, state, number, {name: program})
        if not with_row or without_row:
            exactness = ["exact" if exact else "not exact" for exact in (with_row, without_row)]
            return False, f"example {example}, program {number}: {exactness[0]} with the row, {exactness[1]} without"
    return True, f"example {', '.join(map(str, examples))} is exact with the row, not without"


@cache
def _printed(example: int, state: State, number: int) -> bool:
    return _exact(example, state, number, {})


def _exact(example: int, state: State, number: int, instead: dict[str, Program]) -> bool:
    def load(name: str) -> Program:
        return instead.get(name) or programs.program(name)

    reports = [r for r in reproduce((example,), load, states=(state,)) if r.program == number and r.device == "punch"]
    return bool(reports) and all(report.verdict.kind == EXACT for report in reports)


def _deck(row: Row, step: Step | None) -> tuple[bool, str]:
    deck_name = str(row.ground.get("deck", ""))
    data = ground_deck(deck_name)
    if data is None:
        return False, f"deck {deck_name!r} does not exist"
    whole = _whole(row)
    program, message = _compiled(row, step)
    if program is None:
        return False, f"without the row the deck does not compile: {message}"
    if whole.storage != program.storage and len(whole.code) == len(program.code):
        # The row changes only the size of an array.  Without the row the cards may be the same, but a subscript that
        # exceeds the smaller array shows that the row is needed.
        ending = _outcome(_name(row), layers_for(row), program, data).ending
        if isinstance(ending, Ending) and ending.kind == "bounds" and _has_room(whole, ending):
            return True, f"deck {deck_name} needs the larger array; without the row: {ending.message}"
    with_row = _with_row(_name(row), layers_for(row), deck_name)
    without_row = _outcome(_name(row), layers_for(row), program, data, LIMIT_FACTOR * with_row.longest + LOOP_WINDOW)
    if with_row.same_as(without_row):
        return False, f"deck {deck_name} gives the same cards without the row"
    normal_end = with_row.trouble or "an empty hopper"
    return True, f"deck {deck_name} ends with {normal_end}; without the row: {without_row.trouble or 'different cards'}"


def _has_room(program: Program, ending: Ending) -> bool:
    shape = next(entry.shape for entry in program.storage.entries if entry.name == ending.name)
    return all(1 <= n <= size for n, size in zip(ending.subscripts, shape, strict=True))


def ground_deck(name: str) -> Deck | None:
    """Return a deck that a ground names: an example's input or a deck of ``fortran_src/grounds``, or None."""
    examples = {f"example{number}": number for number in chapter6.EXAMPLES}
    if name in examples:
        return chapter6.input_deck(examples[name])
    entry = programs.sources().joinpath("grounds", f"{name}.deck")
    return deck_from_text(entry.name, entry.read_text(encoding="ascii")) if entry.is_file() else None


@dataclass(frozen=True, slots=True)
class _Outcome:
    """The lines that a job punched and typed, its ending or error, and the number of statements of its longest run."""

    lines: tuple[str, ...]
    ending: Ending | EmulatorError
    longest: int = 0

    @property
    def trouble(self) -> str:
        """The message of an abnormal end, or empty after a normal end."""
        return self.ending.message if isinstance(self.ending, Ending) else str(self.ending)

    def same_as(self, other: "_Outcome") -> bool:
        """Return True if output and kind of ending are equal.  Messages, which contain card numbers, may differ."""
        return self.lines == other.lines and _reason(self.ending) == _reason(other.ending)


def _reason(ending: Ending | EmulatorError) -> tuple[object, ...]:
    if isinstance(ending, Ending):
        return ending.kind, ending.name, ending.subscripts, [line.label for line in ending.loop]
    return (str(ending),)


@cache
def _with_row(name: str, layers: tuple[str, ...], deck_name: str) -> _Outcome:
    """Return the outcome of a data deck with all rows applied; it is cached, because many rows use the same deck."""
    data = ground_deck(deck_name)
    assert data is not None
    return _outcome(name, layers, programs.with_layers(name, layers), data)


def _outcome(name: str, layers: tuple[str, ...], program: Program, deck: Deck, limit: int = 0) -> _Outcome:
    """Run a job on a data deck with ``program`` in place of the built-in program ``name``.

    The other programs of the job are compiled with those of ``layers`` that have rows for them.
    """
    first = "program1_examples" if name == "program1_examples" else "program1"

    def load(requested: str) -> Program:
        return program if requested == name else programs.with_layers(requested, layers)

    try:
        options = LAYERED if layers else LISTED
        steps = run_hull(deck, load, replace(options, limit=limit or options.limit), first).steps
    except EmulatorError as error:
        return _Outcome((), error)
    lines = tuple(line for step in steps for line in (*step.result.punched, *step.result.typed))
    return _Outcome(lines, steps[-1].result.ending, max(step.result.statements for step in steps))


def _forced(row: Row, step: Step | None) -> tuple[bool, str]:
    card, sibling = str(row.ground["card"]), str(row.ground["sibling"])
    names = list(row.ground["rename"])
    exchange = dict(zip(names[::2], names[1::2], strict=True))
    with_row = _card(_built(row), card)
    expected = re.sub(r"[A-Z][A-Z0-9]*", lambda m: exchange.get(m[0], m[0]), _card(_built(row), sibling))
    without_row = _card(_without(row, step), card)
    if with_row != expected:
        return False, f"card {card} differs from card {sibling} with names exchanged"
    if without_row == expected:
        return False, f"card {card} equals card {sibling} with names exchanged also without the row"
    exchanged, equation = ", ".join(f"{a} for {b}" for a, b in exchange.items()), ""
    if ends := row.ground.get("equation"):
        equation = f" and cards {ends[0]} to {ends[1]} compute V of page 15,"
        if not _computes_v(_built(row), *ends) or _computes_v(_without(row, step), *ends):
            return False, f"cards {ends[0]} to {ends[1]} do not compute V of page 15 with the row, or also without it"
    return True, f"card {card} equals card {sibling} with {exchanged},{equation} but not without the row"


# The points P1, P2 and P with which V is computed, each with its coordinates X, Y and Z.
_TRIPLES = (((3, -7, 4), (-5, 2, 9), (6, 8, -1)), ((1, 4, -6), (7, -3, 5), (-2, 9, 8)))


def _computes_v(deck: Deck, first: str, last: str) -> bool:
    """Return True if statements compute V (thesis p. 15), the square of twice the area of the triangle P1 P2 P.

    The statements are run for some points.  The expected value of V is computed from the scalar products of two sides
    of the triangle by Lagrange's identity.
    """
    statements = list(sources(deck))
    begin, end = _index(statements, first), _index(statements, last)
    reading = ("DIMENSION X(3),Y(3),Z(3),E(3)", "I=3", "DO 9 K=1,3", "9 READ 8,X(K),Y(K),Z(K)")
    writing = ("PUNCH 8,E(I)", "8 FORMAT(3F9.0)", "END")
    cards = (*reading, *(statement.text for statement in statements[begin : end + 1]), *writing)
    program = compile_deck(deck_from_lines("V", [f"{'':6}{c}" if c[0] not in "89" else f"    {c}" for c in cards]))
    for points in _TRIPLES:
        data = deck_from_lines("points", ["".join(f"{n:8}." for n in point) for point in points])
        u, v = ([a - b for a, b in zip(points[1], points[k], strict=True)] for k in (2, 0))
        uu, vv, uv = (sum(a * b for a, b in zip(*pair, strict=True)) for pair in ((u, u), (v, v), (u, v)))
        if [float(line) for line in Machine(program, data).run().punched] != [uu * vv - uv * uv]:
            return False
    return True


def _card(deck: Deck, place: str) -> str:
    """Return the text, without blanks and number, of the statement at a place such as ``147+1``."""
    statements = list(sources(deck))
    return statements[_index(statements, place)].text


def _index(statements: Sequence[Source], place: str) -> int:
    label, _, steps = place.partition("+")
    return next(i for i, s in enumerate(statements) if s.label == label) + int(steps or 0)
