"""Check the grounds of the rows of chapter 6: the evidence for each emendation, tested with exact decimals.

The ground of a row must hold in the corrected text, and must fail if the row and the rows that depend on it are left
out.  This detects superfluous and wrong rows.  Grounds use only the printed text, never a run of a program.  The table
``ground`` of a row may contain a second ground under the key ``also``, which must hold too.  The kinds of ground:

``width``       every line that the row changes consists of well-formed numbers and words
``deck``        a line that the row changes has the same numbers as the card that the ground names by ``example``,
                ``program``, ``device`` and ``card``.  If the ground also names a ``field``, the number in this field
                occurs more often in the changed lines with the row than without it
``arithmetic``  ``check = "plane"``: the equation is zero at its printed vertices, which the ground also names;
                ``"carrier"``: the equation of the common plane of example 4 is zero at all points; ``"centre"``: the
                inside point C is the mean of the first four points; ``"minus-with-point"``: in the named lines the OCR
                lost the decimal points of exactly the negative numbers
``sibling``     the text ``words`` occurs in the changed lines, which the key ``own`` of the ground names, and also in
                the lines that the key ``lines`` names, which are in another part of the chapter
``order``       a ground with the key ``lines``: the row sorts these lines of the witness by the column in which each of
                them begins.  With ``role``: the cards with this role are numbered 1, 2, 3 and so on.  With ``page``:
                the row deletes the number of a page
"""

import re
from collections.abc import Callable, Mapping, Sequence
from decimal import Decimal
from typing import Any

from modern.edition.apparatus import ApparatusError, Line, Row, build
from modern.edition.chapter6 import Device, Layout, Role
from modern.edition.chapter6_cards import E14, Card, Chapter, TranscriptError, cards, printed_lines, without_row
from modern.edition.readings import solid

_SIGNED = re.compile(r"[+-]\.\d{8}E[+-]\d\d")
_STRAY = re.compile(r"\d{4}|\.\d|\d\.|(?<!\S)[.,]|[+-]\s*\d|[^A-Z0-9+\-=.,\s]")
_LONE_SIGN = re.compile(r"(?<!\S)[+-]+(?!\S)")

Ground = Mapping[str, Any]


def row_faults(chapter: Chapter, row: Row) -> tuple[str, ...]:
    """Return a message for each ground of a row that fails in the corrected text or also holds without the row."""
    grounds = [row.ground, *([row.ground["also"]] if "also" in row.ground else [])]
    faults = []
    without = without_row(chapter, row.id)
    for ground in grounds:
        check = _CHECKS.get(str(ground.get("kind", "")))
        if check is None:
            return (f"row {row.id}: unknown kind of ground {ground.get('kind')!r}",)
        if not _holds(check, chapter, row, ground):
            faults.append(f"row {row.id}: its ground ({ground['kind']}) fails in the corrected print")
        elif _holds(check, without, row, ground):
            faults.append(f"row {row.id}: its ground ({ground['kind']}) also holds without the row")
    return tuple(faults)


def _holds(check: Callable[[Chapter, Row, Ground], bool], chapter: Chapter, row: Row, ground: Ground) -> bool:
    try:
        return check(chapter, row, ground)
    except TranscriptError:
        return False


def _lines(chapter: Chapter, ids: Sequence[str]) -> tuple[Line, ...]:
    return tuple(line for line in chapter.print if line.id in ids)


def _touched(chapter: Chapter, row: Row) -> tuple[Line, ...]:
    return _lines(chapter, [change.line for change in row.changes])


def well_formed(text: str, signed: bool) -> bool:
    """Return True if a printed line consists only of E14.8 numbers, short integers and words in card characters.

    If ``signed``, every E14.8 number must have a sign, as on the cards of an input deck.
    """
    rest = (_SIGNED if signed else E14).sub(" ", text)
    if _STRAY.search(rest):
        return False
    return bool(re.search(r"[A-Z]", rest)) or not _LONE_SIGN.search(rest)


