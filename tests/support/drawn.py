"""Hulls to be drawn, and a parsed picture for tests."""

import re
from collections.abc import Sequence
from xml.etree import ElementTree

from modern.drawing.draw import draw_svg
from modern.geometry.hull import Hull
from modern.port import convex_hull

Whole = tuple[int, int, int]
Plane = tuple[int, int, int, int]
Place = tuple[float, float]

CUBE: list[Whole] = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
OCTAHEDRON: list[Whole] = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
BOX: list[Whole] = [(4 * x, 4 * y, 4 * z) for x, y, z in CUBE] + [(2, 2, 2), (2, 0, 2), (2, 4, 2), (3, 4, 4), (0, 0, 3)]
SQUARE: list[Whole] = [(0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1), (1, 1, 1), (1, 0, 1)]
EXAMPLE_6: list[Whole] = [
    *((3, 4, 8), (6, -3, 7), (1, 2, -5), (4, 2, -3), (4, 2, 4), (4, 2, 0), (4, 2, -1)),
    *((1, 2, 7), (0, 2, 0), (-2, 2, 0)),
]


# --- reading a picture


class Picture:
    """A parsed SVG file: lines by the vertices they join, circles and crosses by class, numbers with positions."""

    def __init__(self, text: str) -> None:
        self.root = ElementTree.fromstring(text)
        self.groups = {group.get("class"): list(group) for group in self.root if group.get("class")}

    def edges(self, key: str) -> dict[tuple[int, int], tuple[Place, Place]]:
        ends = {}
        for line in self.groups.get(key, []):
            a, b = map(int, line.attrib["data-vertices"].split())
            x1, y1, x2, y2 = (float(line.attrib[name]) for name in ("x1", "y1", "x2", "y2"))
            ends[a - 1, b - 1] = ((x1, y1), (x2, y2))
        return ends

    def vertices(self) -> dict[int, Place]:
        """Return positions by vertex, counted from 0, read from the title of every dot."""
        positions = {}
        for dot in (*self.groups.get("vertices", []), *self.groups.get("vertices-hidden", [])):
            named = re.match(r"vertex (\d+): ", dot[0].text or "")
            assert named
            positions[int(named[1]) - 1] = (float(dot.attrib["cx"]), float(dot.attrib["cy"]))
        return positions

    def titles(self, key: str) -> list[str]:
        return [mark[0].text or "" for mark in self.groups.get(key, [])]

    def numbers(self) -> dict[str, Place]:
        return {
            text.text or "": (float(text.attrib["x"]), float(text.attrib["y"]))
            for text in self.groups.get("numbers", [])
        }

    def legend(self) -> list[str]:
        return [item.text or "" for item in self.groups["legend"] if item.tag.endswith("text")]


def draw(points: Sequence[Sequence[object]], eye: Sequence[int] | None = None) -> tuple[Hull, Picture]:
    hull = convex_hull(points)
    return hull, Picture(draw_svg(hull, eye))
