"""Chapter 7's e: which e makes sets acceptable, which makes hulls wrong, and whether one e does for all.

The thesis (p. 117-118) would count a value from -e to +e as zero, and fears that a point is then taken to be on a
plane when it is not, so that a vertex is not recognized.  The programs with the layers ``epsilon`` and ``corrected``
take e as it is; the port takes it so too, and scaled to each equation.  ``samples`` counts the sets of a cell.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from modern.study.charts import Lines, Series
from modern.study.filing import DETERMINED, WRONG
from modern.study.plan import Cell, Plan, Port, Programs, Route
from modern.study.report import INTERVALS, Report
from modern.study.statistics import Interval, wilson
from modern.study.store import Store
from modern.study.summary import Summary, summary
from modern.study.tables import Table, percent
from modern.study.words import count, powers, series

TITLE = "chapter 7's e: acceptance, wrong hulls, vertices swallowed, by size of e"
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
SWALLOWED = ("vertex missed", "dimension wrong")
"""What a swallowed vertex is filed as: a hull without one of its vertices, or a body taken for flat or for a line."""

Name = Callable[[int], str]
_MARKS = ", ".join("?" * len(DETERMINED))


def taken(power: int) -> str:
    """The route through the programs with e = 10**power."""
    return f"e = 10^{power}"


def ported(power: int) -> str:
    """The same e in the port."""
    return f"port, e = 10^{power}"


def scaled(power: int) -> str:
    """The port with e = 10**power times the equation's largest coefficient A, B or C."""
    return f"scaled e = 10^{power}"


def plan(samples: int = SAMPLES, seed: int = 1963) -> Plan:
    """The plan for ``samples`` sets of each kind."""
    routes: tuple[Route, ...] = (
        _programs(WITHOUT, "0"),
        *(_programs(taken(k), f"1E{k}") for k in ABSOLUTE),
        *(Port(ported(k), "truncating", epsilon=f"1E{k}") for k in ABSOLUTE),
        *(Port(scaled(k), "truncating", epsilon=f"rel:1E{k}") for k in SCALED),
    )
    return Plan(
        "epsilon",
        TITLE[0].upper() + TITLE[1:],
        "Chapter 7 would count values from -e to +e as zero, with e small enough. Which e makes sets acceptable, which "
        "makes hulls wrong, does any do for all sets, and where does a true vertex begin to be swallowed?",
        tuple(
            Cell({"sets": name}, family, {**parameters, "n": POINTS}, routes, samples, chunk=5)
            for name, (family, parameters) in SETS.items()
        ),
        seed,
        (
            "A value of an equation grows with the cube of the coordinates: of whole numbers of 4 digits it reaches "
            "10^13, and of eight digits that are kept the error is some 10^5. So e goes from 10^-3 to 10^9.",
            "A scaled e is a distance: a point within e (times at most the square root of 3) of a plane counts as on "
            "it. It goes from 10^-7 to 10^1, where coordinates are of 1 to 4 digits.",
            "Sets called by a gap are points of a plane, whole numbers of 2 digits, some lifted or lowered by the gap: "
            "of them a true vertex stands nearest to a plane it is not on.",
            f"All sets have {POINTS} points and go through every e.",
        ),
    )


def _programs(name: str, epsilon: str) -> Programs:
    return Programs(name, layers=_LAYERS, core=60_000, limit=200_000, epsilon=epsilon)


@dataclass(frozen=True, slots=True)
class _Rows:
    """The rows counted: outcomes, and swallowed vertices by cell and route."""

    found: Summary
    swallowed: Mapping[tuple[int, str], int]

    def swallows(self, cell: int, route: str) -> Interval:
        """The share of sets of which a vertex was swallowed."""
        return wilson(self.swallowed.get((cell, route), 0), self.found.of(cell, route))

    def clean(self, cell: int, name: Name, tried: tuple[int, ...]) -> list[int]:
        """The powers at which no set failed."""
        return [k for k in tried if not self.found.failed(cell, name(k))]

    def begins(self, cell: int, name: Name, tried: tuple[int, ...]) -> int | None:
        """The least power from which on every greater one swallowed a vertex of some set; None where not even the last.

        A vertex missed at a small e, before others at which none is, is the arithmetic's fault and not e's.
        """
        least = None
        for k in reversed(tried):
            if not self.swallowed.get((cell, name(k)), 0):
                break
            least = k
        return least


