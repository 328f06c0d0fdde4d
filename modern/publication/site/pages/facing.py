"""A listing as facing text: the witness left, the deck right, and beside every card what is known of it.

Text first: without JavaScript and without style every card, every row and every address is there.  Which layers are
marked and which example's figures stand in the margin is chosen by form controls that CSS alone obeys.
"""

from __future__ import annotations

from collections.abc import Iterator

from modern.edition import programs
from modern.edition.apparatus import Row
from modern.publication.facing import Card, Facing, Otherwise, Piece, facing
from modern.publication.measured import NOTICED, Run, runs, weights
from modern.publication.site.entries import LAYERS, entry
from modern.publication.site.made import Made, Part, Target, one_of
from modern.publication.site.markup import code, definitions, element, escape, link, text
from modern.publication.site.pages.symbols import symbols
from modern.publication.uses import Jump, uses

SIGNS = {"ours": "+", "changed": "\u2260", "blanks": "\u2423"}
"""What stands beside a card: it is not in the witness, characters differ, only blanks differ."""
SAID = {
    "ours": "not in the witness",
    "changed": "differs from the witness",
    "blanks": "differs from the witness in blanks only",
}


def make(argument: str) -> Made:
    """The facing text of a built-in program."""
    name = one_of(argument, programs.NAMES)
    found = facing(name)
    first = {row.id: cards[0] for row in found.rows() if (cards := found.cards_of(row.id))}
    parts = [Part(html=_controls(found))]
    if found.everywhere or found.dropped:
        parts.append(Part("What touches most cards", "everywhere", html=_everywhere(found)))
    for page, cards in found.pages():
        items = "".join(_card(found, card, first) for card in cards)
        html = _head() + element("ol", items, cls="cards")
        parts.append(Part(f"Page {page}", f"page-{page}", html=html))
    made = symbols(name)
    return Made((*parts, *made.parts), (*_targets(found), *made.targets))


def _targets(found: Facing) -> Iterator[Target]:
    name = found.program
    for card in found.cards:
        for place in (card.place, *card.also):
            yield Target(place, f"{name} {place}", f"{name} {place}")
    for page, _ in found.pages():
        yield Target(f"page-{page}", f"{name} page {page}", f"{name}, p. {page}")
    own = {row.id for row in found.rows()}
    if name not in programs.TEXTS:
        own -= {row.id for row in facing(found.text.id).rows()}
    for row in found.rows():
        if row.id in own:
            yield Target(row.id, row.id, row.id, f"rows of the apparatus; {row.id}")


def _controls(found: Facing) -> str:
    """Which layers are marked, and which example's figures stand in the margin."""
    name = found.program
    present = [layer for layer in found.text.layers if any(row.layer == layer for row in found.rows())]
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
            (SIGNS["changed"], escape(SAID["changed"])),
            (SIGNS["blanks"], escape(SAID["blanks"])),
            (SIGNS["ours"], escape(SAID["ours"])),
        ),
        cls="key",
    )
    keys = element("p", "Keys: <kbd>n</kbd> and <kbd>p</kbd> go to the next and the previous emendation.", cls="keys")
    return element("div", html + key + keys, cls="controls", role="group", aria_label="What the text shows")


def _choice(kind: str, id: str, name: str, value: str, on: bool, words: str, title: str) -> str:
    box = element("input", type=kind, id=id, name=name, value=value, checked=on)
    return element("label", box + " " + text("span", words), title=title)


def _run(run: Run) -> tuple[str, str]:
    return str(
        run.example
    ), f"{run.statements} statements, {run.seconds:.0f} s of the processor, {run.total:.0f} s in all"


