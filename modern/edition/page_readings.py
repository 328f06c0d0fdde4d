"""Read a completed proof sheet, and write a state of the edition that includes the answers.

A *state* is a folder with a changed copy of the data in ``fortran_src``: the apparatus, the decks, and
``readings.csv``, which holds all answers so far.  The installed package is never changed.  A maintainer compares the
state with the repository and merges it.
"""

from __future__ import annotations

import csv
import re
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import astuple, fields, replace
from importlib.resources.abc import Traversable
from io import StringIO
from pathlib import Path

from emulator.errors import EmulatorError, FileError
from emulator.files import reason
from emulator.language.cards import deck_from_lines
from emulator.language.compiler import compile_deck
from modern.edition import programs
from modern.edition import sources as provenance
from modern.edition.apparatus import ApparatusError, Line, Text, build, load
from modern.edition.page_answers import COLUMNS, DATE, READER, READINGS, Reading, stored_readings
from modern.edition.sheets import Item, Question, sheets
from modern.formats.columns import csv_text

UNREADABLE = "?"


def read_sheet(name: str, text: str) -> tuple[Reading, ...]:
    """Return the answers of a filled sheet: a CSV table with the columns ``COLUMNS``.

    An answer is the letter of a choice, ``?`` if the page cannot be read, or ``=`` followed by the card as the page has
    it.  Rows without an answer are skipped.  Raise FileError, which names the row, for the first fault.
    """
    rows = csv.reader(StringIO(text, newline=""))
    head = next(rows, [])
    if tuple(head[: len(COLUMNS)]) != COLUMNS:
        raise FileError(f"{name}: row 1: expected the columns {', '.join(COLUMNS)}")
    items: dict[str, tuple[str, Item | Question]] = {}
    for sheet in sheets():
        items |= {item.id: (sheet.page, item) for item in sheet.items}
        items |= {question.id: (sheet.page, question) for question in sheet.questions}
    answers: dict[str, tuple[int, str]] = {}
    for number, row in enumerate(rows, 2):
        key, answer = (row[0].strip(), row[5].strip() if len(row) > 5 else "") if row else ("", "")
        if not answer:
            continue
        if key not in items and key not in (READER, DATE):
            raise FileError(f"{name}: row {number}: no sheet has the item {key!r}")
        if key in answers:
            raise FileError(f"{name}: row {number}: item {key} is answered twice, first in row {answers[key][0]}")
        answers[key] = (number, answer)
    _, reader = answers.pop(READER, (0, ""))
    line, day = answers.pop(DATE, (0, ""))
    if answers and not reader:
        raise FileError(f"{name}: the row {READER} needs the name of the person who read the page")
    if answers and not re.fullmatch(r"\d{4}-\d\d-\d\d", day):
        raise FileError(f"{name}: row {line or '(none)'}: expected a date such as 2027-03-31, found {day!r}")
    if not answers:
        raise FileError(f"{name}: no row has an answer")
    return tuple(
        _answered(f"{name}: row {number}", *items[key], answer, reader, day)
        for key, (number, answer) in answers.items()
    )


def _answered(place: str, page: str, entry: Item | Question, answer: str, reader: str, day: str) -> Reading:
    """Return the answer to an item or a question.  The message of a FileError begins with ``place``."""
    program = entry.program if isinstance(entry, Item) else ""
    result = Reading(entry.id, page, program, "unreadable", answer, "", "", "", reader, day)
    choice = next((choice for choice in entry.choices if choice.letter == answer.upper()), None)
    if answer == UNREADABLE:
        return result
    if choice is None and not answer.startswith("="):
        letters = ", ".join(choice.letter for choice in entry.choices)
        raise FileError(
            f"{place}: expected {letters}, {UNREADABLE}, or = followed by the text of the page, found {answer!r}"
        )
    if isinstance(entry, Question):
        settled = " ".join(entry.rows) if choice == entry.choices[0] else ""
        return replace(result, outcome="answered", answer=choice.token if choice else answer[1:], rows=settled)
    if choice == entry.choices[0]:
        return replace(result, outcome="confirmed", card=entry.text)
    card = choice.card if choice else answer[1:].rstrip()
    if card.strip() == entry.text.strip():
        # The page has the card as restored, so all rows that changed the card are right.
        text = programs.text(program)
        line = build(text, programs.built_in(program).layers)[entry.card - 1]
        rows = (row for row in line.rows if not any(change.form for change in text.row(row).changes))
        return replace(result, outcome="confirmed", card=entry.text, rows=" ".join(rows))
    if choice and not card:
        raise FileError(
            f"{place}: the page does not have this card, but a proof sheet cannot remove it; write to the maintainers"
        )
    try:
        deck_from_lines(place, [card])
    except EmulatorError as error:
        raise FileError(str(error)) from None
    return replace(result, outcome="changed", card=card)


