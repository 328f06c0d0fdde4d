"""Appel and Will's complete method: delete points, find the convex edges, and assemble them into borders of faces."""

from collections.abc import Sequence
from dataclasses import dataclass

from emulator.errors import quoted
from modern.exact_hull.coordinates import read_points
from modern.geometry.points import Points
from modern.geometry.vectors import area_vector, dot, independent, minus
from modern.papers.appel_will.corners import Preprocessing, Rule, preprocess
from modern.papers.appel_will.loops import LoopTable, find_loops, surface
from modern.papers.appel_will.star import Deleted, IntPoint, Pair, StarTest, as_printed, convex_edges, in_one_pass
from modern.papers.appel_will.surfaces import Fates, Surface, check_surfaces, fates_by_points

# Rules that can be applied as printed, although wrong: the star test of Fig. 12 and five steps of the appendix.
PRINTED = ("star", "step3", "step5", "step7", "step9", "step10")


@dataclass(frozen=True, slots=True)
class Method:
    """Options of the method: the star polygon test, the steps to apply as printed, and a rule to delete points.

    ``printed`` names steps of the appendix that are wrong or unclear in the print. By default all are corrected, which
    reproduces all printed loops and finds all faces of any hull. A loop begins with two lines L1 and L2.

    ``step3``: choose the first L2 that passes steps 4 to 7. The corrected step prefers an L2 whose direction has a
    positive dot product with that of L1, as the main text requires of two lines that define a plane.
    ``step5``, ``step7``: "go back to step 2", which skips an L1 whose first L2 is rejected. The correct target is
    step 3.
    ``step9``: when searching for the next line of a loop, exclude L1 and L2, but not the other lines already on the
    loop.
    ``step10``: "start another loop at step 1", which sets all counts IUC to 0. No count becomes 2, but the loops are
    the same, unless other steps are also applied as printed. The correct target is step 2.
    """

    star: StarTest = in_one_pass
    printed: frozenset[str] = frozenset()
    inside_corners: Rule | None = None


CORRECTED = Method()


def printed(*names: str) -> Method:
    """Return the method that applies the named rules as printed, although they are wrong, and corrects all others.

    The name ``star`` selects the star polygon test as printed. The names of steps are those of :class:`Method`. Raise
    ValueError for an unknown name.
    """
    unknown = [name for name in names if name not in PRINTED]
    if unknown:
        raise ValueError(f"{quoted(unknown[0])} is not one of the names {', '.join(PRINTED)}")
    return Method(as_printed if "star" in names else in_one_pass, frozenset(names) - {"star"})


@dataclass(frozen=True, slots=True)
class Assembled:
    """A hull assembled from its convex edges. Points are named by their indices in the input, from 0.

    ``points`` are the input coordinates multiplied by ``scale``, as integers. ``duplicates`` has pairs of a point and
    the first point that is equal to it. ``preprocessing`` has the points deleted at inside corners, if a rule was
    chosen, and ``deleted`` has the points that the projections show to lie between two others. ``edges`` is the convex
    edge list (the edges of the hull), and ``table`` is the loop table. A polygon has one loop, which uses every edge
    once. A segment or a point has no loop. ``surfaces`` is the topological map: the points of each loop. ``dimension``
    is that of the point set, from 0 to 3.
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
        """The ends of the convex edges, or the only point if there is just one."""
        return tuple(sorted({end for edge in self.edges for end in edge})) or (0,)

    @property
    def fault(self) -> str:
        """The reason why the result is not a hull, or "". Without rules applied as printed, the result is a hull."""
        v, e, f = len(self.vertices), len(self.edges), len(self.surfaces)
        if self.table.stopped:
            return self.table.stopped
        if self.dimension == 3 and not self.table.closed:
            return f"{sum(count != 2 for count in self.table.in_loops)} of {e} edges are not used by exactly two loops"
        if self.dimension == 3 and v - e + f != 2:
            return f"V - E + F is {v} - {e} + {f} = {v - e + f}, not 2"
        if self.dimension == 2 and (f != 1 or any(count != 1 for count in self.table.in_loops)):
            return f"{e} edges and {f} loops do not form one polygon"
        return ""

    def outward(self) -> tuple[Surface, ...]:
        """Return the faces with their points counterclockwise as seen from outside, or a polygon unchanged."""
        counterclockwise = []
        for points in self.surfaces:
            normal, origin = area_vector(self.points, points), self.points[points[0]]
            # The appendix fixes no sense of rotation. If a vertex is on the side of the normal, it points inwards.
            inward = any(dot(normal, minus(self.points[index], origin)) > 0 for index in self.vertices)
            counterclockwise.append((points[0], *points[:0:-1]) if inward else points)
        return tuple(counterclockwise)

    def fates(self, original: Sequence[Surface]) -> Fates:
        """Return what becomes of each surface of the given polyhedron on the hull (Fig. 4)."""
        in_planes = []
        for face in self.surfaces:
            normal, origin = area_vector(self.points, face), self.points[face[0]]
            in_planes.append([k for k, point in enumerate(self.points) if not dot(normal, minus(point, origin))])
        return fates_by_points(original, in_planes, self.surfaces)


def appel_will(points: Points, surfaces: Sequence[Surface] = (), method: Method = CORRECTED) -> Assembled:
    """Return the hull of at least one point by Appel and Will's method, in exact arithmetic.

    Coordinates are ints, Fractions, decimal strings, or floats, which have their exact binary values. ``surfaces``
    lists the points around each surface of the polyhedron. Only the rules for inside corners need the surfaces. Raise
    PointsError for invalid points and MapError for invalid surfaces.
    """
    coordinates = read_points(points)
    scale, scaled = coordinates.scale, coordinates.all()
    check_surfaces(len(scaled), surfaces)
    first: dict[IntPoint, int] = {}
    for index, point in enumerate(scaled):
        first.setdefault(point, index)
    duplicates = tuple((index, first[point]) for index, point in enumerate(scaled) if first[point] != index)
    # A pair of equal points defines no line, so only the first of several equal points is used.
    live = set(first.values())
    preprocessing = None
    if method.inside_corners is not None:
        merged = tuple(tuple(first[scaled[index]] for index in surface) for surface in surfaces)
        preprocessing = preprocess(scaled, merged, method.inside_corners)
        live.difference_update(preprocessing.deleted)
    # The two steps of the paper: find the convex edges by projections, then the loops by the steps of the appendix.
    convex = convex_edges(scaled, live, method.star)
    table = find_loops(scaled, convex.edges, method.printed)
    topological_map = tuple(surface(loop.entries, convex.edges) for loop in table.loops)
    assembly = (preprocessing, convex.deleted, convex.projections, convex.edges, table, topological_map)
    return Assembled(scaled, scale, duplicates, *assembly, len(independent(list(first))) - 1)
