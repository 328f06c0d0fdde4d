"""Checks of statements of Appel and Will (1976)."""
