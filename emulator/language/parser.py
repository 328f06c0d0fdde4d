"""The parser: it converts statements to the syntax tree, with the LALR grammar in ``dialect.lark``."""

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from importlib.resources import files
from itertools import dropwhile, takewhile
from typing import Any

from lark import Lark, Token, Tree, UnexpectedCharacters, UnexpectedInput, UnexpectedToken

from emulator.errors import Diagnostic, Refused
from emulator.language import tree
from emulator.language.cards import COLUMNS, RECORD_MARKS, Card, Deck
from emulator.language.foreign import STATEMENT_FUNCTION, ForeignStatement, declared_names, identify
from emulator.language.statements import (
    LAST_COLUMN,
    Source,
    is_comment,
    is_control_card,
    may_be_comment,
    resembles_statement,
    sources,
    statement_columns,
)

# For each rule of the grammar: the form of the statement in messages, and IBM's error type (C26-5619 p. 56), or 0.
_FORMS = {
    "assignment": ("variable = expression", 0),
    "go_to": ("GO TO n", 0),
    "computed_go_to": ("GO TO (n1, n2, ...), i", 0),
    "if": ("IF (expression) n1, n2, n3", 0),
    "if_switch": ("IF (SENSE SWITCH n) n1, n2", 7),
    "do": ("DO n i = m1, m2, m3", 8),
    "continue": ("CONTINUE", 0),
    "pause": ("PAUSE", 0),
    "stop": ("STOP", 0),
    "end": ("END", 0),
    "dimension": ("DIMENSION v(d), v(d1, d2), ...", 9),
    "input_output": ("READ n, list (or PUNCH, PRINT, TYPE, ACCEPT)", 13),
}

MAX_NESTING = 60
# The longest statement in characters, without blanks: its object code would fill the largest machine.
MAX_LENGTH = 20_000
# Characters that suggest that columns 73 to 80 hold part of a statement and not an identification.
_CODE = re.compile(r"[=+*/(),]")
_FORMAT_LIKE = re.compile(r"FO[A-Z]*\(")


@dataclass(frozen=True, slots=True)
class Parsed:
    """The result of parsing a deck: the statements that parse, and a message for each statement that does not.

    ``refused`` holds the statement numbers of the statements that do not parse.  ``foreign_names`` holds the names that
    statements of another FORTRAN declare as arrays or functions.  Statements that use these names cannot be checked.
    ``data`` holds the data cards: those after END, without blank cards at their beginning, and before the first control
    card of an operating system.
    """

    statements: tuple[tree.Statement, ...]
    diagnostics: tuple[Diagnostic, ...]
    refused: frozenset[str] = frozenset()
    foreign_names: frozenset[str] = frozenset()
    data: tuple[Card, ...] = ()


def parse(deck: Deck) -> Parsed:
    """Parse every statement of ``deck``.  For a statement that does not parse, add a Diagnostic and continue."""
    statements: list[tree.Statement] = []
    diagnostics: list[Diagnostic] = []
    labels: set[str] = set()
    foreign_names: set[str] = set()
    data: tuple[Card, ...] = ()
    in_subprogram = False
    end: Card | None = None
    for source in sources(deck):
        # The cards of a subprogram are skipped up to its END.
        if in_subprogram:
            in_subprogram = source.kind != "end"
            end = source.cards[-1] if end and not in_subprogram else end
            continue
        foreign = identify(source.kind, source.text) if end else None
        # The statement after END is data unless it begins a subprogram.
        if end and not (foreign and foreign.has_body):
            after = dropwhile(lambda card: not card.text, deck.cards[end.number :])
            data = tuple(takewhile(lambda card: not is_control_card(card), after))
            diagnostics.extend(_data_warnings(deck, end, data))
            break
        end = source.cards[-1] if source.kind == "end" else end
        diagnostics.extend(_column_warnings(source))
        try:
            statements.append(parse_statement(source))
        except Refused as refused:
            if may_be_comment(source):
                diagnostics.append(_taken_as_comment(source.cards[0], refused.diagnostic.message))
                continue
            # A statement that does not parse may belong to another FORTRAN, which gives a better message.
            labels.add(source.label.lstrip("0"))
            foreign = identify(source.kind, source.text)
            if foreign is None:
                diagnostics.append(refused.diagnostic)
                continue
            diagnostics.append(_foreign_message(source.place, foreign))
            foreign_names |= declared_names(foreign, source.text)
            in_subprogram = foreign.has_body
    # An assignment to F(X) without a DIMENSION for F defines a statement function, which this FORTRAN does not have.
    arrays = {name for s in statements if isinstance(s.body, tree.Dimension) for name, _, _ in s.body.arrays}
    for statement in statements:
        if name := _statement_function(statement.body, arrays):
            diagnostics.append(_foreign_message(statement.place, STATEMENT_FUNCTION))
            foreign_names.add(name)
    statements = [s for s in statements if not _statement_function(s.body, arrays)]
    for card in deck.cards[: end.number if end else None]:
        if is_comment(card) and resembles_statement(card):
            diagnostics.append(_taken_as_comment(card, "it begins like a statement"))
    return Parsed(tuple(statements), tuple(diagnostics), frozenset(labels), frozenset(foreign_names), data)


