"""Polyhedra from elsewhere: an OFF file, and every hull of this project."""

from __future__ import annotations

from pathlib import PurePath

from modern.formats.off import OffMesh
from modern.geometry.hull import Hull
from modern.geometry.mesh import mesh
from modern.geometry.numbers import coordinates
from modern.papers.nakamae_nishita.polyhedron import Polyhedron, SceneError, checked


def polyhedron_of_off(found: OffMesh) -> Polyhedron:
    """The convex polyhedron of an OFF file, its faces all clockwise or all counterclockwise from outside.

    Raises SceneError where it is not closed or not convex.
    """
    if not found.faces:
        raise SceneError(f"{found.source}: there are no faces, only points")
    points = tuple(coordinates(point) for point in found.points)
    return checked(Polyhedron(found.source, points, found.faces))


def polyhedron_of_hull(hull: Hull, name: str = "hull") -> Polyhedron:
    """The polyhedron of a hull; of a polygon a plate.

    Raises ExportError where there is no hull, SceneError for one of less than two dimensions and for one whose faces,
    in rounded arithmetic, are not plane or not convex.
    """
    surface = mesh(hull)
    if surface.dimension < 2:
        raise SceneError(f"{name}: a {('point', 'segment')[surface.dimension]} is no polyhedron")
    faces = tuple(face[::-1] for face in surface.faces)
    if surface.dimension == 2:
        faces = (faces[0], surface.faces[0])
    return checked(Polyhedron(PurePath(name).name, surface.numbers(), faces))
