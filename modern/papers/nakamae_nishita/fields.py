"""The fields of a table of a scene file, checked one by one."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from modern.geometry.numbers import number, quoted
from modern.geometry.vectors import Vector
from modern.papers.nakamae_nishita.polyhedron import SceneError


class Fields:
    """The fields of a table, taken out one by one; what is left over at the end is refused."""

    def __init__(self, data: Mapping[str, Any], place: str) -> None:
        self.place = place
        self._data = dict(data)

    def __contains__(self, key: str) -> bool:
        return key in self._data

    def take(self, key: str) -> Any:
        """A value as it stands, None where there is none."""
        return self._data.pop(key, None)

    def wrong(self, key: str, what: str) -> SceneError:
        """The error for a field."""
        return SceneError(f"{self.place}: {key}: {what}")

    def text(self, key: str, default: str) -> str:
        found = self.take(key)
        if found is not None and not isinstance(found, str):
            raise self.wrong(key, "a text is due")
        return default if found is None else found

    def flag(self, key: str) -> bool:
        found = self.take(key)
        if found is not None and not isinstance(found, bool):
            raise self.wrong(key, "true or false is due")
        return bool(found)

    def table(self, key: str) -> Mapping[str, Any]:
        found = self.take(key)
        if found is not None and not isinstance(found, dict):
            raise self.wrong(key, "a table is due")
        return found or {}

    def tables(self, key: str) -> list[Mapping[str, Any]]:
        found = self.take(key) or []
        if not isinstance(found, list) or not all(isinstance(item, dict) for item in found):
            raise self.wrong(key, f"tables [[{key}]] are due")
        return found

    def number(self, key: str) -> Fraction | None:
        found = self.take(key)
        return None if found is None else self._fraction(key, found)

    def count(self, key: str) -> int | None:
        found = self.take(key)
        if found is None:
            return None
        if type(found) is not int:
            raise self.wrong(key, "a whole number is due")
        return int(found)

    def whole(self, key: str, many: int) -> tuple[int, ...] | None:
        """A list of so many whole numbers."""
        found = self.take(key)
        if found is None:
            return None
        if not isinstance(found, list) or len(found) != many or not all(type(k) is int for k in found):
            raise self.wrong(key, f"{many} whole numbers in brackets are due")
        return tuple(found)

    def vector(self, key: str) -> Vector | None:
        found = self.take(key)
        return None if found is None else self._vector(key, found)

    def vectors(self, key: str, flat: bool = False) -> tuple[Vector, ...] | None:
        """A list of points; with ``flat`` also of two numbers each, in the plane z = 0."""
        if key not in self:
            return None
        return tuple(self._vector(key, item, flat) for item in self._list(key, "a list of points is due"))

    def polygons(self, key: str) -> tuple[tuple[Vector, ...], ...]:
        """A list of lists of points."""
        found = self._list(key, "a list of lists of points is due")
        if not all(isinstance(item, list) for item in found):
            raise self.wrong(key, "a list of lists of points is due")
        return tuple(tuple(self._vector(key, point) for point in item) for item in found)

    def counts(self, key: str) -> tuple[tuple[int, ...], ...]:
        """A list of lists of whole numbers."""
        found = self._list(key, "a list of lists of whole numbers is due")
        if not all(isinstance(item, list) and all(type(k) is int for k in item) for item in found):
            raise self.wrong(key, "a list of lists of whole numbers is due")
        return tuple(tuple(item) for item in found)

    def done(self) -> None:
        """Refuse what nobody asked for."""
        for key in self._data:
            raise SceneError(f"{self.place}: {quoted(key)} is no field of this place")

    def _list(self, key: str, due: str) -> list[Any]:
        found = self.take(key)
        if found is not None and not isinstance(found, list):
            raise self.wrong(key, due)
        return found or []

    def _vector(self, key: str, found: Any, flat: bool = False) -> Vector:
        if not isinstance(found, list) or not (len(found) == 3 or (flat and len(found) == 2)):
            raise self.wrong(key, "a point is three numbers in brackets")
        numbers = [self._fraction(key, item) for item in found]
        return numbers[0], numbers[1], numbers[2] if len(numbers) > 2 else Fraction(0)

    def _fraction(self, key: str, found: Any) -> Fraction:
        if type(found) is int or isinstance(found, Fraction):
            return Fraction(found)
        if isinstance(found, str):
            try:
                return number(found)
            except ValueError as error:
                raise self.wrong(key, str(error)) from None
        raise self.wrong(key, "a number is due")
