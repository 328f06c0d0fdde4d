"""The exact convex hull of points in space, with a proof.  The project compares all its other hulls with this one.

``exact_hull(points)`` uses integers and shares no code with the procedures whose hulls are compared with its own.
``certify`` proves a result from the points alone, with code that takes no part in constructing it.  ``exact_hull``
never returns an unproved result.

coordinates                 input as arrays, and as integers with a common scale
facets, surface             construction by random incremental insertion
proposal, kernels           faster construction for many points
planes                      exact signs of planes at points, from a floating-point filter and integers
certificate                 proof by evaluating every plane at every point
convexity, polygons         proof by local convexity, for many points and facets
build                       ``exact_hull``: construct, classify, prove
"""

from modern.exact_hull.build import exact_hull
from modern.exact_hull.certificate import certify
from modern.exact_hull.result import Certificate, CertificateError, ExactHull, Facet
from modern.geometry.numbers import PointsError

__all__ = ["Certificate", "CertificateError", "ExactHull", "Facet", "PointsError", "certify", "exact_hull"]
