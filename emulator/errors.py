"""The errors that bad input raises.  A message is one line, which names file, card and column if these are known."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache

_SHOWN = 40


def quoted(value: object) -> str:
    """Return a text or another value of the input in quotation marks for a message, truncated to 40 characters."""
    text = value if isinstance(value, str) else repr(value)
    short = text if len(text) <= _SHOWN else text[:_SHOWN] + "..."
    return repr(short) if isinstance(value, str) else short


class EmulatorError(Exception):
    """The base class of all errors raised for bad input.  ``str`` is a one-line message for the user."""


class ArgumentError(EmulatorError, ValueError):
    """Raised if an argument of a function is invalid."""


def expect(value: object, kind: type | tuple[type, ...], name: str) -> None:
    """Raise ArgumentError if ``value``, the argument called ``name``, has none of the given types."""
    if not isinstance(value, kind):
        kinds = kind if isinstance(kind, tuple) else (kind,)
        expected = " or ".join(each.__name__ for each in kinds)
        raise ArgumentError(f"{name}: expected {expected}, found {type(value).__name__}")


class FileError(EmulatorError):
    """Raised if a file, standard input or standard output cannot be read or written, or has invalid contents."""


class CardError(EmulatorError):
    """Raised for an invalid card: a character that no card can hold, too many columns, or a field without a number.

    ``unit`` is the name by which messages call a line of the source, such as ``card`` or ``line``.
    """

    def __init__(self, source: str, card: int, column: int, message: str, unit: str = "card") -> None:
        where = f"{source}: {unit} {card}" + (f", column {column}" if column else "")
        super().__init__(f"{where}: {message}")
        self.source, self.card, self.column = source, card, column


class LowerCaseError(CardError):
    """Raised for a lower-case letter on a card.

    ``capitals`` in emulator/language/statements.py converts a program to capitals.
    """


class DeckError(EmulatorError):
    """Raised for a deck of cards that is invalid as a whole: empty, too long or too short."""


class OperatorError(EmulatorError):
    """Raised for an action in an operator's file that is impossible in the current state of the run."""


@dataclass(frozen=True, slots=True, order=True)
class Place:
    """A place in the source deck: card number and column, both counted from 1."""

    card: int
    column: int


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """A message of the compiler.

    ``number`` is IBM's error type (C26-5619 p. 56), or 0.  ``about`` is the subject of the message, for example a name
    in the program, or a kind of statement that only another FORTRAN has.  :func:`merge_repeated` merges messages with
    the same subject.
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


def merge_repeated(diagnostics: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """Yield the messages in the order of their cards, and merge messages with the same subject.

    A merged message lists the cards of all its messages.
    """
    ordered = sorted(dict.fromkeys(diagnostics), key=lambda d: (d.card, d.column))
    cards: dict[str, list[int]] = {}
    for message in ordered:
        if message.about:
            cards.setdefault(message.about, []).append(message.card)
    for message in ordered:
        if not message.about:
            yield message
        elif message.about in cards:
            _, *others = dict.fromkeys(cards.pop(message.about))
            more = f" and {len(others) - 4} more" if len(others) > 4 else ""
            also = f" (also on card{'s' * (len(others) > 1)} {', '.join(map(str, others[:4]))}{more})"
            yield replace(message, message=message.message + also) if others else message


class Refused(Exception):
    """Raised for a statement or FORMAT that the compiler rejects.  The compiler then continues with the next statement.

    ``number`` and ``about`` have the same meaning as in :class:`Diagnostic`.
    """

    def __init__(self, place: Place, message: str, number: int = 0, about: str = "") -> None:
        super().__init__(message)
        self.diagnostic = Diagnostic(place.card, place.column, message, number, about=about)


class CompileError(EmulatorError):
    """Raised for a program with errors.

    ``diagnostics`` holds all messages of the compiler.  ``str`` is the first error and the number of further errors.
    """

    def __init__(self, source: str, diagnostics: Iterable[Diagnostic]) -> None:
        self.source = source
        self.diagnostics = tuple(diagnostics)
        errors = [d for d in self.diagnostics if not d.warning]
        more = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
        super().__init__(errors[0].line(source) + more)


@dataclass(frozen=True, slots=True)
class Explanation:
    """An explanation of an error type of the compiler (``5``) or an error code of the machine (``E3``).

    ``example`` is a deck that produces the error.  ``remedy`` says how to correct the error.  ``source`` is the source
    of the explanation: a page of a manual, or a program of IBM that was executed.
    """

    title: str
    meaning: str
    example: tuple[str, ...]
    remedy: str
    source: str


@cache
def explanations() -> Mapping[str, Explanation]:
    """Return the explanations of the error types 5 to 13 of the compiler and the codes E1 to E8, F1 to F9 of a run."""
    # These imports are inside the function because every command loads this module, but few commands need explanations.
    import tomllib
    from importlib.resources import files

    text = files("emulator").joinpath("explanations.toml").read_text(encoding="utf-8")
    rows = tomllib.loads(text).items()
    return {number: Explanation(**{**row, "example": tuple(row["example"])}) for number, row in rows}
