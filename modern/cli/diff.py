"""``hull1620 diff``: compare the hulls of the 1963 programs and of the port with the exact hull."""

import argparse
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from pathlib import PurePath

from emulator.language.cards import Deck
from emulator.machine.result import Options
from modern.cli.shared.console import DIFFERS, OK, print_notes, print_report, write_json
from modern.cli.shared.inputs import points_of, punch_epsilon
from modern.cli.shared.programs import layers_of
from modern.cli.shared.refusals import Request, refusal_lines
from modern.comparison.difference import Disagreement, disagreement
from modern.comparison.outcome import Outcome, Vector, from_cards, from_hull, from_judge
from modern.edition import programs
from modern.exact_hull import exact_hull
from modern.formats.columns import aligned
from modern.formats.deck import MAX_POINTS, UnfitPoint, data_deck
from modern.formats.points import Input
from modern.port import convex_hull
from modern.thesis.job import run_hull
from modern.thesis.refusals import Cause, explain_run

_LIMIT = 1_000_000
_NOT_RUN = "not run"
_HEAD = ("route", "status", "vertices", "misfiled", "planes", "coefficient error", "point outside")


@dataclass(frozen=True, slots=True)
class Route:
    """The outcome of the programs or of the port, and its difference from the exact hull.

    obstacle: the reason why the programs could not be run, or empty.  cause: the reason why the run gave no hull, or
    None.  layers: the layers that were applied to the programs.
    """

    outcome: Outcome
    difference: Disagreement | None = None
    obstacle: str = ""
    cause: Cause | None = None
    layers: tuple[str, ...] = ()

    @property
    def status(self) -> str:
        return f"not run: {self.obstacle}" if self.obstacle else self.outcome.status

    @property
    def agrees(self) -> bool:
        """Return True if the route agrees with the exact hull or could not be run."""
        return bool(self.obstacle) or (self.difference is not None and self.difference.agrees)


def main(args: argparse.Namespace) -> int:
    source = points_of(args.points)
    points: list[Vector] = [tuple(Fraction(x) for x in point) for point in source.points]
    exact = from_judge(exact_hull(source.points), points)
    routes = [
        replace(route, difference=disagreement(route.outcome, exact, points)) if route.outcome.determined else route
        for route in _routes(args, source, points)
    ]
    print_report(args, _table(routes, exact, source))
    print_notes(source.notes)
    explained_kinds = set()
    for route in routes:
        if route.cause is not None and route.cause.kind not in explained_kinds:
            explained_kinds.add(route.cause.kind)
            print_notes([f"{route.outcome.name}: {route.outcome.status}"])
            print_notes(refusal_lines(route.cause, _request(args, source, route.layers)))
    write_json(args, _document(routes, exact, source))
    return OK if all(route.agrees for route in routes) else DIFFERS


def _request(args: argparse.Namespace, source: Input, layers: tuple[str, ...]) -> Request:
    is_deck = source.kind == "deck"
    deck = args.points if is_deck else PurePath(args.points).with_suffix(".deck").name
    epsilon = (args.epsilon or "") if "epsilon" in layers else ""
    return Request(deck, "" if is_deck else args.points, layers, epsilon=epsilon, explain=args.explain)


def _routes(args: argparse.Namespace, source: Input, points: list[Vector]) -> Iterator[Route]:
    layers = layers_of(args) or (("epsilon", "corrected") if args.epsilon else ("corrected",))
    deck = _deck(source)
    for name, applied in (("listing", ()), ("listing + " + " + ".join(layers), layers)):
        if isinstance(deck, str):
            yield Route(Outcome(name, _NOT_RUN, -1), obstacle=deck)
            continue
        if "epsilon" in applied and (args.epsilon or "").startswith("rel:"):
            yield Route(Outcome(name, _NOT_RUN, -1), obstacle="a card cannot hold a scaled tolerance, rel:E")
            continue
        data = punch_epsilon(deck, args.epsilon or "0") if "epsilon" in applied else deck
        options = Options(limit=_LIMIT, core=60000 if applied else 40000)
        run, cause = explain_run(partial(run_hull, data, programs.loader(applied), options))
        yield Route(from_cards(name, run, points), cause=cause, layers=applied)
    for arithmetic in ("float64", "exact"):
        hull = convex_hull(source.points, arithmetic, epsilon=args.epsilon, on_refusal="return")
        yield Route(from_hull(f"port {arithmetic}", hull))


