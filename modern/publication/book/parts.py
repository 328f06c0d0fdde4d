"""The parts of the book that are generated from data: listings with their apparatus, charts, examples, statements.

The facts are the same as on the site. The textual notes refer to cards, not to lines or pages of the book, so that they
do not depend on page breaks.
"""

import re
from collections.abc import Collection, Iterable, Iterator, Mapping

from modern.claims.register import DOCUMENTS, UNTESTABLE, USED, Judged, judged
from modern.drawing.draw import draw_svg
from modern.drawing.stages import frames, strip
from modern.edition import programs
from modern.edition.apparatus import Row
from modern.edition.chapter6 import EXAMPLES, input_deck
from modern.formats.points import parse_input
from modern.geometry.mesh import ExportError
from modern.port import convex_hull
from modern.publication.book.front import FRAME, SavePicture
from modern.publication.book.markup import block, call, code, heading, label, say, string, table
from modern.publication.chart import chart
from modern.publication.chart_svg import chart_svg
from modern.publication.commentary import Gloss, commentary
from modern.publication.examples import TITLES, VERDICTS, example, homes
from modern.publication.facing import Card, Facing, facing
from modern.publication.flow import flow
from modern.study.report import raised

_SENTENCE = re.compile(r"(?<=\.) (?=[A-Z])")
# The longest reading in a note, in characters.
_LONGEST = 120
# The size of a pixel of a picture in points.
_PIXEL = 0.6
# The largest height of a sheet of a flow chart below a heading, and the size of a pixel, both in millimetres.
_SHEET, _MILLIMETRES = 220, 25.4 / 96
_FONTS = re.compile(r"font-family(=|:)\s*(\"[^\"]*\"|[^;\"}]*)")
_SHORT = {"holds": "holds", "holds with a condition": "with a condition", "does not hold": "does not hold"}


def fitted(svg: str) -> str:
    """Return an SVG picture with the fonts of the book and without links."""
    svg = re.sub(r"</?a\b[^>]*>", "", svg)
    # A picture in pixels is printed in a size in which its letters are about as large as those of a caption.
    svg = re.sub(r'\b(width|height)="(\d+)"', lambda m: f'{m[1]}="{int(m[2]) * _PIXEL:.4g}pt"', svg, count=2)

    def font(match: re.Match[str]) -> str:
        monospaced = "mono" in match[2].lower() or "courier" in match[2].lower()
        family = "IBM Plex Mono" if monospaced else "IBM Plex Sans"
        return f'font-family="{family}"' if match[1] == "=" else f"font-family:'{family}'"

    return _FONTS.sub(font, svg)


def listings() -> Iterator[str]:
    """Yield each listing, with the commentary next to the cards, and then the textual notes on this listing.

    For a variant of a program, such as program1_examples, only the blocks in which a card differs from that program are
    shown.
    """
    for name in programs.NAMES:
        listing, entry = facing(name), programs.built_in(name)
        yield "#pagebreak(weak: true)\n" if name != programs.NAMES[0] else ""
        yield heading(f"{name}.f: {listing.title}", 2, label(name))
        base = facing(entry.text)
        is_variant = name != entry.text
        if is_variant:
            yield say(f"Only the passages that differ from {entry.text} are shown.") + "\n\n#v(10pt)\n\n"
        rows = [row for row in listing.rows() if not is_variant or row not in base.rows()]
        noted = {row.id for row in base.rows()} | {row.id for row in rows}
        texts = {card.text for card in base.cards}
        page = ""
        for passage in commentary(name).blocks:
            cards = [listing.cards[number - 1] for number in passage.cards]
            if is_variant and texts.issuperset(card.text for card in cards):
                continue
            items = []
            for card in cards:
                if card.page != page:
                    page = card.page
                    items.append(f"[#sheet([p. {say(page)}]) <{label(name, f'page-{page}')}>]")
                items.append(f"[{_card(name, card, noted)}]")
            comment = say(" ".join(passage.text.split()))
            if passage.steps:
                comment += "#parbreak();" + call("emph", say(f"Chapter 3: {'; '.join(passage.steps)}."))
            if not is_variant:
                comment += "".join(_mark(name, g) for g in commentary(name).variables if passage.title in g.set_in)
            yield f"#passage([{say(passage.title)}], [{comment}], ({', '.join(items)},))\n\n"
        if not is_variant:
            yield from _variables(name)
        yield heading(f"Textual notes to {name}", 3, label("notes", name))
        yield from _grouped(rows, {row.id: _places(row, listing) for row in rows})


