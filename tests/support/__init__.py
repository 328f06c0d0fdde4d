"""Helpers that tests share: random decks and sets, independent judges, calls of commands, and paths."""
