"""Draw a scene with hidden lines removed: the paper's complete method. Sections 3.2 to 3.5 define its third step."""

import math
import time
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from emulator.errors import quoted
from modern.drawing.visible import BACK
from modern.papers.nakamae_nishita.clipping import beyond_near
from modern.papers.nakamae_nishita.contours import Tables, Values, boxes, overlapping, tables, values
from modern.papers.nakamae_nishita.crossings import Passage, as_printed, clipped
from modern.papers.nakamae_nishita.ghosts import Name, Span, ghosts
from modern.papers.nakamae_nishita.nearness import BY_PLANE, UNDECIDED, By, by_formulas, by_plane
from modern.papers.nakamae_nishita.polyhedron import Polyhedron, SceneError
from modern.papers.nakamae_nishita.projection import Observer
from modern.papers.nakamae_nishita.solids import Solid, solid

ENCLOSED, TOUCHING, ENDS, GHOSTS = "enclosed", "touching", "ends", "ghosts"
# Refinements that can be switched off to show their effect. The first three close gaps of the paper.
# ``enclosed``: a segment entirely within a nearer contour has no intersection, so section 3.5 would not hide it.
# ``touching``: if polyhedra touch, formulas (4) and (5) may both be 0, and a separating plane decides.
# ``ends``: if a segment ends on a contour or runs through its vertex, d is -2 or -1, and formula (6) does not apply.
# ``ghosts``: ghost lines are omitted, as the paper requires in section 3.4.
REFINEMENTS = (ENCLOSED, TOUCHING, ENDS, GHOSTS)


@dataclass(frozen=True, slots=True)
class Relation:
    """Two polyhedra V and V' that overlap in the picture: their numbers ``v`` and ``w``, and the tables PL and LP.

    ``nearer`` is 1 if V is nearer, -1 if V' is nearer, otherwise 0. ``by`` is the criterion that decided.
    """

    v: int
    w: int
    tables: Tables
    nearer: int
    by: By


@dataclass(frozen=True, slots=True)
class Piece:
    """A visible or hidden part of an edge of a polyhedron, or of a side of a figure on a face.

    ``solid`` is the number of the polyhedron, ``start`` and ``end`` are the ends of the edge as indices of
    ``Solid.points``, and ``first`` and ``last`` bound the part as fractions of the edge in space.
    """

    solid: int
    start: int
    end: int
    first: Fraction
    last: Fraction
    visible: bool


@dataclass(frozen=True, slots=True)
class Passages:
    """The course of one segment behind all nearer polyhedra.

    ``solid`` is the number of the polyhedron, and ``segment`` is the number of the segment among those of the
    polyhedron. ``behind`` has pairs of the number of a nearer polyhedron and the passage of the segment behind it.
    ``ghosts`` has the parts of the segment that are ghost lines.
    """

    solid: int
    segment: int
    behind: tuple[tuple[int, Passage], ...]
    ghosts: tuple[Span, ...]

    @property
    def order(self) -> int:
        """The number of contours that hide the segment's start P_A (the paper's order of invisibility)."""
        return sum(passage.order + passage.enclosed for _, passage in self.behind)


@dataclass(frozen=True, slots=True)
class Drawing:
    """The result of hidden line elimination: the visible and hidden pieces of all edges, and intermediate results.

    ``seconds`` are the times of the paper's three steps: creating the polyhedra, classifying edges, eliminating hidden
    lines. ``cut`` names the polyhedra that the near plane clips, and ``behind`` names the polyhedra on the eye's side
    of this plane, which are omitted.
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
        """The numbers of polyhedra, vertices, faces and points of figures, the columns of the paper's Table 1."""
        polyhedra = [item.polyhedron for item in self.solids]
        return (
            len(polyhedra),
            sum(len(item.vertices) for item in polyhedra),
            sum(len(item.faces) for item in polyhedra),
            sum(len(figure.corners) for item in polyhedra for figure in item.figures),
        )


