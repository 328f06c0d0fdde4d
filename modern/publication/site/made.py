"""What a page of data is made of, and the makers by name."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from importlib import import_module
from pkgutil import iter_modules
from typing import Protocol

from modern.publication.site import pages


@dataclass(frozen=True, slots=True)
class Target:
    """An address within a page that others may point at.

    ``id`` is the element's; ``label`` names it in the whole site, in small letters (``program3 147+2``); ``title`` is
    what a reference to it says; ``index`` how the general index calls it, nothing where it does not.
    """

    id: str
    label: str
    title: str
    index: str = ""


@dataclass(frozen=True, slots=True)
class Part:
    """A heading with what stands below it, HTML or MyST; without a heading it belongs to what goes before.

    ``level`` is 1 for a section of the page, 2 for one within it; ``id`` the heading's.  In HTML an address of the site
    is written as :func:`modern.publication.site.markup.address` gives it.
    """

    heading: str = ""
    id: str = ""
    level: int = 1
    html: str = ""
    text: str = ""


@dataclass(frozen=True, slots=True)
class Made:
    """What a maker returns: the parts in order, and the addresses in them."""

    parts: tuple[Part, ...]
    targets: tuple[Target, ...] = ()


class Maker(Protocol):
    """What a module of :mod:`modern.publication.site.pages` has: ``make``, which raises ValueError for its argument."""

    def make(self, argument: str) -> Made: ...


def names() -> tuple[str, ...]:
    """The names of all makers."""
    return tuple(sorted(module.name.replace("_", "-") for module in iter_modules(pages.__path__)))


def make(name: str, argument: str) -> Made:
    """What the maker of that name makes of an argument.  Raises ValueError for another name or argument."""
    if name not in names():
        raise ValueError(f"nothing is made by the name of {name!r}; there are {', '.join(names())}")
    maker: Maker = import_module(f"{pages.__name__}.{name.replace('-', '_')}")
    return maker.make(argument)


def one_of(argument: str, known: Iterable[str]) -> str:
    """An argument that is one of several words.  Raises ValueError, naming them."""
    words = tuple(known)
    if argument not in words:
        raise ValueError(f"{argument!r} is not one of {', '.join(words)}")
    return argument
