"""What the paper prints, computed: the lines of every published result, in the words of the print.

The object of Fig. 4 is read from the corrected print itself.  Other objects are drawn without data in the paper; their
coordinates, found and not printed, are in ``coordinates.toml`` beside the print.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from importlib.resources import files
from itertools import combinations

from modern.geometry.vectors import cross, dot, minus
from modern.papers import Lines
from modern.papers.appel_will.corners import corners, triple_product, vectors
from modern.papers.appel_will.edges import IntPoint, Pair, project
from modern.papers.appel_will.hull import Assembled, Method, appel_will
from modern.papers.appel_will.star import as_corrected
from modern.papers.appel_will.surfaces import Line, Surface, area_normal, oriented

FOLDER = "appel_will_1976"
"""Of the print under ``transcripts``."""
BY_STAR = Method(star=as_corrected)
"""With the star polygon itself, as the paper has it, not its short form."""
ROMAN = ("I", "II", "III", "IV", "V", "VI", "VII", "VIII")
FIG_18_LINES = {5: (1, 2), 7: (2, 3), 6: (4, 3)}
"""The lines of Fig. 18 by their labels: surface k, on which the line runs counterclockwise, and surface l."""


@dataclass(frozen=True, slots=True)
class Solid:
    """An object of a figure: points, and surfaces where it has a map, both from 0."""

    points: tuple[IntPoint, ...]
    surfaces: tuple[Surface, ...] = ()


def found_solid(name: str) -> Solid:
    """An object whose coordinates this project found, by its figure (``fig14``).  Raises KeyError."""
    text = files("transcripts").joinpath(FOLDER, "coordinates.toml").read_text(encoding="utf-8")
    entries = {entry["id"]: entry for entry in tomllib.loads(text)["solid"]}
    entry = entries[name]
    points = tuple((int(x), int(y), int(z)) for x, y, z in entry["points"])
    return Solid(points, tuple(tuple(number - 1 for number in row) for row in entry.get("surfaces", ())))


def printed_solid(printed: Lines) -> Solid:
    """The object of Fig. 4 as the corrected print has it."""
    rows = [[int(word) for word in line.split()] for line in printed["fig4-vertex-list"]]
    points = tuple((x, y, z) for _, x, y, z in rows)
    maps = [line.split()[1] for line in printed["fig4-topological-map"]]
    return Solid(points, tuple(tuple(int(number) - 1 for number in text.split(",")) for text in maps))


def produced(printed: Lines) -> Lines:
    """The lines of every published result that can be computed, by its id in ``results.toml``."""
    given = printed_solid(printed)
    hull = appel_will(given.points, given.surfaces, BY_STAR)
    fig14 = appel_will(found_solid("fig14").points, method=BY_STAR)
    fig23 = appel_will(found_solid("fig23").points, method=BY_STAR)
    return {
        "fig4-vertex-list": list(_vertex_list(given)),
        "fig4-topological-map": list(_map(given.surfaces)),
        "fig4-hull": list(_changes(given, hull)),
        "fig5": list(_parallel_lines(given.points, (0, 1))),
        "combinations": [_combinations(fig14)],
        "fig13": [f"interior points {_listed(_named(_deleted(found_solid('fig13'))))}"],
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
    """Every point as the intersection of its surfaces, each plane from the surface's other points."""
    for index in range(len(solid.points)):
        planes = []
        for surface in solid.surfaces:
            if index in surface:
                others = tuple(other for other in surface if other != index)
                normal = area_normal(solid.points, others)
                planes.append((normal, dot(normal, solid.points[others[0]])))
        (p, a), (q, b), (r, c) = planes
        parts = zip(cross(q, r), cross(r, p), cross(p, q), strict=True)
        at = [Fraction(a * u + b * v + c * w, triple_product(p, q, r)) for u, v, w in parts]
        yield " ".join(map(str, (index + 1, *at)))


def _map(surfaces: Sequence[Surface]) -> Iterator[str]:
    """Every surface from its first point on, along the lines it has in common with another surface."""
    for number, surface in enumerate(surfaces):
        others = [set(other) for place, other in enumerate(surfaces) if place != number]
        way = [surface[0]]
        while len(way) < len(surface):
            beside = [p for p in surface if p not in way and any({p, way[-1]} <= other for other in others)]
            # Of the two ways around, the print's second point chooses.
            way.append(surface[1] if len(way) == 1 and surface[1] in beside else beside[0])
        yield f"{ROMAN[number]} {','.join(_named(way))}"


def _changes(given: Solid, hull: Assembled) -> Iterator[str]:
    """The caption of Fig. 4."""
    fates = hull.fates(given.surfaces)
    deleted = [index for index in range(len(given.points)) if index not in hull.vertices]
    gone = [number for number, other in enumerate(fates.of) if other is None]
    changed = [number for number, other in enumerate(fates.of) if other is not None and number not in fates.kept]
    yield f"Points {_listed(_named(deleted))} have been deleted"
    yield f"surfaces {_listed(ROMAN[number] for number in gone)} have been deleted"
    for place, number in enumerate(fates.added):
        points = ", ".join(_named(_from_lowest(hull.surfaces[number])))
        yield f"Surface {ROMAN[len(given.surfaces) + place]} with connectivity {points}"
    yield f"surfaces {_listed(ROMAN[number] for number in changed)} must be respecified"


