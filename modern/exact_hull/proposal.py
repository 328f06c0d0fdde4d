"""A hull proposed quickly: triangles, to be proved by the certificate or else refused.

The points are rounded to a grid of 2**30 steps an axis (coordinates that fit it are taken as they are), and the hull
of the rounded points is built in rounds: every triangle names the farthest of the points that wait outside of it
(Barber, Dobkin and Huhdanpaa, ACM Transactions on Mathematical Software 22 (1996), 469-483), and of the points named
those are inserted together whose seen triangles neither overlap nor touch along an edge.  So every edge of the new
surface has two triangles that stand side by side in the hull with one of these points alone, and the surface is
convex again.  For the same reason a point that waited at a triangle now gone is tried against the triangles of the
point that removed it, and against no others.  "Sees" is strict, as in :mod:`modern.exact_hull.surface`.

Signs on the grid are exact: in float64 where a value is plainly not 0, otherwise in two int64.  A normal is a vector
product of differences below 2**30, so below 2**61; with N = 2**31 H + L its value at a difference d is
2**31 (H.d) + L.d, and both scalar products are below 2**63.  A computed value, divided by |A| + |B| + |C|, is off by
at most 16 * 2**30 * 2**-53 = 2**-19.

With numba (extra ``fast``) the same hull is found one point at a time (:mod:`modern.exact_hull.kernels`).

Nothing here need be right: what is proposed is proved afterwards.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from emulator.jit.functions import Compiled, Function, NotInstalled
from modern.exact_hull import kernels
from modern.exact_hull.coordinates import IntPoint, columns_of
from modern.exact_hull.kernels import DOUBT, LOW, NEAR

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Flags = NDArray[np.bool_]

GRID_BITS = 30
_VERY_MANY = 500_000
"""Points from which on loading the kernel costs less than it saves."""
_DENSE = 24
"""Up to so many new triangles all points that lost theirs are tried against all of them, by a product of matrices."""


@dataclass(frozen=True, slots=True)
class Proposal:
    """Triangles (m, 3), counterclockwise from outside, and the points besides their corners that may lie on them."""

    triangles: Ints
    near: Ints


def on_grid(points: Sequence[IntPoint]) -> tuple[Ints, bool]:
    """The points from 0 to 2**30 - 1 an axis (n, 3), and whether they are the points themselves, moved."""
    grid, exact = np.empty((len(points), 3), np.int64), True
    for axis, column in enumerate(columns_of(points)):
        low, high = int(column.min()), int(column.max())
        shift = max(0, (high - low).bit_length() - GRID_BITS)
        grid[:, axis] = (column - low) >> shift
        exact = exact and shift == 0
    return grid, exact


def propose(points: Sequence[IntPoint], fast: bool | None = None) -> Proposal | None:
    """The hull of points, or None where none is found.

    ``fast``: by the compiled kernel; None: if it is loaded, or points are very many and numba is there.
    Raises NotInstalled.
    """
    grid, exact = on_grid(points)
    start = _simplex(grid)
    if start is None:
        return None
    kernel = _chosen(fast, len(points))
    if kernel:
        known, work = kernels.surface(grid), kernels.room(len(grid))
        corners = known.corners[: kernel(known, work, np.array(start), exact)]
        return Proposal(corners[corners[:, 0] >= 0], np.flatnonzero(work.near)) if len(corners) else None
    growing = _Growing(grid, exact, start)
    while growing.waiting.size:
        if not growing.round():
            return None
    near = np.concatenate(growing.near) if growing.near else np.empty(0, np.int64)
    triangles = growing.corners[: growing.made][growing.alive[: growing.made]]
    return Proposal(triangles, near)


@cache
def load() -> Function:
    """The kernel, compiled (seconds, once) or loaded.  Raises NotInstalled."""
    some = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], np.int64)
    # No array is made: numba need not count the users of each it is given.
    return Compiled(kernels.grow, _nrt=False).ready(kernels.surface(some), kernels.room(4), np.arange(4), True)


def _chosen(fast: bool | None, count: int) -> Function | None:
    if fast or (fast is None and (count >= _VERY_MANY or load.cache_info().currsize)):
        try:
            return load()
        except NotInstalled:
            if fast:
                raise
    return None


def _simplex(grid: Ints) -> list[int] | None:
    """Four points not in one plane, far from each other; the fourth inside of the others' plane."""
    axis = int(np.ptp(grid, axis=0).argmax())
    a, b = int(grid[:, axis].argmin()), int(grid[:, axis].argmax())
    places = grid - grid[a]
    floats = places.astype(np.float64)
    along = floats[b]
    c = int((np.cross(floats, along) ** 2).sum(axis=1).argmax())
    normal = np.cross(places[b], places[c])
    if not normal.any():
        return None
    d = int(abs(floats @ normal.astype(np.float64)).argmax())
    side = int(exact_signs(normal[None], places[d][None])[0])
    if not side:
        return None
    return [a, b, c, d] if side < 0 else [a, c, b, d]


