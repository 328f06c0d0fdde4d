"""Yau and Srihari, "Digital convex hulls from hierarchical data structures": octrees in, octrees out.

``octree_hull(volume)`` follows the paper step by step; ``Printed`` says which of its statements are taken as printed
where the print is wrong.
"""

from modern.papers.yau_srihari.hull import OctreeHull, octree_hull
from modern.papers.yau_srihari.printed import Printed

__all__ = ["OctreeHull", "Printed", "octree_hull"]
