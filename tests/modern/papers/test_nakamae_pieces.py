"""Lines seen and hidden, against a judge: corrections that are needed, samples, and what must not change the pieces."""

from __future__ import annotations

import random
from collections import Counter
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from modern.drawing.visible import BACK, CONTOUR, INNER
from modern.papers.nakamae_nishita.contours import values
from modern.papers.nakamae_nishita.crossings import as_printed, clipped
from modern.papers.nakamae_nishita.hidden import ENCLOSED, ENDS, GHOSTS, TOUCHING, Drawing, draw
from modern.papers.nakamae_nishita.polyhedron import Polyhedron, SceneError
from modern.papers.nakamae_nishita.projection import parallel, perspective
from modern.papers.nakamae_nishita.scenes import scene
from modern.papers.nakamae_nishita.shapes import column, placed
from tests.modern.papers.test_nakamae_nishita import box
from tests.support.scenes_at_random import apart, blocks, direction, shards, vector
from tests.support.visibility import Judge, wrong

# --- the corrections


def difference(polyhedra: list[Polyhedron], eye: tuple[int, int, int], *without: str) -> int:
    drawing = draw(polyhedra, parallel(eye), without)
    return len(wrong(drawing, Judge(polyhedra, direction=eye))[0])


BEHIND = [box((0, 0, 0), (9, 1, 9)), box((4, 2, 4), (5, 3, 5))]
STACKED = [box((0, 0, 0), (1, 1, 1)), box((0, 0, 1), (1, 1, 2))]
BESIDE = [box((0, 0, 0), (2, 2, 2)), box((2, 0, 0), (4, 2, 1))]
DIVIDED = [box((0, 0, 0), (1, 2, 1), "wall"), box((1, 0, 0), (3, 2, 1), "wall"), box((3, 0, 0), (4, 1, 1), "wall")]


@pytest.mark.parametrize(
    ("correction", "polyhedra"), [(ENCLOSED, BEHIND), (TOUCHING, STACKED), (ENDS, BESIDE), (GHOSTS, DIVIDED)]
)
def test_each_correction_is_needed(correction: str, polyhedra: list[Polyhedron]) -> None:
    eye = (2, -3, 2)
    assert difference(polyhedra, eye) == 0
    assert difference(polyhedra, eye, correction) > 0


def test_no_correction_has_another_name() -> None:
    with pytest.raises(SceneError, match=r"^'end' is not one of enclosed, touching, ends, ghosts$"):
        draw(BEHIND, parallel((1, 1, 1)), ("end",))


def test_in_general_position_clipping_finds_what_the_paper_counts() -> None:
    """The same indices with the same k, for every segment and every contour."""
    compared = 0
    for seed in range(20):
        drawing = draw(apart(seed), parallel((1009 + seed, -2003, 1511)))
        for relation in drawing.relations:
            for one, other in ((relation.v, relation.w), (relation.w, relation.v)):
                near, far = drawing.solids[one], drawing.solids[other]
                found = values(near.lines, far.images)
                assert found is not None
                contour = near.images[: len(near.contour)]
                if any(0 in column_ for column_ in found):
                    continue
                for segment in far.segments:
                    ends = far.points[segment.start], far.points[segment.end]
                    printed = as_printed(found, segment.first, segment.last, ends, contour)
                    assert printed == clipped(found, segment.first, segment.last)
                    compared += bool(printed.marks)
    assert compared > 100


# --- drawings against the judge


def judged(polyhedra: list[Polyhedron], seed: int) -> tuple[list[object], int]:
    source = random.Random(seed)
    if seed % 3 == 2:
        point = vector(*(source.choice((-40, 40, 33, -29, 27)) for _ in range(3)))
        drawing = draw(polyhedra, perspective(point, vector(4, 4, 4)))
        found, count = wrong(drawing, Judge(polyhedra, point=point))
    else:
        eye = direction(source)
        drawing = draw(polyhedra, parallel(eye))
        found, count = wrong(drawing, Judge(polyhedra, direction=eye))
    return list(found), count


@pytest.mark.parametrize("made", [apart, blocks, shards])
def test_no_sample_is_wrong(made) -> None:
    """Polyhedra apart, and the parts of a block or a crystal that touch; parallel, and from a point."""
    total = 0
    for seed in range(1000, 1015):
        polyhedra = made(seed)
        if polyhedra:
            found, count = judged(polyhedra, seed)
            assert found == [], seed
            total += count
    assert total > 3000


