"""The weight of evidence: run every variant of the listings and record the first check that detects the variant.

A variant is a listing with one altered token (:mod:`modern.edition.variants`).  The checks, in this order:

``compiler``  the deck no longer compiles
``no change`` the object code is the same, so the variant is not a different reading and is not counted
``print``     an example of chapter 6 is no longer reproduced.  Program 1 runs in the state that produced the examples,
              and programs 2 and 3 run on the printed intermediate decks.  If only the listing of program 1 has the
              card, the listing runs, and its output must differ from the printed result in more than its order.
``machine``   the variant and the listing give different results for a data deck.  An independent second restoration of
              the listing confirmed the listing's results for all these decks.
``equation``  the card computes a formula of chapter 3 (:data:`EQUATIONS`, compiled by hand)
``sibling``   at least two other cards of the listings have the form of the card (:func:`alike`), and the variant has a
              form that no card has
``nothing``   no check detects the variant

``equation`` and ``sibling`` are comparisons that a reader can make without running the program.  A variant is run until
a result differs: in the state that produced the examples on all six examples, and otherwise only on decks for which the
listing executes the altered card.  Each answer is stored at once, so that an interrupted run can be resumed.
"""

import hashlib
import json
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from emulator.compiled.batch import run_batch
from emulator.errors import EmulatorError, FileError, Refused
from emulator.language.cards import Deck, deck_from_text
from emulator.language.compiler import compile_deck
from emulator.language.expressions import is_fixed_name
from emulator.language.objectcode import Program
from emulator.language.parser import parse_statement
from emulator.language.statements import sources
from emulator.machine.result import Options, Result
from emulator.progress import Progress
from modern.edition import chapter6, programs
from modern.edition.reproduce import DIFFERENT, compare
from modern.edition.variants import Variant, deck_with, statements, variants
from modern.thesis.job import punched_deck, run_hull

NOTICED = ("compiler", "print", "machine", "equation", "sibling", "nothing")
CORE = 60_000
# The parts of a compiled program in which a variant must differ from the listing to be counted.
_PARTS = ("code", "formats", "branches", "subscripts", "loops", "storage")
# The variants that a process judges before it returns their answers.
_CHUNK = 20
# The run of a variant is stopped after LIMIT_FACTOR times the statements of the listing's run, plus LIMIT_EXTRA.
LIMIT_FACTOR, LIMIT_EXTRA = 3, 5_000

# A program, a first and a last card, and the formula of chapter 3 that the floating-point assignments on these cards
# compute.
EQUATIONS: tuple[tuple[str, str, str, str], ...] = (
    ("program1", "113", "113+2", "(3.1)"),
    ("program1", "114", "114+2", "(3.2)"),
    ("program1", "115", "115+2", "(3.3)"),
    ("program1", "183", "183", "(3.1)"),
    ("program1", "190", "190", "(3.2)"),
    ("program1", "192", "192", "(3.3)"),
    ("program1", "125+1", "226", "the formula for V"),
    ("program1", "194", "194+4", "(3.4)"),
    ("program1", "200", "200+4", "(3.4)"),
    ("program2", "102+7", "102+8", "the point C"),
    ("program2", "102+9", "102+21", "(3.5)"),
    ("program2", "133+13", "133+15", "(3.5)"),
    ("program3", "130+3", "130+10", "(3.4)"),
)


@dataclass(frozen=True, slots=True)
class Input:
    """A deck for a built-in program, the check that uses it (``print`` or ``machine``), and the program's result.

    ``example`` is the number of the example from which the deck comes, or 0.
    """

    kind: str
    example: int
    deck: Deck
    result: Result


@dataclass(frozen=True, slots=True)
class Bench:
    """A built-in program with the decks on which its variants are run."""

    program: Program
    inputs: tuple[Input, ...]

    def reaching(self, statement: int) -> Sequence[Input]:
        """Return the inputs for which the program executes a statement, given by its index."""
        counters = [n for n, c in enumerate(self.program.counters) if c.statement == statement and c.begins]
        return [each for each in self.inputs if any(each.result.counts[n] for n in counters)]


