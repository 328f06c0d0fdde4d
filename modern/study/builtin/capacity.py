"""Study whether program 3 can handle N = 51 points: how many entries of its plane table do N points need?

The largest number of entries in use at once is counted in a construction in exact arithmetic.  Runs of the programs as
listed show for which sets the 98-entry table is large enough.  Coordinates have two digits.  ``samples`` is the number
of sets of each family and N.
"""

from dataclasses import dataclass

from emulator.language.storage import FIELD, FUNCTION_NAMES, OBJECT_PROGRAM
from emulator.objectdeck.extent import code_positions
from modern.edition import programs
from modern.study.outcomes import TABLE
from modern.study.plan import Cell, Plan, Port, Programs, Value
from modern.study.report import Lines, Mark, Report, Series, Table, row, with_interval
from modern.study.statistics import Interval, exact, mean_of
from modern.study.store import Store
from modern.study.summary import Summary, cells, summary, values

TITLE = "entries of the plane table against the number of points"
SAMPLES = 100
FAMILIES = ("ball", "integers", "cube", "prism", "sphere")
POINTS = (8, 12, 16, 20, 24, 28, 32, 36, 40, 44, 46, 48, 50, 51)
PLACES = 98
CORE = (20_000, 40_000, 60_000)
LISTED, EXACT = "as listed", "exact"
_INTERVALS = (
    "The numbers in parentheses are 95 % intervals: Student's for means, truncated at 0, and exact ones (Clopper and "
    "Pearson) for proportions. The columns *entries* give the entries of the plane table that are in use at once: the"
    " mean and the largest number over all sets."
)
_NAMES = {"integers": "cube, solid", "cube": "cube, surface"}


def plan(samples: int = SAMPLES, seed: int = 1963) -> Plan:
    routes = (Programs(LISTED), Port(EXACT, history=True, measures=("plane_table",)))
    grid = tuple(
        Cell({"sets": _NAMES.get(family, family), "n": n}, family, {"digits": 2, "n": n}, routes, samples, chunk=20)
        for family in FAMILIES
        for n in POINTS
        if family != "prism" or n % 2 == 0
    )
    return Plan(
        "capacity",
        TITLE[0].upper() + TITLE[1:],
        "The thesis gives 51 as the largest number of points for 40,000 positions of core, with 98 = 2N - 4 entries in "
        "the plane table. But a new vertex adds planes before the old planes are deleted. How many entries are in use "
        "at once?",
        grid,
        seed,
        (
            "Coordinates have two digits, for which eight-digit arithmetic is sufficient (study digits), so that the "
            "plane table limits the programs. A hull of N vertices has 2N - 4 planes if no four vertices share a "
            "plane. Those of a prism do, and most points of a ball are inside.",
        ),
    )


@dataclass(frozen=True, slots=True)
class _Peak:
    """The largest number of table entries in use at once: its mean over the sets, with an interval, and its maximum."""

    mean: Interval
    most: int


def _peaks(plan: Plan, store: Store) -> dict[int, _Peak]:
    measured = store.query(
        "SELECT cell, COUNT(*), AVG(places), SUM(places * places), MAX(places) FROM "
        "(SELECT cell, CAST(json_extract(figures, '$.planes_at_once') AS INTEGER) AS places FROM runs "
        "WHERE route = ? AND json_extract(figures, '$.planes_at_once') IS NOT NULL) GROUP BY cell ORDER BY cell",
        (EXACT,),
    )
    return {
        cell: _Peak(mean_of(count, average, max(0.0, squares - count * average * average), least=0.0), most)
        for cell, count, average, squares, most in measured
    }


def positions(places: int) -> int:
    """Return the core positions that program 3 and its subroutines need with a plane table of ``places`` entries."""
    program = programs.program("program3")
    longer = sum(places - PLACES for entry in program.storage.arrays() if entry.size == PLACES)
    return OBJECT_PROGRAM + FUNCTION_NAMES + code_positions(program) + (program.storage.fields + longer) * FIELD


def report(plan: Plan, store: Store) -> Report:
    counts, peaks = summary(store), _peaks(plan, store)
    return Report(
        (_main(plan, counts, peaks), _sizes(plan, counts, peaks), _core(peaks)),
        (_chart(plan, peaks), _full(plan, counts)),
        _conclusions(plan, counts, peaks),
    )


