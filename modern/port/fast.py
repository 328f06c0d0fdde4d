"""The steps compiled by numba (extra ``fast``), and when they are taken instead of numpy's."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from emulator.jit.functions import Compiled, Function, NotInstalled
from modern.port import growth, kernels, workspace
from modern.port.arithmetic import Arithmetic
from modern.port.binary import FloatArithmetic
from modern.port.growth import LAST_PAIR, TABLE_OF_PLANES, THROUGH_CENTRE
from modern.port.polyhedron import LISTED_PLANES, PLANES, Polyhedron
from modern.port.table import Equations, Places, Slack
from modern.port.workspace import Cloud, Rules, Slots

_CORRECTIONS = {THROUGH_CENTRE: workspace.THROUGH, TABLE_OF_PLANES: workspace.TABLE, LAST_PAIR: workspace.PAIR}

_FIRST = 4
"""Vertices of H_1."""
_SPARE = 1024
"""Slots to begin with, besides six for each equation: a stage needs at most four and a half, of those that stand."""
_POINTS_A_SLOT = 8
"""And one for so many points: most hulls are then grown without asking for more, which copies the points."""

_MANY = 5_000
"""Points from which on loading the kernels costs less than it saves."""


@dataclass(frozen=True, slots=True)
class Steps:
    """A stage of a polyhedron's growth, and the places that satisfy each equation."""

    stage: Callable[[Polyhedron, bool], growth.Grown | None]
    satisfied: Callable[[Equations, Places], list[NDArray[np.int64]]]


def plain_satisfied(table: Equations, places: Places) -> list[NDArray[np.int64]]:
    return table.satisfied(places.coordinates)


PLAIN = Steps(growth.stage, plain_satisfied)


def choose(arithmetic: Arithmetic, places: Places, slack: Slack | None, fast: bool | None) -> Steps:
    """The steps for these points.

    ``fast``: False numpy's; True the kernels; None the kernels where numba is there and it pays: many points, or
    kernels that are loaded already.  Raises NotInstalled where it is True and numba is missing.
    """
    if fast is False or not isinstance(arithmetic, FloatArithmetic) or not _in_range(arithmetic, places, slack):
        return PLAIN
    if fast is None and len(places) < _MANY and not load.cache_info().currsize:
        return PLAIN
    try:
        return load(arithmetic.name)
    except NotInstalled:
        if fast:
            raise
        return PLAIN


def _in_range(arithmetic: FloatArithmetic, places: Places, slack: Slack | None) -> bool:
    """Whether no number of the procedure can overflow, which numpy notices and compiled code does not.

    The largest are squares of a plane's coefficients, at most 36 M**4 for coordinates up to M, values at a point, at
    most 24 M**3, and e, for all the equations, times a coefficient.
    """
    limit = float(np.finfo(arithmetic.dtype).max)
    largest = max(1.0, float(abs(places.coordinates).max()))
    e = max(1.0, float(arithmetic.tolerance(slack.size, 0))) if slack else 1.0
    return largest < limit**0.25 / 8 and e < limit / (8 * largest**2)


@cache
def load(name: str) -> Steps:
    """The steps by kernels compiled for ``float64`` or ``float32``.  Raises NotInstalled."""
    some, one = np.zeros((4, 1), name), np.zeros(1, np.int64)
    cloud = Cloud(some[:3].copy(), one, one, one)
    slots = Slots(some, np.zeros((3, 1), np.int64), some[0].copy(), np.ones(1, np.bool_))
    rules = Rules(some[:3, 0].copy(), False, some[0, 0], False, LISTED_PLANES, PLANES)
    # No array is made: numba need not count the users of each it is given.
    return with_kernels(
        Compiled(kernels.grow, _nrt=False).ready(cloud, slots, workspace.room_for(1, name), one, rules, False, 1),
        Compiled(kernels.satisfied, _nrt=False).ready(slots, cloud.coordinates, one, one),
    )


