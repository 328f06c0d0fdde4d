"""The two tables: which files make up an area and which tests judge it; which mutants are known to change nothing."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
ROOT = HERE.parent.parent


class TableError(ValueError):
    """A table that cannot be read or names a file that does not exist; one line."""


@dataclass(frozen=True, slots=True)
class Area:
    """Files to change and the tests that must notice; all paths from the root of the tree.

    ``tests`` are pytest's arguments, files or single tests; ``select`` is its ``-k``.
    """

    name: str
    files: tuple[str, ...]
    tests: tuple[str, ...]
    select: str = ""


@dataclass(frozen=True, slots=True)
class Equivalent:
    """Mutants of one line that change nothing a test could see; ``file`` is ``*`` for that line in any file.

    ``line`` is the line without its indent, ``becomes`` the line of the mutant, empty for any mutant of that operator;
    ``operator`` is a pattern as of a shell.
    """

    file: str
    line: str
    operator: str
    reason: str
    becomes: str = ""

    def fits(self, file: str, line: str, operator: str) -> bool:
        """Whether it is about that line and operator; the caller compares what the line becomes."""
        return self.file in ("*", file) and self.line == line.strip() and fnmatchcase(operator, self.operator)


def read_areas(path: Path = HERE / "areas.toml", root: Path = ROOT) -> tuple[tuple[Area, ...], tuple[str, ...]]:
    """The areas, with their patterns of files resolved, and the patterns of the operators left out.

    Raises TableError for a pattern that matches no file and for a test whose file does not exist.
    """
    table = _table(path)
    areas = []
    for name, entry in table.pop("area").items():
        try:
            area = Area(name, _files(entry.pop("files"), root), tuple(entry.pop("tests")), **entry)
        except (KeyError, TypeError, TableError) as error:
            raise TableError(f"{path.name}: area {name}: {error}") from None
        for test in area.tests:
            if not (root / test.partition("::")[0]).exists():
                raise TableError(f"{path.name}: area {name}: there is no {test}")
        areas.append(area)
    return tuple(areas), tuple(operator["name"] for operator in table.pop("left_out"))


def read_equivalents(path: Path = HERE / "equivalent.toml") -> tuple[Equivalent, ...]:
    """The mutants known to be equivalent.  Raises TableError."""
    try:
        found = tuple(Equivalent(**entry) for entry in _table(path)["equivalent"])
    except (KeyError, TypeError) as error:
        raise TableError(f"{path.name}: {error}") from None
    for entry in found:
        if not entry.reason.strip():
            raise TableError(f"{path.name}: {entry.file}: {entry.line!r} has no reason")
    return found


def _table(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, tomllib.TOMLDecodeError) as error:
        raise TableError(f"{path.name}: {error}") from None


def _files(patterns: list[str], root: Path) -> tuple[str, ...]:
    files: dict[str, None] = {}
    for pattern in patterns:
        found = sorted(path.relative_to(root).as_posix() for path in root.glob(pattern))
        if not found:
            raise TableError(f"no file is {pattern}")
        files.update(dict.fromkeys(found))
    return tuple(files)
