"""Compilation of Python functions by numba, for the compiled engine and for hulls in floating point."""
