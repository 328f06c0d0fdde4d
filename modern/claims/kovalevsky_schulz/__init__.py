"""Checks of statements of Kovalevsky and Schulz.

The decorator of a check names rows of ``transcripts/statements/kovalevsky-schulz.toml``, which say what the check
computes. The field ``condition`` or ``fails`` of such a row describes the counterexample.
"""
