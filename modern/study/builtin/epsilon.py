"""Study the tolerance e of chapter 7: which e avoids rejections, which gives wrong hulls, and whether one always works.

The thesis (p. 117-118) proposes to count a value from -e to +e as zero.  It warns that a point near a plane may then
count as a point on the plane, and a vertex is not recognized.  The programs with the layers ``epsilon`` and
``corrected`` use an absolute e.  The port uses an absolute e and an e scaled by each equation's coefficients.
``samples`` is the number of sets of a cell.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from modern.study.outcomes import DETERMINED_SQL, WRONG
from modern.study.plan import Cell, Plan, Port, Programs, Route
from modern.study.report import INTERVALS, Lines, Report, Series, Table, listed, percent, powers, row
from modern.study.statistics import Interval, exact
from modern.study.store import Store
from modern.study.summary import Summary, summary

TITLE = "chapter 7's e: accepted sets, wrong hulls and lost vertices, by size of e"
SAMPLES = 200
POINTS = 10
ABSOLUTE = tuple(range(-3, 10))
SCALED = tuple(range(-7, 2))
WITHOUT = "e = 0"
_LAYERS = ("epsilon", "corrected")
SETS: Mapping[str, tuple[str, Mapping[str, int]]] = {
    "integers of 1 digit": ("integers", {"digits": 1}),
    "integers of 2 digits": ("integers", {"digits": 2}),
    "integers of 3 digits": ("integers", {"digits": 3}),
    "integers of 4 digits": ("integers", {"digits": 4}),
    "sphere of 2 digits": ("sphere", {"digits": 2}),
    "sphere of 3 digits": ("sphere", {"digits": 3}),
    "gap of .1": ("near-coplanar", {"digits": 2, "gap": 1}),
    "gap of .01": ("near-coplanar", {"digits": 2, "gap": 2}),
    "gap of .001": ("near-coplanar", {"digits": 2, "gap": 3}),
}
_CHARTED = ("integers of 1 digit", "integers of 2 digits", "integers of 3 digits", "integers of 4 digits", "gap of .01")
# The details of outcomes in which e swallowed a vertex: the hull lacks a vertex, or a solid counts as flat or a line.
SWALLOWED = ("vertex missed", "dimension wrong")

Name = Callable[[int], str]


def taken(power: int) -> str:
    """Return the name of the route of a study that runs the programs with e = 10**power."""
    return f"e = 10^{power}"


def ported(power: int) -> str:
    """Return the name of the route of a study that runs the port with an absolute e of 10**power."""
    return f"port, e = 10^{power}"


def scaled(power: int) -> str:
    """Return the name of the route through the port with an e of 10**power, scaled to each equation.

    The scaled e is multiplied by the largest coefficient A, B or C of the equation.
    """
    return f"scaled e = 10^{power}"


_WAYS: tuple[tuple[str, Name, tuple[int, ...]], ...] = (("as it is", taken, ABSOLUTE), ("scaled", scaled, SCALED))


def plan(samples: int = SAMPLES, seed: int = 1963) -> Plan:
    routes: tuple[Route, ...] = (
        _programs(WITHOUT, "0"),
        *(_programs(taken(k), f"1E{k}") for k in ABSOLUTE),
        *(Port(ported(k), "truncating", epsilon=f"1E{k}") for k in ABSOLUTE),
        *(Port(scaled(k), "truncating", epsilon=f"rel:1E{k}") for k in SCALED),
    )
    return Plan(
        "epsilon",
        TITLE[0].upper() + TITLE[1:],
        "Chapter 7 proposes to count values from -e to +e as zero, with e small enough. Which e makes sets acceptable, "
        "which makes hulls wrong, does one work for all sets, and from which e on is a true vertex lost (swallowed)?",
        tuple(
            Cell({"sets": name}, family, {**parameters, "n": POINTS}, routes, samples, chunk=5)
            for name, (family, parameters) in SETS.items()
        ),
        seed,
        (
            "A value of an equation grows with the cube of the coordinates. For integers of 4 digits it reaches 10^13, "
            "and its error in eight-digit arithmetic is about 10^5. So e ranges from 10^-3 to 10^9.",
            "A scaled e is a distance: a point within e (times at most the square root of 3) of a plane counts as on "
            "it. It ranges from 10^-7 to 10^1, for coordinates of 1 to 4 digits.",
            "Sets named after a gap are points of a plane, integers of 2 digits, some of them raised or lowered by the "
            "gap. In these sets a true vertex is nearest to a plane that it is not on.",
            f"All sets have {POINTS} points and go through every e.",
        ),
    )


def _programs(name: str, epsilon: str) -> Programs:
    return Programs(name, layers=_LAYERS, core=60_000, limit=200_000, epsilon=epsilon)


@dataclass(frozen=True, slots=True)
class _Rows:
    """Counts by cell and route: of outcomes, and of sets with a swallowed vertex (one that is lost because of e)."""

    counts: Summary
    swallowed: Mapping[tuple[int, str], int]

    def swallows(self, cell: int, route: str) -> Interval:
        """Return the share of a cell's sets for which a route loses a vertex or treats a solid as flat."""
        return exact(self.swallowed.get((cell, route), 0), self.counts.of(cell, route))

    def clean(self, cell: int, name: Name, tried: tuple[int, ...]) -> list[int]:
        """Return the exponents k such that no set of the cell failed with the tolerance e = 10**k."""
        return [k for k in tried if not self.counts.failed(cell, name(k))]

    def begins(self, cell: int, name: Name, tried: tuple[int, ...]) -> int | None:
        """Return the least exponent k from which on e is too large.

        With e = 10**k, and with every greater e tried, the hull of some set lacks a vertex because of e.  Return None
        if no vertex is missing with the greatest e.  A vertex that is missing only with a smaller e is missing because
        of the arithmetic and not because of e.
        """
        least = None
        for k in reversed(tried):
            if not self.swallowed.get((cell, name(k)), 0):
                break
            least = k
        return least


