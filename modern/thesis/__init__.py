"""Butler's data decks and jobs: program 1, then program 2 or 3, and the hull read back from cards."""
