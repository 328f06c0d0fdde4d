"""Count outcomes by cell and route, as most reports need them, and select cells by their keys."""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from modern.study.outcomes import DETERMINED, OUTCOMES
from modern.study.plan import Cell, Plan, Value
from modern.study.statistics import Interval, exact
from modern.study.store import Store


def values(plan: Plan, key: str) -> tuple[Value, ...]:
    """Return the values that one parameter has in the keys of a plan's cells, in the order of the cells."""
    return tuple(dict.fromkeys(cell.key[key] for cell in plan.cells if key in cell.key))


def cells(plan: Plan, **key: Value) -> tuple[tuple[int, Cell], ...]:
    """Return the cells of the plan whose keys have all the given values, each with its index in the plan."""
    return tuple(
        (number, cell)
        for number, cell in enumerate(plan.cells)
        if all(cell.key.get(name) == value for name, value in key.items())
    )


@dataclass(frozen=True, slots=True)
class Summary:
    """Counts of outcomes by cell and route.  Cells are numbered from 0 in the order of the plan."""

    counts: Mapping[tuple[int, str], Counter[str]]

    def of(self, cell: int, route: str) -> int:
        return self.counts[cell, route].total()

    def hits(self, cell: int, route: str, outcomes: Iterable[str] = DETERMINED) -> int:
        """Return the number of samples with one of the outcomes, by default the outcomes with the right hull."""
        counter = self.counts[cell, route]
        return sum(counter[outcome] for outcome in frozenset(outcomes))

    def failed(self, cell: int, route: str) -> int:
        return self.of(cell, route) - self.hits(cell, route)

    def sound_from(self, cell: int, route: Callable[[int], str], tried: Sequence[int]) -> int | None:
        """Return the least number tried such that no sample failed with this or a greater number.

        Return None if a sample failed with the greatest number.  ``tried`` has the numbers in ascending order, and
        ``route`` returns the route that uses a number.
        """
        least = None
        for number in reversed(tried):
            if self.failed(cell, route(number)):
                break
            least = number
        return least

    def share(self, cell: int, route: str, outcomes: Iterable[str] = DETERMINED) -> Interval:
        """Return the proportion of samples with one of the outcomes, and its exact interval."""
        return exact(self.hits(cell, route, outcomes), self.of(cell, route))

    def outcomes(self) -> tuple[str, ...]:
        """Return the outcomes that occur, in the order of OUTCOMES."""
        present = {outcome for counter in self.counts.values() for outcome in counter}
        return tuple(outcome for outcome in OUTCOMES if outcome in present)


def summary(store: Store) -> Summary:
    counts: dict[tuple[int, str], Counter[str]] = {}
    for (cell, route, outcome), n in store.counts("cell", "route", "outcome").items():
        counts.setdefault((cell, route), Counter())[outcome] += n
    return Summary(counts)
