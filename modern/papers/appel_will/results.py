"""Compute each published result of Appel and Will, as lines worded like those in the paper.

The coordinates of the object of Fig. 4 are printed, and are read from the corrected print. The paper draws the other
objects without coordinates. This project chose coordinates for them, which are in ``coordinates.toml`` next to the
print.
"""

import math
import tomllib
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from importlib.resources import files
from itertools import combinations

from modern.geometry.vectors import area_vector, cross, dot, minus
from modern.papers import Lines
from modern.papers.appel_will.corners import corners, triple_product, vectors
from modern.papers.appel_will.hull import Assembled, Method, appel_will
from modern.papers.appel_will.star import IntPoint, Pair, as_corrected, project
from modern.papers.appel_will.surfaces import Line, Surface, oriented

# The folder below ``transcripts`` with the printed values.
FOLDER = "appel_will_1976"
# In this module the star polygon test sorts the images, as in the paper. By default the test does not sort them.
BY_STAR = Method(star=as_corrected)
ROMAN = ("I", "II", "III", "IV", "V", "VI", "VII", "VIII")
# The two surfaces of each line of Fig. 18, by the line's label: k, on which the line runs counterclockwise, and l.
FIG_18_LINES = {5: (1, 2), 7: (2, 3), 6: (4, 3)}


@dataclass(frozen=True, slots=True)
class Solid:
    """A polyhedron in a figure: its points, and for each surface, if known, the indices of the points around it."""

    points: tuple[IntPoint, ...]
    surfaces: tuple[Surface, ...] = ()


@cache
def found_solid(name: str) -> Solid:
    """Return the polyhedron of a figure, such as ``fig14``, with coordinates chosen by this project.

    Raise KeyError for an unknown figure.
    """
    text = files("transcripts").joinpath(FOLDER, "coordinates.toml").read_text(encoding="utf-8")
    entry = {entry["id"]: entry for entry in tomllib.loads(text)["solid"]}[name]
    points = tuple((int(x), int(y), int(z)) for x, y, z in entry["points"])
    return Solid(points, tuple(tuple(number - 1 for number in row) for row in entry.get("surfaces", ())))


def printed_solid(printed: Lines) -> Solid:
    """Return the polyhedron of Fig. 4, read from the printed coordinates after correction."""
    rows = [[int(number) for number in line.split()] for line in printed["fig4-vertex-list"]]
    points = tuple((x, y, z) for _, x, y, z in rows)
    maps = [line.split()[1] for line in printed["fig4-topological-map"]]
    return Solid(points, tuple(tuple(int(number) - 1 for number in text.split(",")) for text in maps))


def produced(printed: Lines) -> Lines:
    """Return the lines of each published result that can be computed, by the result's id in ``results.toml``."""
    fig4 = printed_solid(printed)
    hull = appel_will(fig4.points, fig4.surfaces, BY_STAR)
    fig14 = appel_will(found_solid("fig14").points, method=BY_STAR)
    fig23 = appel_will(found_solid("fig23").points, method=BY_STAR)
    fig13 = sorted(deleted.point for deleted in appel_will(found_solid("fig13").points).deleted)
    count = len(fig14.points)
    return {
        "fig4-vertex-list": list(_vertex_list(fig4)),
        "fig4-topological-map": list(_map(fig4.surfaces)),
        "fig4-hull": list(_changes(fig4, hull)),
        "fig5": list(_parallel_lines(fig4.points, (0, 1))),
        "combinations": [f"$$C({count}, 2) = {fig14.projections}, C({count}, 3) = {math.comb(count, 3)}.$$"],
        "fig13": [f"interior points {_listed(_named(fig13))}"],
        "fig14": list(_edge_list(fig14)),
        "figure-number": [_figure_with(printed, "vertex-list", "topological-map")],
        "fig18": list(_determinants(found_solid("fig18"))),
        "fig21": [f"object shown in Fig. 14 would be type {fig14.table.loops[0].kind}"],
        "fig22-loops-1-3": list(_first_three(fig14)),
        "fig22-loops-4-5": list(_last_two(fig14)),
        "fig23-edges": list(_edge_list(fig23)),
        "fig23-loops": list(_loop_rows(fig23, ((0, 2), (2, 5)))),
        "fig23-map": list(_map_rows(fig23)),
    }


