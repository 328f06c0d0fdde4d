"""What a TEI document of ours gives back, from itself alone: witness, corrected text, deck, cards.

It is the other way of :mod:`modern.publication.tei` and shares nothing with it, nor with the apparatus, so that it
shows what the document itself holds.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from xml.etree.ElementTree import Element, ParseError, fromstring

from emulator.errors import EmulatorError

_TEI = "{http://www.tei-c.org/ns/1.0}"
_ID = "{http://www.w3.org/XML/1998/namespace}id"


class TeiError(EmulatorError, ValueError):
    """A file that is no TEI document of this edition, or has no such part; one line naming the file."""


def parsed(name: str, source: str) -> Element:
    """The document's root element.  ``name`` is the file's, for the message.  Raises TeiError."""
    try:
        root = fromstring(source)
    except ParseError as error:
        line, column = error.position
        raise TeiError(f"{name}, line {line}, column {column + 1}: no XML: {str(error).split(':')[0]}") from None
    if root.tag != _TEI + "TEI" or root.find(f".//{_TEI}body") is None:
        raise TeiError(f"{name}: no TEI document with a text")
    return root


def layers(root: Element) -> tuple[str, ...]:
    """The layers a document knows, in their order."""
    found = root.iterfind(f".//{_TEI}taxonomy")
    named = [c.get(_ID, "") for t in found if t.get(_ID) == "layer" for c in t.iterfind(_TEI + "category")]
    return tuple(name.removeprefix("layer-") for name in named)


def printed_layers(root: Element) -> frozenset[str]:
    """The layers of the edition's own text: those whose reading is the lemma."""
    return frozenset(
        app.get("type", "") for app in root.iter(_TEI + "app") for lem in app.iterfind(_TEI + "lem") if lem.get("resp")
    )


def witness(root: Element) -> str:
    """The witness as its file has it, page marks too."""
    lines: list[str] = []
    for element in _listing(root):
        if element.tag == _TEI + "pb":
            lines.append(f"## page {element.get('n', '')}")
        elif element.tag == _TEI + "ab" and element.get("n"):
            lines.append(_reading(element, frozenset()))
    return "".join(line + "\n" for line in lines)


def corrected(root: Element, wanted: Collection[str] | None = None) -> str:
    """The text with the rows of ``wanted`` layers (default: those of the edition's text), a line a line.

    For a listing it is the deck.
    """
    chosen = printed_layers(root) if wanted is None else wanted
    lines = (_reading(ab, chosen) for ab in _listing(root) if ab.tag == _TEI + "ab" and ab.get("type") == "line")
    return "".join(line + "\n" for line in lines if line.strip())


def parts(root: Element) -> tuple[str, ...]:
    """The names of the device files a document holds."""
    return tuple(div.get("n", "") for div in _devices(root))


def part(root: Element, name: str) -> str:
    """A device file: its cards, a line each.  Raises TeiError."""
    for div in _devices(root):
        if div.get("n") == name:
            return "".join(_card(ab) + "\n" for ab in div.iterfind(_TEI + "ab"))
    held = ", ".join(parts(root)) or "none"
    raise TeiError(f"there is no part {name!r}; the document has {held}")


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
    """The characters of a line, or of a reading, with one reading of each app."""
    found = element.text or ""
    for child in element:
        if child.tag == _TEI + "app":
            found += _chosen(child, chosen)
        found += child.tail or ""
    return found


def _chosen(app: Element, chosen: Collection[str]) -> str:
    ours = app.get("type") in chosen
    for reading in app:
        kept = reading.tag in (_TEI + "lem", _TEI + "rdg") and reading.get("type") != "rejected"
        if kept and bool(reading.get("wit")) != ours:
            return _reading(reading, chosen)
    return ""


def _card(ab: Element) -> str:
    found = ab.text or ""
    for child in ab:
        found += _blanks(child) if child.tag == _TEI + "space" else child.text or ""
        found += child.tail or ""
    return found


def _blanks(space: Element) -> str:
    given = space.get("quantity", "")
    if not given.isdecimal() or int(given) > 80:
        raise TeiError(f"a space of {given!r} characters; a card has 80 columns")
    return " " * int(given)
