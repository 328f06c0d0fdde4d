"""Sets that are given and not drawn: those the thesis prints, and a user's own."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

from modern.edition import chapter6
from modern.edition.chapter4 import load_theorems
from modern.formats.points import parse_input, read_input
from modern.geometry.numbers import finite_decimal
from modern.study.families.draws import MOST, Count, Draw, Drawn, FamilyError, Point


@cache
def published_sets() -> dict[str, tuple[Point, ...]]:
    """The sets of chapter 6 and of chapter 4's theorems, by name (thesis p. 37-57, 103-115)."""
    found = {}
    for number in chapter6.EXAMPLES:
        found[f"example {number}"] = parse_input(chapter6.input_deck(number).text(), f"example {number}").points
    for theorem in load_theorems():
        texts = [
            (finite_decimal(x), finite_decimal(y), finite_decimal(z)) for x, y, z in (p.at for p in theorem.points)
        ]
        found[f"theorem {theorem.id}"] = tuple((x, y, z) for x, y, z in texts if x and y and z)
        if len(found[f"theorem {theorem.id}"]) < len(texts):
            del found[f"theorem {theorem.id}"]
    return found


def published(draw: Draw, sets: Sequence[str] = (), shuffle: bool = False) -> Drawn:
    """Sample k is the k-th of the sets named, or of all, beginning again after the last; in shuffled order if asked."""
    known = published_sets()
    names = list(sets) or list(known)
    name = names[draw.index % len(names)]
    if name not in known:
        raise FamilyError(f"no published set is called {name!r}; there are {', '.join(known)}")
    return _order(draw, known[name], shuffle, name)


def points(draw: Draw, points: Sequence[Sequence[str]], n: Count = 0, shuffle: bool = False, name: str = "") -> Drawn:
    """The points given, all of them or ``n`` drawn from them, in shuffled order if asked."""
    given = [(str(x), str(y), str(z)) for x, y, z in points]
    if n:
        count = draw.count(n)
        if count > len(given):
            raise FamilyError(f"n is {count}; there are {len(given)} points")
        chosen = draw.random.sample(range(len(given)), count)
        given = [given[i] for i in (chosen if shuffle else sorted(chosen))]
    elif len(given) > MOST:
        raise FamilyError(f"{len(given)} points; the programs take {MOST} (n draws fewer)")
    return _order(draw, given, shuffle and not n, name)


def file_family(draw: Draw, path: str, n: Count = 0, shuffle: bool = False, name: str = "") -> Drawn:
    """The points of a file beside the plan, as ``points`` takes them; the plan that is carried out holds the points."""
    return points(draw, file_points(path), n, shuffle, name)


def file_points(path: str) -> list[list[str]]:
    """The points of a file (deck, CSV or OFF) for the parameter ``points``: a plan holds them, not the file's name.

    Raises EmulatorError (one line).
    """
    return [list(point) for point in read_input(path).points]


def _order(draw: Draw, given: Sequence[Point], shuffle: bool, name: str) -> Drawn:
    order = list(given)
    if shuffle:
        draw.random.shuffle(order)
    return Drawn(tuple(order), {"kind": name} if name else {})
