"""Compare the speed of the interpreter, the compiled engine, Butler's procedure in doubles, and a native program."""

import importlib.metadata
import os
import platform
import random
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from emulator.compiled.batch import punched, run_batch
from emulator.language.cards import Deck, deck_from_text
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from modern.bench import native
from modern.bench.agreement import Agreement, compare, data_sets
from modern.bench.timing import Figure, side_by_side, timed, timed_once
from modern.edition import programs
from modern.formats import deck
from modern.port import convex_hull

# Program 3 reads the decks that program 1 punches for random points.  It runs with the layer that removes the known
# faults.
PROGRAM, LAYERS = "program3", ("corrected",)
OPTIONS = Options(core=60_000)
POINTS, LARGEST, SEED = 51, 99, 1963

# A Python program that reads one deck from standard input and runs it on the compiled engine.
_ONE_DECK = f"""
import sys
from emulator.compiled.batch import punched
from emulator.machine.result import Options
from modern.edition import programs
program = programs.program({PROGRAM!r}, {LAYERS!r})
sys.stdout.writelines(punched(program, [sys.stdin.read()], Options(core={OPTIONS.core})))
"""

# The compiled engine runs all decks, the plain engine (the interpreter) one in fifty, and the port one in five.
PLAIN_SHARE, PORT_SHARE = 50, 5

PLAIN, COMPILED, PORT, NATIVE = "plain engine", "compiled engine", "port, float64", "native program"
COLD, WARM = "cold start: nothing compiled yet", "warm start: time to the first result"

Point = tuple[int, int, int]
# A function that receives one line for the user.
Say = Callable[[str], None]


@dataclass(frozen=True, slots=True)
class Row:
    """The measured times of an engine, and the number of decks in each run.

    A row is one line in the table of results.
    """

    figure: Figure
    decks: int

    @property
    def each(self) -> float:
        """The median of the seconds for one deck."""
        return self.figure.median / self.decks


@dataclass(frozen=True, slots=True)
class Bench:
    """The results of a measurement.

    ``rows`` has the times of the engines, and ``starts`` has the times of processes from their start to the end of one
    deck.  ``compiler`` is the version of the Fortran compiler, or empty if there is none.
    """

    rows: tuple[Row, ...]
    starts: tuple[Figure, ...]
    agreement: Agreement | None
    compiler: str
    remarks: tuple[str, ...]

    def row(self, what: str) -> Row | None:
        return next((row for row in self.rows if row.figure.what == what), None)


def random_points(count: int, seed: int) -> list[Point]:
    """Return distinct points in random order, whose coordinates are uniformly distributed integers in [-99, 99]."""
    source = random.Random(seed)
    distinct: set[Point] = set()
    while len(distinct) < count:
        x, y, z = (source.randint(-LARGEST, LARGEST) for _ in range(3))
        distinct.add((x, y, z))
    points = sorted(distinct)
    source.shuffle(points)
    return points


def data_deck(points: Sequence[Point]) -> Deck:
    """Return the input deck of program 1 for these points: a card with N, then one card for each point."""
    return deck.data_deck([list(map(str, point)) for point in points], "random deck")


def middle_texts(sets: Sequence[Sequence[Point]]) -> list[str]:
    """Return, as texts, the decks for program 3 that program 1 punches for these point sets."""
    results = run_batch(programs.program("program1"), [data_deck(points) for points in sets])
    return ["".join(card + "\n" for card in result.punched) for result in results]


