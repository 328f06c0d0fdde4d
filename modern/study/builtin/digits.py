"""Study for which coordinates eight-digit arithmetic is sufficient, and how many digits d-digit coordinates need.

Sets of ten points with integer coordinates of d digits go through the programs, as listed and with the layer
``corrected``, and through the port with arithmetic truncated to P digits, for P from 4 to 28.  ``samples`` is the
number of sets of each d.
docs/explanation/eight-digits.md derives the number of digits with which every test for zero is exact, and the number
that is always enough.
"""

from modern.geometry.hull import NOT_ACCEPTABLE
from modern.study.outcomes import DETERMINED, WRONG
from modern.study.plan import Cell, Plan, Port, Programs, Route
from modern.study.report import INTERVALS, Bars, Lines, Mark, Report, Series, Table, listed, row, share_of
from modern.study.statistics import Interval, exact
from modern.study.store import Store
from modern.study.summary import Summary, summary

TITLE = "digits of coordinates against digits of the arithmetic"
SAMPLES = 300
DIGITS = tuple(range(1, 9))
WORKING = tuple(range(4, 29))
POINTS = 10
LISTED, CORRECTED = "as listed", "corrected"
# Pairs of the number of a cell and the digits of its coordinates.
Cells = tuple[tuple[int, int], ...]
_SHOWN = (1, 2, 3, 4, 6, 8)


def working(digits: int) -> str:
    """Return the name of the route through the port with this number of working digits."""
    return f"P={digits}"


def exact_zeros(digits: int) -> int:
    """Return the number of digits with which every test for zero is exact, for coordinates of ``digits`` digits."""
    return 3 * digits + 1


def enough(digits: int) -> int:
    """Return the number of digits with which no hull fails, for integer coordinates of ``digits`` digits."""
    return 3 * digits + 4


def plan(samples: int = SAMPLES, seed: int = 1963) -> Plan:
    routes: tuple[Route, ...] = (
        Programs(LISTED, limit=200_000),
        Programs(CORRECTED, layers=("corrected",), core=60_000, limit=200_000),
        *(Port(working(p), f"truncating:{p}") for p in WORKING),
    )
    cells = tuple(
        Cell({"digits": d}, "integers", {"digits": d, "n": POINTS}, routes, samples, chunk=10) for d in DIGITS
    )
    return Plan(
        "digits",
        TITLE[0].upper() + TITLE[1:],
        "How many digits may coordinates have in eight-digit arithmetic, and how many digits does the procedure need "
        "so that it never fails for coordinates of d digits?",
        cells,
        seed,
        (
            f"Sets have {POINTS} points, about as many as the examples of the thesis. Program 1 punches eight digits "
            "for the next program, whatever the arithmetic. So P is varied in the port, which keeps all digits. With "
            "eight digits the port decides as the corrected programs do.",
        ),
    )


def least(counts: Summary, cell: int) -> int | None:
    """Return the least number P of digits such that no set of the cell failed with P or more digits, or None."""
    return counts.sound_from(cell, working, WORKING)


def report(plan: Plan, store: Store) -> Report:
    counts, cells = summary(store), _cells(plan)
    return Report(
        (_main(counts, cells), _by_working(counts, cells), _outcomes(counts, cells)),
        (_growth(counts, cells), _needed(counts, cells), _eight(counts, cells)),
        _conclusions(counts, cells),
    )


def _cells(plan: Plan) -> Cells:
    return tuple((number, int(cell.key["digits"])) for number, cell in enumerate(plan.cells))


def _main(counts: Summary, cells: Cells) -> Table:
    rows = []
    for cell, d in cells:
        p = least(counts, cell)
        shares = counts.share(cell, LISTED), counts.share(cell, CORRECTED)
        failures = None if p is None else exact(0, counts.of(cell, working(p)))
        rows.append(row(d, counts.of(cell, LISTED), *shares, p, exact_zeros(d), enough(d), failures))
    needed = ("least P without failure", "zeros exact: 3d+1", "always enough: 3d+4", "failures at least P")
    head = ("digits d", "sets", "hull found, as listed", "hull found, corrected", *needed)
    notes = (
        *INTERVALS,
        "No set failed with the least P. The interval in the last column tells what share of such sets could still "
        "fail.",
    )
    return Table("table", "Digits of the coordinates against digits of the arithmetic", head, tuple(rows), notes)


