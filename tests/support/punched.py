"""A hull of the port compared with the cards that the emulated programs punched for the same points.

Numbers are compared as they appear on cards, in E14.8, including the sign of zero. Points and equations are compared in
order.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from fractions import Fraction

from emulator.numbers.arithmetic import MINUS_ZERO, TRUNCATING, ZERO
from emulator.numbers.base import decimal_length
from emulator.numbers.fields import FALLBACK, write_floating
from modern.geometry.hull import DETERMINED, TABLE_FULL, Hull
from modern.thesis.cards import SECTIONS, sections
from modern.thesis.job import HullRun

Row = tuple[str, ...]
_NO_NUMBER = 0
"""The number of an end of a line that is not a vertex, which rounding can cause."""


@dataclass(frozen=True, slots=True)
class Punched:
    """The cards of the last program: rows of numbers, and the vertices that satisfy each equation."""

    status: str
    inside: tuple[Row, ...]
    boundary: tuple[Row, ...]
    vertices: tuple[Row, ...]
    equations: tuple[Row, ...]
    satisfied: tuple[tuple[int, ...], ...]
    plane: tuple[Row, ...]


def from_cards(cards: Sequence[str], status: str = DETERMINED) -> Punched:
    """Read the cards of the last program."""
    read = sections(cards)
    inside, boundary, vertices, equations, plane = (read.points[name] for name in SECTIONS)
    return Punched(status, inside, boundary, vertices, equations, read.satisfied, plane)


def from_run(run: HullRun) -> Punched:
    """Read the cards that a run of the emulated programs punched last.

    The status of a run that filled the table of planes (``--bounds strict``) says so; for any other abnormal ending it
    is the message.
    """
    ending = run.final.result.ending
    status = run.refusal or DETERMINED
    if not ending.normal:
        status = TABLE_FULL if ending.kind == "bounds" and run.final.name == "program3" else ending.message
    return from_cards(run.final.result.punched, status)


def from_hull(hull: Hull) -> Punched:
    """Return the cards that the programs would punch for this hull."""

    def points(names: Sequence[int]) -> tuple[Row, ...]:
        return tuple(tuple(map(e_field, hull.points[k])) for k in names)

    number = {name: k for k, name in enumerate(hull.vertices, start=1)}
    equations = [face.coefficients for face in hull.faces]
    satisfied = [
        (*group, k)
        for k, face in enumerate(hull.faces, start=1)
        for group in _on_cards([number.get(v, _NO_NUMBER) for v in face.polygon], hull.dimension)
    ]
    plane = [hull.plane] if hull.plane and hull.dimension == 2 else []
    if hull.lines:
        equations, plane = list(hull.lines), []
        triangle = ((1, 2), (1, 2), (2, 3), (2, 3), (1, 3), (1, 3))
        satisfied = [(*pair, k) for k, pair in enumerate(triangle, start=1)] if hull.dimension == 2 else []
    if not hull.determined:
        satisfied, plane = [], []
    inside = hull.inside if hull.dimension > 1 else ()
    return Punched(
        hull.status,
        points(inside),
        points(hull.boundary),
        points(hull.vertices),
        tuple(tuple(map(e_field, equation)) for equation in equations),
        tuple(satisfied),
        tuple(tuple(map(e_field, equation)) for equation in plane),
    )


def differences(hull: Hull, punched: Punched) -> list[str]:
    """Return one line for each difference, including the sign of zero."""
    expected = from_hull(hull)
    lines = []
    for field in fields(Punched):
        from_port, from_card = getattr(expected, field.name), getattr(punched, field.name)
        if field.name == "satisfied":
            from_card = (
                tuple(_unnumbered(*rows) for rows in zip(from_port, from_card, strict=False))
                + from_card[len(from_port) :]
            )
        if from_port != from_card:
            lines.append(f"{field.name}: {from_port} is not {from_card}")
    return lines


def _unnumbered(hull_row: tuple[int, ...], card: tuple[int, ...]) -> tuple[int, ...]:
    """Return the row of a card without numbers that the hull lacks."""
    if len(hull_row) != len(card):
        return card
    return tuple(_NO_NUMBER if own == _NO_NUMBER else number for own, number in zip(hull_row, card, strict=True))


def e_field(text: str) -> str:
    """Return exact text as E14.8 punches it, truncated to eight digits."""
    value = Fraction(text)
    if value == 0:
        return write_floating(FALLBACK, 0, MINUS_ZERO if text.startswith("-") else ZERO, TRUNCATING.rules)[0].strip()
    size = abs(value)
    exponent = decimal_length(size.numerator) - decimal_length(size.denominator) + 1
    exponent -= size < Fraction(10) ** (exponent - 1)
    mantissa = int(size / Fraction(10) ** (exponent - 8))
    return write_floating(FALLBACK, -mantissa if value < 0 else mantissa, exponent, TRUNCATING.rules)[0].strip()


def _on_cards(numbers: list[int], dimension: int) -> list[list[int]]:
    """Return vertices as cards list them: three on a card for program 3, both ends of a line for program 2."""
    if dimension == 2:
        return [numbers]
    ordered = sorted(numbers)
    return [ordered[k : k + 3] for k in range(0, len(ordered), 3)]
