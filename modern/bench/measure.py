"""The engines side by side in one run: plain, compiled, the port in doubles, and the same program made native."""

from __future__ import annotations

import importlib.metadata
import os
import platform
import subprocess
import sys
import tempfile
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from emulator.compiled.batch import punched
from emulator.language.cards import deck_from_text
from emulator.machine.machine import Machine
from modern.bench import native
from modern.bench.agreement import Agreement, compared, data_sets
from modern.bench.decks import LAYERS, OPTIONS, POINTS, PROGRAM, SEED, middle_texts, random_points
from modern.bench.timing import Figure, side_by_side, timed, timed_once
from modern.edition import programs
from modern.port import convex_hull

PLAIN_SHARE, PORT_SHARE = 50, 5
"""The plain engine runs one deck in fifty of those the compiled one runs, the port one in five."""

PLAIN, COMPILED, PORT, NATIVE = "plain engine", "compiled engine", "port, float64", "native program"
COLD, WARM = "cold start: nothing compiled yet", "warm start: a process to its first result"

Say = Callable[[str], None]
"""Takes one line for the user."""


@dataclass(frozen=True, slots=True)
class Row:
    """A figure and the number of decks each of its runs did."""

    figure: Figure
    decks: int

    @property
    def each(self) -> float:
        """Median seconds a deck."""
        return self.figure.median / self.decks


@dataclass(frozen=True, slots=True)
class Bench:
    """Everything measured: a row an engine, process starts, who the native program agrees with, and remarks."""

    rows: tuple[Row, ...]
    starts: tuple[Figure, ...]
    agreement: Agreement | None
    compiler: str
    remarks: tuple[str, ...]

    def row(self, what: str) -> Row | None:
        return next((row for row in self.rows if row.figure.what == what), None)


def measure(count: int, say: Say = lambda line: None) -> Bench:
    """Measure with ``count`` decks; ``say`` is told what is going on."""
    program = programs.program(PROGRAM, LAYERS)
    say(f"making {count} decks of {POINTS} points")
    sets = [random_points(POINTS, SEED + n) for n in range(count)]
    texts = middle_texts(sets)
    few, some = texts[: -(-count // PLAIN_SHARE)], sets[: -(-count // PORT_SHARE)]
    works: dict[str, Callable[[], object]] = {}
    sizes = {PLAIN: len(few), COMPILED: count, PORT: len(some), NATIVE: count}
    remarks: list[str] = []
    next(punched(program, texts, OPTIONS, remarks.append))
    compiles = not remarks
    if compiles:
        works[COMPILED] = lambda: list(punched(program, texts, OPTIONS))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        version = ""
        try:
            found = native.compiler()
            made = native.built(programs.deck(PROGRAM, LAYERS), found, folder)
            cards, taken = folder / "cards", folder / "punched"
            cards.write_text("".join(texts), encoding="ascii")
            native.run(made, cards, taken)
            works[NATIVE] = lambda: native.run(made, cards, taken)
            version = found.version
        except native.NoCompiler as error:
            remarks.append(str(error))
        works[PLAIN] = lambda: [Machine(program, deck_from_text("deck", text), OPTIONS).run() for text in few]
        works[PORT] = lambda: [convex_hull(points, "float64", on_refusal="return") for points in some]
        say(f"running {', '.join(works)}, in turn")
        rows = tuple(Row(figure, sizes[figure.what]) for figure in side_by_side(works))
        agreement = None
        if version:
            ours = [text.splitlines() for text in punched(program, texts, OPTIONS)]
            agreement = compared(ours, data_sets(taken.read_text(encoding="ascii").splitlines()))
        starts = _starts(texts[0], folder, say) if compiles else ()
    return Bench(rows, starts, agreement, version, tuple(remarks))


def _starts(text: str, folder: Path, say: Say) -> tuple[Figure, ...]:
    """A process that has nothing compiled, and those that come after it."""
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(folder / "cache")}

    def process() -> None:
        command = [sys.executable, "-m", "modern.bench.decks"]
        subprocess.run(command, input=text, text=True, check=True, stdout=subprocess.DEVNULL, env=environment)

    say("starting processes")
    return timed_once(COLD, process), timed(WARM, process)


def lines(bench: Bench) -> list[str]:
    """The table as text, 78 columns; below it sentences, a line each."""
    compiled, made = bench.row(COMPILED), bench.row(NATIVE)
    against = " ".join(f"{f'/ {word}':>10}" for word, row in (("compiled", compiled), ("native", made)) if row)
    found = [f"{'program 3, 51 points, text to text':<34}{'decks':>6}{'ms/deck':>8}{'decks/s':>8} {against}".rstrip()]
    for row in bench.rows:
        ratios = " ".join(f"{row.each / other.each:10.2f}" for other in (compiled, made) if other)
        line = f"{row.figure.what:<34}{row.decks:>6}{row.each * 1000:>8.3f}{1 / row.each:>8.0f} {ratios}"
        found.append(line.rstrip())
    found += [f"{figure.what:<47}{figure.median:>9.3f} s" for figure in bench.starts]
    if bench.compiler:
        found.append(f"native program: {bench.compiler}, -O2, doubles, one process for all decks")
    if bench.agreement:
        found.append(f"its cards beside the emulated ones: {bench.agreement.line()}")
    return found + list(bench.remarks)


def document(bench: Bench) -> dict[str, Any]:
    """The same as JSON: every run's seconds, and on what it was measured."""
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
            "another_hull": agreement.other,
            "first": agreement.first,
        },
        "remarks": list(bench.remarks),
    }