def _vertex_list(solid: Solid) -> Iterator[str]:
    """Compute each point of Fig. 4 as the intersection of its three surfaces, to confirm the printed coordinates.

    The planes are computed without the point. A misread coordinate therefore cannot confirm its own value.
    """
    for index in range(len(solid.points)):
        planes = []
        for surface in solid.surfaces:
            if index in surface:
                remaining = tuple(point for point in surface if point != index)
                normal = area_vector(solid.points, remaining)
                planes.append((normal, dot(normal, solid.points[remaining[0]])))
        # Cramer's rule for the planes p x = a, q x = b, r x = c: x = (a q*r + b r*p + c p*q) / [pqr].
        (p, a), (q, b), (r, c) = planes
        parts = zip(cross(q, r), cross(r, p), cross(p, q), strict=True)
        at = [Fraction(a * u + b * v + c * w, triple_product(p, q, r)) for u, v, w in parts]
        yield " ".join(map(str, (index + 1, *at)))


def _map(surfaces: Sequence[Surface]) -> Iterator[str]:
    for number, surface in enumerate(surfaces):
        others = [set(points) for k, points in enumerate(surfaces) if k != number]
        path = [surface[0]]
        while len(path) < len(surface):
            neighbours = [p for p in surface if p not in path and any({p, path[-1]} <= points for points in others)]
            # The second printed point shows in which direction the print runs around the surface.
            path.append(surface[1] if len(path) == 1 and surface[1] in neighbours else neighbours[0])
        yield f"{ROMAN[number]} {','.join(_named(path))}"


def _changes(fig4: Solid, hull: Assembled) -> Iterator[str]:
    # Fig. 4: a surface in a plane of the hull is kept or respecified, every other one is deleted.
    fates = hull.fates(fig4.surfaces)
    deleted = [index for index in range(len(fig4.points)) if index not in hull.vertices]
    deleted_surfaces = [number for number, face in enumerate(fates.of) if face is None]
    changed = [number for number, face in enumerate(fates.of) if face is not None and number not in fates.unchanged]
    yield f"Points {_listed(_named(deleted))} have been deleted"
    yield f"surfaces {_listed(ROMAN[number] for number in deleted_surfaces)} have been deleted"
    for position, number in enumerate(fates.added):
        points = ", ".join(_named(_from_lowest(hull.surfaces[number])))
        yield f"Surface {ROMAN[len(fig4.surfaces) + position]} with connectivity {points}"
    yield f"surfaces {_listed(ROMAN[number] for number in changed)} must be respecified"


def _parallel_lines(points: Sequence[IntPoint], pair: Pair) -> Iterator[str]:
    """Find the lines parallel to the line of ``pair``, and report which of them are edges of the hull (Fig. 5)."""
    along = minus(points[pair[1]], points[pair[0]])
    lines = [
        (i, j) for i, j in combinations(range(len(points)), 2) if not any(cross(along, minus(points[j], points[i])))
    ]
    convex = [line for line in lines if as_corrected(project(points, line, range(len(points))).images)]
    yield f"lines {_listed(f'({i + 1}, {j + 1})' for i, j in convex)} are convex points"
    for i, j in lines:
        if (i, j) not in convex:
            yield f"line ({i + 1},{j + 1}) is not a convex point"


def _edge_list(hull: Assembled) -> Iterator[str]:
    for label, (i, j) in enumerate(hull.edges, 1):
        yield f"{label} {i + 1} {j + 1}"


def _figure_with(names: Collection[str], *parts: str) -> str:
    (figure,) = {name.split("-")[0] for name in names if all(f"{name.split('-')[0]}-{part}" in names for part in parts)}
    return f"As illustrated in Fig. {figure.removeprefix('fig')}"


