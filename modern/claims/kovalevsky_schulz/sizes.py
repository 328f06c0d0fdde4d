"""Checks of sections 4 and 5 of Kovalevsky and Schulz: sizes of cell lists and triangulations, and symmetry."""

import re
from fractions import Fraction

from modern.claims.evidence import Check, claim, exhibited, searched, slip
from modern.claims.invariants import half_balls
from modern.claims.kovalevsky_schulz.polyhedra import hulls, polyhedron
from modern.claims.published import PAPERS, printed_lines, results_of
from modern.claims.sampled_sets import CASES, SETS
from modern.papers.kovalevsky_schulz.cells import CellList, cell_list_size, economical_size, triangulation_size
from modern.papers.kovalevsky_schulz.hull import merged, straightened
from modern.papers.kovalevsky_schulz.results import half_ball_cells

PAPER = next(paper for paper in PAPERS if paper.name == "kovalevsky-schulz")


@claim("kovalevsky-schulz.78", full=400)
def formula_5(cases: int = CASES) -> Check:
    """Check that formula (5) gives 6 integers too few: it counts 2 V triangles, but a triangulation has 2 V - 4."""
    lists = [polyhedron(points) for points, _ in hulls(cases)]
    excess = [3 * len(c.vertices) + 3 * len(c.faces) - triangulation_size(len(c.faces)) for c in lists]
    return searched(SETS[3], cases, [e == 6 for e in excess], "hulls of triangles need 6 integers more than (5) gives")


@claim("kovalevsky-schulz.91")
def integers_per_face() -> Check:
    """Check that all quotients of Table 5 are rounded except one that is truncated; they are printed in hundredths."""
    rows = [result.printed[0].split() for result in results_of(PAPER) if result.id.startswith("table5-")]
    quotients = [(int(row[6].replace(".", "")), Fraction(100 * int(row[5]), int(row[4]))) for row in rows]
    wrong = [(printed, exact) for printed, exact in quotients if printed != round(exact)]
    others = "".join(f"; {float(exact / 100):.4f} is printed as {printed / 100}" for printed, exact in wrong)
    is_truncated = [int(exact) for _, exact in wrong] == [printed for printed, _ in wrong]
    correction = ", ".join(str(round(exact) / 100) for _, exact in wrong)
    return slip(not wrong, is_truncated, correction, f"{len(rows) - len(wrong)} quotients are rounded{others}")


@claim("kovalevsky-schulz.100")
def memory_requirements() -> Check:
    """Check that the printed cell lists need fewer integers than Marching Cubes, but not always than the hull's
    triangles.

    Formula (6) gives the number V of vertices from the number of integers; a hull has 2 V - 4 triangles.
    """
    tables = printed_lines(PAPER)
    fewer, more = [], {}
    for row in half_balls():
        own = triangulation_size(2 * int(row.corners) - 4)
        fewer.append(row.integers < row.triangle_integers)
        if row.integers > own:
            more[row.diameter] = f"{row.integers} integers against {own} of its triangles at diameter {row.diameter}"
    car, triangles = (int(tables[name][0].split()[-1]) for name in ("table4-hull", "table4-triangulation"))
    fewer.append(car < triangles)
    message = f"the cell list is smaller than the triangles of Marching Cubes in {sum(fewer)} of {len(fewer)} cases; "
    return exhibited(all(fewer) and {*more} == {10, 18}, f"{message}{', '.join(more.values())}")


def _bodies() -> tuple[list[CellList], list[CellList]]:
    """Return the cell lists of the half-balls, with the points on straight edges and without them."""
    bodies = [half_ball_cells(row.diameter) for row in half_balls()]
    return bodies, [straightened(cells) for cells in bodies]


@claim("kovalevsky-schulz.84")
def integers_of_table_4() -> Check:
    """Check that the printed 495 integers are those of formula (6), and that the cell list of such a hull has fewer.

    By Euler's formula the hull has V + F - 2 edges, each of which is on two faces. The list therefore has 3 V + 2 E
    integers, or F more if it also has the number of vertices of each face.
    """
    faces, vertices, integers = map(int, re.findall(r"\d+", printed_lines(PAPER)["table4-hull"][0]))
    edges = vertices + faces - 2
    exact = 3 * vertices + 2 * edges
    counted = all(economical_size(c) == 3 * len(c.vertices) + 2 * len(c.edges) for bodies in _bodies() for c in bodies)
    check = exhibited(cell_list_size(vertices, faces) == integers, f"{integers} is the value of formula (6)")
    case = f"the cell list itself: {vertices} vertices and {faces} faces have {edges} edges and need {exact} integers"
    return check.unless(counted and integers not in (exact, exact + faces), case)


@claim("kovalevsky-schulz.80")
def vertices_of_a_face() -> Check:
    """Check that the half-balls' faces have about five points on average, but only about four vertices."""
    means = []
    for bodies in _bodies():
        points, faces = [sum(len(f.vertices) for f in c.faces) for c in bodies], [len(c.faces) for c in bodies]
        means.append((Fraction(sum(points), sum(faces)), sum(map(Fraction, points, faces)) / len(bodies)))
    texts = [f"{float(first):.2f} over all faces, {float(second):.2f} over the bodies" for first, second in means]
    check = exhibited(all(round(mean) == 5 for mean in means[0]), f"means of points: {texts[0]}")
    return check.unless(all(round(mean) != 5 for mean in means[1]), f"the means of vertices: {texts[1]}")


@claim("kovalevsky-schulz.81")
def formula_6() -> Check:
    """Check that formula (6) is wrong by less than 5 % for the half-balls together, but by more without some points."""
    all_points, only_vertices = (
        sum(cell_list_size(len(c.vertices), len(c.faces)) for c in bodies) / sum(map(economical_size, bodies))
        for bodies in _bodies()
    )
    check = exhibited(abs(all_points - 1) < 0.05, f"{all_points:.3f} times the exact number of integers")
    ten = half_ball_cells(10)
    alone = cell_list_size(len(ten.vertices), len(ten.faces)) / economical_size(ten)
    case = (
        f"cell lists of vertices only, {only_vertices:.3f} times, and diameter 10, {alone:.2f} times the exact number"
    )
    return check.unless(only_vertices > 1.1 and alone > 1.2, case)


@claim("kovalevsky-schulz.157")
def edges_at_vertex() -> Check:
    """Check that the apex of a pyramid has as many edges as its base has sides, for 3 to 20 sides."""
    outcomes = []
    for sides in range(3, 21):
        pyramid = polyhedron([*((k, k * k, 0) for k in range(sides)), (0, 0, 1)])
        outcomes.append(max(len(vertex.edges) for vertex in merged(pyramid).vertices) == sides)
    return exhibited(all(outcomes), f"in {len(outcomes)} pyramids, the apex has as many edges as the base has sides")