@pytest.mark.parametrize("name", ["cuboids", "columns", "house"])
def test_no_sample_of_the_scenes_is_wrong(name: str) -> None:
    found = scene(name)
    polyhedra = found.make()
    drawing = draw(polyhedra, found.sight.observer(found.make))
    assert wrong(drawing, Judge(polyhedra, direction=drawing.observer.eye), samples=1)[0] == []


def test_the_judge_finds_faults() -> None:
    """A piece too long, a piece lost, a line that is hidden: each is a wrong sample."""
    drawing = draw(BEHIND, parallel((2, -3, 2)))
    judge = Judge(BEHIND, direction=(2, -3, 2))
    assert wrong(drawing, judge)[0] == []
    lost = Drawing(*(getattr(drawing, name) for name in ("observer", "solids", "relations", "passages")), (), (0, 0, 0))
    assert wrong(lost, judge)[0]


# --- what must not change a drawing


def pieces(drawing: Drawing) -> set[tuple[str, int, int, Fraction, Fraction]]:
    return {
        (drawing.solids[p.solid].polyhedron.name, p.start, p.end, p.first, p.last) for p in drawing.pieces if p.seen
    }


@settings(max_examples=30)
@given(st.integers(0, 500), st.randoms(use_true_random=False))
def test_order_size_and_place_do_not_matter(seed: int, shuffler: random.Random) -> None:
    polyhedra = shards(seed, 3)
    eye = direction(random.Random(seed))
    once = pieces(draw(polyhedra, parallel(eye)))
    changed = [placed(p, lambda q: tuple(c * Fraction(10) ** 30 + 10**60 for c in q), p.name) for p in polyhedra]
    shuffler.shuffle(changed)
    assert pieces(draw(changed, parallel([7 * c for c in eye]))) == once


@settings(max_examples=30)
@given(st.integers(0, 500))
def test_seen_and_hidden_pieces_make_up_every_edge(seed: int) -> None:
    polyhedra = apart(seed)
    drawing = draw(polyhedra, parallel(direction(random.Random(seed))), (GHOSTS,), hidden=True)
    length: Counter[tuple[int, int, int]] = Counter()
    for piece in drawing.pieces:
        length[piece.solid, piece.start, piece.end] += piece.last - piece.first
    kinds = (INNER, CONTOUR, BACK)
    assert set(length) == {(s.number, e.start, e.end) for s in drawing.solids for e in s.edges if e.kind in kinds}
    assert set(length.values()) <= {1}
    assert pieces(drawing) == pieces(draw(polyhedra, drawing.observer, (GHOSTS,)))


@pytest.mark.parametrize("eye", [(2, -3, 2), (-2, 3, 1), (1, 1, -1), (9, 1, 1)])
def test_an_object_in_parts_has_the_lines_of_the_whole(eye: tuple[int, int, int]) -> None:
    """Seen and dashed: a box cut in two, of which every edge of the cut lies in a face of the box."""
    parts, whole = (draw(made, parallel(eye), hidden=True) for made in (DIVIDED[:2], [box((0, 0, 0), (3, 2, 1))]))
    for seen in (True, False):
        assert _length(parts, seen) == _length(whole, seen)


def _length(drawing: Drawing, seen: bool) -> Fraction:
    """The length of all pieces; edges are parallel to the axes."""
    total = Fraction(0)
    for piece in drawing.pieces:
        if piece.seen == seen:
            points = drawing.solids[piece.solid].polyhedron.vertices
            edge = [abs(a - b) for a, b in zip(points[piece.start], points[piece.end], strict=True)]
            total += sum(edge) * (piece.last - piece.first)
    return total


def test_a_column_without_height_and_an_eye_inside_are_refused() -> None:
    with pytest.raises(SceneError, match="not entirely in front of the observation point"):
        draw([box((0, 0, 0), (2, 2, 2))], perspective(vector(1, 1, 1), vector(9, 9, 9)))
    with pytest.raises(SceneError, match="does not rise"):
        column("c", [vector(0, 0, 0), vector(1, 0, 0), vector(0, 1, 0)], vector(1, 1, 0))
