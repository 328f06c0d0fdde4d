"""The order of the rooms and the size of the modules, as ``pyproject.toml`` states them; each guard is also tripped."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from tests.support import house
from tests.support.paths import ROOT

LIMITS = house.limits(ROOT)
EMULATOR = ("compiled", "machine", "language", "numbers", "jit")
MODERN = tuple(
    (
        "cli publication bench study claims papers drawing digital edition comparison "
        "thesis port exact_hull formats geometry"
    ).split()
)


def test_a_room_imports_only_rooms_below_it() -> None:
    kept, printed = house.contracts(ROOT)
    assert kept, printed


def test_no_files_import_one_another_in_a_circle() -> None:
    assert house.circle("emulator", "modern", "hull1620") == ()


def test_modern_has_no_loose_module() -> None:
    assert house.loose(ROOT) == []


def test_modern_has_no_more_rooms_than_allowed() -> None:
    assert len(house.rooms(ROOT)) <= LIMITS.rooms, house.rooms(ROOT)


def test_no_module_is_too_long() -> None:
    assert house.too_long(ROOT, LIMITS) == []


def test_few_modules_are_short() -> None:
    found = house.short(ROOT, LIMITS)
    assert len(found) <= LIMITS.short_modules, found


@pytest.fixture
def made_up(tmp_path: Path) -> Path:
    """A house of empty rooms, with the contracts of this one."""
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    for package, names in (("emulator", EMULATOR), ("modern", MODERN), ("hull1620", ())):
        for folder in (tmp_path / package, *(tmp_path / package / name for name in names)):
            folder.mkdir()
            (folder / "__init__.py").touch()
    (tmp_path / "emulator" / "errors.py").touch()
    (tmp_path / "emulator" / "files.py").touch()
    (tmp_path / "emulator" / "progress.py").touch()
    (tmp_path / "hull1620" / "hulls.py").touch()
    return tmp_path


def test_the_contracts_are_kept_by_empty_rooms(made_up: Path) -> None:
    kept, printed = house.contracts(made_up)
    assert kept, printed
    assert "Contracts: 4 kept, 0 broken." in printed


@pytest.mark.parametrize(
    ("place", "line", "contract"),
    [
        ("emulator/numbers/a.py", "from emulator.machine import b", "the rooms of emulator"),
        ("emulator/errors.py", "import emulator.files", "the rooms of emulator"),
        ("modern/geometry/a.py", "def f():\n    from modern.formats import b", "the rooms of modern"),
        ("modern/thesis/a.py", "import modern.comparison.b", "the rooms of modern"),
        ("emulator/compiled/a.py", "import modern.geometry.b", "never the other way"),
        ("modern/geometry/a.py", "import hull1620.hulls", "never the other way"),
        ("modern/port/a.py", "import tests.support", "nothing imports tests"),
    ],
)
def test_an_import_of_an_upper_room_is_found(made_up: Path, place: str, line: str, contract: str) -> None:
    for folder in ("emulator/machine", "modern/formats", "modern/comparison", "modern/geometry"):
        (made_up / folder / "b.py").touch()
    (made_up / place).write_text(line + "\n", encoding="utf-8")
    kept, printed = house.contracts(made_up)
    assert not kept
    assert f"{contract} BROKEN" in printed
    assert "Contracts: 3 kept, 1 broken." in printed


@pytest.mark.parametrize("room", ["modern/attic", "emulator/attic"])
def test_a_room_that_has_no_place_in_the_order_is_found(made_up: Path, room: str) -> None:
    (made_up / room).mkdir()
    (made_up / room / "__init__.py").touch()
    kept, printed = house.contracts(made_up)
    assert not kept
    assert "attic" in printed


def test_a_circle_of_files_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = tmp_path / "round_house"
    package.mkdir()
    lines = {"__init__": "", "a": "from round_house.b import x", "b": "import round_house.c", "c": ""}
    for name, line in lines.items():
        (package / f"{name}.py").write_text(line + "\n", encoding="utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    assert house.circle("round_house") == ()
    (package / "c.py").write_text("def f():\n    from round_house import a\n", encoding="utf-8")
    found = house.circle("round_house")
    assert found[0] == found[-1]
    assert set(found) == {"round_house.a", "round_house.b", "round_house.c"}


def test_a_loose_module_and_a_room_too_many_are_found(made_up: Path) -> None:
    assert house.loose(made_up) == []
    (made_up / "modern" / "points.py").touch()
    assert house.loose(made_up) == ["points.py"]
    assert len(house.rooms(made_up)) == LIMITS.rooms
    (made_up / "modern" / "attic").mkdir()
    (made_up / "modern" / "attic" / "__init__.py").touch()
    assert len(house.rooms(made_up)) > LIMITS.rooms


def test_a_long_module_and_an_exception_not_needed_are_found(made_up: Path) -> None:
    module = made_up / "modern" / "port" / "a.py"
    module.write_text("x = 1\n" * LIMITS.lines, encoding="utf-8")
    assert house.too_long(made_up, LIMITS) == []
    exempt = replace(LIMITS, long={"modern/port/a.py": "a table"})
    assert house.too_long(made_up, exempt) == ["modern/port/a.py"]
    module.write_text("x = 1\n" * (LIMITS.lines + 1), encoding="utf-8")
    assert house.too_long(made_up, LIMITS) == ["modern/port/a.py"]
    assert house.too_long(made_up, exempt) == []


def test_a_short_module_is_counted(made_up: Path) -> None:
    empty = ["emulator/errors.py", "emulator/files.py", "emulator/progress.py", "hull1620/hulls.py"]
    assert house.short(made_up, LIMITS) == empty
    module = made_up / "modern" / "port" / "a.py"
    module.write_text("x = 1\n" * (LIMITS.short - 1), encoding="utf-8")
    assert house.short(made_up, LIMITS) == [*empty, "modern/port/a.py"]
    module.write_text("x = 1\n" * LIMITS.short, encoding="utf-8")
    assert house.short(made_up, LIMITS) == empty
