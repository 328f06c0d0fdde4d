"""A plan looked through before it is begun: what is wrong is said at once, in one line."""

from __future__ import annotations

from collections.abc import Iterable

from emulator.language.cards import deck_from_lines
from emulator.machine.machine import Machine
from modern.edition import programs
from modern.formats.deck import coordinate_field
from modern.port import convex_hull
from modern.study.families import draw_sample
from modern.study.measures import measure_of
from modern.study.plan import Cell, Plan, PlanError, Programs, Route
from modern.study.routes import options_of, programs_of

MOST_FILES = 1_000_000
"""Files of rows a study may have: their names are held in memory while it runs."""


def check_plan(plan: Plan) -> None:
    """Raises PlanError (or FamilyError) for a plan that cannot be carried out."""
    if not plan.name or not plan.name.replace("-", "").replace("_", "").isalnum():
        raise PlanError(f"a study's name is letters, digits, - and _; {plan.name!r} is not")
    if not plan.cells:
        raise PlanError(f"{plan.name}: the plan has no cells")
    _differ((cell.name for cell in plan.cells), f"{plan.name}: two cells have the key")
    files = 0
    for cell in plan.cells:
        _check_cell(cell, plan.seed)
        files += -(-cell.samples // cell.chunk)
    if files > MOST_FILES:
        raise PlanError(
            f"{plan.name}: {plan.samples:,} samples are {files:,} files of rows; a study has at most {MOST_FILES:,}"
        )


def _check_cell(cell: Cell, seed: int) -> None:
    where = f"cell {cell.name}".rstrip()
    if cell.samples < 1 or cell.chunk < 1:
        raise PlanError(f"{where}: samples and chunk are 1 or more")
    if not cell.routes:
        raise PlanError(f"{where}: no routes")
    _differ((route.name for route in cell.routes), f"{where}: two routes have the name")
    if cell.reference and cell.reference not in {route.name for route in cell.routes}:
        raise PlanError(f"{where}: no route is called {cell.reference!r}, the reference")
    for route in cell.routes:
        _check_route(route)
    draw_sample(cell, seed, 0)


def _check_route(route: Route) -> None:
    if not route.name:
        raise PlanError("a route has no name")
    for name in route.measures:
        measure_of(name)
    if not isinstance(route, Programs):
        try:
            convex_hull([(0, 0, 0)], route.arithmetic, route.epsilon or None)
        except ValueError as error:
            raise PlanError(f"route {route.name}: {error}") from None
        return
    if route.state not in ("listing", "examples") or route.bounds not in ("strict", "core") or route.limit < 1:
        raise PlanError(f"route {route.name}: state is listing or examples, bounds strict or core, limit 1 or more")
    if bool(route.epsilon) != ("epsilon" in route.layers):
        raise PlanError(f"route {route.name}: an epsilon needs the layer 'epsilon', and that layer an epsilon")
    try:
        coordinate_field(route.epsilon or "0")
    except ValueError as error:
        raise PlanError(f"route {route.name}: epsilon: {error}") from None
    options = options_of(route)
    first, load = programs_of(route)
    for name in (first, *(text for text in programs.TEXTS if text != "program1")):
        Machine(load(name), deck_from_lines(route.name, ["1"]), options)


def _differ(names: Iterable[str], words: str) -> None:
    seen: set[str] = set()
    for name in names:
        if name in seen:
            raise PlanError(f"{words} {name!r}")
        seen.add(name)
