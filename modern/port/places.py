"""The points in their places: the order the procedure gives them, and which of the input each one is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from modern.port.arithmetic import Scalar, Vector


@dataclass
class Places:
    """Coordinates by place, from 0, in three rows; ``who`` names the point of the input in each place."""

    coordinates: Vector
    who: NDArray[np.int64]

    def __len__(self) -> int:
        return int(self.coordinates.shape[1])

    @property
    def rows(self) -> tuple[Vector, Vector, Vector]:
        return self.coordinates[0], self.coordinates[1], self.coordinates[2]

    def at(self, place: int) -> tuple[Scalar, Scalar, Scalar]:
        """The coordinates of one point."""
        return self.coordinates[0, place], self.coordinates[1, place], self.coordinates[2, place]

    def several(self, places: NDArray[np.int64]) -> tuple[Vector, Vector, Vector]:
        """The coordinates of several points, in vectors."""
        found = self.coordinates[:, places]
        return found[0], found[1], found[2]

    def swap(self, one: int, other: int) -> None:
        if one != other:
            self.coordinates[:, [one, other]] = self.coordinates[:, [other, one]]
            self.who[[one, other]] = self.who[[other, one]]

    def keep(self, wanted: NDArray[np.bool_]) -> list[int]:
        """Leave out the points not wanted, the rest closing up; returns who they were, in order of place."""
        gone: list[int] = self.who[~wanted].tolist()
        self.coordinates = self.coordinates[:, wanted]
        self.who = self.who[wanted]
        return gone

    def names(self, places: slice | Sequence[int] | NDArray[np.int64]) -> tuple[int, ...]:
        """Who stands in the places given."""
        chosen = places if isinstance(places, slice) else np.asarray(places, np.int64)
        return tuple(self.who[chosen].tolist())
