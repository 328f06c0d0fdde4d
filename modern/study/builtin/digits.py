"""What eight digits can bear, and how many digits whole coordinates of d digits need.

Sets of ten points with whole coordinates of d digits go through the programs, as listed and with the layer
``corrected``, and through the port with P digits, truncating, for P from 4 to 28.  ``samples`` counts the sets of
each d.  docs/explanation/eight-digits.md derives the digits that decide every zero, and those that are always enough.
"""

from __future__ import annotations

from modern.geometry.hull import NOT_ACCEPTABLE
from modern.study.outcomes import DETERMINED, WRONG
from modern.study.plan import Cell, Plan, Port, Programs, Route
from modern.study.report import INTERVALS, Bars, Lines, Mark, Report, Series, Table, listed, percent, share_of
from modern.study.statistics import Interval, exact
from modern.study.store import Store
from modern.study.summary import Summary, summary

TITLE = "digits of coordinates against digits of the arithmetic"
SAMPLES = 300
DIGITS = tuple(range(1, 9))
WORKING = tuple(range(4, 29))
POINTS = 10
LISTED, CORRECTED = "as listed", "corrected"
Cells = tuple[tuple[int, int], ...]
"""The cells' numbers and digits."""
_SHOWN = (1, 2, 3, 4, 6, 8)


def working(digits: int) -> str:
    """The name of the route with so many working digits."""
    return f"P={digits}"


def exact_zeros(digits: int) -> int:
    """Working digits with which every test for zero at whole coordinates of ``digits`` digits is exact."""
    return 3 * digits + 1


def enough(digits: int) -> int:
    """Working digits that are always enough for whole coordinates of ``digits`` digits (docs/explanation)."""
    return 3 * digits + 4


def plan(samples: int = SAMPLES, seed: int = 1963) -> Plan:
    """The plan for ``samples`` sets of each number of digits."""
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
        "How many digits may coordinates have for arithmetic of eight digits, and how many digits does the procedure "
        "need so that coordinates of d digits never fail?",
        cells,
        seed,
        (
            f"Sets have {POINTS} points, about as many as the thesis's examples have. The programs punch eight digits "
            "between program 1 and its followers, whatever the arithmetic; so the port, which keeps all digits, is "
            "what P is varied in. At eight digits it decides as the corrected programs do.",
        ),
    )


def least(found: Summary, cell: int) -> int | None:
    """The least P from which on no set of the cell failed; None where the greatest fails too."""
    return found.sound_from(cell, working, WORKING)


def report(plan: Plan, store: Store) -> Report:
    """Tables, charts and words."""
    found, cells = summary(store), _cells(plan)
    return Report(
        (_main(found, cells), _by_working(found, cells), _outcomes(found, cells)),
        (_growth(found, cells), _needed(found, cells), _eight(found, cells)),
        _words(found, cells),
    )


def _cells(plan: Plan) -> Cells:
    return tuple((number, int(cell.key["digits"])) for number, cell in enumerate(plan.cells))


def _main(found: Summary, cells: Cells) -> Table:
    rows = []
    for cell, d in cells:
        p = least(found, cell)
        rows.append(
            (
                str(d),
                str(found.of(cell, LISTED)),
                percent(found.share(cell, LISTED)),
                percent(found.share(cell, CORRECTED)),
                "-" if p is None else str(p),
                str(exact_zeros(d)),
                str(enough(d)),
                "-" if p is None else percent(exact(0, found.of(cell, working(p)))),
            )
        )
    head = (
        "digits d",
        "sets",
        "hull found, as listed",
        "hull found, corrected",
        "least P without failure",
        "zeros exact: 3d+1",
        "always enough: 3d+4",
        "failures at least P",
    )
    notes = (
        *INTERVALS,
        "The failures at the least P are none; their interval says how often sets could still fail there.",
    )
    return Table("table", "Digits of the coordinates against digits of the arithmetic", head, tuple(rows), notes)


