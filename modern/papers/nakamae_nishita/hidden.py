"""Hidden lines of a scene: the third step of the paper (sections 3.2 to 3.5, time III), after its first two."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from modern.drawing.visible import BACK
from modern.geometry.vectors import Vector
from modern.papers.nakamae_nishita.clipping import beyond_near
from modern.papers.nakamae_nishita.contours import Tables, Values, boxes, overlapping, tables, values
from modern.papers.nakamae_nishita.crossings import Passage, as_printed, clipped
from modern.papers.nakamae_nishita.ghosts import Name, Span, ghosts
from modern.papers.nakamae_nishita.nearness import BY_PLANE, UNDECIDED, By, by_formulas, by_plane
from modern.papers.nakamae_nishita.polyhedron import Polyhedron, SceneError
from modern.papers.nakamae_nishita.projection import Observer
from modern.papers.nakamae_nishita.solids import Solid, solid

ENCLOSED, TOUCHING, ENDS, GHOSTS = "enclosed", "touching", "ends", "ghosts"
REFINEMENTS = (ENCLOSED, TOUCHING, ENDS, GHOSTS)
"""What may be left out, to see what it is for.  Three close gaps of the paper: ``enclosed``, a segment wholly
within a nearer contour has no intersection, so nothing in section 3.5 counts it as hidden; ``touching``, where
polyhedra touch (4) and (5) may both be 0, and a separating plane decides; ``ends``, a segment that ends on a contour or
runs through its corner has d = -2 or -1 there, which (6) does not cover.  ``ghosts`` is the paper's own section 3.4."""


@dataclass(frozen=True, slots=True)
class Relation:
    """Two polyhedra whose contours overlap: V and V' by number, their tables, which is the nearer and by what.

    nearer: 1 V, -1 V', 0 neither.
    """

    v: int
    w: int
    tables: Tables
    nearer: int
    by: By


@dataclass(frozen=True, slots=True)
class Piece:
    """A part of an edge or figure: the polyhedron by number, the ends of the edge by place in ``Solid.points``, from
    where to where as fractions of the way in space, and whether it is seen."""

    solid: int
    start: int
    end: int
    first: Fraction
    last: Fraction
    seen: bool


@dataclass(frozen=True, slots=True)
class Passages:
    """How one segment runs: the polyhedron, the segment's place in ``Solid.segments``, its passage behind each nearer
    polyhedron by number, and its parts that are ghosts."""

    solid: int
    segment: int
    behind: tuple[tuple[int, Passage], ...]
    ghosts: tuple[Span, ...]

    @property
    def order(self) -> int:
        """The order of invisibility of P_A."""
        return sum(passage.order + passage.enclosed for _, passage in self.behind)


@dataclass(frozen=True, slots=True)
class Drawing:
    """A scene without its hidden lines.  ``seconds``: of the paper's three steps, making, searching, eliminating.

    cut, behind: the names of the polyhedra that the near plane cuts, and of those wholly behind it, which are left out.
    """

    observer: Observer
    solids: tuple[Solid, ...]
    relations: tuple[Relation, ...]
    passages: tuple[Passages, ...]
    pieces: tuple[Piece, ...]
    seconds: tuple[float, float, float]
    cut: tuple[str, ...] = ()
    behind: tuple[str, ...] = ()

    @property
    def counts(self) -> tuple[int, int, int, int]:
        """The columns of Table 1: convex polyhedra, vertices, faces, points of figures."""
        found = [item.polyhedron for item in self.solids]
        return (
            len(found),
            sum(len(item.vertices) for item in found),
            sum(len(item.faces) for item in found),
            sum(len(figure.corners) for item in found for figure in item.figures),
        )


def draw(
    made: Sequence[Polyhedron] | Callable[[], Sequence[Polyhedron]],
    observer: Observer,
    without: Collection[str] = (),
    hidden: bool = False,
    check: bool = True,
) -> Drawing:
    """Draw convex polyhedra, or what a function makes, which is then timed as the first step.

    without: names from ``REFINEMENTS`` to leave out.  hidden: the hidden parts are pieces too, and edges of faces that
    all turn away.  check: prove of every pair whose contours overlap that they do not intersect.

    Raises SceneError for polyhedra that intersect, one not wholly before the observation point where there is no near
    plane, and a name that is none of these.
    """
    strange = sorted(set(without) - set(REFINEMENTS))
    if strange:
        raise SceneError(f"{strange[0]!r} is not one of {', '.join(REFINEMENTS)}")
    started = time.perf_counter()
    given = made() if callable(made) else made
    kept = beyond_near(given, observer)
    polyhedra = kept.polyhedra
    searched = time.perf_counter()
    origin = _origin(polyhedra)
    solids = tuple(solid(number, polyhedron, observer, origin) for number, polyhedron in enumerate(polyhedra))
    eliminated = time.perf_counter()
    behind: list[list[list[tuple[int, Passage]]]] = [[[] for _ in item.segments] for item in solids]
    relations = []
    for relation, of_v, of_w in _relations(solids, without, check):
        relations.append(relation)
        v, w = solids[relation.v], solids[relation.w]
        if relation.nearer > 0:
            _pass(behind[w.number], w, v, of_v, without)
        elif relation.nearer < 0:
            _pass(behind[v.number], v, w, of_w, without)
    apart: dict[Name, list[Span]] = {} if GHOSTS in without else ghosts(solids)
    passages = tuple(
        Passages(item.number, place, tuple(found), tuple(apart.get((item.number, segment.start, segment.end), ())))
        for item in solids
        for place, (segment, found) in enumerate(zip(item.segments, behind[item.number], strict=True))
    )
    turned = ghosts(solids, -1) if hidden and GHOSTS not in without else {}
    pieces = [piece for passage in passages for piece in _pieces(solids, passage, turned, hidden)]
    if hidden:
        pieces += [piece for item in solids for piece in _backs(item, turned)]
    ended = time.perf_counter()
    seconds = (searched - started, eliminated - searched, ended - eliminated)
    return Drawing(observer, solids, tuple(relations), passages, tuple(pieces), seconds, kept.cut, kept.behind)


