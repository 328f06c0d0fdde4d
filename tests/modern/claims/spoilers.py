"""Changes that break what a check relies on, and the test that its verdict then changes.

A spoiler is a function that receives the original attribute of a module and returns its replacement. Each document has
a table of spoilers with one line for each check: the id of a statement that the check decides, the attribute of the
module of the check, and the spoiler.
"""

from collections.abc import Callable, Iterable
from dataclasses import replace
from importlib import import_module
from typing import Any

import pytest

from modern.claims.algebra import IMPOSSIBLE, Step
from modern.claims.evidence import Check, Decision, exhibited
from modern.claims.register import decisions
from tests.support.caches import cleared

Original = Any
Spoiler = Callable[[Original], object]
Table = list[tuple[str, str, Spoiler]]


def verdict(check: Check) -> tuple[bool, bool, bool]:
    """Return whether a check holds, whether it needs a condition, and whether it is a slip."""
    return check.holds, bool(check.evidence.violation), bool(check.evidence.correction)


def assert_verdict_changes(name: str, attribute: str, spoiler: Spoiler) -> None:
    """Assert that the verdict on a statement changes if an attribute of the module of a check of it is spoiled."""
    changed = False
    for decision in decisions()[name]:
        module = import_module(decision.function.__module__)
        if hasattr(module, attribute):
            expected = verdict(decision.function(**dict(decision.subject)))
            with cleared(module), pytest.MonkeyPatch.context() as patch:
                patch.setattr(module, attribute, spoiler(getattr(module, attribute)))
                changed |= verdict(decision.function(**dict(decision.subject))) != expected
    assert changed


def unspoiled(package: str, tables: Iterable[Table]) -> list[str]:
    """Return the names of the checks of a package that no line of the tables spoils."""
    spoiled = {decision.function for table in tables for name, *_ in table for decision in decisions()[name]}
    checks = [decision for of_statement in decisions().values() for decision in of_statement]
    return sorted({_name(check) for check in checks if check.function not in spoiled and package in _name(check)})


def _name(decision: Decision) -> str:
    return f"{decision.function.__module__}.{decision.function.__name__}"


def always(value: object) -> Spoiler:
    return lambda _: lambda *arguments, **named: value


check_holds = always(exhibited(True, ""))
check_fails = always(exhibited(False, ""))


def value(replacement: object) -> Spoiler:
    """Replace a constant."""
    return lambda _: replacement


def invalid_step(_: Original) -> Callable[[], Step]:
    return lambda: Step("", {}, IMPOSSIBLE)


def identity(_: Original) -> object:
    return lambda argument, *_: argument


def negated(original: Original) -> object:
    return lambda *arguments: -original(*arguments)


def absolute(original: Original) -> object:
    return lambda *arguments: abs(original(*arguments))


def sum_instead_of_product(_: Original) -> object:
    return lambda u, v: tuple(a + b for a, b in zip(u, v, strict=True))


def counterexample(*points: tuple[int, int, int]) -> Spoiler:
    """Replace a counterexample by points that are not one."""
    return always([*points])


def all_points_vertices(original: Original) -> object:
    """Return hulls on which every point is a vertex."""

    def spoiled(points: Original) -> object:
        everyone = tuple(range(len(points)))
        return replace(original(points), vertices=everyone, polygon=everyone, boundary=(), inside=())

    return spoiled


def three_vertices(original: Original) -> object:
    return lambda points: replace(original(points), vertices=(0, 1, 2))


def flattened(original: Original) -> object:
    """Return the hull of the points with z = 0."""
    return lambda points, *arguments, **named: original([(x, y, 0) for x, y, _ in points], *arguments, **named)


def without_last_point(original: Original) -> object:
    return lambda points, *arguments, **named: original(points[:-1], *arguments, **named)


def changed_result(change: Callable[[Original], Original]) -> Spoiler:
    """Apply a change to whatever the original function returns."""
    return lambda original: lambda *arguments, **named: change(original(*arguments, **named))


@changed_result
def plus_one(number: Original) -> object:
    return number + 1


@changed_result
def constant_plus_one(plane: Original) -> object:
    """Add 1 to the last coefficient of a line or plane."""
    return (*plane[:-1], plane[-1] + 1)


@changed_result
def constant_negated(plane: Original) -> object:
    return (*plane[:-1], -plane[-1])
