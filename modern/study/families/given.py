"""Families of point sets that are not random: the sets that the thesis prints, and the points of a user's file."""

from collections.abc import Sequence
from functools import cache

from emulator.errors import quoted
from modern.edition import chapter6
from modern.edition.chapter4 import load_theorems
from modern.formats.points import parse_input, read_input
from modern.geometry.numbers import finite_decimal
from modern.study.families.draws import MOST, Count, Draw, Drawn, FamilyError, Point


@cache
def published_sets() -> dict[str, tuple[Point, ...]]:
    """Return the sets of chapter 6 and of the theorems of chapter 4, by name (thesis p. 37-57, 103-115)."""
    sets = {}
    for number in chapter6.EXAMPLES:
        sets[f"example {number}"] = tuple(parse_input(chapter6.input_deck(number).text(), f"example {number}").points)
    for theorem in load_theorems():
        # Points whose coordinates have no finite decimal expansion cannot be punched, so their theorem is left out.
        texts = (map(finite_decimal, point.at) for point in theorem.points)
        points = tuple((x, y, z) for x, y, z in texts if x and y and z)
        if len(points) == len(theorem.points):
            sets[f"theorem {theorem.id}"] = points
    return sets


def published(draw: Draw, sets: Sequence[str] = (), shuffle: bool = False) -> Drawn:
    """The point sets printed in the thesis: sample k is the k-th of ``sets`` (default: all), repeated cyclically.

    ``shuffle`` changes the order of the points at random.
    """
    known = published_sets()
    names = list(sets) or list(known)
    name = names[draw.index % len(names)]
    if name not in known:
        raise FamilyError(f"no published set is called {quoted(name)}; expected one of {', '.join(known)}")
    return _order(draw, known[name], shuffle, name)


def points(draw: Draw, points: Sequence[Sequence[str]], n: Count = 0, shuffle: bool = False, name: str = "") -> Drawn:
    """The points listed in a plan, or ``n`` of them drawn at random.  If ``shuffle`` is true, their order is random."""
    in_plan = [(str(x), str(y), str(z)) for x, y, z in points]
    if n:
        count = draw.count(n)
        if count > len(in_plan):
            raise FamilyError(f"n is {count}, but there are only {len(in_plan)} points")
        drawn_indices = draw.random.sample(range(len(in_plan)), count)
        in_plan = [in_plan[i] for i in (drawn_indices if shuffle else sorted(drawn_indices))]
    elif len(in_plan) > MOST:
        raise FamilyError(
            f"{len(in_plan)} points, but the programs accept at most {MOST}; set the parameter n to draw fewer points"
        )
    return _order(draw, in_plan, shuffle and not n, name)


def file_family(draw: Draw, path: str, n: Count = 0, shuffle: bool = False, name: str = "") -> Drawn:
    """The points of a file in the folder of the plan, with the parameters of the family ``points``."""
    return points(draw, file_points(path), n, shuffle, name)


def file_points(path: str) -> list[list[str]]:
    """Return the points of a file for the parameter ``points``. Raise EmulatorError if the file cannot be read."""
    return [list(point) for point in read_input(path).points]


def _order(draw: Draw, points: Sequence[Point], shuffle: bool, name: str) -> Drawn:
    order = list(points)
    if shuffle:
        draw.random.shuffle(order)
    return Drawn(tuple(order), {"kind": name} if name else {})
