"""Data: what the thesis prints in its examples, as witness, apparatus and corrected card images.  No logic."""

# Part of the distribution hull1620.
