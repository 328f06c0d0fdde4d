"""The whole method: duplicates, inside corners, convex edges, loops, map."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from modern.exact_hull.coordinates import Points, common_scale, read_points, to_integers
from modern.geometry.vectors import cross, dot, minus
from modern.papers.appel_will.corners import Preprocessing, Rule, preprocess
from modern.papers.appel_will.edges import Deleted, IntPoint, Pair, convex_edges
from modern.papers.appel_will.loops import PREFERRED, LoopTable, Rules, find_loops, surface
from modern.papers.appel_will.star import StarTest, as_printed, in_one_pass
from modern.papers.appel_will.surfaces import Fates, Surface, area_normal, check_surfaces, fates


@dataclass(frozen=True, slots=True)
class Method:
    """Which star polygon test and which reading of the appendix; a rule for inside corners, or none."""

    star: StarTest = in_one_pass
    rules: Rules = PREFERRED
    inside_corners: Rule | None = None


CORRECTED = Method()
PRINTED = ("star", "step3", "step5", "step7", "step9", "step10")
"""The rules that can be taken as printed: Fig. 12's, and steps of the appendix."""


def printed(*names: str) -> Method:
    """The method with these rules as printed, the others corrected.  Raises ValueError for an unknown name.

    ``star``: two images on one ray put C outside of the star polygon; ``step3``: the first L2 that will do is taken,
    none is preferred; ``step5``, ``step7``, ``step9``, ``step10``: see :class:`~modern.papers.appel_will.loops.Rules`.
    """
    unknown = [name for name in names if name not in PRINTED]
    if unknown:
        raise ValueError(f"{unknown[0]!r} is not one of {', '.join(PRINTED)}")
    steps = ("step5" in names, "step7" in names, "step9" in names, "step10" in names)
    return Method(as_printed if "star" in names else in_one_pass, Rules("step3" not in names, *steps))


LITERAL = printed(*PRINTED)
"""By the letter, all of it."""


@dataclass(frozen=True, slots=True)
class Assembled:
    """A hull assembled from its convex edges.  Points are named by index into the points as given, from 0.

    points: integers, the given coordinates times ``scale``; duplicates: (index, index of the first equal point);
    preprocessing: of inside corners, if it was asked for; deleted: points between two others, found in projections;
    edges: the convex edge list; table: its loops; surfaces: the topological map, a surface for each loop.
    dimension: of the points, 0 to 3.  Of a polygon the loop table has one loop and uses every edge once; of a
    segment or a point it is empty.
    """

    points: tuple[IntPoint, ...]
    scale: int
    duplicates: tuple[tuple[int, int], ...]
    preprocessing: Preprocessing | None
    deleted: tuple[Deleted, ...]
    projections: int
    edges: tuple[Pair, ...]
    table: LoopTable
    surfaces: tuple[Surface, ...]
    dimension: int

    @property
    def vertices(self) -> tuple[int, ...]:
        """The ends of the convex edges; of one point that point."""
        return tuple(sorted({end for edge in self.edges for end in edge})) or (0,)

    @property
    def fault(self) -> str:
        """Why edges and loops are no hull of this dimension, or nothing.  Only a literal method has faults."""
        v, e, f = len(self.vertices), len(self.edges), len(self.surfaces)
        if self.table.stopped:
            return self.table.stopped
        if self.dimension == 3 and not self.table.closed:
            return f"{sum(count != 2 for count in self.table.uses)} of {e} edges are not used twice"
        if self.dimension == 3 and v - e + f != 2:
            return f"V - E + F is {v} - {e} + {f} = {v - e + f}, not 2"
        if self.dimension == 2 and (f != 1 or any(count != 1 for count in self.table.uses)):
            return f"{e} edges and {f} loops do not make one polygon"
        return ""

    def outward(self) -> tuple[Surface, ...]:
        """The topological map with every surface counterclockwise seen from outside; of a polygon as it is."""
        turned = []
        for points in self.surfaces:
            normal, origin = area_normal(self.points, points), self.points[points[0]]
            above = any(dot(normal, minus(self.points[index], origin)) > 0 for index in self.vertices)
            turned.append((points[0], *points[:0:-1]) if above else points)
        return tuple(turned)

    def fates(self, given: Sequence[Surface]) -> Fates:
        """What became of the surfaces of the polyhedron (Fig. 4)."""
        return fates(self.points, given, self.surfaces)


def appel_will(points: Points, surfaces: Sequence[Surface] = (), method: Method = CORRECTED) -> Assembled:
    """The hull of at least one point, by Appel and Will's method, in exact arithmetic.

    points: (x, y, z) each, of ints, Fractions, decimal strings or floats (taken as the binary numbers they are).
    surfaces: the topological map of the polyhedron, where there is one; only preprocessing needs it.
    Raises PointsError for invalid points, MapError for invalid surfaces.
    """
    read = read_points(points)
    scale = common_scale(read)
    scaled = tuple(to_integers(read, scale))
    check_surfaces(len(scaled), surfaces)
    first: dict[IntPoint, int] = {}
    for index, point in enumerate(scaled):
        first.setdefault(point, index)
    duplicates = tuple((index, first[point]) for index, point in enumerate(scaled) if first[point] != index)
    live = set(first.values())
    preprocessing = None
    if method.inside_corners is not None:
        same = tuple(tuple(first[scaled[index]] for index in surface) for surface in surfaces)
        preprocessing = preprocess(scaled, same, method.inside_corners)
        live.difference_update(preprocessing.deleted)
    found = convex_edges(scaled, live, method.star)
    table = find_loops(scaled, found.edges, method.rules)
    return Assembled(
        scaled,
        scale,
        duplicates,
        preprocessing,
        found.deleted,
        found.projections,
        found.edges,
        table,
        tuple(surface(loop.entries, found.edges) for loop in table.loops),
        _dimension(list(first)),
    )


def _dimension(points: Sequence[IntPoint]) -> int:
    """The dimension of distinct points."""
    if len(points) == 1:
        return 0
    along = minus(points[1], points[0])
    normals = (cross(along, minus(point, points[0])) for point in points)
    normal = next((normal for normal in normals if any(normal)), None)
    if normal is None:
        return 1
    return 3 if any(dot(normal, minus(point, points[0])) for point in points) else 2
