"""The order of the packages and the length of the modules match ``pyproject.toml``, and each check can fail."""

import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from tests.support import architecture
from tests.support.paths import ROOT

LIMITS = architecture.limits(ROOT)
EMULATOR = ("compiled", "machine", "objectdeck", "translation", "language", "numbers", "jit")


def test_modules_import_lower_packages_without_cycles_and_keep_the_limits() -> None:
    are_kept, report = architecture.check_contracts(ROOT)
    assert are_kept, report
    assert architecture.import_cycle("emulator", "modern", "hull1620") == ()
    assert architecture.modules_outside_packages(ROOT) == []
    assert len(architecture.packages_of_modern(ROOT)) <= LIMITS.max_packages
    assert architecture.wrong_lengths(ROOT, LIMITS) == []
    short = architecture.short_modules(ROOT, LIMITS)
    assert len(short) <= LIMITS.max_short_modules, short


@pytest.fixture
def empty_project(tmp_path: Path) -> Path:
    """A project of empty packages with the contracts of this one."""
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    packages = (("emulator", EMULATOR), ("modern", architecture.packages_of_modern(ROOT)), ("hull1620", ()))
    for package, names in packages:
        for folder in (tmp_path / package, *(tmp_path / package / name for name in names)):
            folder.mkdir()
            (folder / "__init__.py").touch()
    for module in ("emulator/errors.py", "emulator/files.py", "emulator/progress.py", "hull1620/hulls.py"):
        (tmp_path / module).touch()
    return tmp_path


def test_empty_packages_keep_the_contracts(empty_project: Path) -> None:
    are_kept, report = architecture.check_contracts(empty_project)
    assert are_kept, report
    assert "Contracts: 4 kept, 0 broken." in report


@pytest.mark.parametrize(
    ("module", "line", "contract"),
    [
        ("emulator/numbers/a.py", "from emulator.machine import b", "packages of emulator"),
        ("emulator/errors.py", "import emulator.files", "packages of emulator"),
        ("modern/geometry/a.py", "def f():\n    from modern.formats import b", "packages of modern"),
        ("modern/thesis/a.py", "import modern.comparison.b", "packages of modern"),
        ("emulator/compiled/a.py", "import modern.geometry.b", "never the other way"),
        ("modern/geometry/a.py", "import hull1620.hulls", "never the other way"),
        ("modern/port/a.py", "import tests.support", "nothing imports tests"),
    ],
)
def test_an_import_of_a_higher_package_is_reported(empty_project: Path, module: str, line: str, contract: str) -> None:
    for folder in ("emulator/machine", "modern/formats", "modern/comparison", "modern/geometry"):
        (empty_project / folder / "b.py").touch()
    (empty_project / module).write_text(line + "\n", encoding="utf-8")
    are_kept, report = architecture.check_contracts(empty_project)
    assert not are_kept
    assert f"{contract} BROKEN" in report
    assert "Contracts: 3 kept, 1 broken." in report


@pytest.mark.parametrize("package", ["modern/extra", "emulator/extra"])
def test_a_package_that_no_contract_names_is_reported(empty_project: Path, package: str) -> None:
    (empty_project / package).mkdir()
    (empty_project / package / "__init__.py").touch()
    are_kept, report = architecture.check_contracts(empty_project)
    assert not are_kept
    assert "extra" in report


def test_an_import_cycle_is_reported(tmp_path: Path, monkeypatch) -> None:
    package = tmp_path / "cyclic"
    package.mkdir()
    for name, line in {"__init__": "", "a": "from cyclic.b import x", "b": "import cyclic.c", "c": ""}.items():
        (package / f"{name}.py").write_text(line + "\n", encoding="utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    assert architecture.import_cycle("cyclic") == ()
    (package / "c.py").write_text("def f():\n    from cyclic import a\n", encoding="utf-8")
    cycle = architecture.import_cycle("cyclic")
    assert cycle[0] == cycle[-1]
    assert set(cycle) == {"cyclic.a", "cyclic.b", "cyclic.c"}


def test_a_module_outside_the_packages_and_a_surplus_package_are_reported(empty_project: Path) -> None:
    assert architecture.modules_outside_packages(empty_project) == []
    (empty_project / "modern" / "points.py").touch()
    assert architecture.modules_outside_packages(empty_project) == ["points.py"]
    assert len(architecture.packages_of_modern(empty_project)) == LIMITS.max_packages
    (empty_project / "modern" / "extra").mkdir()
    (empty_project / "modern" / "extra" / "__init__.py").touch()
    assert len(architecture.packages_of_modern(empty_project)) > LIMITS.max_packages


def test_a_long_module_and_a_needless_exception_are_reported(empty_project: Path) -> None:
    module = empty_project / "modern" / "port" / "a.py"
    with_exception = replace(LIMITS, exceptions={"modern/port/a.py": "a table"})
    module.write_text("x = 1\n" * LIMITS.max_lines, encoding="utf-8")
    assert architecture.wrong_lengths(empty_project, LIMITS) == []
    assert architecture.wrong_lengths(empty_project, with_exception) == ["modern/port/a.py"]
    module.write_text("x = 1\n" * (LIMITS.max_lines + 1), encoding="utf-8")
    assert architecture.wrong_lengths(empty_project, LIMITS) == ["modern/port/a.py"]
    assert architecture.wrong_lengths(empty_project, with_exception) == []


def test_a_short_module_is_reported(empty_project: Path) -> None:
    empty = ["emulator/errors.py", "emulator/files.py", "emulator/progress.py", "hull1620/hulls.py"]
    module = empty_project / "modern" / "port" / "a.py"
    module.write_text("x = 1\n" * (LIMITS.short_lines - 1), encoding="utf-8")
    assert architecture.short_modules(empty_project, LIMITS) == [*empty, "modern/port/a.py"]
    module.write_text("x = 1\n" * LIMITS.short_lines, encoding="utf-8")
    assert architecture.short_modules(empty_project, LIMITS) == empty
