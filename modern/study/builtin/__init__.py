"""Find the built-in studies by name.  Each module of this package defines one study, as :class:`Study` describes."""

from importlib import import_module
from pkgutil import iter_modules
from typing import Protocol

from modern.study.plan import Plan
from modern.study.report import Report
from modern.study.store import Store


class Study(Protocol):
    """The functions and constants that each module of :mod:`modern.study.builtin` defines.

    TITLE: one line for ``--list``.  SAMPLES: the default of ``--samples``.  The docstring of the module says what this
    number counts.  plan: makes the plan for a number of samples.  report: makes the report from the finished rows.
    """

    TITLE: str
    SAMPLES: int

    def plan(self, samples: int, seed: int) -> Plan: ...

    def report(self, plan: Plan, store: Store) -> Report: ...


def names() -> tuple[str, ...]:
    """Return the names of the built-in studies."""
    return tuple(sorted(module.name.replace("_", "-") for module in iter_modules(__path__)))


def study(name: str) -> Study:
    """Return the built-in study of that name.  Raise KeyError if it is unknown."""
    if name not in names():
        raise KeyError(name)
    module: Study = import_module(f"{__name__}.{name.replace('-', '_')}")
    return module
