"""The weight of evidence, measured: every variant of the listings is run, and what notices it is recorded.

For each variant (:mod:`modern.edition.variants`) the first of these that notices it:

``compiler``  the deck no longer compiles
``no change`` the object code is the same: it is no reading of its own, and is not counted
``print``     an example of chapter 6 comes out otherwise: program 1 in the state of the examples, where the card is in
              it, and programs 2 and 3 on the printed intermediate decks; of a card the listing alone has, no longer in
              agreement with the print up to order
``machine``   a deck whose cards are known from a second restoration comes out otherwise
``equation``  the card computes a formula of chapter 3 (:data:`EQUATIONS`, found by reading) and reads otherwise
``sibling``   the card has the form of two other cards at least of the three listings (:func:`alike`), and reads so that
              it has the form of none: names and numbers stand in another order, or something else does
``nothing``   none of them

Those two are comparisons a reader makes, not runs.  Only decks whose run reaches the card are run, up to the first
that differs.  Answers are kept one by one in the folder, so that a run is resumed where it ended.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
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
PATIENCE, ATTEMPTS = 3, 5_000
"""A variant's run may take so many times the statements of the listing's, and so many more."""

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
"""Program, first and last card, and the formula of chapter 3 that the floating-point assignments of these compute."""


@dataclass(frozen=True, slots=True)
class Bench:
    """A program on its decks: what the listing gives, and how many statements of which index each run begins."""

    program: Program
    decks: tuple[Deck, ...]
    kinds: tuple[str, ...]
    results: tuple[Result, ...]
    examples: tuple[int, ...]

    def reaching(self, statement: int) -> Sequence[int]:
        """The decks whose run begins a statement."""
        counters = [n for n, c in enumerate(self.program.counters) if c.statement == statement and c.begins]
        return [d for d, result in enumerate(self.results) if any(result.counts[n] for n in counters)]


def benches(runs: str) -> dict[str, Bench]:
    """The three programs and the state of the examples on the decks they read; ``runs`` is a folder of known decks."""
    known = [
        ("machine", 0, deck_from_text(path.parent.name, path.read_text(encoding="ascii")))
        for path in (sorted(Path(runs).glob("*/deck.cards")) if runs else ())
    ]
    data = [("print", n, chapter6.input_deck(n)) for n in chapter6.EXAMPLES] + known
    found: dict[str, list[tuple[str, int, Deck]]] = {name: [] for name in programs.NAMES}
    for first in ("program1", "program1_examples"):
        for kind, number, deck in data:
            found[first].append((kind, number, deck))
            steps = run_hull(deck, programs.program, Options(limit=200_000), first).steps
            wanted = first == "program1_examples" if kind == "print" else first == "program1"
            if len(steps) > 1 and wanted:
                found[steps[1].name].append((kind, number, punched_deck(steps[0])))
    return {name: _bench(programs.program(name), decks) for name, decks in found.items()}


def _bench(program: Program, decks: Sequence[tuple[str, int, Deck]]) -> Bench:
    kinds, numbers, cards = zip(*decks, strict=True)
    results = tuple(run_batch(program, cards, Options(limit=100_000, core=CORE)))
    return Bench(program, tuple(cards), tuple(kinds), results, tuple(numbers))


def judged(variant: Variant, known: dict[str, Bench]) -> str:
    """What notices a variant first."""
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
    bench = known[variant.program]
    if (program.code, program.formats, program.branches, program.subscripts, program.loops) == (
        bench.program.code,
        bench.program.formats,
        bench.program.branches,
        bench.program.subscripts,
        bench.program.loops,
    ) and program.storage == bench.program.storage:
        return "no change"
    kinds = _run(variant, program, known)
    if kinds:
        return kinds
    if equation_of(variant.program, variant.place):
        return "equation"
    return "sibling" if _unlike(variant) else "nothing"


def _numbers(text: str) -> set[str]:
    """The numbers of a statement, those of names apart."""
    return set(re.findall(r"(?<![A-Z\d])\d+", text))


@cache
def _labels(name: str) -> frozenset[str]:
    return frozenset(s.source.label for s in statements(name))


def _run(variant: Variant, program: Program, known: dict[str, Bench]) -> str:
    """``print`` or ``machine`` where a run differs; else empty."""
    bench, run = known[variant.program], _begun(variant.program)
    reached = bench.reaching(run.index(variant.card)) if variant.card in run else range(len(bench.decks))
    prints = [d for d in reached if bench.kinds[d] == "print"]
    if variant.program == "program1":
        other = _in_the_examples(variant)
        if other is not None:
            if _differs(other, known["program1_examples"], "print"):
                return "print"
        elif any(_disagrees(program, bench, d) for d in prints):
            return "print"
    elif any(_other(program, bench, d) for d in prints):
        return "print"
    return "machine" if any(_other(program, bench, d) for d in reached if bench.kinds[d] == "machine") else ""


def _begun(name: str) -> list[int]:
    """The cards of the statements a run begins, in the order of Program.statements; FORMATs are none."""
    return [line.place.card for line in programs.program(name).statements]


def _differs(program: Program, bench: Bench, kind: str) -> bool:
    return any(_other(program, bench, d) for d, k in enumerate(bench.kinds) if k == kind)


def _other(program: Program, bench: Bench, d: int) -> bool:
    """Whether a deck gives other cards, other typed lines or another kind of end."""
    was, now = bench.results[d], _result(program, bench, d)
    if now is None:
        return True
    return (was.punched, was.typed, was.ending.kind) != (now.punched, now.typed, now.ending.kind)


def _result(program: Program, bench: Bench, d: int) -> Result | None:
    limit = PATIENCE * bench.results[d].statements + ATTEMPTS
    try:
        return run_batch(program, [bench.decks[d]], Options(limit=limit, core=CORE))[0]
    except EmulatorError:
        return None


def _disagrees(program: Program, bench: Bench, d: int) -> bool:
    """Whether program 1 as listed no longer agrees with the print, up to order."""
    now, example = _result(program, bench, d), bench.examples[d]
    if now is None or now.typed != bench.results[d].typed:
        return True
    pages = [p for p in chapter6.prints(example) if p.program == 1 and p.device == "punch"]
    last = max(p.program for p in chapter6.prints(example)) == 1
    return any(compare(p.lines, now.punched, last, oriented=False).kind == DIFFERENT for p in pages)


def _in_the_examples(variant: Variant) -> Program | None:
    """The same change in the state of the examples; None where the card is not in it, or does not compile there."""
    old = {(s.place, s.source.label, s.source.text): s for s in statements("program1_examples")}
    mine = next(s for s in statements("program1") if s.card == variant.card)
    other = old.get((mine.place, mine.source.label, mine.source.text))
    if other is None:
        return None
    try:
        return compile_deck(deck_with("program1_examples", other.card, variant.reads))
    except EmulatorError:
        return None


def equation_of(name: str, place: str) -> str:
    """The formula of chapter 3 a card computes; empty where it is none."""
    order = [s.place for s in statements(name)]
    source = statements(name)[order.index(place)].source
    if source.kind == "assignment" and not is_fixed_name(source.text):
        for program, first, last, formula in EQUATIONS:
            if program == name and order.index(first) <= order.index(place) <= order.index(last):
                return formula
    return ""


@cache
def _forms() -> Counter[str]:
    """How many cards of the three listings have each form."""
    return Counter(
        _form(s.source.text) for name in programs.TEXTS for s in statements(name) if s.source.kind != "format"
    )


def _form(text: str) -> str:
    """A statement with its names and numbers replaced by their order: ``a(b)=c(b)``."""
    seen: dict[str, str] = {}
    return re.sub(r"[A-Z][A-Z0-9]*|\d+", lambda m: seen.setdefault(m[0], f"<{len(seen)}>"), text)


def alike(text: str) -> int:
    """How many other cards of the three listings have a card's form: its names and numbers by their order alone."""
    return max(_forms()[_form(text)] - 1, 0)


