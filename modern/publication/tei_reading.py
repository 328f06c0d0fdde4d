"""Restore the witness, the corrected text, the deck and the cards from a TEI document of this edition.

The module is the inverse of :mod:`modern.publication.tei`. It shares no code with that module or with the apparatus.
Therefore a successful round trip proves that the document is complete.
"""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from xml.etree.ElementTree import Element, ParseError, fromstring

from emulator.errors import EmulatorError, quoted

_TEI = "{http://www.tei-c.org/ns/1.0}"
_ID = "{http://www.w3.org/XML/1998/namespace}id"
# The paths of the divisions of a document, and of its files of cards and typed lines.
_DIVISIONS = f".//{_TEI}body/{_TEI}div"
_FILES = f"{_DIVISIONS}[@type='devices']/{_TEI}div"


class TeiError(EmulatorError, ValueError):
    """Raised for a file that is not a TEI document of this edition, or that lacks a requested part."""


def parsed(name: str, source: str) -> Element:
    """Parse a document and return its root element. Raise TeiError with the name of the file if it is not TEI."""
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
    names = (category.get(_ID, "") for category in root.iter(_TEI + "category"))
    return tuple(name.removeprefix("layer-") for name in names if name.startswith("layer-"))


def printed_layers(root: Element) -> frozenset[str]:
    """Return the layers whose changes belong to the edited text."""
    edited = root.iterfind(f".//{_TEI}category[@{_ID}='layers-edited']/{_TEI}category")
    return frozenset(category.get(_ID, "").removeprefix("layer-") for category in edited)


def witness(root: Element) -> str:
    """Return the witness exactly as its file has it, with page marks."""
    state = _State.of(root, frozenset())
    lines: list[str] = []
    for element in _listing(root):
        if element.tag == _TEI + "pb":
            lines.append(f"## page {element.get('n', '')}")
        elif element.tag == _TEI + "ab" and element.get("n"):
            lines.append(state.reading(element))
    return "".join(line + "\n" for line in lines)


def corrected(root: Element, selected: Collection[str] | None = None) -> str:
    """Return the text with the changes of the selected layers.

    By default these are the layers of the edited text. For a listing, the result is the deck.
    """
    state = _State.of(root, printed_layers(root) if selected is None else selected)
    lines = (state.reading(ab) for ab in _listing(root) if ab.tag == _TEI + "ab" and ab.get("type") == "line")
    return "".join(line + "\n" for line in lines if line.strip())


def parts(root: Element) -> tuple[str, ...]:
    """Return the names of the files of cards and typed lines in a document, such as ``example4/program1.deck``."""
    return tuple(div.get("n", "") for div in root.iterfind(_FILES))


def part(root: Element, name: str) -> str:
    """Return a file of cards or typed lines that the document contains, with one line for each card.

    Raise TeiError if the document does not contain a file of this name.
    """
    for div in root.iterfind(_FILES):
        if div.get("n") == name:
            return "".join(_card(ab) + "\n" for ab in div.iterfind(_TEI + "ab"))
    held = ", ".join(parts(root)) or "none"
    raise TeiError(f"unknown part {quoted(name)}; the document has {held}")


def _listing(root: Element) -> Iterator[Element]:
    for div in root.iterfind(_DIVISIONS):
        if div.get("type") in ("listing", "print"):
            yield from div


@dataclass(frozen=True)
class _State:
    """The text after some of its emendations.

    ``rows`` has the references (``#id``) of the ``app`` elements whose emendations are made. ``pieces`` has the ``seg``
    elements of displaced text. The key of each element is the reference of the place to which the text is moved.
    """

    rows: frozenset[str]
    pieces: Mapping[str, Element]

    @classmethod
    def of(cls, root: Element, chosen: Collection[str]) -> "_State":
        rows = {f"#{app.get(_ID)}" for app in root.iter(_TEI + "app") if app.get(_ID) and app.get("type") in chosen}
        segs = {f"#{seg.get(_ID)}": seg for seg in root.iter(_TEI + "seg")}
        pieces = {}
        for move in root.iter(_TEI + "transpose"):
            piece, place = (pointer.get("target", "") for pointer in (move[0], move[-1]))
            if move.get("corresp") in rows and piece in segs:
                pieces[place] = segs[piece]
        return cls(frozenset(rows), pieces)

    def reading(self, element: Element) -> str:
        """Return the characters of a line, a reading or a displaced piece in this state."""
        return (element.text or "") + "".join(self._part(child) + (child.tail or "") for child in element)

    def _part(self, child: Element) -> str:
        applies = child.get("corresp", f"#{child.get(_ID)}") in self.rows
        match child.tag.removeprefix(_TEI):
            case "app":
                return next((self.reading(part) for part in child if _is_ours(part) == applies), "")
            case "choice":
                # The patch is the last element; its row decides.
                return self.reading(child[-1] if child[-1].get("corresp") in self.rows else child[0])
            case "space" if applies:
                return _blanks(child)
            case "surplus" | "seg" if not applies:
                return self.reading(child)
            case "anchor" if f"#{child.get(_ID)}" in self.pieces:
                return self.reading(self.pieces[f"#{child.get(_ID)}"])
        return ""


def _is_ours(reading: Element) -> bool | None:
    """Return True for a reading of the edition or of a lost state of a program, and False for a reading of the OCR
    text.

    Return None for a rejected reading and for an element that is no reading.
    """
    if reading.tag not in (_TEI + "lem", _TEI + "rdg") or reading.get("type") == "rejected":
        return None
    return "#ocr" not in reading.get("wit", "").split()


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