def _signed_lines(layout: Layout, chapter: Chapter) -> frozenset[str]:
    decks = [d for d in layout.devices if d.device == "deck"]
    return frozenset(line.id for d in decks for line in printed_lines(chapter, d))


def _width(chapter: Chapter, row: Row, ground: Ground) -> bool:
    signed = _signed_lines(chapter.layout, chapter)
    return all(well_formed(line.text, line.id in signed) for line in _touched(chapter, row))


def numbers(card: Card) -> tuple[Decimal, ...]:
    """Return the E14.8 numbers of a card as exact decimals."""
    return tuple(Decimal(t.text) for t in card.tokens if E14.fullmatch(t.text))


def integers(card: Card) -> tuple[int, ...]:
    return tuple(int(t.text) for t in card.tokens if t.text.isdigit())


def of_role(chapter: Chapter, example: int, program: int, role: Role, device: Device = "punch") -> tuple[Card, ...]:
    """Return the cards of a device file that have a given role, in the order of the file."""
    return tuple(card for card in cards(chapter, example, program, device) if card.role == role)


def _deck(chapter: Chapter, row: Row, ground: Ground) -> bool:
    source = cards(chapter, ground["example"], ground["program"], ground["device"])[ground["card"] - 1]
    card_numbers = numbers(source)
    if "field" not in ground:
        return card_numbers in (_values(chapter, line) for line in _touched(chapter, row))
    value = card_numbers[ground["field"] - 1]
    without = chapter if row.id in chapter.without else without_row(chapter, row.id)
    return _count(chapter, row, value) > _count(without, row, value)


def _values(chapter: Chapter, line: Line) -> tuple[Decimal, ...]:
    signed = line.id in _signed_lines(chapter.layout, chapter)
    return tuple(Decimal(text) for text in (_SIGNED if signed else E14).findall(line.text))


def _count(chapter: Chapter, row: Row, value: Decimal) -> int:
    return sum(_values(chapter, line).count(value) for line in _touched(chapter, row))


def vertices(chapter: Chapter, example: int, program: int) -> tuple[tuple[Decimal, ...], ...]:
    """Return the vertices or endpoints that a program punched, or the first four points if it punched neither."""
    roles: tuple[Role, ...] = ("vertex", "endpoint", "point")
    for role in roles:
        if point_cards := of_role(chapter, example, program, role):
            return tuple(numbers(card) for card in point_cards[: 4 if role == "point" else None])
    raise TranscriptError(f"example {example}, program {program} prints no points")


def plane_at(plane: Sequence[Decimal], point: Sequence[Decimal]) -> Decimal:
    return sum((a * x for a, x in zip(plane[:3], point, strict=True)), plane[3])


def incidences(chapter: Chapter, example: int, program: int) -> dict[int, tuple[int, ...]]:
    """Return the numbers of the printed vertices of each equation, by the number of the equation.

    An intermediate deck has the numbers of the vertices on the card of the plane.
    """
    if planes := of_role(chapter, example, program, "plane"):
        return {n: integers(card) for n, card in enumerate(planes, start=1)}
    if program == 1 and (table := of_role(chapter, example, 1, "incidence")):
        return {integers(card)[-1]: tuple(int(t.text.rstrip(",")) for t in card.tokens[:2]) for card in table}
    if ends := of_role(chapter, example, program, "endpoint"):
        return {integers(c)[0]: tuple(range(1, len(ends) + 1)) for c in of_role(chapter, example, program, "equation")}
    return {integers(card)[-1]: integers(card)[:-1] for card in of_role(chapter, example, program, "incidence")}


def planes(chapter: Chapter, example: int, program: int) -> dict[int, tuple[Decimal, ...]]:
    """Return the coefficients of each printed equation, by its number."""
    if plane_cards := of_role(chapter, example, program, "plane"):
        return {n: numbers(card) for n, card in enumerate(plane_cards, start=1)}
    return {integers(c)[0]: numbers(c) for c in of_role(chapter, example, program, "equation")}