def _origin(polyhedra: Sequence[Polyhedron]) -> Vector:
    if not polyhedra:
        raise SceneError("there are no polyhedra")
    x, y, z = (Fraction(math.floor(number)) for number in polyhedra[0].vertices[0])
    return x, y, z


def _relations(
    solids: Sequence[Solid], without: Collection[str], check: bool
) -> Iterator[tuple[Relation, Values, Values]]:
    """Every pair whose contours overlap, with formula (1) of each one's contour at the other's points."""
    contours = [item.images[: len(item.contour)] for item in solids]
    for first, second in overlapping(boxes(contours)):
        v, w = solids[first], solids[second]
        of_v = values(v.lines, w.images)
        of_w = values(w.lines, v.images) if of_v is not None else None
        if of_v is None or of_w is None:
            continue
        m, n = len(v.contour), len(w.contour)
        found = tables([column[:n] for column in of_v], [row[:m] for row in of_w])
        nearer, by = by_formulas(v, w, found, of_v, of_w)
        if check or (by == UNDECIDED and TOUCHING not in without):
            side, plane = by_plane(v, w)
            if plane is None:
                raise SceneError(f"{v.polyhedron.name} and {w.polyhedron.name} intersect")
            if by == UNDECIDED and TOUCHING not in without:
                nearer, by = side, BY_PLANE
        yield Relation(first, second, found, nearer, by), of_v, of_w


def _pass(
    behind: list[list[tuple[int, Passage]]], far: Solid, near: Solid, of_near: Values, without: Collection[str]
) -> None:
    """Take down how the segments of the far polyhedron run behind the near one."""
    contour = near.images[: len(near.contour)]
    for found, segment in zip(behind, far.segments, strict=True):
        if ENDS in without:
            ends = far.points[segment.start], far.points[segment.end]
            passage = as_printed(of_near, segment.first, segment.last, ends, contour)
        else:
            passage = clipped(of_near, segment.first, segment.last)
        if passage.marks or (passage.enclosed and ENCLOSED not in without):
            found.append((near.number, passage))


def _pieces(
    solids: Sequence[Solid], passages: Passages, turned: dict[Name, list[Span]], hidden: bool
) -> Iterator[Piece]:
    """The parts of a segment, by counting the indices from P_A on; it is seen where the order is 0.

    A ghost is left out of what is seen and of what is hidden; an edge that divides a face turned away, of what is
    hidden.
    """
    segment = solids[passages.solid].segments[passages.segment]
    if not passages.behind and not passages.ghosts:
        yield Piece(passages.solid, segment.start, segment.end, _START, _END, True)
        return
    marks: list[tuple[Fraction, int, int, int]] = [(_END, 0, 0, 0)]
    marks += [(place, index, 0, 0) for _, passage in passages.behind for place, index in passage.marks]
    for low, high in passages.ghosts:
        marks += [(low, 0, 1, 0), (high, 0, -1, 0)]
    for low, high in turned.get((passages.solid, segment.start, segment.end), ()):
        marks += [(low, 0, 0, 1), (high, 0, 0, -1)]
    order, ghost, back = passages.order, 0, 0
    last, drawn = _START, ""
    since = _START
    for place, index, ghosted, turning in sorted(marks):
        if place > last:
            state = "" if ghost or (order and (back or not hidden)) else "hidden" if order else "seen"
            if state != drawn:
                if drawn:
                    yield Piece(passages.solid, segment.start, segment.end, since, last, drawn == "seen")
                since, drawn = last, state
            last = place
        order, ghost, back = order + index, ghost + ghosted, back + turning
    if drawn:
        yield Piece(passages.solid, segment.start, segment.end, since, _END, drawn == "seen")


def _backs(item: Solid, turned: dict[Name, list[Span]]) -> Iterator[Piece]:
    """The edges of faces that all turn away, but for ghosts."""
    for edge in item.edges:
        if edge.kind == BACK:
            since = _START
            for low, high in sorted(turned.get((item.number, edge.start, edge.end), ())):
                if low > since:
                    yield Piece(item.number, edge.start, edge.end, since, low, False)
                since = max(since, high)
            if since < _END:
                yield Piece(item.number, edge.start, edge.end, since, _END, False)


_START, _END = Fraction(0), Fraction(1)
