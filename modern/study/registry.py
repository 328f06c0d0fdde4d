"""Studies by name: those built in, or a user's plan file."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from importlib import import_module
from pkgutil import iter_modules
from typing import Protocol

from modern.study import builtin
from modern.study.plan import SEED, Plan
from modern.study.report import Report
from modern.study.store import Store


class Study(Protocol):
    """What a module of :mod:`modern.study.builtin` has.

    TITLE: one line for ``--list``.  SAMPLES: the default of ``--samples``.  plan: the plan with so many samples, of
    which the module says what they count.  report: the report from the finished rows.
    """

    TITLE: str
    SAMPLES: int

    def plan(self, samples: int, seed: int) -> Plan: ...

    def report(self, plan: Plan, store: Store) -> Report: ...


@dataclass(frozen=True, slots=True)
class Entry:
    """A built-in study as a list shows it: its default of ``--samples``, and how many sets and cells that makes."""

    name: str
    title: str
    samples: int
    sets: int
    cells: int


def names() -> tuple[str, ...]:
    """The names of the studies built in."""
    return tuple(sorted(module.name.replace("_", "-") for module in iter_modules(builtin.__path__)))


def study(name: str) -> Study:
    """The study built in of that name.  Raises KeyError."""
    if name not in names():
        raise KeyError(name)
    module: Study = import_module(f"{builtin.__name__}.{name.replace('-', '_')}")
    return module


def entries() -> Iterator[Entry]:
    """All studies built in."""
    for name in names():
        found = study(name)
        plan = found.plan(found.SAMPLES, SEED)
        yield Entry(name, found.TITLE, found.SAMPLES, plan.samples, len(plan.cells))
