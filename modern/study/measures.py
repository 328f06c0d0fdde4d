"""Measures: further figures of a run, which a route requests by name.

A measure is a function of a sample and its run, a :class:`modern.thesis.job.HullRun` of the programs or a
:class:`modern.geometry.hull.Hull` of the port.  It returns figures: integers, or decimals as text.  ``module:function``
names a user-defined measure.
"""

from collections import Counter
from collections.abc import Callable, Mapping
from decimal import Decimal
from itertools import pairwise
from typing import Any

from emulator.machine.divergence import diverge
from emulator.machine.result import DEFAULT_LIMIT, Options
from emulator.machine.timing import Time, measure
from emulator.numbers import numbers
from modern.geometry.hull import Hull
from modern.study.alarms import alarms
from modern.study.outcomes import Figures, position
from modern.study.sample import Sample
from modern.thesis.cards import planes_hold, read_intermediate
from modern.thesis.job import HullRun

# A measure is a function of a sample and of its run, which is a HullRun or a Hull.
Measure = Callable[[Sample, Any], Figures]
_MILLISECOND = Decimal("0.001")


def machine_time(sample: Sample, run: HullRun) -> Figures:
    """Compute the seconds that a run takes on a 1620: processor, reader, punch and typewriter.

    ``model_low`` and ``model_high`` are the bounds of the total time that follow from the systematic error of the
    timing model (emulator/machine/timing.py).
    """
    tables = [measure(step.program, step.result) for step in run.steps]
    figures = {"seconds_processor": sum(table.processor_time.seconds for table in tables)}
    for device, name in enumerate(("reader", "punch", "typewriter")):
        figures[f"seconds_{name}"] = sum(table.devices[device].time.seconds for table in tables)
    time = sum((table.time for table in tables), Time())
    figures |= {"model_low": time.low, "model_high": time.high}
    return {name: str(Decimal(value).quantize(_MILLISECOND)) for name, value in figures.items()}


def operations(sample: Sample, run: HullRun) -> Figures:
    """Count the floating-point operations of a run's programs: additions, subtractions, products, quotients."""
    counts: Counter[str] = Counter()
    for step in run.steps:
        counts.update(dict(measure(step.program, step.result).operations))
    return {
        "additions": counts["FAD"] + counts["FSB"] + counts["FSBR"],
        "products": counts["FMP"],
        "quotients": counts["FDV"] + counts["FDVR"],
    }


def plane_table(sample: Sample, run: Hull) -> Figures:
    """Find the largest number of entries of program 3's plane table that are in use at once.

    For each of the m planes that the new point is outside of, a stage appends three planes and then deletes that plane.
    Planes inside the new hull are deleted only afterwards.  A stage that begins with L planes therefore reaches
    L + 2m + 1 entries (thesis p. 32, statements 126 to 140).
    """
    if run.dimension < 3 or not run.history:
        return {}
    stages = run.history
    peaks = (len(before.equations) + 2 * after.outside + 1 for before, after in pairwise(stages))
    return {"planes_at_once": max(peaks, default=len(stages[0].equations))}


def divergence(sample: Sample, run: HullRun) -> Figures:
    """Find the first statement at which eight-digit and exact arithmetic decide differently on the same cards.

    ``diverges`` names the program and the statement, and is empty if all decisions agree.  ``diverges`` is ``cards to
    program3`` if all decisions of program 1 agree but an equation that program 1 punched with eight digits is not zero
    at the points of its plane.  No arithmetic of the next program can correct this error.  ``undecided`` gives the
    reason if exact arithmetic cannot follow the run.
    """
    studied, exact = numbers("truncating"), numbers("exact")
    for step in run.steps:
        # The cards that pass from one program to the next can be wrong before the next program decides anything.
        intermediate = read_intermediate([card.text for card in step.deck.cards]) if step is not run.steps[0] else None
        if intermediate is not None and not planes_hold(intermediate):
            return {"diverges": f"cards to {step.name}"}
        options = Options(core=60_000, limit=DEFAULT_LIMIT)
        comparison = diverge(step.program, step.deck, studied, exact, options, values=False)
        if comparison.first_decision is not None:
            return {"diverges": f"{step.name} {position(step.program, comparison.first_decision.line)}"}
        if comparison.apart:
            return {"diverges": "", "undecided": comparison.apart}
    return {"diverges": ""}


MEASURES: Mapping[str, Measure] = {
    "machine_time": machine_time,
    "operations": operations,
    "plane_table": plane_table,
    "divergence": divergence,
    "alarms": alarms,
}


# These measures need runs of the port; all others need runs of the programs.
OF_PORT = frozenset({"plane_table"})
