"""Run Butler's three programs on data decks and read the hull from the punched cards."""
