"""The variables and FORMAT statements of a program: type, size, and the cards that declare, set and use them."""

from modern.edition import programs
from modern.publication.facing import facing
from modern.publication.site.made import Made, Part, Target, one_of
from modern.publication.site.markup import escape, link, table, text
from modern.publication.uses import Name, uses


def make(argument: str) -> Made:
    """Return the table of names and the table of FORMATs of a built-in program, with their addresses."""
    program = one_of(argument, programs.NAMES)
    known, cards = uses(program), {card.number: card for card in facing(program).cards}

    def places(numbers: tuple[int, ...]) -> str:
        return ", ".join(link(program, cards[n].place, cards[n].place) for n in numbers)

    rows, targets = [], []
    for name in known.names:
        code = text("code", name.name, id=f"name-{name.name}")
        rows.append((code, _kind(name), *map(places, (name.declared, name.set, name.used))))
        index = f"{name.name}; {program}"
        targets.append(Target(f"name-{name.name}", f"name {program} {name.name}", name.name, index))
    names = table(("name", "type", "declared", "set", "used"), rows, "Names")
    formats = []
    for card in cards.values():
        if card.kind == "format":
            users = [jump for jump in known.to(card.number) if jump.kind == "format"]
            used = ", ".join(f"{places((jump.card,))} {escape(jump.taken)}" for jump in users)
            specification = card.text.split("FORMAT", 1)[1].strip()
            formats.append((link(program, card.place, str(card.label)), text("code", specification), used or "nothing"))
    parts = (
        Part("Names", "names", html=names),
        Part("FORMATs", "formats", html=table(("FORMAT", "specification", "used by"), formats, "FORMATs")),
    )
    return Made(parts, tuple(targets))


def _kind(name: Name) -> str:
    if name.function:
        return "library function"
    mode = "floating point" if name.floating else "fixed point"
    size = f", array of {' by '.join(map(str, name.shape))}" if name.shape else ""
    return mode + size
