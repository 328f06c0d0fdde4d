"""What programs of the time hold that this FORTRAN has not: statements, functions and fields of its neighbours.

They are recognised so that a message can say what they are.  Sources: the statements of 1620 FORTRAN II (C26-5876), of
FORTRAN II-D with its Monitor (C26-5774) and of GOTRAN (C26-5594); FORTRAN IV as its standard of 1966 has it.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from emulator.language import tree


@dataclass(frozen=True, slots=True)
class Word:
    """A statement of another FORTRAN: how a message calls it, whose it is, and what to do instead.

    ``opens``: the cards after it, up to an END, belong to it.  ``declares``: its names may be arrays, functions or of
    the other mode, so that what uses them cannot be judged; ``(`` for those alone that a parenthesis follows.
    ``number`` is IBM's error type, where one fits.
    """

    name: str
    of: str
    instead: str
    opens: bool = False
    declares: str = ""
    number: int = 0

    @property
    def message(self) -> str:
        return f"{self.name} belongs to {self.of}; {self.instead}"


_II, _IV, _II_D = "FORTRAN II", "FORTRAN IV", "FORTRAN II-D"
_DECK = "a deck is one program here, and the cards from this one to its END are not looked at"
_WHOLE = "leave it out: all names belong to one program, and arrays are named by DIMENSION"
_TYPE = "leave it out: names that begin with I to N are fixed point, all others floating"
_FORMAT = "give the number of a FORMAT after the verb, as in READ 5, A, B"
_DEVICE = "here the verb names the device, as in READ 5, A, B or PUNCH 6, A"
_TAPE = "the machine here reads and punches cards: READ, PUNCH"
_DISK = "the machine here has no disk"
_MODES = "(?:REAL|INTEGER|LOGICAL|COMPLEX|DOUBLEPRECISION)"

_STATEMENTS: tuple[tuple[str, Word], ...] = (
    ("SUBROUTINE[A-Z]", Word("SUBROUTINE", _II, _DECK, opens=True)),
    (f"{_MODES}?FUNCTION[A-Z]", Word("FUNCTION", _II, _DECK, opens=True, declares="(")),
    ("BLOCKDATA", Word("BLOCK DATA", _IV, _DECK, opens=True)),
    ("CALL[A-Z]", Word("CALL", _II, "put the statements of the subprogram in its place; CALL EXIT is STOP")),
    ("RETURN$", Word("RETURN", _II, "leave a part of the program by GO TO")),
    ("COMMON", Word("COMMON", _II, _WHOLE, declares="(")),
    ("EQUIVALENCE", Word("EQUIVALENCE", _II, "give what shares a place one name")),
    ("EXTERNAL[A-Z]", Word("EXTERNAL", _IV, "there are no subprograms to be handed on", declares="all")),
    ("ENTRY[A-Z]", Word("ENTRY", _IV, "there are no subprograms")),
    (_MODES + r"(\*\d)?[A-Z]", Word("a declaration of types", _IV, _TYPE, declares="all")),
    ("IMPLICIT", Word("IMPLICIT", _IV, _TYPE)),
    ("DATA[(A-Z]", Word("DATA", _IV, "give variables their first values by assignments or from cards")),
    ("NAMELIST", Word("NAMELIST", _IV, _FORMAT)),
    ("PROGRAM[A-Z]", Word("PROGRAM", _IV, "leave it out: a program has no name here")),
    (r"ASSIGN\d", Word("ASSIGN", _II, "set a variable and use GO TO (n1, n2, ...), i")),
    ("GOTO[A-Z]", Word("GO TO to an assigned number", _II, "set a variable and use GO TO (n1, n2, ...), i")),
    (r"IF\(SENSELIGHT|SENSELIGHT", Word("SENSE LIGHT", _II, "use a variable: the 1620 has no sense lights")),
    (
        "IF(ACCUMULATOR|QUOTIENT)OVERFLOW|IFDIVIDECHECK",
        Word("a test of overflow", _II, "the machine here notes overflows and goes on with the largest number"),
    ),
    (r"IF\(", Word("a logical IF", _IV, "write IF (A-B) n1, n2, n3 for less, equal, greater")),
    ("FREQUENCY", Word("FREQUENCY", "the FORTRAN of the 704", "leave it out")),
    ("(ACCEPT|PUNCH|READ|TYPE)TAPE", Word("input and output by paper tape", "machines with a tape reader", _TAPE)),
    (
        "(READ|WRITE)(INPUT|OUTPUT)?TAPE|WRITEDRUM|READDRUM|REWIND|BACKSPACE|ENDFILE",
        Word("magnetic tape", "the FORTRAN of larger machines", _TAPE),
    ),
    ("DEFINE(DISK|FILE)|RECORD|FETCH|FIND", Word("the disk", _II_D, _DISK)),
    (r"(READ|WRITE|PRINT|PUNCH|TYPE)\(|WRITE", Word("input and output by a unit's number", _IV, _DEVICE)),
    ("REREAD", Word("REREAD", "later compilers", "read the card once, by a FORMAT that fits it")),
    (
        "(READ|ACCEPT|PUNCH|PRINT|TYPE)[,*A-Z]",
        Word("input and output without a FORMAT", "GOTRAN and FORTRAN without FORMAT", _FORMAT, number=13),
    ),
    (r"\*", Word("a control card", "the monitor of FORTRAN II-D or of another compiler", "leave it out")),
    (r"\$", Word("a control card", "a monitor", "leave it out")),
)
_KINDS = {"unknown", "input_output", "go_to", "if", "assignment"}
_COMPILED = tuple((re.compile(pattern), word) for pattern, word in _STATEMENTS)
_LOGIC = re.compile(r"\.(EQ|NE|LT|LE|GT|GE|AND|OR|NOT|TRUE|FALSE)\.")
_LOGICAL = Word("a logical expression", _IV, "write IF (A-B) n1, n2, n3 for less, equal, greater")
LATER = (*(word for _, word in _STATEMENTS), _LOGICAL)
"""Every statement that :func:`word_of` knows."""
STATEMENT_FUNCTION = Word("a statement function", _II, "write its expression where it is used")

_INSTEAD = {
    "IF (X) n1, n2, n2 and, at n1, X=-X": ("ABS", "XABS", "IABS", "DABS"),
    "LOG": ("ALOG", "DLOG", "LN", "LOGE"),
    "LOG(X)/2.3025851": ("ALOG10", "LOG10", "LOGTEN"),
    "ATAN": ("ARCTAN", "ATN", "ARTAN", "ARCTN"),
    "ATAN(X/SQRT(1.-X*X))": ("ASIN", "ARSIN", "ARCSIN"),
    "SIN(X)/COS(X)": ("TAN",),
    "SQRT": ("SQR", "SQROOT", "DSQRT"),
    "(EXP(X)-EXP(-X))/2. and its like": ("SINH", "COSH", "TANH"),
    "A=I": ("FLOAT", "DFLOAT"),
    "I=A": ("FIX", "IFIX", "XFIX", "INT", "XINT", "AINT", "IDINT"),
    "N-N/M*M": ("MOD", "XMOD", "AMOD"),
    "IF (A-B) n1, n2, n3": ("SIGN", "ISIGN", "XSIGN", "DIM", "IDIM", "XDIM", "AMAX1", "AMIN1", "MAX0", "MIN0"),
}
"""What this FORTRAN has for a function of the others."""
_BY_NAME = {name: instead for instead, names in _INSTEAD.items() for name in names}

FIELDS = {
    "A": "an A field, for text, belongs to FORTRAN II and later; numbers alone are read here, text is punched by H",
    "G": "a G field belongs to FORTRAN IV; use E or F",
    "D": "a D field belongs to FORTRAN IV, for double precision; use E",
    "O": "an O field, for octal numbers, belongs to FORTRAN IV; use I",
    "L": "an L field, for true and false, belongs to FORTRAN IV; use I",
    "P": "a scale factor belongs to FORTRAN IV; use E or F alone",
    "T": "a T field belongs to FORTRAN IV; use X",
    "'": "text in quotes belongs to FORTRAN IV; use H",
}
"""Letters of a FORMAT's specification that other compilers take, with what a message says of each."""


def word_of(kind: str, text: str) -> Word | None:
    """The statement of another FORTRAN that a text (without number and blanks) is; ``kind`` as ``classify`` has it.

    Asked only of statements that do not parse.
    """
    if kind not in _KINDS:
        return None
    if kind == "assignment" and not text.startswith("IF("):
        return _LOGICAL if _LOGIC.search(text) else None
    for pattern, word in _COMPILED:
        if pattern.match(text):
            return word if word.name != "a logical IF" or _is_logical(text) else None
    return None


def _is_logical(text: str) -> bool:
    """Whether an IF is followed by a statement, or asks by an operator between points."""
    if _LOGIC.search(text):
        return True
    depth = 0
    for at, char in enumerate(text):
        depth += (char == "(") - (char == ")")
        if char == ")" and depth == 0:
            return text[at + 1 : at + 2].isalpha()
    return False


def declared(word: Word, text: str) -> frozenset[str]:
    """The names that a statement makes something this FORTRAN has no means for."""
    if not word.declares:
        return frozenset()
    rest = re.sub(rf"^(COMMON(/\w*/)?|EXTERNAL|{_MODES}?(\*\d)?(FUNCTION)?)", "", text)
    after = r"(?=\()" if word.declares == "(" else ""
    return frozenset(re.findall(rf"[A-Z][A-Z0-9]*{after}", rest))


def advice(name: str, library: Sequence[str]) -> str:
    """What to say of a name with arguments that is no array: which functions there are, and which may be meant."""
    known = f"the functions are {', '.join(library[:-1])} and {library[-1]}"
    bare = name.removesuffix("F")
    instead = _BY_NAME.get(name) or _BY_NAME.get(bare)
    if instead:
        return f"{known}; for {name} write {instead}"
    from difflib import get_close_matches

    close = get_close_matches(bare, library, 1, 0.7) if len(bare) > 2 else []
    return f"{known}; is {close[0]} meant?" if close else known


_PARTS: dict[type[object], tuple[str, ...]] = {
    node: tuple(name for name in node.__slots__ if name != "place")
    for node in (
        *(tree.Power, tree.Product, tree.Sum, tree.Reference),
        *(tree.Assignment, tree.ComputedGoTo, tree.If, tree.Do, tree.InputOutput, tree.Loop),
    )
}
"""The nodes that hold names, and their parts."""


def references(node: object) -> list[tree.Reference]:
    """Every name in a statement or a part of one, but for those a DIMENSION gives, in order."""
    found: list[tree.Reference] = []
    _collect(node, found)
    return found


def _collect(node: object, found: list[tree.Reference]) -> None:
    if isinstance(node, tuple):
        for part in node:
            _collect(part, found)
        return
    parts = _PARTS.get(type(node))
    if parts is None:
        return
    if isinstance(node, tree.Reference):
        found.append(node)
    for name in parts:
        _collect(getattr(node, name), found)