def measure(count: int, say: Say = lambda line: None) -> Bench:
    """Measure all engines with ``count`` decks.  ``say`` is called with each line about the progress."""
    program = programs.program(PROGRAM, LAYERS)
    say(f"generating {count} decks of {POINTS} points")
    sets = [random_points(POINTS, SEED + n) for n in range(count)]
    texts = middle_texts(sets)
    plain_texts, port_sets = texts[: -(-count // PLAIN_SHARE)], sets[: -(-count // PORT_SHARE)]
    works: dict[str, Callable[[], object]] = {}
    sizes = {PLAIN: len(plain_texts), COMPILED: count, PORT: len(port_sets), NATIVE: count}
    remarks: list[str] = []
    next(punched(program, texts, OPTIONS, remarks.append))
    compiles = not remarks
    if compiles:
        works[COMPILED] = lambda: list(punched(program, texts, OPTIONS))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        version = ""
        try:
            fortran = native.compiler()
            executable = native.built(programs.deck(PROGRAM, LAYERS), fortran, folder)
            cards, punched_file = folder / "cards", folder / "punched"
            cards.write_text("".join(texts), encoding="ascii")
            native.run(executable, cards, punched_file)
            works[NATIVE] = lambda: native.run(executable, cards, punched_file)
            version = fortran.version
        except native.NoCompiler as error:
            remarks.append(str(error))
        works[PLAIN] = lambda: [Machine(program, deck_from_text("deck", text), OPTIONS).run() for text in plain_texts]
        works[PORT] = lambda: [convex_hull(points, "float64", on_refusal="return") for points in port_sets]
        say(f"running {', '.join(works)}, in turn")
        rows = tuple(Row(figure, sizes[figure.what]) for figure in side_by_side(works))
        agreement = None
        if version:
            ours = [text.splitlines() for text in punched(program, texts, OPTIONS)]
            agreement = compare(ours, data_sets(punched_file.read_text(encoding="ascii").splitlines()))
        starts = _starts(texts[0], folder, say) if compiles else ()
    return Bench(rows, starts, agreement, version, tuple(remarks))


def _starts(text: str, folder: Path, say: Say) -> tuple[Figure, ...]:
    """Time a first process, which compiles the engine to run a deck, and later ones, which load the compiled engine."""
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(folder / "cache")}

    def process() -> None:
        command = [sys.executable, "-c", _ONE_DECK]
        subprocess.run(command, input=text, text=True, check=True, stdout=subprocess.DEVNULL, env=environment)

    say("starting processes")
    return timed_once(COLD, process), timed(WARM, process)


def lines(bench: Bench) -> list[str]:
    """Return the results as the lines of a table of 78 columns, followed by one line for each remark."""
    compiled_row, native_row = bench.row(COMPILED), bench.row(NATIVE)
    headings = " ".join(
        f"{f'/ {word}':>10}" for word, row in (("compiled", compiled_row), ("native", native_row)) if row
    )
    rows = [f"{'program 3, 51 points, text to text':<34}{'decks':>6}{'ms/deck':>8}{'decks/s':>8} {headings}".rstrip()]
    for row in bench.rows:
        ratios = " ".join(f"{row.each / reference.each:10.2f}" for reference in (compiled_row, native_row) if reference)
        line = f"{row.figure.what:<34}{row.decks:>6}{row.each * 1000:>8.3f}{1 / row.each:>8.0f} {ratios}"
        rows.append(line.rstrip())
    rows += [f"{figure.what:<47}{figure.median:>9.3f} s" for figure in bench.starts]
    if bench.compiler:
        rows.append(f"native program: {bench.compiler}, -O2, doubles, one process for all decks")
    if bench.agreement:
        rows.append(f"native and emulated cards: {bench.agreement.line()}")
    return rows + list(bench.remarks)


def document(bench: Bench) -> dict[str, Any]:
    """Return the results as data for a JSON file: the seconds of every run, the machine, and the versions."""
    versions = {"python": platform.python_version()}
    for name in ("hull1620", "numba", "numpy"):
        with suppress(importlib.metadata.PackageNotFoundError):
            versions[name] = importlib.metadata.version(name)
    agreement = bench.agreement
    return {
        "program": PROGRAM,
        "layers": list(LAYERS),
        "points": POINTS,
        "seed": SEED,
        "machine": {"system": platform.platform(), "processors": os.cpu_count(), "versions": versions},
        "compiler": bench.compiler or None,
        "engines": [
            {
                "what": row.figure.what,
                "decks": row.decks,
                "seconds": list(row.figure.seconds),
                "seconds_a_deck": row.each,
            }
            for row in bench.rows
        ],
        "starts": [{"what": figure.what, "seconds": list(figure.seconds)} for figure in bench.starts],
        "agreement": None
        if agreement is None
        else {
            "same": agreement.same,
            "other_digits": agreement.digits,
            "another_hull": agreement.different,
            "first": agreement.first,
        },
        "remarks": list(bench.remarks),
    }
