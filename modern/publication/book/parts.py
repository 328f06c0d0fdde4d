"""The parts of the book that are generated from data: listings with their apparatus, charts, examples, statements.

The facts are the same as on the site.  Notes refer to cards, not to lines or pages of the book, so that they do not
depend on page breaks.
"""

import re
from collections.abc import Callable, Iterator

from modern.claims.register import DOCUMENTS, UNTESTABLE, USED, Judged, judged
from modern.drawing.draw import draw_svg
from modern.drawing.stages import frames, strip
from modern.edition import programs
from modern.edition.apparatus import Row
from modern.edition.chapter6 import EXAMPLES, input_deck
from modern.formats.points import parse_input
from modern.geometry.mesh import ExportError
from modern.port import convex_hull
from modern.publication.book.markup import block, call, code, heading, label, say, string, table
from modern.publication.chart import chart
from modern.publication.chart_svg import chart_svg
from modern.publication.examples import TITLES, VERDICTS, example, homes
from modern.publication.facing import Card, Facing, facing
from modern.publication.flow import flow

# Saves a picture, given its name and SVG, and returns the name by which Typst finds it.
SavePicture = Callable[[str, str], str]

_FONTS = re.compile(r"font-family(=|:)\s*(\"[^\"]*\"|[^;\"}]*)")
_SHORT = {"holds": "holds", "holds with a condition": "with a condition", "does not hold": "does not hold"}


def fitted(svg: str) -> str:
    """Return a picture with the fonts of the book and without links."""
    svg = re.sub(r"</?a\b[^>]*>", "", svg)

    def font(match: re.Match[str]) -> str:
        monospaced = "mono" in match[2].lower() or "courier" in match[2].lower()
        family = "DejaVu Sans Mono" if monospaced else "Libertinus Serif"
        return f'font-family="{family}"' if match[1] == "=" else f"font-family:'{family}'"

    return _FONTS.sub(font, svg)


def listings() -> Iterator[str]:
    """Yield the facing text of every built-in program, each page of the thesis followed by its notes."""
    shown: set[str] = set()
    for name in programs.NAMES:
        listing = facing(name)
        yield heading(f"{name}.f: {listing.title}", 2, label(name))
        for row in listing.everywhere:
            if row.id not in shown:
                shown.add(row.id)
                yield _entry(row, listing)
        for page, cards in listing.pages():
            yield heading(f"Page {page}", 3, label(name, f"page-{page}"))
            yield from (_card(name, card) for card in cards)
            concerned = {row for card in cards for row in card.concerned} - shown
            shown |= concerned
            yield from (_entry(row, listing) for row in listing.rows() if row.id in concerned)


def _card(name: str, card: Card) -> str:
    changed = not card.witness or card.changed or any(piece.changed for piece in card.witness)
    sign = "+" if not card.witness else "≠" if changed else ""
    witness = "" if not changed else " / ".join(f"{piece.line}: {piece.text.strip()}" for piece in card.witness)
    rows = ", ".join(card.rows)
    place = f"#[{say(card.place)}] <{label('card', name, card.place)}>"
    return f"#card([{place}], [{say(sign)}], {string(card.text)}, {string(witness)}, [{say(rows)}])\n"


def _entry(row: Row, listing: Facing) -> str:
    cards = listing.cards_of(row.id)
    at = f" {', '.join(card.place for card in cards[:6])}" if cards else ""
    if len(cards) > 6:
        at += f" and {len(cards) - 6} more"
    kinds = call("text", say(f"{row.layer}, {row.kind}; {row.certainty}"), style='"italic"')
    rejected = "".join(f" Rejected: {code(r.reading)} {say(r.reason)}" for r in row.rejected)
    ground = row.ground.get("kind", "none: the reading is a conjecture")
    text = f"{_head(row)}{say(at)} {kinds}. {_readings(row)}{say(row.reason)}{rejected} {say(row.evidence)} "
    return f"#entry[{text}{say(f'Ground: {ground}.')}]\n\n"


