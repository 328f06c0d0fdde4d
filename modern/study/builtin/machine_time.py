"""Study how the time on a 1620 (reader, punch, typewriter and processor) depends on the number of points.

The corrected programs are used, so that no set fails because of faults of the listing.  The times come from
emulator/machine/timing.py.  ``samples`` counts the sets of each family and N.
"""

from dataclasses import dataclass

from emulator.machine.timing import CONVERSION_MODEL, MODEL
from modern.study.outcomes import DETERMINED
from modern.study.plan import Cell, Plan, Programs, Value
from modern.study.report import Lines, Mark, Report, Series, Table, listed, row, with_interval
from modern.study.statistics import Interval, mean_of
from modern.study.store import Store
from modern.study.summary import cells, values

TITLE = "time on the 1620 against the number of points"
SAMPLES = 60
FAMILIES = ("ball", "integers", "cube", "sphere")
POINTS = (4, 6, 8, 12, 16, 20, 25, 30, 35, 40, 45, 51)
ROUTE = "corrected"
PARTS = ("processor", "reader", "punch", "typewriter")
_NAMES = {"integers": "cube, solid", "cube": "cube, surface"}
_HOUR, _MINUTE = 3600, 60


def plan(samples: int = SAMPLES, seed: int = 1963) -> Plan:
    route = Programs(ROUTE, layers=("corrected",), core=60_000, measures=("machine_time", "operations"))
    grid = tuple(
        Cell({"sets": _NAMES.get(family, family), "n": n}, family, {"digits": 2, "n": n}, (route,), samples, chunk=20)
        for family in FAMILIES
        for n in POINTS
    )
    return Plan(
        "machine-time",
        TITLE[0].upper() + TITLE[1:],
        "How long would a set of N points have taken, and was the machine reading, computing or punching?",
        grid,
        seed,
        (
            "Coordinates have two digits, for which eight-digit arithmetic is sufficient. Only runs that give the hull "
            "are timed. The layer corrected removes faults of the listing; its cards change the time little.",
            "The programs are in core: loading them and the work of the operator are not counted. Reader and punch are "
            "buffered and may run at the same time as the processor, so the sum is an upper bound for a run.",
        ),
    )


@dataclass(frozen=True, slots=True)
class _Time:
    """The times of a cell in seconds, by part and in total, the number of sets timed, and the longest run."""

    sets: int
    parts: dict[str, Interval]
    total: Interval
    longest: float
    operations: float
    model: tuple[float, float]


def _times(store: Store) -> dict[int, _Time]:
    figures = [f"CAST(json_extract(figures, '$.seconds_{part}') AS REAL)" for part in PARTS]
    sums = [*figures, " + ".join(figures)]
    moments = ", ".join(f"AVG({s}), SUM(({s}) * ({s}))" for s in sums)
    counted = " + ".join(f"json_extract(figures, '$.{name}')" for name in ("additions", "products", "quotients"))
    model = ", ".join(f"AVG(CAST(json_extract(figures, '$.model_{end}') AS REAL))" for end in ("low", "high"))
    timed = store.query(
        f"SELECT cell, COUNT(*), MAX({sums[-1]}), AVG({counted}), {model}, {moments} FROM runs "
        f"WHERE outcome IN ({', '.join('?' * len(DETERMINED))}) GROUP BY cell ORDER BY cell",
        DETERMINED,
    )
    times = {}
    for cell, count, longest, operations, low, high, *numbers in timed:
        pairs = zip(numbers[::2], numbers[1::2], strict=True)
        means = [
            mean_of(count, average, max(0.0, squares - count * average**2), least=0.0) for average, squares in pairs
        ]
        times[cell] = _Time(count, dict(zip(PARTS, means, strict=False)), means[-1], longest, operations, (low, high))
    return times


def report(plan: Plan, store: Store) -> Report:
    times = _times(store)
    return Report(
        (_main(plan, times), _sizes(plan, times)), (_chart(plan, times), _parts(plan, times)), _conclusions(plan, times)
    )


def _in_minutes(seconds: Interval) -> Interval:
    return Interval(seconds.value / _MINUTE, seconds.low / _MINUTE, seconds.high / _MINUTE)


