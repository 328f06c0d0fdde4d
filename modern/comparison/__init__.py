"""Hulls of one point set by different routes, held against the exact judge."""
