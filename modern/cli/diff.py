"""``hull1620 diff``: one point set by the 1963 programs, by the port and by the exact judge."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from pathlib import PurePath

from emulator.files import write_text
from emulator.language.cards import Deck
from emulator.machine.result import Options
from modern.cli.shared import refusals
from modern.cli.shared.console import DIFFERS, OK, UsageError, say
from modern.cli.shared.inputs import points_of
from modern.cli.shared.machine import layers_of
from modern.comparison.difference import Disagreement, disagreement
from modern.comparison.outcome import Outcome, Vector, from_cards, from_hull, from_judge
from modern.edition import programs
from modern.exact_hull import exact_hull
from modern.formats.columns import aligned
from modern.formats.deck import MAX_POINTS, UnfitPoint, data_deck, with_epsilon
from modern.formats.points import Input
from modern.port import convex_hull
from modern.thesis.job import run_hull
from modern.thesis.refusals import Cause, explain_run

_LIMIT = 1_000_000
_NOT_RUN = "not run"
_HEAD = ("route", "status", "vertices", "misfiled", "planes", "error", "excluded")


@dataclass(frozen=True, slots=True)
class Route:
    """A route's outcome and how it differs from the judge's; ``obstacle`` is why it could not be run."""

    outcome: Outcome
    found: Disagreement | None = None
    obstacle: str = ""
    cause: Cause | None = None
    layers: tuple[str, ...] = ()

    @property
    def status(self) -> str:
        return f"not run: {self.obstacle}" if self.obstacle else self.outcome.status

    @property
    def fine(self) -> bool:
        """Whether the route agrees; one that could not be run says nothing against the others."""
        return bool(self.obstacle) or (self.found is not None and self.found.agrees)


def main(args: argparse.Namespace) -> int:
    """Run every route, print the table, say which points are concerned."""
    found = points_of(args.points)
    points: list[Vector] = [tuple(Fraction(x) for x in point) for point in found.points]
    judge = from_judge(exact_hull(found.points), points)
    routes = [
        replace(route, found=disagreement(route.outcome, judge, points)) if route.outcome.determined else route
        for route in _routes(args, found, points)
    ]
    for line in _table(routes, judge, found):
        print(line)
    say(found.notes)
    told = set()
    for route in routes:
        if route.cause is not None and route.cause.kind not in told:
            told.add(route.cause.kind)
            say([f"{route.outcome.name}: {route.outcome.status}"])
            say(refusals.lines(route.cause, _asked(args, found, route.layers)))
    if args.json:
        write_text(args.json, json.dumps(_document(routes, judge, found), indent=1) + "\n")
    return OK if all(route.fine for route in routes) else DIFFERS


def _asked(args: argparse.Namespace, found: Input, layers: tuple[str, ...]) -> refusals.Asked:
    is_deck = found.kind == "deck"
    deck = args.points if is_deck else PurePath(args.points).with_suffix(".deck").name
    epsilon = (args.epsilon or "") if "epsilon" in layers else ""
    return refusals.Asked(deck, "" if is_deck else args.points, layers, epsilon=epsilon, explain=args.explain)


def _routes(args: argparse.Namespace, found: Input, points: list[Vector]) -> Iterator[Route]:
    layers = layers_of(args) or (("epsilon", "corrected") if args.epsilon else ("corrected",))
    deck = _deck(found)
    for name, chosen in (("listing", ()), ("listing + " + " + ".join(layers), layers)):
        if isinstance(deck, str):
            yield Route(Outcome(name, _NOT_RUN, -1), obstacle=deck)
            continue
        if "epsilon" in chosen and (args.epsilon or "").startswith("rel:"):
            yield Route(Outcome(name, _NOT_RUN, -1), obstacle="the cards take an absolute e")
            continue
        try:
            data = with_epsilon(deck, args.epsilon or "0") if "epsilon" in chosen else deck
        except ValueError as error:
            raise UsageError(f"--{error}") from None
        options = Options(limit=_LIMIT, core=60000 if chosen else 40000)
        run, cause = explain_run(partial(run_hull, data, programs.loader(chosen), options))
        yield Route(from_cards(name, run, points), cause=cause, layers=chosen)
    for arithmetic in ("float64", "exact"):
        hull = convex_hull(found.points, arithmetic, epsilon=args.epsilon, on_refusal="return")
        yield Route(from_hull(f"port {arithmetic}", hull))


def _deck(found: Input) -> Deck | str:
    """The points as a data deck, or why they are none."""
    if len(found.points) > MAX_POINTS:
        return f"{len(found.points)} points; the programs take {MAX_POINTS}"
    try:
        return data_deck(found.points, found.source)
    except UnfitPoint as error:
        cut = "; diff the deck that hull1620 cards --truncate makes" if error.digits else ""
        return f"{found.places[error.point - 1]}: {error.why}{cut}"


def _table(routes: list[Route], judge: Outcome, found: Input) -> Iterator[str]:
    kinds = ("point", "segment", "polygon", "polyhedron")
    faces = {2: "lines", 3: "planes"}.get(judge.dimension, "equations")
    yield f"{found.source}: {len(found.points)} points"
    yield (
        f"the judge: a {kinds[judge.dimension]} of {len(judge.vertices)} vertices, {len(judge.equations)} {faces}, "
        f"{len(judge.boundary)} boundary and {len(judge.inside)} inside points"
    )
    yield from aligned([_HEAD, *map(_cells, routes)])
    for route in routes:
        for note in _notes(route.outcome):
            yield f"{route.outcome.name}: {note}"
        row = route.found
        if row is not None and row.points:
            yield f"{route.outcome.name}:"
            for index in row.points:
                yield f"  {found.places[index]} ({', '.join(found.points[index])}): {_fault(row, index)}"
    wrong = [route.outcome.name for route in routes if not route.fine]
    yield f"differs from the judge: {', '.join(wrong)}" if wrong else "all agree with the judge"


def _notes(outcome: Outcome) -> list[str]:
    """What there is to say of an outcome beside the table."""
    notes = [] if outcome.ending is None else [outcome.ending.message]
    if outcome.faulty:
        notes.append(f"equations {', '.join(map(str, outcome.faulty))} do not hold at their points")
    return notes


def _cells(route: Route) -> tuple[str, ...]:
    row = route.found
    if row is None:
        return route.outcome.name, route.status, "", "", "", "", ""
    vertices = _counted((len(row.missed), "missed"), (len(row.added), "added"))
    planes = _counted((row.planes_missing, "missing"), (row.planes_extra, "extra"), (row.planes_doubled, "doubled"))
    return (
        route.outcome.name,
        route.status,
        vertices,
        str(len(row.misfiled)) if row.misfiled else "-",
        planes,
        _short(row.error),
        _short(row.excluded),
    )


def _counted(*counts: tuple[int, str]) -> str:
    return ", ".join(f"{n} {what}" for n, what in counts if n) or "-"


def _short(value: Fraction) -> str:
    return f"{float(value):.2e}" if value else "-"


def _fault(row: Disagreement, index: int) -> str:
    faults = []
    if index in row.missed:
        faults.append("a vertex missed")
    if index in row.added:
        faults.append("no vertex")
    if index in row.misfiled:
        faults.append("misfiled")
    if index == row.excluded_point:
        faults.append(f"outside by {_short(row.excluded)}")
    return ", ".join(faults)


def _document(routes: list[Route], judge: Outcome, found: Input) -> dict[str, object]:
    return {
        "source": found.source,
        "points": [
            {"place": place, "at": list(point)} for place, point in zip(found.places, found.points, strict=True)
        ],
        "judge": {
            "dimension": judge.dimension,
            "vertices": sorted(judge.vertices),
            "boundary": sorted(judge.boundary),
            "inside": sorted(judge.inside),
            "equations": [[str(c) for c in equation] for equation in judge.equations],
        },
        "routes": [
            {
                "route": route.outcome.name,
                "status": route.status,
                "agrees": route.fine,
                "notes": _notes(route.outcome),
                **({} if route.found is None else _details(route.found)),
            }
            for route in routes
        ],
    }


def _details(row: Disagreement) -> dict[str, object]:
    return {
        "vertices_missed": sorted(row.missed),
        "vertices_added": sorted(row.added),
        "misfiled": sorted(row.misfiled),
        "planes_missing": row.planes_missing,
        "planes_extra": row.planes_extra,
        "planes_doubled": row.planes_doubled,
        "largest_relative_error": str(row.error),
        "farthest_excluded": {"distance": str(row.excluded), "point": row.excluded_point},
    }