def _parallel_lines(points: Sequence[IntPoint], pair: Pair) -> Iterator[str]:
    """All lines that project to points together with ``pair``, and which of them are convex edges (Fig. 5)."""
    along = minus(points[pair[1]], points[pair[0]])
    lines = [
        (i, j) for i, j in combinations(range(len(points)), 2) if not any(cross(along, minus(points[j], points[i])))
    ]
    convex = [line for line in lines if as_corrected(project(points, line, range(len(points))).images)]
    yield f"lines {_listed(f'({i + 1}, {j + 1})' for i, j in convex)} are convex points"
    for i, j in lines:
        if (i, j) not in convex:
            yield f"line ({i + 1},{j + 1}) is not a convex point"


def _combinations(hull: Assembled) -> str:
    count = len(hull.points)
    return f"$$C({count}, 2) = {hull.projections}, C({count}, 3) = {math.comb(count, 3)}.$$"


def _deleted(solid: Solid) -> list[int]:
    return sorted(deleted.point for deleted in appel_will(solid.points).deleted)


def _edge_list(hull: Assembled) -> Iterator[str]:
    for label, (i, j) in enumerate(hull.edges, 1):
        yield f"{label} {i + 1} {j + 1}"


def _figure_with(names: Collection[str], *parts: str) -> str:
    """The figure that the data of this project take all of ``parts`` from."""
    (figure,) = {name.split("-")[0] for name in names if all(f"{name.split('-')[0]}-{part}" in names for part in parts)}
    return f"As illustrated in Fig. {figure.removeprefix('fig')}"


def _determinants(solid: Solid) -> Iterator[str]:
    surfaces = oriented(solid.points, solid.surfaces)
    found = [corner.line for corner in corners(solid.points, surfaces)]
    for label, (on, beyond) in FIG_18_LINES.items():
        (line,) = [line for line in found if {line.on, line.beyond} == {on - 1, beyond - 1}]
        if line.on != on - 1:
            line = Line(line.ends[::-1], line.beyond, line.on)
        columns = vectors(solid.points, surfaces, line)
        rows = r" \\ ".join(" & ".join(map(str, row)) for row in zip(*columns, strict=True))
        product = triple_product(*columns)
        yield rf"$$[{label}{on}{beyond}] = \begin{{bmatrix}} {rows} \end{{bmatrix}} = {product}$$"
        yield "outside corner" if product > 0 else "inside corner"


def _first_three(hull: Assembled) -> Iterator[str]:
    """Fig. 22's upper half: entries of three loops, then a row an edge."""
    loops = hull.table.loops[:3]
    yield " ".join(f"{_numbers(len(loop.entries))} {_joined(loop.entries)}" for loop in loops)
    for label in range(1, len(hull.edges) + 1):
        yield " ".join(f"{label} {loop.uses[label - 1]}" for loop in loops)


def _last_two(hull: Assembled) -> Iterator[str]:
    """Fig. 22's lower half, its rows grouped as the OCR has them: line 1, lines 2 to 6, lines 7 to 9."""
    loops = hull.table.loops[3:]
    yield " ".join(f"{_numbers(len(loop.entries))} {_joined(loop.entries)}" for loop in loops)
    for first, last in ((1, 1), (2, 6), (7, 9)):
        row = " ".join(f"{_numbers(last, first)} {_joined(loop.uses[first - 1 : last])}" for loop in loops)
        remark = " All 2's indicate end of processing" if hull.table.closed else ""
        yield row + (remark if first == 2 else "")


def _loop_rows(hull: Assembled, groups: Iterable[Pair]) -> Iterator[str]:
    """Fig. 23's loop table, its rows grouped as the OCR has them."""
    for first, last in groups:
        cells = (_joined(loop.entries[first:last]) for loop in hull.table.loops)
        yield f"{_numbers(last, first + 1)} {' '.join(cells)}"


def _map_rows(hull: Assembled) -> Iterator[str]:
    """Fig. 23's topological map: a column a surface."""
    for place in range(max(map(len, hull.surfaces))):
        cells = (str(surface[place] + 1) for surface in hull.surfaces if place < len(surface))
        yield " ".join((str(place + 1), *cells))


def _from_lowest(surface: Surface) -> Surface:
    """A surface from its point of lowest number towards the lower of that point's neighbours."""
    start = surface.index(min(surface))
    turned = surface[start:] + surface[:start]
    return turned if turned[1] < turned[-1] else (turned[0], *turned[:0:-1])


def _named(indices: Iterable[int]) -> list[str]:
    return [str(index + 1) for index in indices]


def _listed(words: Iterable[str]) -> str:
    """``3 and 4``; ``2, 3, 6, and 7``."""
    *some, last = words
    return f"{', '.join(some)}{',' if len(some) > 1 else ''} and {last}" if some else last


def _numbers(last: int, first: int = 1) -> str:
    return _joined(range(first, last + 1))


def _joined(numbers: Iterable[int]) -> str:
    return " ".join(map(str, numbers))
