"""Hidden lines of convex polyhedra: E. Nakamae and T. Nishita, "An Algorithm for Hidden Line Elimination of Polyhedra"
(Hiroshima University; in Japanese in Joho-Shori 13, No. 4 (1972), p. 239-246).

An object is made of convex polyhedra that may touch.  Their faces are seen or turned away
(``modern.drawing.visible``), their contours are compared in pairs (``contours``, ``nearness``), and the parts of edges
that lie behind a nearer contour are found by counting (``crossings``, ``hidden``).  Everything that is decided is
decided in integers.
"""