def report(plan: Plan, store: Store) -> Report:
    """Tables, charts and words."""
    swallowed: dict[tuple[int, str], int] = {}
    for (cell, route, _, detail), n in store.counts("cell", "route", "outcome", "detail").items():
        if detail in SWALLOWED:
            swallowed[cell, route] = swallowed.get((cell, route), 0) + n
    rows = _Rows(summary(store), swallowed)
    return Report(
        (
            _main(plan, rows),
            _each(plan, rows, "absolute", "The programs with e as it is", (WITHOUT, *map(taken, ABSOLUTE))),
            _each(plan, rows, "scaled", "The port with e scaled to the equation", tuple(map(scaled, SCALED))),
        ),
        (
            _chart(plan, rows, "found", "Sets whose hull is found, with e as it is", taken, ABSOLUTE),
            _chart(plan, rows, "scaled", "Sets whose hull is found, with e scaled to the equation", scaled, SCALED),
            _chart(plan, rows, "swallowed", "Sets of which e swallows a vertex", taken, ABSOLUTE, swallows=True),
        ),
        tuple(_words(plan, rows, store)),
    )


def _main(plan: Plan, rows: _Rows) -> Table:
    lines = []
    for number, cell in enumerate(plan.cells):
        texts = [str(cell.key["sets"]), str(cell.samples), percent(rows.found.share(number, WITHOUT))]
        for name, tried in ((taken, ABSOLUTE), (scaled, SCALED)):
            begins = rows.begins(number, name, tried)
            texts += [powers(rows.clean(number, name, tried)), "-" if begins is None else f"10^{begins}"]
        lines.append(tuple(texts))
    head = (
        "sets",
        "of each",
        "hull found, e = 0",
        "no failure at e",
        "swallows from e",
        "no failure at scaled e",
        "swallows from scaled e",
    )
    notes = (
        *INTERVALS,
        "Swallows from: the least e from which on every greater one tried lost a true vertex of some set, or took a "
        "body for flat.",
    )
    return Table("table", "Which e does", head, tuple(lines), notes)


def _each(plan: Plan, rows: _Rows, name: str, title: str, routes: tuple[str, ...]) -> Table:
    lines = tuple(
        (
            str(cell.key["sets"]),
            route,
            str(rows.found.of(number, route)),
            str(rows.found.hits(number, route)),
            str(rows.found.hits(number, route, (WRONG,))),
            str(rows.swallowed.get((number, route), 0)),
            str(rows.found.failed(number, route) - rows.found.hits(number, route, (WRONG,))),
            percent(rows.found.share(number, route)),
            percent(rows.found.share(number, route, (WRONG,))),
        )
        for number, cell in enumerate(plan.cells)
        for route in routes
    )
    head = ("sets", "e", "of each", "found", "wrong", "of them swallowed", "refused or not ended", "found", "wrong")
    return Table(name, title, head, lines, INTERVALS)


def _chart(
    plan: Plan, rows: _Rows, file: str, title: str, name: Name, tried: tuple[int, ...], swallows: bool = False
) -> Lines:
    shares = rows.swallows if swallows else rows.found.share
    return Lines(
        file,
        title,
        "k, where e = 10^k",
        "vertex swallowed, of all sets" if swallows else "hull found, of all sets",
        tuple(
            Series(str(cell.key["sets"]), tuple((float(k), shares(number, name(k))) for k in tried))
            for number, cell in enumerate(plan.cells)
            if cell.key["sets"] in _CHARTED
        ),
        percent=True,
        note=f"{plan.cells[0].samples} sets of {POINTS} points of each kind; bars: 95 % intervals (Wilson)",
    )


def _words(plan: Plan, rows: _Rows, store: Store) -> list[str]:
    refused = [
        f"{cell.key['sets']} {percent(rows.found.share(number, WITHOUT))}"
        for number, cell in enumerate(plan.cells)
        if rows.found.failed(number, WITHOUT)
    ]
    first = (
        f"Without e the corrected programs find fewer than all hulls of these sets: {'; '.join(refused)}. "
        if refused
        else "Without e the corrected programs find the hull of every set. "
    )
    first += f"{_for_all(plan, rows, taken, ABSOLUTE, 'as it is')} {_for_all(plan, rows, scaled, SCALED, 'scaled')}"
    return [first, _worry(plan, rows), _price(plan, rows, store)]