def _by_working(counts: Summary, cells: Cells) -> Table:
    rows = tuple(row(p, *(counts.share(cell, working(p)) for cell, _ in cells)) for p in WORKING)
    return Table("working", "Hull found, by working digits P", ("P", *(f"d={d}" for _, d in cells)), rows, INTERVALS)


def _outcomes(counts: Summary, cells: Cells) -> Table:
    outcomes = counts.outcomes()
    rows = tuple(
        row(d, route, *(counts.hits(cell, route, (outcome,)) for outcome in outcomes))
        for cell, d in cells
        for route in (LISTED, CORRECTED)
    )
    return Table("outcomes", "Outcomes in eight-digit arithmetic", ("digits d", "programs", *outcomes), rows)


def _growth(counts: Summary, cells: Cells) -> Lines:
    lines = tuple(
        Series(f"d = {d}", tuple((float(p), counts.share(cell, working(p))) for p in WORKING))
        for cell, d in cells
        if d in _SHOWN
    )
    return Lines(
        "working",
        f"Sets of {POINTS} points whose hull is found with P truncated digits",
        "working digits P",
        "share of sets whose hull is found",
        lines,
        percent=True,
        marks=(Mark(8, "eight digits of the 1620", upright=True),),
        note=f"integer coordinates of d digits, {counts.of(0, LISTED)} sets each; bars: exact 95 % intervals",
    )


def _needed(counts: Summary, cells: Cells) -> Lines:
    measured = [(d, least(counts, cell)) for cell, d in cells]
    return Lines(
        "needed",
        "Working digits needed",
        "digits of the coordinates d",
        "working digits P",
        (
            Series(
                f"least P without failure in {counts.of(0, LISTED)} sets",
                tuple(_drawn(d, p) for d, p in measured if p is not None),
            ),
            Series("zeros exact: 3d + 1", tuple(_drawn(d, exact_zeros(d)) for _, d in cells)),
            Series("always enough: 3d + 4", tuple(_drawn(d, enough(d)) for _, d in cells)),
        ),
        marks=(Mark(8, "eight digits of the 1620"),),
        note="least P: no set failed at it or at any greater P up to 28",
    )


def _drawn(place: int, value: int) -> tuple[float, Interval]:
    return float(place), Interval(float(value), float(value), float(value))


def _eight(counts: Summary, cells: Cells) -> Bars:
    parts = (("hull found", DETERMINED), (NOT_ACCEPTABLE, (NOT_ACCEPTABLE,)), (WRONG, (WRONG,)))
    bars = tuple(
        Series(name, tuple((str(d), counts.share(cell, CORRECTED, outcomes)) for cell, d in cells))
        for name, outcomes in parts
    )
    return Bars(
        "eight",
        "The corrected programs in eight-digit arithmetic",
        "digits of the coordinates d",
        "share of sets",
        bars,
        percent=True,
        note=f"{counts.of(0, CORRECTED)} sets of {POINTS} points each; bars: exact 95 % intervals",
    )


def _conclusions(counts: Summary, cells: Cells) -> tuple[str, ...]:
    without_failure = [d for cell, d in cells if not counts.failed(cell, CORRECTED)]
    without_hull = [d for cell, d in cells if not counts.hits(cell, CORRECTED)]
    wrong = sum(counts.hits(cell, CORRECTED, (WRONG,)) for cell, _ in cells)
    failed = sum(counts.failed(cell, CORRECTED) for cell, _ in cells)
    agree = [d for cell, d in cells if least(counts, cell) == exact_zeros(d)]
    sets = counts.of(0, LISTED)
    return (
        "In eight-digit arithmetic the corrected programs found every hull if the coordinates had one of these numbers "
        f"of digits: {listed(without_failure)}. The programs found no hull at all for these numbers of digits: "
        f"{listed(without_hull)}.",
        f"Of the failures, {share_of(wrong, failed)}, are plausible but wrong hulls.",
        f"The coordinates had d digits, and the arithmetic P digits. For {len(agree)} of the {len(cells)} values of d "
        "that were tried, the smallest P at which no set failed was 3d + 1. With 3d + 1 digits, every test for zero is "
        "exact. If none of "
        f"{sets} sets fails, up to {100 * exact(0, sets).high:.2f} % of such sets could still fail (exact 95 % "
        "interval). A proof shows that no set fails with P = 3d + 4 digits.",
    )
