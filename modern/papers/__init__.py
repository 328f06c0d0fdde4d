"""The later papers, one folder each: what they describe, exactly, with their published results."""
