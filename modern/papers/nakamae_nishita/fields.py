"""Read and check the fields of one table of a scene file (TOML)."""

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from emulator.errors import quoted
from modern.geometry.numbers import number
from modern.geometry.vectors import Vector
from modern.papers.nakamae_nishita.polyhedron import SceneError


class Fields:
    """The fields of a table in a scene file. Each method reads and removes one field, except ``done``, which rejects
    all remaining ones.

    Each method raises SceneError if the field is invalid.
    """

    def __init__(self, data: Mapping[str, Any], place: str) -> None:
        self.place = place
        self._data = dict(data)

    def __contains__(self, key: str) -> bool:
        return key in self._data

    def take(self, key: str) -> Any:
        """Remove a field and return its unchecked value, or None if the field does not exist."""
        return self._data.pop(key, None)

    def wrong(self, key: str, message: str) -> SceneError:
        return SceneError(f"{self.place}: {key}: {message}")

    def text(self, key: str, default: str) -> str:
        raw = self._typed(key, str, "expected a string")
        return default if raw is None else str(raw)

    def flag(self, key: str) -> bool:
        return bool(self._typed(key, bool, "expected true or false"))

    def table(self, key: str) -> Mapping[str, Any]:
        return self._typed(key, dict, "expected a table") or {}

    def tables(self, key: str) -> list[Mapping[str, Any]]:
        return self._list_of(dict, key, f"expected tables [[{key}]]")

    def number(self, key: str) -> Fraction | None:
        raw = self.take(key)
        return None if raw is None else self._fraction(key, raw)

    def count(self, key: str) -> int | None:
        raw = self.take(key)
        if raw is None:
            return None
        if type(raw) is not int:
            raise self.wrong(key, "expected an integer")
        return int(raw)

    def whole(self, key: str, length: int) -> tuple[int, ...] | None:
        raw = self.take(key)
        if raw is None:
            return None
        if not isinstance(raw, list) or len(raw) != length or not all(type(k) is int for k in raw):
            raise self.wrong(key, f"expected {length} integers in brackets")
        return tuple(raw)

    def vector(self, key: str) -> Vector | None:
        raw = self.take(key)
        return None if raw is None else self._vector(key, raw)

    def vectors(self, key: str, flat: bool = False) -> tuple[Vector, ...] | None:
        """Return a list of points. If ``flat``, a point may have two numbers and then lies in the plane z = 0."""
        if key not in self:
            return None
        return tuple(self._vector(key, item, flat) for item in self._list_of(object, key, "expected a list of points"))

    def polygons(self, key: str) -> tuple[tuple[Vector, ...], ...]:
        raw = self._list_of(list, key, "expected a list of lists of points")
        return tuple(tuple(self._vector(key, point) for point in item) for item in raw)

    def counts(self, key: str) -> tuple[tuple[int, ...], ...]:
        message = "expected a list of lists of integers"
        raw = self._list_of(list, key, message)
        # bool is a subclass of int, so isinstance would accept true and false.
        if not all(type(k) is int for item in raw for k in item):
            raise self.wrong(key, message)
        return tuple(tuple(item) for item in raw)

    def done(self) -> None:
        """Raise SceneError if the table has a field that was not read."""
        for key in self._data:
            raise SceneError(f"{self.place}: {quoted(key)} is not a known field of this table")

    def _typed(self, key: str, kind: type, message: str) -> Any:
        raw = self.take(key)
        if raw is not None and not isinstance(raw, kind):
            raise self.wrong(key, message)
        return raw

    def _list_of(self, kind: type, key: str, message: str) -> list[Any]:
        raw = self._typed(key, list, message) or []
        if not all(isinstance(item, kind) for item in raw):
            raise self.wrong(key, message)
        return list(raw)

    def _vector(self, key: str, raw: Any, flat: bool = False) -> Vector:
        if not isinstance(raw, list) or not (len(raw) == 3 or (flat and len(raw) == 2)):
            raise self.wrong(key, "expected a point, three numbers in brackets")
        numbers = [self._fraction(key, item) for item in raw]
        return numbers[0], numbers[1], numbers[2] if len(numbers) > 2 else Fraction(0)

    def _fraction(self, key: str, raw: Any) -> Fraction:
        if type(raw) is int or isinstance(raw, Fraction):
            return Fraction(raw)
        if isinstance(raw, str):
            try:
                return number(raw)
            except ValueError as error:
                raise self.wrong(key, str(error)) from None
        raise self.wrong(key, "expected a number")
