"""A hull and its parts as data, the surface they make, and the exact numbers of both."""
