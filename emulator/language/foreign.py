"""Statements, functions and FORMAT codes of other FORTRANs, recognised so that a message can explain them.

Sources: the statements of 1620 FORTRAN II (C26-5876), of FORTRAN II-D with its Monitor (C26-5774) and of GOTRAN
(C26-5594), and FORTRAN IV as defined by its standard of 1966.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from emulator.language import tree
from emulator.language.cards import RECORD_MARK


@dataclass(frozen=True, slots=True)
class ForeignStatement:
    """A statement of another FORTRAN: its name in messages, the language it belongs to, and a replacement for it.

    ``has_body`` is True if the cards after the statement, up to an END, belong to it.  ``declares`` tells which of its
    names the statement may declare as arrays, as functions or with a type.  The value ``all`` stands for all names,
    ``(`` for the names that a parenthesis follows, and an empty text for none.  Other statements that use a declared
    name cannot be checked.  ``number`` is IBM's error type, or 0.
    """

    name: str
    origin: str
    replacement: str
    has_body: bool = False
    declares: str = ""
    number: int = 0

    @property
    def message(self) -> str:
        return f"{self.name} belongs to {self.origin}; {self.replacement}"


_II, _IV, _II_D = "FORTRAN II", "FORTRAN IV", "FORTRAN II-D"
_DECK = "in this dialect a deck is one program, so the cards from this one to its END are skipped"
_WHOLE = "leave it out: all names belong to one program, and DIMENSION declares the arrays"
_TYPE = "leave it out: names that begin with I to N are fixed point, all others floating"
_FORMAT = "give the number of a FORMAT after the verb, as in READ 5, A, B"
_DEVICE = "in this dialect the verb names the device, as in READ 5, A, B or PUNCH 6, A"
_TAPE = "the emulated 1620 has no tape; read and punch cards with READ and PUNCH"
_COMPARE = (
    "write IF (A-B) n1, n2, n3, which branches to n1 if A is less than B, n2 if they are equal, n3 if A is greater"
)
_DISK = "the emulated 1620 has no disk"
_MODES = "(?:REAL|INTEGER|LOGICAL|COMPLEX|DOUBLEPRECISION)"

_STATEMENTS: tuple[tuple[str, ForeignStatement], ...] = (
    ("SUBROUTINE[A-Z]", ForeignStatement("SUBROUTINE", _II, _DECK, has_body=True)),
    (f"{_MODES}?FUNCTION[A-Z]", ForeignStatement("FUNCTION", _II, _DECK, has_body=True, declares="(")),
    ("BLOCKDATA", ForeignStatement("BLOCK DATA", _IV, _DECK, has_body=True)),
    (
        "CALL[A-Z]",
        ForeignStatement("CALL", _II, "put the statements of the subprogram in its place; CALL EXIT is STOP"),
    ),
    (
        "RETURN$",
        ForeignStatement("RETURN", _II, "use GO TO: the statements of the subprogram become part of the program"),
    ),
    ("COMMON", ForeignStatement("COMMON", _II, _WHOLE, declares="(")),
    ("EQUIVALENCE", ForeignStatement("EQUIVALENCE", _II, "use the same name for all quantities that share storage")),
    (
        "EXTERNAL[A-Z]",
        ForeignStatement("EXTERNAL", _IV, "there are no subprograms to pass as arguments", declares="all"),
    ),
    ("ENTRY[A-Z]", ForeignStatement("ENTRY", _IV, "there are no subprograms")),
    (_MODES + r"(\*\d)?[A-Z]", ForeignStatement("a declaration of types", _IV, _TYPE, declares="all")),
    ("IMPLICIT", ForeignStatement("IMPLICIT", _IV, _TYPE)),
    ("DATA[(A-Z]", ForeignStatement("DATA", _IV, "give variables their first values by assignments or from cards")),
    ("NAMELIST", ForeignStatement("NAMELIST", _IV, _FORMAT)),
    ("PROGRAM[A-Z]", ForeignStatement("PROGRAM", _IV, "leave it out: a program of this dialect has no name")),
    (r"ASSIGN\d", ForeignStatement("ASSIGN", _II, "set a variable and use GO TO (n1, n2, ...), i")),
    (
        "GOTO[A-Z]",
        ForeignStatement("GO TO to an assigned number", _II, "set a variable and use GO TO (n1, n2, ...), i"),
    ),
    (
        r"IF\(SENSELIGHT|SENSELIGHT",
        ForeignStatement("SENSE LIGHT", _II, "use a variable: the 1620 has no sense lights"),
    ),
    (
        "IF(ACCUMULATOR|QUOTIENT)OVERFLOW|IFDIVIDECHECK",
        ForeignStatement(
            "a test of overflow", _II, "the emulated 1620 reports overflows and continues with the largest number"
        ),
    ),
    (r"IF\(", ForeignStatement("a logical IF", _IV, _COMPARE)),
    ("FREQUENCY", ForeignStatement("FREQUENCY", "the FORTRAN of the 704", "leave it out")),
    (
        "(ACCEPT|PUNCH|READ|TYPE)TAPE",
        ForeignStatement("input and output by paper tape", "machines with a tape reader", _TAPE),
    ),
    (
        "(READ|WRITE)(INPUT|OUTPUT)?TAPE|WRITEDRUM|READDRUM|REWIND|BACKSPACE|ENDFILE",
        ForeignStatement("magnetic tape", "the FORTRAN of larger machines", _TAPE),
    ),
    ("DEFINE(DISK|FILE)|RECORD|FETCH|FIND", ForeignStatement("the disk", _II_D, _DISK)),
    (r"(READ|WRITE|PRINT|PUNCH|TYPE)\(|WRITE", ForeignStatement("input and output by a unit's number", _IV, _DEVICE)),
    ("REREAD", ForeignStatement("REREAD", "later compilers", "read the card once, with a FORMAT that fits it")),
    (
        "(READ|ACCEPT|PUNCH|PRINT|TYPE)[,*A-Z]",
        ForeignStatement("input and output without a FORMAT", "GOTRAN and FORTRAN without FORMAT", _FORMAT, number=13),
    ),
    (r"\*", ForeignStatement("a control card", "the monitor of FORTRAN II-D or of another compiler", "leave it out")),
    (RECORD_MARK.pattern + "{2}", ForeignStatement("a control card", "the monitor of FORTRAN II-D", "leave it out")),
    (r"\$", ForeignStatement("a control card", "a monitor", "leave it out")),
)
# The kinds that :func:`~emulator.language.statements.classify` may give to a statement of another FORTRAN.
_KINDS = {"unknown", "input_output", "go_to", "if", "assignment"}
_COMPILED = tuple((re.compile(pattern), word) for pattern, word in _STATEMENTS)
_LOGIC = re.compile(r"\.(EQ|NE|LT|LE|GT|GE|AND|OR|NOT|TRUE|FALSE)\.")
_LOGICAL = ForeignStatement("a logical expression", _IV, _COMPARE)
# Every statement that :func:`identify` recognises.
FOREIGN_STATEMENTS = (*(statement for _, statement in _STATEMENTS), _LOGICAL)
STATEMENT_FUNCTION = ForeignStatement("a statement function", _II, "write its expression where it is used")

# The replacement, in this FORTRAN, for functions of other FORTRANs.
_INSTEAD = {
    "IF (X) n1, n2, n2 with X=-X as statement n1 and CONTINUE as n2": ("ABS", "XABS", "IABS", "DABS"),
    "LOG": ("ALOG", "DLOG", "LN", "LOGE"),
    "LOG(X)/2.3025851": ("ALOG10", "LOG10", "LOGTEN"),
    "ATAN": ("ARCTAN", "ATN", "ARTAN", "ARCTN"),
    "ATAN(X/SQRT(1.-X*X))": ("ASIN", "ARSIN", "ARCSIN"),
    "SIN(X)/COS(X)": ("TAN",),
    "SQRT": ("SQR", "SQROOT", "DSQRT"),
    "(EXP(X)-EXP(-X))/2.": ("SINH",),
    "(EXP(X)+EXP(-X))/2.": ("COSH",),
    "(EXP(X)-EXP(-X))/(EXP(X)+EXP(-X))": ("TANH",),
    "A=I": ("FLOAT", "DFLOAT"),
    "I=A": ("FIX", "IFIX", "XFIX", "INT", "XINT", "AINT", "IDINT"),
    "N-N/M*M": ("MOD", "XMOD", "AMOD"),
    "IF (A-B) n1, n2, n3 with an assignment as each of the statements n1, n2 and n3": (
        *("SIGN", "ISIGN", "XSIGN", "DIM", "IDIM", "XDIM"),
        *("AMAX1", "AMIN1", "MAX0", "MIN0"),
    ),
}
_BY_NAME = {name: replacement for replacement, names in _INSTEAD.items() for name in names}

# FORMAT codes of other compilers, each with its message.
FOREIGN_FIELDS = {
    "A": "an A field, for text, belongs to FORTRAN II and later; only numbers are read here, and H punches text",
    "G": "a G field belongs to FORTRAN IV; use E or F",
    "D": "a D field belongs to FORTRAN IV, for double precision; use E",
    "O": "an O field, for octal numbers, belongs to FORTRAN IV; use I",
    "L": "an L field, for true and false, belongs to FORTRAN IV; use I",
    "P": "a scale factor belongs to FORTRAN IV; use E or F alone",
    "T": "a T field belongs to FORTRAN IV; use X",
    "'": "text in quotes belongs to FORTRAN IV; use H",
}


def identify(kind: str, text: str) -> ForeignStatement | None:
    """Return the description of the foreign statement ``text`` (without number and blanks), or None if it is not one.

    Call this only for a statement that does not parse.  ``kind`` is the kind that ``classify`` gave it.
    """
    if kind not in _KINDS:
        return None
    if kind == "assignment" and not text.startswith("IF("):
        return _LOGICAL if _LOGIC.search(text) else None
    for pattern, statement in _COMPILED:
        if pattern.match(text):
            return statement if statement.name != "a logical IF" or _is_logical(text) else None
    return None


def _is_logical(text: str) -> bool:
    """Return True if an IF statement contains a logical operator, or another statement after its condition."""
    if _LOGIC.search(text):
        return True
    depth = 0
    for at, char in enumerate(text):
        depth += (char == "(") - (char == ")")
        if char == ")" and depth == 0:
            return text[at + 1 : at + 2].isalpha()
    return False


def declared_names(statement: ForeignStatement, text: str) -> frozenset[str]:
    """Return the names that a statement of another FORTRAN declares as arrays, functions, integers or reals."""
    if not statement.declares:
        return frozenset()
    rest = re.sub(rf"^(COMMON(/\w*/)?|EXTERNAL|{_MODES}?(\*\d)?(FUNCTION)?)", "", text)
    after = r"(?=\()" if statement.declares == "(" else ""
    return frozenset(re.findall(rf"[A-Z][A-Z0-9]*{after}", rest))


def suggest_function(name: str, library: Sequence[str]) -> str:
    """Return advice about an unknown function: the list of functions, and a replacement or similar name."""
    known = f"the functions are {', '.join(library[:-1])} and {library[-1]}"
    bare = name.removesuffix("F")
    replacement = _BY_NAME.get(name) or _BY_NAME.get(bare)
    if replacement:
        return f"{known}; for {name} write {replacement}"
    from difflib import get_close_matches

    close = get_close_matches(bare, library, 1, 0.7) if len(bare) > 2 else []
    return f"{known}; is {close[0]} meant?" if close else known


# For each kind of node that may contain names, the fields to search.
_PARTS: dict[type[object], tuple[str, ...]] = {
    node: tuple(name for name in node.__slots__ if name != "place")
    for node in (
        *(tree.Power, tree.Product, tree.Sum, tree.Reference),
        *(tree.Assignment, tree.ComputedGoTo, tree.If, tree.Do, tree.InputOutput, tree.Loop),
    )
}


def references(node: object) -> list[tree.Reference]:
    """Return every name used in an expression or statement, in order, except the names that a DIMENSION declares."""
    parts: Iterable[object]
    if isinstance(node, tuple):
        parts = node
    elif names := _PARTS.get(type(node)):
        parts = [getattr(node, name) for name in names]
    else:
        return []
    found = [node] if isinstance(node, tree.Reference) else []
    for part in parts:
        found += references(part)
    return found
