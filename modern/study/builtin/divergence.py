"""Where eight digits first decide otherwise than exact numbers, statement by statement.

Each set goes through the programs as listed; then every program runs again over exact numbers in step with that run,
on the same cards, up to the first IF, computed GO TO or end of a DO that goes two ways
(emulator/machine/divergence.py).
Between two programs the planes on the cards, cut to eight digits, may already miss the points they go through.
``samples`` counts the sets of each family.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from modern.study.outcomes import DETERMINED
from modern.study.plan import Cell, Plan, Programs
from modern.study.report import INTERVALS, Bars, Report, Series, Table, listed, percent, share_of
from modern.study.statistics import exact
from modern.study.store import Store

TITLE = "the statement that first decides otherwise than exact numbers"
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
    """The plan for ``samples`` sets of each family."""
    route = Programs(ROUTE, measures=("divergence",), limit=200_000)
    cells = tuple(
        Cell({"sets": name}, family, parameters, (route,), samples, chunk=20) for name, family, parameters in FAMILIES
    )
    return Plan(
        "divergence",
        TITLE[0].upper() + TITLE[1:],
        "Which statement of the programs is the first that eight digits mislead, and does it matter?",
        cells,
        seed,
        (
            "Exact numbers run on the cards each program reads, so program 2 or 3 starts from the same cards of eight "
            "digits in both arithmetics. Where a plane on them misses its own points, that is counted as such.",
            f"Sets have {POINTS} points but for the thesis's kind, which has its own numbers of points.",
        ),
    )


@dataclass(frozen=True, slots=True)
class _Place:
    """A statement that was first to decide otherwise, by cell, with how its sets ended."""

    counts: Counter[tuple[int, str]]
    found: Counter[tuple[int, str]]
    undecided: int

    def total(self, place: str) -> int:
        return sum(n for (_, name), n in self.counts.items() if name == place)

    def ended_well(self, place: str) -> int:
        return sum(n for (_, name), n in self.found.items() if name == place)

    def of(self, cell: int) -> int:
        return sum(n for (number, _), n in self.counts.items() if number == cell)

    @property
    def places(self) -> tuple[str, ...]:
        """Statements, the most frequent first; of equals by name."""
        names = {name for _, name in self.counts if name != NOWHERE}
        return tuple(sorted(names, key=lambda name: (-self.total(name), name)))


def _places(store: Store) -> _Place:
    counts: Counter[tuple[int, str]] = Counter()
    found: Counter[tuple[int, str]] = Counter()
    undecided = 0
    asked = store.query(
        "SELECT cell, outcome, json_extract(figures, '$.diverges'), json_extract(figures, '$.undecided'), COUNT(*) "
        "FROM runs GROUP BY 1, 2, 3, 4 ORDER BY 1, 2, 3, 4"
    )
    for cell, outcome, place, why, n in asked:
        key = (cell, place or NOWHERE)
        counts[key] += n
        undecided += n if why else 0
        if outcome in DETERMINED:
            found[key] += n
    return _Place(counts, found, undecided)


def report(plan: Plan, store: Store) -> Report:
    """Tables, chart and words."""
    seen = _places(store)
    return Report((_main(seen), _by_family(plan, seen)), (_chart(plan, seen),), _words(plan, seen))


def _main(seen: _Place) -> Table:
    everything = sum(seen.counts.values())
    rows = tuple(
        (
            name,
            str(seen.total(name)),
            percent(exact(seen.total(name), everything)),
            str(seen.ended_well(name)),
            percent(exact(seen.ended_well(name), seen.total(name))),
        )
        for name in (*seen.places, NOWHERE)
        if seen.total(name)
    )
    head = ("first other decision", "sets", "of all sets", "hull found all the same", "of these sets")
    notes = (
        *INTERVALS,
        "Statements by number: 196+2 is the second after statement 196. Cards: a plane on the cards program 1 "
        "punched, of eight digits, misses its own points. Families count alike.",
    )
    return Table("table", "The statement that first decides otherwise", head, rows, notes)


def _by_family(plan: Plan, seen: _Place) -> Table:
    names = (*seen.places, NOWHERE)
    rows = tuple(
        (str(cell.key["sets"]), str(seen.of(number)), *(str(seen.counts[number, name]) for name in names))
        for number, cell in enumerate(plan.cells)
    )
    return Table("families", "The same by family", ("sets", "number", *names), rows)


def _chart(plan: Plan, seen: _Place) -> Bars:
    shown = (NOWHERE, *seen.places[: _BARS - 1])
    series = tuple(
        Series(
            name,
            tuple(
                (str(cell.key["sets"]), exact(seen.counts[number, name], seen.of(number)))
                for number, cell in enumerate(plan.cells)
            ),
        )
        for name in shown
    )
    rest = len(seen.places) - (len(shown) - 1)
    more = f"; {rest} rarer statement{'s' * (rest > 1)} not shown" if rest > 0 else ""
    return Bars(
        "first",
        "Where eight digits first decide otherwise than exact numbers",
        "",
        "share of the family's sets",
        series,
        percent=True,
        note=f"{seen.of(0)} sets of each family{more}; bars: exact 95 % intervals",
    )


def _words(plan: Plan, seen: _Place) -> tuple[str, ...]:
    everything, same = sum(seen.counts.values()), seen.total(NOWHERE)
    never = [str(cell.key["sets"]) for k, cell in enumerate(plan.cells) if seen.counts[k, NOWHERE] == seen.of(k)]
    saved = sum(seen.ended_well(name) for name in seen.places)
    lost = same - seen.ended_well(NOWHERE)
    return (
        f"Sets that go through every decision as exact numbers would: {share_of(same, everything)}. Families of which "
        f"every set does: {listed(never)}.",
        f"Of the other sets, those that still end in the right hull: {share_of(saved, everything - same)}. Of the sets "
        "that follow exact numbers throughout, those that fail, by the programs' own faults: "
        f"{share_of(lost, same)}.",
        f"Runs that exact numbers could not follow to a decision that differs: {seen.undecided}.",
    )
