"""Cells by their keys, and how often each outcome was, by cell and route: what most reports are computed from."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from modern.study.outcomes import DETERMINED, OUTCOMES
from modern.study.plan import Cell, Plan, Value
from modern.study.statistics import Interval, exact
from modern.study.store import Store


def values(plan: Plan, key: str) -> tuple[Value, ...]:
    """The values a part of the key has in a plan, in the order of the cells."""
    return tuple(dict.fromkeys(cell.key[key] for cell in plan.cells if key in cell.key))


def cells(plan: Plan, **key: Value) -> tuple[tuple[int, Cell], ...]:
    """The cells, with their numbers, whose keys have these values."""
    wanted = key.items()
    return tuple((k, cell) for k, cell in enumerate(plan.cells) if all(cell.key.get(a) == b for a, b in wanted))


@dataclass(frozen=True, slots=True)
class Summary:
    """Counts of outcomes; cells are numbered from 0 as in the plan."""

    counts: Mapping[tuple[int, str], Counter[str]]

    def of(self, cell: int, route: str) -> int:
        """Samples of a cell sent through a route."""
        return self.counts[cell, route].total()

    def hits(self, cell: int, route: str, outcomes: Iterable[str] = DETERMINED) -> int:
        """Samples with one of the outcomes; by default those whose hull was found."""
        wanted = frozenset(outcomes)
        return sum(n for outcome, n in self.counts[cell, route].items() if outcome in wanted)

    def failed(self, cell: int, route: str) -> int:
        """Samples whose hull was not found."""
        return self.of(cell, route) - self.hits(cell, route)

    def sound_from(self, cell: int, route: Callable[[int], str], tried: Sequence[int]) -> int | None:
        """The least of the numbers tried, which rise, from which on no set failed; None where the greatest fails.

        ``route`` names the route of a number.
        """
        best = None
        for number in reversed(tried):
            if self.failed(cell, route(number)):
                break
            best = number
        return best

    def share(self, cell: int, route: str, outcomes: Iterable[str] = DETERMINED) -> Interval:
        """The proportion of samples under one of the outcomes, with its exact interval."""
        return exact(self.hits(cell, route, outcomes), self.of(cell, route))

    def seen(self) -> tuple[str, ...]:
        """The outcomes that occur, in the order of OUTCOMES."""
        present = {outcome for counter in self.counts.values() for outcome in counter}
        return tuple(outcome for outcome in OUTCOMES if outcome in present)


def summary(store: Store) -> Summary:
    """Count a study's outcomes."""
    counts: dict[tuple[int, str], Counter[str]] = {}
    for (cell, route, outcome), n in store.counts("cell", "route", "outcome").items():
        counts.setdefault((cell, route), Counter())[outcome] += n
    return Summary(counts)
