"""Files that appear whole or not at all, whatever interrupts: written beside their place, then renamed."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from modern.study.plan import PlanError

BESIDE = ".beside-"
"""How the name of a file begins that is not in its place yet."""


class StudyFileError(PlanError):
    """A file of a study that cannot be written or read; one line that says what to do."""


@contextmanager
def placing(path: Path) -> Iterator[BinaryIO]:
    """A file to write, put in its place when all of it is on disk.  Raises StudyFileError."""
    beside = path.with_name(f"{BESIDE}{path.name}")
    try:
        with open(beside, "wb") as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        os.replace(beside, path)
    except OSError as error:
        beside.unlink(missing_ok=True)
        raise StudyFileError(f"{path}: {(error.strerror or str(error)).lower()}") from None


def put(path: Path, data: bytes | str) -> None:
    """Write a file whole or not at all.  Raises StudyFileError."""
    with placing(path) as file:
        file.write(data.encode("utf-8") if isinstance(data, str) else data)


def sweep(folder: Path) -> None:
    """Take away what an interrupted run left beside."""
    for path in folder.glob(f"{BESIDE}*"):
        path.unlink(missing_ok=True)
