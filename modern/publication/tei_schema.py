"""Compile the project's ODD to RELAX NG.

The file ``hull1620.odd`` describes every element and attribute of the TEI documents, and their meaning in this edition
(TEI P5, chapter 22). The compiler needs no TEI software, because each ``elementSpec`` replaces the definition of the
TEI completely and its content model names elements instead of classes.
"""

from collections.abc import Iterable
from functools import cache
from importlib.resources import files
from xml.etree.ElementTree import Element, SubElement, fromstring, indent, tostring

FILE_NAME = "hull1620.rng"
_TEI = "{http://www.tei-c.org/ns/1.0}"
_RNG = "http://relaxng.org/ns/structure/1.0"
_DATATYPES = "http://www.w3.org/2001/XMLSchema-datatypes"
# The RELAX NG element around a pattern, by the least and the largest number of its occurrences.
_OCCURRENCE = {("0", "1"): "optional", ("0", "unbounded"): "zeroOrMore", ("1", "unbounded"): "oneOrMore"}


def odd() -> str:
    """Return the ODD, which documents the project's use of TEI and from which the schema is compiled."""
    return files("modern").joinpath("publication", "hull1620.odd").read_text(encoding="utf-8")


@cache
def schema() -> str:
    """Return the RELAX NG schema compiled from the ODD."""
    spec = fromstring(odd()).find(f".//{_TEI}schemaSpec")
    assert spec is not None
    grammar = Element("grammar", xmlns=_RNG, ns=_TEI[1:-1], datatypeLibrary=_DATATYPES)
    SubElement(SubElement(grammar, "start"), "ref", name=spec.get("start", ""))
    for macro in spec.iter(f"{_TEI}macroSpec"):
        _contents(SubElement(grammar, "define", name=macro.get("ident", "")), macro)
    for group in spec.iter(f"{_TEI}classSpec"):
        _attributes(SubElement(grammar, "define", name=group.get("ident", "")), group)
    for specification in spec.iter(f"{_TEI}elementSpec"):
        name = specification.get("ident", "")
        element = SubElement(SubElement(grammar, "define", name=name), "element", name=name)
        _attributes(element, specification)
        _contents(element, specification)
    indent(grammar, " ")
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(grammar, encoding="unicode") + "\n"


def _contents(parent: Element, specification: Element) -> None:
    for pattern in specification.iterfind(f"{_TEI}content/*"):
        _pattern(parent, pattern)


def _pattern(parent: Element, pattern: Element) -> None:
    """Write a part of a content model: a reference, a text, or a sequence or choice of such parts."""
    wrapper = _OCCURRENCE.get((pattern.get("minOccurs", "1"), pattern.get("maxOccurs", "1")))
    target = parent if wrapper is None else SubElement(parent, wrapper)
    match pattern.tag.removeprefix(_TEI):
        case "elementRef" | "macroRef":
            SubElement(target, "ref", name=pattern.get("key", ""))
        case "textNode":
            SubElement(target, "text")
        case "empty":
            SubElement(target, "empty")
        case kind:
            inner = SubElement(target, {"alternate": "choice", "sequence": "group"}[kind])
            for child in pattern:
                _pattern(inner, child)


def _attributes(parent: Element, specification: Element) -> None:
    for member in specification.iterfind(f"{_TEI}classes/*"):
        SubElement(parent, "ref", name=member.get("key", ""))
    for entries in specification.iterfind(_TEI + "attList"):
        _attribute_list(parent, entries)


def _attribute_list(target: Element, entries: Element) -> None:
    for entry in entries:
        if entry.tag == _TEI + "attList":
            _attribute_list(SubElement(target, "choice" if entry.get("org") == "choice" else "group"), entry)
            continue
        required = entry.get("usage") == "req"
        attribute = SubElement(target if required else SubElement(target, "optional"), "attribute")
        attribute.set("name", entry.get("ident", ""))
        _values(attribute, entry)


def _values(attribute: Element, entry: Element) -> None:
    """Write whether an attribute has one value or several, and its permitted values: a closed list or a datatype."""
    data = entry.find(f"{_TEI}datatype/{_TEI}dataRef")
    values = [item.get("ident", "") for item in entry.iterfind(f"{_TEI}valList/{_TEI}valItem")]
    if data is None:
        _choices(attribute, values)
        return
    many = entry.find(_TEI + "datatype").get("maxOccurs") == "unbounded"  # type: ignore[union-attr]
    target = SubElement(SubElement(attribute, "list"), "oneOrMore") if many else attribute
    if values:
        _choices(target, values)
        return
    SubElement(target, "data", type=data.get("name", ""))


def _choices(parent: Element, values: Iterable[str]) -> None:
    choice = SubElement(parent, "choice")
    for value in values:
        SubElement(choice, "value").text = value
