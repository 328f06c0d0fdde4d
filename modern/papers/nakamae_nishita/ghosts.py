"""Find ghost lines: edges that must not be drawn because they only divide a plane face of an object (section 3.4).

If two edges of one object overlap and their front faces lie in one plane, the common part of the edges is not drawn.
The object, the plane and the line of an edge form a key, and only edges with the same key are compared.
"""

import math
from collections import Counter, defaultdict
from collections.abc import Sequence
from fractions import Fraction

from modern.drawing.visible import FLAT, line_through
from modern.papers.nakamae_nishita.projection import Homogeneous
from modern.papers.nakamae_nishita.solids import Solid

Span = tuple[Fraction, Fraction]
# An edge is named by the number of its solid and the indices of its two vertices, the smaller first.
Name = tuple[int, int, int]

_Key = tuple[object, ...]


def ghosts(solids: Sequence[Solid], facing: int = 1) -> dict[Name, list[Span]]:
    """Return the parts of each edge that must not be drawn, as intervals of fractions of the edge.

    ``facing`` is 1 for front faces, as in the paper, or -1 for back faces, which are needed only to draw hidden lines.
    """
    # Only an object of at least two polyhedra has ghost lines.
    parts = Counter(solid.polyhedron.thing for solid in solids if solid.polyhedron.thing)
    # Group the edges by object, plane of a face, and line of the image. If edges in one plane have images on one line,
    # they are on one line in space.
    lines: dict[_Key, list[Name]] = defaultdict(list)
    for solid in solids:
        if parts[solid.polyhedron.thing] < 2:
            continue
        for edge in solid.edges:
            if edge.kind == FLAT:
                continue
            a, b = solid.points[edge.start], solid.points[edge.end]
            for face in edge.faces:
                if solid.signs[face] == facing:
                    # Opposite coefficients describe one line, but the two sides of a plane are different faces.
                    line = _lowest(line_through((a[0], a[1], a[3]), (b[0], b[1], b[3])))
                    key = (solid.polyhedron.thing, _lowest(solid.planes[face]), max(line, tuple(-n for n in line)))
                    lines[key].append((solid.number, edge.start, edge.end))
    # Section 3.4: the part that an edge has in common with an edge of another polyhedron is a ghost.
    spans: dict[Name, list[Span]] = defaultdict(list)
    for group in lines.values():
        for name in group if len(group) > 1 else ():
            for partner in group:
                span = _shared(solids, name, partner) if name[0] != partner[0] else None
                if span:
                    spans[name].append(span)
    return dict(spans)


def _shared(solids: Sequence[Solid], name: Name, partner: Name) -> Span | None:
    """Return the part of an edge that another edge on the same line covers, as an interval, or None."""
    a, b = (solids[name[0]].points[place] for place in name[1:])
    ends = sorted(_fraction(a, b, solids[partner[0]].points[place]) for place in partner[1:])
    low, high = max(ends[0], Fraction(0)), min(ends[1], Fraction(1))
    return (low, high) if low < high else None


def _fraction(a: Homogeneous, b: Homogeneous, c: Homogeneous) -> Fraction:
    """Return the position of c on the line from a to b in space, as a fraction of the distance from a to b."""
    axis = 0 if a[0] * b[3] != b[0] * a[3] else 1
    at_a, at_b = a[axis] * c[3] - c[axis] * a[3], b[axis] * c[3] - c[axis] * b[3]
    return Fraction(at_a, at_a - at_b)


def _lowest(numbers: Sequence[int]) -> tuple[int, ...]:
    divisor = math.gcd(*numbers)
    return tuple(number // divisor for number in numbers)