def report(plan: Plan, store: Store) -> Report:
    swallowed: dict[tuple[int, str], int] = {}
    for (cell, route, _, detail), n in store.counts("cell", "route", "outcome", "detail").items():
        if detail in SWALLOWED:
            swallowed[cell, route] = swallowed.get((cell, route), 0) + n
    rows = _Rows(summary(store), swallowed)
    return Report(
        (
            _main(plan, rows),
            _each(plan, rows, "absolute", "The programs with an absolute e", (WITHOUT, *map(taken, ABSOLUTE))),
            _each(plan, rows, "scaled", "The port with scaled e (a distance)", tuple(map(scaled, SCALED))),
            _best(plan, rows),
            _price(plan, rows, store),
        ),
        (
            _chart(plan, rows, "found", "Sets whose hull is found, with an absolute e", taken, ABSOLUTE),
            _chart(plan, rows, "scaled", "Sets whose hull is found, with e scaled to the equation", scaled, SCALED),
            _chart(plan, rows, "swallowed", "Sets with a vertex swallowed by e", taken, ABSOLUTE, swallows=True),
        ),
        _conclusions(plan, rows, store),
    )


def _main(plan: Plan, rows: _Rows) -> Table:
    lines = []
    for number, cell in enumerate(plan.cells):
        texts = [str(cell.key["sets"]), str(cell.samples), percent(rows.counts.share(number, WITHOUT))]
        for _, name, tried in _WAYS:
            begins = rows.begins(number, name, tried)
            texts += [powers(rows.clean(number, name, tried)), "-" if begins is None else f"10^{begins}"]
        lines.append(tuple(texts))
    by_way = ("no failure at e", "swallows from e", "no failure at scaled e", "swallows from scaled e")
    head = ("sets", "of each", "hull found, e = 0", *by_way)
    notes = (
        *INTERVALS,
        "The column *swallows from* has the smallest tried e such that this e and every larger one lost a true "
        "vertex of some set or counted a body as flat.",
    )
    return Table("table", "Which e works", head, tuple(lines), notes)


def _each(plan: Plan, rows: _Rows, name: str, title: str, routes: tuple[str, ...]) -> Table:
    lines = []
    for number, cell in enumerate(plan.cells):
        for route in routes:
            of, wrong = rows.counts.of(number, route), rows.counts.hits(number, route, (WRONG,))
            failed, swallowed = rows.counts.failed(number, route), rows.swallowed.get((number, route), 0)
            numbers = (of, of - failed, wrong, swallowed, failed - wrong)
            lines.append(row(cell.key["sets"], route, *numbers, exact(of - failed, of), exact(wrong, of)))
    counts = ("of each", "found", "wrong", "of them swallowed", "refused or not ended")
    return Table(name, title, ("sets", "e", *counts, "share found", "share wrong"), tuple(lines), INTERVALS)


def _chart(
    plan: Plan, rows: _Rows, file: str, title: str, name: Name, tried: tuple[int, ...], swallows: bool = False
) -> Lines:
    shares = rows.swallows if swallows else rows.counts.share
    return Lines(
        file,
        title,
        "e",
        "share of sets with a swallowed vertex" if swallows else "share of sets whose hull is found",
        tuple(
            Series(str(cell.key["sets"]), tuple((float(k), shares(number, name(k))) for k in tried))
            for number, cell in enumerate(plan.cells)
            if cell.key["sets"] in _CHARTED
        ),
        percent=True,
        powers=True,
        note=f"{plan.cells[0].samples} sets of {POINTS} points of each kind; bars: exact 95 % intervals",
    )


