"""Statements about how much work things are and how large they get, which rows of transcripts/statements name."""

from __future__ import annotations

import csv
import math
import random
import sys
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from types import FrameType

from modern.digital.solids import half_ball
from modern.papers.appel_will import appel_will
from modern.papers.kovalevsky_schulz.hull import voxel_hull
from modern.papers.nakamae_nishita.hidden import draw
from modern.papers.nakamae_nishita.polyhedron import polyhedron_of_hull
from modern.papers.nakamae_nishita.projection import parallel
from modern.port import convex_hull
from tests.support.paths import ROOT

Point = tuple[int, int, int]


def sphere(count: int) -> list[Point]:
    draw_ = random.Random(count)
    found: dict[Point, None] = {}
    while len(found) < count:
        x, y, z = (draw_.gauss(0, 1) for _ in range(3))
        size = math.sqrt(x * x + y * y + z * z)
        found[(round(1000 * x / size), round(1000 * y / size), round(1000 * z / size))] = None
    return list(found)


def calls(work: Callable[[], object]) -> int:
    """How many functions are called: as good a measure as time, and the same whenever it is taken."""
    seen = 0

    def watch(frame: FrameType, event: str, argument: object) -> None:
        nonlocal seen
        seen += event in ("call", "c_call")

    sys.setprofile(watch)
    try:
        work()
    finally:
        sys.setprofile(None)
    return seen


def work_for(count: int) -> tuple[int, int]:
    """Of Appel and Will's hull of so many points of a sphere, and of that hull drawn without hidden lines."""
    points = sphere(count)
    polyhedron, eye = polyhedron_of_hull(convex_hull(points)), parallel((Fraction(3), Fraction(-5), Fraction(2)))
    return calls(lambda: appel_will(points)), calls(lambda: draw([polyhedron], eye))


def test_the_hull_grows_faster_than_hidden_lines() -> None:
    """From 20 to 100 points the one grows as the cube, 125 times, the other no faster than the square."""
    (hull, lines), (more_hull, more_lines) = work_for(20), work_for(100)
    assert more_hull / hull > 2 * more_lines / lines
    assert more_hull > more_lines


def test_the_sphere_of_the_row_is_one() -> None:
    path = Path(ROOT, "transcripts", "counterexamples", "sphere_40.csv")
    points = [tuple(map(int, row)) for row in csv.reader(path.read_text(encoding="utf-8").splitlines())]
    assert len(set(points)) == 40
    assert len(appel_will(points).vertices) == 40


def test_projections_depend_on_all_points_and_loops_on_the_hull() -> None:
    """Points inside a hull leave edges and loops as they are, but every pair with them is projected."""
    corners = [(x, y, z) for x in (0, 9) for y in (0, 8) for z in (0, 7)]
    inside = [(x, x + 1, x) for x in (2, 3, 4, 5)]
    few, many = appel_will(corners), appel_will([*corners, *inside])
    assert (few.edges, len(few.surfaces)) == (many.edges, len(many.surfaces))
    assert few.projections == math.comb(8, 2)
    assert many.projections > few.projections + len(corners) * 2


def test_a_face_has_about_five_vertices() -> None:
    """Of the eight half-balls of Table 5, vertices on straight edges counted as the table counts them."""
    means = []
    for diameter in range(8, 24, 2):
        faces = voxel_hull(half_ball(diameter), neighbours=6, coplanar="invisible").polyhedron.faces.faces
        means.append((sum(len(face.vertices) for face in faces), len(faces)))
    of_each = [total / count for total, count in means]
    assert 4.5 < sum(total for total, _ in means) / sum(count for _, count in means) < 4.7
    assert 4.9 < float(sum(of_each) / len(of_each)) < 5.0
    assert round(min(of_each), 1) == 3.5
    assert round(max(of_each), 1) == 8.0
