"""Checks of the whole transcript of chapter 6.  Each function returns a message for each fault that it finds.

* :func:`check_tie` checks that the cards have the characters of the printed lines, in the order of the print.
* :func:`check_rows` checks that the ground of every emendation holds, and that no emendation is superfluous.
* :func:`check_layout` checks that columns, blank cards and words of the cards agree with the FORMAT statements.
* :func:`check_arithmetic` checks that the printed points, planes and counts agree with each other.
* :func:`check_files` checks that the committed device files are those built from witness, apparatus and layout.
"""

import re
import sys
from collections.abc import Sequence
from decimal import Decimal
from importlib.resources.abc import Traversable
from pathlib import Path

from emulator.errors import Refused
from emulator.language.formats import Literal, Slash, parse_format
from emulator.language.tree import Format, Place
from modern.edition.chapter6 import CardShape, DeviceLayout, Field, LayoutError, Role, chapter6_folder
from modern.edition.chapter6_cards import (
    Chapter,
    built_files,
    cards,
    device_files,
    load_chapter,
    printed_lines,
    write_files,
)
from modern.edition.chapter6_grounds import incidences, numbers, of_role, plane_at, planes, row_faults, vertices
from modern.edition.readings import solid

Point = tuple[Decimal, ...]


def check_chapter(chapter: Chapter) -> tuple[str, ...]:
    """Run every check of this module and return all faults."""
    return (
        *check_tie(chapter),
        *check_rows(chapter),
        *check_layout(chapter),
        *check_arithmetic(chapter),
        *check_files(chapter, chapter6_folder()),
    )


def check_tie(chapter: Chapter) -> tuple[str, ...]:
    """Check that the cards have the characters of the printed lines, and that each line is a card or a heading."""
    faults: list[str] = []
    used: list[str] = list(chapter.layout.headings)
    for entry in chapter.layout.devices:
        if entry.span is None:
            continue
        lines = printed_lines(chapter, entry)
        used += [line.id for line in lines]
        images = [card.image for card in cards(chapter, entry.example, entry.program, entry.device)]
        if solid("".join(images)) != solid("".join(line.text for line in lines)):
            faults.append(f"{entry.file}: the characters of its cards differ from those of its printed lines")
    known = [line.id for line in chapter.print]
    faults += [f"line {i} of the corrected print belongs to no card and no heading" for i in known if i not in used]
    faults += [f"line {i} of the corrected print is used twice" for i in sorted(set(used)) if used.count(i) > 1]
    faults += [f"heading line {i} is not in the corrected print" for i in used if i not in known]
    return tuple(faults)


def check_rows(chapter: Chapter) -> tuple[str, ...]:
    return tuple(fault for row in chapter.text.rows for fault in row_faults(chapter, row))


def check_layout(chapter: Chapter) -> tuple[str, ...]:
    """Check that cards have the columns and words of their FORMATs, and that no card of a FORMAT is missing."""
    faults: list[str] = []
    literals: dict[str, list[str]] = {}
    texts = {(f.program, f.number): f.text for f in chapter.layout.formats}
    sizes: dict[tuple[int, int, int], int] = {}
    for shape in chapter.layout.cards:
        try:
            cards_of_format = records(texts[shape.program, shape.format], shape.values)
        except KeyError:
            faults.append(f"card {shape.id}: the layout has no FORMAT {shape.format} of program {shape.program}")
            continue
        except Refused as error:
            faults.append(f"card {shape.id}: {error}")
            continue
        sizes[shape.program, shape.format, shape.values] = len(cards_of_format)
        expected = cards_of_format[shape.record - 1] if 0 < shape.record <= len(cards_of_format) else None
        if expected is None or tuple(field for field, _ in expected) != shape.fields:
            faults.append(f"card {shape.id}: its columns differ from those of FORMAT {shape.format}")
            continue
        literals[shape.id] = [text for _, text in expected]
    for entry in chapter.layout.devices:
        faults += _whole_formats(entry, sizes)
        for card in cards(chapter, entry.example, entry.program, entry.device):
            for token, word in zip(card.tokens, literals.get(card.shape, ()), strict=False):
                if word and token.text != word:
                    faults.append(f"{entry.file}: line {token.line} prints {token.text}, the FORMAT {word}")
    return tuple(faults)