def draw(
    made: Sequence[Polyhedron] | Callable[[], Sequence[Polyhedron]],
    observer: Observer,
    without: Collection[str] = (),
    hidden: bool = False,
    check: bool = True,
) -> Drawing:
    """Return the drawing of a scene of convex polyhedra with the hidden lines removed.

    ``made`` may be a function that creates the polyhedra. The time of this function is then that of the first step.
    ``without`` names those refinements of the method (``REFINEMENTS``) that are switched off. With ``hidden``, the
    drawing has hidden pieces too: hidden parts of edges, and edges between back faces. With ``check``, all polyhedra
    with overlapping contours are proved not to intersect.

    Raise SceneError if polyhedra intersect, if a polyhedron is not entirely in front of the observation point and there
    is no near plane, or if a name in ``without`` is unknown.
    """
    unknown = sorted(set(without) - set(REFINEMENTS))
    if unknown:
        raise SceneError(f"{quoted(unknown[0])} is not one of the names {', '.join(REFINEMENTS)}")
    started = time.perf_counter()
    # Time I: create the polyhedra (section 2).
    created = made() if callable(made) else made
    clipped_scene = beyond_near(created, observer)
    polyhedra = clipped_scene.polyhedra
    # Time II: project the polyhedra and find their edges and contours.
    searched = time.perf_counter()
    if not polyhedra:
        raise SceneError("expected at least one polyhedron, found none")
    # Moving the origin to an integer point near the scene keeps the coordinates short.
    x, y, z = (Fraction(math.floor(number)) for number in polyhedra[0].vertices[0])
    solids = tuple(solid(number, polyhedron, observer, (x, y, z)) for number, polyhedron in enumerate(polyhedra))
    # Time III: compare the contours in pairs (sections 3.2 and 3.3). Only the segments of the farther polyhedron can be
    # hidden by the nearer one, so each pair is examined in one direction.
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
    # Section 3.4: ghost lines divide two parts of one object in a plane face.
    front_ghosts: dict[Name, list[Span]] = {} if GHOSTS in without else ghosts(solids)
    passages = []
    for item in solids:
        for place, (segment, course) in enumerate(zip(item.segments, behind[item.number], strict=True)):
            spans = front_ghosts.get((item.number, segment.start, segment.end), ())
            passages.append(Passages(item.number, place, tuple(course), tuple(spans)))
    back_ghosts = ghosts(solids, -1) if hidden and GHOSTS not in without else {}
    # Section 3.5: the visible parts of every segment.
    pieces = [piece for passage in passages for piece in _pieces(solids, passage, back_ghosts, hidden)]
    if hidden:
        pieces += [piece for item in solids for piece in _back_edges(item, back_ghosts)]
    ended = time.perf_counter()
    seconds = (searched - started, eliminated - searched, ended - eliminated)
    near_plane = (clipped_scene.cut, clipped_scene.behind)
    return Drawing(observer, solids, tuple(relations), tuple(passages), tuple(pieces), seconds, *near_plane)


def _relations(
    solids: Sequence[Solid], without: Collection[str], check: bool
) -> Iterator[tuple[Relation, Values, Values]]:
    """Yield the pairs of polyhedra with overlapping contours.

    Each pair is yielded with two tables of values of formula (1), a line's equation. Each table has the values for the
    lines of one of the two contours at the points of the other polyhedron.
    """
    contours = [item.images[: len(item.contour)] for item in solids]
    # By property 1 of section 3.2, contours do not overlap if all points of one are outside a segment of the other.
    for first, second in overlapping(boxes(contours)):
        v, w = solids[first], solids[second]
        of_v = values(v.lines, w.images)
        of_w = values(w.lines, v.images) if of_v is not None else None
        if of_v is None or of_w is None:
            continue
        # Formulas (2) and (3): the signs at the vertices of the contours, which come first among the points.
        m, n = len(v.contour), len(w.contour)
        pair = tables([column[:n] for column in of_v], [row[:m] for row in of_w])
        nearer, by = by_formulas(v, w, pair, of_v, of_w)
        # Both formulas are 0 for polyhedra that touch. A separating plane decides then, and proves the pair disjoint.
        if check or (by == UNDECIDED and TOUCHING not in without):
            side, plane = by_plane(v, w)
            if plane is None:
                raise SceneError(
                    f"{v.polyhedron.name} and {w.polyhedron.name} intersect; the polyhedra of a scene must not"
                )
            if by == UNDECIDED and TOUCHING not in without:
                nearer, by = side, BY_PLANE
        yield Relation(first, second, pair, nearer, by), of_v, of_w


