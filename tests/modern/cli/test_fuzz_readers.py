"""Every reader on files damaged at random gives a result, or one line and exit code 2 and no partial file.

``HULL1620_FUZZ=200`` damages 200 files of each reader instead of 3, each in 50 ways.
"""

import random
import struct
from pathlib import Path

import numpy as np
import pytest

from emulator.errors import EmulatorError
from modern.formats.export import export_text
from modern.port import convex_hull
from modern.study.tomlplan import read_plan
from tests.support.mutated import FILES, WAYS, Make, codes_of, damaged, saved, solid
from tests.support.paths import PROGRAMS, ROOT
from tests.support.solids import CUBE, CUBE_FACES, binary_stl, cut


def points(draw: random.Random) -> list[tuple[str, str, str]]:
    """Draw points in space, with or without decimals."""
    count, places = draw.randrange(4, 12), draw.randrange(3)
    corner = [("0", "0", "0"), ("9", "0", "0"), ("0", "9", "0"), ("0", "0", "9")]
    return corner + [tuple(f"{draw.uniform(-5, 5):.{places}f}" for _ in range(3)) for _ in range(count)]


def deck(draw: random.Random) -> bytes:
    rows = points(draw)
    return (f"{len(rows):2d}\n" + "".join(f"{x:>14}{y:>14}{z:>14}\n" for x, y, z in rows)).encode()


def listed(separator: str) -> Make:
    return lambda draw: (
        separator.join("xyz") + "\n" + "\n".join(separator.join(p) for p in points(draw)) + "\n"
    ).encode()


def exported(form: str) -> Make:
    return lambda draw: export_text(convex_hull(points(draw)), form).encode()


def triangles_apart(draw: random.Random) -> bytes:
    count = draw.randrange(1, 9)
    body = b"".join(struct.pack("<12fH", *(draw.uniform(-9, 9) for _ in range(12)), 0) for _ in range(count))
    return b"binary".ljust(80) + struct.pack("<I", count) + body


def binary_ply(draw: random.Random) -> bytes:
    order, count = draw.choice((("little", "<"), ("big", ">"))), draw.randrange(4, 9)
    head = f"ply\nformat binary_{order[0]}_endian 1.0\nelement vertex {count}\n"
    head += "".join(f"property float {axis}\n" for axis in "xyz") + "end_header\n"
    return head.encode() + struct.pack(f"{order[1]}{3 * count}f", *(draw.uniform(-9, 9) for _ in range(3 * count)))


def triangles(draw: random.Random) -> bytes:
    """Return the faces of one or two cuboids as a binary STL file."""
    rows = []
    for k in range(draw.randrange(1, 3)):
        size = draw.randrange(1, 4)
        rows += cut([(size * x + 5 * k, size * y, size * z) for x, y, z in CUBE], CUBE_FACES)
    return binary_stl(rows)


def point_array(draw: random.Random) -> bytes:
    kind = draw.choice((np.int16, np.float32, np.float64))
    return saved(np.array([[float(x) for x in p] for p in points(draw)]).astype(kind))


def voxels(draw: random.Random) -> bytes:
    return "".join(f"{x},{y},{z}\n" for x, y, z in np.argwhere(solid(draw))).encode()


def scene(draw: random.Random) -> bytes:
    number = draw.randrange(1, 9)
    text = f"""title = "a"
[view]
eye = [31, -46, 22]
[[part]]
name = "ground"
shape = "cuboid"
size = [{number + 3}, 22.5, 3]
at = [0, 0, 0]
figures = [[[1.5, 0, 1], [1.5, 0, 2.5], [3.5, 0, 2.5], [3.5, 0, 1]]]
[[part]]
file = "{ROOT / "transcripts" / "counterexamples" / "crown.off"}"
hull = true
coplanar_within = 0.0{number}
scale = 0.{number}
at = [0, 0, 90]
"""
    return text.encode()


def plan(draw: random.Random) -> bytes:
    text = f"""name = "mine"
title = "t"
question = "q"
samples = {draw.randrange(1, 9)}
[[route]]
name = "as listed"
[[route]]
name = "float64"
kind = "port"
arithmetic = "float64"
[[cell]]
family = "integers"
parameters = {{ digits = 3, n = [4, 20] }}
routes = ["float64"]
"""
    return text.encode()