def _best(plan: Plan, rows: _Rows) -> Table:
    of = sum(cell.samples for cell in plan.cells)
    lines = []
    for how, name, tried in _WAYS:
        clean = [rows.clean(number, name, tried) for number in range(len(plan.cells))]
        hits = {k: sum(rows.counts.hits(number, name(k)) for number in range(len(plan.cells))) for k in tried}
        best = max(tried, key=lambda k: hits[k])
        lines.append(
            (
                how,
                powers(k for k in tried if all(k in powers_of_kind for powers_of_kind in clean)),
                f"10^{best}",
                percent(exact(hits[best], of)),
                listed(cell.key["sets"] for number, cell in enumerate(plan.cells) if best not in clean[number]),
                listed(cell.key["sets"] for number, cell in enumerate(plan.cells) if not clean[number]),
            )
        )
    head = ("e", "no failure at all at", "best e", "hulls found with it", "kinds it fails on", "kinds every e fails on")
    return Table("best", "One e for all sets", head, tuple(lines), INTERVALS)


def _price(plan: Plan, rows: _Rows, store: Store) -> Table:
    lines = []
    for comparison, below in (("smaller", True), ("greater", False)):
        wrong, of = _wrong_outside(plan, rows, store, below)
        lines.append(row(comparison, of, wrong, exact(wrong, of) if of else None))
    notes = (
        *INTERVALS,
        "An e is too small or too great if it lies below or above all values of e at which no set of the same kind "
        "failed. A set counts once, even if several such e give a wrong hull.",
    )
    head = ("e, as it is", "sets", "wrong hull", "of these sets")
    return Table(
        "price", "Plausible but wrong hulls, with an e that is too small or too great", head, tuple(lines), notes
    )


def _conclusions(plan: Plan, rows: _Rows, store: Store) -> tuple[str, ...]:
    saved = [
        listed(
            cell.key["sets"]
            for number, cell in enumerate(plan.cells)
            if rows.counts.failed(number, WITHOUT) and rows.clean(number, name, tried)
        )
        for _, name, tried in _WAYS
    ]
    lost = [cell.key["sets"] for number, cell in enumerate(plan.cells) if rows.swallowed.get((number, WITHOUT), 0)]
    same, of = _same_as_port(store)
    return (
        "Chapter 7 counts a value from -e to +e as zero. An absolute e is the same for all equations; a scaled e is "
        "multiplied by the largest coefficient A, B or C of each equation. Some sets of the following kinds fail "
        f"without e, but none fails with a suitable absolute e: {saved[0]}. Some sets of the following kinds fail "
        f"without e, but none fails with a suitable scaled e: {saved[1]}. Some sets of the following kinds lose a "
        f"vertex even if e = 0: {listed(lost)}.",
        f"In {same:,} of {of:,} runs, the port has the same outcome as the programs with the same e.",
    )


def _same_as_port(store: Store) -> tuple[int, int]:
    """Return the number of runs in which the programs and the port agree, and the number of compared runs.

    Runs with the same e are compared.  They agree if their outcomes are equal, or if both hulls are right and differ at
    most in order.
    """
    same = of = 0
    for k in ABSOLUTE:
        alike, runs = next(
            store.query(
                "SELECT SUM(a.outcome = b.outcome OR "
                f"a.outcome IN {DETERMINED_SQL} AND b.outcome IN {DETERMINED_SQL}), COUNT(*) "
                "FROM runs a JOIN runs b ON a.cell = b.cell AND a.place = b.place WHERE a.route = ? AND b.route = ?",
                (taken(k), ported(k)),
            )
        )
        same, of = same + (alike or 0), of + runs
    return same, of


def _wrong_outside(plan: Plan, rows: _Rows, store: Store, below: bool) -> tuple[int, int]:
    """Return the number of sets with a wrong hull at an e that is too small or too large, and the number of all sets.

    If ``below`` is true, only values of e that are too small are counted, otherwise only values that are too large.  An
    e is too small if it is below every e with which no set of the cell fails, and too large if it is above all of them.
    A cell counts only if there is an e with which no set of the cell fails.
    """
    wrong = of = 0
    for number, cell in enumerate(plan.cells):
        clean = rows.clean(number, taken, ABSOLUTE)
        if not clean:
            continue
        tried = [taken(k) for k in ABSOLUTE if (k < clean[0] if below else k > clean[-1])]
        if tried:
            distinct = store.query(
                "SELECT COUNT(DISTINCT place) FROM runs WHERE cell = ? AND outcome = ? "
                f"AND route IN ({', '.join('?' * len(tried))})",
                (number, WRONG, *tried),
            )
            wrong, of = wrong + next(distinct)[0], of + cell.samples
    return wrong, of