def _for_all(plan: Plan, rows: _Rows, name: Name, tried: tuple[int, ...], how: str) -> str:
    """Whether one e does for all sets; and if none, which does best, and for which kinds."""
    clean = [rows.clean(number, name, tried) for number in range(len(plan.cells))]
    common = [k for k in tried if all(k in one for one in clean)]
    of = sum(cell.samples for cell in plan.cells)
    if common:
        none = wilson(of, of)
        return (
            f"With e {how} no set of any kind failed at {powers(common)}; up to {100 * (1 - none.low):.2f} % of such "
            "sets could (95 %)."
        )
    hits = {k: sum(rows.found.hits(number, name(k)) for number in range(len(plan.cells))) for k in tried}
    best = max(tried, key=lambda k: hits[k])
    lost = [str(cell.key["sets"]) for number, cell in enumerate(plan.cells) if best not in clean[number]]
    never = [str(cell.key["sets"]) for number, cell in enumerate(plan.cells) if not clean[number]]
    text = (
        f"Of e {how}, no value tried does for all sets: the best, 10^{best}, finds the hulls of "
        f"{percent(wilson(hits[best], of))} of the {count(of, 'set')} and fails on some of the {series(lost)}"
    )
    return text + (f"; for the {series(never)} there is none at which no set fails." if never else ".")


def _worry(plan: Plan, rows: _Rows) -> str:
    """Where the thesis's worry begins."""
    told = []
    for number, cell in enumerate(plan.cells):
        begins = rows.begins(number, taken, ABSOLUTE)
        if begins is not None:
            share = percent(rows.swallows(number, taken(begins)))
            told.append(f"{cell.key['sets']} at 10^{begins}, with {share} of the sets")
    silent = [
        f"{cell.key['sets']} ({percent(rows.swallows(number, WITHOUT))})"
        for number, cell in enumerate(plan.cells)
        if rows.swallowed.get((number, WITHOUT), 0)
    ]
    text = (
        f"The thesis's worry, a true vertex swallowed, begins at these e, taken as it is: {'; '.join(told)}."
        if told
        else "The thesis's worry, a true vertex swallowed, begins at no e tried."
    )
    if silent:
        text += f" With e = 0 a vertex is lost too, of these shares of the sets: {series(silent)}."
    return text


def _price(plan: Plan, rows: _Rows, store: Store) -> str:
    """What acceptance costs in wrong hulls, on either side of the right e; whether port and programs agree."""
    saved = [
        series(
            cell.key["sets"]
            for number, cell in enumerate(plan.cells)
            if rows.found.failed(number, WITHOUT) and rows.clean(number, name, tried)
        )
        for name, tried in ((taken, ABSOLUTE), (scaled, SCALED))
    ]
    text = ""
    if any(rows.found.failed(number, WITHOUT) for number in range(len(plan.cells))):
        text = "Of the kinds of which sets fail without e, those of which some e saves every set are " + (
            f"{saved[0]}, as it is and scaled alike."
            if saved[0] == saved[1]
            else f"{saved[0]} as it is, {saved[1]} scaled."
        )
    small, large = _wrong_beside(plan, rows, store, below=True), _wrong_beside(plan, rows, store, below=False)
    for (wrong, of), words in ((small, "smaller"), (large, "greater")):
        if of:
            text += (
                f" With an e, taken as it is, {words} than those at which none of the kind failed, {wrong:,} of {of:,} "
                f"sets, {percent(wilson(wrong, of))}, ended in a wrong hull that looks like a right one."
            )
    same, of = next(
        store.query(
            f"SELECT SUM(a.outcome = b.outcome OR a.outcome IN ({_MARKS}) AND b.outcome IN ({_MARKS})), COUNT(*) "
            "FROM runs a JOIN runs b ON a.cell = b.cell AND a.place = b.place AND b.route = 'port, ' || a.route",
            (*DETERMINED, *DETERMINED),
        )
    )
    return f"{text} The port with the same e ends as the programs do in {same:,} of {of:,} runs.".lstrip()


def _wrong_beside(plan: Plan, rows: _Rows, store: Store, below: bool) -> tuple[int, int]:
    """How many sets of how many got a wrong hull at an e below, or above, those at which none of their kind failed."""
    wrong = of = 0
    for number, cell in enumerate(plan.cells):
        clean = rows.clean(number, taken, ABSOLUTE)
        if not clean:
            continue
        tried = [taken(k) for k in ABSOLUTE if (k < clean[0] if below else k > clean[-1])]
        if tried:
            asked = store.query(
                "SELECT COUNT(DISTINCT place) FROM runs WHERE cell = ? AND outcome = ? "
                f"AND route IN ({', '.join('?' * len(tried))})",
                (number, WRONG, *tried),
            )
            wrong, of = wrong + next(asked)[0], of + cell.samples
    return wrong, of
