"""Yau and Srihari's algorithm for the digital convex hull of a voxel solid that is stored as an octree.

``octree_hull(volume)`` follows the paper step by step. The hull lies between two functions of x and y: the convex
envelope of the floor (the lowest voxel of each column) and the concave envelope of the ceiling (the highest voxel of
each column). ``Printed`` selects statements of the paper that are applied as printed although they are wrong.

References
----------
M.-M. Yau and S. N. Srihari, "Digital Convex Hulls from Hierarchical Data Structures".
"""

from modern.papers.yau_srihari.hull import OctreeHull, octree_hull
from modern.papers.yau_srihari.printed import Printed

__all__ = ["OctreeHull", "Printed", "octree_hull"]
