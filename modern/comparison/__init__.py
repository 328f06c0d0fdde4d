"""Compare the hulls that different routes determine for the same points with the exact hull."""
