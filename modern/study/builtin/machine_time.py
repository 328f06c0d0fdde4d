"""Study how the time on a 1620 (reader, punch, typewriter and processor) depends on the number of points.

The corrected programs are used, so that no set fails because of faults of the listing.  The times come from
emulator/machine/timing.py.  ``samples`` is the number of point sets of each family and N.
"""

from dataclasses import dataclass

from emulator.machine.timing import CONVERSION_MODEL, MODEL
from modern.study.outcomes import DETERMINED_SQL
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
    """The times of the sets of a cell, in seconds.

    sets: the number of sets.  parts: the mean time of each part of the machine.  total: the mean total time.  model:
    the mean total time with its bounds.  longest: the time of the longest run with its bounds.  These bounds follow
    from the systematic error of the timing model.  operations: the mean number of floating-point operations.
    """

    sets: int
    parts: dict[str, Interval]
    total: Interval
    model: Interval
    longest: Interval
    operations: float

    @property
    def processor(self) -> Interval:
        """Return the processor's mean time with the bounds that follow from the systematic error of the model."""
        devices = self.total.value - self.parts["processor"].value
        return Interval(self.parts["processor"].value, self.model.low - devices, self.model.high - devices)


def _times(store: Store) -> dict[int, _Time]:
    figures = [f"CAST(json_extract(figures, '$.seconds_{part}') AS REAL)" for part in PARTS]
    sums = [*figures, " + ".join(figures)]
    moments = ", ".join(f"AVG({s}), SUM(({s}) * ({s}))" for s in sums)
    counted = " + ".join(f"json_extract(figures, '$.{name}')" for name in ("additions", "products", "quotients"))
    ends = [f"CAST(json_extract(figures, '$.model_{end}') AS REAL)" for end in ("low", "high")]
    # If a query of SQLite has one MAX, its other plain columns have the values of the row with the maximum.
    model = ", ".join([*ends, *(f"AVG({end})" for end in ends)])
    timed = store.query(
        f"SELECT cell, COUNT(*), AVG({counted}), MAX({sums[-1]}), {model}, {moments} FROM runs "
        f"WHERE outcome IN {DETERMINED_SQL} GROUP BY cell ORDER BY cell"
    )
    times = {}
    for cell, count, operations, most, most_low, most_high, low, high, *numbers in timed:
        pairs = zip(numbers[::2], numbers[1::2], strict=True)
        means = [
            mean_of(count, average, max(0.0, squares - count * average**2), least=0.0) for average, squares in pairs
        ]
        parts, total, longest = dict(zip(PARTS, means, strict=False)), means[-1], Interval(most, most_low, most_high)
        times[cell] = _Time(count, parts, total, Interval(total.value, low, high), longest, operations)
    return times


def report(plan: Plan, store: Store) -> Report:
    times = _times(store)
    tables = _main(plan, times), _sizes(plan, times), _part_table(plan, times)
    return Report(tables, (_chart(plan, times), _parts(plan, times)), _conclusions(plan, times))


def _in_minutes(seconds: Interval) -> Interval:
    return Interval(seconds.value / _MINUTE, seconds.low / _MINUTE, seconds.high / _MINUTE)


def _by_model(bounds: Interval) -> str:
    return f"{bounds.low / _MINUTE:.2f} to {bounds.high / _MINUTE:.2f}"


def _along(plan: Plan, times: dict[int, _Time], name: Value) -> list[tuple[float, _Time]]:
    return [(float(cell.key["n"]), times[k]) for k, cell in cells(plan, sets=name) if k in times]


def _row(name: Value, n: float, time: _Time) -> tuple[str, ...]:
    minutes = with_interval(_in_minutes(time.total)), _by_model(time.model)
    longest = f"{time.longest.value / _MINUTE:.2f} ({_by_model(time.longest)})"
    return row(name, int(n), time.sets, *minutes, longest, f"{time.operations:.0f}")


_HEAD = ("sets", "N", "timed", "minutes", "by the model", "longest", "operations")
_STUDENT = "The numbers in parentheses are Student's 95 % intervals of the mean, truncated at 0 minutes."
_MODEL = (
    "*By the model* means the lower and upper bound of the mean time, if the processor's true time is "
    f"{MODEL[0]} to {MODEL[1]} times the computed one, and the true time of input and output "
    f"{CONVERSION_MODEL[0]} to {CONVERSION_MODEL[1]} times. Runs of IBM's library of 1962 gave both ranges."
)
_NOTES = (
    f"{_STUDENT} {_MODEL} The column *longest* gives the longest run, with the bounds of its time.",
    "The column *operations* gives the mean number of floating-point additions, products and quotients.",
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


def _part_table(plan: Plan, times: dict[int, _Time]) -> Table:
    rows = []
    for name in values(plan, "sets"):
        for n, time in _along(plan, times, name)[-1:]:
            processor, *devices = (with_interval(_in_minutes(time.parts[part])) for part in PARTS)
            rows.append(row(name, int(n), processor, _by_model(time.processor), *devices))
    head = ("sets", "N", "processor", "by the model", *PARTS[1:])
    notes = (f"{_STUDENT} {_MODEL} The times of reader, punch and typewriter follow from their nominal speeds.",)
    return Table("parts", "Minutes of each part of the machine at the largest N", head, tuple(rows), notes)


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
    largest = max(n for n, _ in timed)
    for number in (POINTS[1], largest):
        there = [time for n, time in timed if n == number]
        if there:
            share = sum(t.parts["processor"].value for t in there) / sum(t.total.value for t in there)
            shares.append(f"{100 * share:.0f} % at N = {number:.0f}")
    minutes = (
        f"{name}, {with_interval(_in_minutes(time.total))} minutes, or {_by_model(time.model)} with the systematic "
        "error"
        for name in values(plan, "sets")
        for n, time in _along(plan, times, name)
        if n == largest
    )
    return (
        f"The mean times for {largest:.0f} points are, by kind of set: {listed(minutes)}.",
        f"Over all kinds of sets, the processor took these shares of the time: {listed(shares)}. Reader, punch and "
        "typewriter took the rest.",
    )
