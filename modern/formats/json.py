"""A hull as JSON: everything the result holds, every number exact.

Coordinates and coefficients are strings, decimals or fractions ``p/q``; the integers of the lowest terms are strings
too, as many readers of JSON round large numbers.  Points are named by place in ``points``, from 0.  Read are points:
of a hull, of any object with ``points`` or ``vertices``, or a list; numbers and strings, exactly.
"""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

from emulator.errors import FileError
from modern.geometry.hull import Face, Hull, Stage
from modern.geometry.numbers import Point, integer_text, number


def document(hull: Hull) -> dict[str, Any]:
    """The hull as plain data.  It may be one that was not determined: ``status`` says so."""
    return {
        "type": "hull",
        "arithmetic": hull.arithmetic,
        "status": hull.status,
        "statement": hull.statement,
        "dimension": hull.dimension,
        "points": [list(point) for point in hull.points],
        "vertices": list(hull.vertices),
        "boundary": list(hull.boundary),
        "inside": list(hull.inside),
        "duplicates": [{"point": point, "first": first} for point, first in hull.duplicates],
        "faces": [_face(face) for face in hull.faces],
        "plane": None if hull.plane is None else list(hull.plane),
        "lines": [list(line) for line in hull.lines],
        "centre": None if hull.centre is None else list(hull.centre),
        "corrected": list(hull.corrected),
        "history": [_stage(stage) for stage in hull.history],
        "coplanar": None if hull.coplanar is None else asdict(hull.coplanar),
    }


def write(hull: Hull) -> str:
    """The text of a JSON file: a line for every member, and for every item of a list of lists or objects."""
    members = ",\n".join(f" {json.dumps(name)}: {_member(value)}" for name, value in document(hull).items())
    return "{\n" + members + "\n}\n"


def _member(value: Any) -> str:
    if not isinstance(value, list) or not any(isinstance(item, (list, dict)) for item in value):
        return json.dumps(value)
    return "[\n" + ",\n".join(f"  {json.dumps(item)}" for item in value) + "\n ]"


def _face(face: Face) -> dict[str, Any]:
    return {
        "coefficients": list(face.coefficients),
        "lowest": [integer_text(number) for number in face.lowest],
        "defining": list(face.defining),
        "polygon": list(face.polygon),
        "on": list(face.on),
    }


def _stage(stage: Stage) -> dict[str, Any]:
    return {
        "number": stage.number,
        "added": list(stage.added),
        "checked": stage.checked,
        "outside": stage.outside,
        "struck": list(stage.struck),
        "equations": [list(equation) for equation in stage.equations],
    }


def parse(text: str, source: str) -> tuple[Point, ...]:
    """The points of a JSON file, as the numbers stand there.  Raises FileError, naming line or point."""
    try:
        found = json.loads(text, parse_float=str, parse_int=str, parse_constant=str)
    except json.JSONDecodeError as error:
        raise FileError(f"{source}: line {error.lineno}, column {error.colno}: not JSON: {error.msg}") from None
    except RecursionError:
        raise FileError(f"{source}: the JSON is nested too deeply") from None
    if isinstance(found, dict):
        name = next((name for name in ("points", "vertices") if isinstance(found.get(name), list)), "")
        if not name:
            raise FileError(f'{source}: the JSON object has no list "points"')
        found = found[name]
    if not isinstance(found, list):
        raise FileError(f"{source}: points in JSON are a list of x, y, z")
    return tuple(_point(row, order, source) for order, row in enumerate(found, 1))


def _point(row: object, order: int, source: str) -> Point:
    if not isinstance(row, list) or len(row) != 3:
        raise FileError(f"{source}: point {order} is not a list of three numbers")
    for axis, text in zip("xyz", row, strict=True):
        if not isinstance(text, str):
            raise FileError(f"{source}: point {order}, {axis}: {json.dumps(text)[:40]} is not a number")
        try:
            number(text)
        except ValueError as error:
            raise FileError(f"{source}: point {order}, {axis}: {error}") from None
    x, y, z = (text.strip() for text in row)
    return x, y, z
