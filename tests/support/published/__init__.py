"""The published vectors: rules in fractions, operands, lines. Nothing of ``emulator`` is used here."""
