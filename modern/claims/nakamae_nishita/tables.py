"""Checks of Nakamae and Nishita on how two contours lie, on formulas (1) to (5), and on the tables PL and LP.

An entry of a table tells on which side of a line of one contour a vertex of the other contour lies.
"""

import math
from collections.abc import Iterator
from functools import cache
from itertools import combinations, product
from random import Random

from modern.claims import algebra
from modern.claims.appel_will.convexity import area
from modern.claims.evidence import Check, Generator, claim, identity, proved, searched
from modern.claims.hulls import exact_hull
from modern.claims.nakamae_nishita.proofs import one_order, overlap_by_neighbours
from modern.claims.sampled_sets import CASES, SETS, Point, sampled_sets
from modern.drawing.visible import line_through, sign, value
from modern.geometry.mesh import sides
from modern.geometry.vectors import dot
from modern.papers.nakamae_nishita.contours import Tables, tables, values
from modern.papers.nakamae_nishita.crossings import CLEAR, clipped
from modern.papers.nakamae_nishita.solids import height, plane_through

Place = tuple[int, int]

SQUARE: tuple[Place, ...] = ((0, 0), (0, 4), (4, 4), (4, 0))
WITHIN: tuple[Place, ...] = ((1, 1), (1, 3), (3, 3), (3, 1))
ACROSS: tuple[Place, ...] = ((2, 2), (2, 6), (6, 6), (6, 2))
BESIDE: tuple[Place, ...] = ((6, 0), (6, 4), (9, 4), (9, 0))
AGAINST: tuple[Place, ...] = ((0, 2), (1, 3), (2, 2), (1, 1))


def flat(places: tuple[Place, ...]) -> list[tuple[int, int, int]]:
    return [(x, y, 1) for x, y in places]


def lines_of(places: tuple[Place, ...]) -> list[tuple[int, int, int]]:
    return [line_through(a, b) for a, b in sides(flat(places))]


def tables_of(v: tuple[Place, ...], w: tuple[Place, ...]) -> Tables:
    """Return the tables PL and LP by formula (2), even if contours are apart.  Rows belong to V' and columns to V."""
    of_v, of_w = ([[value(line, p) for p in flat(b)] for line in lines_of(a)] for a, b in ((v, w), (w, v)))
    return tables(of_v, of_w)


def _draw_polygon(random: Random) -> tuple[Place, ...]:
    points = [(random.randint(-2, 6), random.randint(-2, 6), 0) for _ in range(6)]
    return tuple(points[k][:2] for k in exact_hull(points).polygon[::-1])


POLYGONS = Generator("convex polygons with coordinates from -2 to 6, and five fixed ones", 32, _draw_polygon, bool)


@cache
def polygons(count: int = CASES) -> tuple[tuple[Place, ...], ...]:
    """Return the five polygons of this module and ``2 * count`` random convex polygons, all with clockwise corners."""
    return (SQUARE, WITHIN, ACROSS, BESIDE, AGAINST, *POLYGONS.cases(2 * count))


def pairs(count: int = CASES) -> Iterator[tuple[tuple[Place, ...], tuple[Place, ...]]]:
    for v, w in combinations(polygons(count), 2):
        yield v, w
        yield w, v


def inside(p: Place, v: tuple[Place, ...]) -> bool:
    """Return True if a point is in a convex polygon: its triangles with all sides add up to the area of the polygon."""
    return sum(abs(area(p, a, b)) for a, b in sides(v)) == abs(sum(area(v[0], a, b) for a, b in sides(v)))


def overlap(v: tuple[Place, ...], w: tuple[Place, ...]) -> bool:
    """Return True if the hulls of two sets have common inner points: 0 is inside the hull of all differences q - p."""
    differences = sorted({(q[0] - p[0], q[1] - p[1], 0) for p in v for q in w})
    ring = [differences[k][:2] for k in exact_hull(differences).polygon]
    return all(area((0, 0), a, b) > 0 for a, b in sides(ring))


# A pyramid over an upright pentagon that is seen edge-on along z.
ROOF: tuple[Point, ...] = ((0, 0, 0), (4, 0, 0), (4, 0, 2), (2, 0, 3), (0, 0, 2), (2, 5, 1))


