"""Hulls of one point set by different routes, compared with the exact judge's."""
