"""Export a program as a job for one of two compilers of the 1960s: FORTRAN II-D under Monitor I, or PDQ FORTRAN.

A job is a folder of text files for the 1620 simulator of SIMH.  The folder contains no code of IBM's: the operator adds
the compiler.  The program is exported card by card.  The export changes a card only if the compiler does not accept the
card, and records each change in :attr:`Job.changes`.  The rules were found by running both compilers under Open SIMH.
"""

import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from typing import Literal

from emulator.errors import CardError, DeckError
from emulator.language.cards import RECORD_MARK, Card, Deck
from emulator.language.objectcode import Program
from emulator.language.parser import parse
from emulator.language.statements import LAST_COLUMN, Source, is_comment, sources, statement_columns

Compiler = Literal["fortran2d", "pdq"]

# The characters that the simulator's card reader translates (cdr_to_alp in i1620_cd.c).
READABLE = frozenset("0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ .)+$*-/,(=@|")

# Cards that the export adds have this identification in columns 73 to 80.
ADDED = "ADDED"

# The three instructions of the first card read the supervisor from the disk and branch to it.  The 5 in the third names
# the card reader.  The disk control field follows: drive, sector, number of sectors and address in core storage.
_COLD_START = ("34000360070136000360070249024025000011963611300102",)

# The utility DFINE of the supervisor records the machine: one disk drive, 60,000 positions, 8 and 4 digits.
_SIXTY_THOUSAND = (
    *_COLD_START,
    "||JOB 5                      60,000 POSITIONS",
    "||DUP",
    f"*DFINE{'1':>12}{'08 02 0 08 04 5 5   2 0':>41}",
    "||PAUS",
)

# PDQ's compiler stops at a jump from outside a DO to the last statement of the DO.  Program 2 has such a jump, to
# statement 184.  In the job the jump goes to 191, the statement after 184.
_FOR_PDQ = {"IF(E(I))112,184,180": "IF (E(I))112,191,180"}


@dataclass(frozen=True, slots=True)
class Change:
    """A source card that the export changed or added: its number (0 if added), the resulting cards, and the reason."""

    card: int
    texts: tuple[str, ...]
    reason: str


@dataclass(frozen=True, slots=True)
class Job:
    """A job for a compiler of the 1960s: the program as the compiler reads it, the data, and the changes made."""

    compiler: Compiler
    source: tuple[str, ...]
    data: tuple[str, ...]
    changes: tuple[Change, ...]

    def cards(self) -> Iterator[str]:
        """Yield the cards for FORTRAN II-D: a job that sets the size of core storage, and the job of the program."""
        for card in _SIXTY_THOUSAND, _COLD_START:
            yield from card
        yield "||JOB 5                      HULL1620"
        yield "||FORX5"
        yield "*FANDK0804"
        yield from self.source
        yield from self.data
        yield "||||"

    def script(self, switches: Collection[int]) -> str:
        """Return commands for the simulator SIMH.  ``switches`` are the sense switches that are on during the run."""
        lines = _monitor(switches) if self.compiler == "fortran2d" else _pdq(switches)
        return "".join(
            f"{line}\n" for line in (*lines, "! python3 check.py compare expected.cards punched.cards", "quit")
        )


def job(deck: Deck, program: Program, data: Deck, compiler: Compiler) -> Job:
    """Return a job that compiles the source ``deck`` and runs it with ``data``.

    Raise CardError if a statement is too long for the compiler, or a character cannot be read, and DeckError if the
    deck has no END.
    """
    statements = {source.cards[0].number: source for source in sources(deck)}
    end = next((number for number, source in statements.items() if source.kind == "end"), 0)
    if not end:
        raise DeckError(f"{deck.source}: expected an END card; found none")
    following = {card.number for source in statements.values() for card in source.cards[1:]}
    texts: list[str] = []
    changes: list[Change] = []
    cleared = False
    for card in deck.cards[: end + len(statements[end].cards) - 1]:
        if card.number in following:
            continue
        source = statements.get(card.number)
        if source and not cleared and source.kind not in ("dimension", "format"):
            added = tuple(clearing(program, {part.label for part in statements.values()}))
            changes += (
                [Change(0, added, "these cards set the arrays to zero, because the compiler does not")] if added else []
            )
            texts += added
            cleared = True
        cards, reason = _fitted(deck.source, card, source, compiler)
        changes += [Change(card.number, cards, reason)] if reason else []
        texts += cards
    return Job(compiler, tuple(texts), tuple(_image(data.source, card) for card in _data(deck, data)), tuple(changes))


def clearing(program: Program, labels: Collection[str]) -> Iterator[str]:
    """Yield cards that set all arrays of a program to zero.

    On the 1620, an array begins with the previous contents of the storage.  The results of the thesis's programs depend
    on these contents, because the programs read the element after the last point.
    """
    names = {entry.name for entry in program.storage.entries}
    free = (str(n) for n in range(9001, 9999) if str(n) not in labels)
    outer, inner = [name for name in (f"{letter}ZERO" for letter in "IJKLMN") if name not in names][:2]
    for array in program.storage.arrays():
        label, variables = next(free), (outer, inner)[: len(array.shape)]
        zero = "0" if array.name[0] in "IJKLMN" else "0."
        lines = [f"      DO {label} {v}=1,{size}" for v, size in zip(variables, array.shape, strict=True) if size > 1]
        subscripts = [v if size > 1 else "1" for v, size in zip(variables, array.shape, strict=True)]
        lines.append(f" {label if lines else '':>4} {array.name}({','.join(subscripts)})={zero}")
        yield from (f"{line:<72}{ADDED}" for line in lines)


