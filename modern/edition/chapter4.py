"""The worked examples of chapter 4 of the thesis (theorems 4.1, 4.2 with Table 1, and 4.8) as exact data.

Each point or plane names the line of the corrected text of chapter 4 that prints it, and quotes its printed form.
:func:`theorem_faults` parses the printed form and compares the result with the data.
"""

import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Any

from modern.edition.apparatus import Text, build, load

THEOREMS = ("4.1", "4.2", "4.8")

Vector = tuple[Fraction, ...]
_TERM = re.compile(r"([+-]?)(\d*)([xyz]?)")


@dataclass(frozen=True, slots=True)
class Point:
    """A printed point: its name, its exact coordinates (x, y, z), the id of its line, and its printed form."""

    name: str
    at: Vector
    line: str
    printed: str


@dataclass(frozen=True, slots=True)
class Plane:
    """The plane Ax + By + Cz + D = 0 of a worked example.

    ``coefficients`` are A, B, C and D, and ``vertices`` are the points that the plane contains according to the thesis.
    ``printed`` is its equation as printed, and ``line`` is the id of the printed line.
    """

    number: int
    coefficients: Vector
    vertices: tuple[str, ...]
    line: str
    printed: str

    def at(self, point: Point) -> Fraction:
        """Return the value of the left side of the equation at a point."""
        products = (a * x for a, x in zip(self.coefficients, point.at, strict=False))
        return sum(products, self.coefficients[3])


@dataclass(frozen=True, slots=True)
class Theorem:
    """A worked example.

    ``extremes`` names the points that the thesis calls lx, sx, ly, sy, lz and sz, which have the largest or smallest x,
    y or z.  ``outside_plane`` names the points that, according to the text, do not lie on the plane.  ``signs`` holds
    triples (number of a plane, name of a point, sign): the sign that the plane's equation has at the point according to
    the text.  ``lost`` maps the name of each point whose coordinates the OCR lost to the reason why the text does not
    determine them.
    """

    id: str
    points_stated: int
    points: tuple[Point, ...]
    planes: tuple[Plane, ...]
    extremes: Mapping[str, str]
    outside_plane: tuple[str, ...]
    signs: tuple[tuple[int, str, str], ...]
    lost: Mapping[str, str]

    def point(self, name: str) -> Point | None:
        return next((p for p in self.points if p.name == name), None)

    def plane(self, number: int) -> Plane:
        return next(p for p in self.planes if p.number == number)


def chapter4_folder() -> Traversable:
    return files("transcripts").joinpath("chapter4")


@cache
def load_text() -> Text:
    return load(chapter4_folder(), "chapter4")


@cache
def load_theorems() -> tuple[Theorem, ...]:
    """Return the data of ``theorems.toml`` in the order of the chapter."""
    data = tomllib.loads(chapter4_folder().joinpath("theorems.toml").read_text(encoding="utf-8"))
    return tuple(_theorem(raw) for raw in data["theorem"])


def _theorem(raw: Mapping[str, Any]) -> Theorem:
    return Theorem(
        id=raw["id"],
        points_stated=raw["points_stated"],
        points=tuple(Point(p["name"], _vector(p["at"]), p["line"], p["printed"]) for p in raw["point"]),
        planes=tuple(
            Plane(p["number"], _vector(p["coefficients"]), tuple(p["vertices"]), p["line"], p["printed"])
            for p in raw["plane"]
        ),
        extremes=dict(raw["extremes"]),
        outside_plane=tuple(raw["outside_plane"]),
        signs=tuple((s["plane"], s["point"], s["sign"]) for s in raw.get("sign", ())),
        lost={entry["name"]: entry["reason"] for entry in raw.get("lost", ())},
    )


def _vector(texts: Sequence[str]) -> Vector:
    return tuple(Fraction(text) for text in texts)


def printed_point(text: str) -> Vector:
    """Return the coordinates of a point printed like ``(9/4, 4, 1/8)`` or ``P_1 = (9,6,-8)``."""
    return _vector([part.strip() for part in text[text.index("(") + 1 : text.rindex(")")].split(",")])


