"""The invariants of printed tables expose the rows that are wrong, and each of them notices an altered print."""

from __future__ import annotations

from dataclasses import replace

import pytest

from modern.claims import invariants
from modern.claims.invariants import INVARIANTS, may_be_convex
from modern.claims.published import Paper, PublishedResult
from modern.edition.chapter4 import load_theorems
from modern.edition.chapter6_cards import Chapter
from modern.papers import Lines

EXPOSED = {
    ("V <= 2 F - 4 and F <= 2 V - 4", "kovalevsky-schulz.86", "d = 8"),
    ("V <= 2 F - 4 and F <= 2 V - 4", "kovalevsky-schulz.89", "d = 14"),
    ("quarter turns map the half-ball to itself", "kovalevsky-schulz.86", "d = 8"),
    ("the quotient is rounded to two decimals", "kovalevsky-schulz.91", "d = 18"),
    ("the ball is symmetric and its triangles have V corners", "kovalevsky-schulz.22", "at most 360 corners are used"),
    ("n solids have V <= 2 F - 4 n and F <= 2 V - 4 n", "nakamae-nishita.56", "(d)"),
}


def _violations() -> set[tuple[str, str, str]]:
    return {(invariant.says, *violation) for invariant in INVARIANTS for violation in invariant.violations()}


def test_the_invariants_expose_exactly_these_rows() -> None:
    assert _violations() == EXPOSED


@pytest.mark.parametrize(
    ("result", "old", "new", "statement"),
    [
        ("table5-10", "3420", "3421", "kovalevsky-schulz.87"),
        ("table5-10", "760 3420", "761 3424", "kovalevsky-schulz.87"),
        ("table5-16", "1010", "1011", "kovalevsky-schulz.90"),
        ("table5-20", "94 938", "96 948", "kovalevsky-schulz.92"),
        ("ball-voxels", "17077", "17078", "kovalevsky-schulz.20"),
        ("ball-corners-6", "776", "778", "kovalevsky-schulz.21"),
        ("ball-triangles", "1404", "1406", "kovalevsky-schulz.64"),
        ("ball-faces", "266", "267", "kovalevsky-schulz.64"),
        ("table1", "-1, 3, -5", "1, 3, -5", "kovalevsky-schulz.39"),
        ("table2", "2 3 1 3", "2 3 1 4", "kovalevsky-schulz.40"),
        ("table3", "(4, -5)", "(4, 5)", "kovalevsky-schulz.41"),
        ("table4-triangulation", "16020", "16021", "kovalevsky-schulz.83"),
        ("table4-hull", "495", "496", "kovalevsky-schulz.84"),
        ("table1-c", "480", "482", "nakamae-nishita.55"),
        ("fig4-topological-map", "5,6,9,10", "5,6,10,9", "appel-will.20"),
        ("fig14", "4 6", "3 6", "appel-will.65"),
        ("fig22-loops-4-5", "9 -5", "9 5", "appel-will.111"),
        ("fig22-loops-1-3", "-1 2 -4", "-1 2 -5", "appel-will.111"),
        ("fig23-edges", "4 6", "3 6", "appel-will.113"),
        ("fig23-loops", "13 -7", "13 7", "appel-will.114"),
        ("fig23-map", "8 8", "8 7", "appel-will.115"),
    ],
)
def test_an_altered_print_violates_an_invariant(
    monkeypatch: pytest.MonkeyPatch, result: str, old: str, new: str, statement: str
) -> None:
    def altered(line: str) -> str:
        # Cells are separated by tabs; the alteration is written with spaces.
        return line.replace(old, new).replace(old.replace(" ", "\t"), new.replace(" ", "\t"))

    printed, results = invariants.printed_lines, invariants.results_of

    def printed_lines(paper: Paper) -> Lines:
        return {name: [*map(altered, rows)] if name == result else rows for name, rows in printed(paper).items()}

    def results_of(paper: Paper) -> tuple[PublishedResult, ...]:
        return tuple(
            replace(r, printed=tuple(map(altered, r.printed))) if r.id == result else r for r in results(paper)
        )

    monkeypatch.setattr(invariants, "printed_lines", printed_lines)
    monkeypatch.setattr(invariants, "results_of", results_of)
    assert statement in {violated for _, violated, _ in _violations() - EXPOSED}


def test_altered_tables_of_the_thesis_violate_an_invariant(monkeypatch: pytest.MonkeyPatch) -> None:
    without_a_plane = [replace(theorem, planes=theorem.planes[:-1]) for theorem in load_theorems()]
    monkeypatch.setattr(invariants, "load_theorems", lambda: without_a_plane)
    named = invariants.incidences

    def swapped(chapter: Chapter, example: int, program: int) -> dict[int, tuple[int, ...]]:
        lines = named(chapter, example, program)
        return {**lines, 1: lines[2]}

    monkeypatch.setattr(invariants, "incidences", swapped)
    expected = {"thesis.115", "thesis.150", "thesis.175", "thesis.176", "thesis.177"}
    assert {statement for _, statement, _ in _violations() - EXPOSED} == expected


def test_a_tetrahedron_may_be_convex_and_five_faces_have_at_most_six_vertices() -> None:
    assert may_be_convex(4, 4)
    assert may_be_convex(6, 5)
    assert not may_be_convex(7, 5)
