"""Read the input of a command: a file, standard input, or an example by name.

``example1`` to ``example6`` are the data decks of chapter 6.  ``appel-will/fig18`` is the object of a figure in Appel
and Will's paper.  ``seventy/17`` is sample 17, counted from 0, of the study ``seventy``.  ``digits/2/17`` is sample 17
of cell 2 of the study ``digits``.  ``mine.toml/17`` is sample 17 of the study that the plan file ``mine.toml`` defines.
An existing file of the same name takes precedence.
"""

from __future__ import annotations

import os
import re
from typing import TYPE_CHECKING

from emulator.files import POINTS_LIMIT, read_bytes, source_name
from emulator.language.cards import Deck, deck_from_bytes
from modern.cli.shared.console import UsageError
from modern.formats import POINTS
from modern.formats.deck import data_deck, with_epsilon
from modern.formats.points import Input, deck_or_points, parse_bytes

if TYPE_CHECKING:
    from modern.geometry.hull import Hull

_EXAMPLE = re.compile(r"example([1-6])")
_FIGURE = re.compile(r"appel-will/(fig[0-9]{1,2})")
_SAMPLE = re.compile(r"([a-z]+(?:-[a-z]+)*|.+\.toml)(?:/([0-9]{1,6}))?/([0-9]{1,9})")


def read_input(name: str) -> bytes:
    """Return the bytes of a file (``-``: standard input) or an example.  Raise EmulatorError if it is unreadable."""
    text = None if name == "-" or os.path.exists(name) else _example(name)
    return read_bytes(name, limit=POINTS_LIMIT) if text is None else text.encode("ascii")


def points_of(name: str) -> Input:
    """Return the points of a file in any format, or of an example.  Raise EmulatorError if that fails."""
    return parse_bytes(read_input(name), source_name(name))


def deck_of(name: str, points: bool = False) -> Deck:
    """Return the deck of a file or of an example.  Raise EmulatorError if that fails.

    points: True if the deck must hold points.  If the file has points in another format, the error message names the
    command that makes a deck of it.
    """
    data, source = read_input(name), source_name(name)
    is_figure = _FIGURE.fullmatch(name) is not None
    kind = deck_or_points(data, source) if points or is_figure else "deck"
    if kind == "deck":
        return deck_from_bytes(source, data)
    if is_figure and not os.path.exists(name):
        return data_deck(parse_bytes(data, source).points, name)
    command = f"hull1620 cards {name} -o points.deck makes a deck of it"
    raise UsageError(f"{source}: expected a data deck, found {POINTS[kind]}; {command}")


def punch_epsilon(deck: Deck, epsilon: str) -> Deck:
    """Return a deck with the tolerance of ``--epsilon`` punched on its first card.

    Raise UsageError if the card has no room for the number.
    """
    try:
        return with_epsilon(deck, epsilon)
    except ValueError as error:
        raise UsageError(f"--{error}") from None


def deck_for(program: str, name: str) -> Deck:
    """Return a deck for a program. Raise EmulatorError if it is invalid or, for program 1, does not hold points."""
    return deck_of(name, points=program in ("program1", "program1_examples"))


def _example(name: str) -> str | None:
    if match := _EXAMPLE.fullmatch(name):
        from modern.edition.chapter6 import input_deck  # only examples need these imports, so files are read faster

        return input_deck(int(match[1])).text()
    if match := _FIGURE.fullmatch(name):
        return _figure(match[1])
    if match := _SAMPLE.fullmatch(name):
        return _sample(match[1], int(match[2] or 0), int(match[3]))
    return None


def _figure(name: str) -> str | None:
    from modern.formats.off import write
    from modern.geometry.mesh import Mesh
    from modern.papers.appel_will.results import found_solid

    try:
        solid = found_solid(name)
    except KeyError:
        return None
    points = tuple((str(x), str(y), str(z)) for x, y, z in solid.points)
    return write(Mesh(3, points, solid.surfaces))


def _sample(study_name: str, cell: int, index: int) -> str | None:
    from modern.study import builtin
    from modern.study.families import draw_sample
    from modern.study.plan import SEED

    if study_name.endswith(".toml"):
        from modern.study.tomlplan import read_plan  # imported here because few samples are those of a plan file

        plan = read_plan(study_name)
    elif study_name in builtin.names():
        study = builtin.study(study_name)
        plan = study.plan(study.SAMPLES, SEED)
    else:
        return None
    if cell >= len(plan.cells) or index >= plan.cells[cell].samples:
        choices = f"cells 0 to {len(plan.cells) - 1}"
        choices += f", samples 0 to {plan.cells[cell].samples - 1}" if cell < len(plan.cells) else ""
        raise UsageError(f"{study_name}/{cell}/{index}: study {study_name} has {choices}")
    return data_deck(draw_sample(plan.cells[cell], plan.seed, index).points, study_name).text()


def exact_hull_of(
    path: str, *, procedure: bool, history: bool = False, within: str | None = None
) -> tuple[Hull, list[str]]:
    """Return the hull of a file's points in exact arithmetic, and notes for the user.

    procedure: True to use Butler's procedure, which also gives the equations in her order, the inside point C and, with
    ``history``, the stages of the construction.  False to use a method that is much faster for many points.
    within: merge faces whose vertices lie within this distance of one plane.
    """
    from modern.geometry.coplanar import FLAT, CoplanarError, coplanar, join_summary, parse_distance

    limit = None if within is None else parse_distance(within)
    points = points_of(path)
    # These imports take time, and an unreadable file must be reported at once.
    if procedure:
        from modern.port import convex_hull

        hull = convex_hull(points.points, "exact", history=history, on_refusal="return")
    else:
        from modern.comparison.outcome import as_hull
        from modern.exact_hull import exact_hull

        hull = as_hull(exact_hull(points.points))
    notes = [*points.notes]
    for point, first in hull.duplicates:
        notes.append(f"{points.source}: {points.places[point]} repeats the point of {points.places[first]}")
    if limit is not None and hull.determined:
        try:
            hull, joined = coplanar(hull, limit)
        except CoplanarError as error:
            raise CoplanarError(f"{points.source}: --coplanar-within: {error}") from None
        notes.append(f"{points.source}: {join_summary(joined) if joined else FLAT}")
    return hull, notes
