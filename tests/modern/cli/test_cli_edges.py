"""The edges of the commands: data on standard output, outputs and options that are wrong, and input without an end."""

from __future__ import annotations

import argparse
import csv
import io
import json
import os
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

from emulator import files
from emulator.numbers import numbers
from modern.claims.register import DOCUMENTS
from modern.cli.arguments import COMMANDS
from modern.cli.main import build_parser
from modern.cli.shared import arguments
from modern.cli.shared.arguments import EXAMPLES, NAMES
from modern.cli.shared.inputs import points_of
from modern.edition import programs
from modern.edition.chapter4 import THEOREMS
from modern.formats import ply
from modern.geometry.mesh import Mesh
from modern.papers.nakamae_nishita import scenes
from modern.publication.tei import documents
from modern.study import builtin
from tests.support.commands import call
from tests.support.paths import ROOT

PLAN = "{}[[route]]\nname = 'a'\n[[cell]]\nfamily = 'integers'\nparameters = {{ digits = 2, n = 5 }}\n"
TETRAHEDRON = [("0", "0", "0"), ("1", "0", "0"), ("0", "1", "0"), ("0", "0", "1")]
SIDES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))
LONG = "8" * 5000


@pytest.fixture
def own(room: Path) -> Path:
    (room / "mine.toml").write_text(PLAN.format("samples = 3\n"), encoding="ascii")
    np.save("labels.npy", np.arange(27).reshape(3, 3, 3) // 9)
    np.save("fractions.npy", np.arange(8).reshape(2, 2, 2) / 4)
    np.save("long.npy", np.diag([np.longdouble("1e4900")] * 3))
    two = [*TETRAHEDRON, *((f"{int(x) + 5}", y, z) for x, y, z in TETRAHEDRON)]
    faces = (*SIDES, *(tuple(k + 4 for k in side) for side in SIDES))
    (room / "two.ply").write_text(ply.write(Mesh(3, tuple(two), faces)), encoding="ascii")
    (room / "faces.json").write_text(json.dumps({"points": TETRAHEDRON, "faces": SIDES}), encoding="ascii")
    (room / "folder").mkdir()
    (room / "big.raw").write_bytes(bytes([1]) * 8)
    header = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\ndata file: ../big.raw\n"
    (room / "folder" / "a.nhdr").write_text(header, encoding="ascii")
    header = "NDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\nElementDataFile = {}\n"
    (room / "folder" / "a.mhd").write_text(header.format("../big.raw"), encoding="ascii")
    (room / "device.mhd").write_text(header.format("/dev/zero"), encoding="ascii")
    return room


@pytest.mark.parametrize(
    "words",
    [
        "diff example1 --json -",
        "diff good.deck --epsilon rel:1e-9 --explain --json -",
        "diff seventy/17 --json -",
        "diverge program1 example2 --json -",
        "diverge good.f x.deck --first --json -",
        "reproduce 3 --json -",
        "reproduce 3 --show --json -",
        "voxel-hull labels.npy --each-label --csv -",
        "voxel-hull labels.npy --each-label --centres --label 1 --csv -",
        "voxel-hull labels.npy --each-label --fill --csv -",
        "hidden-line house --tables -o -",
        "appel-will example5 -o -",
    ],
)
def test_data_alone_go_to_standard_output_and_the_report_to_standard_error(words: str, own: Path, capsys) -> None:
    code, out, err = call(capsys, *words.split())
    assert code in (0, 1)
    assert err
    if "--json" in words:
        assert isinstance(json.loads(out), dict)
    elif "--csv" in words:
        rows = list(csv.DictReader(io.StringIO(out)))
        assert rows
        assert all(int(row["label"]) and None not in row for row in rows)
    else:
        assert out.startswith(("<svg", "OFF\n"))


@pytest.mark.parametrize(
    ("words", "paths"),
    [
        *(
            (words, ("no/folder", "folder", "/proc/file", "good.f/file", ""))
            for words in (
                "run good.f x.deck --punch",
                "hull example1 --typewriter",
                "hull example1 --trace",
                "hull example1 --log",
                "diff example1 --json",
                "cards example1 -o",
                "listing program1 -o",
                "voxel-hull labels.npy --csv",
            )
        ),
        *((words, ("good.f/file", "/proc/file")) for words in ("study mine.toml --out", "tei --all")),
    ],
)
def test_an_unwritable_output_is_reported_before_the_work(words, paths, own, capsys, monkeypatch) -> None:
    monkeypatch.setattr("modern.cli.main.importlib.import_module", lambda name: pytest.fail(f"{name} was imported"))
    for path in paths:
        code, out, err = call(capsys, *words.split(), path)
        assert (code, out, err.count("\n")) == (2, "", 1)
        assert err.startswith(f"hull1620: {path}: " if path else "hull1620: a file without a name")


@pytest.mark.parametrize(
    "words",
    [
        "draw example1 --against both -o both",
        "compile program1 --object --library both -o both",
        "hull example1 --operator=both --log both",
        "listing program1 example1 --operator=both -o both",
        "tei --check both -o both",
        "hull both --punch both",
        "hull both --trace link",
        "run both --typewriter both",
        "cards both -o ./both",
        "export both --format off -o both",
        "diff both --json both",
    ],
)
def test_an_output_that_is_also_an_input_is_rejected_before_the_work(words: str, room: Path, capsys) -> None:
    (room / "both").write_text("kept", encoding="ascii")
    (room / "link").symlink_to("both")
    message = f"{words.split()[-1]}: this output is also an input, which would be overwritten; choose another name\n"
    assert call(capsys, *words.split()) == (2, "", f"hull1620: {message}")
    assert (room / "both").read_text(encoding="ascii") == "kept"


@pytest.mark.parametrize("unbuffered", ["", "1"])
@pytest.mark.parametrize("words", ["--help", "hull --help", "--version", "hull example1", "hull no 2"])
def test_output_to_a_full_device_ends_with_2_and_one_line(words: str, unbuffered: str) -> None:
    if not os.path.exists("/dev/full"):
        pytest.skip("/dev/full does not exist")
    environment = {**os.environ, "PYTHONUNBUFFERED": unbuffered}
    command = f"{sys.executable} -m hull1620 {words}> /dev/full"
    done = subprocess.run(["sh", "-c", command], cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    typed = ["CONVEX HULL"] if words == "hull example1" else []
    message = [] if words.endswith("2") else ["hull1620: cannot write: no space left on device"]
    assert (done.returncode, done.stderr.splitlines()) == (2, [*typed, *message])


@pytest.mark.parametrize("name", COMMANDS)
def test_an_unknown_option_names_the_help_of_its_command(name: str, capsys) -> None:
    code, out, err = call(capsys, name, "x", "--widht", "3")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert err.startswith(f"hull1620 {name}: ")
    assert err.endswith(f" (try hull1620 {name} --help)\n")


@pytest.mark.parametrize(
    "words",
    [
        *("hull LONG", "run good.f x.deck --limit xLONG", "run good.f x.deck --arithmetic LONG", "hull LONG/1"),
        *("hull example1 --layers LONG", "check --explain LONG", "reproduce LONG", "tei LONG", "study LONG"),
        *("study LONG.toml", "study mine.toml --samples LONG", "cards example1 --epsilon LONG", "draw example1 --LONG"),
        *("draw example1 --labels LONG", "draw example1 --eye LONG,1,1", "draw example1 --width LONG", "LONG"),
        *("apparatus --layer LONG", "apparatus --program LONG", "octree-hull ball:LONG", "octree-hull LONG"),
        *("voxel-hull labels.npy --label LONG", "voxel-hull labels.npy --threshold LONG", "export LONG --format off"),
        *("voxel-hull labels.npy --shape LONG", "voxel-hull labels.npy --spacing LONG", "hidden-line LONG"),
        *("hidden-line house --near -LONG", "hidden-line house --without LONG", "appel-will example1 --printed LONG"),
        *("flowchart program1 --page LONG", "diff long.csv", "hull long.deck", "check long.f", "study long.toml"),
        *("hidden-line long.toml", "diff long.json", "diff long.npy", "octree-hull long.csv", "diff long.off"),
    ],
)
def test_a_long_text_of_the_input_is_shortened(words: str, own: Path, capsys) -> None:
    texts = {"csv": f"{LONG},0,0\n", "deck": f"{LONG}\n", "f": f"      A={LONG}\n", "toml": f"samples = {LONG}\n"}
    texts |= {"json": f"[[{LONG}, 0, 0]]", "off": f"OFF\n{LONG} 1 1\n"}
    for ending, text in texts.items():
        (own / f"long.{ending}").write_text(text, encoding="ascii")
    code, out, err = call(capsys, *(word.replace("LONG", LONG) for word in words.split()))
    assert code == 2
    assert max(map(len, (out + err).splitlines())) < 500
    assert (err or out).count("\n") == 1 or words.startswith("check")


@pytest.mark.parametrize("ending", [".png", ".PDF"])
def test_draw_writes_png_and_pdf(ending: str, room: Path, capsys, monkeypatch) -> None:
    pytest.importorskip("typst")
    for name in ("a", "b"):
        assert call(capsys, "draw", "example5", "--title", "Hull", "-o", name + ending) == (0, "", "")
    data = (room / f"a{ending}").read_bytes()
    assert data == (room / f"b{ending}").read_bytes()
    assert data.startswith(b"%PDF-" if ending == ".PDF" else b"\x89PNG\r\n\x1a\n")
    if ending == ".png":
        assert int.from_bytes(data[16:20], "big") == 2 * 640
    code, _, err = call(capsys, "draw", "example5", "--animate", "-o", f"c{ending}")
    assert (code, "only an SVG file can be animated" in err) == (2, True)
    monkeypatch.setattr("modern.drawing.svg.find_spec", lambda name: None)
    code, _, err = call(capsys, "draw", "example5", "-o", f"c{ending}")
    assert (code, err) == (2, f"hull1620: c{ending}: PDF and PNG need typst: pip install 'hull1620[plot]'\n")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("voxel-hull labels.npy --spacing=-1,1,1", "spacing: expected positive numbers, found -1"),
        ("study many.toml", "many.toml: line 1: samples: expected an integer of at least 1, found 'many'"),
        ("study digits.toml", "digits.toml: a number has too many digits, 10000 (at line 1, column 11)"),
        ("study deep.toml", "deep.toml: the text is nested too deeply"),
        ("hidden-line digits.toml", "digits.toml: line 1, column 11: a number has too many digits, 10000"),
        ("diff long.npy", "long.npy: row 1, x: 4901 digits; at most 4000 are read"),
        ("voxel-hull device.mhd", "device.mhd: /dev/zero: expected a regular file"),
        ("hull mine.toml/3", "mine.toml/0/3: study mine.toml has cells 0 to 0, samples 0 to 2"),
        ("hull yours.toml/3", "yours.toml: no such file or directory"),
    ],
)
def test_bad_input_is_one_line(words: str, message: str, own: Path, capsys) -> None:
    if "device" in words:
        pytest.importorskip("SimpleITK")
    (own / "many.toml").write_text(PLAN.format("samples = 'many'\n"), encoding="ascii")
    (own / "digits.toml").write_text(PLAN.format(f"samples = {'9' * 10_000}\n"), encoding="ascii")
    (own / "deep.toml").write_text("a = " + "[" * 50_000, encoding="ascii")
    code, out, err = call(capsys, *words.split())
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert err.endswith(f"{message}\n")