def printed_plane(equation: str) -> Vector:
    """Return A, B, C, D of a printed equation such as ``2x - 5y + 14z = 0``.

    A term that is not printed has the coefficient 0.
    """
    left, right = equation.replace(" ", "").split("=")
    if right != "0":
        raise ValueError(f"{equation}: the right-hand side is not 0")
    coefficients = dict.fromkeys(("x", "y", "z", ""), Fraction(0))
    for sign, digits, variable in _TERM.findall(left):
        if digits or variable:
            coefficients[variable] = Fraction(f"{sign}{digits or 1}")
    return tuple(coefficients[v] for v in ("x", "y", "z", ""))


def theorem_faults(theorem: Theorem, text: Text) -> tuple[str, ...]:
    """Return a message for each difference between a theorem's data and its text, and for each wrong claim.

    The claims are the stated number of points, the points on each plane, the extreme points and the signs.
    """
    faults: list[str] = []
    at = {line.id: "".join(line.text.split()) for line in build(text)}
    name = f"theorem {theorem.id}"
    for point in theorem.points:
        if "".join(point.printed.split()) not in at.get(point.line, ""):
            faults.append(f"{name}: line {point.line} does not print {point.printed}")
        if printed_point(point.printed) != point.at:
            faults.append(f"{name}: {point.name} differs from {point.printed}")
    for plane in theorem.planes:
        if "".join(plane.printed.split()) not in at.get(plane.line, ""):
            faults.append(f"{name}: line {plane.line} does not print {plane.printed}")
        if printed_plane(plane.printed) != plane.coefficients:
            faults.append(f"{name}: plane {plane.number} differs from {plane.printed}")
        faults += _plane_faults(theorem, plane, at.get(plane.line, ""))
    if len(theorem.points) + len(theorem.lost) != theorem.points_stated:
        total = len(theorem.points) + len(theorem.lost)
        faults.append(f"{name}: the text states {theorem.points_stated} points, the data have {total}")
    for label, extreme in theorem.extremes.items():
        faults += _extreme_faults(theorem, label, extreme)
    for number, named, sign in theorem.signs:
        sign_point = theorem.point(named)
        value = theorem.plane(number).at(sign_point) if sign_point else Fraction(0)
        if (value > 0) != (sign == "+") or value == 0:
            faults.append(f"{name}: plane {number} has the value {value} at {named}, the text states {sign}")
    return tuple(faults)


def _plane_faults(theorem: Theorem, plane: Plane, printed_line: str) -> list[str]:
    faults = []
    for vertex in plane.vertices:
        point = theorem.point(vertex)
        if point is None or plane.at(point):
            faults.append(f"theorem {theorem.id}: plane {plane.number} does not contain {vertex}")
        if len(theorem.planes) > 1 and point and not _named(point, printed_line):
            faults.append(f"theorem {theorem.id}: the table does not list {vertex} for plane {plane.number}")
    for name in theorem.outside_plane:
        point = theorem.point(name)
        if point is None or not plane.at(point):
            faults.append(f"theorem {theorem.id}: plane {plane.number} contains {name}")
    return faults


def _named(point: Point, printed_line: str) -> bool:
    """Return True if a line names a point by its coordinates (theorem 4.8) or by P with a subscript (theorem 4.2)."""
    subscripted = "P" + "₀₁₂₃₄₅₆₇₈₉"[int(point.name[1:])]
    return subscripted in printed_line or "".join(str(point.at[i]) + ",)"[i == 2] for i in range(3)) in printed_line


def _extreme_faults(theorem: Theorem, label: str, name: str) -> list[str]:
    # Lost points are ignored, because their coordinates are unknown.
    axis, point = "xyz".index(label[1]), theorem.point(name)
    if point is None:
        return [] if name in theorem.lost else [f"theorem {theorem.id}: {name} does not exist"]
    values = [p.at[axis] for p in theorem.points]
    if point.at[axis] != (max(values) if label[0] == "l" else min(values)):
        return [f"theorem {theorem.id}: {name} is not the extreme {label}"]
    return []
