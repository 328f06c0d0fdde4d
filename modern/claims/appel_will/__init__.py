"""Checks of statements of Appel and Will (1976).

What a check decides stands in the rows of ``transcripts/statements/appel-will.toml`` that its decorator names.
"""
