"""Study the translation of the origin to the inside point C (chapter 7): the time it saves, and its cost in digits.

The thesis (p. 118-119) leaves open whether the translation is worthwhile.  With the origin at C, the sign of an
equation's constant term shows which side of the plane is the inside, and C need not be substituted.  But all points
must be moved, and later moved back.  Time is measured on runs of the programs without rounding, in which no set is
rejected.  Digits are varied in the port.  ``samples`` is the number of timed sets of each kind and N.  Each kind whose
digits are varied has 4 x ``samples`` sets.
"""

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from math import inf

from emulator.machine.timing import CONVERSION_MODEL, MODEL
from modern.study.outcomes import DETERMINED_SQL
from modern.study.plan import Cell, Plan, Port, Programs, Route
from modern.study.report import Lines, Mark, Report, Series, Table, listed, row, with_interval
from modern.study.statistics import Interval, exact, mean
from modern.study.store import Store
from modern.study.summary import Summary, cells, summary

TITLE = "the effect of moving the origin to C on operations, time and digits"
SAMPLES = 50
PLAIN, MOVED = "origin kept", "origin moved to C"
POINTS = 10
PLANES = "planes like example 4"
WORKING = tuple(range(4, 17))
EIGHT = 8
_SECONDS = ("seconds_processor", "seconds_reader", "seconds_punch", "seconds_typewriter")
PARTS = ("additions", "products", "quotients", _SECONDS[0])
# The limits of the classes into which sets are divided by their planes per point.
RATIOS = (0.0, 0.5, 1.0, 1.5, inf)
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
    "The numbers in parentheses are 95 % intervals: Student's for the time saved, truncated at 100 %, and exact "
    "ones (Clopper and Pearson) for sets. In a flat set, the planes are the lines of its boundary."
)
_LAYERS: Mapping[str, tuple[str, ...]] = {PLAIN: ("corrected",), MOVED: ("corrected", "translation")}


def working(name: str, digits: int) -> str:
    """Return the name of the route through the port with this number of digits."""
    return f"{name}, P={digits}"


def plan(samples: int = SAMPLES, seed: int = 1963) -> Plan:
    timed = {
        arithmetic: tuple(
            Programs(
                name,
                layers=layers,
                arithmetic=arithmetic,
                core=60_000,
                limit=3_000_000,
                measures=("operations", "machine_time"),
            )
            for name, layers in _LAYERS.items()
        )
        for arithmetic in ("exact", "truncating:16")
    }
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
        "Chapter 7 proposes to move the origin to C, so that the sign of the constant term orients an equation, and "
        "leaves open whether this reduces the time to find the hull. Does it, and how many digits does it cost?",
        (
            *(
                Cell(
                    {"asked": "time", "sets": name, "n": n},
                    family,
                    {**parameters, "n": n},
                    timed["exact" if name == PLANES else "truncating:16"],
                    samples,
                    chunk=5,
                )
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
            "The thesis expects the answer to depend on the number of equations to be normalized in relation to the "
            "number of points to be moved. So the kinds differ in their numbers of planes: whole numbers to 2 have few "
            "planes for many points, and a sphere has the most, 2N - 4. N = 50 on a sphere is omitted, because the "
            "plane table has 98 entries.",
            "Time is measured without rounding, so that no set is rejected and both versions finish: with sixteen "
            "digits, which hold all numbers of these sets, and for planes, in which C has thirds, in exact arithmetic. "
            "Each operation counts with its time on the 1620 with eight digits.",
            "C is the mean of four vertices, or of three in a plane. So moved coordinates contain quarters, with two "
            "more digits, or thirds, which have no finite decimal expansion. A translation should help most for sets "
            "around a centre far from the origin. A power of ten changes nothing in decimal arithmetic, so integers "
            "represent decimals too.",
        ),
    )


@dataclass(frozen=True, slots=True)
class _Pair:
    """A set whose hull is found with and without moving the origin, and the figures of both runs.

    ratio: the number of planes of the hull per point.
    """

    cell: int
    ratio: float
    plain: Mapping[str, float]
    moved: Mapping[str, float]

    def saved(self, part: str) -> float:
        """Return the share of the figure ``part`` that moving the origin saves.  A negative share is a loss."""
        return (self.plain[part] - self.moved[part]) / self.plain[part] if self.plain[part] else 0.0

    @property
    def saved_in_all(self) -> float:
        """Return the share of the total time that the translation saves, including reader, punch and typewriter."""
        plain, moved = (sum(figures[name] for name in _SECONDS) for figures in (self.plain, self.moved))
        return (plain - moved) / plain

    @property
    def bounds(self) -> tuple[float, float]:
        """Return the bounds of the processor seconds without translation, which follow from the time model's error."""
        devices = sum(self.plain[name] for name in _SECONDS[1:])
        return self.plain["model_low"] - devices, self.plain["model_high"] - devices