def _by_model(time: _Time) -> str:
    """Return the mean minutes with the interval of the timing model's systematic error."""
    return f"{time.model[0] / _MINUTE:.2f} to {time.model[1] / _MINUTE:.2f}"


def _along(plan: Plan, times: dict[int, _Time], name: Value) -> list[tuple[float, _Time]]:
    """Return the numbers N of points at which runs of one kind of set were timed, and the times."""
    return [(float(cell.key["n"]), times[k]) for k, cell in cells(plan, sets=name) if k in times]


def _row(name: Value, n: float, time: _Time) -> tuple[str, ...]:
    parts = [f"{time.parts[part].value / _MINUTE:.2f}" for part in PARTS]
    milliseconds = 1000 * time.parts["processor"].value / time.operations if time.operations else 0.0
    minutes = (with_interval(_in_minutes(time.total)), _by_model(time), f"{time.longest / _MINUTE:.2f}", *parts)
    return row(name, int(n), time.sets, *minutes, f"{time.operations:.0f}", f"{milliseconds:.0f}")


_HEAD = ("sets", "N", "timed", "minutes", "by the model", "longest", *PARTS, "operations", "ms an operation")
_NOTES = (
    "In parentheses: Student's 95 % intervals of the mean, truncated at 0 minutes. By the model: mean minutes if "
    f"the processor's times are {MODEL[0]} to {MODEL[1]} of those computed, and {CONVERSION_MODEL[0]} to "
    f"{CONVERSION_MODEL[1]} for input and output, as in runs on IBM's library of 1962. Processor, reader, punch "
    "and typewriter: mean minutes.",
    "Operations: floating-point additions, products and quotients. The last column is the processor time of one.",
)


_CHART_NOTE = (
    "{} sets at each point; bars: 95 % intervals of the mean (Student's); "
    f"systematic error of the processor's times: {MODEL[0]} to {MODEL[1]}"
)


def _main(plan: Plan, times: dict[int, _Time]) -> Table:
    rows = tuple(_row(name, *along[-1]) for name in values(plan, "sets") if (along := _along(plan, times, name)))
    return Table("table", "Minutes on the 1620 at the largest N", _HEAD, rows, _NOTES)


def _sizes(plan: Plan, times: dict[int, _Time]) -> Table:
    rows = tuple(_row(name, n, time) for name in values(plan, "sets") for n, time in _along(plan, times, name))
    return Table("sizes", "Minutes on the 1620 at each N", _HEAD, rows, _NOTES)


def _chart(plan: Plan, times: dict[int, _Time]) -> Lines:
    series = tuple(
        Series(str(name), tuple((n, _in_minutes(time.total)) for n, time in _along(plan, times, name)))
        for name in values(plan, "sets")
    )
    return Lines(
        "time",
        "Time on the 1620, by number of points",
        "points N",
        "minutes",
        tuple(line for line in series if line.points),
        log_x=True,
        log_y=True,
        marks=(Mark(60, "one hour"),),
        note=_CHART_NOTE.format(plan.cells[0].samples),
    )


def _parts(plan: Plan, times: dict[int, _Time]) -> Lines:
    name = values(plan, "sets")[-1]
    along = _along(plan, times, name)
    series = tuple(Series(part, tuple((n, _in_minutes(time.parts[part])) for n, time in along)) for part in PARTS)
    return Lines(
        "parts",
        f"Time of each part of the machine: sets on a {name}",
        "points N",
        "minutes",
        series if along else (),
        log_x=True,
        log_y=True,
        note=_CHART_NOTE.format(plan.cells[0].samples),
    )


def _conclusions(plan: Plan, times: dict[int, _Time]) -> tuple[str, ...]:
    timed = [entry for name in values(plan, "sets") for entry in _along(plan, times, name)]
    if not timed:
        return ("No run gave a hull, so nothing was timed.",)
    shares = []
    for number in (POINTS[1], max(n for n, _ in timed)):
        there = [time for n, time in timed if n == number]
        if there:
            share = sum(t.parts["processor"].value for t in there) / sum(t.total.value for t in there)
            shares.append(f"{100 * share:.0f} % at N = {number:.0f}")
    return (
        f"The processor took this part of the time, over all kinds of sets: {listed(shares)}. Cards and typing took "
        "the rest.",
    )