def _data_warnings(deck: Deck, end: Card, data: Sequence[Card]) -> Iterator[Diagnostic]:
    """Yield a warning about the data cards after END, and one about the first control card after END."""
    if data:
        message = f"cards {data[0].number} to {data[-1].number} follow END: they are data and are not compiled"
        yield Diagnostic(data[0].number, 0, message, warning=True, about="END")
    control = next(filter(is_control_card, deck.cards[end.number :]), None)
    if control:
        message = "a control card of a monitor follows END; neither it nor the cards after it are read"
        yield Diagnostic(control.number, 0, message, warning=True, about="END of the job")


def _column_warnings(source: Source) -> Iterator[Diagnostic]:
    """Yield warnings about punches in columns that other compilers would read differently or would ignore."""
    first = source.cards[0]
    if source.label and not first.columns(1, 5).strip() and first.columns(6, 6).isdigit():
        what = f"statement number {source.label} begins in column 6, where other compilers expect a continuation mark"
        yield Diagnostic(first.number, 6, what, warning=True, about="column 6")
    not_read = "columns 73 to 80 hold the identification of the card and are not read"
    for card in source.cards:
        if " " not in card.columns(72, 73):
            what = f"{not_read}, but a punch in column 72 suggests that the statement continues there"
            yield Diagnostic(card.number, 73, what, warning=True, about="identification")
        elif _CODE.search(card.columns(73, COLUMNS)):
            what = f"{not_read}, but they look like a part of the statement"
            yield Diagnostic(card.number, 73, what, warning=True, about="code")


def _foreign_message(place: tree.Place, foreign: ForeignStatement) -> Diagnostic:
    return Diagnostic(place.card, place.column, foreign.message, foreign.number, about=f"word {foreign.name}")


def _statement_function(body: tree.Body, arrays: Collection[str]) -> str:
    """Return the name of the function that an assignment such as ``F(X) = X+1.`` defines, or an empty string.

    All arguments must be names, one of them of a floating-point variable: ``F(X)`` then cannot be an array element,
    because subscripts are fixed point.
    """
    if not isinstance(body, tree.Assignment) or not body.target.arguments or body.target.name in arrays:
        return ""
    names = [a.name for a in body.target.arguments if isinstance(a, tree.Reference) and not a.arguments]
    floating = any(name[0] not in "IJKLMN" for name in names)
    return body.target.name if floating and len(names) == len(body.target.arguments) else ""


def _taken_as_comment(card: Card, why: str) -> Diagnostic:
    return Diagnostic(card.number, 1, f"taken as a comment because of its C in column 1: {why}", warning=True)