def report(plan: Plan, store: Store) -> Report:
    pairs, counts = _pairs(store), summary(store)
    return Report(
        (_main(plan, pairs), _by_ratio(pairs), _digits(plan, counts)),
        (_time_chart(plan, pairs), _digit_chart(plan, counts)),
        (_time_conclusion(pairs), _digit_conclusion(plan, counts)),
    )


def _pairs(store: Store) -> list[_Pair]:
    selected = store.query(
        "SELECT a.cell, CAST(s.planes AS REAL) / s.n, a.figures, b.figures FROM runs a "
        "JOIN runs b ON a.cell = b.cell AND a.place = b.place "
        "JOIN samples s ON a.cell = s.cell AND a.place = s.place "
        f"WHERE a.route = ? AND b.route = ? AND a.outcome IN {DETERMINED_SQL} AND b.outcome IN {DETERMINED_SQL} "
        "AND json_extract(a.figures, '$.seconds_processor') IS NOT NULL ORDER BY a.cell, a.place",
        (PLAIN, MOVED),
    )
    return [_Pair(cell, ratio, _numbers(first), _numbers(second)) for cell, ratio, first, second in selected]


def _numbers(figures: str) -> dict[str, float]:
    used = {*PARTS, *_SECONDS, "model_low", "model_high"}
    return {name: float(value) for name, value in json.loads(figures).items() if name in used}


def _share(estimate: Interval) -> str:
    """Format a saved share in percent, with its interval unless it is the share of a single set."""
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
        seconds = with_interval(mean((pair.plain["seconds_processor"] for pair in here), least=0.0), 0)
        low, high = (sum(pair.bounds[end] for pair in here) / len(here) for end in (0, 1))
        planes = sum(pair.ratio for pair in here) / len(here) * int(cell.key["n"])
        operations = _share(_saved(here, "additions")), _share(_saved(here, "products"))
        time = (
            seconds,
            f"{low:.0f} to {high:.0f}",
            _share(_saved(here)),
            _share(mean((pair.saved_in_all for pair in here), most=1.0)),
        )
        quicker = sum(pair.saved("seconds_processor") > 0 for pair in here)
        rows.append(row(cell.key["sets"], cell.key["n"], len(here), f"{planes:.1f}", *operations, *time, quicker))
    times = ("seconds", "by the model", "of them saved", "of all time saved", "sets quicker")
    head = ("sets", "N", "timed", "planes", "additions saved", "products saved", *times)
    notes = (
        "The numbers in parentheses are Student's 95 % intervals of the mean over sets, truncated at 100 %. A "
        "negative share is a loss. The seconds are processor time with the origin kept. The column *of all "
        "time saved* includes the time of reader, punch and typewriter.",
        "*By the model* means the lower and upper bound of the mean seconds, if the processor's true time is "
        f"{MODEL[0]} to {MODEL[1]} times the computed one, and the true time of input and output "
        f"{CONVERSION_MODEL[0]} to {CONVERSION_MODEL[1]} times. Runs of IBM's library of 1962 gave both ranges. Shares "
        "are ratios, in which most of the systematic error cancels.",
    )
    return Table("table", "What moving the origin to C saves", head, tuple(rows), notes)


def _classes(pairs: list[_Pair]) -> list[tuple[str, list[_Pair]]]:
    classes = []
    for low, high in pairwise(RATIOS):
        here = [pair for pair in pairs if low <= pair.ratio < high]
        name = f"{low:g} and more" if high == inf else f"less than {high:g}" if low == 0 else f"{low:g} to {high:g}"
        if here:
            classes.append((name, here))
    return classes


def _by_ratio(pairs: list[_Pair]) -> Table:
    rows = []
    for name, here in _classes(pairs):
        quicker = sum(pair.saved("seconds_processor") > 0 for pair in here)
        rows.append(row(name, len(here), _share(_saved(here)), exact(quicker, len(here))))
    head = ("planes a point", "timed", "processor time saved", "sets quicker")
    return Table(
        "ratio", "What moving the origin to C saves, by planes of the hull per point", head, tuple(rows), (_BY_RATIO,)
    )


