"""Checks of Yau and Srihari: convex and simple solids, the queue of edges, vertices in rows, the search by angles."""

from collections.abc import Mapping
from itertools import product
from random import Random

from modern.claims.appel_will.convexity import area
from modern.claims.evidence import Check, Generator, claim, exhibited, refuted, searched
from modern.claims.hulls import exact_hull, octree_hull
from modern.claims.sampled_sets import Point, counterexample_points
from modern.claims.yau_srihari.envelopes import SOLIDS, array_of, envelopes_against_judge, hull_of, judge_agrees, moved
from modern.claims.yau_srihari.proofs import smallest_solid
from modern.digital.solids import VERTEX, Voxels, ball
from modern.geometry.mesh import sides
from modern.papers.yau_srihari import OctreeHull, Printed
from modern.papers.yau_srihari.convexity import is_digitally_convex, is_midpoint_convex, is_simple
from modern.papers.yau_srihari.envelope import outline, reduced_tree
from modern.papers.yau_srihari.octree import QUADRANTS
from modern.papers.yau_srihari.printed import NAMES
from modern.papers.yau_srihari.quadtree import Leaf, Place, Quadtree, heights, line, no_columns, sons_of, written
from modern.papers.yau_srihari.search import Bounds, Search


def path_and_larger() -> list[Voxels]:
    """Return six voxels that form a path, alone and with each of two other voxels."""
    return [array_of([*counterexample_points("yau_path.csv"), *p]) for p in ([], [(1, 0, 1)], [(1, 1, 1)])]


@claim("yau-srihari.1")
def minimum_not_unique() -> Check:
    path, *larger = path_and_larger()
    # By definition 3.2.2, and by Kim and Rosenfeld's test (3.2.3)
    outcomes = [not of(path) and all(map(of, larger)) for of in (is_midpoint_convex, is_digitally_convex)]
    message = "a path of six voxels fails definition 3.2.2 and the test of 3.2.3, but satisfies both if either of "
    return exhibited(all(outcomes), f"{message}{len(larger)} other voxels is added")


@claim("yau-srihari.35")
def smallest_convex_solid() -> Check:
    path, *larger = path_and_larger()
    is_own_hull = (octree_hull(path).filled == path).all() and not is_digitally_convex(path)
    case = f"a path of six voxels, which becomes convex if one of {len(larger)} other voxels is added"
    return smallest_solid().check().unless(is_own_hull and all(map(is_digitally_convex, larger)), case)


@claim("yau-srihari.29")
def simple_with_a_tunnel() -> Check:
    solid = counterexample_points("tunnel.csv")
    # The vertices, edges, sides and voxels of the solid by their topological coordinates.
    euler = sum((-1) ** sum(c % 2 for c in cell) for cell in moved(solid, (0, 1, 2), 2))
    message = f"the solid is simple, but has the Euler number {euler}; solids without tunnels and cavities have 1"
    return refuted(is_simple(array_of(solid)) and euler == 0, message)


@claim("yau-srihari.85", full=500)
def queued_edges_reversed(cases: int = 3) -> Check:
    found, outcomes = 0, []
    for voxels in SOLIDS.cases(cases):
        outcomes.append(judge_agrees(voxels))
        for step in (*hull_of(voxels).lower.steps, *hull_of(voxels).upper.steps):
            ring, found = step.face.vertices if step.face else (), found + len(step.removed)
            # Section 5 enters the edges of a new face in the directions u1 u3 and u3 u2.
            entries = {*zip((*ring[1:], *ring[:1]), ring, strict=True)} - {step.edge[::-1]}
            outcomes.append(entries == {*step.entered, *((q, p) for p, q in step.removed)})
    message = f"all faces are found if {found} edges that are in the queue in the reverse direction are removed from it"
    return searched(SOLIDS, cases, outcomes, message)


@claim("yau-srihari.51", full=400, of_ceiling=False)
@claim("yau-srihari.52", full=400, of_ceiling=True)
def envelope_algorithm(of_ceiling: bool, cases: int = 2) -> Check:
    needed = [name for name in NAMES if not of_ceiling or name != "truncation"]
    wrong = all(_is_wrong(name, of_ceiling) == (name in needed) for name in NAMES)
    # From the upright starting face of two columns, no other face is found.
    row = octree_hull(array_of([(0, 0, 0), (1, 0, 0)]))
    found = Search((1, 0, 0), (0, 0, 0), (0, -1, 0), Printed()).run((row.upper if of_ceiling else row.lower).tree)
    case = f"{len(needed)} printed steps, each giving a wrong envelope; and two voxels in a row, which have no face"
    return envelopes_against_judge(cases).unless(wrong and not found, case)


def _is_wrong(name: str, of_ceiling: bool) -> bool:
    """Return True if a step as printed gives a wrong envelope for its counterexample, as it is or mirrored in z."""
    upright = array_of(counterexample_points(f"yau_{name}.csv"))
    both = [[octree_hull(array, p) for p in (Printed(), Printed.only(name))] for array in (upright, upright[..., ::-1])]
    trees = [[heights((hull.upper if of_ceiling else hull.lower).tree) for hull in hulls] for hulls in both]
    return any(right != as_printed for right, as_printed in trees)


def _draw_floor(random: Random) -> tuple[Point, ...]:
    return tuple((x, y, random.randint(0, 3)) for x in range(4) for y in range(4) if random.random() < 0.8)


FLOORS: Generator[tuple[Point, ...]] = Generator("floors of about 13 columns of height 0 to 3", 29, _draw_floor)


