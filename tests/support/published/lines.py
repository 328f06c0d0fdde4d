"""A reader of the published vectors, written from the description of their format in the README alone."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

from tests.support.paths import PUBLISHED

SUFFIX = ".vectors"
_TOKEN = re.compile(r"'[^']*'|\S+")


@dataclass(frozen=True)
class Vector:
    """A line: operands and result as text, the columns of a card without their quotes."""

    id: str
    operation: str
    operands: tuple[str, ...]
    result: str
    code: str
    profile: str
    digits: int
    kind: str


def names() -> list[str]:
    """Return the operations that have a file."""
    return sorted(path.stem for path in PUBLISHED.glob(f"*{SUFFIX}"))


@cache
def load(operation: str) -> tuple[Vector, ...]:
    """Return the vectors of an operation's file."""
    return tuple(parsed((PUBLISHED / (operation + SUFFIX)).read_text(encoding="ascii")))


def parsed(text: str) -> Iterator[Vector]:
    """Yield the vectors of a file's text.  Raise ValueError with the line number if a line is invalid."""
    header: dict[str, str] = {}
    ids: set[str] = set()
    for row, line in enumerate(text.splitlines(), 1):
        if not line or line.startswith("--"):
            continue
        word, colon, value = line.partition(": ")
        if colon and word in ("version", "profile", "digits", "class"):
            header[word] = value
            continue
        tokens = [token.strip("'") for token in _TOKEN.findall(line)]
        arrow = tokens.index("->") if "->" in tokens else 0
        if arrow < 3 or len(tokens) - arrow not in (2, 3) or tokens[0] in ids or len(header) < 4:
            raise ValueError(f"line {row}: {line!r} is not a vector")
        ids.add(tokens[0])
        code = tokens[arrow + 2] if len(tokens) - arrow == 3 else ""
        digits = 0 if header["digits"] == "any" else int(header["digits"])
        section = (header["profile"], digits, header["class"])
        yield Vector(tokens[0], tokens[1], tuple(tokens[2:arrow]), tokens[arrow + 1], code, *section)