def _arithmetic(chapter: Chapter, row: Row, ground: Ground) -> bool:
    return _ARITHMETIC[str(ground["check"])](chapter, row, ground)


def _plane(chapter: Chapter, row: Row, ground: Ground) -> bool:
    example, program, equation = ground["example"], ground["program"], ground["equation"]
    plane = planes(chapter, example, program).get(equation)
    named = tuple(ground["vertices"])
    points = vertices(chapter, example, program)
    if plane is None or incidences(chapter, example, program).get(equation) != named:
        return False
    return any(plane) and all(not plane_at(plane, points[n - 1]) for n in named)


def _carrier(chapter: Chapter, row: Row, ground: Ground) -> bool:
    carrier = numbers(of_role(chapter, ground["example"], ground["program"], "carrier")[0])
    points = of_role(chapter, ground["example"], 1, "point", "deck")
    return any(carrier) and all(not plane_at(carrier, numbers(card)) for card in points)


def _centre(chapter: Chapter, row: Row, ground: Ground) -> bool:
    centre = numbers(of_role(chapter, ground["example"], 1, "centre")[0])
    first = vertices(chapter, ground["example"], 1)
    return all(4 * c == sum(axis) for c, axis in zip(centre, zip(*first, strict=True), strict=True))


def _minus_with_point(chapter: Chapter, row: Row, ground: Ground) -> bool:
    for line in _lines(chapter, ground["lines"]):
        witness = next(w for w in chapter.text.witness if w.id == line.id)
        cells = [cell.strip() for cell in witness.text.split("\t") if "E" in cell]
        printed = E14.findall(line.text)
        if len(cells) != len(printed):
            return False
        if any(cell[0].isdigit() != text.startswith("-") for cell, text in zip(cells, printed, strict=True)):
            return False
    return True


def _sibling(chapter: Chapter, row: Row, ground: Ground) -> bool:
    phrase = solid(ground["words"])
    return all(phrase in solid("".join(line.text for line in _lines(chapter, ground[k]))) for k in ("own", "lines"))


def _order(chapter: Chapter, row: Row, ground: Ground) -> bool:
    if "lines" in ground:
        return row.id not in chapter.without and _by_columns(chapter, row, ground["lines"])
    if "page" in ground:
        pages = {line.id: line.page for line in chapter.text.witness}
        named = all(c.witness == ground["page"] == pages[c.line] and not c.lemma for c in row.changes)
        return named and not _lines(chapter, [c.line for c in row.changes])
    table = of_role(chapter, ground["example"], ground["program"], ground["role"])
    place = -1 if ground["role"] == "incidence" else 0
    return [integers(card)[place] for card in table] == list(range(1, len(table) + 1))


def _by_columns(chapter: Chapter, row: Row, ids: Sequence[str]) -> bool:
    """Return True if the row sorts unsorted lines of the witness by the column in which each of them begins."""
    witness = [line for line in chapter.text.witness if line.id in ids]
    ordered = sorted(witness, key=lambda line: len(line.text) - len(line.text.lstrip()))
    others = frozenset(r.id for r in chapter.text.rows) - {row.id}
    try:
        alone = build(chapter.text, None, others)
    except ApparatusError:
        return False
    before, expected, after = (
        solid("".join(line.text for line in lines))
        for lines in (witness, ordered, [line for line in alone if line.id in ids])
    )
    return before != expected == after


_ARITHMETIC: Mapping[str, Callable[[Chapter, Row, Ground], bool]] = {
    "plane": _plane,
    "carrier": _carrier,
    "centre": _centre,
    "minus-with-point": _minus_with_point,
}
_CHECKS: Mapping[str, Callable[[Chapter, Row, Ground], bool]] = {
    "width": _width,
    "deck": _deck,
    "arithmetic": _arithmetic,
    "sibling": _sibling,
    "order": _order,
}