def write_state(folder: str, readings: Sequence[Reading]) -> tuple[Reading, ...]:
    """Write a state of the edition that includes the readings to ``folder``, and return all readings of the state.

    If the folder is a state already, the readings are added to it.  The folder is replaced as a whole.  Raise FileError
    if the folder holds other files, or if an item is already answered, and ApparatusError if a row does not fit.
    """
    target = Path(folder)
    base = target / "fortran_src" if (target / "fortran_src" / READINGS).is_file() else None
    if base is None and target.exists() and (not target.is_dir() or any(target.iterdir())):
        raise FileError(f"{folder}: expected a new folder or a state of the edition; it holds other files")
    earlier = stored_readings((base / READINGS).read_text(encoding="utf-8")) if base else ()
    for known in earlier:
        if any(known.item == reading.item for reading in readings):
            raise FileError(f"{folder}: item {known.item} was already answered by {known.reader} on {known.date}")
    changed = [reading for reading in (*earlier, *readings) if reading.outcome == "changed"]
    for number, reading in enumerate(changed):
        if first := next((r for r in changed[:number] if r.item[:5] == reading.item[:5]), None):
            raise FileError(
                f"items {first.item} and {reading.item} change the same card; answer one with = and the whole card"
            )
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".state-", dir=target.parent) as room:
            new = Path(room) / "new"
            _copy(base or programs.sources(), new / "fortran_src")
            stored = (*earlier, *_applied(new / "fortran_src", readings))
            table = csv_text(([field.name for field in fields(Reading)], *map(astuple, stored)))
            (new / "fortran_src" / READINGS).write_text(table, encoding="utf-8")
            if target.exists():
                target.rename(Path(room) / "before")
            new.rename(target)
    except OSError as error:
        raise FileError(f"{folder}: {reason(error)}") from None
    return stored


def _copy(source: Traversable, target: Path) -> None:
    target.mkdir(parents=True)
    for entry in source.iterdir():
        if entry.is_file():
            (target / entry.name).write_bytes(entry.read_bytes())
        elif entry.name != "__pycache__":
            _copy(entry, target / entry.name)


def _applied(data: Path, readings: Sequence[Reading]) -> Iterator[Reading]:
    """Add a row to the apparatus in ``data`` for each changed card, and build the decks again.

    Yield all readings; a reading for which a row was added has the id of this row.
    """
    for reading in readings:
        if reading.outcome != "changed":
            yield reading
            continue
        text = load(data, reading.program)
        line = _line_of(text, reading)
        row = f"P{reading.program[-1]}-{1 + max(int(row.id.partition('-')[2]) for row in text.rows):03}"
        path = data / "apparatus" / f"{reading.program}.toml"
        path.write_text(path.read_text(encoding="utf-8") + _row(row, line, reading), encoding="utf-8")
        yield replace(reading, row=row)
    _rebuild(data)


def _line_of(text: Text, reading: Reading) -> Line:
    """Return the line of a card, with the layer ``ocr`` applied.  Raise ApparatusError if later layers change it."""
    number = int(reading.item.split("-")[1])
    final = build(text, programs.built_in(text.id).layers)[number - 1]
    for line in build(text, ("ocr",)):
        if line.id == final.id and line.text == final.text:
            return line
    raise ApparatusError(
        f"item {reading.item}: other emendations change this card ({', '.join(final.rows)}); write to the maintainers"
    )


def _row(row: str, line: Line, reading: Reading) -> str:
    def quoted(text: str) -> str:
        return f"'{text}'" if "'" not in text else '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'

    return f"""
[[row]]
id = '{row}'
layer = 'ocr'
kind = 'page'
reason = 'The page has another reading than the OCR text.'
evidence = {quoted(f"Page {reading.page}, read by {reading.reader}.")}
editor = {quoted(reading.reader)}
date = {reading.date}
ground = {{ kind = 'page' }}
[[row.change]]
line = '{line.id}'
witness = {quoted(line.text)}
lemma = {quoted(reading.card)}
"""


def _rebuild(data: Path) -> None:
    """Write the decks of ``data`` again from witness and apparatus, and the hashes of the optional layers."""
    texts = {name: load(data, name) for name in programs.TEXTS}
    for entry in programs.BUILT_INS:
        cards = "".join(f"{line.text}\n" for line in build(texts[entry.text], entry.layers))
        compile_deck(deck_from_lines(f"{entry.name}.f", cards.splitlines()))
        (data / f"{entry.name}.f").write_text(cards, encoding="ascii")
    path = data / "SOURCES.toml"
    table = path.read_text(encoding="utf-8")
    for name, layer, sha in provenance.sources().layered:
        entry = programs.built_in(name)
        cards = "".join(f"{line.text}\n" for line in build(texts[entry.text], (*entry.layers, layer)))
        table = table.replace(sha, provenance.digest(cards))
    path.write_text(table, encoding="utf-8")
