"""What can go wrong outside the machine: every error is one line that names file, card and column."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache


class EmulatorError(Exception):
    """Base of all errors raised for bad input; ``str`` is one line fit to be shown to a user."""


class FileError(EmulatorError):
    """A file, or standard input or output, that cannot be read or written, or whose text is not of its format."""


class CardError(EmulatorError):
    """A card that cannot be read: a character outside the code, too many columns, a field that holds no number.

    ``unit`` is what the source is made of: cards, or lines typed.
    """

    def __init__(self, source: str, card: int, column: int, message: str, unit: str = "card") -> None:
        where = f"{source}: {unit} {card}" + (f", column {column}" if column else "")
        super().__init__(f"{where}: {message}")
        self.source, self.card, self.column = source, card, column


class LowerCaseError(CardError):
    """A small letter on a card.  A source program can be read with capitals (emulator/language/statements.py)."""


class DeckError(EmulatorError):
    """A deck that cannot be used as a whole: empty, too long or too short."""


class OperatorError(EmulatorError):
    """What an operator's file says and the run, as it stands, cannot take."""


@dataclass(frozen=True, slots=True, order=True)
class Place:
    """A place in the source deck: card number and column, both from 1."""

    card: int
    column: int


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """A message of the compiler: ``number`` is IBM's error type where one is known (C26-5619 p. 56), else 0.

    ``about``: a name or a statement of another FORTRAN, of which a deck's messages speak once (:func:`said_once`).
    """

    card: int
    column: int
    message: str
    number: int = 0
    warning: bool = False
    about: str = ""

    def line(self, source: str) -> str:
        kind = "warning" if self.warning else ("error" if not self.number else f"error {self.number}")
        where = f"card {self.card}" + (f", column {self.column}" if self.column else "")
        return f"{source}: {where}: {kind}: {self.message}"


def said_once(diagnostics: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """The messages in order of cards; of those about one thing the first, with the cards of the others."""
    ordered = sorted(dict.fromkeys(diagnostics), key=lambda d: (d.card, d.column))
    cards: dict[str, list[int]] = {}
    for message in ordered:
        if message.about:
            cards.setdefault(message.about, []).append(message.card)
    for message in ordered:
        if not message.about:
            yield message
        elif also := list(dict.fromkeys(cards.pop(message.about, ()))):
            more = also[1:]
            yield replace(message, message=message.message + _also(more)) if more else message


def _also(cards: list[int]) -> str:
    shown = ", ".join(map(str, cards[:4])) + (f" and {len(cards) - 4} more" if len(cards) > 4 else "")
    return f" (also on card{'s' * (len(cards) > 1)} {shown})"


class Refused(Exception):
    """A statement or a specification the compiler refuses, while it is being read; it goes on with the next statement.

    ``number`` and ``about`` are as of :class:`Diagnostic`.
    """

    def __init__(self, place: Place, message: str, number: int = 0, about: str = "") -> None:
        super().__init__(message)
        self.diagnostic = Diagnostic(place.card, place.column, message, number, about=about)


class CompileError(EmulatorError):
    """A source deck that does not compile; ``diagnostics`` holds every message, ``str`` the first."""

    def __init__(self, source: str, diagnostics: Iterable[Diagnostic]) -> None:
        self.source = source
        self.diagnostics = tuple(diagnostics)
        errors = [d for d in self.diagnostics if not d.warning]
        more = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
        super().__init__(errors[0].line(source) + more)


@dataclass(frozen=True, slots=True)
class Explanation:
    """What an error number of the compiler (``5``) or an error code of the machine (``E3``) means.

    ``example``: cards that give it when compiled or run.  ``source``: manual and page, or what was executed.
    """

    title: str
    meaning: str
    example: tuple[str, ...]
    mend: str
    source: str


@cache
def explanations() -> Mapping[str, Explanation]:
    """Every error number and code with its explanation: 5 to 13 (C26-5619 p. 56), E1 to E8, F1 to F6, F8."""
    # Imported here, for every command begins with this module and few explain.
    import tomllib
    from importlib.resources import files

    text = files("emulator").joinpath("explanations.toml").read_text(encoding="utf-8")
    rows = tomllib.loads(text).items()
    return {number: Explanation(**{**row, "example": tuple(row["example"])}) for number, row in rows}
