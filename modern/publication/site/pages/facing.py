"""A listing as facing text, with details for every card, and the tables of its names and FORMAT statements.

All cards, rows and addresses are plain HTML and need neither JavaScript nor CSS. The reader chooses with form controls
which layers are highlighted and which example has its executions and times in the margin. CSS evaluates the controls.
"""

from collections.abc import Iterable

from modern.edition import programs
from modern.publication.chart import chart, sheets_of
from modern.publication.commentary import Block, Gloss, commentary
from modern.publication.facing import Card, Facing, Piece, Variant, facing
from modern.publication.flow import flow
from modern.publication.measured import DETECTED_BY, runs, weights
from modern.publication.moments import LEGEND, drawn, moments
from modern.publication.site.entries import entry
from modern.publication.site.made import Part, one_of
from modern.publication.site.markup import (
    bar,
    code,
    definitions,
    details,
    element,
    escape,
    link,
    lowered,
    preformatted,
    run_link,
    table,
    text,
)
from modern.publication.tei_header import LAYERS
from modern.publication.uses import Name, uses

_CHARTS = dict(zip(programs.NAMES, ("chart1", "chart2", "chart3", "chart1_examples"), strict=True))

# The kinds of difference between a card and the witness, each with its sign and meaning.
SIGNS = {
    "changed": ("\u2260", "differs from the witness"),
    "blanks": ("\u2423", "differs from the witness in blanks only"),
    "ours": ("+", "not in the witness"),
}


# The conditions of an IF: signs of its expression, or the position of a switch.
_SIGNS = {"\u2212": "negative", "0": "zero", "+": "positive"}
_CONDITIONS = {
    ", ".join(signs): f"if {' or '.join(_SIGNS[sign] for sign in signs)}"
    for signs in (("\u2212",), ("0",), ("+",), ("\u2212", "0"), ("\u2212", "+"), ("0", "+"))
}


def make(argument: str) -> list[Part]:
    """Return the facing text of a built-in program."""
    name = one_of(argument, programs.NAMES)
    listing = facing(name)
    first_cards = {row.id: cards[0] for row in listing.rows() if (cards := listing.cards_of(row.id))}
    parts = [Part(html=_controls(listing) + text("p", LEGEND, cls="quiet"))]
    titles = ("place", "witness: line and text", "deck", "executions, time")
    head = element("div", "".join(text("span", title) for title in titles), cls="card-head", aria_hidden="true")
    sheets = sheets_of(chart(flow(programs.program(name))))
    remarks = {block.cards.start: _remark(name, block, sheets) for block in commentary(name).blocks}
    for page, cards in listing.pages():
        items = "".join(remarks.get(card.number, "") + _card(listing, card, first_cards) for card in cards)
        parts.append(Part(f"Page {page}", f"page-{page}", html=head + element("ol", items, cls="cards")))
    if listing.everywhere or listing.dropped:
        parts.append(Part("Rows that concern most cards", "everywhere", html=_everywhere(listing)))
    return [*parts, _names(name), _formats(name)]


def _remark(name: str, block: Block, sheet_of: dict[int, int]) -> str:
    """Return the commentary on a block: what it does, its steps in chapter 3, and its sheets of the flow chart."""
    place = facing(name).cards[block.cards.start - 1].place
    where = "; ".join(map(escape, block.steps))
    where = f"{link('reference/concordance', '', 'Chapter 3')}: {where}. " if where else ""
    sheets = dict.fromkeys(sheet for card, sheet in sheet_of.items() if card in block.cards)
    where += ", ".join(link(_CHARTS[name], f"sheet-{n}", f"flow chart, sheet {n}") for n in sheets)
    inner = (
        text("h3", block.title)
        + element("p", lowered(block.text))
        + (element("p", where, cls="quiet") if where else "")
    )
    if moment := moments(name).get(block.cards.start):
        inner = element("div", inner) + element("figure", drawn(moment) + text("figcaption", moment.caption()))
    return element("li", inner, cls="remark", id=f"about-{place}")


def _controls(listing: Facing) -> str:
    name = listing.program
    present = [layer for layer in listing.text.layers if any(row.layer == layer for row in listing.rows())]
    shown = programs.built_in(name).layers
    html = text("legend", "Layers")
    for layer in present:
        html += _choice("checkbox", "layer", layer, layer in shown, LAYERS[layer])
    examples = text("legend", "Executions and time: example")
    for run in runs(name):
        times = f"{run.processor} of processor time, {run.total} in total"
        is_default = run is runs(name)[-1]
        examples += _choice("radio", "example", str(run.example), is_default, f"{run.statements} statements, {times}")
    html = element("fieldset", html) + element("fieldset", examples)
    key = definitions(((character, escape(meaning)) for character, meaning in SIGNS.values()), cls="key")
    keys = element("p", "Press <kbd>n</kbd> for the next emendation and <kbd>p</kbd> for the previous one.", cls="keys")
    return element("div", html + key + keys, cls="controls", role="group", aria_label="Display options")