def _deck(source: Input) -> Deck | str:
    """Return the points as a data deck, or a message if a deck cannot hold them."""
    if len(source.points) > MAX_POINTS:
        return f"{len(source.points)} points; the programs accept at most {MAX_POINTS}"
    try:
        return data_deck(source.points, source.source)
    except UnfitPoint as error:
        remedy = "; to truncate them, make a deck with hull1620 cards --truncate and compare it" if error.digits else ""
        return f"{source.places[error.point - 1]}: {error.why}{remedy}"


def _table(routes: list[Route], exact: Outcome, source: Input) -> Iterator[str]:
    kinds = ("point", "segment", "polygon", "polyhedron")
    faces = {2: "lines", 3: "planes"}.get(exact.dimension, "equations")
    yield f"{source.source}: {len(source.points)} points"
    yield (
        f"the exact hull: a {kinds[exact.dimension]} of {len(exact.vertices)} vertices, "
        f"{len(exact.equations)} {faces}, "
        f"{len(exact.boundary)} boundary and {len(exact.inside)} inside points"
    )
    yield from aligned([_HEAD, *map(_cells, routes)])
    for route in routes:
        for note in _notes(route.outcome):
            yield f"{route.outcome.name}: {note}"
        difference = route.difference
        if difference is not None and difference.points:
            yield f"{route.outcome.name}:"
            for index in difference.points:
                coordinates = ", ".join(source.points[index])
                yield f"  {source.places[index]} ({coordinates}): {_fault(difference, index)}"
    wrong = [route.outcome.name for route in routes if not route.agrees]
    yield f"differs from the exact hull: {', '.join(wrong)}" if wrong else "all agree with the exact hull"


def _notes(outcome: Outcome) -> list[str]:
    notes = [] if outcome.ending is None else [outcome.ending.message]
    if outcome.faulty:
        numbers = ", ".join(map(str, outcome.faulty))
        notes.append(f"equations of program 1 that are not 0 at the points that they should contain: {numbers}")
    return notes


def _cells(route: Route) -> tuple[str, ...]:
    difference = route.difference
    if difference is None:
        return route.outcome.name, route.status, "", "", "", "", ""
    vertices = _counted((len(difference.missed), "missed"), (len(difference.added), "added"))
    planes = _counted(
        (difference.planes_missing, "missing"),
        (difference.planes_extra, "extra"),
        (difference.planes_doubled, "doubled"),
    )
    return (
        route.outcome.name,
        route.status,
        vertices,
        str(len(difference.misfiled)) if difference.misfiled else "-",
        planes,
        _short(difference.error),
        _short(difference.excluded),
    )


def _counted(*counts: tuple[int, str]) -> str:
    return ", ".join(f"{count} {noun}" for count, noun in counts if count) or "-"


def _short(value: Fraction) -> str:
    return f"{float(value):.2e}" if value else "-"


def _fault(difference: Disagreement, index: int) -> str:
    faults = []
    if index in difference.missed:
        faults.append("a missed vertex")
    if index in difference.added:
        faults.append("not a vertex")
    if index in difference.misfiled:
        faults.append("misfiled")
    if index == difference.excluded_point:
        faults.append(f"outside by {_short(difference.excluded)}")
    return ", ".join(faults)


def _document(routes: list[Route], exact: Outcome, source: Input) -> dict[str, object]:
    return {
        "source": source.source,
        "points": [
            {"place": place, "at": list(point)} for place, point in zip(source.places, source.points, strict=True)
        ],
        "judge": {
            "dimension": exact.dimension,
            "vertices": sorted(exact.vertices),
            "boundary": sorted(exact.boundary),
            "inside": sorted(exact.inside),
            "equations": [[str(c) for c in equation] for equation in exact.equations],
        },
        "routes": [
            {
                "route": route.outcome.name,
                "status": route.status,
                "agrees": route.agrees,
                "notes": _notes(route.outcome),
                **({} if route.difference is None else _counts(route.difference)),
            }
            for route in routes
        ],
    }


def _counts(difference: Disagreement) -> dict[str, object]:
    return {
        "vertices_missed": sorted(difference.missed),
        "vertices_added": sorted(difference.added),
        "misfiled": sorted(difference.misfiled),
        "planes_missing": difference.planes_missing,
        "planes_extra": difference.planes_extra,
        "planes_doubled": difference.planes_doubled,
        "largest_relative_error": str(difference.error),
        "farthest_excluded": {"distance": str(difference.excluded), "point": difference.excluded_point},
    }
