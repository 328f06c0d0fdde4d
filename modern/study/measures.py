"""Further figures of a run, by name: what a route asks for with ``measures``.

A measure is a function of a sample and of its run, a :class:`modern.thesis.job.HullRun` of the programs or a
:class:`modern.geometry.hull.Hull` of the port, that gives figures: whole numbers, or decimals as text.
``module:function`` names one of a user's own.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from decimal import Decimal
from itertools import pairwise

from emulator.machine.divergence import diverge
from emulator.machine.result import DEFAULT_LIMIT, Options
from emulator.machine.timing import measure
from emulator.numbers import numbers
from modern.geometry.hull import Hull
from modern.study.outcomes import Figures, place
from modern.study.plan import named
from modern.study.sample import Sample
from modern.thesis.cards import planes_hold, read_intermediate
from modern.thesis.job import HullRun

Run = HullRun | Hull
Measure = Callable[[Sample, Run], Figures]
_MILLISECOND = Decimal("0.001")


def machine_time(sample: Sample, run: Run) -> Figures:
    """Seconds on a 1620 of all programs run, processor, reader, punch and typewriter apart
    (emulator/machine/timing.py)."""
    if not isinstance(run, HullRun):
        return {}
    tables = [measure(step.program, step.result) for step in run.steps]
    seconds = {"processor": sum(table.processor_seconds for table in tables)}
    for device, name in enumerate(("reader", "punch", "typewriter")):
        seconds[name] = sum(table.devices[device].seconds for table in tables)
    return {f"seconds_{name}": str(Decimal(value).quantize(_MILLISECOND)) for name, value in seconds.items()}


def operations(sample: Sample, run: Run) -> Figures:
    """Floating-point operations of all programs run: additions (and subtractions), products, quotients."""
    if not isinstance(run, HullRun):
        return {}
    counts: Counter[str] = Counter()
    for step in run.steps:
        counts.update(dict(measure(step.program, step.result).operations))
    return {
        "additions": counts["FAD"] + counts["FSB"] + counts["FSBR"],
        "products": counts["FMP"],
        "quotients": counts["FDV"] + counts["FDVR"],
    }


def plane_table(sample: Sample, run: Run) -> Figures:
    """The most places of program 3's table of planes in use at once; of a port's run with its history.

    Three planes are put after the others before the one they replace is struck, so a stage that begins with L planes
    and replaces m of them reaches L + 2m + 1 (thesis p. 32, statements 126 to 140).
    """
    if not isinstance(run, Hull) or run.dimension < 3 or not run.history:
        return {}
    stages = run.history
    grown = (len(a.equations) + 2 * b.outside + 1 for a, b in pairwise(stages))
    return {"planes_at_once": max(grown, default=len(stages[0].equations))}


def divergence(sample: Sample, run: Run) -> Figures:
    """Where a run in the programs' own arithmetic first decides otherwise than exact numbers would, on its cards.

    ``diverges`` is program and statement; ``cards to program3`` where no decision of program 1 differs but a plane it
    punched, of eight digits, misses its own points, which no arithmetic of the next program can correct; empty where
    every decision is the same.  ``undecided`` says so where exact numbers cannot follow.
    """
    if not isinstance(run, HullRun):
        return {}
    studied, exact = numbers("truncating"), numbers("exact")
    for step in run.steps:
        middle = read_intermediate([card.text for card in step.deck.cards]) if step is not run.steps[0] else None
        if middle is not None and not planes_hold(middle):
            return {"diverges": f"cards to {step.name}"}
        options = Options(core=60_000, limit=DEFAULT_LIMIT)
        found = diverge(step.program, step.deck, studied, exact, options, values=False)
        if found.first_decision is not None:
            return {"diverges": f"{step.name} {place(step.program, found.first_decision.line)}"}
        if found.apart:
            return {"diverges": "", "undecided": found.apart}
    return {"diverges": ""}


MEASURES: Mapping[str, Measure] = {
    "machine_time": machine_time,
    "operations": operations,
    "plane_table": plane_table,
    "divergence": divergence,
}


def measure_of(name: str) -> Measure:
    """The measure of that name, or the function ``module:function``.  Raises PlanError."""
    return named("measure", name, MEASURES)
