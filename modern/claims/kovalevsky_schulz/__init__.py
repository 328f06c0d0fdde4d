"""Checks of statements of Kovalevsky and Schulz.

What a check computes stands in the rows of ``transcripts/statements/kovalevsky-schulz.toml`` that its decorator names.
The field ``condition`` or ``fails`` describes the counterexample.
"""