def _variables(name: str) -> Iterator[str]:
    """Yield the table of a program's variables. Each name is also an entry of the book's index."""
    yield heading(f"Variables of {name}", 3, label("variables", name))
    rows = []
    for gloss in commentary(name).variables:
        limits = f"{gloss.limits[0]} to {gloss.limits[1]}" if gloss.limits else ""
        rows.append([_mark(name, gloss) + code(gloss.name), say(limits), say(" ".join(gloss.text.split()))])
    yield table([say(title) for title in ("name", "values", "meaning")], rows, (6, 11, 120), (6, 11, 14))


def _mark(name: str, gloss: Gloss) -> str:
    return f"#idx({string(f'{gloss.name} ({name})')});"


def _card(name: str, card: Card, noted: Collection[str]) -> str:
    changed = not card.witness or card.changed or any(piece.changed for piece in card.witness)
    sign = "+" if not card.witness else "≠" if changed else ""
    witness = "" if not changed else " / ".join(f"{piece.line}: {piece.text.strip()}" for piece in card.witness)
    rows = ", ".join(f"#link(<{label('row', row)}>)[{say(row)}]" if row in noted else say(row) for row in card.rows)
    place = f"#[{say(card.place)}] <{label('card', name, card.place)}>"
    return f"#card([{place}], [{say(sign)}], {string(card.text)}, {string(witness)}, [{rows}])"


def _places(row: Row, listing: Facing) -> str:
    places = [card.place for card in listing.cards_of(row.id)]
    return ", ".join(places[:6]) + (f" and {len(places) - 6} more" if len(places) > 6 else "")


def _grouped(rows: Iterable[Row], places: Mapping[str, str] | None = None) -> Iterator[str]:
    """Yield the textual notes on emendations. Emendations of one kind with the same reason share a note.

    ``places`` names the cards that each row changes.
    """

    def readings(row: Row) -> str:
        at = say((places or {}).get(row.id, ""))
        return f"{at} {_reading(row.witness)} → {_reading(row.lemma)} "

    groups: dict[tuple[str, ...], list[Row]] = {}
    for row in rows:
        groups.setdefault((row.layer, row.kind, row.certainty, row.reason), []).append(row)
    for (layer, kind, certainty, reason), members in groups.items():
        about = f"{call('strong', say(kind))}{say(f' ({layer}, {certainty}). {reason} ')}"
        if len(members) == 1:
            (row,) = members
            reasons = f"{about}{say(row.evidence)} {_rejected(row)}{say(_ground(row))}"
            yield f"#entry[{_head(row)} {readings(row)}{reasons}]\n\n"
            continue
        evidence = {row.id: _SENTENCE.split(row.evidence) for row in members}
        shared = [sentence for sentence in evidence[members[0].id] if all(sentence in e for e in evidence.values())]
        notes = []
        for row in members:
            rest = " ".join(sentence for sentence in evidence[row.id] if sentence not in shared)
            notes.append(f"[{_head(row)} {readings(row)}{say(rest)} {_rejected(row)}]")
        grounds = {_ground(row) for row in members}
        common = say(" ".join([*shared, *(grounds if len(grounds) == 1 else ())]))
        yield f"#notes([{about}{common}], ({', '.join(notes)},))\n\n"


def _rejected(row: Row) -> str:
    return "".join(f"Rejected: {code(r.reading)} {say(r.reason)} " for r in row.rejected)


def _ground(row: Row) -> str:
    return f"Ground: {row.ground.get('kind', 'none, because the reading is a conjecture')}."