@pytest.mark.parametrize(
    ("words", "note"),
    [
        ("voxel-hull fractions.npy --each-label", "not integers: 6 (distinct values: 6, such as 0.25)"),
        ("voxel-hull folder/a.nhdr", "note: folder/a.nhdr: the data are read from {}/big.raw, which is not in"),
        ("voxel-hull folder/a.mhd", "note: folder/a.mhd: the data are read from {}/big.raw, which is not in"),
        ("hidden-line two.ply", "note: two.ply: 2 connected components"),
        ("hidden-line faces.json", "note: faces.json: the faces of a JSON file are not read"),
    ],
)
def test_data_that_are_left_out_or_lie_elsewhere_are_noted(words: str, note: str, own: Path, capsys) -> None:
    if words.endswith("mhd"):
        pytest.importorskip("SimpleITK")
    assert note.format(own) in call(capsys, *words.split())[2]


def test_a_sample_of_a_plan_and_a_pipe_are_read(own: Path, capsys) -> None:
    first, again, different = (call(capsys, "cards", f"mine.toml/{k}") for k in ("1", "0/1", "2"))
    assert first == again != different
    assert first[1].startswith(" 5\n")
    os.mkfifo("pipe")
    writer = threading.Thread(target=lambda: Path("pipe").write_bytes(Path("good.deck").read_bytes()))
    writer.start()
    from_pipe = call(capsys, "hull", "pipe")
    writer.join()
    assert from_pipe[:2] == call(capsys, "hull", "good.deck")[:2]


