"""Digital solids: voxel volumes, and their convex hulls as volumes again."""
