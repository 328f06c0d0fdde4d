"""Small parts of the sentences reports are made of."""

from __future__ import annotations

from collections.abc import Iterable


def series(items: Iterable[object], none: str = "none") -> str:
    """``a``, ``a and b``, ``a, b and c``; for no items, ``none``."""
    words = [str(item) for item in items]
    if len(words) < 2:
        return words[0] if words else none
    return f"{', '.join(words[:-1])} and {words[-1]}"


def count(number: int, one: str) -> str:
    """A number with its noun: ``1 set``, ``1,200 sets``, ``no set``."""
    if not number:
        return f"no {one}"
    return f"{number:,} {one}{'' if number == 1 else 's'}"


def spans(numbers: Iterable[int], step: int = 1) -> tuple[tuple[int, int], ...]:
    """Whole numbers, rising, as runs from the first to the last of those ``step`` apart."""
    runs: list[tuple[int, int]] = []
    for number in numbers:
        if runs and runs[-1][1] + step == number:
            runs[-1] = runs[-1][0], number
        else:
            runs.append((number, number))
    return tuple(runs)


def powers(exponents: Iterable[int], none: str = "none") -> str:
    """Powers of ten by their exponents: ``10^-6 to 10^-3 and 10^1``."""
    return series((f"10^{a}" if a == b else f"10^{a} to 10^{b}" for a, b in spans(exponents)), none)
