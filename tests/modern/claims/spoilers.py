"""Alterations of what a check relies on: the results of functions that it calls, and the constants that it reads."""

import inspect
from collections.abc import Callable, Iterator, Mapping, Set
from contextlib import ExitStack, contextmanager
from dataclasses import fields, is_dataclass, replace
from functools import wraps
from importlib import import_module
from itertools import islice
from numbers import Number
from types import CodeType, ModuleType
from typing import Any

import numpy as np
import pytest

from modern.claims import evidence
from modern.claims.evidence import Check, Decision
from tests.support.caches import cleared

# Alterations of one attribute that are tried, and calls beyond those of the unaltered check, which end endless loops.
_MOST_ALTERATIONS, _MORE_CALLS = 150, 500


class Endless(Exception):
    """An altered function was called far more often than the original one."""


def verdict(check: Check) -> tuple[bool, bool, bool]:
    """Return whether a check holds, whether it needs a condition, and whether it is a slip."""
    return check.holds, bool(check.evidence.violation), bool(check.evidence.correction)


def alterations(value: Any, depth: int = 4) -> Iterator[object]:
    """Yield altered values of the same type; fields, first and last elements are altered up to the given depth."""
    if isinstance(value, bool | np.bool_):
        yield not value
    elif isinstance(value, Number):
        yield from (value + 1, -value)
    elif isinstance(value, np.ndarray):
        yield from (value[:-1], ~value if value.dtype == np.bool_ else -value)
    elif is_dataclass(value) and not isinstance(value, type):
        names = [field.name for field in fields(value) if field.init] if depth else []
        yield from (replace(value, **{n: a}) for n in names for a in alterations(getattr(value, n), depth - 1))
    elif isinstance(value, Mapping):
        yield dict([*value.items()][:-1])
        first = next(iter(value), None) if depth else None
        yield from ({**value, first: altered} for altered in alterations(value.get(first), depth - 1))
    elif isinstance(value, Set):
        yield from (type(value)([*value][:-1]), type(value)())
    elif isinstance(value, str):
        yield f"{value}?"
    elif isinstance(value, tuple | list):
        yield from (value[:-1], value[::-1])
        if value and depth:
            yield from (type(value)((first, *value[1:])) for first in alterations(value[0], depth - 1))
            yield from (type(value)((*value[:-1], last)) for last in alterations(value[-1], depth - 1))


def _names(function: Callable[..., object], module: ModuleType, names: list[str]) -> list[str]:
    """Append the names of the module's attributes that a function uses, directly or by functions of the module."""
    codes = [inspect.unwrap(function).__code__]
    while codes:
        code = codes.pop()
        codes += [constant for constant in code.co_consts if isinstance(constant, CodeType)]
        for name in code.co_names:
            attribute = vars(module).get(name)
            owner = getattr(attribute, "__module__", "")
            if name in names or name not in vars(module) or isinstance(attribute, type | ModuleType):
                continue
            is_foreign = callable(attribute) and not str(owner).startswith(("emulator", "modern"))
            if is_foreign or owner == evidence.__name__:
                continue
            names.append(name)
            if inspect.isfunction(inspect.unwrap(attribute)) and owner == module.__name__:
                _names(attribute, module, names)
    return names


@contextmanager
def altered(module: ModuleType, name: str, number: int, limit: int) -> Iterator[list[int]]:
    """Alter an attribute of a module in the way with this number; yield the numbers of calls and of altered values."""
    original, counts = getattr(module, name), [0, 0]

    def changed(value: Any) -> object:
        value = [*value] if isinstance(value, Iterator) else value
        for alteration in islice(alterations(value), number, number + 1):
            counts[1] += 1
            return alteration
        return value

    @wraps(original)
    def spoiled(*arguments: Any, **named: Any) -> object:
        counts[0] += 1
        if counts[0] > limit:
            raise Endless
        value = original(*arguments, **named)
        return value if number < 0 else changed(value)

    with cleared(module), pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, name, spoiled if callable(original) else changed(original) if number >= 0 else original)
        yield counts


def is_noticed(decision: Decision) -> bool:
    """Return True if some alteration of what a check relies on changes its verdict."""
    module = import_module(decision.function.__module__)

    def run() -> tuple[bool, bool, bool]:
        return verdict(decision.function(**dict(decision.subject)))

    # One run of the unaltered check counts the calls of all attributes.
    with ExitStack() as stack:
        names = _names(decision.function, module, [])
        counts_of = {name: stack.enter_context(altered(module, name, -1, 10**9)) for name in names}
        expected = run()
    limits = {name: 2 * counts[0] + _MORE_CALLS for name, counts in counts_of.items()}
    # The first alterations of all attributes are tried before the further ones of each.
    for number in range(_MOST_ALTERATIONS):
        for name, limit in [*limits.items()]:
            with altered(module, name, number, limit) as counts:
                # An exception is noticed too, but it is no verdict.
                try:
                    if run() != expected:
                        return True
                except Exception:
                    pass
            if not counts[1]:
                del limits[name]
    return False
