"""Slow checks of statements on running time and size. Rows of transcripts/statements name these tests."""

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
    source = random.Random(count)
    points: dict[Point, None] = {}
    while len(points) < count:
        x, y, z = (source.gauss(0, 1) for _ in range(3))
        size = math.sqrt(x * x + y * y + z * z)
        points[(round(1000 * x / size), round(1000 * y / size), round(1000 * z / size))] = None
    return list(points)


def calls(work: Callable[[], object]) -> int:
    """Count the function calls, a measure of work that does not depend on the machine."""
    count = 0

    def watch(frame: FrameType, event: str, argument: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    sys.setprofile(watch)
    try:
        work()
    finally:
        sys.setprofile(None)
    return count


def work_for(count: int) -> tuple[int, int]:
    """Count the calls of Appel and Will's hull of points on a sphere, and of drawing it without hidden lines."""
    points = sphere(count)
    polyhedron, eye = polyhedron_of_hull(convex_hull(points)), parallel((Fraction(3), Fraction(-5), Fraction(2)))
    return calls(lambda: appel_will(points)), calls(lambda: draw([polyhedron], eye))


def test_the_hull_grows_faster_than_hidden_lines() -> None:
    """From 20 to 60 points the hull grows as the cube, 27 times, hidden lines no faster than the square."""
    (hull, lines), (more_hull, more_lines) = work_for(20), work_for(60)
    assert more_hull / hull > 2 * more_lines / lines
    assert more_hull > more_lines


def test_the_points_of_sphere_40_csv_are_all_vertices() -> None:
    path = Path(ROOT, "transcripts", "counterexamples", "sphere_40.csv")
    points = [tuple(map(int, row)) for row in csv.reader(path.read_text(encoding="utf-8").splitlines())]
    assert len(set(points)) == 40
    assert len(appel_will(points).vertices) == 40


def test_inside_points_add_projections_but_neither_edges_nor_loops() -> None:
    corners = [(x, y, z) for x in (0, 9) for y in (0, 8) for z in (0, 7)]
    inside = [(x, x + 1, x) for x in (2, 3, 4, 5)]
    few, many = appel_will(corners), appel_will([*corners, *inside])
    assert (few.edges, len(few.surfaces)) == (many.edges, len(many.surfaces))
    assert few.projections == math.comb(8, 2)
    assert many.projections > few.projections + len(corners) * 2


def test_a_face_has_about_five_vertices() -> None:
    """Check the eight half-balls of Table 5, counting vertices on straight edges as the table does."""
    means = []
    for diameter in range(8, 24, 2):
        faces = voxel_hull(half_ball(diameter), neighbours=6, coplanar="invisible").polyhedron.faces.faces
        means.append((sum(len(face.vertices) for face in faces), len(faces)))
    of_each = [total / count for total, count in means]
    assert 4.5 < sum(total for total, _ in means) / sum(count for _, count in means) < 4.7
    assert 4.9 < float(sum(of_each) / len(of_each)) < 5.0
    assert round(min(of_each), 1) == 3.5
    assert round(max(of_each), 1) == 8.0
