"""A listing as facing text: the witness on the left, the deck on the right, and details for every card.

All cards, rows and addresses are plain HTML and need neither JavaScript nor CSS.  The reader chooses the highlighted
layers and the example whose figures appear in the margin with form controls, which CSS evaluates.
"""

from __future__ import annotations

from collections.abc import Iterator

from modern.edition import programs
from modern.edition.apparatus import Row
from modern.publication.facing import Card, Facing, Piece, Variant, facing
from modern.publication.measured import DETECTED_BY, Run, runs, weights
from modern.publication.site.entries import entry
from modern.publication.site.made import Made, Part, Target, one_of
from modern.publication.site.markup import code, definitions, element, escape, link, text
from modern.publication.site.pages.symbols import symbols
from modern.publication.tei import LAYERS
from modern.publication.uses import Jump, uses

SIGNS = {"ours": "+", "changed": "\u2260", "blanks": "\u2423"}
"""The sign of a card that is not in the witness, differs from it, or differs in blanks only."""
SIGN_MEANINGS = {
    "ours": "not in the witness",
    "changed": "differs from the witness",
    "blanks": "differs from the witness in blanks only",
}


def make(argument: str) -> Made:
    """Return the facing text of a built-in program."""
    name = one_of(argument, programs.NAMES)
    listing = facing(name)
    first_cards = {row.id: cards[0] for row in listing.rows() if (cards := listing.cards_of(row.id))}
    parts = [Part(html=_controls(listing))]
    if listing.everywhere or listing.dropped:
        parts.append(Part("Rows that concern most cards", "everywhere", html=_everywhere(listing)))
    for page, cards in listing.pages():
        items = "".join(_card(listing, card, first_cards) for card in cards)
        html = _head() + element("ol", items, cls="cards")
        parts.append(Part(f"Page {page}", f"page-{page}", html=html))
    tables = symbols(name)
    return Made((*parts, *tables.parts), (*_targets(listing), *tables.targets))


def _targets(listing: Facing) -> Iterator[Target]:
    name = listing.program
    for card in listing.cards:
        for place in (card.place, *card.also):
            yield Target(place, f"{name} {place}", f"{name} {place}")
    for page, _ in listing.pages():
        yield Target(f"page-{page}", f"{name} page {page}", f"{name}, p. {page}")
    # The page of program 1 as listed is the address of the rows that the state of the examples shares with it.
    own = {row.id for row in listing.rows()}
    if name not in programs.TEXTS:
        own -= {row.id for row in facing(listing.text.id).rows()}
    for row in listing.rows():
        if row.id in own:
            yield Target(row.id, row.id, row.id, f"rows of the apparatus; {row.id}")


def _controls(listing: Facing) -> str:
    """Return the controls that choose the highlighted layers and the example in the margin."""
    name = listing.program
    present = [layer for layer in listing.text.layers if any(row.layer == layer for row in listing.rows())]
    shown = programs.built_in(name).layers
    layers = "".join(_choice("checkbox", f"layer-{n}", "layer", n, n in shown, n, LAYERS[n]) for n in present)
    chosen = runs(name)
    default = chosen[-1].example
    examples = "".join(
        _choice("radio", f"example-{run.example}", "example", str(run.example), run.example == default, *_run(run))
        for run in chosen
    )
    html = element("fieldset", text("legend", "Layers") + layers)
    html += element("fieldset", text("legend", "Executions and time: example") + examples)
    key = definitions(
        (
            (SIGNS["changed"], escape(SIGN_MEANINGS["changed"])),
            (SIGNS["blanks"], escape(SIGN_MEANINGS["blanks"])),
            (SIGNS["ours"], escape(SIGN_MEANINGS["ours"])),
        ),
        cls="key",
    )
    keys = element("p", "Press <kbd>n</kbd> for the next emendation and <kbd>p</kbd> for the previous one.", cls="keys")
    return element("div", html + key + keys, cls="controls", role="group", aria_label="Display options")