@claim("nakamae-nishita.12", full=400)
def convex_contour(cases: int = CASES) -> Check:
    checks, straight, sets = [], 0, [(sampled.points, sampled.judge) for sampled in sampled_sets(3, 1 + cases)]
    # The eye is at infinity if the last number is 0. The images are in the plane z = 0, enlarged to have integers.
    eyes = (-31, -17, 1, 0), (9, -4, 12, 1)
    for (points, judge), (a, b, c, w) in (*product(sets, eyes), ((ROOF, exact_hull(ROOF)), (0, 0, 1, 0))):
        scale = math.lcm(*(c - w * z for _, _, z in points))
        enlarged = [(x, y, z, scale // (c - w * z)) for x, y, z in points]
        images = [((c * x - a * z) * factor, (c * y - b * z) * factor) for x, y, z, factor in enlarged]
        values = [dot(face.plane[:3], (a, b, c)) + w * face.plane[3] for face in judge.facets]
        # A directed edge of a front face is on the contour if its reverse belongs to no front face.
        front = [face.polygon for face, face_value in zip(judge.facets, values, strict=True) if face_value > 0]
        edges = {edge for ring in front for edge in sides(ring)}
        after = {q: p for p, q in edges if (q, p) not in edges}
        ring = [min(after)]
        while len(ring) < len(after) and after[ring[-1]] != ring[0]:
            ring.append(after[ring[-1]])
        contour = [images[k] for k in ring]
        turns = [side(contour[k - 2], contour[k - 1], contour[k]) for k in range(len(contour))]
        checks.append(len(ring) == len(after) and {*turns} <= {-1, 0} and (0 in values or 0 not in turns))
        checks.append(all(side(p, q, image) <= 0 for p, q in sides(contour) for image in images))
        straight += turns.count(0)
    message = f"{len(checks) // 2} contours of hulls are convex and clockwise, also if a face is seen edge-on"
    return searched(SETS[3], 1 + cases, [*checks, straight], message)


@claim("nakamae-nishita.13", full=25)
def correlations(cases: int = CASES) -> Check:
    checks, counts = [], dict.fromkeys(("apart", "one encloses the other", "partly overlapping"), 0)
    for v, w in pairs(cases):
        encloses = any(all(inside(p, a) for p in b) for a, b in ((v, w), (w, v)))
        of_w = [values(lines_of(w), [(*a, 0, 1), (*b, 0, 1)]) for a, b in sides(v)]
        # A part of a side of V is inside V', but neither of the two polygons is.
        partly = any(ends is not None and clipped(ends, 0, 1) != CLEAR for ends in of_w) and not encloses
        relations = {"apart": not overlap(v, w), "one encloses the other": encloses, "partly overlapping": partly}
        checks.append(sum(relations.values()) == 1)
        counts = {name: n + relations[name] for name, n in counts.items()}
    shown = ", ".join(f"{name}: {number}" for name, number in counts.items())
    message = f"each pair of contours is in exactly one of three relations ({shown})"
    return searched(POLYGONS, 2 * cases, [*checks, *counts.values()], message)


@claim("nakamae-nishita.21")
def formula_1() -> Check:
    def difference(x1: int, y1: int, x: int, y: int, along: int, right: int) -> int:
        x2, y2, u, v = x1 + x, y1 + y, x1 + along * x + right * y, y1 + along * y - right * x
        determinant = u * (y1 - y2) - v * (x1 - x2) + x1 * y2 - x2 * y1
        computed = value(line_through((x1, y1, 1), (x2, y2, 1)), (u, v, 1))
        # Both differences are polynomials, and the result is 0 only if both are.
        return abs(computed + determinant) + abs(determinant + right * (x * x + y * y))

    argument = "The value at a point is its distance to the right of the line times the length of the segment."
    message = "formula (1) is positive exactly to the right of the line"
    return identity(difference, (2, 2, 2, 2, 1, 1), message, argument)


@claim("nakamae-nishita.37", conclusion="in right-handed coordinates, formula (5) is positive if the vertex is nearer")
@claim("nakamae-nishita.60", conclusion="formula (5) has the same sign at all vertices of V', so any of them decides")
def formula_5(conclusion: str) -> Check:
    x, p, q, r = (algebra.point(name, 3) for name in "xpqr")
    unit = algebra.polynomial(1)
    computed = height(plane_through(*((*corner, unit) for corner in (p, q, r))), (*x, unit))  # type: ignore[arg-type]
    # The determinant of (5), expanded along the column of ones, with the printed minus sign.
    minors = [algebra.dot(a, algebra.cross(b, c)) for a, b, c in ((p, q, r), (x, q, r), (x, p, r), (x, p, q))]
    printed = minors[0] - minors[1] + minors[2] - minors[3]
    outward = algebra.cross(algebra.minus(r, p), algebra.minus(q, p))
    differences = printed - computed, printed - algebra.dot(algebra.minus(x, p), outward)
    order = one_order()
    argument = (
        "The value of formula (5) for a vertex x and corners p, q and r of a face is (x - p) n with n = (r - p) x (q - "
        "p), which points outward because the corners run clockwise as seen from outside, and is not 0 because they "
        "form a convex angle (section 3.1). The coordinates are right-handed. So the value is positive in "
        "front of the face, like the eye, and negative behind it: x is nearer or farther than the point of the face "
        f"with the same image. The order of these two points is that of V' and V. {order.argument}"
    )
    face = plane_through((0, 0, 0, 1), (0, 4, 0, 1), (4, 4, 0, 1))  # clockwise as seen from above
    above, on, below = (sign(height(face, (1, 2, z, 1))) for z in (1, 0, -1))
    steps = [*(d == 0 * unit for d in differences), *(step.is_valid() for step in order.steps)]
    check = proved(argument, steps, conclusion)
    return check.unless(above > on == 0 > below, "a vertex in the face, for which formula (5) is 0")


def between(p: Place, q: Place, r: Place) -> bool:
    return side(p, q, r) == 0 and (r[0] - p[0]) * (r[0] - q[0]) + (r[1] - p[1]) * (r[1] - q[1]) <= 0


def side(p: Place, q: Place, r: Place) -> int:
    return sign(area(p, q, r))


def crosses(a: Place, b: Place, c: Place, d: Place) -> bool:
    """Return True if the segments a b and c d cross at a point that is no end of either."""
    return side(a, b, c) * side(a, b, d) == -1 == side(c, d, a) * side(c, d, b)


@claim("nakamae-nishita.66")
def overlap_by_tables() -> Check:
    v, ends = ((3, 5), (6, 0), (3, 0), (0, 0)), (2, 4)
    contours = [((3, -4), (1, 0), (x, 0), (5, 0)) for x in ends]
    one, other = (tables_of(v, w) for w in contours)
    # Segment 1 of each contour, from (1, 0) to (x, 0), is on the line of side 1 of V, from (6, 0) to (3, 0).
    overlaps = [min(x, v[1][0]) > max(1, v[2][0]) for x in ends]
    case = f"{v} with {contours[0]} or {contours[1]}: the tables are the same, but only segment 1 of the second "
    case += "overlaps segment 1 of the first polygon"
    return overlap_by_neighbours().check().unless(one == other and overlaps == [False, True], case)
