"""The measure of the house: which rooms there are, how long their modules are, and whether imports run in circles.

The order of the rooms is the import-linter contracts of ``pyproject.toml``; the numbers stand beside them, in
``[tool.house]``.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import grimp


@dataclass(frozen=True)
class Limits:
    """What ``[tool.house]`` allows; ``long`` names modules that may be longer (path below the root, reason)."""

    rooms: int
    lines: int
    short: int
    short_modules: int
    long: Mapping[str, str]


def limits(root: Path) -> Limits:
    """The limits that the ``pyproject.toml`` of this folder states."""
    with (root / "pyproject.toml").open("rb") as stream:
        return Limits(**tomllib.load(stream)["tool"]["house"])


def contracts(root: Path) -> tuple[bool, str]:
    """Whether import-linter finds every contract of ``root/pyproject.toml`` kept, and what it prints."""
    command = [sys.executable, "-c", "from importlinter.cli import lint_imports_command as main; main()"]
    environment = {**os.environ, "PYTHONPATH": str(root), "COLUMNS": "200"}
    options = ["--config", "pyproject.toml", "--no-cache"]
    done = subprocess.run(
        [*command, *options], cwd=root, env=environment, capture_output=True, text=True, encoding="utf-8", check=False
    )
    return done.returncode == 0, done.stdout + done.stderr


def circle(*packages: str) -> tuple[str, ...]:
    """The modules of one circle of imports, the first one repeated at the end; empty where there is none.

    An import of a package is an import of its ``__init__``; imports inside functions count.
    """
    graph = grimp.build_graph(*packages, cache_dir=None)
    try:
        TopologicalSorter({name: graph.find_modules_directly_imported_by(name) for name in graph.modules}).prepare()
    except CycleError as error:
        return tuple(reversed(error.args[1]))
    return ()


def loose(root: Path) -> list[str]:
    """Modules that lie in ``modern`` and in none of its rooms."""
    return sorted(path.name for path in (root / "modern").glob("*.py") if path.name != "__init__.py")


def rooms(root: Path) -> list[str]:
    """The rooms of ``modern``."""
    return sorted(path.parent.name for path in (root / "modern").glob("*/__init__.py"))


def too_long(root: Path, allowed: Limits) -> list[str]:
    """Modules of more lines than allowed, and exceptions that need not be made any more."""
    lengths = _lengths(root)
    over = {name for name, lines in lengths.items() if lines > allowed.lines}
    return sorted(over ^ set(allowed.long))


def short(root: Path, allowed: Limits) -> list[str]:
    """Modules below the length under which a module is short, ``__init__`` not counted."""
    return sorted(name for name, lines in _lengths(root).items() if lines < allowed.short)


def _lengths(root: Path) -> dict[str, int]:
    return {
        path.relative_to(root).as_posix(): len(path.read_text(encoding="utf-8").splitlines()) for path in _modules(root)
    }


def _modules(root: Path) -> list[Path]:
    found = [path for package in ("emulator", "modern", "hull1620") for path in sorted((root / package).rglob("*.py"))]
    return [path for path in found if path.name != "__init__.py"]
