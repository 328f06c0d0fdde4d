"""The public names of ``hull1620``: lazy imports, types and help."""

import ast
import os
import pydoc
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import hull1620
from tests.support.paths import ROOT


def python(*words: str, cwd: Path = ROOT) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    return subprocess.run(
        [sys.executable, *words], cwd=cwd, env=environment, capture_output=True, text=True, check=False
    )


def test_public_names_exist_in_package_and_stub() -> None:
    assert [name for name in hull1620.__all__ if not hasattr(hull1620, name)] == []
    assert sorted(name for name in dir(hull1620) if not name.startswith("_")) == hull1620.__all__
    with pytest.raises(AttributeError, match=r"^module 'hull1620' has no attribute 'hull_of_nothing'$"):
        _ = hull1620.hull_of_nothing
    stub = ast.parse((ROOT / "hull1620" / "__init__.pyi").read_text(encoding="utf-8"))
    imports = [node for node in stub.body if isinstance(node, ast.ImportFrom)]
    assert sorted(alias.name for node in imports for alias in node.names) == hull1620.__all__


def test_an_import_is_fast_and_loads_no_other_package() -> None:
    words = (
        "import sys, hull1620; print({name.split('.')[0] for name in sys.modules} & {'modern', 'emulator', 'numpy'})"
    )
    assert python("-c", words).stdout == "set()\n"
    words = "import time; t = time.perf_counter(); import hull1620; print(time.perf_counter() - t)"
    assert min(float(python("-c", words).stdout) for _ in range(3)) < 0.1


@pytest.mark.parametrize(
    "name", ["emulator.py", "modern.py", "transcripts.py", "fortran_src.py", "emulator/__init__.py"]
)
def test_a_file_that_hides_a_package_is_named_with_the_remedy(name: str, tmp_path: Path) -> None:
    (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / name).write_text("", encoding="utf-8")
    hiding = tmp_path / (name if name.endswith("n.py") or "/" not in name else name.partition("/")[0])
    package = name.partition("/")[0].removesuffix(".py")
    message = f"{hiding} hides the package {package!r} of hull1620; rename it, or work in another folder"
    for words in (["-c", "import hull1620"], ["-m", "hull1620", "--help"]):
        done = python(*words, cwd=tmp_path)
        assert (done.returncode, done.stdout) == (1, "")
        assert message in done.stderr.splitlines()[-1]
    assert len(done.stderr.splitlines()) == 1


def test_a_distribution_that_overwrites_a_package_is_reported(tmp_path: Path) -> None:
    for name in ("hull1620", "emulator", "modern", "fortran_src", "transcripts"):
        (tmp_path / name).mkdir()
        shutil.copy(ROOT / name / "__init__.py", tmp_path / name)
    (tmp_path / "modern" / "__init__.py").write_text("", encoding="utf-8")
    done = python("-m", "hull1620", "--help", cwd=tmp_path)
    assert (done.returncode, len(done.stderr.splitlines())) == (1, 1)
    assert "another distribution has overwritten" in done.stderr
    assert "install hull1620 in a separate environment" in done.stderr


def test_help_lists_the_functions_and_the_package_runs_the_command() -> None:
    text = pydoc.plain(pydoc.render_doc(hull1620))
    for name in ("convex_hull", "exact_hull", "run_hull", "diverge", "run_study", "class Machine", "class Hull"):
        assert name in text
    assert "counterclockwise seen from outside" in pydoc.plain(pydoc.render_doc(hull1620.Hull))
    done = python("-m", "hull1620", "--help")
    assert done.returncode == 0
    assert done.stdout.startswith("usage: hull1620 ")
    assert python("-m", "hull1620", "hull", "absent.deck").returncode == 2
