"""The loop of program 3, which adds vertices to the first hull H_1, compiled by numba for floating-point numbers.

The steps, decisions and numbers are those of :mod:`modern.port.growth` and :mod:`modern.port.polyhedron`, and the
formulas are computed by the same functions. A stage is the addition of one vertex. The kernel leaves three kinds of
exceptional stages to these two modules: a stage that ends without a hull, a stage that is the first to need one of two
corrections of the listing, and a stage whose new vertex is already a vertex. The first correction concerns pairs of
equal planes, and the second concerns planes through the inside point C. For an exceptional stage the kernel returns
UNUSUAL and changes only the number of the equation to check.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from modern.port.arithmetic import at, plane
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

# The results of a stage: it is completed; no further stage is possible; numpy must run the stage; there are not enough
# free slots for its planes.
GROWN, ENDED, UNUSUAL, FULL = range(4)

# The number of points whose values are compared as a block with the largest value so far.
BLOCK = 256


def keeper_among(point: Any, slots: Any, first: int, last: int) -> int:
    """Return the first slot, from ``first`` to ``last`` - 1, whose plane the point is on or outside of, or -1."""
    for slot in range(first, last):
        if slots.alive[slot] and is_not_inside(at(equation(slots.coefficients, slot), point), slots.tolerances[slot]):
            return slot
    return -1


def strike_inside(cloud: Any, slots: Any, state: NDArray[np.int64]) -> None:
    """Remove the points that are inside all planes.  This is the compiled version of ``Remaining.strike_inside``."""
    made, tried, eliminated_before = state[MADE], state[TRIED], state[GONE]
    next_index = state[VERTICES]
    for index in range(state[VERTICES], state[COUNT]):
        keeper = cloud.keeper[index]
        # Statements 104 to 112. The new planes come first: for most points one of them replaces the deleted keeper, the
        # plane that shows that a point is not inside.
        if keeper < 0 or not slots.alive[keeper]:
            point = corner(cloud.coordinates, index)
            keeper = keeper_among(point, slots, tried, made)
            if keeper < 0:
                keeper = keeper_among(point, slots, 0, tried)
        if keeper < 0:
            cloud.eliminated[state[GONE]] = cloud.input_index[index]
            state[GONE] += 1
            continue
        # Statement 111 moves all later points down for each point eliminated. Here a single pass moves each point only
        # once.
        if next_index != index:
            for i in range(3):
                cloud.coordinates[i, next_index] = cloud.coordinates[i, index]
            cloud.input_index[next_index] = cloud.input_index[index]
        cloud.keeper[next_index] = keeper
        next_index += 1
    state[COUNT] = next_index
    state[TRIED] = made
    state[STRUCK] = state[GONE] > eliminated_before


def count_above(coordinates: NDArray[Any], start: int, end: int, plane_equation: Any, above: Any) -> int:
    """Count the points at which the value of a plane's equation exceeds ``above``.

    The loop has no branches, so that the processor can compute several values at a time.
    """
    x, y, z = coordinates[0, start:end], coordinates[1, start:end], coordinates[2, start:end]
    count = 0
    for k in range(len(x)):
        count += at(plane_equation, (x[k], y[k], z[k])) > above
    return count


def farthest_outside(coordinates: NDArray[Any], count: int, plane_equation: Any, e: Any) -> int:
    """Return the index of the point farthest outside a plane, or -1 if none is outside.

    If several points are equally far, the index is that of the last of them.
    """
    # A value within the slack counts as zero. The difference computed here is a zero of the number type of the values.
    largest = e if e > 0 else e - e
    index = -1
    # Visit the points from the end, so that the last of equal values is met first (program 3, 122: not greater).
    end = count
    while end > 0:
        start = max(end - BLOCK, 0)
        # Most blocks contain no larger value. Only the others are searched one by one.
        if count_above(coordinates, start, end, plane_equation, largest):
            for k in range(end - 1, start - 1, -1):
                value = at(plane_equation, corner(coordinates, k))
                if value > largest:
                    index, largest = k, value
        end = start
    return index


def outside_point(cloud: Any, slots: Any, state: NDArray[np.int64]) -> int:
    """Return the index of the next vertex, or -1 if no point is outside the hull.

    Return -2 if the equation of a plane does not hold at a point that defines the plane.
    """
    while state[CHECK] < state[MADE]:
        slot = state[CHECK]
        if slots.alive[slot]:
            plane_equation, e = equation(slots.coefficients, slot), slots.tolerances[slot]
            for i in range(3):
                # Statements 116 to 119: a defining point must satisfy its equation.
                if not is_on(at(plane_equation, corner(cloud.coordinates, slots.defining[i, slot])), e):
                    return -2
            index = farthest_outside(cloud.coordinates, state[COUNT], plane_equation, e)
            if index >= 0:
                return index
            state[CHECKED] += 1
        state[CHECK] += 1
    return -1


def planes_to_replace(point: Any, slots: Any, scratch: Any, state: NDArray[np.int64]) -> int:
    """List the planes that the point is outside of, in the order in which they are replaced.  Return their number.

    The first plane is the one that is being checked. No point is outside of the planes in earlier slots, because those
    were checked before.
    """
    order, values = scratch.order, scratch.values
    # Statements 135 to 140: the plane being checked first, then by decreasing value at the new vertex.
    order[0] = state[CHECK]
    count = 1
    for slot in range(state[CHECK] + 1, state[MADE]):
        if slots.alive[slot]:
            value = at(equation(slots.coefficients, slot), point)
            if is_outside(value, slots.tolerances[slot]):
                order[count], values[count] = slot, value
                count += 1
    sort_descending(order, values, 1, count)
    return count


def sort_descending(order: NDArray[np.int64], values: NDArray[Any], first: int, last: int) -> None:
    """Sort planes by value, largest first, by Shell's method.

    Of planes with equal values, the one in the later slot comes first.
    """
    gap = 1
    while gap < last - first:
        gap = 3 * gap + 1
    while gap > 0:
        for k in range(first + gap, last):
            slot, value, position = order[k], values[k], k - gap
            while position >= first and (
                values[position] < value or (values[position] == value and order[position] < slot)
            ):
                order[position + gap], values[position + gap] = order[position], values[position]
                position -= gap
            order[position + gap], values[position + gap] = slot, value
        gap //= 3


def three_planes(count: int, index: int, cloud: Any, slots: Any, scratch: Any, state: Any, rules: Any) -> int:
    """Write three new planes into empty slots for each plane that the new vertex is outside of.

    Return -1 if a plane is degenerate or if rounding puts the new vertex outside a new plane. The module
    :mod:`modern.port.polyhedron` must then compute the stage. Otherwise, return THROUGH if a new plane contains the
    inside point C, a case for which the listing had to be corrected, and 0 if none does.
    """
    new, slot, corrections = state[VERTICES], state[MADE], 0
    point = corner(cloud.coordinates, index)
    for k in range(count):
        old = scratch.order[k]
        # Statements 126 to 130: the new vertex replaces MM, NN and KK in turn. ``defining`` stores the final index of
        # the new vertex, but its coordinates are still at its old index.
        for turn in range(3):
            for i in range(3):
                slots.defining[i, slot] = slots.defining[i, old]
            slots.defining[turn, slot] = new
            p = point if turn == 0 else corner(cloud.coordinates, slots.defining[0, slot])
            q = point if turn == 1 else corner(cloud.coordinates, slots.defining[1, slot])
            r = point if turn == 2 else corner(cloud.coordinates, slots.defining[2, slot])
            fresh = plane(p, q, r)
            # Statements 132 to 134: orient the plane by C. If the origin was moved to C, D is the value at C (p. 118).
            value = fresh[3] if rules.moved else at(fresh, (rules.centre[0], rules.centre[1], rules.centre[2]))
            if value > 0:
                fresh = (-fresh[0], -fresh[1], -fresh[2], -fresh[3])
            e = tolerance(fresh, rules)
            if value == 0:
                corrections |= THROUGH
                if fresh[0] * fresh[0] == 0 and fresh[1] * fresh[1] == 0 and fresh[2] * fresh[2] == 0:
                    return -1
            # Rounding can put the new vertex outside its own plane. numpy's version then reproduces the failure.
            if is_outside(at(fresh, point), e):
                return -1
            for i in range(4):
                slots.coefficients[i, slot] = fresh[i]
            slots.tolerances[slot] = e
            slot += 1
    return corrections


def doubles(defining: NDArray[np.int64], first: int, last: int, scratch: Any) -> None:
    """Find the pairs of equal planes among the new planes, which are in the slots ``first`` to ``last``.

    ``scratch.partner`` receives for each new plane the number of the new plane with the same three points, or -1. Of
    three equal planes the first two are a pair. A hash table holds the planes that have no partner yet.
    """
    partner, following, chains, keys = scratch.partner, scratch.following, scratch.chains, scratch.keys
    size = 4
    while size < 2 * (last - first):
        size *= 2
    for k in range(size):
        chains[k] = -1
    for k in range(last - first):
        partner[k] = -1
        a, b, c = defining[0, first + k], defining[1, first + k], defining[2, first + k]
        # The new vertex has the largest index of the three defining points, so the other two identify the plane.
        new = max(a, b, c)
        low, high = min(a, b, c), a + b + c - new - min(a, b, c)
        keys[0, k], keys[1, k] = low, high
        bucket = (low * 40503 + high) & (size - 1)
        previous, candidate = -1, chains[bucket]
        while candidate >= 0 and not (keys[0, candidate] == low and keys[1, candidate] == high):
            previous, candidate = candidate, following[candidate]
        if candidate < 0:
            following[k] = chains[bucket]
            chains[bucket] = k
        else:
            partner[k], partner[candidate] = candidate, k
            # A pair is removed from the chain, so that a third equal plane waits for a fourth.
            if previous < 0:
                chains[bucket] = following[candidate]
            else:
                following[previous] = following[candidate]


def takes_last_pair(partner: NDArray[np.int64], count: int) -> bool:
    """Return True if the listing would fail at these new planes.

    The listing fails if at most one new plane follows a pair of equal planes that the listing deletes.
    """
    remaining = count
    for k in range(count):
        if partner[k] < 0:
            remaining -= 1
        elif partner[k] > k:
            remaining -= 2
            if remaining <= 1:
                return True
    return False


def expand(index: int, cloud: Any, slots: Any, scratch: Any, state: NDArray[np.int64], rules: Any) -> int:
    """Make a point a vertex of the hull.  This is the compiled version of ``Polyhedron.expand``."""
    replaced_count = planes_to_replace(corner(cloud.coordinates, index), slots, scratch, state)
    made, new = state[MADE], state[VERTICES]
    last = made + 3 * replaced_count
    if last > len(slots.alive):
        return FULL
    # The largest table of the stage: every replacement adds three planes and then deletes one (statements 131, 157).
    peak = state[ALIVE] + 2 * replaced_count + 1
    corrections = three_planes(replaced_count, index, cloud, slots, scratch, state, rules)
    if corrections < 0 or peak > max(rules.capacity, 4 * state[COUNT] - 11):
        return UNUSUAL
    if peak > rules.listed:
        corrections |= TABLE
    doubles(slots.defining, made, last, scratch)
    partner = scratch.partner
    if replaced_count > 1 and takes_last_pair(partner, 3 * replaced_count):
        corrections |= PAIR
    # For any hull of many points the table is longer than the listing's, so only this correction is recorded here.
    if corrections & ~state[KNOWN] & ~TABLE:
        return UNUSUAL
    state[KNOWN] |= corrections
    for k in range(replaced_count):
        slots.alive[scratch.order[k]] = False
    next_slot = made
    # Keep the fresh planes without a partner and close up their slots (statements 141 to 160).
    for k in range(last - made):
        if partner[k] < 0:
            for i in range(4):
                slots.coefficients[i, next_slot] = slots.coefficients[i, made + k]
            for i in range(3):
                slots.defining[i, next_slot] = slots.defining[i, made + k]
            slots.tolerances[next_slot] = slots.tolerances[made + k]
            slots.alive[next_slot] = True
            next_slot += 1
    state[MADE] = next_slot
    state[ALIVE] += next_slot - made - replaced_count
    for i in range(3):
        cloud.coordinates[i, index], cloud.coordinates[i, new] = cloud.coordinates[i, new], cloud.coordinates[i, index]
    cloud.input_index[index], cloud.input_index[new] = cloud.input_index[new], cloud.input_index[index]
    cloud.keeper[index] = cloud.keeper[new]
    state[VERTICES] += 1
    state[ADDED], state[OUTSIDE] = cloud.input_index[new], replaced_count
    return GROWN


def grow(cloud: Any, slots: Any, scratch: Any, state: NDArray[np.int64], rules: Any, first: bool, stages: int) -> int:
    """Add ``stages`` vertices to the hull, or all if ``stages`` < 0.  ``first`` is True before the first addition."""
    while True:
        if not first:
            # No points remain, and the last test eliminated none (statement 103).
            if state[COUNT] == state[VERTICES] and not state[STRUCK]:
                return ENDED
            # Close up the slots when a third of them are empty.
            if state[MADE] > state[ALIVE] + state[ALIVE] // 2 + 16:
                pack(cloud, slots, scratch, state)
            index = outside_point(cloud, slots, state)
            if index == -1:
                return ENDED
            if index < state[VERTICES]:
                return UNUSUAL
            code = expand(index, cloud, slots, scratch, state, rules)
            if code != GROWN:
                return code
        strike_inside(cloud, slots, state)
        first = False
        state[STAGES] += 1
        if state[STAGES] == stages:
            return GROWN


def count_on(coordinates: NDArray[Any], start: int, end: int, plane_equation: Any, e: Any) -> int:
    """Count the points that satisfy a plane's equation.  Like :func:`count_above`, the loop has no branches."""
    x, y, z = coordinates[0, start:end], coordinates[1, start:end], coordinates[2, start:end]
    count = 0
    for k in range(len(x)):
        count += abs(at(plane_equation, (x[k], y[k], z[k]))) <= e
    return count


def satisfied(slots: Any, coordinates: NDArray[Any], counts: NDArray[np.int64], indices: NDArray[np.int64]) -> int:
    """Write the points on each plane into ``indices`` while it has room, and return the number of all such points."""
    k, count = 0, coordinates.shape[1]
    for slot in range(len(slots.alive)):
        plane_equation, e, first = equation(slots.coefficients, slot), slots.tolerances[slot], k
        e = e if e > 0 else e - e
        for start in range(0, count, BLOCK):
            end = min(start + BLOCK, count)
            if count_on(coordinates, start, end, plane_equation, e):
                for index in range(start, end):
                    if is_on(at(plane_equation, corner(coordinates, index)), e):
                        if k < len(indices):
                            indices[k] = index
                        k += 1
        counts[slot] = k - first
    return k
