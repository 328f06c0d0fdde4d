"""Nakamae and Nishita's algorithm (1972): hidden line elimination for scenes of convex polyhedra.

An object consists of convex polyhedra that may touch. Their faces are classified as front or back faces
(``modern.drawing.visible``), their contours are compared in pairs (``contours``, ``nearness``), and the parts of edges
behind a nearer contour are found by counting intersections (``crossings``, ``hidden``). All decisions are made in
integers.

References
----------
E. Nakamae and T. Nishita, "An Algorithm for Hidden Line Elimination of Polyhedra", Hiroshima University; in Japanese
in Joho-Shori 13, No. 4 (1972), p. 239-246.
"""
