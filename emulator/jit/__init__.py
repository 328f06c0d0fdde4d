"""Functions compiled by numba, which both packages use."""
