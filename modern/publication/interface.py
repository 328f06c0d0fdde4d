"""The reference of the Python interface, made from a package: every public name with its signature and its docstring.

:func:`names` reads the package (``hull1620``) into plain data, :func:`as_markdown` sets them out; site and book put the
text where a page says ``{{ python }}`` (``modern/publication/figures.py``).
"""

from __future__ import annotations

import inspect
import re
import textwrap
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from types import ModuleType
from typing import Literal

Kind = Literal["function", "class", "exception"]
KINDS: tuple[Kind, ...] = ("function", "class", "exception")
_HEADS = {"function": "Functions", "class": "Classes", "exception": "Exceptions"}


@dataclass(frozen=True, slots=True)
class Member:
    """A public method or property of a class: its signature, empty for a property, and what its docstring says."""

    name: str
    signature: str
    says: str


@dataclass(frozen=True, slots=True)
class Name:
    """A public name: its kind, its signature as it is called, its docstring, its home, and its members."""

    name: str
    kind: Kind
    signature: str
    says: str
    home: str
    members: tuple[Member, ...] = ()


def names(package: ModuleType) -> tuple[Name, ...]:
    """Every name of the package's ``__all__``, in its order."""
    return tuple(_name(name, getattr(package, name)) for name in package.__all__)


def _name(name: str, found: object) -> Name:
    says, home = inspect.getdoc(found) or "", getattr(found, "__module__", "")
    if not inspect.isclass(found):
        return Name(name, "function", _signature(found), says, home)
    if issubclass(found, Exception):
        return Name(name, "exception", "", says, home)
    return Name(name, "class", _signature(found), says, home, tuple(_members(found)))


def _members(found: type) -> Iterator[Member]:
    for name, value in vars(found).items():
        if name.startswith("_") or not (said := inspect.getdoc(value)):
            continue
        if isinstance(value, property):
            yield Member(name, "", said)
        elif inspect.isfunction(value) or isinstance(value, classmethod | staticmethod):
            yield Member(name, _signature(getattr(found, name)), said)


def _signature(found: object) -> str:
    """As it is called, without types, which the docstring names: ``(points, arithmetic='exact', *, text=False)``."""
    if not callable(found):
        return ""
    try:
        signature = inspect.signature(found)
    except ValueError:  # a class made in C has none
        return ""
    plain = [
        one.replace(annotation=inspect.Parameter.empty, default=_Shown.of(one.default))
        for name, one in signature.parameters.items()
        if name != "self"
    ]
    return str(signature.replace(parameters=plain, return_annotation=inspect.Signature.empty))


@dataclass(frozen=True, slots=True, repr=False)
class _Shown:
    """A default as a reader is shown it: a function or class by its name, what is long as dots."""

    text: str

    def __repr__(self) -> str:
        return self.text

    @classmethod
    def of(cls, value: object) -> object:
        if value is inspect.Parameter.empty:
            return value
        text = getattr(value, "__name__", repr(value))
        return cls(text if len(text) < 40 and "<" not in text else "...")


def as_markdown(found: Iterable[Name]) -> str:
    """Functions, classes, exceptions; a heading a name."""
    found = tuple(found)
    parts = []
    for kind in KINDS:
        parts.append(f"## {_HEADS[kind]}")
        parts += [_section(name) for name in found if name.kind == kind]
    return "\n\n".join(parts)


def _section(name: Name) -> str:
    head = [f"### {name.name}"]
    if name.signature:
        head.append(f"```text\n{_wrapped(name.name, name.signature)}\n```")
    taken = re.findall(r"[(,] ?\**(\w+)", name.signature)
    says = "\n\n".join(_itemised(part, taken) for part in _prose(name.says).split("\n\n"))
    rows = [f"| `{one.name}{one.signature}` | {_cell(one.says)} |" for one in name.members]
    table = ["\n".join(["| member | what it is |", "|---|---|", *rows])] if rows else []
    return "\n\n".join([*head, says, *table])


def _wrapped(name: str, signature: str) -> str:
    """A signature on lines of 80 columns."""
    indent = " " * (len(name) + 1)
    return textwrap.fill(f"{name}{signature}", 80, subsequent_indent=indent, break_on_hyphens=False)


def _itemised(paragraph: str, taken: Sequence[str]) -> str:
    """A paragraph that says ``this: ...  that: ...`` of what is taken, as a list; what is raised after it."""
    if not taken or paragraph.startswith("```"):
        return paragraph
    head, *parts = re.split(rf"(?:^|(?<=[.;)])\s+)({'|'.join(taken)}):\s", paragraph)
    if not parts:
        return paragraph
    last, *raised = re.split(r"\s(?=Raises )", parts[-1], maxsplit=1)
    said = zip(parts[::2], [*parts[1:-1:2], last], strict=True)
    items = "\n".join(f"- `{one}`: {' '.join(words.split())}" for one, words in said)
    return "\n\n".join(part for part in (head.strip(), items, *raised) if part)


def _prose(docstring: str) -> str:
    """A docstring as Markdown: single quotes for names, its examples as text."""
    text = re.sub(r"``([^`]+)``", r"`\1`", re.sub(r":\w+:`([^`]+)`", r"`\1`", docstring))
    return re.sub(
        r"::\n\n((?: {4}.*\n?|\n)+)", lambda block: f":\n\n```text\n{inspect.cleandoc(block[1])}\n```\n\n", text
    )


def _cell(docstring: str) -> str:
    return _prose(" ".join(docstring.split())).replace("|", "\\|")
