"""The position of voxels in an NRRD file: read exactly and restored after writing."""

import gzip
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hull1620 import digital_hull
from modern.digital.nrrd import parse_nrrd, write_nrrd
from modern.digital.scans import chosen
from modern.digital.solids import Volume, VolumeError, listed
from modern.digital.volumes import read_volume, write_array
from modern.digital.world import LAS, LPS, RAS, World, determinant, world_of
from tests.support.volumefiles import nrrd

STEPS = (np.arange(24).reshape(2, 3, 4) % 5).astype(np.uint8)
"""Values 0 to 4. Additional lines of the header start at line 6."""


def world_in(*fields: str) -> World:
    world = parse_nrrd(nrrd(STEPS, *fields), "a.nrrd").world
    assert world is not None
    return world


def test_decimals_are_read_exactly() -> None:
    world = world_in(
        "space: left-posterior-superior",
        "space directions: (0.1,0,0) (0,-0.30000000000000004,1e-3) (0, 0, 2.5)",
        "space origin: (-12.345678901234567890123456789,+4,.5)",
        'space units: "mm" "mm" "mm"',
    )
    assert world.steps[0] == (Fraction(1, 10), 0, 0)
    assert world.steps[1] == (0, Fraction(-30000000000000004, 10**17), Fraction(1, 1000))
    assert world.origin == (Fraction(-12345678901234567890123456789, 10**27), 4, Fraction(1, 2))
    assert (world.space, world.unit) == (LPS, "mm")


def test_positions_are_read_restored_and_never_rounded() -> None:
    world = world_in("spacings: 0.5 0.25 2", 'units: "mm" "mm" "mm"')
    assert world == World(((Fraction(1, 2), 0, 0), (0, Fraction(1, 4), 0), (0, 0, 2)), (0, 0, 0), "", "mm")
    unknown = world_in("spacings: nan nan nan", "space directions: (1,0,0) (0,1,0) (0,0,1)")
    assert unknown.steps[0] == (1, 0, 0)
    picture = Volume(np.ones((2, 3), np.bool_), (0, 0), world=world_of(2, directions=[(0, 1, 1), (2, 0, 0)]))
    write_nrrd("a.nrrd", picture.array, picture)
    assert read_volume("a.nrrd").world == picture.world
    volume = Volume(STEPS > 0, (0, 0, 0), world=world_of(3, spacing=(Fraction(1, 3), 1, 1)))
    with pytest.raises(VolumeError, match=r"b\.nrrd: 1/3 has no finite decimal"):
        write_nrrd("b.nrrd", volume.array, volume)
    assert not Path("b.nrrd").exists()


@pytest.mark.parametrize(
    ("word", "space"), [("RAS", RAS), ("left-anterior-superior", LAS), ("Lps", LPS), ("scanner-xyz", "scanner-xyz")]
)
def test_names_of_spaces_are_expanded(word: str, space: str) -> None:
    assert world_in(f"space: {word}", "space directions: (1,0,0) (0,1,0) (0,0,1)").space == space


