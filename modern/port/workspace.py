"""What the kernels work on: points, planes in slots and a row of counts; and the smallest steps over them.

Planes stand in *slots* in the order of the table; a slot whose plane was struck stays empty until :func:`pack`.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

COUNT, VERTICES, CHECK, CHECKED, MADE, ALIVE, TRIED, STRUCK, GONE, STAGES, ADDED, OUTSIDE, KNOWN = range(13)
"""Places of the state: points left, vertices among them; slot to check and how many equations stand before it; slots
used and planes in them; slots used when the points were last looked at, whether that struck any, and points struck so
far; stages so far, of the last one the point added and how many equations it lay outside of; corrections known, a
bit each."""
STATE_SIZE = 13

THROUGH, TABLE, PAIR = 1, 2, 4
"""Bits of corrections: a plane through C, more planes than the listing has room for, the last pair of equal planes."""


class Cloud(NamedTuple):
    """The points by place: coordinates (3, n), which of the input, the slot of a plane each is not inside of or -1.

    ``gone``: room for the points struck, in order.
    """

    coordinates: NDArray[Any]
    who: NDArray[np.int64]
    keeper: NDArray[np.int64]
    gone: NDArray[np.int64]


class Slots(NamedTuple):
    """The planes by slot: coefficients (4, slots), defining places (3, slots), e, whether the plane still stands.

    An e of -1 is none.
    """

    coefficients: NDArray[Any]
    defining: NDArray[np.int64]
    tolerances: NDArray[Any]
    alive: NDArray[np.bool_]


class Room(NamedTuple):
    """Room for what a stage works out, so that no kernel makes an array: numba compiles those that do far longer.

    order, values: slots of planes, and their values at a point.  partner, following, keys (2, slots), chains: of pairs
    of fresh planes, see :func:`modern.port.kernels.doubles`.
    """

    order: NDArray[np.int64]
    values: NDArray[Any]
    partner: NDArray[np.int64]
    following: NDArray[np.int64]
    keys: NDArray[np.int64]
    chains: NDArray[np.int64]


def room_for(slots: int, number: Any) -> Room:
    """Room for tables of so many slots, their coefficients of the type ``number``."""
    chains = 4
    while chains < 2 * slots:
        chains *= 2
    one = [np.empty(slots, np.int64) for _ in range(3)]
    return Room(
        one[0], np.empty(slots, number), one[1], one[2], np.empty((2, slots), np.int64), np.empty(chains, np.int64)
    )


class Rules(NamedTuple):
    """What does not change: the point C, or whether the origin was moved to it; e, or -1, and whether it is relative.

    ``listed``, ``room``: places for planes in the listing and in the layer ``corrected``.
    """

    centre: NDArray[Any]
    moved: bool
    size: Any
    relative: bool
    listed: int
    room: int


def is_outside(value: Any, e: Any) -> bool:
    """Whether the value, zero from -e to +e, is positive."""
    return value > 0 and value > e  # type: ignore[no-any-return]


def is_not_inside(value: Any, e: Any) -> bool:
    """Whether the value, zero from -e to +e, is zero or positive."""
    return value >= 0 or value >= -e  # type: ignore[no-any-return]


def is_on(value: Any, e: Any) -> bool:
    """Whether the value, zero from -e to +e, is zero."""
    return value == 0 or abs(value) <= e  # type: ignore[no-any-return]


def corner(coordinates: NDArray[Any], place: int) -> Any:
    return coordinates[0, place], coordinates[1, place], coordinates[2, place]


def equation(coefficients: NDArray[Any], k: int) -> Any:
    return coefficients[0, k], coefficients[1, k], coefficients[2, k], coefficients[3, k]


def tolerance(found: Any, rules: Any) -> Any:
    """The e of an equation, as ``Slack.of`` has it."""
    if not rules.relative:
        return rules.size
    largest = abs(found[0])
    for k in range(1, 3):
        other = abs(found[k])
        if other - largest > 0:
            largest = other
    return rules.size * largest


def pack(cloud: Any, slots: Any, room: Any, state: NDArray[np.int64]) -> None:
    """Close up the slots."""
    made, to = state[MADE], room.order
    check, tried, k = -1, -1, 0
    for slot in range(made):
        to[slot] = -1
        if check < 0 and slot >= state[CHECK]:
            check = k
        if tried < 0 and slot >= state[TRIED]:
            tried = k
        if slots.alive[slot]:
            to[slot] = k
            for i in range(4):
                slots.coefficients[i, k] = slots.coefficients[i, slot]
            for i in range(3):
                slots.defining[i, k] = slots.defining[i, slot]
            slots.tolerances[k] = slots.tolerances[slot]
            k += 1
    for slot in range(made):
        slots.alive[slot] = slot < k
    state[CHECK] = check if check >= 0 else k
    state[TRIED] = tried if tried >= 0 else k
    state[MADE] = k
    for place in range(state[VERTICES], state[COUNT]):
        if cloud.keeper[place] >= 0:
            cloud.keeper[place] = to[cloud.keeper[place]]
