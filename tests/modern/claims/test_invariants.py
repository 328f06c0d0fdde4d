"""Each invariant of a printed table or figure notices an altered print."""

from __future__ import annotations

from dataclasses import replace

import pytest

from modern.claims import invariants
from modern.claims.evidence import Check
from modern.claims.invariants import may_be_convex
from modern.claims.published import Paper
from modern.claims.register import decisions
from modern.edition.chapter4 import load_theorems
from modern.papers import Lines


def _checks(statement: str) -> list[Check]:
    of_statement = [d for d in decisions()[statement] if d.function.__module__ == invariants.__name__]
    return [decision.function(**dict(decision.subject)) for decision in of_statement]


@pytest.mark.parametrize(
    ("result", "old", "new", "statement"),
    [
        ("table5-10", "3420", "3421", "kovalevsky-schulz.171"),
        ("table5-16", "1010", "1011", "kovalevsky-schulz.171"),
        ("table5-14", "426", "318", "kovalevsky-schulz.89"),
        ("ball-voxels", "17077", "17078", "kovalevsky-schulz.20"),
        ("ball-corners-6", "776", "778", "kovalevsky-schulz.21"),
        ("ball-triangles", "1404", "1406", "kovalevsky-schulz.64"),
        ("ball-faces", "266", "267", "kovalevsky-schulz.64"),
        ("table1", "-1, 3, -5", "1, 3, -5", "kovalevsky-schulz.39"),
        ("table1", "1, -2, 4", "1, 2, 4", "kovalevsky-schulz.42"),
        ("table2", "2 3 1 3", "2 3 1 4", "kovalevsky-schulz.40"),
        ("table3", "(4, -5)", "(4, 5)", "kovalevsky-schulz.41"),
        ("table4-triangulation", "16020", "16021", "kovalevsky-schulz.83"),
        ("table4-hull", "495", "496", "kovalevsky-schulz.84"),
        ("table1-c", "480", "482", "nakamae-nishita.55"),
        ("fig4-topological-map", "5,6,9,10", "5,6,10,9", "appel-will.20"),
        ("fig14", "4 6", "3 6", "appel-will.65"),
        ("fig22-loops-4-5", "9 -5", "9 5", "appel-will.65"),
        ("fig22-loops-1-3", "-1 2 -4", "-1 2 -5", "appel-will.65"),
        ("fig23-edges", "4 6", "3 6", "appel-will.113"),
        ("fig23-loops", "13 -7", "13 7", "appel-will.114"),
        ("fig23-map", "8 8", "8 7", "appel-will.115"),
    ],
)
def test_an_altered_print_violates_an_invariant(monkeypatch, result: str, old: str, new: str, statement: str) -> None:
    def altered(line: str) -> str:
        # Cells are separated by tabs; the alteration is written with spaces.
        return line.replace(old, new).replace(old.replace(" ", "\t"), new.replace(" ", "\t"))

    printed = invariants.printed_lines

    def printed_lines(paper: Paper) -> Lines:
        return {name: [*map(altered, rows)] if name == result else rows for name, rows in printed(paper).items()}

    assert all(check.holds for check in _checks(statement))
    monkeypatch.setattr(invariants, "printed_lines", printed_lines)
    assert [check.holds for check in _checks(statement)].count(False) == 1


def test_enough_corners_for_the_printed_triangles_need_no_condition(monkeypatch) -> None:
    assert invariants.triangles_of_360_corners().holds
    monkeypatch.setattr(invariants, "numbers_of_ball", lambda: [17077, 776, 704, 1404, 266])
    assert not invariants.triangles_of_360_corners().holds


def test_table_of_theorem_4_8_needs_all_planes(monkeypatch) -> None:
    without_a_plane = tuple(replace(theorem, planes=theorem.planes[:-1]) for theorem in load_theorems())
    monkeypatch.setattr(invariants, "load_theorems", lambda: without_a_plane)
    assert [check.holds for check in _checks("thesis.150")] == [False]


@pytest.mark.parametrize("statement", ["thesis.175", "thesis.176", "thesis.177"])
def test_examples_of_chapter_6_need_their_incidences(monkeypatch, statement: str) -> None:
    read = invariants.read_hull
    monkeypatch.setattr(invariants, "read_hull", lambda cards: replace(read(cards), satisfied=()))
    assert [check.holds for check in _checks(statement)] == [False]


def test_a_tetrahedron_may_be_convex_and_five_faces_have_at_most_six_vertices() -> None:
    assert may_be_convex(4, 4)
    assert may_be_convex(6, 5)
    assert not may_be_convex(7, 5)