def _by_working(found: Summary, cells: Cells) -> Table:
    rows = tuple((str(p), *(percent(found.share(cell, working(p))) for cell, _ in cells)) for p in WORKING)
    return Table("working", "Hull found, by working digits P", ("P", *(f"d={d}" for _, d in cells)), rows, INTERVALS)


def _outcomes(found: Summary, cells: Cells) -> Table:
    seen = found.outcomes()
    rows = tuple(
        (str(d), route, *(str(found.hits(cell, route, (outcome,))) for outcome in seen))
        for cell, d in cells
        for route in (LISTED, CORRECTED)
    )
    return Table("outcomes", "Outcomes with eight digits", ("digits d", "programs", *seen), rows)


def _growth(found: Summary, cells: Cells) -> Lines:
    lines = tuple(
        Series(f"d = {d}", tuple((float(p), found.share(cell, working(p))) for p in WORKING))
        for cell, d in cells
        if d in _SHOWN
    )
    return Lines(
        "working",
        f"Sets of {POINTS} points whose hull is found with P truncated digits",
        "working digits P",
        "hull found, of all sets",
        lines,
        percent=True,
        marks=(Mark(8, "the 1620's eight", upright=True),),
        note=f"whole coordinates of d digits, {found.of(0, LISTED)} sets each; bars: exact 95 % intervals",
    )


def _needed(found: Summary, cells: Cells) -> Lines:
    measured = [(d, least(found, cell)) for cell, d in cells]
    return Lines(
        "needed",
        "Working digits without which sets fail",
        "digits of the coordinates d",
        "working digits P",
        (
            Series(
                f"least P without failure in {found.of(0, LISTED)} sets",
                tuple(_drawn(d, p) for d, p in measured if p is not None),
            ),
            Series("zeros exact: 3d + 1", tuple(_drawn(d, exact_zeros(d)) for _, d in cells)),
            Series("always enough: 3d + 4", tuple(_drawn(d, enough(d)) for _, d in cells)),
        ),
        marks=(Mark(8, "the 1620's eight"),),
        note="a least P stands where no set failed at it or at any greater P up to 28",
    )


def _drawn(place: int, value: int) -> tuple[float, Interval]:
    """A number known without error, as a point of a chart."""
    return float(place), Interval(float(value), float(value), float(value))


def _eight(found: Summary, cells: Cells) -> Bars:
    parts = (("hull found", DETERMINED), (NOT_ACCEPTABLE, (NOT_ACCEPTABLE,)), (WRONG, (WRONG,)))
    bars = tuple(
        Series(name, tuple((str(d), found.share(cell, CORRECTED, outcomes)) for cell, d in cells))
        for name, outcomes in parts
    )
    return Bars(
        "eight",
        "The corrected programs with eight digits",
        "digits of the coordinates d",
        "share of all sets",
        bars,
        percent=True,
        note=f"{found.of(0, CORRECTED)} sets of {POINTS} points each; bars: exact 95 % intervals",
    )


def _words(found: Summary, cells: Cells) -> tuple[str, ...]:
    sound = [d for cell, d in cells if not found.failed(cell, CORRECTED)]
    lost = [d for cell, d in cells if not found.hits(cell, CORRECTED)]
    wrong = sum(found.hits(cell, CORRECTED, (WRONG,)) for cell, _ in cells)
    failed = sum(found.failed(cell, CORRECTED) for cell, _ in cells)
    agree = [d for cell, d in cells if least(found, cell) == exact_zeros(d)]
    sets = found.of(0, LISTED)
    return (
        f"Eight digits, layer corrected: digits d of the coordinates at which no set failed: {listed(sound)}; at which "
        f"no hull was found: {listed(lost)}.",
        f"Of the sets that failed so, those that ended in a wrong hull that looks right: {share_of(wrong, failed)}.",
        f"Lengths d for which the least P is 3d + 1, with which every test for zero is exact: {len(agree)} of "
        f"{len(cells)}. Where none of {sets} sets fails, up to {100 * exact(0, sets).high:.2f} % of such sets could "
        "(95 %, exact); with 3d + 4 digits none can.",
    )
