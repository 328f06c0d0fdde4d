"""Checks of Appel and Will about the edges and faces of a hull: its graph, its outline, loops, and properties."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations, permutations, product

from modern.claims.appel_will.convexity import CUBE
from modern.claims.evidence import Check, claim, searched
from modern.claims.hulls import exact_hull
from modern.claims.sampled_sets import CASES, SETS, Point, is_closed_curve, plane_value, sampled_sets
from modern.exact_hull import ExactHull
from modern.geometry.mesh import sides
from modern.geometry.vectors import area_vector, cross, dot, minus
from modern.papers.appel_will.results import found_solid

Graph = Mapping[int, frozenset[int]]


def _sets(cases: int) -> list[tuple[Point, ...]]:
    figures = [found_solid(name).points for name in ("fig14", "fig23")]
    return [CUBE, *figures, *(sampled.points for sampled in sampled_sets(3, cases))]  # type: ignore[list-item]


@claim("appel-will.97", full=100)
def faces_from_graph(cases: int = CASES) -> Check:
    # The graph of a convex polyhedron stays connected if any two vertices are removed. The faces of such a graph are
    # the cycles that have no chord and leave the rest connected (Tutte 1963).
    checks, faces = [], 0
    for judge in map(exact_hull, _sets(cases)):
        graph = _graph(judge)
        found_faces = {cycle for cycle in _cycles(graph) if _connected(graph, cycle)}
        checks.append(found_faces == {frozenset(facet.polygon) for facet in judge.facets})
        faces += len(found_faces)
    message = f"the edges alone determine the {faces} faces of the hulls of {cases} drawn sets and of three fixed ones"
    return searched(SETS[3], cases, checks, message)


def _graph(judge: ExactHull) -> Graph:
    return {k: frozenset(sum(edge) - k for edge in judge.edges() if k in edge) for k in judge.vertices}


def _cycles(graph: Graph) -> Iterator[frozenset[int]]:
    paths: list[tuple[int, ...]] = [(k,) for k in graph]
    while paths:
        path = paths.pop()
        for new in graph[path[-1]]:
            if new > path[0] and new not in path:
                # An edge to an earlier point of the path is a chord, unless it leads to the start and closes the cycle.
                before = graph[new] & {*path[:-1]}
                if before == {path[0]}:
                    yield frozenset((*path, new))
                elif not before:
                    paths.append((*path, new))


def _connected(graph: Graph, without: frozenset[int]) -> bool:
    remaining = {*graph} - without
    queue = [remaining.pop()] if remaining else []
    while queue:
        near = graph[queue.pop()] & remaining
        remaining -= near
        queue += near
    return not remaining


@claim("appel-will.96", "appel-will.124", "kovalevsky-schulz.43", "kovalevsky-schulz.158", full=400)
def planar_graph(cases: int = CASES) -> Check:
    checks = []
    for hull in (sampled.judge for sampled in sampled_sets(3, cases)):
        rings = [f.polygon for f in hull.facets]
        checks += [len({*ring}) == len(ring) > 2 for ring in rings]
        directed = [side for ring in rings for side in sides(ring)]
        checks.append(len({*directed}) == len(directed) and {*directed} == {(b, a) for a, b in directed})
        for vertex in hull.vertices:
            # The edges opposite to a vertex, one in each face, form one ring around it.
            at = [(ring, ring.index(vertex)) for ring in rings if vertex in ring]
            checks.append(is_closed_curve([(ring[k - 1], ring[(k + 1) % len(ring)]) for ring, k in at]))
        checks += [len(hull.vertices) - len(hull.edges()) + len(rings) == 2, _connected(_graph(hull), frozenset())]
    message = f"{len(checks)} conditions hold: the edges of a face form a ring, the graph is connected, the faces at "
    message += "each vertex form a ring, and V - E + F = 2"
    return searched(SETS[3], cases, checks, message)


@claim("appel-will.158", full=200)
def coplanar_loops(cases: int = CASES) -> Check:
    checks = []
    for judge in map(exact_hull, _sets(cases)):
        threes = [{*a, *b} for a, b in combinations(judge.edges(), 2) if len({*a, *b}) == 3]
        checks += [sum(three <= {*facet.polygon} for facet in judge.facets) <= 1 for three in threes]
        checks.append(len({facet.plane for facet in judge.facets}) == len(judge.facets))
    message = "the three points of two edges with a common end are on at most one loop; no two loops are coplanar"
    return searched(SETS[3], cases, checks, f"in {cases} drawn and 3 fixed sets, {message}")


@claim("appel-will.32", full=400)
def outline(cases: int = CASES) -> Check:
    outcomes = []
    for s, eye, w in product(sampled_sets(3, cases), permutations((1, 6, 20), 3), (0, 1)):
        if all(dot(facet.plane[:3], eye) + w * facet.plane[3] for facet in s.judge.facets):
            outcomes.append(is_closed_curve(_on_outline(s.points, s.judge, eye, w)))
    message = f"in {len(outcomes)} parallel and central projections, the edges that produce the outline of a hull form "
    check = searched(SETS[3], cases, outcomes, f"{message}one closed curve")
    edges = _on_outline(CUBE, exact_hull(CUBE), (0, 0, 1))  # type: ignore[arg-type]
    case = f"a cube seen along an edge: {len(edges)} edges produce the outline and form no single closed curve"
    return check.unless(edges and not is_closed_curve(edges), case)


def _on_outline(points: Sequence[Point], judge: ExactHull, eye: Point, w: int = 0) -> list[tuple[int, int]]:
    """Return the edges whose images are on the border of a projection, from a point if ``w`` is 1, and no points."""
    edges = []
    for a, b in judge.edges():
        # This normal is perpendicular to the image of the edge in the plane of projection.
        normal = cross(minus(points[b], points[a]), minus(eye, points[a]) if w else eye)
        values = [dot(normal, minus(point, points[a])) for point in points]
        if any(normal) and not min(values) < 0 < max(values):
            edges.append((a, b))
    return edges


@claim("appel-will.28", number="2", full=400)
@claim("appel-will.29", "appel-will.66", number="3", full=400)
@claim("appel-will.30", "nakamae-nishita.63", number="4", full=400)
@claim("appel-will.9", number="4", dimension=2, full=400)
def polyhedron_property(number: str, dimension: int = 3, cases: int = 2 * CASES) -> Check:
    outcomes_of, meaning = _PROPERTIES[number]
    checks = [right for s in sampled_sets(dimension, cases) for right in outcomes_of(s.points, s.judge)]
    return searched(SETS[dimension], cases, checks, f"in {cases} hulls, {meaning}")


def _cones(points: Sequence[Point], judge: ExactHull) -> Iterator[bool]:
    # No point is outside the planes of the faces at a vertex, and these planes meet only in the vertex.
    for k in judge.vertices:
        planes = [f.plane for f in judge.facets if k in f.polygon]
        yield all(plane_value(p, q) <= 0 for p in planes for q in points)
        yield any(dot(a[:3], cross(b[:3], c[:3])) for a, b, c in combinations(planes, 3))


def _dihedral(points: Sequence[Point], judge: ExactHull) -> Iterator[bool]:
    for edge in judge.edges():
        both = [f for f in judge.facets if {*edge} <= {*f.polygon}]
        far = [plane_value(both[0].plane, points[k]) < 0 for k in both[-1].polygon if k not in edge]
        yield len(both) == 2 and all(far)


def _faces(points: Sequence[Point], judge: ExactHull) -> Iterator[bool]:
    for polygon in [f.polygon for f in judge.facets] if judge.dimension == 3 else [judge.polygon]:
        ring = [points[k] for k in polygon]
        for p, q in sides(ring):
            # All other corners are to the left of each side.
            normals = [cross(minus(q, p), minus(r, p)) for r in ring if r not in (p, q)]
            yield min(dot(normal, area_vector(points, polygon)) for normal in normals) > 0


_PROPERTIES = {
    "2": (_cones, "the planes of the faces at a vertex meet only there, and no point is on their outer sides"),
    "3": (_dihedral, "each edge is on exactly two faces, whose angle inside the hull is less than 180 degrees"),
    "4": (_faces, "all other corners of a polygon are on one side of the line through each of its sides"),
}
