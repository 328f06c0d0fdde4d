"""Appel and Will's algorithm (1976): the hull of a polyhedron from its convex edges, in exact arithmetic.

For each pair of points, ``appel_will(points)`` projects all points parallel to the line through the pair. The line
then has a point C as its image. The pair is a *convex edge*, an edge of the hull, if C is outside the *star polygon*,
which joins the other images in order of their angle about C. The convex edges are then assembled into loops, and each
loop bounds a face of the hull.

References
----------
A. Appel and P. M. Will, "Determining the Three-dimensional Convex Hull of a Polyhedron", received 1975.
"""

from modern.papers.appel_will.corners import RULES
from modern.papers.appel_will.hull import CORRECTED, PRINTED, Assembled, Method, appel_will, printed
from modern.papers.appel_will.surfaces import MapError

__all__ = ["CORRECTED", "PRINTED", "RULES", "Assembled", "MapError", "Method", "appel_will", "printed"]
