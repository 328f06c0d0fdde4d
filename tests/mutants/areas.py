"""The two tables: the areas with their files and tests, and the mutants that no test can notice."""

import tomllib
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
ROOT = HERE.parent.parent


class TableError(ValueError):
    """A table that cannot be read or names a file that does not exist."""


@dataclass(frozen=True, slots=True)
class Area:
    """Files to change and the tests that must notice, as paths from the root of the tree.

    ``tests`` are arguments of pytest, and ``select`` is its ``-k``.
    """

    name: str
    files: tuple[str, ...]
    tests: tuple[str, ...]
    select: str = ""


@dataclass(frozen=True, slots=True)
class Equivalent:
    """Mutants of one line that change nothing a test can observe; ``file`` is ``*`` for the line in any file.

    ``line`` is the line without its indentation. ``becomes`` is the line of the mutant, or empty for every mutant of
    the operator. ``operator`` is a shell pattern.
    """

    file: str
    line: str
    operator: str
    reason: str
    becomes: str = ""

    def fits(self, file: str, line: str, operator: str) -> bool:
        """Return True if the entry is about that line and operator. The caller compares ``becomes``."""
        return self.file in ("*", file) and self.line == line.strip() and fnmatchcase(operator, self.operator)


def read_areas(path: Path = HERE / "areas.toml", root: Path = ROOT) -> tuple[tuple[Area, ...], tuple[str, ...]]:
    """Return the areas and the patterns of the operators that are left out.

    Raise TableError for a pattern without a file and for a test whose file does not exist.
    """
    table = _table(path)
    areas = []
    for name, entry in table["area"].items():
        try:
            area = Area(name, _files(entry.pop("files"), root), tuple(entry.pop("tests")), **entry)
        except (KeyError, TypeError, TableError) as error:
            raise TableError(f"{path.name}: area {name}: {error}") from None
        for test in area.tests:
            if not (root / test.partition("::")[0]).exists():
                raise TableError(f"{path.name}: area {name}: {test} does not exist")
        areas.append(area)
    return tuple(areas), tuple(operator["name"] for operator in table["left_out"])


def read_equivalents(path: Path = HERE / "equivalent.toml") -> tuple[Equivalent, ...]:
    """Return the mutants known to be equivalent. Raise TableError if an entry has no reason."""
    try:
        entries = tuple(Equivalent(**entry) for entry in _table(path)["equivalent"])
    except (KeyError, TypeError) as error:
        raise TableError(f"{path.name}: {error}") from None
    for entry in entries:
        if not entry.reason.strip():
            raise TableError(f"{path.name}: {entry.file}: {entry.line!r} has no reason")
    return entries


def _table(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, tomllib.TOMLDecodeError) as error:
        raise TableError(f"{path.name}: {error}") from None


def _files(patterns: list[str], root: Path) -> tuple[str, ...]:
    files: dict[str, None] = {}
    for pattern in patterns:
        matches = sorted(path.relative_to(root).as_posix() for path in root.glob(pattern))
        if not matches:
            raise TableError(f"no file matches {pattern}")
        files.update(dict.fromkeys(matches))
    return tuple(files)
