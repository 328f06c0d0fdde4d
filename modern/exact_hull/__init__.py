"""The exact convex hull of points in 3-space, with a certificate: the judge of every other hull here.

``exact_hull(points)`` works over integers and shares no code with the procedures it judges.  ``certify`` proves a
result from the points alone, by means other than those that built it; ``exact_hull`` never returns an unproved one.
"""

from modern.exact_hull.build import exact_hull
from modern.exact_hull.certificate import certify
from modern.exact_hull.result import Certificate, CertificateError, ExactHull, Facet
from modern.geometry.numbers import PointsError

__all__ = ["Certificate", "CertificateError", "ExactHull", "Facet", "PointsError", "certify", "exact_hull"]
