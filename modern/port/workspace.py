"""The arrays of the port of program 3 that numba compiles: points, planes, counters, and small operations on them.

A plane occupies a *slot*, an index of the arrays, in the order of the table of planes. The slot of a deleted plane
stays empty until :func:`pack`.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

# Indices of the state vector.
#
# COUNT: the number of points that remain. VERTICES: the number of vertices among them. CHECK: the slot to check.
# CHECKED: the number of equations before that slot. MADE: the number of slots used. ALIVE: the number of planes in
# these slots. TRIED: the number of slots used when the points were last tested. STRUCK: whether that test eliminated a
# point. GONE: the number of points eliminated so far. STAGES: the number of stages so far. ADDED: the point added by
# the last stage. OUTSIDE: the number of equations that this point lay outside of. KNOWN: the corrections recorded so
# far, one bit for each.
COUNT, VERTICES, CHECK, CHECKED, MADE, ALIVE, TRIED, STRUCK, GONE, STAGES, ADDED, OUTSIDE, KNOWN = range(13)
STATE_SIZE = 13

# Bits for corrections.
#
# THROUGH: a plane contains the inside point C. TABLE: there are more planes than the listing's table holds. PAIR: the
# last pair of equal planes was deleted.
THROUGH, TABLE, PAIR = 1, 2, 4


class Cloud(NamedTuple):
    """The points in their current order: coordinates, shape (3, n), and input indices.

    ``keeper`` has, for each point, the slot of a plane that the point is on or outside of, or -1 if none is known.
    ``eliminated`` collects the eliminated points.
    """

    coordinates: NDArray[Any]
    input_index: NDArray[np.int64]
    keeper: NDArray[np.int64]
    eliminated: NDArray[np.int64]


class Slots(NamedTuple):
    """The planes, by slot: coefficients, shape (4, slots), three defining points, and a tolerance e or -1 for none."""

    coefficients: NDArray[Any]
    defining: NDArray[np.int64]
    tolerances: NDArray[Any]
    alive: NDArray[np.bool_]


class Scratch(NamedTuple):
    """Temporary arrays that are allocated once, because numba compiles functions faster if they allocate nothing.

    ``order`` and ``values`` hold slots of planes and the values of these planes at a point. The other arrays are used
    in :func:`modern.port.kernels.doubles`.
    """

    order: NDArray[np.int64]
    values: NDArray[Any]
    partner: NDArray[np.int64]
    following: NDArray[np.int64]
    keys: NDArray[np.int64]
    chains: NDArray[np.int64]


def scratch_for(slots: int, number: Any) -> Scratch:
    """Allocate temporary arrays for a table with this number of slots and coefficients of the type of ``number``."""
    # The hash table is a power of two, at least twice as large as the number of planes.
    chains = 4
    while chains < 2 * slots:
        chains *= 2
    buffers = [np.empty(slots, np.int64) for _ in range(3)]
    return Scratch(
        buffers[0],
        np.empty(slots, number),
        buffers[1],
        buffers[2],
        np.empty((2, slots), np.int64),
        np.empty(chains, np.int64),
    )


class Rules(NamedTuple):
    """The constants of a run: the inside point C, the tolerance e, and limits for the number of planes.

    ``moved`` is True if the origin was moved to C.  ``size`` is e, or -1 if there is no tolerance.  If ``relative`` is
    True, e is multiplied by an equation's largest coefficient.  ``listed`` is the number of planes for which the
    listing of 1963 has room in its table, and ``capacity`` the number for which this port has room.
    """

    centre: NDArray[Any]
    moved: bool
    size: Any
    relative: bool
    listed: int
    capacity: int


def is_outside(value: Any, e: Any) -> bool:
    """Return True if a plane's value at a point is positive.  A value from -e to +e counts as zero."""
    return value > 0 and value > e  # type: ignore[no-any-return]


def is_not_inside(value: Any, e: Any) -> bool:
    """Return True if a plane's value at a point is positive or counts as zero."""
    return value >= 0 or value >= -e  # type: ignore[no-any-return]


def is_on(value: Any, e: Any) -> bool:
    """Return True if a plane's value at a point counts as zero."""
    return value == 0 or abs(value) <= e  # type: ignore[no-any-return]


def corner(coordinates: NDArray[Any], place: int) -> Any:
    return coordinates[0, place], coordinates[1, place], coordinates[2, place]


def equation(coefficients: NDArray[Any], k: int) -> Any:
    return coefficients[0, k], coefficients[1, k], coefficients[2, k], coefficients[3, k]


def tolerance(coefficients: Any, rules: Any) -> Any:
    """Return the tolerance e of an equation, as ``Slack.of`` computes it."""
    if not rules.relative:
        return rules.size
    largest = abs(coefficients[0])
    for k in range(1, 3):
        size = abs(coefficients[k])
        if size - largest > 0:
            largest = size
    return rules.size * largest


def pack(cloud: Any, slots: Any, scratch: Any, state: NDArray[np.int64]) -> None:
    """Move the remaining planes together, so that no empty slot lies between them."""
    used, new_slots = state[MADE], scratch.order
    check, tried, k = -1, -1, 0
    for slot in range(used):
        new_slots[slot] = -1
        # CHECK and TRIED may point at empty slots. They become the new slot of the next plane that remains.
        if check < 0 and slot >= state[CHECK]:
            check = k
        if tried < 0 and slot >= state[TRIED]:
            tried = k
        if slots.alive[slot]:
            new_slots[slot] = k
            for i in range(4):
                slots.coefficients[i, k] = slots.coefficients[i, slot]
            for i in range(3):
                slots.defining[i, k] = slots.defining[i, slot]
            slots.tolerances[k] = slots.tolerances[slot]
            k += 1
    # The planes now fill the first k slots.
    for slot in range(used):
        slots.alive[slot] = slot < k
    state[CHECK] = check if check >= 0 else k
    state[TRIED] = tried if tried >= 0 else k
    state[MADE] = k
    # A keeper whose plane was deleted becomes -1, which stands for an unknown keeper.
    for place in range(state[VERTICES], state[COUNT]):
        if cloud.keeper[place] >= 0:
            cloud.keeper[place] = new_slots[cloud.keeper[place]]