def charts(save: SavePicture) -> Iterator[str]:
    """Yield the flow charts of the listings.  Each sheet has a page, and is reduced if it is too high for the page."""
    variants = [name for name in programs.NAMES if name not in programs.TEXTS]
    yield say(f"The site also shows the flow chart of {', '.join(variants)}.") + "\n\n"
    for name in programs.TEXTS:
        drawn = chart(flow(programs.program(name)))
        yield "#pagebreak(weak: true)\n\n" + heading(f"Flow chart of {name}", 2, label("chart", name))
        for number, page in enumerate(drawn.pages, 1):
            title = f"Flow chart of {name}, sheet {number} of {len(drawn.pages)}"
            file = save(f"chart-{name}-{number}", chart_svg(drawn, number))
            height = min(_SHEET, page.height * _MILLIMETRES)
            picture = f"#picture({string(file)}, {string(title)}, height: {height:.0f}mm)"
            is_last = name == programs.TEXTS[-1] and number == len(drawn.pages)
            break_after = "" if is_last else "#pagebreak(weak: true)\n\n"
            yield f"#[{picture}] <{label('chart', name, str(number))}>\n{break_after}"


def examples(save: SavePicture) -> Iterator[str]:
    """Yield the printed examples: verdicts, pictures, the printed cards, and the rows of the apparatus."""
    for number in EXAMPLES:
        yield "#place.flush()\n#pagebreak(weak: true)\n" + heading(f"Example {number}", 2, label(f"example{number}.md"))
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
                yield block(cards)
        rows_shown = [row for part in parts for row in part.rows if homes()[row.id] == (number, part.id)]
        if rows_shown:
            yield heading(f"Textual notes to example {number}", 3, label("notes", f"example{number}"))
        yield from _grouped(rows_shown)


def _head(row: Row) -> str:
    return f"#[{call('strong', say(row.id))}] <{label('row', row.id)}>"


def _reading(text: str) -> str:
    """Return a reading of a card as code. The middle of a long reading is omitted."""
    if len(text) > _LONGEST:
        text = f"{text[: _LONGEST // 2]} ... {text[-_LONGEST // 3 :]}"
    return code(text) if text else "–"


def _pictures(number: int, save: SavePicture) -> Iterator[str]:
    points = parse_input(input_deck(number).text(), f"example{number}").points
    hull = convex_hull(points, "exact", history=True, on_refusal="return")
    file = save(f"hull-{number}", draw_svg(hull, width=340))
    yield f"#picture({string(file)}, {string(f'The hull of example {number}')}, width: 40%)\n\n"
    try:
        stages = frames(hull, None, *FRAME)
    except ExportError:
        return
    file = save(f"stages-{number}", strip(stages, columns=2))
    title = f"The construction of example {number}, H1 to Hf"
    yield f"#picture({string(file)}, {string(title)}, width: 62%)\n\n"


def statements() -> Iterator[str]:
    """Yield the statements of the five documents with their verdicts."""
    for name in DOCUMENTS:
        yield heading(f"Statements: {name}", 2, label("statements", name))
        rows = [_statement(judgement) for judgement in judged(name)]
        place = max(len(judgement.statement.page) for judgement in judged(name))
        head = [say(title) for title in ("", "page", "statement", "verdict")]
        yield table(head, rows, (4, place, 80, 90), (4, min(place, 11), 12, 12))


_DOTTED = re.compile(r"\w+(?:\.\w+){2,}")


def _statement(judgement: Judged) -> list[str]:
    row = judgement.statement
    grade = "" if row.verdict in (USED, UNTESTABLE) else f", {judgement.grade}"
    verdict = call("strong", say(_SHORT.get(row.verdict, row.verdict) + grade))
    reason = f"as {row.same.partition('.')[2]}" if row.same else row.why
    # A long dotted name may be broken after its dots.
    why = say(": " + _DOTTED.sub(lambda name: name[0].replace(".", ".\u200b"), reason)) if reason else ""
    number = row.id.partition(".")[2]
    return [f"#[{say(number)}] <{label('row', row.id)}>", say(row.page), say(raised(row.says)), verdict + why]