@lru_cache(2048)
def parse_statement(source: Source) -> tree.Statement:
    """Parse a statement.  Results are cached, because many decks differ from others in a few cards only."""
    if not source.text:
        raise Refused(source.place, f"expected a statement after the statement number {source.label}")
    for card in source.cards:
        if statement_columns(card).rstrip() != card.columns(1, LAST_COLUMN).rstrip(f"{RECORD_MARKS} "):
            message = "a record mark (punched 0-2-8) ends a statement, but other characters follow it"
            raise Refused(source.place, message)
    label = _statement_number(source.label, source.place) if source.label else 0
    if len(source.text) > MAX_LENGTH:
        raise Refused(source.place, f"the statement has more than {MAX_LENGTH} characters")
    text = "\n".join(card.text for card in source.cards)
    if source.kind == "format":
        return tree.Statement(label, source.place, text, tree.Format(source.text, source.places))
    # An unknown statement that resembles a FORMAT gets the error types 10 and 11 of p. 56.
    if source.kind == "unknown":
        if _FORMAT_LIKE.match(source.text):
            raise Refused(source.place, "the word FORMAT is misspelled", 10)
        if source.text.startswith("FORMAT"):
            raise Refused(source.place, "expected a parenthesis after FORMAT", 11)
        raise Refused(source.place, f"not a statement of this FORTRAN: {source.text[:40]}")
    # The builder is recursive, so the depth is limited before parsing.
    if _depth(source.text) > MAX_NESTING:
        raise Refused(source.place, f"parentheses are nested more than {MAX_NESTING} deep")
    form, number = _FORMS[source.kind]
    try:
        body = _Builder(source.places).build(_tree(source.text, source.kind))
    except UnexpectedCharacters as error:
        at = source.places[error.pos_in_stream or 0]
        raise Refused(at, f"{error.char!r} is not allowed here; the form is {form}", number) from None
    except UnexpectedToken as error:
        # An IF that is followed by a comma is error type 7 (C26-5619 p. 56).
        if source.kind == "if" and error.token == "," and source.text[(error.token.start_pos or 1) - 1] == ")":
            number = 7
        raise Refused(*_token_message(error, source), number) from None
    except UnexpectedInput:
        raise Refused(source.place, f"the statement does not parse; the form is {form}", number) from None
    return tree.Statement(label, source.place, text, body)


def _statement_number(digits: str, place: tree.Place) -> int:
    if len(digits.lstrip("0")) > 4 or not digits.strip("0"):
        raise Refused(place, f"statement number {digits[:12]} is not between 1 and 9999")
    return int(digits)


def _token_message(error: UnexpectedToken, source: Source) -> tuple[tree.Place, str]:
    form, _ = _FORMS[source.kind]
    token = error.token
    if token.type == "$END":
        return source.places[-1], f"the statement ends too soon; the form is {form}"
    at = source.places[token.start_pos or 0]
    return at, f"{str(token)!r} is not allowed here; the form is {form}"


def _depth(text: str) -> int:
    depth = deepest = 0
    for char in text:
        depth += (char == "(") - (char == ")")
        deepest = max(deepest, depth)
    return deepest


@lru_cache(1024)
def _tree(text: str, kind: str) -> Tree[Token]:
    return _grammar().parse(text, start=kind)


@cache
def _grammar() -> Lark:
    source = files("emulator.language").joinpath("dialect.lark").read_text(encoding="utf-8")
    return Lark(source, parser="lalr", start=list(_FORMS), maybe_placeholders=True)


