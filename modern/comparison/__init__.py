"""Compare hulls that the programs, the port and other routes determine for the same points with the exact hull."""