def _choice(kind: str, name: str, value: str, checked: bool, title: str) -> str:
    box = element("input", type=kind, id=f"{name}-{value}", name=name, value=value, checked=checked)
    return element("label", box + " " + text("span", value), title=title)


def _everywhere(listing: Facing) -> str:
    html = "".join(element("div", entry(row, (), listing.program), cls="panel") for row in listing.everywhere)
    for row_id, pieces in listing.dropped:
        lines = "\n".join(f"{piece.line:>4}  {piece.text}" for piece in pieces)
        summary = f"{row_id} replaces {len(pieces)} lines of the witness"
        html += details(summary, preformatted(lines, "lines of the witness"), cls="dropped")
    return html


def _difference(card: Card) -> str:
    """Return how a card differs from the witness, as a key of :data:`SIGNS`, or an empty string if it does not."""
    if not card.witness:
        return "ours"
    if card.changed or any(piece.changed for piece in card.witness):
        return "changed"
    return "blanks" if card.rows else ""


def _card(listing: Facing, card: Card, first_cards: dict[str, Card]) -> str:
    difference = _difference(card)
    html = "".join(element("span", "", id=place, cls="also-at") for place in card.also)
    title = f"card {card.number}: its permanent address"
    html += text("a", card.place, href=f"#{card.place}", cls="place", title=title)
    html += _column("Witness", "".join(map(_piece, card.witness)) or text("span", SIGNS["ours"][1], cls="none"))
    deck = ""
    if difference:
        sign, meaning = SIGNS[difference]
        deck = text("span", sign, cls="sign", title=meaning, role="img", aria_label=meaning)
    deck += code(card.text, card.changed if card.witness else (), "ins")
    html += _column("Deck", deck + text("span", str(card.number), cls="number", title="card of the deck"))
    html += _details(listing, card, first_cards)
    html += "".join(_variant(listing, variant) for variant in card.variants)
    # The class many or noted makes room for the ids of the rows in the margin.
    noted = "many" if len(card.rows) > 1 else "noted" if card.rows else ""
    classes = ("card", card.kind, *(f"of-{layer}" for layer in card.layers), difference, noted)
    return element("li", html, cls=" ".join(filter(None, classes)), id=card.place)


def _piece(piece: Piece) -> str:
    where = f"p. {piece.page}, line {piece.line} of the witness, {piece.source} of the thesis's OCR text"
    number = text("span", str(piece.line), cls="line", title=where)
    return element("span", number + code(piece.text, piece.changed, "del"), cls="piece")


def _column(name: str, inner: str) -> str:
    """Return a cell of a comparison. Screen readers read its name, which in lower case is also its CSS class."""
    return element("div", text("span", f"{name} ", cls="sr") + inner, cls=name.lower())


def _variant(listing: Facing, variant: Variant) -> str:
    rows = ", ".join(link(listing.program, row, row) for row in variant.rows)
    cards = text("code", "\n".join(variant.cards)) if variant.cards else text("span", "no card", cls="none")
    head = element("span", f"with layer {escape(variant.layer)} ({rows})", cls="layer-name")
    return element("div", head + cards, cls=f"otherwise of-{variant.layer}")


def _details(listing: Facing, card: Card, first_cards: dict[str, Card]) -> str:
    inner, there = "", []
    for name in card.applicable_rows:
        if first_cards[name] is card:
            places = [changed.place for changed in listing.cards_of(name)]
            inner += entry(listing.text.row(name), places, listing.program)
        else:
            there.append(name)
    if there:
        links = ", ".join(link(listing.program, name, name) for name in there)
        inner += element("p", f"Also concerned: {links}.", cls="also")
    inner += _facts(listing, card)
    shown = " ".join(card.rows)
    summary = (text("span", shown, cls="rows") if shown else "") + _margin(listing, card)
    summary += text("span", f" details of card {card.place}", cls="sr")
    return element("details", element("summary", summary) + element("div", inner, cls="panel"), cls="about")


