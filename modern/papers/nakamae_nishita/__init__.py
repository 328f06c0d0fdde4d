"""Nakamae and Nishita's algorithm (1972): hidden line elimination for scenes of convex polyhedra.

An object consists of convex polyhedra that may touch. ``modern.drawing.visible`` classifies their faces as front or
back faces. ``contours`` and ``nearness`` compare the contours of the polyhedra in pairs. ``crossings`` and ``hidden``
find the parts of edges behind a nearer contour by counting intersections. All decisions are made in integers.

References
----------
E. Nakamae and T. Nishita, "An Algorithm for Hidden Line Elimination of Polyhedra", Hiroshima University; in Japanese
in Joho-Shori 13, No. 4 (1972), p. 239-246.
"""
