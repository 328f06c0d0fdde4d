"""Find a hull of many points quickly, as triangles.  The certificate then proves it or rejects it.

The hull grows in rounds.  In each round every triangle nominates the farthest of the points that wait outside it
(Barber, Dobkin and Huhdanpaa, ACM Transactions on Mathematical Software 22 (1996), 469-483).  Nominated points are
inserted together if the regions of triangles that they see neither overlap nor share an edge.  Every edge of the new
surface then has two triangles that would also be adjacent if only one of these points had been inserted, so the surface
is convex again.  For the same reason a point that waits at a removed triangle is compared only with the triangles of
the point that removed it.  A point sees a triangle if it is strictly outside the triangle's plane, as in
:mod:`modern.exact_hull.surface`.

With numba (extra ``fast``) the same hull grows one point at a time (:mod:`modern.exact_hull.kernels`), if doubles hold
the points exactly.

Errors in this module cannot cause a wrong result, because every proposal is proved afterwards.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from emulator.jit.functions import Compiled, Function, NotInstalled
from modern.exact_hull import kernels
from modern.exact_hull.coordinates import Coordinates, Floats, Ints
from modern.exact_hull.facets import planes_of
from modern.exact_hull.planes import Planes

# Signs of planes at points are exact.  They are computed from the images u of the points (``Coordinates.images``), with
# errors of at most e = 2**-54.  Let w <= 1 be the largest side of a triangle on any axis.  Its sides have errors of at
# most 3e, a product of two sides 7e w, and a number of the vector product 20e w, also rounded.  The vector product is
# divided by the power of two s that makes its largest number at most 1.  So the value of the plane at a point has an
# error of 60e w / s from the normal and 46e from its evaluation (see ``planes``), less than 2**-47 (1 + w / s).
_BOUND = 2.0**-47
# Doubles hold the points and all products of three coordinates if these have at most this number of bits.
_DOUBLE_BITS, _PRODUCT_BITS = 53, 1000
# The number of points from which the compiled kernel saves more time than it takes to load.
_VERY_MANY = 500_000
# The largest number of new triangles for which one matrix product compares all points with all of them.
_DENSE = 24


@dataclass(frozen=True, slots=True)
class Proposal:
    """A hull that is not proved yet: triangles, shape (m, 3), counterclockwise seen from outside.

    ``near`` lists points that are not corners but may lie on the surface.  For each of them, ``at`` has a triangle
    whose plane probably contains the point, or -1.
    """

    triangles: Ints
    near: Ints
    at: Ints


def _proposal(corners: Ints, alive: NDArray[np.bool_], near: Ints, at: Ints) -> Proposal:
    numbers = np.where(alive, np.cumsum(alive) - 1, -1)
    return Proposal(corners[alive], near, numbers[at])


def in_doubles(points: Coordinates) -> Floats | None:
    """Return the points scaled by a power of two on each axis, or None if doubles cannot hold them exactly.

    On each axis, scaled points differ by at most 1.
    """
    shifts, power, numbers = np.array(points.images.shifts), points.scale.bit_length() - 1, points.numbers
    if points.kind == "i" and shifts.max() <= _DOUBLE_BITS:
        return points.images.places
    if points.kind == "i":
        power, numbers = 0, numbers.astype(np.float64)
        with np.errstate(invalid="ignore"):
            exact = bool((numbers.astype(np.int64) == points.numbers).all())
    else:
        exact = points.kind == "f" and shifts.sum() <= _PRODUCT_BITS
    return np.ldexp(numbers, power - shifts) if exact else None


def propose(points: Coordinates, basis: Sequence[int], fast: bool | None = None) -> Proposal | None:
    """Return a hull that still has to be proved, or None if none was found.

    basis: the indices of four points that do not lie in a plane. fast: True to use compiled code, False to use numpy,
    None to let the program choose.
    """
    start = _simplex(points, basis)
    exact = points.images.are_small
    kernel = _chosen(fast, len(points))
    if kernel and (places := in_doubles(points)) is not None:
        known, work = kernels.surface(places, exact), kernels.room(len(places))
        corners = known.corners[: kernel(known, work, np.array(start))]
        near = np.flatnonzero(work.near >= 0)
        return _proposal(corners, corners[:, 0] >= 0, near, work.near[near]) if len(corners) else None
    # Without numba: in rounds of numpy operations.
    growing = _Growing(points, exact, start)
    while growing.waiting.size:
        if not growing.round():
            return None
    made, (near, at) = growing.made, np.concatenate(growing.near, axis=1)
    return _proposal(growing.corners[:made], growing.alive[:made], near, at)


@cache
def load() -> Function:
    """Return the compiled kernel.  The first call may take seconds to compile it.  Raise NotInstalled without numba."""
    tetrahedron = np.array([(0.0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    # The kernel allocates no array, so numba need not count references.
    known = kernels.surface(tetrahedron, True)
    return Compiled(kernels.grow, _nrt=False).ready(known, kernels.room(4), np.array([0, 2, 1, 3]))


def _chosen(fast: bool | None, count: int) -> Function | None:
    if fast or (fast is None and (count >= _VERY_MANY or load.cache_info().currsize)):
        try:
            return load()
        except NotInstalled:
            if fast:
                raise
    return None


def _simplex(points: Coordinates, basis: Sequence[int]) -> list[int]:
    """Return four points that are far from each other, or ``basis`` if those four seem to lie in a plane."""
    # a and b are the extreme points on an axis, c is farthest from their line, d from the plane of a, b and c.
    places = points.images.places
    a, b = int(places[:, 0].argmin()), int(places[:, 0].argmax())
    steps = places - places[a]
    c = int((np.cross(steps, steps[b]) ** 2).sum(axis=1).argmax())
    d = int(abs(steps @ np.cross(steps[b], steps[c])).argmax())
    side, corners = 0, np.array([(a, b, c, d), basis])
    # The four points may lie in a plane because images are rounded.
    for four in corners:
        with suppress(ValueError):
            side = int(_exact_planes(points, four[None, :3]).exact(np.array([0]), four[3:])[0])
            if side:
                break
    p, q, r, s = four.tolist()
    return [p, q, r, s] if side < 0 else [p, r, q, s]


def _exact_planes(points: Coordinates, corners: Ints) -> Planes:
    return Planes(points, planes_of(corners, points), corners[:, 0])


class _Growing:
    """The surface while it grows, as arrays of triangles, and the points that wait outside it.

    A removed triangle keeps its index.  For each of the T triangles, ``corners`` (T, 3) has the corners,
    counterclockwise seen from outside, and ``neighbours`` (T, 3) has the triangle beyond each edge.  ``images`` (T, 4)
    has the plane of each triangle, scaled so that A, B and C are at most 1 in absolute value, and ``bounds`` has a
    bound for the error of this plane's values.  ``waiting`` lists the points outside the surface.  For each of them,
    ``home`` has a triangle that the point sees, and ``height`` has the value of this triangle's plane at the point.
    ``near`` is a list of arrays of two rows: points that lay on the surface when they were last compared with
    triangles, and for each a triangle in whose plane it lay.
    """

    def __init__(self, points: Coordinates, exact: bool, start: list[int]) -> None:
        self.points = points
        self.exact = exact
        self.places = np.ones((len(points), 4))
        self.places[:, :3] = points.images.places
        room = 64
        self.corners = np.empty((room, 3), np.int64)
        self.neighbours = np.empty((room, 3), np.int64)
        self.images = np.empty((room, 4))
        self.bounds = np.empty(room)
        self.alive = np.zeros(room, np.bool_)
        self.made = 0
        self.near: list[Ints] = []
        a, b, c, d = start
        corners = np.array([(a, b, c), (b, a, d), (c, b, d), (a, c, d)], np.int64)
        self._add(corners, np.array([(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)], np.int64))
        rest = np.ones(len(points), np.bool_)
        rest[start] = False
        self.waiting, self.home, self.height = self._tried_against_all(np.flatnonzero(rest), 0)

    def _add(self, corners: Ints, neighbours: Ints) -> None:
        end = self.made + len(corners)
        while end > len(self.alive):
            for name in ("corners", "neighbours", "images", "bounds", "alive"):
                array = getattr(self, name)
                setattr(self, name, np.concatenate([array, np.zeros_like(array)]))
        p, q, r = (self.places[corners[:, k], :3] for k in range(3))
        u, v = q - p, r - p
        (u1, u2, u3), (v1, v2, v3) = u.T, v.T
        normals = np.stack([u2 * v3 - u3 * v2, u3 * v1 - u1 * v3, u1 * v2 - u2 * v1], axis=1)
        new = slice(self.made, end)
        self.corners[new], self.neighbours[new] = corners, neighbours
        # A normal without a clear direction gets a bound that no value exceeds.
        exponents = np.frexp(abs(normals).max(axis=1))[1]
        images = np.ldexp(normals, -exponents[:, None])
        self.images[new, :3] = images
        self.images[new, 3] = -(images * p).sum(axis=1)
        widths = np.maximum(abs(u), abs(v)).max(axis=1)
        self.bounds[new] = 0.0 if self.exact else _BOUND * (1 + np.ldexp(widths, np.minimum(-exponents, 1000)))
        self.alive[new] = True
        self.made = end

    def _signed(self, values: Floats, points: Ints, triangles: Ints) -> Floats:
        """Return values of planes at points.  A value whose sign is in doubt becomes its exact sign times 1e-300."""
        doubtful = np.flatnonzero(~(abs(values) > self.bounds[triangles]))
        if doubtful.size and not self.exact:
            distinct, places = np.unique(triangles[doubtful], return_inverse=True)
            planes = _exact_planes(self.points, self.corners[distinct])
            values[doubtful] = planes.exact(places, points[doubtful]) * 1e-300
        return values

    def _outside(self, points: Ints, chosen: Ints, largest: Floats) -> tuple[Ints, Ints, Floats]:
        on, outside = largest == 0, largest > 0
        self.near.append(np.stack([points[on], chosen[on]]))
        return points[outside], chosen[outside], largest[outside]

    def _tried_against_all(self, points: Ints, first: int) -> tuple[Ints, Ints, Floats]:
        """Compare each point with all triangles from index ``first`` on.

        Return the points that are outside of at least one of them.  For each, return also the triangle whose plane has
        the largest value at the point, and that value.
        """
        triangles = np.arange(first, self.made)
        chosen, largest = np.empty(len(points), np.int64), np.empty(len(points))
        step = max(1, (1 << 16) // len(triangles))
        for start in range(0, len(points), step):
            block = slice(start, start + step)
            values = self.places[points[block]] @ self.images[first : self.made].T
            rows, columns = np.nonzero(~(abs(values) > self.bounds[first : self.made]))
            if rows.size:
                values[rows, columns] = self._signed(values[rows, columns], points[block][rows], triangles[columns])
            best = values.argmax(axis=1)
            chosen[block], largest[block] = best + first, values[np.arange(len(values)), best]
        return self._outside(points, chosen, largest)

    def _tried_against_own(self, points: Ints, remover: Ints, starts: Ints, counts: Ints) -> tuple[Ints, Ints, Floats]:
        """Compare each waiting point only with the new triangles of the inserted point that removed its triangle.

        For each of ``points``, ``remover`` has the rank of the inserted point that removed its triangle.  For each
        rank, ``starts`` has the first triangle that the inserted point made, and ``counts`` has the number of its
        triangles.  The result has the same form as that of ``_tried_against_all``.
        """
        # Make one row for each pair of a point and a new triangle of the point that removed its triangle.
        pairs = counts[remover]
        ends = np.cumsum(pairs)
        row_point = np.repeat(np.arange(len(points)), pairs)
        triangles = np.arange(len(row_point)) + np.repeat(starts[remover] - (ends - pairs), pairs)
        places, images = self.places[points][row_point], self.images[triangles]
        values = self._signed(np.einsum("ij,ij->i", places, images), points[row_point], triangles)
        largest = np.maximum.reduceat(values, ends - pairs)
        chosen = np.empty(len(points), np.int64)
        best = values == largest[row_point]
        chosen[row_point[best]] = triangles[best]
        return self._outside(points, chosen, largest)

    def round(self) -> bool:
        """Insert several waiting points that see neither the same triangles nor neighbouring ones.

        Return False if the surface is no longer closed.
        """
        nominated, at = self._nominated()
        rank, visible, edge_rank, edge_from, edge = self._regions(nominated, at)
        beyond = self.neighbours[edge_from, edge]
        # If two points conflict, the one nominated later (the higher one) is inserted: it owns the triangles that it
        # sees.  A point is dropped for this round if it does not own all triangles that it sees, or if a later point
        # owns a triangle next to them.
        owner = np.full(self.made, -1)
        np.maximum.at(owner, visible, rank)
        accepted = np.ones(len(nominated), np.bool_)
        accepted[rank[owner[visible] != rank]] = False
        accepted[edge_rank[owner[beyond] > edge_rank]] = False
        chosen = accepted[edge_rank]
        edge_rank, edge_from, edge, beyond = edge_rank[chosen], edge_from[chosen], edge[chosen], beyond[chosen]
        removed = visible[accepted[rank]]
        self.alive[removed] = False
        # The horizon of each point must be one cycle: sort its edges by start, and find for each end the edge that
        # starts there.
        start, end = self.corners[edge_from, edge], self.corners[edge_from, (edge + 1) % 3]
        order = np.argsort(edge_rank * len(self.places) + start)
        edge_rank, start, end, beyond = edge_rank[order], start[order], end[order], beyond[order]
        leaving, arriving = edge_rank * len(self.places) + start, edge_rank * len(self.places) + end
        following = np.searchsorted(leaving, arriving)
        if (leaving[1:] == leaving[:-1]).any() or (leaving[following.clip(max=len(leaving) - 1)] != arriving).any():
            return False
        # One new triangle for each edge, linked with the triangle beyond and with its neighbours in the cycle.
        first = self.made
        before = np.empty_like(following)
        before[following] = np.arange(len(following))
        slot = (self.corners[beyond] == end[:, None]).argmax(axis=1)
        self.neighbours[beyond, slot] = first + np.arange(len(beyond))
        self._add(
            np.stack([start, end, nominated[edge_rank]], axis=1),
            np.stack([beyond, first + following, first + before], axis=1),
        )
        self._reassign(owner, nominated[accepted], edge_rank, first)
        return True

    def _nominated(self) -> tuple[Ints, Ints]:
        """Return points that are farther outside than any point at a neighbouring triangle, and their triangles."""
        highest = np.full(self.made, -1.0)
        np.maximum.at(highest, self.home, self.height)
        top = self.height == highest[self.home]
        nominee = np.full(self.made, -1)
        nominee[self.home[top]] = self.waiting[top]
        at = np.flatnonzero(nominee >= 0)
        at = at[(highest[self.neighbours[at]] <= highest[at, None]).all(axis=1)]
        at = at[np.argsort(highest[at], kind="stable")]
        # A point waits at one triangle, so it is nominated only once.
        return nominee[at], at

    def _regions(self, nominated: Ints, at: Ints) -> tuple[Ints, Ints, Ints, Ints, Ints]:
        """Return the triangles that each nominated point is outside of, and the edges around them (the horizon).

        The result has pairs (rank, triangle) and triples (rank, triangle, edge).  The rank is an index into
        ``nominated``.
        """
        # A pair is encoded as the integer rank * size + triangle, so that sets of pairs are sorted arrays.
        size = self.made
        rank, triangle = np.arange(len(nominated)), at
        keys = rank * size + triangle
        examined = keys
        visible_keys = [keys]
        # All regions grow at once, by one ring of triangles in each pass.
        while keys.size:
            beyond = (keys // size * size)[:, None] + self.neighbours[keys % size]
            fresh = np.unique(beyond)
            fresh = fresh[examined[np.searchsorted(examined, fresh).clip(max=len(examined) - 1)] != fresh]
            points, triangles = nominated[fresh // size], fresh % size
            values = np.einsum("ij,ij->i", self.places[points], self.images[triangles])
            keys = fresh[self._signed(values, points, triangles) > 0]
            visible_keys.append(keys)
            examined = np.union1d(examined, fresh)
        visible = np.sort(np.concatenate(visible_keys))
        rank, triangle = visible // size, visible % size
        # An edge belongs to the horizon if the triangle beyond it is not visible from the same point.
        beyond = (rank * size)[:, None] + self.neighbours[triangle]
        border = visible[np.searchsorted(visible, beyond).clip(max=len(visible) - 1)] != beyond
        row, edge = np.nonzero(border)
        return rank, triangle, rank[row], triangle[row], edge

    def _reassign(self, owner: Ints, inserted: Ints, edge_rank: Ints, first: int) -> None:
        """Assign each point that waited at a removed triangle to a new triangle (``first`` or higher), or drop it."""
        lost = ~self.alive[self.home]
        orphans, remover = self.waiting[lost], owner[self.home[lost]]
        done = np.zeros(len(self.places), np.bool_)
        done[inserted] = True
        still_waiting = ~done[orphans]
        orphans, remover = orphans[still_waiting], remover[still_waiting]
        if self.made - first <= _DENSE:
            reassigned = self._tried_against_all(orphans, first)
        elif orphans.size:
            counts = np.bincount(edge_rank)
            starts = first + np.cumsum(counts) - counts
            reassigned = self._tried_against_own(orphans, remover, starts, counts)
        else:
            reassigned = orphans, orphans, np.empty(0)
        self.waiting = np.concatenate([self.waiting[~lost], reassigned[0]])
        self.home = np.concatenate([self.home[~lost], reassigned[1]])
        self.height = np.concatenate([self.height[~lost], reassigned[2]])
