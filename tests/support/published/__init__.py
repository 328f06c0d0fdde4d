"""The published vectors: their rules in fractions, and their lines.  Nothing of ``emulator`` is used here."""
