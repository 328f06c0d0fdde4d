"""The origin moved to C, as chapter 7 proposes: what it saves in operations and time, and costs in digits.

The thesis (p. 118-119) leaves open whether the translation pays: it turns equations by their constant terms instead
of putting C into them, but moves the points there and back.  Time is measured on runs of the programs over exact
numbers, in which nothing is refused; digits are varied in the port.  ``samples`` counts the sets of a kind and an N
whose time is measured; each kind whose digits are varied has four times as many.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from math import inf

from modern.study.outcomes import DETERMINED
from modern.study.plan import Cell, Plan, Port, Programs, Route
from modern.study.report import Lines, Mark, Report, Series, Table, listed, percent
from modern.study.statistics import Interval, exact, mean
from modern.study.store import Store
from modern.study.summary import Summary, cells, summary

TITLE = "the origin moved to C: operations, time and digits with and without"
SAMPLES = 50
PLAIN, MOVED = "origin kept", "origin moved to C"
POINTS = 10
PLANES = "planes like example 4"
WORKING = tuple(range(4, 17))
EIGHT = 8
PARTS = ("additions", "products", "quotients", "seconds_processor")
RATIOS = (0.0, 0.5, 1.0, 1.5, inf)
"""Planes of the hull a point, in classes."""
_TIMED: Mapping[str, tuple[str, Mapping[str, object], tuple[int, ...]]] = {
    PLANES: ("thesis", {"kinds": {"plane": 1}}, (8, 16, 32)),
    "slabs like example 5": ("thesis", {"kinds": {"slab": 1}}, (15, 30)),
    "whole numbers to 2": ("box", {"most": 2}, (10, 20, 30, 40, 50)),
    "whole numbers to 99": ("box", {"most": 99}, (10, 20, 30, 40, 50)),
    "sphere of 2 digits": ("sphere", {"digits": 2}, (10, 20, 30, 40)),
}
_VARIED: Mapping[str, tuple[str, Mapping[str, object]]] = {
    "numbers to 9": ("box", {"most": 9}),
    "numbers to 9 about 100": ("box", {"most": 9, "centre": 100}),
    "numbers to 9 about 10000": ("box", {"most": 9, "centre": 10_000}),
    "numbers to 99": ("box", {"most": 99}),
    "numbers to 99 about 1000": ("box", {"most": 99, "centre": 1_000}),
    PLANES: ("thesis", {"kinds": {"plane": 1}}),
}
_CHARTED = ("numbers to 9", "numbers to 99")
_BY_RATIO = (
    "In brackets: 95 % intervals, of time saved by Student's t, cut at 100 %, of sets exact (Clopper and Pearson); "
    "planes of a flat set are the lines about it."
)
_LAYERS: Mapping[str, tuple[str, ...]] = {PLAIN: ("corrected",), MOVED: ("corrected", "translation")}


def working(name: str, digits: int) -> str:
    """The route of the port with so many digits."""
    return f"{name}, P={digits}"


def plan(samples: int = SAMPLES, seed: int = 1963) -> Plan:
    """The plan for ``samples`` timed sets of each kind and N."""
    timed = tuple(
        Programs(
            name,
            layers=layers,
            arithmetic="exact",
            core=60_000,
            limit=3_000_000,
            measures=("operations", "machine_time"),
        )
        for name, layers in _LAYERS.items()
    )
    varied: tuple[Route, ...] = (
        *(Programs(name, layers=layers, core=60_000, limit=200_000) for name, layers in _LAYERS.items()),
        *(
            Port(working(name, p), f"truncating:{p}", translate=name == MOVED)
            for p in WORKING
            for name in (PLAIN, MOVED)
        ),
    )
    return Plan(
        "translation",
        TITLE[0].upper() + TITLE[1:],
        "Chapter 7 would move the origin to C, so that an equation is turned by the sign of its constant term, and "
        "leaves open whether the time to find the hull is reduced. Is it, and what becomes of the digits?",
        (
            *(
                Cell({"asked": "time", "sets": name, "n": n}, family, {**parameters, "n": n}, timed, samples, chunk=5)
                for name, (family, parameters, counts) in _TIMED.items()
                for n in counts
            ),
            *(
                Cell(
                    {"asked": "digits", "sets": name},
                    family,
                    {**parameters, "n": POINTS},
                    varied,
                    4 * samples,
                    chunk=10,
                )
                for name, (family, parameters) in _VARIED.items()
            ),
        ),
        seed,
        (
            "The thesis expects the answer to depend on the equations to be normalized in relation to the points to be "
            "moved. So the kinds differ in planes: whole numbers to 2 have few for many points, a sphere has most, "
            "2N - 4. N = 50 on a sphere is left out: the table of planes holds 98.",
            "Time is measured over exact numbers, so that no set is refused and both ways run to the end; operations "
            "are then those of any arithmetic with digits enough, and each takes the time of the 1620's with eight.",
            "C is the mean of four vertices, in a plane of three: moved coordinates have quarters, with two digits "
            "more, or thirds, which have no end. Sets about a centre far from the origin are those a translation "
            "should help most. A power of ten changes nothing in decimal arithmetic, so whole numbers stand for "
            "decimals too.",
        ),
    )


@dataclass(frozen=True, slots=True)
class _Pair:
    """One set that both ways determine: cell, planes a point, and the figures without and with the translation."""

    cell: int
    ratio: float
    plain: Mapping[str, float]
    moved: Mapping[str, float]

    def saved(self, part: str) -> float:
        """The share of a figure that the translation saves; negative where it costs."""
        return (self.plain[part] - self.moved[part]) / self.plain[part] if self.plain[part] else 0.0

    @property
    def saved_in_all(self) -> float:
        """The same of the whole time, with reader, punch and typewriter."""
        whole, then = (sum(v for k, v in one.items() if k.startswith("seconds_")) for one in (self.plain, self.moved))
        return (whole - then) / whole


def report(plan: Plan, store: Store) -> Report:
    """Tables, charts and words."""
    pairs, found = _pairs(store), summary(store)
    return Report(
        (_main(plan, pairs), _by_ratio(pairs), _digits(plan, found)),
        (_time_chart(plan, pairs), _digit_chart(plan, found)),
        _words(plan, pairs, found),
    )


def _pairs(store: Store) -> list[_Pair]:
    marks = ", ".join("?" * len(DETERMINED))
    asked = store.query(
        "SELECT a.cell, CAST(s.planes AS REAL) / s.n, a.figures, b.figures FROM runs a "
        "JOIN runs b ON a.cell = b.cell AND a.place = b.place "
        "JOIN samples s ON a.cell = s.cell AND a.place = s.place "
        f"WHERE a.route = ? AND b.route = ? AND a.outcome IN ({marks}) AND b.outcome IN ({marks}) "
        "AND json_extract(a.figures, '$.seconds_processor') IS NOT NULL ORDER BY a.cell, a.place",
        (PLAIN, MOVED, *DETERMINED, *DETERMINED),
    )
    return [_Pair(cell, ratio, _numbers(first), _numbers(second)) for cell, ratio, first, second in asked]


def _numbers(figures: str) -> dict[str, float]:
    kept = (*PARTS, "seconds_reader", "seconds_punch", "seconds_typewriter")
    return {name: float(value) for name, value in json.loads(figures).items() if name in kept}


def _share(estimate: Interval) -> str:
    """A part saved, in percent with its interval; of one set alone there is none."""
    if estimate.high == inf:
        return f"{100 * estimate.value:.1f} %"
    return f"{100 * estimate.value:.1f} ({100 * estimate.low:.1f} to {100 * estimate.high:.1f}) %"


def _saved(pairs: Iterable[_Pair], part: str = "seconds_processor") -> Interval:
    return mean((pair.saved(part) for pair in pairs), most=1.0)


def _main(plan: Plan, pairs: list[_Pair]) -> Table:
    rows = []
    for number, cell in cells(plan, asked="time"):
        here = [pair for pair in pairs if pair.cell == number]
        if not here:
            continue
        seconds = mean(pair.plain["seconds_processor"] for pair in here).value
        rows.append(
            (
                str(cell.key["sets"]),
                str(cell.key["n"]),
                str(len(here)),
                f"{sum(pair.ratio for pair in here) / len(here) * int(cell.key['n']):.1f}",
                _share(_saved(here, "additions")),
                _share(_saved(here, "products")),
                f"{seconds:.0f}",
                _share(_saved(here)),
                _share(mean((pair.saved_in_all for pair in here), most=1.0)),
                str(sum(pair.saved("seconds_processor") > 0 for pair in here)),
            )
        )
    head = (
        "sets",
        "N",
        "timed",
        "planes",
        "additions saved",
        "products saved",
        "seconds",
        "of them saved",
        "of all time saved",
        "sets quicker",
    )
    notes = (
        "In brackets: 95 % intervals of the mean over sets, by Student's t, cut at 100 %; a negative part is lost. "
        "Seconds: of the processor, with the origin kept; all time: with reader, punch and typewriter.",
    )
    return Table("table", "What moving the origin to C saves", head, tuple(rows), notes)


def _classes(pairs: list[_Pair]) -> list[tuple[str, list[_Pair]]]:
    """The timed sets by planes a point, those classes that have any."""
    found = []
    for low, high in pairwise(RATIOS):
        here = [pair for pair in pairs if low <= pair.ratio < high]
        name = f"{low:g} and more" if high == inf else f"less than {high:g}" if low == 0 else f"{low:g} to {high:g}"
        if here:
            found.append((name, here))
    return found


def _by_ratio(pairs: list[_Pair]) -> Table:
    rows = []
    for name, here in _classes(pairs):
        quicker = sum(pair.saved("seconds_processor") > 0 for pair in here)
        rows.append((name, str(len(here)), _share(_saved(here)), percent(exact(quicker, len(here)))))
    head = ("planes a point", "timed", "processor time saved", "sets quicker")
    return Table("ratio", "What it saves, by planes of the hull a point", head, tuple(rows), (_BY_RATIO,))


def _least(found: Summary, cell: int, name: str) -> int | None:
    """The least P from which on no set failed; None where the greatest fails too."""
    return found.sound_from(cell, lambda p: working(name, p), WORKING)


def _digits(plan: Plan, found: Summary) -> Table:
    rows = []
    for number, cell in cells(plan, asked="digits"):
        least = [_least(found, number, name) for name in (PLAIN, MOVED)]
        eight = [percent(found.share(number, name)) for name in (PLAIN, MOVED)]
        rows.append((str(cell.key["sets"]), str(cell.samples), *("-" if p is None else str(p) for p in least), *eight))
    head = (
        "sets",
        "of each",
        f"least P, {PLAIN}",
        f"least P, {MOVED}",
        f"eight digits, {PLAIN}",
        f"eight digits, {MOVED}",
    )
    notes = (
        "In brackets: exact 95 % intervals (Clopper and Pearson). Least P: working digits from which on no set "
        "failed; eight digits: sets whose hull the programs find.",
    )
    return Table("digits", "What moving the origin to C costs in digits", head, tuple(rows), notes)


def _time_chart(plan: Plan, pairs: list[_Pair]) -> Lines:
    shown = []
    for name in _TIMED:
        points = []
        for number, cell in cells(plan, asked="time", sets=name):
            here = [pair for pair in pairs if pair.cell == number]
            if len(here) > 1:
                points.append((float(cell.key["n"]), _saved(here)))
        if points:
            shown.append(Series(name, tuple(points)))
    return Lines(
        "time",
        "The origin moved to C: processor time saved",
        "points N",
        "time saved, of the 1620's processor",
        tuple(shown),
        percent=True,
        marks=(Mark(0, "nothing saved"),),
        note=f"{cells(plan, asked='time')[0][1].samples} sets of each kind and N; bars: 95 % intervals of the mean "
        "(Student)",
    )


def _digit_chart(plan: Plan, found: Summary) -> Lines:
    shown = tuple(
        Series(
            f"{cell.key['sets']}, {name}",
            tuple((float(p), found.share(number, working(name, p))) for p in WORKING),
        )
        for number, cell in cells(plan, asked="digits")
        if cell.key["sets"] in _CHARTED
        for name in (PLAIN, MOVED)
    )
    return Lines(
        "digits",
        "The origin moved to C: sets whose hull is found with P truncated digits",
        "working digits P",
        "hull found, of all sets",
        shown,
        percent=True,
        marks=(Mark(EIGHT, "the 1620's eight", upright=True),),
        note=f"{cells(plan, asked='digits')[0][1].samples} sets of {POINTS} points with whole numbers; bars: "
        "exact 95 % intervals",
    )


def _words(plan: Plan, pairs: list[_Pair], found: Summary) -> tuple[str, ...]:
    return _time_words(pairs), _digit_words(plan, found)


def _time_words(pairs: list[_Pair]) -> str:
    if not pairs:
        return "No set was determined both ways, so no time can be compared."
    each = [pair.saved("seconds_processor") for pair in pairs]
    whole = mean((pair.saved_in_all for pair in pairs), most=1.0)
    return (
        f"Sets timed both ways: {len(pairs)}. Processor time saved: at most {100 * max(each):.1f} %, at least "
        f"{100 * min(each):.1f} %; of the whole time, cards and typing included, {_share(whole)} on the mean. "
        "Moving the origin, by planes of the hull a point: "
        f"{listed(f'{_verdict(_saved(here))} ({name})' for name, here in _classes(pairs))}."
    )


def _verdict(saved: Interval) -> str:
    """Whether time is saved, by the interval of the mean."""
    return "saves time" if saved.low > 0 else "costs time" if saved.high < 0 else "makes no difference that can be told"


def _digit_words(plan: Plan, found: Summary) -> str:
    never: list[str] = []
    verdicts: dict[str, list[str]] = {"loses": [], "gains": [], "same": []}
    for number, cell in cells(plan, asked="digits"):
        name = str(cell.key["sets"])
        if _least(found, number, PLAIN) is not None and _least(found, number, MOVED) is None:
            never.append(name)
        kept, moved = found.share(number, PLAIN), found.share(number, MOVED)
        verdicts["loses" if kept.low > moved.high else "gains" if moved.low > kept.high else "same"].append(name)
    return (
        "Kinds of which some set fails at every P tried with the origin moved, and none from some P on with it kept: "
        f"{listed(never)}. Through the programs with eight digits moving the origin loses hulls of: "
        f"{listed(verdicts['loses'])}; gains hulls of: {listed(verdicts['gains'])}; makes no difference that can be "
        f"told for: {listed(verdicts['same'])}."
    )