def _choice(kind: str, id: str, name: str, value: str, checked: bool, label: str, title: str) -> str:
    box = element("input", type=kind, id=id, name=name, value=value, checked=checked)
    return element("label", box + " " + text("span", label), title=title)


def _run(run: Run) -> tuple[str, str]:
    """Return the label and the title of an example's control."""
    times = f"{run.seconds:.0f} s of processor time, {run.total:.0f} s in total"
    return str(run.example), f"{run.statements} statements, {times}"


def _everywhere(listing: Facing) -> str:
    html = "".join(element("div", entry(row, (), listing.program), cls="panel") for row in listing.everywhere)
    for row_id, pieces in listing.dropped:
        lines = "\n".join(f"{piece.line:>4}  {piece.text}" for piece in pieces)
        html += element(
            "details",
            text("summary", f"{row_id} replaces {len(pieces)} lines of the witness")
            + element("pre", escape(lines), tabindex="0", aria_label="lines of the witness"),
            cls="dropped",
        )
    return html


def _head() -> str:
    names = ("place", "witness: line and text", "deck", "executions, time")
    return element("div", "".join(text("span", name) for name in names), cls="card-head", aria_hidden="true")


def _sign(card: Card) -> str:
    if not card.witness:
        return "ours"
    if card.changed or any(piece.changed for piece in card.witness):
        return "changed"
    return "blanks" if card.rows else ""


def _card(listing: Facing, card: Card, first_cards: dict[str, Card]) -> str:
    """Return a card with its address, witness, deck and details."""
    sign = _sign(card)
    number = text(
        "a", card.place, href=f"#{card.place}", cls="place", title=f"card {card.number}: its permanent address"
    )
    left = "".join(_piece(piece) for piece in card.witness) or text("span", SIGN_MEANINGS["ours"], cls="none")
    witness = element("div", text("span", "Witness ", cls="sr") + left, cls="witness")
    card_html = code(card.text, card.changed if card.witness else (), "ins")
    card_html += text("span", str(card.number), cls="number", title="card of the deck")
    mark = (
        element("span", SIGNS[sign], cls="sign", title=SIGN_MEANINGS[sign], role="img", aria_label=SIGN_MEANINGS[sign])
        if sign
        else ""
    )
    deck = element("div", text("span", "Deck ", cls="sr") + mark + card_html, cls="deck")
    variants = "".join(_variant(listing, variant) for variant in card.variants)
    names = " ".join([card.kind, *(f"of-{layer}" for layer in card.layers), *([sign] if sign else []), *_tall(card)])
    also = "".join(element("span", "", id=place, cls="also-at") for place in card.also)
    return element(
        "li",
        also + number + witness + deck + _details(listing, card, first_cards) + variants,
        cls=f"card {names}",
        id=card.place,
    )


def _tall(card: Card) -> tuple[str, ...]:
    """Return the CSS class that makes room for the ids of the rows in the margin."""
    return ("many",) if len(card.rows) > 1 else ("noted",) if card.rows else ()


def _piece(piece: Piece) -> str:
    where = f"p. {piece.page}, line {piece.line} of the witness, {piece.source} of the thesis's OCR text"
    number = text("span", str(piece.line), cls="line", title=where)
    return element("span", number + code(piece.text, piece.changed, "del"), cls="piece")


def _variant(listing: Facing, variant: Variant) -> str:
    rows = ", ".join(link(listing.program, row, row) for row in variant.rows)
    cards = text("code", "\n".join(variant.cards)) if variant.cards else text("span", "no card", cls="none")
    head = element("span", f"with layer {escape(variant.layer)} ({rows})", cls="layer-name")
    return element("div", head + cards, cls=f"otherwise of-{variant.layer}")


