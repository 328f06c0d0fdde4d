"""The intermediate results of a drawing as text, and its counts as a row of the paper's Table 1.

The intermediate results are faces and edges, the PL and LP tables with d, and the indices of the intersections.
"""

from collections import Counter
from collections.abc import Iterator
from typing import get_args

from modern.drawing.visible import Kind
from modern.papers.nakamae_nishita.hidden import Drawing, Passages, Relation

_KINDS: tuple[Kind, ...] = get_args(Kind)


def table1(drawing: Drawing) -> Iterator[str]:
    """Yield the columns of the paper's Table 1 with the seconds that its three steps took here."""
    counts = drawing.counts
    yield "polyhedra  vertices  faces  points       I      II     III  (seconds)"
    times = "".join(f"{seconds:8.3f}" for seconds in drawing.seconds)
    yield f"{counts[0]:9d}{counts[1]:10d}{counts[2]:7d}{counts[3]:8d}{times}"


def tables(drawing: Drawing) -> Iterator[str]:
    """Yield all tables: the polyhedra, the pairs with overlapping contours, and the segments behind a contour."""
    for solid in drawing.solids:
        kinds = Counter(edge.kind for edge in solid.edges)
        yield f"{solid.number + 1}. {solid.polyhedron.name}"
        yield "  front faces " + (" ".join(str(k) for k, sign in enumerate(solid.signs, 1) if sign > 0) or "none")
        yield "  contour " + (" ".join(str(place + 1) for place in solid.contour) or "none")
        yield "  edges " + ", ".join(f"{kinds[kind]} {kind}" for kind in _KINDS if kinds[kind])
    for relation in drawing.relations:
        yield from _relation(drawing, relation)
    for passages in drawing.passages:
        if passages.behind or passages.ghosts:
            yield from _passages(drawing, passages)


def _relation(drawing: Drawing, relation: Relation) -> Iterator[str]:
    v, w = drawing.solids[relation.v], drawing.solids[relation.w]
    nearer = {1: f"V = {v.number + 1} is nearer", -1: f"V' = {w.number + 1} is nearer", 0: "neither hides the other"}
    yield f"V = {v.number + 1}, V' = {w.number + 1}: {nearer[relation.nearer]}, by {relation.by}"
    columns = [place + 1 for place in v.contour]
    pair = relation.tables
    # Formulas (2) and (3): rows for the vertices of V', columns for those of V, as the paper prints the tables.
    d = tuple(tuple(pair.crossing_number(i, j) for i in range(len(columns))) for j in range(len(pair.pl)))
    for title, rows in (("PL", pair.pl), ("LP", pair.lp), ("d", d)):
        yield f"  {title:4}" + "".join(f"{column:4d}" for column in columns)
        for place, row in zip(w.contour, rows, strict=True):
            yield f"  {place + 1:4d}" + "".join(f"{number:4d}" for number in row)


def _passages(drawing: Drawing, passages: Passages) -> Iterator[str]:
    segment = drawing.solids[passages.solid].segments[passages.segment]
    yield f"{passages.solid + 1}: {segment.start + 1}-{segment.end + 1} ({segment.kind}), order {passages.order}"
    for near, passage in passages.behind:
        marks = ", ".join(f"{index:+d} at {place}" for place, index in passage.marks)
        yield f"  behind {near + 1}: {marks or 'enclosed'}"
    for low, high in passages.ghosts:
        yield f"  ghost from {low} to {high}"
