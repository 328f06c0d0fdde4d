"""Yau and Srihari's algorithm for the digital convex hull of a voxel solid that is stored as an octree.

``octree_hull(volume)`` follows the paper step by step. The hull lies between two functions of the column (x, y): the
convex envelope of the floor (the lowest voxels) and the concave envelope of the ceiling (the highest voxels).
``Printed`` selects statements to apply as printed although the print is wrong.

References
----------
M.-M. Yau and S. N. Srihari, "Digital Convex Hulls from Hierarchical Data Structures".
"""

from modern.papers.yau_srihari.hull import OctreeHull, octree_hull
from modern.papers.yau_srihari.printed import Printed

__all__ = ["OctreeHull", "Printed", "octree_hull"]