def records(text: str, values: int) -> tuple[tuple[tuple[Field, str], ...], ...]:
    """Return the fields of each card that FORMAT ``text`` punches for ``values`` numbers.

    Each field has the word that it prints, such as VERTICES; the word of a numeric field is empty.
    Raise Refused if the FORMAT does not parse or has too few fields.
    """
    spec, _ = parse_format(Format(text, tuple(Place(1, column) for column in range(1, len(text) + 1))))
    card_fields: list[list[tuple[Field, str]]] = [[]]
    column, remaining = 1, values
    for item in spec.specs:
        if isinstance(item, Slash):
            card_fields.append([])
            column = 1
        elif isinstance(item, Literal):
            words = re.finditer(r"\S+", item.text)
            card_fields[-1] += [(Field(column + w.start(), column + w.end() - 1, True), w[0]) for w in words]
            column += len(item.text)
        elif remaining:
            card_fields[-1].append((Field(column, column + item.width - 1, False), ""))
            column, remaining = column + item.width, remaining - 1
        else:  # The list is exhausted: the literals before the next numeric field are punched, and the rest is not.
            break
    if remaining:
        raise Refused(Place(1, len(text)), f"the FORMAT has no field for {remaining} of {values} numbers")
    return tuple(map(tuple, card_fields))


def _whole_formats(entry: DeviceLayout, sizes: dict[tuple[int, int, int], int]) -> list[str]:
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
            after = before.id if before else "the beginning"
            faults.append(f"{entry.file}: {name} cannot follow {after}, because a FORMAT's cards must be complete")
        before = shape
    return faults


def check_arithmetic(chapter: Chapter) -> tuple[str, ...]:
    """Check that all device files of an example agree in N and the points, and that no point is outside a plane."""
    faults: list[str] = []
    for example in sorted({d.example for d in chapter.layout.devices}):
        deck = sorted(numbers(card) for card in of_role(chapter, example, 1, "point", "deck"))
        for _, program, device, name in (f for f in device_files(chapter) if f[0] == example):
            if device != "punch":
                continue
            output_points = _points(chapter, example, program)
            if program == 1 and example == 2:
                if not set(output_points) <= set(deck):
                    faults.append(f"{name}: an endpoint is not a point of the input deck")
            elif sorted(output_points) != deck:
                faults.append(f"{name}: its points differ from those of the input deck")
            faults += _plane_faults(chapter, example, program, name, deck)
        faults += _counts(chapter, example, len(deck))
    return tuple(faults)


def _points(chapter: Chapter, example: int, program: int) -> list[Point]:
    roles: tuple[Role, ...] = ("point", "inside", "boundary", "vertex", "endpoint")
    points = [numbers(card) for role in roles for card in of_role(chapter, example, program, role)]
    if program == 1 and of_role(chapter, example, 1, "carrier"):
        # KPROJ = 2: program 1 exchanges y and z in the deck for program 2 (listing 1, statement 213).
        return [(x, y, z) for x, z, y in points]
    return points


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
            faults.append(f"{name}: equation {number} does not have three vertices")
        if of_output and any(plane_at(plane, point) > 0 for point in deck):
            faults.append(f"{name}: equation {number} has a point of the deck on its positive side")
    return faults


def _counts(chapter: Chapter, example: int, size: int) -> list[str]:
    faults = []
    for _, program, device, name in (f for f in device_files(chapter) if f[0] == example):
        for card in cards(chapter, example, program, device):
            texts = [token.text for token in card.tokens]
            if (card.role == "n" or texts[:1] == ["N="]) and int(texts[0 if card.role == "n" else 1]) != size:
                faults.append(f"{name}: card {card.number}: N is not {size}, the number of points of the deck")
    return faults


def check_files(chapter: Chapter, folder: Traversable) -> tuple[str, ...]:
    faults = []
    for name, contents in built_files(chapter):
        path = folder.joinpath(*name.split("/"))
        if not path.is_file():
            faults.append(f"{name} is missing")
        elif path.read_bytes() != contents.encode("ascii"):
            faults.append(f"{name} differs from the file built from witness, apparatus and layout")
    return tuple(faults)


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the device files (``--write``) or print all faults (``--check``), and return the exit status."""
    options = list(sys.argv[1:] if arguments is None else arguments)
    if options not in (["--write"], ["--check"]):
        print("usage: python -m modern.edition.chapter6_checks --write | --check", file=sys.stderr)
        return 2
    try:
        chapter = load_chapter()
        if options == ["--write"]:
            for name in write_files(chapter, Path(str(chapter6_folder()))):
                print(name)
            return 0
        faults = check_chapter(chapter)
    except (ValueError, LayoutError) as error:
        print(error, file=sys.stderr)
        return 1
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    raise SystemExit(main())
