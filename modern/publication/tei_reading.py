"""Restore witness, corrected text, deck and cards from a TEI document of this edition.

The module is the inverse of :mod:`modern.publication.tei`.  It shares no code with that module or with the apparatus,
so that a successful round trip proves that the document is complete.
"""

from collections.abc import Collection, Iterator
from xml.etree.ElementTree import Element, ParseError, fromstring

from emulator.errors import EmulatorError, quoted

_TEI = "{http://www.tei-c.org/ns/1.0}"
_ID = "{http://www.w3.org/XML/1998/namespace}id"


class TeiError(EmulatorError, ValueError):
    """A file is not a TEI document of this edition, or lacks the requested part."""


def parsed(name: str, source: str) -> Element:
    """Parse a document and return its root element.  Raise TeiError with the name of the file if that fails."""
    try:
        root = fromstring(source)
    except ParseError as error:
        line, column = error.position
        raise TeiError(
            f"{name}, line {line}, column {column + 1}: not well-formed XML: {str(error).split(':')[0]}"
        ) from None
    if root.tag != _TEI + "TEI" or root.find(f".//{_TEI}body") is None:
        raise TeiError(f"{name}: not a TEI document with a text")
    return root


def layers(root: Element) -> tuple[str, ...]:
    """Return the layers that a document declares, in order."""
    taxonomies = root.iterfind(f".//{_TEI}taxonomy")
    named = [c.get(_ID, "") for t in taxonomies if t.get(_ID) == "layer" for c in t.iterfind(_TEI + "category")]
    return tuple(name.removeprefix("layer-") for name in named)


def printed_layers(root: Element) -> frozenset[str]:
    """Return the layers of the edited text, whose readings are the lemmas."""
    return frozenset(
        app.get("type", "") for app in root.iter(_TEI + "app") for lem in app.iterfind(_TEI + "lem") if lem.get("resp")
    )


def witness(root: Element) -> str:
    """Return the witness as it is in its file, with page marks."""
    lines: list[str] = []
    for element in _listing(root):
        if element.tag == _TEI + "pb":
            lines.append(f"## page {element.get('n', '')}")
        elif element.tag == _TEI + "ab" and element.get("n"):
            lines.append(_reading(element, frozenset()))
    return "".join(line + "\n" for line in lines)


def corrected(root: Element, selected: Collection[str] | None = None) -> str:
    """Return the text with the selected layers, by default those of the edited text (for a listing, the deck)."""
    chosen = printed_layers(root) if selected is None else selected
    lines = (_reading(ab, chosen) for ab in _listing(root) if ab.tag == _TEI + "ab" and ab.get("type") == "line")
    return "".join(line + "\n" for line in lines if line.strip())


def parts(root: Element) -> tuple[str, ...]:
    """Return the names of the device files in a document."""
    return tuple(div.get("n", "") for div in _devices(root))


def part(root: Element, name: str) -> str:
    """Return a device file with one line for each card.  Raise TeiError if the document does not have it."""
    for div in _devices(root):
        if div.get("n") == name:
            return "".join(_card(ab) + "\n" for ab in div.iterfind(_TEI + "ab"))
    held = ", ".join(parts(root)) or "none"
    raise TeiError(f"unknown part {quoted(name)}; the document has {held}")


def _divisions(root: Element, types: Collection[str]) -> Iterator[Element]:
    body = root.find(f".//{_TEI}body")
    for div in () if body is None else body.iterfind(_TEI + "div"):
        if div.get("type") in types:
            yield div


def _listing(root: Element) -> Iterator[Element]:
    for div in _divisions(root, ("listing", "print")):
        yield from div


def _devices(root: Element) -> Iterator[Element]:
    for div in _divisions(root, ("devices",)):
        yield from div.iterfind(_TEI + "div")


def _reading(element: Element, chosen: Collection[str]) -> str:
    """Return the characters of a line or of a reading, with one reading of each app."""
    text = element.text or ""
    for child in element:
        if child.tag == _TEI + "app":
            text += _chosen(child, chosen)
        text += child.tail or ""
    return text


def _chosen(app: Element, chosen: Collection[str]) -> str:
    ours = app.get("type") in chosen
    for reading in app:
        is_reading = reading.tag in (_TEI + "lem", _TEI + "rdg") and reading.get("type") != "rejected"
        if is_reading and bool(reading.get("wit")) != ours:
            return _reading(reading, chosen)
    return ""


def _card(ab: Element) -> str:
    text = ab.text or ""
    for child in ab:
        text += _blanks(child) if child.tag == _TEI + "space" else child.text or ""
        text += child.tail or ""
    return text


def _blanks(space: Element) -> str:
    quantity = space.get("quantity", "")
    if not quantity.isdecimal() or int(quantity) > 80:
        raise TeiError(f"a space of {quoted(quantity)} characters; a card has 80 columns")
    return " " * int(quantity)