def _pass(
    behind: list[list[tuple[int, Passage]]], far: Solid, near: Solid, of_near: Values, without: Collection[str]
) -> None:
    """Add to ``behind`` the passage of each segment of the farther polyhedron behind the nearer polyhedron."""
    contour = near.images[: len(near.contour)]
    for course, segment in zip(behind, far.segments, strict=True):
        if ENDS in without:
            ends = far.points[segment.start], far.points[segment.end]
            passage = as_printed(of_near, segment.first, segment.last, ends, contour)
        else:
            passage = clipped(of_near, segment.first, segment.last)
        if passage.marks or (passage.enclosed and ENCLOSED not in without):
            course.append((near.number, passage))


def _pieces(
    solids: Sequence[Solid], passages: Passages, back_ghosts: dict[Name, list[Span]], hidden: bool
) -> Iterator[Piece]:
    """Yield the pieces of a segment. A piece is visible if no contour hides it.

    The paper adds the order of invisibility (the number of contours that hide the segment's start) and the indices of
    the intersections between the start and the piece. The piece is visible if the sum is 0.

    Ghost lines between front faces are omitted from all pieces, ghost lines between back faces from hidden pieces.
    """
    segment = solids[passages.solid].segments[passages.segment]
    if not passages.behind and not passages.ghosts:
        yield Piece(passages.solid, segment.start, segment.end, _START, _END, True)
        return
    # A mark is a point of the edge, as a fraction of its length, with the changes of three counters at this point.
    marks: list[tuple[Fraction, int, int, int]] = [(_END, 0, 0, 0)]
    marks += [(place, index, 0, 0) for _, passage in passages.behind for place, index in passage.marks]
    for low, high in passages.ghosts:
        marks += [(low, 0, 1, 0), (high, 0, -1, 0)]
    for low, high in back_ghosts.get((passages.solid, segment.start, segment.end), ()):
        marks += [(low, 0, 0, 1), (high, 0, 0, -1)]
    # Sweep along the segment. Three counters change at the marks: the order of invisibility, and the numbers of ghost
    # parts between front faces and between back faces that cover the current point.
    order, ghost, back = passages.order, 0, 0
    last, drawn = _START, ""
    since = _START
    for place, index, ghost_change, back_change in sorted(marks):
        if place > last:
            state = "" if ghost or (order and (back or not hidden)) else "hidden" if order else "visible"
            # Neighbouring intervals with the same state are one piece.
            if state != drawn:
                if drawn:
                    yield Piece(passages.solid, segment.start, segment.end, since, last, drawn == "visible")
                since, drawn = last, state
            last = place
        order, ghost, back = order + index, ghost + ghost_change, back + back_change
    if drawn:
        yield Piece(passages.solid, segment.start, segment.end, since, _END, drawn == "visible")


def _back_edges(item: Solid, back_ghosts: dict[Name, list[Span]]) -> Iterator[Piece]:
    for edge in item.edges:
        if edge.kind == BACK:
            # Edges between back faces are hidden everywhere. They are drawn dashed except for their ghost parts.
            since = _START
            for low, high in sorted(back_ghosts.get((item.number, edge.start, edge.end), ())):
                if low > since:
                    yield Piece(item.number, edge.start, edge.end, since, low, False)
                since = max(since, high)
            if since < _END:
                yield Piece(item.number, edge.start, edge.end, since, _END, False)


_START, _END = Fraction(0), Fraction(1)
