"""Whether N = 51 was ever true: how many places of the table of planes N points need.

The construction over exact numbers tells the most places in use at once; the programs as listed, with two-digit
coordinates, which eight digits bear, tell what 98 places come to.  ``samples`` counts the sets of each family and N.
"""

from __future__ import annotations

from dataclasses import dataclass

from emulator.language.objectcode import code_positions
from emulator.language.storage import FIELD, FUNCTION_NAMES, OBJECT_PROGRAM
from modern.edition import programs
from modern.study.outcomes import TABLE
from modern.study.plan import Cell, Plan, Port, Programs, Value
from modern.study.report import Lines, Mark, Report, Series, Table, percent, with_interval
from modern.study.statistics import Interval, exact, mean_of
from modern.study.store import Store
from modern.study.summary import Summary, cells, summary, values

TITLE = "places in the table of planes against the number of points"
SAMPLES = 100
FAMILIES = ("ball", "integers", "cube", "prism", "sphere")
POINTS = (8, 12, 16, 20, 24, 28, 32, 36, 40, 44, 46, 48, 50, 51)
PLACES = 98
CORE = (20_000, 40_000, 60_000)
LISTED, EXACT = "as listed", "exact"
_INTERVALS = (
    "In brackets: 95 % intervals, of means by Student's t, cut at 0 places, of proportions exact (Clopper and Pearson)."
)
_NAMES = {"integers": "cube, solid", "cube": "cube, surface"}


def plan(samples: int = SAMPLES, seed: int = 1963) -> Plan:
    """The plan for ``samples`` sets of each family and N."""
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
        "The thesis gives 51 as the most points for 40,000 positions, with 98 = 2N - 4 places for planes. But a vertex "
        "taken in makes new planes before the old ones are struck: how many places are in use at once?",
        grid,
        seed,
        (
            "Coordinates have two digits, which eight digits of arithmetic bear (study digits), so that it is the "
            "table that limits the programs. A hull of N vertices has 2N - 4 planes where no four vertices share one; "
            "a prism's do, and most points of a ball are inside.",
        ),
    )


@dataclass(frozen=True, slots=True)
class _Peak:
    """Places in use at once: the mean with its interval, and the greatest."""

    mean: Interval
    most: int


def _peaks(plan: Plan, store: Store) -> dict[int, _Peak]:
    asked = store.query(
        "SELECT cell, COUNT(*), AVG(places), SUM(places * places), MAX(places) FROM "
        "(SELECT cell, CAST(json_extract(figures, '$.planes_at_once') AS INTEGER) AS places FROM runs "
        "WHERE route = ? AND json_extract(figures, '$.planes_at_once') IS NOT NULL) GROUP BY cell ORDER BY cell",
        (EXACT,),
    )
    return {
        cell: _Peak(mean_of(count, average, max(0.0, squares - count * average * average), least=0.0), most)
        for cell, count, average, squares, most in asked
    }


def positions(places: int) -> int:
    """Positions of core program 3 needs with so many places for planes, the machine's own part included."""
    program = programs.program("program3")
    longer = sum(places - PLACES for entry in program.storage.arrays() if entry.size == PLACES)
    return OBJECT_PROGRAM + FUNCTION_NAMES + code_positions(program) + (program.storage.fields + longer) * FIELD


def report(plan: Plan, store: Store) -> Report:
    """Tables, charts and words."""
    found, peaks = summary(store), _peaks(plan, store)
    return Report(
        (_main(plan, found, peaks), _sizes(plan, found, peaks), _core(peaks)),
        (_chart(plan, peaks), _full(plan, found)),
        _words(plan, found, peaks),
    )


def _main(plan: Plan, found: Summary, peaks: dict[int, _Peak]) -> Table:
    rows = []
    for name in values(plan, "sets"):
        along = _along(plan, name)
        over = [int(n) for k, n in along if k in peaks and peaks[k].most > PLACES]
        last, n = along[-1]
        if last not in peaks:
            continue
        rows.append(
            (
                str(name),
                str(over[0]) if over else "-",
                str(int(n)),
                with_interval(peaks[last].mean, 1),
                str(peaks[last].most),
                percent(found.share(last, LISTED, (TABLE,))),
            )
        )
    head = ("sets", "more than 98 from N =", "largest N", "places there, mean", "most", "table full, as listed")
    return Table("table", "Places in use at once, of 98", head, tuple(rows), (_INTERVALS,))


