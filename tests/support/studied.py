"""A small study for tests that run it, some of them in other processes."""

from __future__ import annotations

from modern.study import Cell, Plan, Port, Programs

ROUTES = (Programs("listed", limit=20_000), Port("exact"))
PLAN = Plan(
    "small",
    "A small study",
    "Does it repeat?",
    (
        Cell({"n": 5}, "integers", {"digits": 1, "n": 5}, ROUTES, 24, chunk=5),
        Cell({"n": 9}, "thesis", {"kinds": {"slab": 1}, "n": 9}, ROUTES, 20, chunk=4),
    ),
    seed=5,
)
