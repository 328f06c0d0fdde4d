"""Convex hulls: Butler's procedure over any arithmetic, an exact judge, comparison, studies, the edition.

:mod:`hull1620` lists the public names.
"""

# Part of the distribution hull1620.
