"""What the tests share: decks and sets at random, judges of their own, calls of the command line, paths."""