def _margin(listing: Facing, card: Card) -> str:
    if card.kind != "statement" or card.text.lstrip().startswith("DIMENSION"):
        return text("span", card.kind if card.kind != "statement" else "storage", cls="quiet")
    cells = []
    for run in runs(listing.program):
        times = run.executions.get(card.number, 0)
        inner = text("span", f"{times}\u00d7") + " " + text("span", str(run.times.get(card.number, "")), cls="time")
        inner = inner if times else text("span", "not executed", cls="quiet")
        cells.append(element("span", inner, cls=f"run example-{run.example}"))
    return "".join(cells)


def _facts(listing: Facing, card: Card) -> str:
    known = uses(listing.program)
    weight = weights(listing.program).get(card.number)

    def to(number: int, condition: str = "") -> str:
        place = listing.cards[number - 1].place
        words = _CONDITIONS.get(condition, condition)
        return link(listing.program, place, place) + (f" ({escape(words)})" if words else "")

    def come(kind: str) -> str:
        return ", ".join(to(jump.card, jump.taken) for jump in known.to(card.number) if jump.kind == kind)

    def go(kind: str) -> str:
        jumps = (jump for jump in known.jumps if jump.card == card.number and jump.kind == kind)
        return ", ".join(to(jump.target, jump.taken) for jump in jumps)

    names = ", ".join(link(listing.program, f"name-{name}", name) for name in known.of(card.number))
    block = next(block for block in commentary(listing.program).blocks if card.number in block.cards)
    first = listing.cards[block.cards.start - 1].place
    facts = (
        ("purpose", f"{link(listing.program, f'about-{first}', block.title)}: {lowered(block.text)}"),
        ("card", f"{card.number} of {len(listing.cards)}; p. {card.page}"),
        ("reached from", come("jump")),
        ("goes to", go("jump")),
        ("ends the loop that begins at", go("again")),
        ("the loop ends at", come("again")),
        ("FORMAT", go("format")),
        ("used by", come("format")),
        ("names", names),
        ("emulator", _run(listing, card)),
        ("altered readings", _weight(weight.detected, weight.formula) if weight else ""),
    )
    return definitions(facts, cls="facts")


def _run(listing: Facing, card: Card) -> str:
    """Return a link that runs an example up to a card, or an empty string if no example executes the card."""
    name = listing.program
    for run in runs(name):
        if run.executions.get(card.number):
            deck = f"example{run.example}" + ("" if programs.built_in(name).number == 1 else "/punched")
            return run_link(name, deck, f"run example {run.example} and stop here", stop=f"CARD {card.number}")
    return ""


def _weight(detected: tuple[int, ...], formula: str) -> str:
    counts = ", ".join(
        f"{count} undetected" if check == "nothing" else f"{count} detected by {check}"
        for check, count in zip(DETECTED_BY, detected, strict=True)
        if count
    )
    sentence = f"{sum(detected)}: {counts}" + (f"; computes {formula}" if formula else "")
    return escape(sentence) + bar((f"w-{check}", count) for check, count in zip(DETECTED_BY, detected, strict=True))


def _names(program: str) -> Part:
    gloss_of = {gloss.name: gloss for gloss in commentary(program).variables}
    rows = []
    for name in uses(program).names:
        code = text("code", name.name, id=f"name-{name.name}")
        meaning = _meaning(gloss_of[name.name]) if name.name in gloss_of else ""
        cards = (_places(program, numbers) for numbers in (name.declared, name.set, name.used))
        rows.append((code, meaning, _type_of(name), *cards))
    return Part("Names", "names", html=table(("name", "meaning", "type", "declared", "set", "used"), rows, "Names"))


def _formats(program: str) -> Part:
    rows = []
    for card in facing(program).cards:
        if card.kind == "format":
            users = [jump for jump in uses(program).to(card.number) if jump.kind == "format"]
            used = ", ".join(f"{_places(program, (jump.card,))} {escape(jump.taken)}" for jump in users)
            specification = card.text.split("FORMAT", 1)[1].strip()
            rows.append((link(program, card.place, str(card.label)), text("code", specification), used or "nothing"))
    return Part("FORMATs", "formats", html=table(("FORMAT", "specification", "used by"), rows, "FORMATs"))


def _places(program: str, numbers: Iterable[int]) -> str:
    places = (facing(program).cards[number - 1].place for number in numbers)
    return ", ".join(link(program, place, place) for place in places)


def _meaning(gloss: Gloss) -> str:
    return lowered(gloss.text) + (f" From {gloss.limits[0]} to {gloss.limits[1]}." if gloss.limits else "")


def _type_of(name: Name) -> str:
    if name.function:
        return "library function"
    mode = "floating point" if name.floating else "fixed point"
    size = f", array of {' by '.join(map(str, name.shape))}" if name.shape else ""
    return mode + size