def _determinants(solid: Solid) -> Iterator[str]:
    # The columns of the determinant are the direction I and the inward normals K and L of the two surfaces.
    surfaces = oriented(solid.points, solid.surfaces)
    solid_lines = [corner.line for corner in corners(solid.points, surfaces)]
    for label, (on, beyond) in FIG_18_LINES.items():
        (line,) = [line for line in solid_lines if {line.on, line.beyond} == {on - 1, beyond - 1}]
        if line.on != on - 1:
            # The figure directs the line as on the other surface.
            line = Line(line.ends[::-1], line.beyond, line.on)
        columns = vectors(solid.points, surfaces, line)
        rows = r" \\ ".join(" & ".join(map(str, row)) for row in zip(*columns, strict=True))
        product = triple_product(*columns)
        yield rf"$$[{label}{on}{beyond}] = \begin{{bmatrix}} {rows} \end{{bmatrix}} = {product}$$"
        yield "outside corner" if product > 0 else "inside corner"


def _first_three(hull: Assembled) -> Iterator[str]:
    """Compute the upper half of the table in Fig. 22: the entries of three loops, then a row for each edge."""
    # Fig. 22 prints each loop next to the counts IUC of all edges after it.
    loops = hull.table.loops[:3]
    yield " ".join(f"{_numbers(len(loop.entries))} {_joined(loop.entries)}" for loop in loops)
    for label in range(1, len(hull.edges) + 1):
        yield " ".join(f"{label} {loop.uses[label - 1]}" for loop in loops)


def _last_two(hull: Assembled) -> Iterator[str]:
    """Compute the lower half of the table in Fig. 22. As in the scan, rows 2 to 6 and rows 7 to 9 are one line each."""
    loops = hull.table.loops[3:]
    yield " ".join(f"{_numbers(len(loop.entries))} {_joined(loop.entries)}" for loop in loops)
    for first, last in ((1, 1), (2, 6), (7, 9)):
        row = " ".join(f"{_numbers(last, first)} {_joined(loop.uses[first - 1 : last])}" for loop in loops)
        remark = " All 2's indicate end of processing" if {*hull.table.uses} == {2} else ""
        yield row + (remark if first == 2 else "")


def _loop_rows(hull: Assembled, groups: Iterable[Pair]) -> Iterator[str]:
    """Compute the table of loops in Fig. 23. Each of the ``groups`` of rows is one line, as in the scanned text."""
    for first, last in groups:
        cells = (_joined(loop.entries[first:last]) for loop in hull.table.loops)
        yield f"{_numbers(last, first + 1)} {' '.join(cells)}"


def _map_rows(hull: Assembled) -> Iterator[str]:
    """Compute the table of surfaces and their points in Fig. 23, which has a column for each surface."""
    for row in range(max(map(len, hull.surfaces))):
        cells = (str(surface[row] + 1) for surface in hull.surfaces if row < len(surface))
        yield " ".join((str(row + 1), *cells))


def _from_lowest(surface: Surface) -> Surface:
    """Return the points around a surface, beginning with the lowest number, then the lower of its two neighbours."""
    start = surface.index(min(surface))
    cycle = surface[start:] + surface[:start]
    return cycle if cycle[1] < cycle[-1] else (cycle[0], *cycle[:0:-1])


def _named(indices: Iterable[int]) -> list[str]:
    return [str(index + 1) for index in indices]


def _listed(names: Iterable[str]) -> str:
    """Join names as the paper prints lists: ``3 and 4``, or ``2, 3, 6, and 7``."""
    *front, last = names
    return f"{', '.join(front)}{',' if len(front) > 1 else ''} and {last}" if front else last


def _numbers(last: int, first: int = 1) -> str:
    return _joined(range(first, last + 1))


def _joined(numbers: Iterable[int]) -> str:
    return " ".join(map(str, numbers))
