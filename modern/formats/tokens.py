"""Words of a text file with line and column, as the readers of OFF, OBJ, PLY and STL take them: decimals and counts.

And the surface such a file holds.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from emulator.errors import FileError
from modern.geometry.numbers import Point, number, quoted

Word = tuple[str, int]
"""A word and the column it begins in, from 1."""
Line = tuple[int, list[Word]]
"""A line's number, from 1, and its words; there is one at least."""


@dataclass(frozen=True, slots=True)
class FileMesh:
    """A file of a surface: its points as the text that stands there, where each stands (line, or triangle of a binary
    file), and faces by place from 0."""

    source: str
    points: tuple[Point, ...]
    lines: tuple[int, ...]
    faces: tuple[tuple[int, ...], ...]


def lines(text: str, comment: str = "#") -> Iterator[Line]:
    """Lines with words in them; what follows ``comment`` (empty: nothing) is passed over."""
    for number_, line in enumerate(text.replace("\r\n", "\n").split("\n"), 1):
        kept = line.split(comment, 1)[0] if comment else line
        words = [(match[0], match.start() + 1) for match in re.finditer(r"\S+", kept)]
        if words:
            yield number_, words


def last_line(text: str) -> int:
    """The number of the line a text ends in."""
    return text.count("\n") + 1


def take(found: Iterator[Line], count: int, source: str, last: int, what: str) -> Iterator[Line]:
    """So many lines.  Raises FileError where the file ends before, in line ``last``."""
    for done in range(count):
        line = next(found, None)
        if line is None:
            raise FileError(f"{source}: line {last}, column 1: the file ends after {done} of {count} {what}")
        yield line


def point(source: str, line: int, words: list[Word]) -> Point:
    """The three decimals of a point.  Raises FileError."""
    x, y, z = (decimal(source, line, word) for word in words)
    return x, y, z


def count(source: str, line: int, word: Word) -> int:
    """A whole number of at most nine digits.  Raises FileError."""
    if not re.fullmatch(r"[0-9]{1,9}", word[0]):
        raise error(source, line, word, f"{quoted(word[0])} is not a count")
    return int(word[0])


def decimal(source: str, line: int, word: Word) -> str:
    """A decimal number, as the text that stands there.  Raises FileError."""
    try:
        if "/" in word[0]:
            raise ValueError(f"{quoted(word[0])} is not a decimal number")
        number(word[0])
    except ValueError as wrong:
        raise error(source, line, word, str(wrong)) from None
    return word[0]


def error(source: str, line: int, word: Word, message: str) -> FileError:
    """What is wrong with a word."""
    return FileError(f"{source}: line {line}, column {word[1]}: {message}")
