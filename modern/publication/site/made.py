"""The content of a page that is generated from data, and the functions that generate it, by name."""

from collections.abc import Collection
from dataclasses import dataclass
from importlib import import_module
from pkgutil import iter_modules
from typing import Protocol

from modern.publication.site import pages


@dataclass(frozen=True, slots=True)
class Target:
    """An address within a page.

    ``id`` is the id of the HTML element.  ``label`` names it in the whole site, in lower case (``program3 147+2``).
    ``title`` is the text of a reference to it.
    """

    id: str
    label: str
    title: str


@dataclass(frozen=True, slots=True)
class Part:
    """A section: a heading with content in HTML or MyST.  Without a heading, the content continues the section before.

    ``level`` is 1 for a section of the page and 2 for a subsection; ``id`` is the id of the heading.  Addresses of the
    site in HTML are those of :func:`modern.publication.site.markup.address`.
    """

    heading: str = ""
    id: str = ""
    level: int = 1
    html: str = ""
    text: str = ""


@dataclass(frozen=True, slots=True)
class Made:
    """The generated content of a page: its sections in order, and the addresses in them."""

    parts: tuple[Part, ...]
    targets: tuple[Target, ...] = ()


class Maker(Protocol):
    """A module of :mod:`modern.publication.site.pages`; its ``make`` raises ValueError for an unknown argument."""

    def make(self, argument: str) -> Made: ...


def slug(prefix: str, title: str) -> str:
    """Return the id of a heading: the prefix, and the title with a hyphen for everything but letters and digits."""
    return f"{prefix}-" + "".join(c if c.isalnum() else "-" for c in title.lower())


def names() -> tuple[str, ...]:
    """Return the names that the directive ``made`` accepts."""
    return tuple(sorted(module.name.replace("_", "-") for module in iter_modules(pages.__path__)))


def make(name: str, argument: str) -> Made:
    """Generate the content named ``name`` for an argument. Raise ValueError if either is unknown."""
    if name not in names():
        raise ValueError(f"unknown page {name!r}; expected one of {', '.join(names())}")
    maker: Maker = import_module(f"{pages.__name__}.{name.replace('-', '_')}")
    return maker.make(argument)


def one_of(argument: str, choices: Collection[str]) -> str:
    """Return the argument if it is one of the choices.  Raise ValueError otherwise."""
    if argument not in choices:
        raise ValueError(f"{argument!r} is not one of {', '.join(choices)}")
    return argument
