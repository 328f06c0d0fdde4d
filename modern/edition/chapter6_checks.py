"""Checks of the chapter 6 transcript as a whole; each returns its faults, one clear line a fault.

* :func:`check_tie`        every character of the cards is a character of the print, in order, and all lines are used;
* :func:`check_rows`       every row stands on its ground, and none is superfluous;
* :func:`check_layout`     columns, blank cards and words of the cards are those of the FORMAT statements;
* :func:`check_arithmetic` the printed numbers agree among themselves;
* :func:`check_files`      the committed device files are what witness, apparatus and layout give.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from decimal import Decimal
from importlib.resources.abc import Traversable

from emulator.errors import Refused
from emulator.language.formats import Literal, Slash, parse_format
from emulator.language.tree import Format, Place
from modern.edition.chapter6 import CardShape, DeviceLayout, Field, Role, chapter6_folder
from modern.edition.chapter6_cards import (
    Chapter,
    built_files,
    cards,
    device_files,
    printed_lines,
)
from modern.edition.chapter6_grounds import (
    incidences,
    numbers,
    of_role,
    plane_at,
    planes,
    row_faults,
    solid,
    vertices,
)

Point = tuple[Decimal, ...]


def check_chapter(chapter: Chapter, folder: Traversable | None = None) -> tuple[str, ...]:
    """Every check of this module on one chapter; no faults is an empty tuple."""
    at = folder or chapter6_folder()
    return (
        *check_tie(chapter),
        *check_rows(chapter),
        *check_layout(chapter),
        *check_arithmetic(chapter),
        *check_files(chapter, at),
    )


def check_tie(chapter: Chapter) -> tuple[str, ...]:
    """The cards' characters are those of the corrected print, and each printed line is a card's or a heading."""
    faults: list[str] = []
    used: list[str] = list(chapter.layout.headings)
    for entry in chapter.layout.devices:
        if entry.span is None:
            continue
        lines = printed_lines(chapter, entry)
        used += [line.id for line in lines]
        images = [card.image for card in cards(chapter, entry.example, entry.program, entry.device)]
        if solid("".join(images)) != solid("".join(line.text for line in lines)):
            faults.append(f"{entry.file}: the characters of its cards are not those of its printed lines")
    known = [line.id for line in chapter.print]
    faults += [f"line {i} of the corrected print belongs to no card and no heading" for i in known if i not in used]
    faults += [f"line {i} is used twice" for i in sorted(set(used)) if used.count(i) > 1]
    faults += [f"heading line {i} is not in the corrected print" for i in used if i not in known]
    return tuple(faults)


def check_rows(chapter: Chapter) -> tuple[str, ...]:
    """Every row of the apparatus stands on its ground (:mod:`modern.edition.chapter6_grounds`)."""
    return tuple(fault for row in chapter.text.rows for fault in row_faults(chapter, row))


def check_layout(chapter: Chapter) -> tuple[str, ...]:
    """Cards have their FORMAT's columns, device files use whole FORMATs, printed words are the FORMATs'."""
    faults: list[str] = []
    words: dict[str, list[str]] = {}
    texts = {(f.program, f.number): f.text for f in chapter.layout.formats}
    sizes: dict[tuple[int, int, int], int] = {}
    for shape in chapter.layout.cards:
        try:
            given = records(texts[shape.program, shape.format], shape.values)
        except KeyError:
            faults.append(f"card {shape.id}: the layout has no FORMAT {shape.format} of program {shape.program}")
            continue
        except Refused as error:
            faults.append(f"card {shape.id}: {error}")
            continue
        sizes[shape.program, shape.format, shape.values] = len(given)
        wanted = given[shape.record - 1] if 0 < shape.record <= len(given) else None
        if wanted is None or tuple(field for field, _ in wanted) != shape.fields:
            faults.append(f"card {shape.id}: its columns are not those of FORMAT {shape.format}")
            continue
        words[shape.id] = [text for _, text in wanted]
    for entry in chapter.layout.devices:
        faults += _whole_formats(entry, sizes)
        for card in cards(chapter, entry.example, entry.program, entry.device):
            for token, word in zip(card.tokens, words.get(card.shape, ()), strict=False):
                if word and token.text != word:
                    faults.append(f"{entry.file}: line {token.line} prints {token.text}, the FORMAT {word}")
    return tuple(faults)


def records(text: str, values: int) -> tuple[tuple[tuple[Field, str], ...], ...]:
    """The cards that ``values`` numbers give under FORMAT ``text``, in one scan: its fields, a literal's word by word.

    A field's text is empty for a number; a card without fields is blank.  Raises Refused for a FORMAT that does
    not parse or leaves numbers over.
    """
    spec, _ = parse_format(Format(text, tuple(Place(1, column) for column in range(1, len(text) + 1))))
    given: list[list[tuple[Field, str]]] = [[]]
    column, left = 1, values
    for item in spec.specs:
        if isinstance(item, Slash):
            given.append([])
            column = 1
        elif isinstance(item, Literal):
            found = re.finditer(r"\S+", item.text)
            given[-1] += [(Field(column + w.start(), column + w.end() - 1, True), w[0]) for w in found]
            column += len(item.text)
        elif left:
            given[-1].append((Field(column, column + item.width - 1, False), ""))
            column, left = column + item.width, left - 1
        else:  # unused numeric groups at the end are dropped, a literal before them is punched
            break
    if left:
        raise Refused(Place(1, len(text)), f"{left} of {values} numbers are left over")
    return tuple(map(tuple, given))


def _whole_formats(entry: DeviceLayout, sizes: dict[tuple[int, int, int], int]) -> list[str]:
    """A statement punches all the cards of its FORMAT, in order: 1, 2, ... up to the last."""
    faults = []
    before: CardShape | None = None
    for shape in [*(shape for shape, _ in entry.cards), None]:
        ended = before is None or before.record == sizes.get((before.program, before.format, before.values))
        follows = (
            before is not None
            and shape is not None
            and (shape.program, shape.format, shape.values) == (before.program, before.format, before.values)
            and shape.record == before.record + 1
        )
        begins = shape is None or shape.record == 1
        if not (follows or (ended and begins)):
            name = shape.id if shape else "the end"
            faults.append(f"{entry.file}: {name} cannot follow {before.id if before else 'the beginning'}")
        before = shape
    return faults


def check_arithmetic(chapter: Chapter) -> tuple[str, ...]:
    """The printed numbers agree: same points in every part of an example, N, and planes that support their hull."""
    faults: list[str] = []
    for example in sorted({d.example for d in chapter.layout.devices}):
        deck = sorted(numbers(card) for card in of_role(chapter, example, 1, "point", "deck"))
        for _, program, device, name in (f for f in device_files(chapter) if f[0] == example):
            if device != "punch":
                continue
            found = _points(chapter, example, program)
            if program == 1 and example == 2:
                if not set(found) <= set(deck):
                    faults.append(f"{name}: an endpoint is no point of the input deck")
            elif sorted(found) != deck:
                faults.append(f"{name}: its points are not those of the input deck")
            faults += _plane_faults(chapter, example, program, name, deck)
        faults += _counts(chapter, example, len(deck))
    return tuple(faults)


def _points(chapter: Chapter, example: int, program: int) -> list[Point]:
    roles: tuple[Role, ...] = ("point", "inside", "boundary", "vertex", "endpoint")
    found = [numbers(card) for role in roles for card in of_role(chapter, example, program, role)]
    if program == 1 and of_role(chapter, example, 1, "carrier"):
        return [(x, y, z) for x, z, y in found]  # KPROJ = 2: the deck for program 2 has y last (listing 1, label 213)
    return found


def _plane_faults(chapter: Chapter, example: int, program: int, name: str, deck: Sequence[Point]) -> list[str]:
    faults: list[str] = []
    if not planes(chapter, example, program):
        return faults
    corners = vertices(chapter, example, program)
    table = incidences(chapter, example, program)
    of_output = program > 1
    for number, plane in planes(chapter, example, program).items():
        zero = tuple(i for i, p in enumerate(corners, start=1) if not plane_at(plane, p))
        if not set(table[number]) <= set(zero):
            faults.append(f"{name}: equation {number} does not vanish at its vertices")
        if example in (5, 6) and len(table[number]) != 3:
            faults.append(f"{name}: equation {number} has not three vertices")
        if of_output and any(plane_at(plane, point) > 0 for point in deck):
            faults.append(f"{name}: equation {number} has a point of the deck on its positive side")
    return faults


def _counts(chapter: Chapter, example: int, size: int) -> list[str]:
    """N on every card that prints it is the number of points of the input deck."""
    faults = []
    for _, program, device, name in (f for f in device_files(chapter) if f[0] == example):
        for card in cards(chapter, example, program, device):
            texts = [token.text for token in card.tokens]
            if (card.role == "n" or texts[:1] == ["N="]) and int(texts[0 if card.role == "n" else 1]) != size:
                faults.append(f"{name}: card {card.number} says N is not {size}")
    return faults


def check_files(chapter: Chapter, folder: Traversable) -> tuple[str, ...]:
    """Each committed device file equals its build."""
    faults = []
    for name, contents in built_files(chapter):
        path = folder.joinpath(*name.split("/"))
        if not path.is_file():
            faults.append(f"{name} is missing")
        elif path.read_bytes() != contents.encode("ascii"):
            faults.append(f"{name} is not what witness, apparatus and layout give")
    return tuple(faults)
