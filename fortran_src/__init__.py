"""Data: the witness of the thesis's listings, its apparatus, and the decks built from them.  No logic."""

# Part of the distribution hull1620.
