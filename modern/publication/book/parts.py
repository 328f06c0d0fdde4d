"""The parts of the book that are made from data: listings with their apparatus, charts, examples, statements.

The facts are those that the site shows; only their form is of the book.  Notes are keyed to cards, not to lines or
pages, so that they stay true wherever a page ends.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from modern.claims.register import DOCUMENTS, Statement, statements_of
from modern.drawing.draw import draw_svg
from modern.drawing.stages import frames, strip
from modern.edition import programs
from modern.edition.apparatus import Row
from modern.edition.chapter6 import EXAMPLES, input_deck
from modern.edition.reproduce import EXACT, ORDER
from modern.formats.points import parse_input
from modern.geometry.mesh import ExportError
from modern.port import convex_hull
from modern.publication.book.markup import block, call, code, heading, label, say, string, table
from modern.publication.chart import chart
from modern.publication.chart_svg import chart_svg
from modern.publication.examples import TITLES, example, homes
from modern.publication.facing import Card, Facing, facing
from modern.publication.flow import flow

Keep = Callable[[str, str], str]
"""Takes a picture's name and its SVG, and gives the name by which Typst finds it."""

_FONTS = re.compile(r"font-family(=|:)\s*(\"[^\"]*\"|[^;\"}]*)")
_VERDICTS = {EXACT: "to the character", ORDER: "the same hull, in another order"}
_SHORT = {"holds": "holds", "holds with a condition": "with a condition", "does not hold": "does not hold"}


def fitted(svg: str) -> str:
    """A picture with the fonts of the book, and without what only a page of the site can do."""
    svg = re.sub(r"</?a\b[^>]*>", "", svg)
    return _FONTS.sub(_font, svg)


def _font(found: re.Match[str]) -> str:
    family = "DejaVu Sans Mono" if "mono" in found[2].lower() or "courier" in found[2].lower() else "Libertinus Serif"
    return f'font-family="{family}"' if found[1] == "=" else f"font-family:'{family}'"


def listings() -> Iterator[str]:
    """The facing text of every built-in program, each page of the thesis with its notes."""
    shown: set[str] = set()
    for name in programs.NAMES:
        found = facing(name)
        yield heading(f"{name}.f: {found.title}", 2, label(name))
        for row in found.everywhere:
            if row.id not in shown:
                shown.add(row.id)
                yield _entry(row, found)
        for page, cards in found.pages():
            yield heading(f"Page {page}", 3, label(name, f"page-{page}"))
            yield from map(_card, [name] * len(cards), cards)
            rows = [row for row in found.rows() if row.id not in shown and _touched(row, cards)]
            shown |= {row.id for row in rows}
            yield from (_entry(row, found) for row in rows)


def _touched(row: Row, cards: tuple[Card, ...]) -> bool:
    return any(row.id in card.rows or any(row.id in variant.rows for variant in card.variants) for card in cards)


def _card(name: str, card: Card) -> str:
    changed = not card.witness or card.changed or any(piece.changed for piece in card.witness)
    sign = "+" if not card.witness else "≠" if changed else ""
    words = "" if not changed else " / ".join(f"{piece.line}: {piece.text.strip()}" for piece in card.witness)
    rows = ", ".join(card.rows)
    place = f"#[{say(card.place)}] <{label('card', name, card.place)}>"
    return f"#card([{place}], [{say(sign)}], {string(card.text)}, {string(words)}, [{say(rows)}])\n"


def _entry(row: Row, found: Facing | None, where: str = "") -> str:
    cards = ", ".join(card.place for card in found.cards_of(row.id)[:6]) if found else where
    more = len(found.cards_of(row.id)) - 6 if found else 0
    at = f" {cards}{f' and {more} more' if more > 0 else ''}" if cards else ""
    head = f"#[{call('strong', say(row.id))}] <{label('row', row.id)}>"
    kinds = call("text", say(f"{row.layer}, {row.kind}; {row.certainty}"), style='"italic"')
    readings = f"{code(row.witness or ' ')} → {code(row.lemma or ' ')}"
    rejected = "".join(f" Not {code(one.reading)}: {say(one.reason)}" for one in row.rejected)
    ground = row.ground.get("kind", "none: a conjecture")
    words = f"{head}{say(at)} {kinds}. {readings}. {say(row.reason)}{rejected} {say(row.evidence)} "
    return f"#entry[{words}{say(f'Ground: {ground}.')}]\n\n"


