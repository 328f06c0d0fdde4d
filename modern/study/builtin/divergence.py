"""Study the first branch on which eight-digit and exact arithmetic disagree.

Each set goes through the programs as listed.  Then every program runs again in exact arithmetic on the same cards, in
step with the first run, up to the first IF, computed GO TO or end of a DO at which the two runs diverge
(emulator/machine/divergence.py).  On the cards between two programs, equations are truncated to eight digits, so the
points that define a plane may no longer satisfy its equation.  ``samples`` is the number of point sets of each family.
"""

from collections import Counter
from dataclasses import dataclass

from modern.study.outcomes import DETERMINED
from modern.study.plan import Cell, Plan, Programs
from modern.study.report import INTERVALS, Bars, Report, Series, Table, listed, row, share_of
from modern.study.statistics import exact
from modern.study.store import Store

TITLE = "the first statement at which eight-digit and exact arithmetic disagree"
SAMPLES = 600
POINTS = 10
ROUTE = "as listed"
FAMILIES: tuple[tuple[str, str, dict[str, int]], ...] = (
    ("thesis's kind", "thesis", {}),
    *((f"whole, {d} digit{'s' * (d > 1)}", "integers", {"digits": d, "n": POINTS}) for d in (1, 2, 3, 4, 6, 8)),
    *((f"decimals, {d} digits", "decimals", {"digits": d, "n": POINTS}) for d in (2, 3, 8)),
    *((f"nearly flat, gap 1E-{g}", "near-coplanar", {"digits": 2, "n": POINTS, "gap": g}) for g in (1, 3, 5)),
)
NOWHERE = "nowhere"
_BARS = 6


def plan(samples: int = SAMPLES, seed: int = 1963) -> Plan:
    route = Programs(ROUTE, measures=("divergence",), limit=200_000)
    cells = tuple(
        Cell({"sets": name}, family, parameters, (route,), samples, chunk=20) for name, family, parameters in FAMILIES
    )
    return Plan(
        "divergence",
        TITLE[0].upper() + TITLE[1:],
        "At which statement of the programs does eight-digit arithmetic first decide differently from exact "
        "arithmetic, and does it matter?",
        cells,
        seed,
        (
            "Both arithmetics read the same cards, so program 2 or 3 starts from the same eight-digit numbers in both. "
            "If a plane on the cards misses its own points, that is counted separately.",
            f"Sets have {POINTS} points, except those of the thesis's kind, whose numbers of points vary.",
        ),
    )


@dataclass(frozen=True, slots=True)
class _Divergences:
    """Counts of sets by cell and by the first statement at which the two runs decide differently.

    right: counts of the same kind, but only of sets whose hull is right.  undecided: the number of sets that exact
    arithmetic cannot follow.
    """

    counts: Counter[tuple[int, str]]
    right: Counter[tuple[int, str]]
    undecided: int

    def total(self, place: str) -> int:
        return sum(n for (_, name), n in self.counts.items() if name == place)

    def with_hull(self, place: str) -> int:
        return sum(n for (_, name), n in self.right.items() if name == place)

    def of(self, cell: int) -> int:
        return sum(n for (number, _), n in self.counts.items() if number == cell)

    @property
    def places(self) -> tuple[str, ...]:
        """Return the statements at which the runs first disagree, the most frequent first, then by name."""
        names = {name for _, name in self.counts if name != NOWHERE}
        return tuple(sorted(names, key=lambda name: (-self.total(name), name)))


def _divergences(store: Store) -> _Divergences:
    counts: Counter[tuple[int, str]] = Counter()
    right: Counter[tuple[int, str]] = Counter()
    undecided = 0
    counted = store.query(
        "SELECT cell, outcome, json_extract(figures, '$.diverges'), json_extract(figures, '$.undecided'), COUNT(*) "
        "FROM runs GROUP BY 1, 2, 3, 4 ORDER BY 1, 2, 3, 4"
    )
    for cell, outcome, place, why_undecided, n in counted:
        key = (cell, place or NOWHERE)
        counts[key] += n
        undecided += n if why_undecided else 0
        if outcome in DETERMINED:
            right[key] += n
    return _Divergences(counts, right, undecided)


def report(plan: Plan, store: Store) -> Report:
    counts = _divergences(store)
    return Report((_main(counts), _by_family(plan, counts)), (_chart(plan, counts),), _conclusions(plan, counts))


def _main(counts: _Divergences) -> Table:
    everything = sum(counts.counts.values())
    rows = []
    for name in (*counts.places, NOWHERE):
        sets, right = counts.total(name), counts.with_hull(name)
        if sets:
            rows.append(row(name, sets, exact(sets, everything), right, exact(right, sets)))
    head = ("first other decision", "sets", "of all sets", "hull found all the same", "of these sets")
    notes = (
        *INTERVALS,
        "Statements are named by number: 196+2 is the second after statement 196. The row *cards to program3* "
        "counts the sets for which program 1 punched a plane that, with its eight digits, no longer contains its own "
        "points. All families have the same number of sets.",
    )
    return Table("table", "The first statement that decides differently", head, tuple(rows), notes)


def _by_family(plan: Plan, counts: _Divergences) -> Table:
    names = (*counts.places, NOWHERE)
    rows = tuple(
        row(cell.key["sets"], counts.of(number), *(counts.counts[number, name] for name in names))
        for number, cell in enumerate(plan.cells)
    )
    return Table(
        "families", "The first statement that decides differently, by family", ("sets", "number", *names), rows
    )


def _chart(plan: Plan, counts: _Divergences) -> Bars:
    shown = (NOWHERE, *counts.places[: _BARS - 1])
    series = tuple(
        Series(
            name,
            tuple(
                (str(cell.key["sets"]), exact(counts.counts[number, name], counts.of(number)))
                for number, cell in enumerate(plan.cells)
            ),
        )
        for name in shown
    )
    rest = len(counts.places) - (len(shown) - 1)
    more = f"; {rest} rarer statement{'s' * (rest > 1)} omitted" if rest > 0 else ""
    return Bars(
        "first",
        "The first statement at which eight-digit and exact arithmetic disagree",
        "",
        "share of the family's sets",
        series,
        percent=True,
        note=f"{counts.of(0)} sets of each family{more}; bars: exact 95 % intervals",
    )


def _conclusions(plan: Plan, counts: _Divergences) -> tuple[str, ...]:
    everything, same = sum(counts.counts.values()), counts.total(NOWHERE)
    never = [str(cell.key["sets"]) for k, cell in enumerate(plan.cells) if counts.counts[k, NOWHERE] == counts.of(k)]
    saved = sum(counts.with_hull(name) for name in counts.places)
    lost = same - counts.with_hull(NOWHERE)
    return (
        f"In {share_of(same, everything)}, of the sets, eight-digit arithmetic made every decision as exact arithmetic "
        f"does. All decisions agreed for all sets of these families: {listed(never)}.",
        f"Of the sets with a different decision, {share_of(saved, everything - same)}, still give the right hull. Of "
        f"the sets in which all decisions agree, {share_of(lost, same)}, fail because of faults of the programs.",
        f"In {counts.undecided} runs, exact arithmetic had to stop before any decision differed.",
    )
