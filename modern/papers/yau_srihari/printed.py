"""Where the paper's print is wrong: each statement by name, with what it has to be."""

from __future__ import annotations

from dataclasses import dataclass, fields


@dataclass(frozen=True, slots=True)
class Printed:
    """The statements taken as printed; all False: the algorithm as it has to be.

    angle: Theorem 2 takes the face of the greatest angle between outward normals.  The supporting plane is that of the
        least.
    start: section 5 starts from one upright face over each edge of H(A).  Points of the floor may lie lower above the
        inside of such an edge: one upright face is needed for every edge of the lower chain of the points above it.
    triangles: section 4.6 takes all faces as triangles.  Where four extreme points or more lie in one supporting plane,
        triangles chosen edge by edge overlap; the face is the polygon of all of them.
    truncation: section 5 enters the truncated value of a face.  The least digital point on or above it is rounded up.
    bound: section 4.6.2 bounds both angles of a square at z = max, which goes with the greatest angle.  For the least
        it is z = min, the value a node of the floor tree holds; and a corner below the plane of the known face, where
        no point can be, counts as lying on it.
    corners: section 4.6.2 takes the extrema of a square at its corners.  They are there only if the whole square lies
        beyond the edge; a square which the edge's line crosses has to be divided.
    marks: section 5 marks every digital point of a face, and searches what is not marked.  The vertices of a face are
        vertices of its neighbours too and must be found again.
    """

    angle: bool = False
    start: bool = False
    triangles: bool = False
    truncation: bool = False
    bound: bool = False
    corners: bool = False
    marks: bool = False

    @classmethod
    def only(cls, *names: str) -> Printed:
        """These statements as printed, the others corrected.  Raises ValueError for an unknown name."""
        unknown = [name for name in names if name not in NAMES]
        if unknown:
            raise ValueError(f"{unknown[0]!r} is not one of {', '.join(NAMES)}")
        return cls(**dict.fromkeys(names, True))

    def names(self) -> tuple[str, ...]:
        """The statements taken as printed."""
        return tuple(name for name in NAMES if getattr(self, name))


NAMES = tuple(field.name for field in fields(Printed))
LITERAL = Printed.only(*NAMES)
