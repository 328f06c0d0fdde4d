"""The pictures next to the commentary show the variables of the programs at the end of each block."""

import pytest

from modern.edition import programs
from modern.edition.chapter6 import input_deck
from modern.exact_hull import exact_hull
from modern.formats.points import parse_input
from modern.publication.commentary import commentary
from modern.publication.measured import runs
from modern.publication.moments import Moment, drawn, moments


def moment(program: str, place: str) -> Moment:
    """Return the moment of the block with a title."""
    block = next(block for block in commentary(program).blocks if block.title == place)
    return moments(program)[block.cards.start]


@pytest.mark.parametrize("program", programs.NAMES)
def test_every_block_that_an_example_executes_on_points_has_a_moment(program: str) -> None:
    executed = {card for run in runs(program) for card in run.executions}
    blocks = {block.title for block in commentary(program).blocks if executed & set(block.cards)}
    with_moment = {block.title for block in commentary(program).blocks if block.cards.start in moments(program)}
    assert blocks == with_moment


@pytest.mark.parametrize("program", programs.NAMES)
def test_every_mark_names_variables_of_the_program(program: str) -> None:
    names = {gloss.name for gloss in commentary(program).variables}
    for block in commentary(program).blocks:
        for mark in block.marks:
            assert {name for name in mark.split() if not name.isdigit()} <= names | {"plane", "line", "at"}, mark


def test_the_pictures_show_what_the_blocks_do() -> None:
    inside = moment("program3", "Punch and remove an inside point")
    assert len(inside.after.points) == len(inside.before.points) - 1
    vertex = moment("program3", "The point becomes a vertex")
    assert (vertex.before.vertices, vertex.after.vertices) == (4, 5)
    (mark, plane) = vertex.marks
    assert mark.name == "NV = 5"
    assert mark.corners == vertex.after.points[4:5]
    assert plane.name == "NETC = 1"
    replaced = moment("program3", "Three planes replace one")
    assert len(replaced.after.faces) == len(replaced.before.faces) + 3
    assert drawn(replaced).count('class="new"') == 3
    removed = moment("program3", "Remove a plane")
    assert len(removed.after.faces) == len(removed.before.faces) - 1
    assert drawn(removed).count('class="gone"') == 1
    assert len(moment("program2", "Two lines replace one").after.faces) == 5


def test_the_last_picture_shows_the_exact_hull() -> None:
    end = moment("program3", "End").after
    points = parse_input(input_deck(6).text(), "example6").points
    expected = {tuple(map(float, points[n])) for n in exact_hull(points).vertices}
    assert set(end.points[: end.vertices]) >= expected
    assert {corner for face in end.faces for corner in face} == set(end.points[: end.vertices])