def _sizes(plan: Plan, found: Summary, peaks: dict[int, _Peak]) -> Table:
    rows = tuple(
        (
            str(cell.key["sets"]),
            str(cell.key["n"]),
            str(found.of(k, LISTED)),
            with_interval(peaks[k].mean, 1),
            str(peaks[k].most),
            percent(found.share(k, LISTED, (TABLE,))),
            percent(found.share(k, LISTED)),
        )
        for k, cell in enumerate(plan.cells)
        if k in peaks
    )
    head = ("sets", "N", "number", "places at once, mean", "most", "table full, as listed", "hull found, as listed")
    return Table("sizes", "The same at each N", head, rows, (_INTERVALS,))


def _core(peaks: dict[int, _Peak]) -> Table:
    most = max((peak.most for peak in peaks.values()), default=PLACES)
    wanted = (("as listed", PLACES), ("most places seen", most), ("never full: 4N - 11 at N = 51", 4 * POINTS[-1] - 11))
    rows = tuple(
        (
            name,
            str(places),
            str(positions(places)),
            next((str(core) for core in CORE if positions(places) <= core), "none"),
        )
        for name, places in wanted
    )
    head = ("table", "places", "positions, about", "smallest core")
    notes = (
        "Program 3 as listed with longer arrays; the length of its object code is an estimate "
        "(docs/reference/machine.md).",
    )
    return Table("storage", "Positions of core for so many places", head, rows, notes)


def _along(plan: Plan, name: Value) -> list[tuple[int, float]]:
    """The cells of a kind of set: number, and N for a chart."""
    return [(k, float(cell.key["n"])) for k, cell in cells(plan, sets=name)]


def _chart(plan: Plan, peaks: dict[int, _Peak]) -> Lines:
    series = []
    for name in values(plan, "sets"):
        points = [(n, peaks[k]) for k, n in _along(plan, name) if k in peaks]
        # From the mean up to the greatest: a table must hold the greatest.
        series.append(Series(str(name), tuple((n, Interval(p.mean.value, p.mean.value, p.most)) for n, p in points)))
    return Lines(
        "places",
        "Places in use at once in the table of planes",
        "points N",
        "places",
        tuple(series),
        marks=(Mark(PLACES, "98 places, as listed"),),
        note=f"{plan.cells[0].samples} sets at each point; marks: means, bars: up to the most seen",
    )


def _full(plan: Plan, found: Summary) -> Lines:
    series = tuple(
        Series(str(name), tuple((n, found.share(k, LISTED, (TABLE,))) for k, n in _along(plan, name)))
        for name in values(plan, "sets")
    )
    return Lines(
        "full",
        "Sets for which the table of planes as listed is too short",
        "points N",
        "table full, of all sets",
        series,
        percent=True,
        note=f"{plan.cells[0].samples} sets at each point; bars: exact 95 % intervals",
    )


def _words(plan: Plan, found: Summary, peaks: dict[int, _Peak]) -> tuple[str, ...]:
    tried = [(int(cell.key["n"]), peaks[k].most) for k, cell in enumerate(plan.cells) if k in peaks]
    bears = max((n for n, _ in tried if all(most <= PLACES for m, most in tried if m <= n)), default=0)
    most = max((peak.most for peak in peaks.values()), default=0)
    words = [
        f"Most places seen in use at once: {most}; the table as listed holds {PLACES}. Largest N tried at which, as at "
        f"every smaller one, no set needed more than {PLACES}: {bears or 'none'}."
    ]
    if bears:
        number = sum(found.of(k, LISTED) for k, cell in enumerate(plan.cells) if cell.key["n"] == bears)
        words.append(
            f"Sets tried at that N: {number}. With none above {PLACES}, up to {100 * exact(0, number).high:.2f} % of "
            "such sets could need more (95 %, exact)."
        )
    return tuple(words)
