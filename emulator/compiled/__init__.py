"""The same object code over many decks: a kernel in integers, compiled by numba."""
