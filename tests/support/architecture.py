"""Checks of the architecture: the packages, the length of their modules, and circular imports.

The order of the packages is stated by the import-linter contracts of ``pyproject.toml``, and the limits by its table
``[tool.architecture]``.
"""

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
    """The limits of ``[tool.architecture]``.

    max_packages: packages in ``modern``.  max_lines: lines of a module.  short_lines: a module with fewer lines is
    short.  max_short_modules: short modules of the project.  exceptions: longer modules, from path to reason.
    """

    max_packages: int
    max_lines: int
    short_lines: int
    max_short_modules: int
    exceptions: Mapping[str, str]


def limits(root: Path) -> Limits:
    """Return the limits stated in ``root/pyproject.toml``."""
    with (root / "pyproject.toml").open("rb") as stream:
        return Limits(**tomllib.load(stream)["tool"]["architecture"])


def check_contracts(root: Path) -> tuple[bool, str]:
    """Run import-linter in ``root``; return True if every contract is kept, and its output."""
    command = [sys.executable, "-c", "from importlinter.cli import lint_imports_command as main; main()"]
    environment = {**os.environ, "PYTHONPATH": str(root), "COLUMNS": "200"}
    options = ["--config", "pyproject.toml", "--no-cache"]
    process = subprocess.run(
        [*command, *options], cwd=root, env=environment, capture_output=True, text=True, encoding="utf-8", check=False
    )
    return process.returncode == 0, process.stdout + process.stderr


def import_cycle(*packages: str) -> tuple[str, ...]:
    """Return the modules of one import cycle, the first repeated at the end, or () if there is no cycle.

    Importing a package counts as importing its ``__init__``.  Imports inside functions count.
    """
    graph = grimp.build_graph(*packages, cache_dir=None)
    try:
        TopologicalSorter({name: graph.find_modules_directly_imported_by(name) for name in graph.modules}).prepare()
    except CycleError as error:
        return tuple(reversed(error.args[1]))
    return ()


def modules_outside_packages(root: Path) -> list[str]:
    """Return the modules that lie directly in ``modern``."""
    return sorted(path.name for path in (root / "modern").glob("*.py") if path.name != "__init__.py")


def packages_of_modern(root: Path) -> list[str]:
    """Return the names of the packages of ``modern``."""
    return sorted(path.parent.name for path in (root / "modern").glob("*/__init__.py"))


def wrong_lengths(root: Path, allowed: Limits) -> list[str]:
    """Return the modules that are too long without an exception, and the exceptions that are not needed."""
    too_long = {name for name, lines in _lengths(root).items() if lines > allowed.max_lines}
    return sorted(too_long ^ set(allowed.exceptions))


def short_modules(root: Path, allowed: Limits) -> list[str]:
    """Return the short modules, except ``__init__`` files."""
    return sorted(name for name, lines in _lengths(root).items() if lines < allowed.short_lines)


def _lengths(root: Path) -> dict[str, int]:
    paths = [path for package in ("emulator", "modern", "hull1620") for path in sorted((root / package).rglob("*.py"))]
    return {
        path.relative_to(root).as_posix(): len(path.read_text(encoding="utf-8").splitlines())
        for path in paths
        if path.name != "__init__.py"
    }
