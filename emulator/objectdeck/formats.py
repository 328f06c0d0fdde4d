"""FORMATs in the object program: words of five digits, which the library interprets.

A control word is the position of a routine of the library, with a flag over its first digit.  The word of a field holds
one digit for the kind, two for the width and two for the decimals, with flags over the first and the last digit.
The deck shows fields, texts, the beginning and the end.  The library's code shows the slash.  It has no word for repeat counts and none for X,
so that a repeated field is written out and X is a text of blanks.
"""

from __future__ import annotations

from emulator.language.formats import FormatSpec, Literal, Slash
from emulator.objectdeck.digits import BRANCH, FLAGGED, address, flagged, flagged_alphameric
from emulator.objectdeck.library import FORMAT_BEGIN, FORMAT_END, FORMAT_SLASH, FORMAT_TEXT

# The second digit of the letter's code.
_KINDS = {"E": "5", "F": "6", "I": "9"}


def format_text(spec: FormatSpec, after: int) -> str:
    """Return a FORMAT with the branch around it.  ``after`` is the position of the branch to the next statement."""
    words = [BRANCH + address(after), address(FORMAT_BEGIN)]
    for index, part in enumerate(spec.specs):
        # A list that is longer than the FORMAT continues at the word of the last parenthesis.
        if index and index == spec.again:
            words.append(address(FORMAT_BEGIN))
        if isinstance(part, Slash):
            words.append(address(FORMAT_SLASH))
        elif isinstance(part, Literal):
            words += _texts(part.text)
        else:
            decimals = f"{part.decimals:02d}"
            words.append(f"{flagged(_KINDS[part.kind])}{part.width:02d}{decimals[0]}{FLAGGED[int(decimals[1])]}")
    return "".join([*words, address(FORMAT_END)])


def _texts(text: str) -> list[str]:
    """Return the words of a text, whose length has two digits."""
    pieces = [text[start : start + 99] for start in range(0, len(text), 99)]
    return [address(FORMAT_TEXT) + flagged(f"{len(piece):02d}") + flagged_alphameric(piece) for piece in pieces]
