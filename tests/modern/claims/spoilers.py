"""Changes that break what a claim relies on, and the check that its verdict then changes.

A spoiler is a function that receives the original attribute of a module and returns its replacement.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from importlib import import_module
from typing import Any

import pytest

from modern.claims.evidence import Check, exhibited
from tests.support.caches import cleared

Original = Any
Spoiler = Callable[[Original], object]


def assert_verdict_changes(claim: str, attribute: str, spoiler: Spoiler) -> None:
    """Assert that a claim that holds fails with the spoiled attribute, and the other way round."""
    module = import_module("modern.claims." + claim.split()[0].rpartition(".")[0])
    expected = run_claim(claim).holds
    with cleared(module), pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, attribute, spoiler(getattr(module, attribute)))
        spoiled = run_claim(claim).holds
    assert spoiled != expected


def run_claim(claim: str) -> Check:
    """Run a check, named by module and function below modern.claims, with the given positional arguments."""
    name, *arguments = claim.split()
    module, _, function_name = name.rpartition(".")
    function = getattr(import_module(f"modern.claims.{module}"), function_name)
    check: Check = function(*arguments)
    return check


def always(value: object) -> Spoiler:
    return lambda _: lambda *arguments, **named: value


check_holds = always(exhibited(True, ""))
check_fails = always(exhibited(False, ""))


def identity(_: Original) -> object:
    return lambda argument: argument


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


def without_first_result(original: Original) -> object:
    return lambda *arguments: original(*arguments)[1:]


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
