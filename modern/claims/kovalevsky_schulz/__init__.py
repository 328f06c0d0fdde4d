"""Checks of statements of Kovalevsky and Schulz."""
