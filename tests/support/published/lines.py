"""The lines of the published vectors, read as their README describes them, by nothing but that description."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

from tests.support.paths import PUBLISHED

SUFFIX = ".vectors"
_TOKEN = re.compile(r"'[^']*'|\S+")


@dataclass(frozen=True)
class Vector:
    """One line: operands and result as they stand there, the columns of a card without their quotes."""

    id: str
    operation: str
    operands: tuple[str, ...]
    result: str
    code: str
    profile: str
    digits: int
    kind: str


def names() -> list[str]:
    """The operations there is a file for."""
    return sorted(path.stem for path in PUBLISHED.glob(f"*{SUFFIX}"))


@cache
def load(operation: str) -> tuple[Vector, ...]:
    """The vectors of an operation's file."""
    return tuple(parsed((PUBLISHED / (operation + SUFFIX)).read_text(encoding="ascii")))


def parsed(text: str) -> Iterator[Vector]:
    """The vectors of a file's text.  Raises ValueError with the line's number for a line that is no vector."""
    said: dict[str, str] = {}
    seen: set[str] = set()
    for row, line in enumerate(text.splitlines(), 1):
        if not line or line.startswith("--"):
            continue
        word, colon, value = line.partition(": ")
        if colon and word in ("version", "profile", "digits", "class"):
            said[word] = value
            continue
        tokens = [token.strip("'") for token in _TOKEN.findall(line)]
        arrow = tokens.index("->") if "->" in tokens else 0
        if arrow < 3 or len(tokens) - arrow not in (2, 3) or tokens[0] in seen or len(said) < 4:
            raise ValueError(f"line {row}: {line!r} is not a vector")
        seen.add(tokens[0])
        code = tokens[arrow + 2] if len(tokens) - arrow == 3 else ""
        digits = 0 if said["digits"] == "any" else int(said["digits"])
        what = (said["profile"], digits, said["class"])
        yield Vector(tokens[0], tokens[1], tuple(tokens[2:arrow]), tokens[arrow + 1], code, *what)
