"""Checks of statements of the thesis (K. J. Butler, 1963), by chapter."""