def exact_signs(normals: Ints, differences: Ints) -> Ints:
    """Signs of the scalar products of rows: normals below 2**61, differences below 2**30."""
    high = ((normals >> 31) * differences).sum(axis=1)
    low = ((normals & LOW) * differences).sum(axis=1)
    high += low >> 31
    low &= LOW
    return np.asarray(np.where(high == 0, low > 0, np.sign(high)), np.int64)


class _Growing:
    """The surface so far, in arrays over triangle numbers (removed ones keep theirs), and the points that wait.

    corners, neighbours (T, 3): the triangle beyond the edge from corner k to the next; normals; images (T, 4): the
    plane over its |A| + |B| + |C|.  waiting: points, each with a triangle it sees (``home``) and its value there.
    near: points set aside as not outside that may lie on the surface.
    """

    def __init__(self, grid: Ints, exact: bool, start: list[int]) -> None:
        self.grid = grid
        self.exact = exact
        self.places = np.ones((len(grid), 4))
        self.places[:, :3] = grid
        room = 64
        self.corners = np.empty((room, 3), np.int64)
        self.neighbours = np.empty((room, 3), np.int64)
        self.normals = np.empty((room, 3), np.int64)
        self.images = np.empty((room, 4))
        self.alive = np.zeros(room, np.bool_)
        self.made = 0
        self.near: list[Ints] = []
        a, b, c, d = start
        corners = np.array([(a, b, c), (b, a, d), (c, b, d), (a, c, d)], np.int64)
        self._add(corners, np.array([(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)], np.int64))
        rest = np.ones(len(grid), np.bool_)
        rest[start] = False
        self.waiting, self.home, self.height = self._tried_against_all(np.flatnonzero(rest), 0)

    def _add(self, corners: Ints, neighbours: Ints) -> None:
        """Triangles with the next numbers."""
        end = self.made + len(corners)
        while end > len(self.alive):
            for name in ("corners", "neighbours", "normals", "images", "alive"):
                array = getattr(self, name)
                setattr(self, name, np.concatenate([array, np.zeros_like(array)]))
        p, q, r = (self.grid[corners[:, k]] for k in range(3))
        (u1, u2, u3), (v1, v2, v3) = (q - p).T, (r - p).T
        normals = np.stack([u2 * v3 - u3 * v2, u3 * v1 - u1 * v3, u1 * v2 - u2 * v1], axis=1)
        new = slice(self.made, end)
        self.corners[new], self.neighbours[new], self.normals[new] = corners, neighbours, normals
        images = normals / np.maximum(1, abs(normals).sum(axis=1))[:, None]
        self.images[new, :3] = images
        self.images[new, 3] = -(images * p).sum(axis=1)
        self.alive[new] = True
        self.made = end

    def _signed(self, values: Floats, points: Ints, triangles: Ints) -> Floats:
        """The values, those in doubt replaced by their sign times the smallest there is."""
        doubtful = np.flatnonzero(abs(values) <= DOUBT)
        if doubtful.size:
            who, where = points[doubtful], triangles[doubtful]
            differences = self.grid[who] - self.grid[self.corners[where, 0]]
            values[doubtful] = exact_signs(self.normals[where], differences) * 1e-300
        return values

    def _set_aside(self, points: Ints, largest: Floats) -> None:
        """Note those of the points, which are not outside, that may be on the surface."""
        self.near.append(points[largest == 0] if self.exact else points[largest >= NEAR])

    def _tried_against_all(self, points: Ints, first: int) -> tuple[Ints, Ints, Floats]:
        """Which of the points see triangles from ``first`` on, the one each sees best, and its value there."""
        triangles = np.arange(first, self.made)
        chosen, largest = np.empty(len(points), np.int64), np.empty(len(points))
        step = max(1, (1 << 16) // len(triangles))
        for start in range(0, len(points), step):
            block = slice(start, start + step)
            values = self.places[points[block]] @ self.images[first : self.made].T
            rows, columns = np.nonzero(abs(values) <= DOUBT)
            if rows.size:
                values[rows, columns] = self._signed(values[rows, columns], points[block][rows], triangles[columns])
            best = values.argmax(axis=1)
            chosen[block], largest[block] = best + first, values[np.arange(len(values)), best]
        outside = largest > 0
        self._set_aside(points[~outside], largest[~outside])
        return points[outside], chosen[outside], largest[outside]

    def _tried_against_own(self, points: Ints, remover: Ints, starts: Ints, counts: Ints) -> tuple[Ints, Ints, Floats]:
        """The same, each point against the triangles of the point that removed its own: ``counts`` from ``starts``."""
        many = counts[remover]
        ends = np.cumsum(many)
        who = np.repeat(np.arange(len(points)), many)
        triangles = np.arange(len(who)) + np.repeat(starts[remover] - (ends - many), many)
        places, images = self.places[points][who], self.images[triangles]
        values = self._signed(np.einsum("ij,ij->i", places, images), points[who], triangles)
        largest = np.maximum.reduceat(values, ends - many)
        chosen = np.empty(len(points), np.int64)
        best = values == largest[who]
        chosen[who[best]] = triangles[best]
        outside = largest > 0
        self._set_aside(points[~outside], largest[~outside])
        return points[outside], chosen[outside], largest[outside]

    def round(self) -> bool:
        """Insert some of the points that wait; False where the surface is found not to be one."""
        named, at = self._named()
        place, seen, edge_place, edge_from, edge = self._regions(named, at)
        beyond = self.neighbours[edge_from, edge]
        # Of points in each other's way the later named goes first: it keeps what it sees and what is next to that.
        owner = np.full(self.made, -1)
        np.maximum.at(owner, seen, place)
        good = np.ones(len(named), np.bool_)
        good[place[owner[seen] != place]] = False
        good[edge_place[owner[beyond] > edge_place]] = False
        chosen = good[edge_place]
        edge_place, edge_from, edge, beyond = edge_place[chosen], edge_from[chosen], edge[chosen], beyond[chosen]
        removed = seen[good[place]]
        self.alive[removed] = False
        start, end = self.corners[edge_from, edge], self.corners[edge_from, (edge + 1) % 3]
        order = np.argsort(edge_place * len(self.grid) + start)
        edge_place, start, end, beyond = edge_place[order], start[order], end[order], beyond[order]
        leaving, arriving = edge_place * len(self.grid) + start, edge_place * len(self.grid) + end
        following = np.searchsorted(leaving, arriving)
        if (leaving[1:] == leaving[:-1]).any() or (leaving[following.clip(max=len(leaving) - 1)] != arriving).any():
            return False
        first = self.made
        before = np.empty_like(following)
        before[following] = np.arange(len(following))
        slot = (self.corners[beyond] == end[:, None]).argmax(axis=1)
        self.neighbours[beyond, slot] = first + np.arange(len(beyond))
        self._add(
            np.stack([start, end, named[edge_place]], axis=1),
            np.stack([beyond, first + following, first + before], axis=1),
        )
        self._wait_anew(owner, named[good], edge_place, first)
        return True

    def _named(self) -> tuple[Ints, Ints]:
        """Points to insert and the triangles that name them, no two of which are neighbours; highest last."""
        highest = np.full(self.made, -1.0)
        np.maximum.at(highest, self.home, self.height)
        top = self.height == highest[self.home]
        name = np.full(self.made, -1)
        name[self.home[top]] = self.waiting[top]
        at = np.flatnonzero(name >= 0)
        at = at[(highest[self.neighbours[at]] <= highest[at, None]).all(axis=1)]
        at = at[np.argsort(highest[at], kind="stable")]
        # A point waits at one triangle, so none is named twice.
        return name[at], at

    def _regions(self, named: Ints, at: Ints) -> tuple[Ints, Ints, Ints, Ints, Ints]:
        """All that the points see: pairs (point, triangle), and the edges of these regions (point, triangle, edge)."""
        size = self.made
        place, triangle = np.arange(len(named)), at
        keys = place * size + triangle
        known = keys
        seen_keys = [keys]
        while keys.size:
            beyond = (keys // size * size)[:, None] + self.neighbours[keys % size]
            fresh = np.unique(beyond)
            fresh = fresh[known[np.searchsorted(known, fresh).clip(max=len(known) - 1)] != fresh]
            points, triangles = named[fresh // size], fresh % size
            values = np.einsum("ij,ij->i", self.places[points], self.images[triangles])
            keys = fresh[self._signed(values, points, triangles) > 0]
            seen_keys.append(keys)
            known = np.union1d(known, fresh)
        found = np.sort(np.concatenate(seen_keys))
        place, triangle = found // size, found % size
        beyond = (place * size)[:, None] + self.neighbours[triangle]
        border = found[np.searchsorted(found, beyond).clip(max=len(found) - 1)] != beyond
        row, edge = np.nonzero(border)
        return place, triangle, place[row], triangle[row], edge

    def _wait_anew(self, owner: Ints, inserted: Ints, edge_place: Ints, first: int) -> None:
        """The points whose triangles are gone are tried against new ones."""
        lost = ~self.alive[self.home]
        orphans, remover = self.waiting[lost], owner[self.home[lost]]
        done = np.zeros(len(self.grid), np.bool_)
        done[inserted] = True
        still = ~done[orphans]
        orphans, remover = orphans[still], remover[still]
        if self.made - first <= _DENSE:
            news = self._tried_against_all(orphans, first)
        elif orphans.size:
            counts = np.bincount(edge_place)
            starts = first + np.cumsum(counts) - counts
            news = self._tried_against_own(orphans, remover, starts, counts)
        else:
            news = orphans, orphans, np.empty(0)
        self.waiting = np.concatenate([self.waiting[~lost], news[0]])
        self.home = np.concatenate([self.home[~lost], news[1]])
        self.height = np.concatenate([self.height[~lost], news[2]])
