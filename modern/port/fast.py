"""The compiled version of program 3, by numba (the extra ``fast``), and the choice between it and numpy."""

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
from modern.port.table import Equations, PointTable, Slack
from modern.port.workspace import Cloud, Rules, Slots

_CORRECTIONS = {THROUGH_CENTRE: workspace.THROUGH, TABLE_OF_PLANES: workspace.TABLE, LAST_PAIR: workspace.PAIR}

_H1_VERTICES = 4
# The number of free slots with which a table begins, in addition to six for each equation. A stage needs at most four
# and a half slots for each plane.
_SPARE_SLOTS = 1024
# A table begins with one more free slot for every eight points. The arrays are then large enough for most hulls and
# need not be copied to larger ones.
_POINTS_PER_SLOT = 8

# The number of points from which loading the kernels costs less than it saves.
_WORTH_LOADING = 5_000


@dataclass(frozen=True, slots=True)
class Steps:
    """Two steps of program 3, either in numpy or compiled: adding vertices, and finding the points on each plane."""

    stage: Callable[[Polyhedron, bool], growth.Grown | None]
    satisfied: Callable[[Equations, PointTable], list[NDArray[np.int64]]]


PLAIN = Steps(growth.stage, lambda table, points: table.satisfied(points.coordinates))


def choose(arithmetic: Arithmetic, points: PointTable, slack: Slack | None, fast: bool | None) -> Steps:
    """Choose between numpy and compiled code (the kernels) for the hull of these points.

    ``fast`` selects numpy (False) or the kernels (True). None selects the kernels if numba is installed and they save
    time, that is, for many points or if they are already loaded. Raise NotInstalled if ``fast`` is True and numba is
    missing.
    """
    if fast is False or not isinstance(arithmetic, FloatArithmetic) or not _in_range(arithmetic, points, slack):
        return PLAIN
    if fast is None and len(points) < _WORTH_LOADING and not load.cache_info().currsize:
        return PLAIN
    try:
        return load(arithmetic.name)
    except NotInstalled:
        if fast:
            raise
        return PLAIN


def _in_range(arithmetic: FloatArithmetic, points: PointTable, slack: Slack | None) -> bool:
    """Return True if no number of the procedure can overflow, which compiled code, unlike numpy, would not report.

    The largest numbers are squares of a plane's coefficients, at most 36 M**4 for coordinates up to M. A plane's value
    at a point is at most 24 M**3. The tolerance of an equation is e, or e times one of its coefficients.
    """
    limit = float(np.finfo(arithmetic.dtype).max)
    largest = max(1.0, float(abs(points.coordinates).max()))
    e = max(1.0, float(arithmetic.tolerance(slack.size, 0))) if slack else 1.0
    # 36**0.25 is 2.45, so a factor of 8 leaves room for rounding.
    return largest < limit**0.25 / 8 and e < limit / (8 * largest**2)


@cache
def load(name: str) -> Steps:
    """Return the two steps of program 3, compiled for ``float64`` or ``float32``.  Raise NotInstalled without numba."""
    # Arrays of one element tell numba the types.
    sample, sample_index = np.zeros((4, 1), name), np.zeros(1, np.int64)
    cloud = Cloud(sample[:3].copy(), sample_index, sample_index, sample_index)
    slots = Slots(sample, np.zeros((3, 1), np.int64), sample[0].copy(), np.ones(1, np.bool_))
    rules = Rules(sample[:3, 0].copy(), False, sample[0, 0], False, LISTED_PLANES, PLANES)
    # The kernels allocate no arrays, so numba need not count references.
    return with_kernels(
        Compiled(kernels.grow, _nrt=False).ready(
            cloud, slots, workspace.scratch_for(1, name), sample_index, rules, False, 1
        ),
        Compiled(kernels.satisfied, _nrt=False).ready(slots, cloud.coordinates, sample_index, sample_index),
    )


