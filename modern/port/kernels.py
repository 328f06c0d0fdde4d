"""Program 3 from H_1 on for floats, one number at a time, in the part of Python that numba compiles.

The steps are those of :mod:`modern.port.growth`, :mod:`modern.port.polyhedron` and :mod:`modern.port.growth`, and so
are the decisions and the numbers, which come from the formulas those use.  What is not ordinary is left to them: a
stage that stops, that meets a correction of a pair or of C not yet noted, or that takes back a vertex returns UNUSUAL
with nothing changed but the equation to check.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from modern.port.formulas import at, plane
from modern.port.workspace import (
    ADDED,
    ALIVE,
    CHECK,
    CHECKED,
    COUNT,
    GONE,
    KNOWN,
    MADE,
    OUTSIDE,
    PAIR,
    STAGES,
    STRUCK,
    TABLE,
    THROUGH,
    TRIED,
    VERTICES,
    corner,
    equation,
    is_not_inside,
    is_on,
    is_outside,
    pack,
    tolerance,
)

GROWN, ENDED, UNUSUAL, FULL = range(4)
"""How a stage came out: grown; no stage can follow; left to numpy; no slots left for its planes."""

BLOCK = 256
"""Points put into an equation before the largest value is looked for among them."""


def keeper_among(point: Any, slots: Any, first: int, last: int) -> int:
    """The first slot of a plane the point is not inside of, -1 if there is none."""
    for slot in range(first, last):
        if slots.alive[slot] and is_not_inside(at(equation(slots.coefficients, slot), point), slots.tolerances[slot]):
            return slot
    return -1


def strike_inside(cloud: Any, slots: Any, state: NDArray[np.int64]) -> None:
    """Eliminate the points inside of every plane: ``Remaining.strike_inside``."""
    made, tried, before = state[MADE], state[TRIED], state[GONE]
    to = state[VERTICES]
    for place in range(state[VERTICES], state[COUNT]):
        kept = cloud.keeper[place]
        if kept < 0 or not slots.alive[kept]:
            point = corner(cloud.coordinates, place)
            kept = keeper_among(point, slots, tried, made)
            if kept < 0:
                kept = keeper_among(point, slots, 0, tried)
        if kept < 0:
            cloud.gone[state[GONE]] = cloud.who[place]
            state[GONE] += 1
            continue
        if to != place:
            for i in range(3):
                cloud.coordinates[i, to] = cloud.coordinates[i, place]
            cloud.who[to] = cloud.who[place]
        cloud.keeper[to] = kept
        to += 1
    state[COUNT] = to
    state[TRIED] = made
    state[STRUCK] = state[GONE] > before


def reaching(coordinates: NDArray[Any], start: int, end: int, found: Any, above: Any) -> int:
    """How many points have a larger value: no branches, so that the compiler takes several points at a time."""
    x, y, z = coordinates[0, start:end], coordinates[1, start:end], coordinates[2, start:end]
    count = 0
    for k in range(len(x)):
        count += at(found, (x[k], y[k], z[k])) > above
    return count


def farthest_outside(coordinates: NDArray[Any], count: int, found: Any, e: Any) -> int:
    """The place of the largest value, the last of equals, if it is outside; else -1."""
    largest = e if e > 0 else e - e
    place = -1
    # From the end on: a later one of equals is met first.
    end = count
    while end > 0:
        start = max(end - BLOCK, 0)
        if reaching(coordinates, start, end, found, largest):
            for k in range(end - 1, start - 1, -1):
                value = at(found, corner(coordinates, k))
                if value > largest:
                    place, largest = k, value
        end = start
    return place


def outside_point(cloud: Any, slots: Any, state: NDArray[np.int64]) -> int:
    """``Polyhedron.outside_point``; -1 when every equation supports, -2 when a defining point is off its plane."""
    while state[CHECK] < state[MADE]:
        slot = state[CHECK]
        if slots.alive[slot]:
            found, e = equation(slots.coefficients, slot), slots.tolerances[slot]
            for i in range(3):
                if not is_on(at(found, corner(cloud.coordinates, slots.defining[i, slot])), e):
                    return -2
            place = farthest_outside(cloud.coordinates, state[COUNT], found, e)
            if place >= 0:
                return place
            state[CHECKED] += 1
        state[CHECK] += 1
    return -1


def replaced(point: Any, slots: Any, room: Any, state: NDArray[np.int64]) -> int:
    """How many planes the point is outside of; ``room.order`` gets their slots in the order they are replaced.

    First is the one to check.  None stands before it: those have been put to every point that is left.
    """
    order, values = room.order, room.values
    order[0] = state[CHECK]
    count = 1
    for slot in range(state[CHECK] + 1, state[MADE]):
        if slots.alive[slot]:
            value = at(equation(slots.coefficients, slot), point)
            if is_outside(value, slots.tolerances[slot]):
                order[count], values[count] = slot, value
                count += 1
    fall(order, values, 1, count)
    return count


def fall(order: NDArray[np.int64], values: NDArray[Any], first: int, last: int) -> None:
    """Sort from the largest value to the smallest, of equals the later slot first (Shell's method)."""
    gap = 1
    while gap < last - first:
        gap = 3 * gap + 1
    while gap > 0:
        for k in range(first + gap, last):
            slot, value, to = order[k], values[k], k - gap
            while to >= first and (values[to] < value or (values[to] == value and order[to] < slot)):
                order[to + gap], values[to + gap] = order[to], values[to]
                to -= gap
            order[to + gap], values[to + gap] = slot, value
        gap //= 3


def three_planes(count: int, place: int, cloud: Any, slots: Any, room: Any, state: Any, rules: Any) -> int:
    """``Polyhedron.three_planes`` into the slots after those used; the bits of corrections, -1 to stop the stage."""
    new, slot, corrections = state[VERTICES], state[MADE], 0
    point = corner(cloud.coordinates, place)
    for k in range(count):
        old = room.order[k]
        for turn in range(3):
            for i in range(3):
                slots.defining[i, slot] = slots.defining[i, old]
            slots.defining[turn, slot] = new
            p = point if turn == 0 else corner(cloud.coordinates, slots.defining[0, slot])
            q = point if turn == 1 else corner(cloud.coordinates, slots.defining[1, slot])
            r = point if turn == 2 else corner(cloud.coordinates, slots.defining[2, slot])
            found = plane(p, q, r)
            value = found[3] if rules.moved else at(found, (rules.centre[0], rules.centre[1], rules.centre[2]))
            if value > 0:
                found = (-found[0], -found[1], -found[2], -found[3])
            e = tolerance(found, rules)
            if value == 0:
                corrections |= THROUGH
                if found[0] * found[0] == 0 and found[1] * found[1] == 0 and found[2] * found[2] == 0:
                    return -1
            if is_outside(at(found, point), e):
                return -1
            for i in range(4):
                slots.coefficients[i, slot] = found[i]
            slots.tolerances[slot] = e
            slot += 1
    return corrections


def doubles(defining: NDArray[np.int64], first: int, last: int, room: Any) -> None:
    """``room.partner``: for each fresh plane from slot ``first`` on the other with the same three points; -1: none.

    Both are counted from 0.  Of three equal ones the first two are a pair.  Planes wait in chains, found by a hash of
    their points.
    """
    partner, following, chains, keys = room.partner, room.following, room.chains, room.keys
    size = 4
    while size < 2 * (last - first):
        size *= 2
    for k in range(size):
        chains[k] = -1
    for k in range(last - first):
        partner[k] = -1
        a, b, c = defining[0, first + k], defining[1, first + k], defining[2, first + k]
        new = max(a, b, c)
        low, high = min(a, b, c), a + b + c - new - min(a, b, c)
        keys[0, k], keys[1, k] = low, high
        bucket = (low * 40503 + high) & (size - 1)
        before, other = -1, chains[bucket]
        while other >= 0 and not (keys[0, other] == low and keys[1, other] == high):
            before, other = other, following[other]
        if other < 0:
            following[k] = chains[bucket]
            chains[bucket] = k
        else:
            partner[k], partner[other] = other, k
            if before < 0:
                chains[bucket] = following[other]
            else:
                following[before] = following[other]


def takes_last_pair(partner: NDArray[np.int64], count: int) -> bool:
    """Whether a pair is struck with at most one plane left after it, as ``Polyhedron.single`` notes it."""
    left = count
    for k in range(count):
        if partner[k] < 0:
            left -= 1
        elif partner[k] > k:
            left -= 2
            if left <= 1:
                return True
    return False


def expand(place: int, cloud: Any, slots: Any, room: Any, state: NDArray[np.int64], rules: Any) -> int:
    """``Polyhedron.expand``."""
    gone = replaced(corner(cloud.coordinates, place), slots, room, state)
    made, new = state[MADE], state[VERTICES]
    last = made + 3 * gone
    if last > len(slots.alive):
        return FULL
    peak = state[ALIVE] + 2 * gone + 1
    corrections = three_planes(gone, place, cloud, slots, room, state, rules)
    if corrections < 0 or peak > max(rules.room, 4 * state[COUNT] - 11):
        return UNUSUAL
    if peak > rules.listed:
        corrections |= TABLE
    doubles(slots.defining, made, last, room)
    partner = room.partner
    if gone > 1 and takes_last_pair(partner, 3 * gone):
        corrections |= PAIR
    # The table of planes is larger than the listing's in every hull of many points: that is noted here.
    if corrections & ~state[KNOWN] & ~TABLE:
        return UNUSUAL
    state[KNOWN] |= corrections
    for k in range(gone):
        slots.alive[room.order[k]] = False
    to = made
    for k in range(last - made):
        if partner[k] < 0:
            for i in range(4):
                slots.coefficients[i, to] = slots.coefficients[i, made + k]
            for i in range(3):
                slots.defining[i, to] = slots.defining[i, made + k]
            slots.tolerances[to] = slots.tolerances[made + k]
            slots.alive[to] = True
            to += 1
    state[MADE] = to
    state[ALIVE] += to - made - gone
    for i in range(3):
        cloud.coordinates[i, place], cloud.coordinates[i, new] = cloud.coordinates[i, new], cloud.coordinates[i, place]
    cloud.who[place], cloud.who[new] = cloud.who[new], cloud.who[place]
    cloud.keeper[place] = cloud.keeper[new]
    state[VERTICES] += 1
    state[ADDED], state[OUTSIDE] = cloud.who[new], gone
    return GROWN


def grow(cloud: Any, slots: Any, room: Any, state: NDArray[np.int64], rules: Any, first: bool, stages: int) -> int:
    """So many stages, or all if negative; ``first``: the first of them is H_1 itself, which has no new vertex."""
    while True:
        if not first:
            if state[COUNT] == state[VERTICES] and not state[STRUCK]:
                return ENDED
            if state[MADE] > state[ALIVE] + state[ALIVE] // 2 + 16:
                pack(cloud, slots, room, state)
            place = outside_point(cloud, slots, state)
            if place == -1:
                return ENDED
            if place < state[VERTICES]:
                return UNUSUAL
            code = expand(place, cloud, slots, room, state, rules)
            if code != GROWN:
                return code
        strike_inside(cloud, slots, state)
        first = False
        state[STAGES] += 1
        if state[STAGES] == stages:
            return GROWN


def touching(coordinates: NDArray[Any], start: int, end: int, found: Any, e: Any) -> int:
    """How many points are on the plane; no branches, as in :func:`reaching`."""
    x, y, z = coordinates[0, start:end], coordinates[1, start:end], coordinates[2, start:end]
    count = 0
    for k in range(len(x)):
        count += abs(at(found, (x[k], y[k], z[k]))) <= e
    return count


def satisfied(slots: Any, coordinates: NDArray[Any], counts: NDArray[np.int64], places: NDArray[np.int64]) -> int:
    """``Equations.satisfied``: how many points satisfy each equation, and their places, equation after equation.

    All are counted; those beyond the end of ``places`` are not noted.
    """
    k, count = 0, coordinates.shape[1]
    for slot in range(len(slots.alive)):
        found, e, first = equation(slots.coefficients, slot), slots.tolerances[slot], k
        e = e if e > 0 else e - e
        for start in range(0, count, BLOCK):
            end = min(start + BLOCK, count)
            if touching(coordinates, start, end, found, e):
                for place in range(start, end):
                    if is_on(at(found, corner(coordinates, place)), e):
                        if k < len(places):
                            places[k] = place
                        k += 1
        counts[slot] = k - first
    return k