@pytest.mark.parametrize(
    ("words", "size"),
    [
        *((f"{command} /dev/zero", 16) for command in ("check", "run", "listing", "tei --read")),
        *(("study zero.toml", 16), ("hidden-line zero.toml", 16)),
        *((f"{command} /dev/zero", 2) for command in ("hull", "diff", "cards", "appel-will", "hidden-line")),
        *((f"{command} /dev/zero", 3) for command in ("voxel-hull", "octree-hull --shape 2,2,2")),
    ],
)
def test_a_device_without_an_end_is_read_up_to_the_limit_of_its_kind(words, size, own, capsys, monkeypatch) -> None:
    assert (files.TEXT_LIMIT, files.POINTS_LIMIT, files.VOLUME_LIMIT) == (16 << 20, 256 << 20, 1024 << 20)
    monkeypatch.setattr("modern.cli.shared.inputs.POINTS_LIMIT", 2 << 20)
    monkeypatch.setattr("modern.digital.volumes.VOLUME_LIMIT", 3 << 20)
    os.symlink("/dev/zero", "zero.toml")
    most = f"at most {size} MiB can be read from a pipe or device; write the data to a file"
    assert call(capsys, *words.split()) == (2, "", f"hull1620: {words.split()[-1]}: {most}\n")


def test_the_shell_completes_commands_options_and_examples() -> None:
    pytest.importorskip("argcomplete")

    def completed(line: str) -> list[str]:
        shell = {"_ARGCOMPLETE": "1", "_ARGCOMPLETE_STDOUT_FILENAME": "/dev/stdout", "COMP_LINE": line}
        environment = {**os.environ, **shell, "COMP_POINT": str(len(line)), "_ARGCOMPLETE_IFS": "\n"}
        command = [sys.executable, "-m", "hull1620"]
        done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
        return [word.strip() for word in done.stdout.split("\n")]

    assert completed("hull1620 hu") == ["hull"]
    assert completed("hull1620 hull --ep") == ["--epsilon"]
    assert completed("hull1620 hull exa") == [f"example{number}" for number in range(1, 7)]
    assert completed("hull1620 draw example1 --labels in") == ["input"]


def test_every_completed_name_is_that_of_an_argument_and_every_example_can_be_read() -> None:
    commands = next(a for a in build_parser()._actions if isinstance(a, argparse._SubParsersAction)).choices
    assert set(NAMES) <= {action.dest for command in commands.values() for action in command._actions}
    assert all(points_of(name).points for name in EXAMPLES)


def test_the_shell_completes_every_name_of_the_registers() -> None:
    assert builtin.names() == arguments.STUDIES
    assert arguments.PROGRAMS == programs.NAMES
    assert arguments.DOCUMENTS == DOCUMENTS
    assert tuple(THEOREMS) == arguments.THEOREMS
    assert scenes.names() == arguments.SCENES
    assert tuple(documents()) == arguments.TEXTS
    assert [numbers(name).name for name in arguments.ARITHMETICS] == list(arguments.ARITHMETICS)