def charts(save: SavePicture) -> Iterator[str]:
    """Yield the flow charts of all programs, one page for each sheet."""
    yield "#pagebreak(weak: true)\n\n"
    for name in programs.NAMES:
        drawn = chart(flow(programs.program(name)))
        for number in range(1, len(drawn.pages) + 1):
            title = f"Flow chart of {name}, sheet {number} of {len(drawn.pages)}"
            if number == 1:
                yield heading(f"Flow chart of {name}", 2, label("chart", name))
            yield heading(f"Sheet {number} of {len(drawn.pages)}", 3, label("chart", name, str(number)))
            file = save(f"chart-{name}-{number}", chart_svg(drawn, number))
            image = f'image({string(file)}, alt: {string(title)}, height: 1fr, fit: "contain")'
            yield f"#align(center, {image})\n#pagebreak(weak: true)\n\n"


def examples(save: SavePicture) -> Iterator[str]:
    """Yield the printed examples: verdicts, pictures, the printed cards, and the rows of the apparatus."""
    for number in EXAMPLES:
        yield heading(f"Example {number}", 2, label(f"example{number}.md"))
        parts = example(number)
        rows = []
        for part in parts:
            if part.reports:
                verdicts = [say(VERDICTS.get(r.verdict.kind, r.verdict.kind)) for r in part.reports]
                rows.append([say(f"program {part.program}, {TITLES[part.device]}"), *verdicts])
        head = [say(title) for title in ("", "program 1 in the state of the examples", "program 1 as listed")]
        yield table(head, rows, (30, 30, 30))
        yield from _pictures(number, save)
        for part in parts:
            cards = "\n".join(card.print for card in part.cards)
            if cards.strip():
                yield heading(part.title, 3, label(f"example{number}", part.id))
                yield block(cards, "7pt")
            yield from (_short(row) for row in part.rows if homes()[row.id] == (number, part.id))


def _head(row: Row) -> str:
    return f"#[{call('strong', say(row.id))}] <{label('row', row.id)}>"


def _readings(row: Row) -> str:
    return f"{code(row.witness or ' ')} → {code(row.lemma or ' ')}. "


def _short(row: Row) -> str:
    text = f"{_head(row)} {say(f'{row.kind}, {row.certainty}: ')}{_readings(row)}"
    return f"#entry[{text}{say(row.reason)}]\n\n"


def _pictures(number: int, save: SavePicture) -> Iterator[str]:
    points = parse_input(input_deck(number).text(), f"example{number}").points
    hull = convex_hull(points, "exact", history=True, on_refusal="return")
    file = save(f"hull-{number}", draw_svg(hull, width=520))
    yield f"#picture({string(file)}, {string(f'The hull of example {number}')}, width: 58%)\n\n"
    try:
        stages = frames(hull)
    except ExportError:
        return
    file = save(f"stages-{number}", strip(stages))
    yield f"#picture({string(file)}, {string(f'The construction of example {number}, H1 to Hf')}, width: 88%)\n\n"


def statements() -> Iterator[str]:
    """Yield the statements of the five documents with their verdicts."""
    for name in DOCUMENTS:
        yield heading(f"Statements: {name}", 2, label("statements", name))
        rows = [_statement(judgement) for judgement in judged(name)]
        place = max(len(judgement.statement.page) for judgement in judged(name))
        head = [say(title) for title in ("", "page", "statement", "verdict")]
        yield table(head, rows, (4, place, 90, 62), (4, min(place, 11), 12, 12))


def _statement(judgement: Judged) -> list[str]:
    row = judgement.statement
    grade = "" if row.verdict in (USED, UNTESTABLE) else f", {judgement.grade}"
    verdict = call("strong", say(_SHORT.get(row.verdict, row.verdict) + grade))
    reason = f"as {row.same.partition('.')[2]}" if row.same else row.why
    why = say(f": {reason}") if reason else ""
    number = row.id.partition(".")[2]
    return [f"#[{say(number)}] <{label('row', row.id)}>", say(row.page), say(row.says), verdict + why]
