"""The later papers, one folder each: what they describe, exactly, with their published results."""

from collections.abc import Mapping, Sequence

Lines = Mapping[str, Sequence[str]]
"""Lines printed or produced, by the id of the result they are; words separated by blanks.

The module ``results`` of a paper has a function ``produced(printed: Lines) -> Lines``: it is given the corrected lines
of the print and returns, for every result that can be computed, one line for each line of the print.
"""
