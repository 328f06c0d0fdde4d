"""Split a text file into tokens with their lines and columns, for the readers of OFF, OBJ, PLY and STL."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from emulator.errors import FileError, quoted
from modern.geometry.numbers import Point, number

# A token and the column in which it begins, from 1.
Token = tuple[str, int]
# The number of a line, from 1, and its tokens, at least one.
Line = tuple[int, list[Token]]


@dataclass(frozen=True, slots=True)
class FileMesh:
    """The surface in a file: points as decimal text, and faces as indices of points.

    ``lines`` has the number of the line (in a binary file, of the vertex or triangle) that holds each point.
    """

    source: str
    points: tuple[Point, ...]
    lines: tuple[int, ...]
    faces: tuple[tuple[int, ...], ...]


def lines(text: str, comment: str = "#") -> Iterator[Line]:
    """Yield those lines of a text that have tokens.  Comments, which begin with the mark ``comment``, are dropped."""
    for line_number, line in enumerate(text.replace("\r\n", "\n").split("\n"), 1):
        content = line.split(comment, 1)[0] if comment else line
        tokens = [(match[0], match.start() + 1) for match in re.finditer(r"\S+", content)]
        if tokens:
            yield line_number, tokens


def last_line(text: str) -> int:
    return text.count("\n") + 1


def take(rows: Iterator[Line], count: int, source: str, last: int, what: str) -> Iterator[Line]:
    """Yield the next ``count`` lines of a file.  Raise FileError for line ``last`` if the file ends earlier."""
    for done in range(count):
        line = next(rows, None)
        if line is None:
            raise FileError(f"{source}: line {last}, column 1: the file ends after {done} of {count} {what}")
        yield line


def vertex(source: str, line: int, tokens: list[Token], first: int = 0, allow_more: bool = False) -> Point:
    """Return the three coordinates of a vertex, which begin at token ``first`` of a line.

    Raise FileError if they are invalid, or if more tokens follow and ``allow_more`` is false.
    """
    numbers = len(tokens) - first
    if numbers < 3 or (numbers > 3 and not allow_more):
        where = tokens[min(first + 3, len(tokens) - 1)]
        raise error(source, line, where, f"expected a vertex of 3 numbers, x y z; found {numbers}")
    x, y, z = (decimal(source, line, token) for token in tokens[first : first + 3])
    return x, y, z


def count(source: str, line: int, token: Token) -> int:
    """Return a token as an integer of at most nine digits.  Raise FileError for any other token."""
    if not re.fullmatch(r"[0-9]{1,9}", token[0]):
        raise error(source, line, token, f"{quoted(token[0])} is not a count")
    return int(token[0])


def decimal(source: str, line: int, token: Token) -> str:
    """Return the text of a token, a decimal number.  Raise FileError for any other token."""
    try:
        if "/" in token[0]:
            raise ValueError(f"{quoted(token[0])} is not a decimal number")
        number(token[0])
    except ValueError as wrong:
        raise error(source, line, token, str(wrong)) from None
    return token[0]


def error(source: str, line: int, token: Token, message: str) -> FileError:
    """Return an error whose message gives the line and column of a token."""
    return FileError(f"{source}: line {line}, column {token[1]}: {message}")
