"""The statements of Yau and Srihari's paper that are wrong as printed, with their corrections.

``octree-hull --printed NAME`` applies a statement as printed and shows the effect.
"""

from dataclasses import dataclass, fields

from emulator.errors import quoted


@dataclass(frozen=True, slots=True)
class Printed:
    """Selects statements of the paper to apply as printed, although wrong.  By default all are corrected.

    angle
        Theorem 2 chooses the face with the greatest angle between outward normals. The supporting plane is the one
        with the least angle.
    start
        Section 5 starts from one upright face over each edge of H(A). Points of the floor may lie lower above the
        inside of such an edge, so every edge of the lower chain of the points above it needs an upright face.
    triangles
        Section 4.6 assumes that all faces are triangles. If four or more extreme points lie in one supporting plane,
        triangles chosen edge by edge overlap. The face is the polygon of all of these points.
    truncation
        Section 5 enters the truncated height of a face. The least digital point on or above the face is its height
        rounded up.
    bound
        Section 4.6.2 takes both bounds of the angle over a square at z = max, which fits the greatest angle. The least
        angle needs z = min, the value that a node of the floor tree holds. A corner below the plane of the known face,
        where no point can be, counts as lying on it.
    corners
        Section 4.6.2 takes the extrema over a square at its corners. This holds only if the whole square lies beyond
        the edge. A square that the edge's line crosses has to be divided.
    marks
        Section 5 marks every digital point of a face and searches only unmarked points. The vertices of a face are
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
    def only(cls, *names: str) -> "Printed":
        """Return options that apply the named statements as printed.  Raise ValueError for an unknown name."""
        unknown = [name for name in names if name not in NAMES]
        if unknown:
            raise ValueError(f"{quoted(unknown[0])} is not one of {', '.join(NAMES)}")
        return cls(**dict.fromkeys(names, True))

    def names(self) -> tuple[str, ...]:
        """Return the names of the statements that are applied as printed."""
        return tuple(name for name in NAMES if getattr(self, name))


NAMES = tuple(field.name for field in fields(Printed))
LITERAL = Printed.only(*NAMES)
