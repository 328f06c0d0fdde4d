"""The statements of Yau and Srihari's paper that are wrong as printed, with their corrections.

``octree-hull --printed NAME`` applies a statement as printed and shows the effect.
"""

from dataclasses import dataclass, fields

from emulator.errors import quoted


@dataclass(frozen=True, slots=True)
class Printed:
    """The statements of the paper to apply as printed, although they are wrong. By default all are corrected.

    angle
        Theorem 2 chooses the face with the greatest angle between outward normals. But the face that
        lies in a supporting plane has the least angle.
    start
        Section 5 starts with one upright face above each edge of H(A), the plane hull of the columns' positions (x, y).
        Points of the floor above such an edge may lie below this face. Therefore an upright face is needed at every
        edge of the lower side of the hull of these points.
    triangles
        Section 4.6 assumes that all faces are triangles. If four or more vertices lie in one supporting plane,
        triangles chosen edge by edge may overlap. The face is the polygon of all of these vertices.
    truncation
        Section 5 enters the truncated height of a face into the tree. The height of the lowest digital point on or
        above the face is the height of the face rounded up.
    bound
        Section 4.6.2 computes both bounds of the angle over a square at z = max, which is right for the greatest angle.
        The least angle needs z = min, the value of a node of the floor tree. A corner of the square below the plane of
        the known face, where no point can be, counts as lying in this plane.
    corners
        Section 4.6.2 assumes that the angle is least and greatest at corners of a square. This assumption can fail if a
        part of the square does not lie beyond the edge of the known face. Such a square has to be divided.
    marks
        Section 5 marks every digital point of a face and searches only unmarked points. But the vertices of a face are
        vertices of neighbouring faces too, so they must not be marked.
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
        """Return the object that applies the named statements as printed. Raise ValueError for an unknown name."""
        unknown = [name for name in names if name not in NAMES]
        if unknown:
            raise ValueError(f"{quoted(unknown[0])} is not one of the names {', '.join(NAMES)}")
        return cls(**dict.fromkeys(names, True))

    def names(self) -> tuple[str, ...]:
        """Return the names of the statements that are applied as printed."""
        return tuple(name for name in NAMES if getattr(self, name))


NAMES = tuple(field.name for field in fields(Printed))
LITERAL = Printed.only(*NAMES)
