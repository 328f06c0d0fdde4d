"""A benchmark for authors of tools that estimate rounding errors: programs, formulas, and decks with exact decisions.

:func:`benchmark` returns the files as texts.  The same version of the project always returns the same texts.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from importlib.resources import files
from itertools import islice
from typing import NamedTuple

from emulator.language.cards import Deck
from emulator.language.objectcode import Program
from emulator.numbers import Numbers, numbers
from emulator.translation.fpcore import statements
from emulator.translation.writers import translated
from modern.bench.decisions import PROGRAMS, Decision, run_with_decisions, samples, steps_of
from modern.bench.formulas import formulas, fpcore
from modern.edition import programs
from modern.edition.chapter6 import EXAMPLES, input_deck
from modern.formats.columns import csv_text

EXACT, STUDIED = "exact", {"float64": "float64", "decimal8": "truncating"}
RIGHT, WRONG, AFTER = "right", "wrong", "after a wrong one"


class _Case(NamedTuple):
    name: str
    program: Program
    deck: Deck


def benchmark(sets: int = 13) -> dict[str, str]:
    """Return the texts of the benchmark's files, by path.

    The decks contain the six examples of the thesis and ``sets`` random point sets.
    """
    texts = {}
    for name in PROGRAMS:
        deck = programs.deck(name)
        texts[f"original/{name}.f"] = deck.text()
        texts[f"c/{name}.c"] = translated(deck, "c", every_read_ends=False)
        texts[f"fortran/{name}.f90"] = translated(deck, "fortran", every_read_ends=False)
        texts[f"fpcore/{name}.fpcore"] = statements(programs.program(name))
    for name in formulas():
        texts[f"fpcore/{name}.fpcore"] = fpcore(name)
    verdicts = []
    for case in _cases(sets):
        texts[f"decks/{case.name}.deck"] = case.deck.text()
        texts[f"decisions/{case.name}.csv"], verdict = _judged(case)
        verdicts.append(verdict)
    texts["verdicts.json"] = json.dumps(verdicts, indent=1) + "\n"
    readme = files("modern.bench").joinpath("benchmark.md").read_text(encoding="utf-8")
    texts["README.md"] = readme.format(decks=len(verdicts), after=AFTER)
    return texts


def _cases(sets: int) -> Iterator[_Case]:
    """Yield the input decks of program 1, and the decks that program 1 punches from them for programs 2 and 3."""
    decks = [(f"example{n}", input_deck(n)) for n in EXAMPLES]
    decks += [(f"set{n}", deck) for n, deck in enumerate(islice(samples(sets), sets), 1)]
    for name, deck in decks:
        for step, _ in steps_of(deck, numbers(STUDIED["decimal8"])):
            yield _Case(f"{step.name}-{name}", step.program, step.deck)


def _judged(case: _Case) -> tuple[str, dict[str, object]]:
    """Return the table of the decisions of a run as CSV text, and the entry of the deck in ``verdicts.json``."""
    result, exact = run_with_decisions(case.program, case.deck, numbers(EXACT))
    runs = {column: _compared(case, name, exact) for column, name in STUDIED.items()}
    lines = {line.place.card: line.text for line in case.program.statements}
    header = ["number", "card", "statement", "kind", "outcome", "value"]
    header += [f"{column}_{what}" for column in runs for what in ("outcome", "value", "verdict")]
    table: list[Sequence[object]] = [header]
    for n, decision in enumerate(exact):
        row = [n + 1, decision.card, lines[decision.card], decision.kind, decision.outcome]
        table.append([*row, _text(numbers(EXACT), decision), *(cell for run in runs.values() for cell in run[n])])
    firsts = {
        column: next((n + 1 for n, row in enumerate(run) if row[2] == WRONG), None) for column, run in runs.items()
    }
    verdict = {
        "deck": case.name,
        "program": case.program.source,
        "ending": result.ending.kind,
        "decisions": len(exact),
        "exact_zeros": sum(d.kind == "IF" and d.outcome == 0 for d in exact),
        "first_wrong": firsts,
    }
    return csv_text(table), verdict


def _compared(case: _Case, name: str, exact: Sequence[Decision]) -> list[tuple[object, str, str]]:
    """Return, for each decision of the exact run, the outcome, the value and a verdict in the arithmetic ``name``."""
    arithmetic = numbers(name)
    _, decisions = run_with_decisions(case.program, case.deck, arithmetic)
    cells: list[tuple[object, str, str]] = []
    for k, reference in enumerate(exact):
        if k == len(decisions) or (cells and cells[-1][2] != RIGHT):
            return cells + [("", "", AFTER)] * (len(exact) - k)
        same = (decisions[k].card, decisions[k].outcome) == (reference.card, reference.outcome)
        cells.append((decisions[k].outcome, _text(arithmetic, decisions[k]), RIGHT if same else WRONG))
    return cells


def _text(arithmetic: Numbers, decision: Decision) -> str:
    # Fixed-point numbers, which decide a DO, a computed GO TO and some IFs, are Python integers in every arithmetic.
    return str(decision.value) if isinstance(decision.value, int) else arithmetic.text(decision.value)
