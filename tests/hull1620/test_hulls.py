"""The hulls of the public interface: arrays, exact measures, drawings and files."""

import json
import pickle
import sys
from contextlib import suppress
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

import hull1620

CUBE = [(x, y, z) for x in (0, 2) for y in (0, 2) for z in (0, 2)]
SQUARE = [(0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1), (1, 1, 1), (1, 0, 1)]
DOUBLES = np.random.default_rng(1963).normal(size=(30, 3))
BOTH = (hull1620.convex_hull, hull1620.exact_hull)

small = st.integers(-6, 6)
sets = st.lists(st.tuples(small, small, small), min_size=1, max_size=14)


def parts(hull: hull1620.Hull) -> tuple[object, ...]:
    """Return the content of a hull, independent of its order."""
    faces = {(face.lowest, frozenset(face.polygon), frozenset(face.on)) for face in hull.faces}
    groups = [frozenset(group.tolist()) for group in (hull.vertices, hull.boundary, hull.inside)]
    return hull.dimension, *groups, faces, hull.volume, hull.area, hull.duplicates


@settings(deadline=None, max_examples=150)
@given(sets)
def test_the_procedure_and_the_judge_have_the_same_hull(points: list[tuple[int, int, int]]) -> None:
    ours, judged = hull1620.convex_hull(points), hull1620.exact_hull(points)
    if len(set(points)) > 3 or ours.dimension < 2:
        assert parts(ours) == parts(judged)
    assert (ours.volume, ours.area) == (judged.volume, judged.area)
    assert judged.certificate is not None
    assert ours.certificate is None
    assert ours.exact_points == judged.exact_points


@pytest.mark.parametrize("hull_of", BOTH)
@pytest.mark.parametrize(
    "kind", [np.int8, np.uint16, np.int64, np.float16, np.float32, np.float64, np.longdouble, object, str]
)
def test_arrays_of_all_real_types_are_exact(hull_of: Any, kind: Any) -> None:
    assert parts(hull_of(np.array(CUBE).astype(kind))) == parts(hull_of(CUBE))


@pytest.mark.parametrize("hull_of", BOTH)
def test_coordinates_may_have_any_real_type(hull_of: Any) -> None:
    for half in (0.5, "0.5", "1/2", Fraction(1, 2), Decimal("0.5"), np.float32(0.5), np.float16(0.5)):
        assert hull_of([(half, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 0)]).volume == Fraction(1, 12)
    tenth = hull_of([(np.float64(0.1), 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 0)])
    assert tenth.volume == Fraction(0.1) / 6


@pytest.mark.parametrize("hull_of", BOTH)
@pytest.mark.parametrize("nothing", [[], (), iter([]), np.empty((0, 3)), np.empty(0), np.empty((0, 3), int)])
def test_no_points_always_raise_the_same_error(hull_of: Any, nothing: Any) -> None:
    with pytest.raises(hull1620.PointsError, match=r"^there are no points$"):
        hull_of(nothing)


@pytest.mark.parametrize("hull_of", [hull1620.digital_hull, hull1620.voxel_hull])
@pytest.mark.parametrize("nothing", [np.zeros((2, 2, 2)), np.empty((0, 3, 3)), np.zeros((3, 3, 3), bool)])
def test_no_voxels_raise_the_same_error_as_no_points(hull_of: Any, nothing: Any) -> None:
    with pytest.raises(hull1620.PointsError, match=r"^there are no points$"):
        hull_of(nothing)


@pytest.mark.parametrize("hull_of", BOTH)
def test_arrays_have_the_content_of_those_of_qhull(hull_of: Any) -> None:
    hull, other = hull_of(DOUBLES), ConvexHull(DOUBLES)
    assert sorted(hull.vertices) == sorted(other.vertices)
    assert {frozenset(row) for row in hull.simplices.tolist()} == {frozenset(row) for row in other.simplices.tolist()}
    assert np.array_equal(hull.points, DOUBLES)
    assert hull.equations.shape == (len(hull.simplices), 4)
    values = DOUBLES @ hull.equations[:, :3].T + hull.equations[:, 3]
    assert values.max() < 1e-14
    for row, corners in enumerate(hull.simplices):
        assert abs(values[corners, row]).max() < 1e-14
        a, b, c = hull.points[corners]
        assert np.cross(b - a, c - a) @ hull.equations[row, :3] > 0
    assert float(hull.volume) == pytest.approx(other.volume, rel=1e-13)
    assert float(hull.area) == pytest.approx(other.area, rel=1e-13)