def _everywhere(found: Facing) -> str:
    html = "".join(element("div", entry(row, (), found.program), cls="panel") for row in found.everywhere)
    for row_id, pieces in found.dropped:
        lines = "\n".join(f"{piece.line:>4}  {piece.text}" for piece in pieces)
        html += element(
            "details",
            text("summary", f"{row_id} takes the place of {len(pieces)} lines of the witness")
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


def _card(found: Facing, card: Card, first: dict[str, Card]) -> str:
    """A card: address, witness, deck, and what is known of it."""
    sign = _sign(card)
    number = text(
        "a", card.place, href=f"#{card.place}", cls="place", title=f"card {card.number}: its permanent address"
    )
    left = "".join(_piece(piece) for piece in card.witness) or text("span", SAID["ours"], cls="none")
    witness = element("div", text("span", "Witness ", cls="sr") + left, cls="witness")
    words = code(card.text, card.changed if card.witness else (), "ins")
    words += text("span", str(card.number), cls="number", title="card of the deck")
    mark = element("span", SIGNS[sign], cls="sign", title=SAID[sign], role="img", aria_label=SAID[sign]) if sign else ""
    deck = element("div", text("span", "Deck ", cls="sr") + mark + words, cls="deck")
    others = "".join(_otherwise(found, other) for other in card.otherwise)
    names = " ".join([card.kind, *(f"of-{layer}" for layer in card.layers), *([sign] if sign else []), *_tall(card)])
    also = "".join(element("span", "", id=place, cls="also-at") for place in card.also)
    return element(
        "li", also + number + witness + deck + _about(found, card, first) + others, cls=f"card {names}", id=card.place
    )


def _tall(card: Card) -> tuple[str, ...]:
    """Room for the rows' names in the margin."""
    return ("many",) if len(card.rows) > 1 else ("noted",) if card.rows else ()


def _piece(piece: Piece) -> str:
    where = f"p. {piece.page}, line {piece.line} of the witness, {piece.source} of the thesis's OCR text"
    number = text("span", str(piece.line), cls="line", title=where)
    return element("span", number + code(piece.text, piece.changed, "del"), cls="piece")


def _otherwise(found: Facing, other: Otherwise) -> str:
    rows = ", ".join(link(found.program, row, row) for row in other.rows)
    cards = text("code", "\n".join(other.cards)) if other.cards else text("span", "no card", cls="none")
    head = element("span", f"with layer {escape(other.layer)} ({rows})", cls="layer-name")
    return element("div", head + cards, cls=f"otherwise of-{other.layer}")


def _about(found: Facing, card: Card, first: dict[str, Card]) -> str:
    """What opens beside a card: the margin as its summary, then rows, jumps, names and the weight of evidence."""
    touching = [*card.rows, *(row for other in card.otherwise for row in other.rows)]
    here = [found.text.row(name) for name in dict.fromkeys(touching) if first[name] is card]
    there = [name for name in dict.fromkeys(touching) if first[name] is not card]
    inner = "".join(entry(row, _addresses(found, row), found.program) for row in here)
    if there:
        links = ", ".join(link(found.program, name, name) for name in there)
        inner += element("p", f"Touched by {links} too.", cls="also")
    inner += _facts(found, card)
    shown = " ".join(card.rows)
    words = (text("span", shown, cls="rows") if shown else "") + _margin(found, card)
    words += text("span", f" about card {card.place}", cls="sr")
    return element("details", element("summary", words) + element("div", inner, cls="panel"), cls="about")


def _addresses(found: Facing, row: Row) -> list[tuple[str, str]]:
    return [(card.place, card.place) for card in found.cards_of(row.id)]


def _margin(found: Facing, card: Card) -> str:
    """Executions and time of every example; CSS shows the chosen one."""
    if card.kind != "statement" or card.text.lstrip().startswith("DIMENSION"):
        return text("span", card.kind if card.kind != "statement" else "storage", cls="quiet")
    cells = []
    for run in runs(found.program):
        times = run.executions.get(card.number, 0)
        inner = text("span", f"{times}\u00d7") + " " + text("span", _seconds(run.times.get(card.number, 0)), cls="time")
        inner = inner if times else text("span", "not run", cls="quiet")
        cells.append(element("span", inner, cls=f"run example-{run.example}"))
    return "".join(cells)


def _seconds(seconds: float) -> str:
    if seconds >= 0.1:
        return f"{seconds:.1f} s" if seconds < 10 else f"{seconds:.0f} s"
    return f"{1000 * seconds:.0f} ms" if seconds >= 0.001 else "<1 ms"


def _facts(found: Facing, card: Card) -> str:
    known = uses(found.program)
    by_number = {each.number: each for each in found.cards}
    weight = weights(found.program).get(card.number)

    def to(number: int, words: str = "") -> str:
        place = by_number[number].place
        return link(found.program, place, place) + (f" ({escape(words)})" if words else "")

    def joined(jumps: list[Jump], end: str) -> str:
        return ", ".join(to(getattr(jump, end), jump.taken) for jump in jumps)

    comes = [jump for jump in known.to(card.number) if jump.kind == "jump"]
    goes = [jump for jump in known.jumps if jump.card == card.number and jump.kind == "jump"]
    ends = [jump for jump in known.jumps if jump.card == card.number and jump.kind == "again"]
    begins = [jump for jump in known.to(card.number) if jump.kind == "again"]
    forms = [jump for jump in known.jumps if jump.card == card.number and jump.kind == "format"]
    users = [jump for jump in known.to(card.number) if jump.kind == "format"]
    names = ", ".join(link(found.program, f"name-{name}", name) for name in known.of(card.number))
    return definitions(
        (
            ("card", f"{card.number} of {len(found.cards)}; p. {card.page}"),
            ("come here", joined(comes, "card")),
            ("goes to", joined(goes, "target")),
            ("ends the loop of", joined(ends, "target")),
            ("its loop ends at", joined(begins, "card")),
            ("FORMAT", joined(forms, "target")),
            ("used by", joined(users, "card")),
            ("names", names),
            ("readings altered", _weight(weight.noticed, weight.formula) if weight else ""),
        ),
        cls="facts",
    )


def _weight(noticed: tuple[int, ...], formula: str) -> str:
    """Of all readings of a card, what notices how many, as words and as a bar."""
    total = sum(noticed)
    told = ", ".join(f"{count} noticed by {what}" for what, count in zip(NOTICED, noticed, strict=True) if count)
    told = told.replace("noticed by nothing", "noticed by nothing at all")
    bar = "".join(
        element("span", "", cls=f"w-{what}", style=f"flex-grow:{count}")
        for what, count in zip(NOTICED, noticed, strict=True)
        if count
    )
    words = f"{total}: {told}" + (f"; computes {formula}" if formula else "")
    return escape(words) + element("span", bar, cls="weight", aria_hidden="true")
