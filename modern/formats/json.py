"""A hull as JSON: everything the result holds, every number exact.

Coordinates and coefficients are strings, decimals or fractions ``p/q``; the integers of the lowest terms are strings
too, as many readers of JSON round large numbers.  Points are named by place in ``points``, from 0.
"""

from __future__ import annotations

import json
from typing import Any

from modern.geometry.hull import Face, Hull, Stage
from modern.geometry.numbers import integer_text


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
        "mended": list(hull.mended),
        "history": [_stage(stage) for stage in hull.history],
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
