"""Write and read JSON: the complete data of a hull, with every number exact.

Coordinates and coefficients are strings, decimals or fractions ``p/q``.  The integers of equations in lowest terms are
strings too, because many JSON readers round large numbers.  Indices refer to ``points`` and count from 0.  The reader
accepts a hull, any object with the member ``points`` or ``vertices``, or a list of points.  Coordinates may be numbers
or strings.
"""

import json
from dataclasses import asdict
from typing import Any

from emulator.errors import FileError
from modern.geometry.hull import Face, Hull
from modern.geometry.numbers import Point, integer_text, number


def document(hull: Hull) -> dict[str, Any]:
    """Return the hull as dictionaries and lists.  If no hull was found, ``status`` gives the reason."""
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
        "history": [asdict(stage) for stage in hull.history],
        "coplanar": None if hull.coplanar is None else asdict(hull.coplanar),
    }


def write(hull: Hull) -> str:
    """Return the hull as JSON text, with one line for each member and for each item of a long list."""
    members = ",\n".join(f" {json.dumps(name)}: {_member(value)}" for name, value in document(hull).items())
    return "{\n" + members + "\n}\n"


def _member(value: Any) -> str:
    if not isinstance(value, list) or not any(isinstance(item, (list, dict)) for item in value):
        return json.dumps(value)
    return "[\n" + ",\n".join(f"  {json.dumps(item)}" for item in value) + "\n ]"


def _face(face: Face) -> dict[str, Any]:
    # dataclasses.asdict would copy every number, which is slow for thousands of faces.
    return {
        "coefficients": list(face.coefficients),
        "lowest": [integer_text(number) for number in face.lowest],
        "defining": list(face.defining),
        "polygon": list(face.polygon),
        "on": list(face.on),
    }


def parse(text: str, source: str) -> tuple[Point, ...]:
    """Return the points of a JSON file as text.  Raise FileError, with the line or the point, if it is invalid."""
    try:
        data = json.loads(text, parse_float=str, parse_int=str, parse_constant=str)
    except json.JSONDecodeError as error:
        raise FileError(f"{source}: line {error.lineno}, column {error.colno}: not JSON: {error.msg}") from None
    except RecursionError:
        raise FileError(f"{source}: the JSON is nested too deeply") from None
    if isinstance(data, dict):
        name = next((name for name in ("points", "vertices") if isinstance(data.get(name), list)), "")
        if not name:
            raise FileError(f'{source}: the JSON object has no list "points"')
        data = data[name]
    if not isinstance(data, list):
        raise FileError(f"{source}: expected a list of points [x, y, z] in the JSON")
    return tuple(_point(row, point_number, source) for point_number, row in enumerate(data, 1))


def _point(row: object, point_number: int, source: str) -> Point:
    if not isinstance(row, list) or len(row) != 3:
        raise FileError(f"{source}: point {point_number} is not a list of three numbers")
    for axis, text in zip("xyz", row, strict=True):
        if not isinstance(text, str):
            raise FileError(f"{source}: point {point_number}, {axis}: {json.dumps(text)[:40]} is not a number")
        try:
            number(text)
        except ValueError as error:
            raise FileError(f"{source}: point {point_number}, {axis}: {error}") from None
    x, y, z = (text.strip() for text in row)
    return x, y, z