def benches(runs: str) -> dict[str, Bench]:
    """Return every built-in program with its input decks, from the examples and the files ``runs``/*/deck.cards."""
    known = [
        ("machine", 0, deck_from_text(path.parent.name, path.read_text(encoding="ascii")))
        for path in (sorted(Path(runs).glob("*/deck.cards")) if runs else ())
    ]
    data = [("print", n, chapter6.input_deck(n)) for n in chapter6.EXAMPLES] + known
    decks: dict[str, list[tuple[str, int, Deck]]] = {name: [] for name in programs.NAMES}
    for first in ("program1", "program1_examples"):
        for kind, number, deck in data:
            decks[first].append((kind, number, deck))
            steps = run_hull(deck, programs.program, Options(limit=200_000), first).steps
            # The state of the examples produced the print.  The second restoration is of the listing.
            punched_by = "program1_examples" if kind == "print" else "program1"
            if len(steps) > 1 and first == punched_by:
                decks[steps[1].name].append((kind, number, punched_deck(steps[0])))
    known_programs = {}
    for name, inputs in decks.items():
        program = programs.program(name)
        results = run_batch(program, [deck for _, _, deck in inputs], Options(limit=100_000, core=CORE))
        known_programs[name] = Bench(
            program, tuple(Input(*each, result) for each, result in zip(inputs, results, strict=True))
        )
    return known_programs


def judged(variant: Variant, known: dict[str, Bench]) -> str:
    """Return the name of the first check that detects a variant.  ``known`` is the result of :func:`benches`."""
    if variant.how == "number" and not _numbers(variant.reads) <= _numbers(variant.was) | _labels(variant.program):
        return "compiler"
    try:
        deck = deck_with(variant.program, variant.card, variant.reads)
        for source in sources(deck) if variant.reads else ():
            if source.cards[0].number == variant.card:
                parse_statement(source)
        program = compile_deck(deck)
    except (EmulatorError, Refused):
        return "compiler"
    listing = known[variant.program].program
    if all(getattr(program, part) == getattr(listing, part) for part in _PARTS):
        return "no change"
    if kind := _run(variant, program, known):
        return kind
    if equation_of(variant.program, variant.place):
        return "equation"
    has_form = variant.reads and _forms()[_form(variant.reads)]
    return "sibling" if alike(variant.was) >= 2 and not has_form else "nothing"


def _numbers(text: str) -> set[str]:
    return set(re.findall(r"(?<![A-Z\d])\d+", text))


@cache
def _labels(name: str) -> frozenset[str]:
    return frozenset(s.source.label for s in statements(name))


def _run(variant: Variant, program: Program, known: dict[str, Bench]) -> str:
    bench = known[variant.program]
    cards = [line.place.card for line in bench.program.statements]
    reached = bench.reaching(cards.index(variant.card)) if variant.card in cards else bench.inputs
    in_examples = _in_the_examples(variant) if variant.program == "program1" else None
    if in_examples is not None:
        prints = [each for each in known["program1_examples"].inputs if each.kind == "print"]
        changes_print = any(_differs(in_examples, each) for each in prints)
    else:
        differs = _disagrees if variant.program == "program1" else _differs
        changes_print = any(differs(program, each) for each in reached if each.kind == "print")
    if changes_print:
        return "print"
    return "machine" if any(_differs(program, each) for each in reached if each.kind == "machine") else ""


def _differs(program: Program, data: Input) -> bool:
    actual = _result(program, data)
    return actual is None or _output(actual) != _output(data.result)


def _output(result: Result) -> tuple[object, ...]:
    return result.punched, result.typed, result.ending.kind


def _result(program: Program, data: Input) -> Result | None:
    limit = LIMIT_FACTOR * data.result.statements + LIMIT_EXTRA
    try:
        return run_batch(program, [data.deck], Options(limit=limit, core=CORE))[0]
    except EmulatorError:
        return None


def _disagrees(program: Program, data: Input) -> bool:
    """Return True if the print detects ``program``, a variant of program 1.

    This is the case if the variant does not run, or types other lines than program 1, or punches cards that differ from
    the printed ones in more than their order.
    """
    actual = _result(program, data)
    if actual is None or actual.typed != data.result.typed:
        return True
    prints = [p for p in chapter6.prints(data.example) if p.program == 1 and p.device == "punch"]
    final = max(p.program for p in chapter6.prints(data.example)) == 1
    return any(compare(p.lines, actual.punched, final, oriented=False).kind == DIFFERENT for p in prints)


def _in_the_examples(variant: Variant) -> Program | None:
    """Return program1_examples with the change of a variant, or None if it lacks the card or does not compile."""
    examples = {(s.place, s.source.label, s.source.text): s for s in statements("program1_examples")}
    listed = next(s for s in statements("program1") if s.card == variant.card)
    counterpart = examples.get((listed.place, listed.source.label, listed.source.text))
    if counterpart is None:
        return None
    try:
        return compile_deck(deck_with("program1_examples", counterpart.card, variant.reads))
    except EmulatorError:
        return None


def equation_of(name: str, place: str) -> str:
    """Return the formula of chapter 3 that a card computes, or an empty string."""
    order = [s.place for s in statements(name)]
    source = statements(name)[order.index(place)].source
    if source.kind == "assignment" and not is_fixed_name(source.text):
        for program, first, last, formula in EQUATIONS:
            if program == name and order.index(first) <= order.index(place) <= order.index(last):
                return formula
    return ""


