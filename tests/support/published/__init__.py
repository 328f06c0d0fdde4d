"""The published vectors: rules in fractions, operands and lines.  Nothing of ``emulator`` is used here."""