def with_kernels(grow: Function, find_satisfied: Function) -> Steps:
    """Return the two steps of program 3 that run the given kernels, compiled or as plain Python functions."""

    def stage(hull: Polyhedron, first: bool) -> growth.Grown | None:
        """Add the next vertex to the hull. If no history is recorded, add as many vertices as the kernel can add."""
        spare = 6 * len(hull.table) + _SPARE_SLOTS + len(hull.points) // _POINTS_PER_SLOT
        cloud, slots, state = _cloud(hull), _slots(hull.table, spare), _state(hull)
        scratch = workspace.scratch_for(len(slots.alive), slots.coefficients.dtype)
        code = grow(cloud, slots, scratch, state, _rules(hull), first, -1 if hull.progress.history is None else 1)
        _store_state(hull, cloud, slots, state)
        # The kernel completed no stage. Unless the hull is finished, numpy runs this one, which raises any error.
        if not state[workspace.STAGES]:
            return None if code == kernels.ENDED else growth.stage(hull, first)
        eliminated = cloud.eliminated[: state[workspace.GONE]].tolist()
        if first:
            return growth.Grown(hull.points.input_indices(slice(0, _H1_VERTICES)), 0, 0, eliminated)
        return growth.Grown(
            (int(state[workspace.ADDED]),), hull.to_check + 1, int(state[workspace.OUTSIDE]), eliminated
        )

    def satisfied(table: Equations, points: PointTable) -> list[NDArray[np.int64]]:
        slots, coordinates = _slots(table, 0), np.array(points.coordinates, order="C")
        counts, indices = np.empty(len(table), np.int64), np.empty(4 * len(table), np.int64)
        # Room for four points on each plane is enough for most hulls. Otherwise repeat with the exact number.
        if (count := find_satisfied(slots, coordinates, counts, indices)) > len(indices):
            indices = np.empty(count, np.int64)
            find_satisfied(slots, coordinates, counts, indices)
        ends = np.cumsum(counts).tolist()
        return [indices[start:end] for start, end in zip([0, *ends], ends, strict=False)]

    return Steps(stage, satisfied)


def _cloud(hull: Polyhedron) -> Cloud:
    points, serial = hull.points, hull.table.serial
    keeper_serial = hull.remaining.keeper
    keeper_slot = np.searchsorted(serial, keeper_serial)
    keeper_slot[keeper_slot == len(serial)] = 0
    keeper = np.full(len(points), -1, np.int64)
    keeper[hull.vertices :] = np.where(serial[keeper_slot] == keeper_serial, keeper_slot, -1)
    # Copies in C order: for each other layout numba would compile the kernels again.
    return Cloud(
        np.array(points.coordinates, order="C"), points.input_index.copy(), keeper, np.empty(len(points), np.int64)
    )


def _slots(table: Equations, spare: int) -> Slots:
    """Return the planes in the array form of the kernels, with ``spare`` empty slots after them."""
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
    state[workspace.COUNT], state[workspace.VERTICES] = len(hull.points), hull.vertices
    state[workspace.CHECK] = state[workspace.CHECKED] = hull.to_check
    state[workspace.MADE] = state[workspace.ALIVE] = len(hull.table)
    state[workspace.TRIED] = np.searchsorted(hull.table.serial, hull.remaining.tried)
    state[workspace.STRUCK] = hull.remaining.eliminated_any
    state[workspace.KNOWN] = sum(bit for name, bit in _CORRECTIONS.items() if name in hull.progress.corrected)
    return state


def _rules(hull: Polyhedron) -> Rules:
    number, slack = hull.arithmetic.dtype, hull.table.slack
    centre = np.array(hull.centre or (0, 0, 0), number)
    size = number(-1) if slack is None else hull.arithmetic.tolerance(slack.size, 0)
    return Rules(centre, hull.centre is None, size, slack is not None and slack.relative, LISTED_PLANES, PLANES)


def _store_state(hull: Polyhedron, cloud: Cloud, slots: Slots, state: NDArray[np.int64]) -> None:
    """Copy the points and planes of the compiled code back into the hull, and number the planes by their slots."""
    count, made = state[workspace.COUNT], state[workspace.MADE]
    remaining_slots = np.flatnonzero(slots.alive[:made])
    points, table, remaining = hull.points, hull.table, hull.remaining
    points.coordinates, points.input_index = cloud.coordinates[:, :count], cloud.input_index[:count]
    table.coefficients, table.defining = slots.coefficients[:, remaining_slots], slots.defining[:, remaining_slots]
    table.serial, table.made = remaining_slots, int(made)
    if table.tolerances is not None:
        table.tolerances = slots.tolerances[remaining_slots]
    if state[workspace.KNOWN] & workspace.TABLE:
        hull.progress.correct(TABLE_OF_PLANES)
    hull.vertices, hull.to_check = int(state[workspace.VERTICES]), int(state[workspace.CHECKED])
    remaining.keeper, remaining.tried = cloud.keeper[hull.vertices : count], int(state[workspace.TRIED])
    remaining.eliminated_any = bool(state[workspace.STRUCK])