def _unlike(variant: Variant) -> bool:
    return alike(variant.was) >= 2 and not (variant.reads and _forms()[_form(variant.reads)])


def ordered(names: Iterable[str] = programs.TEXTS) -> list[Variant]:
    """All variants in an order that any part of is a fair sample: by SHA-256 of their keys."""
    found = [variant for name in names for variant in variants(name)]
    return sorted(found, key=lambda v: hashlib.sha256(v.key.encode()).digest())


_KNOWN: dict[str, Bench] = {}


def _begin(runs: str) -> None:
    _KNOWN.update(benches(runs))


def _judge(some: Sequence[Variant]) -> list[str]:
    return [judged(variant, _KNOWN) for variant in some]


def weigh(folder: Path, runs: str, workers: int = 1, most: int = 0, chunk: int = 20) -> dict[str, str]:
    """Judge every variant (or the first ``most``), keeping each answer in ``folder/variants.jsonl``; key to answer.

    Raises FileError where ``runs`` holds no deck, and where the folder holds answers of other listings or cannot
    be written.
    """
    if runs and not any(Path(runs).glob("*/deck.cards")):
        raise FileError(f"{runs}: no folder in it has a deck.cards")
    wanted = ordered()[: most or None]
    print_of = hashlib.sha256("".join(programs.committed(n).text() for n in programs.NAMES).encode()).hexdigest()
    path = folder / "variants.jsonl"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        lines = path.read_text(encoding="utf-8").split("\n") if path.exists() else []
        if lines and json.loads(lines[0]) != {"decks": print_of}:
            raise FileError(f"{path}: holds answers of other listings")
        # The last line may have been cut where a run was killed.
        done = {key: answer for line in lines[1:-1] for key, answer in [json.loads(line)]}
        with path.open("w", encoding="utf-8") as file:
            file.write(json.dumps({"decks": print_of}) + "\n")
            file.writelines(json.dumps([key, answer]) + "\n" for key, answer in done.items())
            file.flush()
            left = [variant for variant in wanted if variant.key not in done]
            parts = [left[k : k + chunk] for k in range(0, len(left), chunk)]
            progress = Progress(len(wanted), len(wanted) - len(left))
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
    return {variant.key: done[variant.key] for variant in wanted}


def by_card(answers: Mapping[str, str]) -> Iterator[tuple[Variant, Counter[str]]]:
    """For each card one of its variants, and how many of its variants each thing notices."""
    cards: dict[tuple[str, int], tuple[Variant, Counter[str]]] = {}
    for variant in sorted(ordered(), key=lambda v: (v.program, v.card)):
        if variant.key in answers:
            _, count = cards.setdefault((variant.program, variant.card), (variant, Counter()))
            count[answers[variant.key]] += 1
    yield from cards.values()


def silent(answers: Mapping[str, str]) -> list[Variant]:
    """The variants nothing notices, in the order of the cards."""
    found = [variant for variant in ordered() if answers.get(variant.key) == "nothing"]
    return sorted(found, key=lambda v: (v.program, v.card, v.reads))