def with_kernels(grow: Function, find: Function) -> Steps:
    """The steps by the kernels given, compiled or as they stand in Python."""

    def stage(hull: Polyhedron, first: bool) -> growth.Grown | None:
        """One stage if somebody watches, else as many as come."""
        cloud, slots, state = _cloud(hull), _slots(hull.table, _spare(hull)), _state(hull)
        room = workspace.room_for(len(slots.alive), slots.coefficients.dtype)
        code = grow(cloud, slots, room, state, _rules(hull), first, 1 if hull.watch else -1)
        _take_back(hull, cloud, slots, state)
        if not state[workspace.STAGES]:
            return None if code == kernels.ENDED else growth.stage(hull, first)
        struck = cloud.gone[: state[workspace.GONE]].tolist()
        if first:
            return growth.Grown(hull.places.names(slice(0, _FIRST)), 0, 0, struck)
        return growth.Grown((int(state[workspace.ADDED]),), hull.to_check + 1, int(state[workspace.OUTSIDE]), struck)

    def satisfied(table: Equations, places: Places) -> list[NDArray[np.int64]]:
        slots, coordinates = _slots(table, 0), np.array(places.coordinates, order="C")
        counts, found = np.empty(len(table), np.int64), np.empty(4 * len(table), np.int64)
        if (count := find(slots, coordinates, counts, found)) > len(found):
            found = np.empty(count, np.int64)
            find(slots, coordinates, counts, found)
        ends = np.cumsum(counts).tolist()
        return [found[start:end] for start, end in zip([0, *ends], ends, strict=False)]

    return Steps(stage, satisfied)


def _spare(hull: Polyhedron) -> int:
    return 6 * len(hull.table) + _SPARE + len(hull.places) // _POINTS_A_SLOT


def _cloud(hull: Polyhedron) -> Cloud:
    """The points; each keeps the slot of its equation, -1 where that was struck."""
    places, serial = hull.places, hull.table.serial
    kept_by = hull.remaining.keeper
    slot = np.searchsorted(serial, kept_by)
    slot[slot == len(serial)] = 0
    keeper = np.full(len(places), -1, np.int64)
    keeper[hull.vertices :] = np.where(serial[slot] == kept_by, slot, -1)
    # Copies in C order: for each other layout numba would compile the kernels again.
    return Cloud(np.array(places.coordinates, order="C"), places.who.copy(), keeper, np.empty(len(places), np.int64))


def _slots(table: Equations, spare: int) -> Slots:
    """The table in the first slots, and so many empty ones."""
    count = len(table)
    coefficients = np.zeros((4, count + spare), table.coefficients.dtype)
    defining = np.zeros((3, count + spare), np.int64)
    tolerances = np.full(count + spare, -1, table.coefficients.dtype)
    coefficients[:, :count], defining[:, :count] = table.coefficients, table.defining
    if table.tolerances is not None:
        tolerances[:count] = table.tolerances
    return Slots(coefficients, defining, tolerances, np.arange(count + spare) < count)


def _state(hull: Polyhedron) -> NDArray[np.int64]:
    state = np.zeros(workspace.STATE_SIZE, np.int64)
    state[workspace.COUNT], state[workspace.VERTICES] = len(hull.places), hull.vertices
    state[workspace.CHECK] = state[workspace.CHECKED] = hull.to_check
    state[workspace.MADE] = state[workspace.ALIVE] = len(hull.table)
    state[workspace.TRIED] = np.searchsorted(hull.table.serial, hull.remaining.tried)
    state[workspace.STRUCK] = hull.remaining.struck
    state[workspace.KNOWN] = sum(bit for name, bit in _CORRECTIONS.items() if name in hull.progress.corrected)
    return state


def _rules(hull: Polyhedron) -> Rules:
    number, slack = hull.arithmetic.dtype, hull.table.slack
    centre = np.array(hull.centre or (0, 0, 0), number)
    size = number(-1) if slack is None else hull.arithmetic.tolerance(slack.size, 0)
    return Rules(centre, hull.centre is None, size, slack is not None and slack.relative, LISTED_PLANES, PLANES)


def _take_back(hull: Polyhedron, cloud: Cloud, slots: Slots, state: NDArray[np.int64]) -> None:
    """What the kernels made of the state; slots become the serial numbers of the equations in them."""
    count, made = state[workspace.COUNT], state[workspace.MADE]
    standing = np.flatnonzero(slots.alive[:made])
    places, table, remaining = hull.places, hull.table, hull.remaining
    places.coordinates, places.who = cloud.coordinates[:, :count], cloud.who[:count]
    table.coefficients, table.defining = slots.coefficients[:, standing], slots.defining[:, standing]
    table.serial, table.made = standing, int(made)
    if table.tolerances is not None:
        table.tolerances = slots.tolerances[standing]
    if state[workspace.KNOWN] & workspace.TABLE:
        hull.progress.correct(TABLE_OF_PLANES)
    hull.vertices, hull.to_check = int(state[workspace.VERTICES]), int(state[workspace.CHECKED])
    remaining.keeper, remaining.tried = cloud.keeper[hull.vertices : count], int(state[workspace.TRIED])
    remaining.struck = bool(state[workspace.STRUCK])
