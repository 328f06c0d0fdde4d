"""The hull of a polyhedron from its convex edges (Appel & Will 1976), exactly.

A. Appel and P. M. Will, "Determining the Three-dimensional Convex Hull of a Polyhedron", received 1975.
``appel_will(points)`` projects the points parallel to every pair of them, keeps the pairs whose image is outside of
the others' star polygon, and assembles these convex edges to the loops that bound the faces.
"""

from modern.papers.appel_will.corners import RULES
from modern.papers.appel_will.hull import CORRECTED, LITERAL, PRINTED, Assembled, Method, appel_will, printed
from modern.papers.appel_will.surfaces import MapError

__all__ = ["CORRECTED", "LITERAL", "PRINTED", "RULES", "Assembled", "MapError", "Method", "appel_will", "printed"]