def charts(keep: Keep) -> Iterator[str]:
    """Every sheet of every program's flow chart, a page each."""
    yield "#pagebreak(weak: true)\n\n"
    for name in programs.NAMES:
        drawn = chart(flow(programs.program(name)))
        for number in range(1, len(drawn.pages) + 1):
            title = f"Flow chart of {name}, sheet {number} of {len(drawn.pages)}"
            if number == 1:
                yield heading(f"Flow chart of {name}", 2, label("chart", name))
            yield heading(f"Sheet {number} of {len(drawn.pages)}", 3, label("chart", name, str(number)))
            file = keep(f"chart-{name}-{number}", chart_svg(drawn, number))
            drawn_in = f'image({string(file)}, alt: {string(title)}, height: 1fr, fit: "contain")'
            yield f"#align(center, {drawn_in})\n#pagebreak(weak: true)\n\n"


def examples(keep: Keep) -> Iterator[str]:
    """The printed examples: verdicts, pictures, the cards as they are printed and punched, and the rows."""
    for number in EXAMPLES:
        yield heading(f"Example {number}", 2, label(f"example{number}.md"))
        parts = example(number)
        rows = [
            [
                say(f"program {part.program}, {TITLES[part.device]}"),
                *(
                    say(_VERDICTS.get(r.verdict.kind, r.verdict.kind))
                    for r in sorted(part.reports, key=lambda r: r.state)
                ),
            ]
            for part in parts
            if part.reports
        ]
        yield table(
            [say(words) for words in ("", "program 1 as it was then", "program 1 as listed")], rows, (30, 30, 30)
        )
        yield from _pictures(number, keep)
        for part in parts:
            cards = "\n".join(card.print for card in part.cards)
            if cards.strip():
                yield heading(f"Program {part.program}: {TITLES[part.device]}", 3, label(f"example{number}", part.id))
                yield block(cards, "7pt")
            mine = [row for row in part.rows if homes()[row.id] == (number, part.id)]
            yield from (_short(row) for row in mine)


def _short(row: Row) -> str:
    """A row of a print in a line or two; what is the same for many is told once, in the chapter on the text."""
    head = f"#[{call('strong', say(row.id))}] <{label('row', row.id)}>"
    words = f"{head} {say(f'{row.kind}, {row.certainty}: ')}{code(row.witness or ' ')} → {code(row.lemma or ' ')}. "
    return f"#entry[{words}{say(row.reason)}]\n\n"


def _pictures(number: int, keep: Keep) -> Iterator[str]:
    points = parse_input(input_deck(number).text(), f"example{number}").points
    hull = convex_hull(points, "exact", history=True, on_refusal="return")
    file = keep(f"hull-{number}", draw_svg(hull, width=520))
    yield f"#picture({string(file)}, {string(f'The hull of example {number}')}, width: 58%)\n\n"
    try:
        stages = frames(hull)
    except ExportError:
        return
    file = keep(f"stages-{number}", strip(stages))
    yield f"#picture({string(file)}, {string(f'The construction of example {number}, H1 to Hf')}, width: 88%)\n\n"


def statements() -> Iterator[str]:
    """Every statement of the five documents with its verdict."""
    for name in DOCUMENTS:
        yield heading(f"Statements: {name}", 2, label("statements", name))
        rows = [_statement(row) for row in statements_of(name)]
        place = max(len(row.page) for row in statements_of(name))
        head = [say(words) for words in ("", "page", "what is stated", "verdict")]
        yield table(head, rows, (4, place, 90, 62), (4, min(place, 11), 12, 12))


def _statement(row: Statement) -> list[str]:
    verdict = call("strong", say(_SHORT.get(row.verdict, row.verdict)))
    why = say(f": {row.why}") if row.why else ""
    number = row.id.partition(".")[2]
    return [f"#[{say(number)}] <{label('row', row.id)}>", say(row.page), say(row.says), verdict + why]