@claim("yau-srihari.64", "yau-srihari.104", full=1_000)
def extreme_in_row_and_column(cases: int = 6) -> Check:
    checks = []
    for floor_ in FLOORS.cases(cases):
        heights_ = {(x, y): z for x, y, z in floor_}
        extreme_in_both = {place for place in heights_ if all(_extreme(place, axis, heights_) for axis in (0, 1))}
        # The set A has the points that are extreme in their columns among the points that are extreme in their rows.
        after_first = {place: z for place, z in heights_.items() if _extreme(place, 1, heights_)}
        after_both = {place for place in after_first if _extreme(place, 0, after_first)}
        tree = written(no_columns(4), {place: Leaf(z) for place, z in heights_.items()})
        # The lower hull of the floor: copies of all points far above leave its lower vertices unchanged.
        hull = exact_hull([*floor_, *((x, y, z + 9) for x, y, z in floor_)])
        vertices = {floor_[k][:2] for k in hull.vertices if k < len(floor_)}
        checks.append(vertices <= extreme_in_both <= after_both == {*heights(reduced_tree(tree))})
        flat, ring = [(x, y, 0) for x, y in after_both], outline(after_both)
        checks.append({*ring} == {flat[k][:2] for k in exact_hull(flat).vertices})
        checks += [area(p, q, at) >= 0 for p, q in sides(ring) for at in ring]
    message = "extreme points are extreme in their row and column, and remain in A; floor and ceiling of A give "
    return searched(FLOORS, cases, checks, f"{message}the corners of H(A) in counterclockwise order")


@claim("yau-srihari.80", full=1_000)
def leaves_in_sorted_order(cases: int = 6) -> Check:
    checks = []
    for floor_ in FLOORS.cases(cases):
        tree = written(no_columns(4), {(x, y): Leaf(z) for x, y, z in floor_})
        for axis, at in product((0, 1), range(4)):
            of_line = sorted((p[1 - axis], p[2]) for p in floor_ if p[axis] == at)
            checks.append(_leaves(tree, axis, at) == of_line == [*line(tree, axis, at)])
    message = f"the leaves of {len(checks)} binary subtrees, visited son by son, are sorted along their row or column"
    return searched(FLOORS, cases, checks, message)


def _leaves(tree: Quadtree, axis: int, at: int, first: int = 0) -> list[tuple[int, int]]:
    """Visit the sons of a node that meet a row or column, in the order of their numbers; return the heights found."""
    if not (half := tree.side // 2):
        return [(first, height) for height in heights(tree).values()]
    sons = [son for son, place in zip(sons_of(tree), QUADRANTS, strict=True) if place[axis] == at // half]
    return [leaf for k, son in enumerate(sons) for leaf in _leaves(son, axis, at % half, first + k * half)]


def _extreme(place: Place, axis: int, heights_: Mapping[Place, int]) -> bool:
    """Return True if a point is a vertex of the lower hull of the points in its row or column."""
    at, z = place[axis], heights_[place]
    on_line = [(p[axis], h) for p, h in heights_.items() if p[1 - axis] == place[1 - axis]]
    around = product([entry for entry in on_line if entry[0] < at], [entry for entry in on_line if entry[0] > at])
    return all((z - h) * (b - a) < (k - h) * (at - a) for (a, h), (b, k) in around)


class _Counted(Search):
    """A search whose ``taken`` counts the angles of points.  ``angles`` also counts those of corners."""

    taken = 0

    def bounds(self, low: int, high: int, x: int, y: int, side: int) -> Bounds:
        before, both = self.angles, super().bounds(low, high, x, y, side)
        # By yau-srihari.71, both bounds are angles at corners. So a program needs at most two angles for each square.
        self.angles = min(self.angles, before + 2)
        return both

    def take(self, point: Point) -> None:
        self.taken += 1
        super().take(point)


@claim("yau-srihari.129", full=100)
def angle_counts(cases: int = 3) -> Check:
    balls = [ball(diameter, VERTEX).array for diameter in (2, 4, 8)]
    counts = [_angles(octree_hull(array)) for array in (*balls, *map(array_of, SOLIDS.cases(cases)))]
    of_2, (whole_of_4, _, _, with_bounds_of_4), (whole, preprocessed, by_search, with_bounds), *_ = counts
    outcomes = [by_search < preprocessed < whole, with_bounds < whole, *(c[2] <= c[1] <= c[0] for c in counts)]
    message = f"the hull of a ball of diameter 8 needs {whole} angles of points, {preprocessed} after preprocessing, "
    message += f"{by_search} with the search too, and {with_bounds} if the search's angles for bounds are counted"
    check = searched(SOLIDS, cases, outcomes, message)
    case = f"a ball of diameter 2, which needs {of_2[2]} angles of points in any way; and by a ball of diameter 4, "
    case += f"which needs {with_bounds_of_4} angles with the bounds instead of {whole_of_4}"
    return check.unless(of_2[0] == of_2[2] and with_bounds_of_4 > whole_of_4, case)


def _angles(hull: OctreeHull) -> tuple[int, int, int, int]:
    """Count angles at edges: of all points beyond an edge, of those in A, of those visited, and these with bounds."""
    reduced = written(no_columns(hull.side), {(x, y): Leaf(z) for x, y, z in hull.lower.reduced})
    searches = [_Counted(*step.edge, step.normal, Printed()) for step in hull.lower.steps]
    # Without the search, the angles of all points beyond the edge are computed.
    points = hull.floor, heights(reduced)
    whole, preprocessed = (sum(search.beyond(*at) for search in searches for at in tree) for tree in points)
    for search in searches:
        search.run(reduced)
    return whole, preprocessed, sum(s.taken for s in searches), sum(s.angles for s in searches)
