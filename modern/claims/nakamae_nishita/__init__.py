"""Checks of statements of Nakamae and Nishita (1972)."""