class _Builder:
    """The converter from lark's syntax tree to the classes of tree.py, with one method for each grammar rule."""

    def __init__(self, places: Sequence[tree.Place]) -> None:
        self._places = places

    def build(self, node: Tree[Token]) -> Any:
        """Convert lark's tree to the syntax tree, faster than its Transformer.  Raise Refused for an invalid name."""
        children = [self.build(child) if isinstance(child, Tree) else child for child in node.children]
        return getattr(self, node.data)(children)

    def _at(self, token: Token) -> tree.Place:
        return self._places[token.start_pos or 0]

    def number(self, children: list[Token]) -> tree.Number:
        token = children[0]
        # C26-5619 p. 14.
        if "." not in token and len(token) > 4:
            raise Refused(self._at(token), f"fixed-point constant {token} has more than four digits")
        return tree.Number(str(token), self._at(token))

    def reference(self, children: list[Any]) -> tree.Reference:
        return self._name(children[0], tuple(c for c in children[1:] if c is not None))

    def _name(self, token: Token, arguments: tuple[tree.Expression, ...] = ()) -> tree.Reference:
        # C26-5619 p. 16, and error type 6 on p. 56.
        if len(token) > 5:
            raise Refused(self._at(token), f"the name {token} has more than five characters", 6, about=str(token))
        return tree.Reference(str(token), arguments, self._at(token))

    def power(self, children: list[Any]) -> tree.Power:
        return tree.Power(children[0], children[1], children[0].place)

    def product(self, children: list[Any]) -> tree.Product:
        rest = tuple((str(op), factor) for op, factor in zip(children[1::2], children[2::2], strict=True))
        return tree.Product(children[0], rest, children[0].place)

    def expression(self, children: list[Any]) -> tree.Expression:
        minus = False
        place = children[0].place if not isinstance(children[0], Token) else self._at(children[0])
        if isinstance(children[0], Token):
            minus = children[0] == "-"
            children = children[1:]
        # A single term without a sign needs no Sum around it.
        if len(children) == 1 and not minus:
            return children[0]  # type: ignore[no-any-return]
        rest = tuple((str(op), term) for op, term in zip(children[1::2], children[2::2], strict=True))
        return tree.Sum(minus, children[0], rest, place)

    def assignment(self, children: list[Any]) -> tree.Assignment:
        return tree.Assignment(children[0], children[1])

    def go_to(self, children: list[Token]) -> tree.GoTo:
        return tree.GoTo(self._label(children[0]))

    def computed_go_to(self, children: list[Token]) -> tree.ComputedGoTo:
        return tree.ComputedGoTo(tuple(map(self._label, children[:-1])), self._name(children[-1]))

    def _label(self, token: Token) -> int:
        return _statement_number(token, self._at(token))

    def if_(self, children: list[Any]) -> tree.If:
        a, b, c = map(self._label, children[1:])
        return tree.If(children[0], (a, b, c))

    def if_switch(self, children: list[Token]) -> tree.IfSwitch:
        if children[0] not in ("1", "2", "3", "4", "9"):
            message = f"there is no sense switch {children[0]}; the console has 1 to 4, and 9 is on after the last card"
            raise Refused(self._at(children[0]), message, 7)
        on, off = map(self._label, children[1:])
        return tree.IfSwitch(int(children[0]), (on, off))

    def do(self, children: list[Any]) -> tree.Do:
        label, variable, first, last, step = children
        return tree.Do(self._label(label), self._name(variable), first, last, step)

    def continue_(self, _: list[Any]) -> tree.Continue:
        return tree.Continue()

    def pause(self, children: list[Any]) -> tree.Pause:
        return tree.Pause(str(children[0] or ""))

    def stop(self, children: list[Any]) -> tree.Stop:
        return tree.Stop(str(children[0] or ""))

    def end(self, _: list[Any]) -> tree.End:
        return tree.End()

    def array(self, children: list[Token]) -> tuple[str, tuple[int, ...], tree.Place]:
        name = self._name(children[0])
        if len(children) > 3:
            raise Refused(name.place, f"{name.name} has more than two dimensions", 9)
        if any(len(d.lstrip("0")) > 4 for d in children[1:]):
            raise Refused(name.place, f"{name.name}: a dimension has more than four digits", 9)
        return name.name, tuple(int(d) for d in children[1:]), name.place

    def dimension(self, children: list[tuple[str, tuple[int, ...], tree.Place]]) -> tree.Dimension:
        return tree.Dimension(tuple(children))

    def loop(self, children: list[Any]) -> tree.Loop:
        *items, variable, first, last, step = children
        return tree.Loop(tuple(items), self._name(variable), first, last, step)

    def input_output(self, children: list[Any]) -> tree.InputOutput:
        verb, label, *items = children
        # A comma may stand before an empty list (READ 5,).
        return tree.InputOutput(str(verb), self._label(label), tuple(item for item in items if item is not None))