def source(draw: random.Random) -> bytes:
    return draw.choice(sorted(PROGRAMS.glob("*.f"))).read_bytes()


READERS: dict[str, tuple[str, Make, list[str]]] = {
    "deck": ("a.deck", deck, ["hull", "a.deck", "--limit", "3000", "--punch", "out"]),
    "deck-points": ("a.deck", deck, ["cards", "a.deck", "-o", "out"]),
    "commas": ("a.csv", listed(","), ["cards", "a.csv", "-o", "out", "--truncate"]),
    "semicolons": ("a.csv", listed(";"), ["cards", "a.csv", "-o", "out"]),
    "tabs": ("a.txt", listed("\t"), ["cards", "a.txt", "-o", "out"]),
    "blanks": ("a.txt", listed(" "), ["export", "a.txt", "--format", "json", "-o", "out"]),
    "off": ("a.off", exported("off"), ["hidden-line", "a.off", "-o", "out.svg"]),
    "obj-faces": ("a.obj", exported("obj"), ["hidden-line", "a.obj", "-o", "out.svg"]),
    "stl-faces": ("a.stl", exported("stl"), ["hidden-line", "a.stl", "--hull", "-o", "out.svg"]),
    "stl-binary-faces": ("a.stl", triangles, ["hidden-line", "a.stl", "-o", "out.svg"]),
    "off-within": ("a.off", exported("off"), ["hidden-line", "a.off", "--coplanar-within", ".01", "-o", "out.svg"]),
    "off-points": ("a.off", exported("off"), ["appel-will", "a.off", "-o", "out.off"]),
    "off-map": ("a.off", exported("off"), ["appel-will", "a.off", "--map", "-o", "out.svg"]),
    "off-solid": ("a.off", exported("off"), ["appel-will", "a.off", "--coplanar-within", ".1", "-o", "out.svg"]),
    "obj": ("a.obj", exported("obj"), ["cards", "a.obj", "-o", "out"]),
    "ply": ("a.ply", exported("ply"), ["cards", "a.ply", "-o", "out"]),
    "ply-binary": ("a.ply", binary_ply, ["export", "a.ply", "--format", "off", "-o", "out"]),
    "stl": ("a.stl", exported("stl"), ["cards", "a.stl", "-o", "out"]),
    "stl-binary": ("a.stl", triangles_apart, ["export", "a.stl", "--format", "off", "-o", "out"]),
    "json": ("a.json", exported("json"), ["cards", "a.json", "-o", "out"]),
    "npy-points": ("a.npy", point_array, ["export", "a.npy", "--format", "json", "-o", "out"]),
    "voxels": ("a.csv", voxels, ["octree-hull", "a.csv", "-o", "out.npy"]),
    "scene": ("a.toml", scene, ["hidden-line", "a.toml", "-o", "out.svg"]),
    "program": ("a.f", source, ["check", "a.f"]),
}


@pytest.mark.parametrize("name", READERS)
def test_a_damaged_file_is_read_or_rejected_in_one_line(name: str, tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    codes = codes_of(name, *READERS[name], tmp_path, capsys)
    assert {0, 2} <= codes, codes


def test_a_damaged_plan_is_read_or_rejected_in_one_line(tmp_path: Path) -> None:
    codes = set()
    path = tmp_path / "a.toml"
    for number in range(FILES):
        whole = plan(random.Random(f"plan:{number}"))
        path.write_bytes(whole)
        assert read_plan(str(path)).cells
        for way in range(WAYS):
            path.write_bytes(damaged(whole, way, f"plan:{number}"))
            codes.add(refusal(path))
    assert "" in codes
    assert len(codes) > 5
    assert [words for words in codes if "\n" in words] == []


def refusal(path: Path) -> str:
    """Return the message about a rejected plan, or an empty string."""
    try:
        read_plan(str(path))
    except EmulatorError as error:
        return str(error)
    return ""