def test_arrays_are_read_only() -> None:
    hull = hull1620.exact_hull(CUBE)
    for array in (hull.points, hull.vertices, hull.boundary, hull.inside, hull.simplices, hull.equations):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0


@pytest.mark.parametrize("hull_of", BOTH)
def test_volume_and_area_are_exact(hull_of: Any) -> None:
    cube = hull_of(CUBE)
    assert (cube.volume, cube.area, cube.squared_areas) == (8, 24, (16,) * 6)
    corner = hull_of([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    assert corner.volume == Fraction(1, 6)
    # 3/2 and half the root of 3, whose digits are known (OEIS A002194).
    assert corner.area.digits == Decimal("2.3660254037844386467637231707529361834714026269052")
    assert sorted(corner.squared_areas) == [Fraction(1, 4)] * 3 + [Fraction(3, 4)]
    third = hull_of([("1/3", 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 0)])
    assert third.volume == Fraction(1, 18)
    square = hull_of(SQUARE)
    assert (square.volume, square.area, square.simplices.shape) == (0, 4, (2, 3))
    for flat in ([(1, 2, 3)], [(0, 0, 0), (1, 1, 1), (2, 2, 2)]):
        hull = hull_of(flat)
        assert (hull.volume, hull.area, hull.simplices.shape, hull.equations.shape) == (0, 0, (0, 3), (0, 4))


def test_a_refusal_has_the_incomplete_result() -> None:
    with pytest.raises(hull1620.HullRefused, match=r"^no hull in float64: DATA NOT ACCEPTABLE, decided at") as caught:
        hull1620.convex_hull(DOUBLES, "float64")
    returned = hull1620.convex_hull(DOUBLES, "float64", on_refusal="return")
    assert isinstance(caught.value.result, hull1620.Hull)
    assert caught.value.result == returned
    assert (returned.determined, returned.statement) == (False, "program3 119")
    assert repr(returned) == "<no hull: DATA NOT ACCEPTABLE at program3 119; 30 points, float64>"
    assert returned._repr_svg_() is None
    for what in ("simplices", "equations", "volume", "area"):
        with pytest.raises(hull1620.ExportError, match="there is no hull: DATA NOT ACCEPTABLE"):
            getattr(returned, what)
    assert hull1620.convex_hull(DOUBLES, "float64", epsilon=1e-9).determined
    with pytest.raises(ValueError, match="on_refusal"):
        hull1620.convex_hull(CUBE, on_refusal="ignore")


def test_an_epsilon_that_merges_too_many_faces_is_refused_and_every_determined_hull_has_a_volume() -> None:
    points = np.random.default_rng(4).integers(-9, 10, (30, 3))
    hulls = [hull1620.convex_hull(points, "float64", epsilon=e, on_refusal="return") for e in range(0, 400, 20)]
    refused = [hull for hull in hulls if hull.status == "the faces do not form a closed surface"]
    assert 0 < len(refused) < len(hulls)
    for hull in hulls:
        if hull.determined:
            assert 0 <= hull.volume <= hull1620.exact_hull(points).volume * 2
    e = 20 * hulls.index(refused[0])
    with pytest.raises(
        hull1620.HullRefused, match=r"do not form a closed surface, decided at .*; a smaller epsilon may find a hull"
    ):
        hull1620.convex_hull(points, "float64", epsilon=e)


@pytest.mark.parametrize("epsilon", [-1, "-1", "", "rel:x", "rel:-1", "nan", float("nan"), True, [1], b"1", "1/0"])
def test_an_invalid_epsilon_is_an_input_error(epsilon: Any) -> None:
    for call in (
        lambda: hull1620.convex_hull(CUBE, epsilon=epsilon),
        lambda: hull1620.data_deck(CUBE, epsilon=epsilon),
    ):
        with pytest.raises(hull1620.EmulatorError, match=r"^epsilon: [^\n]*$"):
            call()


def test_volumes_areas_and_solidity_are_exact_numbers() -> None:
    corner = hull1620.exact_hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    assert corner.area / corner.volume == pytest.approx(14.19615242270663)
    assert np.sqrt(corner.area) ** 2 == pytest.approx(2.366025403784439)
    again = pickle.loads(pickle.dumps(corner.area))
    assert (again, again.digits) == (corner.area, corner.area.digits)
    points = np.random.default_rng(7).integers(-9, 10, (14, 3))
    hull = hull1620.convex_hull(points, text=True)
    assert hull.volume == hull1620.exact_hull(points).volume
    assert hull.corrected == hull.record.corrected
    solid = np.zeros((3, 3, 3), bool)
    solid[[0, 2, 1], [0, 0, 1], [0, 0, 0]] = True
    hull = hull1620.digital_hull(solid)
    assert (hull.voxels, hull.solidity) == (4, Fraction(3, 4))
    assert hull1620.digital_hull(np.ones((2, 2, 2))).solidity == 1


@pytest.mark.parametrize("hull_of", BOTH)
def test_neighbors_have_the_order_of_scipy(hull_of: Any) -> None:
    def links(hull: Any) -> set[object]:
        rows = [frozenset(row) for row in hull.simplices.tolist()]
        return {
            (row, corner, rows[neighbor])
            for row, corners, neighbors in zip(rows, hull.simplices.tolist(), hull.neighbors.tolist(), strict=True)
            for corner, neighbor in zip(corners, neighbors, strict=True)
        }

    assert links(hull_of(DOUBLES)) == links(ConvexHull(DOUBLES))
    assert hull_of(SQUARE).neighbors.tolist() == [[-1, 1, -1], [-1, -1, 0]]


FAR = [
    [(2.0**1023, 0, 0), (0, 2.0**1023, 0), (0, 0, 2.0**1023), (-1.7e308,) * 3, (1.7e308,) * 3],
    [(np.ldexp(np.longdouble(1.1), 16200), 0, 0), (0, 1, 0), (0, 0, np.ldexp(np.longdouble(1.1), -16400)), (1, 1, 1)],
    [("1.23e-9999", 0, 0), (0, 1, 0), (0, 0, "1e9999"), (1, 1, 1)],
    [("9" * 4000, 0, 0), (0, "1/3", 0), (0, 0, 1), (1, 1, 1)],
]


@pytest.mark.parametrize("hull_of", BOTH)
@pytest.mark.parametrize("points", FAR)
def test_an_accepted_hull_of_very_large_or_small_numbers_can_be_used(hull_of: Any, points: Any, tmp_path: Path) -> None:
    hull = hull_of(points)
    assert hull.volume > 0
    assert hull.area.digits > 0
    assert hull.points.shape == (len(points), 3)
    assert not np.isnan(hull.equations).any()
    assert len(hull.exact_points) == len(points)
    for extension in ("off", "stl", "json", "svg"):
        with suppress(hull1620.ExportError):
            hull.save(tmp_path / f"hull.{extension}", digits=9)


def test_pictures_are_the_same_from_all_functions_and_follow_the_options() -> None:
    hull = hull1620.exact_hull(CUBE)
    assert hull._repr_svg_() == hull.draw() == hull1620.draw(CUBE) == hull1620.draw(hull)
    assert hull.draw().startswith("<svg ")
    assert hull.draw(eye=(1, 2.5, np.float32(3)), title="a cube") == hull1620.draw(CUBE, (2, 5, 6), "a cube")
    with pytest.raises(hull1620.ExportError, match="expected a direction of view with 3 numbers, found 2"):
        hull.draw(eye=(1, 2))
    points = [*CUBE, (1, 1, 1)]
    whole, without = hull1620.draw(points), hull1620.draw(points, labels="none", hidden=False, others=False)
    assert ('class="inside"' in whole, 'class="inside"' in without) == (True, False)
    assert ('class="numbers"' in whole, 'class="numbers"' in without) == (True, False)
    assert hull1620.exact_hull(points).draw(width=900).startswith('<svg xmlns="http://www.w3.org/2000/svg" width="900"')


@pytest.mark.parametrize("ending", ["off", "obj", "ply", "stl", "json", "svg"])
def test_the_extension_determines_the_saved_format(ending: str, tmp_path: Path) -> None:
    path = tmp_path / f"cube.{ending}"
    hull1620.exact_hull(CUBE).save(path)
    first = path.read_text(encoding="ascii")
    hull1620.save(CUBE, str(path))
    assert path.read_text(encoding="ascii") == first != ""
    with pytest.raises(hull1620.ExportError, match="must end with"):
        hull1620.save(CUBE, tmp_path / "cube.3ds")
    assert [found.name for found in tmp_path.iterdir()] == [path.name]


def test_the_record_of_an_exact_hull_is_complete(tmp_path: Path) -> None:
    hull1620.save(SQUARE, tmp_path / "square.json")
    held = json.loads((tmp_path / "square.json").read_text(encoding="ascii"))
    assert (held["status"], held["plane"], held["inside"]) == ("determined", ["0", "0", "1", "-1"], [4])
    assert {tuple(face["coefficients"]) for face in held["faces"]} == {
        ("0", "-2", "0", "0"),
        ("2", "0", "0", "-4"),
        ("0", "2", "0", "-4"),
        ("-2", "0", "0", "0"),
    }


def test_points_become_cards_and_punched_cards_become_a_hull(tmp_path: Path) -> None:
    path = tmp_path / "points.csv"
    path.write_text("0,0,0\n4,0,0\n0,4,0\n0,0,4\n1,1,1\n.5,1,1\n", encoding="ascii")
    points = hull1620.read_points(path)
    deck = hull1620.data_deck(points)
    run = hull1620.run_hull(deck)
    assert run.complete
    assert len(hull1620.read_hull(run.final.result.punched).vertices) == len(hull1620.exact_hull(points).vertices) == 4
    assert hull1620.data_deck([(0.5, 0, 0)]).cards[1].text.startswith("+.50000000E+00")
    assert hull1620.data_deck([(0, 0, 0)], epsilon=0.125).cards[0].text == " 1+.12500000E+00"
    with pytest.raises(ValueError, match="55 significant digits"):
        hull1620.data_deck([(0.1, 0, 0)])
    assert hull1620.data_deck([(0.1, 0, 0)], truncate=True).cards[1].text.startswith("+.10000000E+00")
    assert hull1620.run_hull(hull1620.data_deck(points, epsilon="1e-3"), layers=("epsilon",)).complete


def test_a_run_of_60_points_warns_and_its_refusal_explains() -> None:
    points = np.random.default_rng(1).integers(-9, 10, (60, 3))
    with pytest.warns(UserWarning, match="N is 60; the programs accept 1 to 51 points"):
        run = hull1620.run_hull(hull1620.data_deck(points))
    assert not run.complete
    assert "X(52)" in run.refusal
    assert run.refusal in repr(run)
    assert max(len(repr(run)), *(len(repr(step)) for step in run.steps)) < 300


def test_a_program_of_the_thesis_is_loaded_by_its_name() -> None:
    assert hull1620.load_program("program3").source == "program3.f"
    assert hull1620.load_program("program3", ("epsilon",)).statements != hull1620.load_program("program3").statements
    with pytest.raises(
        hull1620.EmulatorError, match="no program is called 'program4'; the names are program1, program2"
    ):
        hull1620.load_program("program4")


@pytest.mark.parametrize(
    "call", [lambda: hull1620.convex_hull(CUBE, fast=True), lambda: hull1620.exact_hull(CUBE, fast=True)]
)
def test_fast_without_numba_is_an_error_for_every_input(call: Any, monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "numba", None)
    with pytest.raises(hull1620.EmulatorError, match=r"needs numba: pip install 'hull1620\[fast\]'"):
        call()


def test_an_image_of_simpleitk_has_its_hull_in_its_coordinates() -> None:
    sitk = pytest.importorskip("SimpleITK")
    image = sitk.GetImageFromArray(np.ones((2, 3, 4), np.uint8))  # z, y, x
    image.SetSpacing((0.5, 2, 1))
    image.SetOrigin((10, 20, 30))
    image.SetDirection((0, -1, 0, 1, 0, 0, 0, 0, 1))
    hull = hull1620.voxel_hull(image)
    assert hull.volume == 24
    # The axis x has the direction (0, 1, 0), and y (-1, 0, 0).
    assert hull.points.min(axis=0).tolist() == [5, 19.75, 29.5]
    assert hull.points.max(axis=0).tolist() == [11, 21.75, 31.5]
