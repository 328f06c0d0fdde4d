"""Checks of statements of Yau and Srihari."""