def _data(deck: Deck, data: Deck) -> tuple[Card, ...]:
    return parse(deck).data or data.cards


def _fitted(name: str, card: Card, source: Source | None, compiler: Compiler) -> tuple[tuple[str, ...], str]:
    """Return a statement or comment as cards that the compiler accepts, and the reason for a change, or ""."""
    if source is None or is_comment(card):
        text = "".join(c if c.upper() in READABLE else " " for c in card.text).rstrip()
        return (text,), "" if text == card.text else "the simulator reads only characters of the card code"
    images = tuple(_image(name, part) for part in source.cards)
    if compiler == "pdq":
        if source.text in _FOR_PDQ:
            reason = "PDQ's compiler stops at a jump to statement 184 from outside the DO that ends with it"
            return (f"{source.label:>5} {_FOR_PDQ[source.text]}",), reason
        if len(source.cards) == 1:
            return images, ""
        text = source.label + source.text.rstrip()
        if len(text) > LAST_COLUMN:
            raise CardError(
                name, card.number, 1, f"PDQ FORTRAN has no continuation cards; the statement has {len(text)} characters"
            )
        return (text,), "PDQ FORTRAN has no continuation cards"
    first, *rest = source.cards
    if re.match(r"[ \d]{5}[ 0]", first.text.ljust(6)) and all(re.match(r" {5}[^ 0]", part.text) for part in rest):
        return images, ""
    # Put the number into columns 1 to 5 and the statement into columns 7 to 72 of as many cards as it needs.
    columns = statement_columns(first) + "".join(statement_columns(part, 7) for part in rest)
    parts = re.fullmatch(r"([ \d]*)(.*)", columns, re.DOTALL)
    assert parts is not None
    text, width = parts[2].rstrip(), LAST_COLUMN - 6
    pieces = [text[at : at + width].rstrip() for at in range(0, len(text), width)]
    heads = [f"{parts[1].replace(' ', ''):>5} ", *(f"     {n}" for n in range(1, len(pieces)))]
    cards = tuple(head + piece for head, piece in zip(heads, pieces, strict=True))
    return cards, "the number belongs in columns 1 to 5 and the statement in columns 7 to 72"


def _image(name: str, card: Card) -> str:
    """Return a card's text in the characters of the simulator.  Raise CardError if the simulator lacks a character."""
    text = RECORD_MARK.sub("|", card.text).replace("'", "@")
    for column, char in enumerate(text, 1):
        if char not in READABLE:
            raise CardError(name, card.number, column, f"the simulator cannot read {char!r}")
    return text


def _switches(on: Collection[int]) -> list[str]:
    return [f"deposit sw{number} {int(number in on)}" for number in (1, 2, 3, 4)]


# The disk of the 1620 stops at the end of a cylinder and sets the indicators "cylinder overflow" and "any check".  SIMH
# does not set "any check", so that the supervisor would not read the rest of the data.  These commands therefore let
# the simulator continue after the instruction that tests "any check": one in the supervisor, one in the loader.
_OVERFLOW = (
    ":next",
    "if dp cylo==0 goto done",
    "if pc==2020 deposit pc 2080",
    "if pc==958 deposit pc 982",
    "continue",
    "goto next",
    ":done",
)


def _monitor(switches: Collection[int]) -> list[str]:
    return [
        "; FORTRAN II-D under Monitor I.  monitor.pack is the disk of Monitor I, as README.txt says.",
        "! python3 check.py disk monitor.pack monitor.dsk",
        "set cpu 60K",
        "deposit arstop 0",
        *_switches(switches),
        *(f"set dp{drive} disabled" for drive in (1, 2, 3)),
        "attach dp0 monitor.dsk",
        "attach -n lpt printed.txt",
        "attach cdr job.cards",
        "attach -n cdp punched.cards",
        "boot cdr",
        "boot cdr",
        *_OVERFLOW,
        "detach all",
    ]


def _pdq(switches: Collection[int]) -> list[str]:
    return [
        "; PDQ FORTRAN.  pdq.txt is the compiler and pdq-fixed.txt its subroutines, as README.txt says.",
        "! python3 check.py join compile.cards pdq.txt program.cards pdq-fixed.txt",
        "set cpu 40K",
        "deposit arstop 0",
        *_switches((2, 4)),
        "attach cdr compile.cards",
        "attach -n cdp object.cards",
        "boot cdr",
        "continue",
        "detach all",
        "! python3 check.py join run.cards object.cards data.cards",
        *_switches(switches),
        "attach cdr run.cards",
        "attach -n cdp punched.cards",
        "boot cdr",
        "detach all",
    ]