def _least(counts: Summary, cell: int, name: str) -> int | None:
    return counts.sound_from(cell, lambda p: working(name, p), WORKING)


def _digits(plan: Plan, counts: Summary) -> Table:
    rows = []
    for number, cell in cells(plan, asked="digits"):
        least = [_least(counts, number, name) for name in (PLAIN, MOVED)]
        eight = [counts.share(number, name) for name in (PLAIN, MOVED)]
        rows.append(row(cell.key["sets"], cell.samples, *least, *eight))
    head = ("sets", "of each", *(f"{what}, {name}" for what in ("least P", "eight digits") for name in (PLAIN, MOVED)))
    notes = (
        "The numbers in parentheses are exact 95 % intervals (Clopper and Pearson). The least P is the number "
        "of working digits from which on no set failed. The columns for eight digits give the share of sets "
        "whose hull the programs find.",
    )
    return Table("digits", "What moving the origin to C costs in digits", head, tuple(rows), notes)


def _time_chart(plan: Plan, pairs: list[_Pair]) -> Lines:
    series = []
    for name in _TIMED:
        points = []
        for number, cell in cells(plan, asked="time", sets=name):
            here = [pair for pair in pairs if pair.cell == number]
            if len(here) > 1:
                points.append((float(cell.key["n"]), _saved(here)))
        if points:
            series.append(Series(name, tuple(points)))
    return Lines(
        "time",
        "Processor time saved by moving the origin to C",
        "points N",
        "share of the processor time saved",
        tuple(series),
        percent=True,
        marks=(Mark(0, "nothing saved"),),
        note=f"{cells(plan, asked='time')[0][1].samples} sets of each kind and N; bars: 95 % intervals of the mean "
        "(Student's)",
    )


def _digit_chart(plan: Plan, counts: Summary) -> Lines:
    shown = tuple(
        Series(
            f"{cell.key['sets']}, {name}", tuple((float(p), counts.share(number, working(name, p))) for p in WORKING)
        )
        for number, cell in cells(plan, asked="digits")
        if cell.key["sets"] in _CHARTED
        for name in (PLAIN, MOVED)
    )
    return Lines(
        "digits",
        "Sets whose hull is found with P truncated digits, with and without moving the origin",
        "working digits P",
        "share of sets whose hull is found",
        shown,
        percent=True,
        marks=(Mark(EIGHT, "eight digits of the 1620", upright=True),),
        note=f"{cells(plan, asked='digits')[0][1].samples} sets of {POINTS} points with integer coordinates; bars: "
        "exact 95 % intervals",
    )


def _time_conclusion(pairs: list[_Pair]) -> str:
    if not pairs:
        return "No set gave a hull both ways, so no times can be compared."
    savings = [pair.saved("seconds_processor") for pair in pairs]
    whole = mean((pair.saved_in_all for pair in pairs), most=1.0)
    return (
        f"Moving the origin to C, a point inside the hull, saved {_share(whole)} of the total time on average, "
        "including the time of the card machines and the typewriter. For the "
        f"{len(pairs)} sets timed with and without the move, it saved {100 * min(savings):.1f} % to "
        f"{100 * max(savings):.1f} % of the processor time. By the number of planes of the hull per point, the move "
        "has these effects: "
        f"{listed(f'{_verdict(_saved(here))} ({name})' for name, here in _classes(pairs))}."
    )


def _verdict(saved: Interval) -> str:
    return "saves time" if saved.low > 0 else "costs time" if saved.high < 0 else "makes no significant difference"


def _digit_conclusion(plan: Plan, counts: Summary) -> str:
    never: list[str] = []
    verdicts: dict[str, list[str]] = {"loses": [], "gains": [], "same": []}
    for number, cell in cells(plan, asked="digits"):
        name = str(cell.key["sets"])
        if _least(counts, number, PLAIN) is not None and _least(counts, number, MOVED) is None:
            never.append(name)
        plain, moved = counts.share(number, PLAIN), counts.share(number, MOVED)
        verdicts["loses" if plain.low > moved.high else "gains" if moved.low > plain.high else "same"].append(name)
    return (
        f"For these kinds, some sets fail even with {WORKING[-1]} digits if the origin is moved, although none fails "
        f"with {WORKING[-1]} digits if the origin is kept: {listed(never)}. With the origin moved, the programs with "
        f"eight digits find fewer hulls for these kinds: {listed(verdicts['loses'])}. They find more hulls for these "
        f"kinds: {listed(verdicts['gains'])}. The difference is not significant for these kinds: "
        f"{listed(verdicts['same'])}."
    )