def _details(listing: Facing, card: Card, first_cards: dict[str, Card]) -> str:
    """Return the details of a card below the margin: rows, jumps, names and the weight of evidence."""
    touching = [*card.rows, *(row for variant in card.variants for row in variant.rows)]
    here = [listing.text.row(name) for name in dict.fromkeys(touching) if first_cards[name] is card]
    there = [name for name in dict.fromkeys(touching) if first_cards[name] is not card]
    inner = "".join(entry(row, _addresses(listing, row), listing.program) for row in here)
    if there:
        links = ", ".join(link(listing.program, name, name) for name in there)
        inner += element("p", f"Also concerned: {links}.", cls="also")
    inner += _facts(listing, card)
    shown = " ".join(card.rows)
    summary = (text("span", shown, cls="rows") if shown else "") + _margin(listing, card)
    summary += text("span", f" details of card {card.place}", cls="sr")
    return element("details", element("summary", summary) + element("div", inner, cls="panel"), cls="about")


def _addresses(listing: Facing, row: Row) -> list[tuple[str, str]]:
    return [(card.place, card.place) for card in listing.cards_of(row.id)]


def _margin(listing: Facing, card: Card) -> str:
    """Return the executions and the time in every example; CSS shows the chosen example."""
    if card.kind != "statement" or card.text.lstrip().startswith("DIMENSION"):
        return text("span", card.kind if card.kind != "statement" else "storage", cls="quiet")
    cells = []
    for run in runs(listing.program):
        times = run.executions.get(card.number, 0)
        inner = text("span", f"{times}\u00d7") + " " + text("span", _seconds(run.times.get(card.number, 0)), cls="time")
        inner = inner if times else text("span", "not executed", cls="quiet")
        cells.append(element("span", inner, cls=f"run example-{run.example}"))
    return "".join(cells)


def _seconds(seconds: float) -> str:
    if seconds >= 0.1:
        return f"{seconds:.1f} s" if seconds < 10 else f"{seconds:.0f} s"
    return f"{1000 * seconds:.0f} ms" if seconds >= 0.001 else "<1 ms"


def _facts(listing: Facing, card: Card) -> str:
    known = uses(listing.program)
    by_number = {other.number: other for other in listing.cards}
    weight = weights(listing.program).get(card.number)

    def to(number: int, condition: str = "") -> str:
        place = by_number[number].place
        return link(listing.program, place, place) + (f" ({escape(condition)})" if condition else "")

    def joined(jumps: list[Jump], end: str) -> str:
        return ", ".join(to(getattr(jump, end), jump.taken) for jump in jumps)

    comes = [jump for jump in known.to(card.number) if jump.kind == "jump"]
    goes = [jump for jump in known.jumps if jump.card == card.number and jump.kind == "jump"]
    ends = [jump for jump in known.jumps if jump.card == card.number and jump.kind == "again"]
    starts = [jump for jump in known.to(card.number) if jump.kind == "again"]
    forms = [jump for jump in known.jumps if jump.card == card.number and jump.kind == "format"]
    users = [jump for jump in known.to(card.number) if jump.kind == "format"]
    names = ", ".join(link(listing.program, f"name-{name}", name) for name in known.of(card.number))
    return definitions(
        (
            ("card", f"{card.number} of {len(listing.cards)}; p. {card.page}"),
            ("reached from", joined(comes, "card")),
            ("goes to", joined(goes, "target")),
            ("ends the loop that begins at", joined(ends, "target")),
            ("the loop ends at", joined(starts, "card")),
            ("FORMAT", joined(forms, "target")),
            ("used by", joined(users, "card")),
            ("names", names),
            ("altered readings", _weight(weight.detected, weight.formula) if weight else ""),
        ),
        cls="facts",
    )


def _weight(detected: tuple[int, ...], formula: str) -> str:
    """Return the numbers of altered readings that each check detects, as text and as a bar."""
    counts = ", ".join(
        f"{count} undetected" if check == "nothing" else f"{count} detected by {check}"
        for check, count in zip(DETECTED_BY, detected, strict=True)
        if count
    )
    bar = "".join(
        element("span", "", cls=f"w-{check}", style=f"flex-grow:{count}")
        for check, count in zip(DETECTED_BY, detected, strict=True)
        if count
    )
    sentence = f"{sum(detected)}: {counts}" + (f"; computes {formula}" if formula else "")
    return escape(sentence) + element("span", bar, cls="weight", aria_hidden="true")