def _main(plan: Plan, counts: Summary, peaks: dict[int, _Peak]) -> Table:
    rows = []
    for name in values(plan, "sets"):
        along = _along(plan, name)
        over = [int(n) for k, n in along if k in peaks and peaks[k].most > PLACES]
        last, n = along[-1]
        if last not in peaks:
            continue
        mean, share = with_interval(peaks[last].mean, 1), counts.share(last, LISTED, (TABLE,))
        rows.append(row(name, over[0] if over else None, int(n), mean, peaks[last].most, share))
    head = ("sets", "more than 98 from N =", "largest N", "entries, mean", "entries, most", "table full, as listed")
    return Table("table", "Entries of the 98-entry plane table in use at once", head, tuple(rows), (_INTERVALS,))


def _sizes(plan: Plan, counts: Summary, peaks: dict[int, _Peak]) -> Table:
    rows = []
    for k, peak in peaks.items():
        key, shares = plan.cells[k].key, (counts.share(k, LISTED, (TABLE,)), counts.share(k, LISTED))
        rows.append(row(key["sets"], key["n"], counts.of(k, LISTED), with_interval(peak.mean, 1), peak.most, *shares))
    head = ("sets", "N", "number", "entries, mean", "entries, most", "table full, as listed", "hull found, as listed")
    return Table("sizes", "Entries in use at once at each N", head, tuple(rows), (_INTERVALS,))


def _core(peaks: dict[int, _Peak]) -> Table:
    most = max((peak.most for peak in peaks.values()), default=PLACES)
    sizes = (
        ("as listed", PLACES),
        ("most entries observed", most),
        ("never full: 4N - 11 at N = 51", 4 * POINTS[-1] - 11),
    )
    rows = tuple(
        row(name, places, positions(places), next((core for core in CORE if positions(places) <= core), "none"))
        for name, places in sizes
    )
    head = ("table", "entries", "positions, about", "smallest core")
    notes = (
        "Program 3 is as listed, except that its plane table has the number of entries in the second column. The "
        "length of its object code is an estimate (docs/reference/machine.md).",
    )
    return Table("storage", "Positions of core needed by program 3", head, rows, notes)


def _along(plan: Plan, name: Value) -> list[tuple[int, float]]:
    return [(k, float(cell.key["n"])) for k, cell in cells(plan, sets=name)]


def _chart(plan: Plan, peaks: dict[int, _Peak]) -> Lines:
    series = []
    for name in values(plan, "sets"):
        points = [(n, peaks[k]) for k, n in _along(plan, name) if k in peaks]
        # The bar extends from the mean to the greatest number of entries, which the table must hold.
        series.append(Series(str(name), tuple((n, Interval(p.mean.value, p.mean.value, p.most)) for n, p in points)))
    return Lines(
        "places",
        "Entries of the plane table in use at once",
        "points N",
        "entries",
        tuple(series),
        marks=(Mark(PLACES, "98 entries, as listed"),),
        note=f"{plan.cells[0].samples} sets at each point; markers: means; bars: up to the greatest number observed",
    )


def _full(plan: Plan, counts: Summary) -> Lines:
    series = tuple(
        Series(str(name), tuple((n, counts.share(k, LISTED, (TABLE,))) for k, n in _along(plan, name)))
        for name in values(plan, "sets")
    )
    return Lines(
        "full",
        "Sets for which the plane table as listed is too short",
        "points N",
        "share of sets with a full table",
        series,
        percent=True,
        note=f"{plan.cells[0].samples} sets at each point; bars: exact 95 % intervals",
    )


def _conclusions(plan: Plan, counts: Summary, peaks: dict[int, _Peak]) -> tuple[str, ...]:
    tried = [(int(cell.key["n"]), peaks[k].most) for k, cell in enumerate(plan.cells) if k in peaks]
    sufficient = max((n for n, _ in tried if all(most <= PLACES for m, most in tried if m <= n)), default=0)
    most = max((peak.most for peak in peaks.values()), default=0)
    conclusions = [
        f"The plane table is {'too short for some' if most > PLACES else 'long enough for all'} sets: up to {most} "
        f"entries were in use at once, and the table as listed has {PLACES}. The largest N up to which no set needed "
        f"more than {PLACES} entries is {sufficient or 'unknown'}."
    ]
    if sufficient:
        number = sum(counts.of(k, LISTED) for k, cell in enumerate(plan.cells) if cell.key["n"] == sufficient)
        conclusions.append(
            f"None of the {number} sets of {sufficient} points needed more than {PLACES} entries, so at most "
            f"{100 * exact(0, number).high:.2f} % of such sets need more (exact 95 % interval)."
        )
    return tuple(conclusions)