@pytest.mark.parametrize(
    ("fields", "note"),
    [
        (("spacings: 1 nan 2",), "line 6: an axis of the array is not spatial; the position is ignored"),
        (
            ("space dimension: 2", "space directions: none (1,0) (0,1)"),
            "line 7: an axis of the array is not spatial; the position is ignored",
        ),
        (("space origin: (1,2,3)",), "line 6: space origin is ignored, because there are no spacings"),
        (("space directions: (1,0,0,0) (0,1,0,0) (0,0,1,0)",), "line 6: the space has 4 axes; the position is ignored"),
        (("axis mins: 0 0 0", "spacings: 1 1 1"), "line 6: axis mins is ignored; space origin states"),
        (("axismaxs: 2 3 4", "spacings: 1 1 1"), "line 6: axis maxs is ignored; space origin states"),
    ],
)
def test_ignored_fields_are_noted(fields: tuple[str, ...], note: str) -> None:
    scan = parse_nrrd(nrrd(STEPS, *fields), "a.nrrd")
    assert (scan.world is None) == ("position is ignored" in note or "no spacings" in note)
    assert scan.notes[0].startswith(f"a.nrrd: {note}")


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        (("spacings: 1 2",), "line 6: spacings: expected 3 numbers, found 2"),
        (("spacings: 1 2 x",), "line 6: spacings: 'x' is not a decimal number"),
        (("spacings: 1 2 1e999",), "line 6: spacings: '1e999' has more than 100 digits or an exponent beyond 400"),
        (("spacings: 1 2 0",), "line 6: the spacing of an axis is 0"),
        (("space directions: (1,0,0) (0,1,0)",), "line 6: space directions: expected 3 vectors such as (1,0,0)"),
        (("space directions: (1,0,0) (0,1,0) (0,0)",), "line 6: space directions: expected 3 numbers, found 2"),
        (("space directions: (1,0,0) (0,1,0) (0,0,1) 7",), "line 6: space directions: expected 3 vectors"),
        (("space directions: (1,0,0) (0,1,0) (1,1,0)",), "the directions of the axes are linearly dependent"),
        (
            ("spacings: 1 1 1", "space directions: (1,0,0) (0,1,0) (0,0,1)"),
            "expected no spacings, because space directions state them",
        ),
        (
            ("spacings: 1 1 1", "space origin: (1,2)"),
            "line 7: space origin: expected 3 numbers in parentheses, found '(1,2)'",
        ),
        (("spacings: 1 1 1", "space origin: (1,nan,2)"), "line 7: space origin: 'nan' is not a decimal number"),
        (("spacings: 1 1 1", "space origin: none"), "line 7: space origin: expected a vector such as (1,0,0)"),
        (("spacings: 1 1 1", 'space units: "mm" "m" "mm"'), "line 7: the axes have different units: m, mm"),
        (("spacings: 1 1 1", "SPACINGS: 1 1 1"), "line 7, column 1: duplicate field SPACINGS"),
        (("axis mins: 0 0 0", "axismins: 0 0 0"), "line 7, column 1: duplicate field axismins"),
    ],
)
def test_invalid_positions_are_reported_in_one_line(fields: tuple[str, ...], message: str) -> None:
    with pytest.raises(VolumeError) as caught:
        parse_nrrd(nrrd(STEPS, *fields), "a.nrrd")
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


numbers = st.decimals(-1000, 1000, places=7).map(Fraction)
vectors = st.tuples(numbers, numbers, numbers)


@settings(deadline=None, max_examples=60)
@given(st.tuples(vectors, vectors, vectors), vectors, st.sampled_from(["", LPS, "scanner-xyz"]), st.booleans())
def test_a_written_volume_is_restored_with_its_position(steps, origin, space, unit) -> None:
    if not determinant(steps):
        return
    volume = Volume(STEPS > 2, (4, -1, 0), world=World(steps, origin, space, "mm" if unit else ""))
    path = Path("a.nrrd")
    write_nrrd(str(path), volume.array, volume)
    restored = chosen(parse_nrrd(path.read_bytes(), "a.nrrd")).volume
    path.unlink()
    assert np.array_equal(restored.array, volume.array)
    assert volume.world is not None
    assert restored.world == volume.world.moved(volume.origin)


@pytest.fixture(autouse=True)
def _folder(tmp_path_factory, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path_factory.mktemp("nrrd"))


def test_saved_hulls_and_lists_keep_their_position() -> None:
    array = np.zeros((3, 3, 3), np.uint8)
    array[0, 0, 0] = array[2, 2, 2] = array[2, 0, 1] = 1
    hull = digital_hull(array, spacing=("0.1", 2, "-0.25"), origin=(1, "2.5", 0))
    hull.save("hull.nrrd")
    hull.save("hull.npy")
    assert (read_volume("hull.nrrd").world, read_volume("hull.npy").world) == (hull.world, None)
    assert np.array_equal(read_volume("hull.nrrd").array, hull.filled)
    with pytest.raises(VolumeError, match=r"hull\.off: the name must end with \.npy or \.nrrd"):
        hull.save("hull.off")
    volume = listed([(5, -2, 7), (6, -2, 7)])
    write_array("a.nrrd", volume.array, volume)
    world = read_volume("a.nrrd").world
    assert world is not None
    assert world.place((0, 0, 0)) == (5, -2, 7)
    whole = listed([(0, 0, 0), (0, 0, 1)])
    write_array("b.nrrd", whole.array, whole)
    assert read_volume("b.nrrd").world is None
    volume = Volume(STEPS > 0, (0, 0, 0), world=world_of(3, (1, 2, 3)))
    write_nrrd("a.nrrd", volume.array, volume)
    first = Path("a.nrrd").read_bytes()
    head, _, body = first.partition(b"\n\n")
    assert b"space directions: (1,0,0) (0,2,0) (0,0,3)" in head.splitlines()
    assert gzip.decompress(body) == (STEPS > 0).astype(np.uint8).tobytes("F")
    write_nrrd("a.nrrd", volume.array, volume)
    assert Path("a.nrrd").read_bytes() == first
