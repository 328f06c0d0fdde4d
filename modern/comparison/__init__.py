"""Compare hulls of the same points that were computed in different ways, above all with the exact hull."""
