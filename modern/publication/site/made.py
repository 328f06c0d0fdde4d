"""The class of the parts from which generated pages are made, and the function that calls a generator by its name."""

from collections.abc import Collection
from dataclasses import dataclass
from importlib import import_module
from pkgutil import iter_modules

from modern.publication.site import pages


@dataclass(frozen=True, slots=True)
class Part:
    """A section of a page: a heading with content in HTML or MyST.

    A part without a heading continues the section before it.  ``id`` is the id of the heading.  ``level`` is 1 for a
    section of the page and 2 for a subsection.  ``text`` is MyST and comes before ``html``.  The function
    :func:`modern.publication.site.markup.address` writes the addresses in ``html``.
    """

    heading: str = ""
    id: str = ""
    level: int = 1
    html: str = ""
    text: str = ""


def slug(prefix: str, title: str) -> str:
    """Return the id of a heading: the prefix and the title, in which hyphens replace all but letters and digits."""
    return f"{prefix}-" + "".join(c if c.isalnum() else "-" for c in title.lower())


def names() -> tuple[str, ...]:
    """Return the names that the directive ``made`` accepts."""
    return tuple(sorted(module.name.replace("_", "-") for module in iter_modules(pages.__path__)))


def make(name: str, argument: str) -> list[Part]:
    """Return the parts that a module of ``pages`` makes. Raise ValueError for an unknown name or argument."""
    if name not in names():
        raise ValueError(f"unknown page {name!r}; expected one of {', '.join(names())}")
    content: list[Part] = import_module(f"{pages.__name__}.{name.replace('-', '_')}").make(argument)
    return content


def one_of(argument: str, choices: Collection[str]) -> str:
    """Return the argument if it is one of the choices.  Raise ValueError otherwise."""
    if argument not in choices:
        raise ValueError(f"{argument!r} is not one of {', '.join(choices)}")
    return argument
