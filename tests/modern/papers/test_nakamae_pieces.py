"""Tests of drawings against an independent judge: the refinements, random scenes, and invariances of the pieces."""

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

# --- the refinements


def difference(polyhedra: list[Polyhedron], eye: tuple[int, int, int], *without: str) -> int:
    drawing = draw(polyhedra, parallel(eye), without)
    return len(wrong(drawing, Judge(polyhedra, direction=eye))[0])


BEHIND = [box((0, 0, 0), (9, 1, 9)), box((4, 2, 4), (5, 3, 5))]
STACKED = [box((0, 0, 0), (1, 1, 1)), box((0, 0, 1), (1, 1, 2))]
BESIDE = [box((0, 0, 0), (2, 2, 2)), box((2, 0, 0), (4, 2, 1))]
DIVIDED = [box((0, 0, 0), (1, 2, 1), "wall"), box((1, 0, 0), (3, 2, 1), "wall"), box((3, 0, 0), (4, 1, 1), "wall")]


@pytest.mark.parametrize(
    ("refinement", "polyhedra"), [(ENCLOSED, BEHIND), (TOUCHING, STACKED), (ENDS, BESIDE), (GHOSTS, DIVIDED)]
)
def test_each_refinement_is_needed(refinement: str, polyhedra: list[Polyhedron]) -> None:
    eye = (2, -3, 2)
    assert difference(polyhedra, eye) == 0
    assert difference(polyhedra, eye, refinement) > 0


def test_unknown_refinements_flat_columns_and_eyes_inside_are_rejected() -> None:
    with pytest.raises(SceneError, match=r"^'end' is not one of the names enclosed, touching, ends, ghosts$"):
        draw(BEHIND, parallel((1, 1, 1)), ("end",))
    with pytest.raises(SceneError, match="not entirely in front of the observation point"):
        draw([box((0, 0, 0), (2, 2, 2))], perspective(vector(1, 1, 1), vector(9, 9, 9)))
    with pytest.raises(SceneError, match="rises within the plane of its base"):
        column("c", [vector(0, 0, 0), vector(1, 0, 0), vector(0, 1, 0)], vector(1, 1, 0))


def test_in_general_position_clipping_agrees_with_the_printed_rule() -> None:
    """Both methods give the same indices with the same k for every segment and contour."""
    compared = 0
    for seed in range(20):
        drawing = draw(apart(seed), parallel((1009 + seed, -2003, 1511)))
        for relation in drawing.relations:
            v, w = drawing.solids[relation.v], drawing.solids[relation.w]
            for near, far in ((v, w), (w, v)):
                sides = values(near.lines, far.images)
                assert sides is not None
                contour = near.images[: len(near.contour)]
                # A 0 means that a point lies on a contour line, which is not general position.
                if any(0 in column_ for column_ in sides):
                    continue
                for segment in far.segments:
                    ends = far.points[segment.start], far.points[segment.end]
                    printed = as_printed(sides, segment.first, segment.last, ends, contour)
                    assert printed == clipped(sides, segment.first, segment.last)
                    compared += bool(printed.marks)
    assert compared > 100


# --- drawings against the judge


def judged(polyhedra: list[Polyhedron], seed: int) -> tuple[list[object], int]:
    """Draw polyhedra, every third time in perspective, and return the wrong samples and the number of samples."""
    source = random.Random(seed)
    if seed % 3 == 2:
        point = vector(*(source.choice((-40, 40, 33, -29, 27)) for _ in range(3)))
        drawing = draw(polyhedra, perspective(point, vector(4, 4, 4)))
        judge = Judge(polyhedra, point=point)
    else:
        eye = direction(source)
        drawing = draw(polyhedra, parallel(eye))
        judge = Judge(polyhedra, direction=eye)
    wrong_samples, count = wrong(drawing, judge)
    return list(wrong_samples), count


@pytest.mark.parametrize("random_scene", [apart, blocks, shards])
def test_random_scenes_agree_with_the_judge(random_scene) -> None:
    """Check disjoint polyhedra and the touching parts of a block or a crystal, in both projections."""
    total = 0
    for seed in range(1000, 1015):
        polyhedra = random_scene(seed)
        if polyhedra:
            wrong_samples, count = judged(polyhedra, seed)
            assert wrong_samples == [], seed
            total += count
    assert total > 3000


@pytest.mark.parametrize("name", ["cuboids", "columns", "house"])
def test_the_scenes_of_the_project_agree_with_the_judge(name: str) -> None:
    polyhedra = scene(name).make()
    drawing = draw(polyhedra, scene(name).sight.observer(scene(name).make))
    assert wrong(drawing, Judge(polyhedra, direction=drawing.observer.eye), samples=1)[0] == []


def test_the_judge_detects_missing_pieces() -> None:
    drawing = draw(BEHIND, parallel((2, -3, 2)))
    judge = Judge(BEHIND, direction=(2, -3, 2))
    assert wrong(drawing, judge)[0] == []
    without_pieces = Drawing(
        *(getattr(drawing, name) for name in ("observer", "solids", "relations", "passages")), (), (0, 0, 0)
    )
    assert wrong(without_pieces, judge)[0]


# --- invariances


def pieces(drawing: Drawing) -> set[tuple[str, int, int, Fraction, Fraction]]:
    return {
        (drawing.solids[p.solid].polyhedron.name, p.start, p.end, p.first, p.last) for p in drawing.pieces if p.visible
    }


@settings(max_examples=15)
@given(st.integers(0, 500), st.randoms(use_true_random=False))
def test_order_scale_and_position_do_not_change_the_pieces(seed: int, shuffler: random.Random) -> None:
    polyhedra = shards(seed, 3)
    eye = direction(random.Random(seed))
    expected = pieces(draw(polyhedra, parallel(eye)))
    changed = [placed(p, lambda q: tuple(c * Fraction(10) ** 30 + 10**60 for c in q), p.name) for p in polyhedra]
    shuffler.shuffle(changed)
    assert pieces(draw(changed, parallel([7 * c for c in eye]))) == expected


@settings(max_examples=15)
@given(st.integers(0, 500))
def test_visible_and_hidden_pieces_make_up_every_edge(seed: int) -> None:
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
def test_a_divided_box_has_the_lines_of_the_undivided_one(eye: tuple[int, int, int]) -> None:
    """Compare the lengths of visible and of hidden lines of a box and of its two parts."""
    divided = draw(DIVIDED[:2], parallel(eye), hidden=True)
    undivided = draw([box((0, 0, 0), (3, 2, 1))], parallel(eye), hidden=True)
    for visible in (True, False):
        assert _length(divided, visible) == _length(undivided, visible)


def _length(drawing: Drawing, visible: bool) -> Fraction:
    """Return the total length of the visible or hidden pieces of edges parallel to the axes."""
    total = Fraction(0)
    for piece in drawing.pieces:
        if piece.visible == visible:
            points = drawing.solids[piece.solid].polyhedron.vertices
            edge = [abs(a - b) for a, b in zip(points[piece.start], points[piece.end], strict=True)]
            total += sum(edge) * (piece.last - piece.first)
    return total
