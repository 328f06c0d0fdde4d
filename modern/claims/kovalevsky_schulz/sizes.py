"""Checks of sections 4 and 5 of Kovalevsky and Schulz: sizes of cell lists and triangulations, and symmetry."""

from fractions import Fraction
from functools import cache

from modern.claims.evidence import Check, claim, exhibited, searched, slip
from modern.claims.kovalevsky_schulz.polyhedra import hulls, polyhedron
from modern.claims.published import PAPERS, printed_lines, produced_by
from modern.claims.sampled_sets import CASES, SETS
from modern.papers.kovalevsky_schulz.cells import cell_list_size, economical_size, triangulation_size
from modern.papers.kovalevsky_schulz.hull import merged
from modern.papers.kovalevsky_schulz.results import half_ball_cells

# The diameters of the half-balls of Table 5.
DIAMETERS = (8, 10, 12, 14, 16, 18, 20, 22)


@claim("kovalevsky-schulz.78", full=400)
def formula_5(cases: int = CASES) -> Check:
    """Check that formula (5) is only 6 integers too low, because a triangulation has 2 V - 4 triangles and not 2 V."""
    excess = []
    for points, _ in hulls(cases):
        cells = polyhedron(points)
        triangles = len(cells.faces)
        excess.append(3 * len(cells.vertices) + 3 * triangles - triangulation_size(triangles))
    return searched(SETS[3], cases, [e == 6 for e in excess], "hulls of triangles need 6 integers more than (5) gives")


@claim("kovalevsky-schulz.91")
def integers_per_face() -> Check:
    """Check that Table 5 prints quotients rounded, as 8.56 shows, so that the printed 7.53 must be 7.54."""
    sixteen, eighteen = (Fraction(100 * integers, faces) for _, _, faces, integers in _table_5()[4:6])
    rounded = (int(sixteen), round(sixteen)) == (855, 856)
    message = "1010 / 118 is printed rounded as 8.56; 1070 / 142 is 7.535"
    return slip(round(eighteen) == 753, rounded and round(eighteen) == 754, "7.54", message)


@cache
def _table_5() -> tuple[tuple[int, int, int, int], ...]:
    """Return, for each row of Table 5, printed triangles and integers, and computed faces and integers of the hull."""
    paper = next(paper for paper in PAPERS if paper.name == "kovalevsky-schulz")
    printed, made = printed_lines(paper), produced_by(paper)
    rows = [(printed[name][0].split(), made[name][0].split()) for name in (f"table5-{d}" for d in DIAMETERS)]
    return tuple((int(p[1]), int(p[2]), int(m[4]), int(m[5])) for p, m in rows)


@claim("kovalevsky-schulz.100")
def memory_requirements() -> Check:
    """Check that the cell lists of Table 5 need fewer integers than Marching Cubes, but not always than the hull's
    triangles.

    Formula (6) gives the number V of vertices from the number of integers; a hull has 2 V - 4 triangles.
    """
    fewer, more = [], {}
    for diameter, (_, triangulated, faces, cells) in zip(DIAMETERS, _table_5(), strict=True):
        # Formula (6) counts 5 integers for each face and 3 for each vertex.
        own = triangulation_size(2 * ((cells - 5 * faces) // 3) - 4)
        fewer.append(cells < triangulated)
        if cells > own:
            more[diameter] = f"{cells} integers against {own} of the hull's own triangles at diameter {diameter}"
    fewer.append(cell_list_size(60, 63) < triangulation_size(3560))
    message = f"the cell list is smaller than the triangles of Marching Cubes in {sum(fewer)} of {len(fewer)} cases; "
    return exhibited(all(fewer) and {*more} == {10, 18}, f"{message}{', '.join(more.values())}")


@claim("kovalevsky-schulz.80", "kovalevsky-schulz.81")
def vertices_of_a_face() -> Check:
    """Check that the half-balls' faces have about five vertices on average, whether over all faces or over bodies."""
    bodies = [half_ball_cells(d) for d in DIAMETERS]
    corners, faces = [sum(len(f.vertices) for f in cells.faces) for cells in bodies], [len(c.faces) for c in bodies]
    single = [Fraction(c, f) for c, f in zip(corners, faces, strict=True)]
    means = Fraction(sum(corners), sum(faces)), sum(single) / len(single)
    exact = sum(economical_size(cells) for cells in bodies)
    by_6 = sum(cell_list_size(len(cells.vertices), len(cells.faces)) for cells in bodies)
    passed = all(round(mean) == 5 for mean in means) and abs(exact - by_6) * 20 < exact
    message = (
        f"{float(means[0]):.2f} vertices for each face, and {float(means[1]):.2f} as the mean of the bodies' means"
    )
    return exhibited(passed, f"{message}; {exact} integers, {by_6} by formula (6)")


@claim("kovalevsky-schulz.157")
def edges_at_vertex() -> Check:
    """Check that the apex of a pyramid on an octagon has eight edges, more than a Cartesian complex allows."""
    octagon = [(sx * x, sy * y, 0) for x, y in ((1, 2), (2, 1)) for sx in (1, -1) for sy in (1, -1)]
    most = max(len(vertex.edges) for vertex in merged(polyhedron([*octagon, (0, 0, 1)])).vertices)
    return exhibited(most == 8, f"a vertex of the cell list has {most} edges")
