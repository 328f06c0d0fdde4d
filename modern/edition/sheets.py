"""Proof sheets: for each page of the thesis, questions about the readings that only the printed page can decide.

A *silent reading* is an altered card that no check detects (``fortran_src/silent.csv``, written by
:mod:`modern.edition.weight`).  An :class:`Item` asks which token is printed at one place of a card.  The choices of the
item are the restored token and the silent readings of this token.  Each silent reading and each open question about the
text (``fortran_src/questions.toml``) is on exactly one sheet.  :mod:`modern.edition.page_readings` reads a filled
sheet.
"""

from __future__ import annotations

import csv
import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from string import ascii_uppercase

from emulator.language.cards import Card
from modern.edition import programs
from modern.edition.apparatus import build
from modern.edition.edits import common_prefix
from modern.edition.variants import Statement, statements

LETTERS = (*ascii_uppercase, *(a + b for a in ascii_uppercase for b in ascii_uppercase))

DEPENDS: Mapping[str, str] = {
    "number": "to which other statement the card refers, in a case that no printed example shows",
    "name": "which number the card uses, in a case that no printed example shows",
    "operator": "how the card calculates, in a case that no printed example shows",
    "constant": "a number or the size of a table, in a case that no printed example shows",
    "character": "a letter of a name or message; the printed results are the same either way",
    "format": "the layout of a line or card that no printed example shows",
    "card": "whether the card exists; the printed results are the same without it",
}


@dataclass(frozen=True, slots=True)
class Choice:
    """A possible answer: its letter on the sheet, the text of the token, and the whole card with this token.

    If the choice is that the card does not exist, token and card are empty.
    """

    letter: str
    token: str
    card: str


@dataclass(frozen=True, slots=True)
class Item:
    """A question about one token of a card.

    ``first`` is the first column of the token, counted from 0, and ``last`` is the column after the token.  ``how`` is
    the kind of the alteration, as in :class:`modern.edition.variants.Variant`.  The first choice is the restored
    reading.  ``variants`` has the keys of the silent readings, which are the other choices.
    """

    id: str
    program: str
    card: int
    how: str
    text: str
    first: int
    last: int
    choices: tuple[Choice, ...]
    variants: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Question:
    """An open question about the text of a page.

    ``depends`` is a sentence on what depends on the answer.  If the answer is the first choice, the readings of the
    rows in ``rows`` become certain.
    """

    id: str
    page: str
    ask: str
    choices: tuple[Choice, ...]
    depends: str
    rows: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Sheet:
    """The proof sheet of a page of the thesis: the cards on the page, the items and the questions about it."""

    page: str
    program: str
    cards: tuple[Card, ...]
    items: tuple[Item, ...]
    questions: tuple[Question, ...]


def sheets(answered: Iterable[str] = ()) -> tuple[Sheet, ...]:
    """Return a sheet for each page with unanswered items or questions.

    ``answered`` has the ids of the answered items and questions.
    """
    done = set(answered)
    by_page: dict[tuple[str, str], tuple[list[Card], list[Item]]] = {}
    for name in programs.TEXTS:
        own = _items(name)
        for card, page in pages(name):
            cards, items = by_page.setdefault((page, name), ([], []))
            cards.append(card)
            items += (item for item in own.get(card.number, ()) if item.id not in done)
    open_questions = [question for question in questions() if question.id not in done]
    for question in open_questions:
        if not any(page == question.page for page, _ in by_page):
            by_page[question.page, ""] = ([], [])
    result = []
    for (page, name), (cards, items) in by_page.items():
        asked = tuple(question for question in open_questions if question.page == page)
        if items or asked:
            result.append(Sheet(page, name, tuple(cards), tuple(items), asked))
    return tuple(sorted(result, key=lambda sheet: int(sheet.page)))


def pages(name: str) -> Iterator[tuple[Card, str]]:
    """Yield each card of a program with its page of the thesis."""
    lines = build(programs.text(name), programs.built_in(name).layers)
    return ((Card(number, line.text), line.page) for number, line in enumerate(lines, 1))


def questions() -> tuple[Question, ...]:
    """Return the open questions about the text."""
    data = tomllib.loads(programs.sources().joinpath("questions.toml").read_text(encoding="utf-8"))
    return tuple(
        Question(
            f"Q{raw['number']}",
            raw["page"],
            raw["ask"],
            tuple(Choice(letter, answer, "") for letter, answer in zip(LETTERS, raw["answers"], strict=False)),
            raw["depends"],
            tuple(raw["rows"]),
        )
        for raw in data["question"]
    )


def silent_readings() -> list[dict[str, str]]:
    """Return the silent readings, which are the rows of ``fortran_src/silent.csv``."""
    text = programs.sources().joinpath("silent.csv").read_text(encoding="utf-8")
    return list(csv.DictReader(text.splitlines()))


def _items(name: str) -> dict[int, list[Item]]:
    """Return the items of a program by the number of the card.  Silent readings of the same token share an item."""
    by_card = {statement.card: statement for statement in statements(name)}
    tokens: dict[tuple[int, int, int], list[tuple[str, str, str]]] = {}
    for row in silent_readings():
        if row["program"] != name:
            continue
        card, was, reads = int(row["card"]), row["was"], row["reads"]
        if by_card[card].source.text != was:
            continue  # The page has another card than the one that was weighed.
        columns = [place.column for place in by_card[card].source.places]
        first, last, token = _altered_token(was, reads, columns) if reads else (0, len(was), "")
        tokens.setdefault((card, first, last), []).append((row["how"], token, reads))
    result: dict[int, list[Item]] = {}
    for (card, first, last), rivals in sorted(tokens.items()):
        items = result.setdefault(card, [])
        number = f"{name[-1]}-{card:03}-{len(items) + 1}"
        items.append(_item(number, name, by_card[card], first, last, rivals))
    return result


def _item(
    number: str, name: str, statement: Statement, first: int, last: int, rivals: list[tuple[str, str, str]]
) -> Item:
    card, source = statement.source.cards[0], statement.source
    # Translate positions in the statement, which has no blanks, to columns of the card.
    start, end = source.places[first].column - 1, source.places[last - 1].column
    whole = card.text.rstrip()
    choices = [Choice("A", whole[start:end], whole)]
    for letter, (_, token, reads) in zip(LETTERS[1:], rivals, strict=False):
        choices.append(Choice(letter, token, whole[:start] + token + whole[end:] if reads else ""))
    keys = tuple(f"{name} {card.number} {reads}" for _, _, reads in rivals)
    return Item(number, name, card.number, rivals[0][0], whole, start, end, tuple(choices), keys)


def _altered_token(was: str, reads: str, columns: Sequence[int]) -> tuple[int, int, str]:
    """Return the token that differs between two readings of a card: its first character, its end, and its altered text.

    A token is a run of letters and digits between which the card has no blank.  ``columns`` has the column of each
    character on the card.
    """
    first = common_prefix(was, reads)
    last = len(was) - min(common_prefix(was[::-1], reads[::-1]), len(was) - first, len(reads) - first)
    while first > 0 and was[first - 1].isalnum() and columns[first - 1] + 1 == columns[min(first, len(columns) - 1)]:
        first -= 1
    while last < len(was) and was[last].isalnum() and columns[last - 1] + 1 == columns[last]:
        last += 1
    if first == last:  # Only characters were added after a special character: include that character.
        first -= 1
    return first, last, reads[first : len(reads) - len(was) + last]