@cache
def _forms() -> Counter[str]:
    return Counter(
        _form(s.source.text) for name in programs.TEXTS for s in statements(name) if s.source.kind != "format"
    )


def _form(text: str) -> str:
    """Return a statement with each name and number replaced by the rank of its first occurrence.

    ``X(K)=Y(K)`` becomes ``<0>(<1>)=<2>(<1>)``.
    """
    order: dict[str, str] = {}
    return re.sub(r"[A-Z][A-Z0-9]*|\d+", lambda m: order.setdefault(m[0], f"<{len(order)}>"), text)


def alike(text: str) -> int:
    """Return the number of other cards of the three listings that have the same form as a statement.

    Statements have the same form if they differ only in their names and numbers, and repeat these at the same places.
    """
    return max(_forms()[_form(text)] - 1, 0)


def ordered() -> list[Variant]:
    """Return all variants ordered by the SHA-256 of their keys: any first n of them are then a random sample."""
    every = [variant for name in programs.TEXTS for variant in variants(name)]
    return sorted(every, key=lambda v: hashlib.sha256(v.key.encode()).digest())


# The benches of a worker process.
_KNOWN: dict[str, Bench] = {}


def _begin(runs: str) -> None:
    _KNOWN.update(benches(runs))


def _judge(chunk: Sequence[Variant]) -> list[str]:
    return [judged(variant, _KNOWN) for variant in chunk]


def weigh(folder: Path, runs: str, workers: int = 1, most: int = 0) -> dict[str, str]:
    """Judge every variant, or the first ``most`` variants, and map the key of each to the check that detects it.

    The answers are kept in ``folder/variants.jsonl``.  ``runs`` is a folder of decks for the check ``machine``, or
    empty.  Raise FileError if ``runs`` contains no deck, if ``folder`` contains answers for other listings, or if
    ``folder`` cannot be written.
    """
    if runs and not any(Path(runs).glob("*/deck.cards")):
        raise FileError(f"{runs}: expected folders that contain a file deck.cards, found none")
    sample = ordered()[: most or None]
    print_of = hashlib.sha256("".join(programs.committed(n).text() for n in programs.NAMES).encode()).hexdigest()
    path = folder / "variants.jsonl"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        lines = path.read_text(encoding="utf-8").split("\n") if path.exists() else []
        if lines and json.loads(lines[0]) != {"decks": print_of}:
            raise FileError(f"{path}: contains results for other listings; choose another folder")
        # If a run was killed, its last line may be incomplete.  The line is then removed and its variant judged again.
        done = {key: answer for line in lines[1:-1] for key, answer in [json.loads(line)]}
        with path.open("w", encoding="utf-8") as file:
            file.write(json.dumps({"decks": print_of}) + "\n")
            file.writelines(json.dumps([key, answer]) + "\n" for key, answer in done.items())
            file.flush()
            remaining = [variant for variant in sample if variant.key not in done]
            parts = [remaining[k : k + _CHUNK] for k in range(0, len(remaining), _CHUNK)]
            progress = Progress(len(sample), len(sample) - len(remaining))
            with ProcessPoolExecutor(workers, initializer=_begin, initargs=(runs,)) as pool:
                for part, answers in zip(parts, pool.map(_judge, parts), strict=True):
                    for variant, answer in zip(part, answers, strict=True):
                        done[variant.key] = answer
                        file.write(json.dumps([variant.key, answer]) + "\n")
                    file.flush()
                    progress.add(len(part))
            progress.close()
    except (OSError, json.JSONDecodeError) as error:
        raise FileError(f"{path}: {error}") from None
    return {variant.key: done[variant.key] for variant in sample}


def by_card(answers: Mapping[str, str]) -> Iterator[tuple[Variant, Counter[str]]]:
    """Yield, for each card, one of its variants, and a count of its variants by the check that detects them."""
    cards: dict[tuple[str, int], tuple[Variant, Counter[str]]] = {}
    for variant in sorted(ordered(), key=lambda v: (v.program, v.card)):
        if variant.key in answers:
            _, count = cards.setdefault((variant.program, variant.card), (variant, Counter()))
            count[answers[variant.key]] += 1
    yield from cards.values()


def silent(answers: Mapping[str, str]) -> list[Variant]:
    """Return the variants that no check detects, in the order of the cards."""
    undetected = [variant for variant in ordered() if answers.get(variant.key) == "nothing"]
    return sorted(undetected, key=lambda v: (v.program, v.card, v.reads))
