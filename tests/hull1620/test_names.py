"""The package ``hull1620``: its names, found without cost, with types and help."""

from __future__ import annotations

import os
import pydoc
import subprocess
import sys
from pathlib import Path

import pytest

import emulator
import hull1620
import modern
from tests.support.paths import ROOT

SCRIPT = """
from fractions import Fraction

import numpy as np
import numpy.typing as npt

import hull1620
from hull1620 import Hull, HullRefused, Machine, compile_deck, convex_hull, exact_hull, read_deck


def largest(points: npt.NDArray[np.float64]) -> Fraction:
    hull: Hull = exact_hull(points)
    try:
        convex_hull(points.tolist(), "float64", epsilon=1e-9)
    except HullRefused as refused:
        print(refused.result)
    corners: npt.NDArray[np.float64] = hull.points[hull.vertices]
    print(corners.sum(), hull.simplices.shape, hull.area + 1, hull.draw(eye=(1, 2.5, 3)).upper())
    return hull.volume


def cards(name: str) -> tuple[str, ...]:
    program = compile_deck(read_deck(name))
    return Machine(program, hull1620.data_deck([(0, 0, 0)])).run().punched
"""


def python(*words: str, cwd: Path = ROOT) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    return subprocess.run(
        [sys.executable, *words], cwd=cwd, env=environment, capture_output=True, text=True, check=False
    )


def test_every_name_is_there_and_is_listed_for_completion() -> None:
    assert [name for name in hull1620.__all__ if not hasattr(hull1620, name)] == []
    for package in (hull1620, emulator, modern):
        assert set(package.__all__) <= set(dir(package))
        with pytest.raises(AttributeError, match=f"^module '{package.__name__}' has no attribute 'hull_of_nothing'$"):
            _ = package.hull_of_nothing


def test_completion_offers_the_public_names_alone() -> None:
    for package in (hull1620, emulator, modern):
        assert sorted(name for name in dir(package) if not name.startswith("_")) == sorted(package.__all__)


def test_a_name_is_the_one_of_its_room() -> None:
    apart = {"Hull", "convex_hull"}
    for package in (emulator, modern):
        for name in set(package.__all__) - apart:
            assert getattr(hull1620, name) is getattr(package, name)


def test_an_import_loads_no_room() -> None:
    words = (
        "import sys, hull1620; print({name.split('.')[0] for name in sys.modules} & {'modern', 'emulator', 'numpy'})"
    )
    assert python("-c", words).stdout == "set()\n"


def test_an_import_takes_less_than_a_tenth_of_a_second() -> None:
    words = "import time; t = time.perf_counter(); import hull1620; print(time.perf_counter() - t)"
    assert min(float(python("-c", words).stdout) for _ in range(5)) < 0.1


def test_help_has_every_public_function() -> None:
    text = pydoc.plain(pydoc.render_doc(hull1620))
    for name in ("convex_hull", "exact_hull", "run_hull", "diverge", "run_study", "class Machine", "class Hull"):
        assert name in text
    assert "counterclockwise seen from outside" in pydoc.plain(pydoc.render_doc(hull1620.Hull))


def test_a_script_of_a_user_has_types(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    (tmp_path / "mine.py").write_text(SCRIPT, encoding="utf-8")
    done = python("-m", "mypy", "--strict", "--follow-imports=silent", "mine.py", cwd=tmp_path)
    assert done.stdout.startswith("Success"), done.stdout + done.stderr
    (tmp_path / "mine.py").write_text(SCRIPT + "\nhull1620.exact_hull(3).volume.upper()\n", encoding="utf-8")
    done = python("-m", "mypy", "--strict", "--follow-imports=silent", "mine.py", cwd=tmp_path)
    assert "Found 2 errors" in done.stdout, done.stdout + done.stderr


def test_the_package_is_the_command() -> None:
    done = python("-m", "hull1620", "--help")
    assert done.returncode == 0
    assert done.stdout.startswith("usage: hull1620 ")
    assert python("-m", "hull1620", "hull", "absent.deck").returncode == 2
