"""Study the benefit of different roundings: truncation, IBM's rounded product, a guard digit, rounding, binary floats.

Two tests are compared.  The exact test of the thesis requires that the three points of a plane give zero in its
equation.  For this test, decimal arithmetics run in the programs with the layer ``corrected``, and binary arithmetics
in the port.  The other test is the interval of chapter 7 (thesis p. 117), scaled to the largest coefficient of each
equation.  For this test, all arithmetics run in the port.  ``samples`` is the number of point sets of a cell.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from modern.study.outcomes import DETERMINED, DETERMINED_SQL, WRONG
from modern.study.plan import Cell, Plan, Port, Programs, Route
from modern.study.report import INTERVALS, Bars, Lines, Report, Series, Table, listed, percent, powers, row
from modern.study.statistics import exact
from modern.study.store import Store
from modern.study.summary import Summary, cells, summary

TITLE = "the benefit of rounding: truncation, rounded products, a guard digit, floats"
SAMPLES = 300
POINTS = 10
TRUNCATING = "truncating"
DECIMAL: Mapping[str, str] = {
    TRUNCATING: "truncating",
    "rounded product": "ibm1962",
    "guard digit": "guarded:8",
    "rounding": "rounding:8",
}
BINARY = ("float32", "float64")
WAYS = (*DECIMAL, *BINARY)
SIZES = (9, 99, 150, 200, 250, 300, 350, 400, 500, 999, 9999)
# Exponents k: half the width of the interval is 10**k times the largest coefficient A, B or C of the equation.
WIDTHS = tuple(range(-6, 0))
BOXES = "whole numbers"
_WRONG_HULLS = "The last column counts the wrong hulls of each arithmetic, in the order of the columns before it."
TENTHS = "near a plane with a gap of .1"
_EXACT: Mapping[str, tuple[str, Mapping[str, int]]] = {
    "decimals of 3 digits": ("decimals", {"digits": 3}),
    "ball, 3 digits": ("ball", {"digits": 3}),
    "sphere, 3 digits": ("sphere", {"digits": 3}),
    TENTHS: ("near-coplanar", {"digits": 2, "gap": 1}),
    "near a plane with a gap of .001": ("near-coplanar", {"digits": 2, "gap": 3}),
}
_INTERVAL: Mapping[str, tuple[str, Mapping[str, int]]] = {
    "whole numbers of 4 digits": ("integers", {"digits": 4}),
    "decimals of 5 digits": ("decimals", {"digits": 5}),
    "sphere, 4 digits": ("sphere", {"digits": 4}),
    "near a plane with a gap of .001": ("near-coplanar", {"digits": 2, "gap": 3}),
}
_SHOWN = "whole numbers of 4 digits"


def within(way: str, power: int) -> str:
    """Return the name of the route through the port with an arithmetic and the interval for e = 10**power."""
    return f"{way}, e = 10^{power}"


def plan(samples: int = SAMPLES, seed: int = 1963) -> Plan:
    tested: tuple[Route, ...] = (
        *(Programs(way, layers=("corrected",), arithmetic=a, core=60_000, limit=200_000) for way, a in DECIMAL.items()),
        *(Port(way, way) for way in BINARY),
    )
    widened = tuple(Port(within(way, k), DECIMAL.get(way, way), epsilon=f"rel:1E{k}") for k in WIDTHS for way in WAYS)
    return Plan(
        "rounding",
        TITLE[0].upper() + TITLE[1:],
        "The machine of the thesis truncates. What difference would rounded products, a guard digit, rounding "
        "everywhere or the floats of a present computer have made, and how often is a hull silently wrong?",
        (
            *(
                Cell({"test": "exact", "sets": BOXES, "to": m}, "box", {"most": m, "n": POINTS}, tested, samples)
                for m in SIZES
            ),
            *(
                Cell({"test": "exact", "sets": name}, family, {**parameters, "n": POINTS}, tested, samples)
                for name, (family, parameters) in _EXACT.items()
            ),
            *(
                Cell({"test": "interval", "sets": name}, family, {**parameters, "n": POINTS}, widened, samples, chunk=5)
                for name, (family, parameters) in _INTERVAL.items()
            ),
        ),
        seed,
        (
            "Each of the products A x, B y, C z is at most four times the cube of the largest coordinate. Their sum "
            "has at most 8 digits for coordinates up to about 200, 24 bits up to about 110 and 53 bits up to about "
            "80,000. So most sizes of integers lie from 150 to 500, where eight digits begin to fail; 9, 99, 999 and "
            "9999 are the integers of 1 to 4 digits.",
            "The interval is scaled: a point within e (times at most the square root of 3) of a plane counts as on "
            "it. It is applied to kinds of sets that the exact test rejects.",
            f"All sets have {POINTS} points and go through every arithmetic, so arithmetics are compared set by set.",
        ),
    )


@dataclass(frozen=True, slots=True)
class _Pairs:
    """The numbers of sets for which an arithmetic does better than truncation, and worse than truncation."""

    better: int
    worse: int

    @property
    def verdict(self) -> str:
        """Return whether the arithmetic is better than truncation, worse, or not significantly different."""
        if self.better + self.worse == 0:
            return "no difference"
        share = exact(self.better, self.better + self.worse)
        return "better" if share.low > 0.5 else "worse" if share.high < 0.5 else "no significant difference"


def report(plan: Plan, store: Store) -> Report:
    counts = summary(store)
    tested = {way: _compared(plan, store, way, "exact") for way in WAYS[1:]}
    widened = {way: _compared(plan, store, way, "interval") for way in WAYS[1:]}
    return Report(
        (
            _main(plan, counts, tested, widened),
            _sizes(plan, counts),
            _widths(plan, counts),
            _verdicts(tested, widened),
            _sound_widths(plan, counts),
            _silent(plan, counts),
        ),
        (_size_chart(plan, counts), _width_chart(plan, counts), _wrong_chart(plan, counts)),
        _conclusions(plan, counts),
    )


def _compared(plan: Plan, store: Store, way: str, test: str) -> _Pairs:
    better = worse = 0
    names = {way: (way, *(within(way, k) for k in WIDTHS)) for way in (way, TRUNCATING)}
    way_of = {route: way for way, routes in names.items() for route in routes}
    for number, cell in cells(plan, test=test):
        hits: dict[str, list[int]] = {way: [0] * cell.samples, TRUNCATING: [0] * cell.samples}
        with_hull = store.query(
            f"SELECT route, place FROM runs WHERE cell = ? AND outcome IN {DETERMINED_SQL}", (number,)
        )
        for route, place in with_hull:
            if route in way_of:
                hits[way_of[route]][place] += 1
        pairs = list(zip(hits[way], hits[TRUNCATING], strict=True))
        better += sum(a > b for a, b in pairs)
        worse += sum(a < b for a, b in pairs)
    return _Pairs(better, worse)


def _pooled(plan: Plan, counts: Summary, test: str, route: str, outcomes: tuple[str, ...]) -> tuple[int, int]:
    numbers = [number for number, _ in cells(plan, test=test)]
    return sum(counts.hits(k, route, outcomes) for k in numbers), sum(counts.of(k, route) for k in numbers)


def _main(plan: Plan, counts: Summary, tested: Mapping[str, _Pairs], widened: Mapping[str, _Pairs]) -> Table:
    rows = []
    for way in WAYS:
        right, of = _pooled(plan, counts, "exact", way, DETERMINED)
        wrong, _ = _pooled(plan, counts, "exact", way, (WRONG,))
        pairs = [f"{one.better} / {one.worse}" if one else "-" for one in (tested.get(way), widened.get(way))]
        largest = str(_largest(plan, counts, way) or "-")
        share = percent(exact(wrong, of - right)) if right < of else "-"
        rows.append((way, largest, str(of), str(of - right), str(wrong), share, *pairs))
    exact_test = ("whole numbers up to", "sets", "failed", "wrong hulls", "of the failed")
    head = ("way", *exact_test, "against truncating", "with the interval")
    notes = (
        "The numbers in parentheses are exact 95 % intervals (Clopper and Pearson).",
        "The columns *sets*, *failed* and *wrong hulls* are those of the exact test. The second column has the "
        "largest size up to which no set failed. The column *against truncating* has two numbers: the sets whose "
        "hull only this arithmetic finds, and the sets whose hull only truncation finds. The last column has the sets "
        "whose hull this arithmetic finds at more widths of the interval than truncation, and at fewer widths.",
    )
    return Table("table", "Arithmetics compared, all sets", head, tuple(rows), notes)


def _sizes(plan: Plan, counts: Summary) -> Table:
    rows = []
    for number, cell in cells(plan, test="exact"):
        sets = " to ".join(str(value) for name, value in cell.key.items() if name != "test")
        wrong = [str(counts.hits(number, way, (WRONG,))) for way in WAYS]
        rows.append((sets, str(cell.samples), *(percent(counts.share(number, way)) for way in WAYS), " ".join(wrong)))
    head = ("sets", "of each", *WAYS, "wrong hulls")
    notes = (*INTERVALS, _WRONG_HULLS)
    return Table("exact", "Hull found with the exact test", head, tuple(rows), notes)


def _widths(plan: Plan, counts: Summary) -> Table:
    rows = []
    for number, cell in cells(plan, test="interval"):
        for k in WIDTHS:
            routes = [within(way, k) for way in WAYS]
            wrong = [str(counts.hits(number, route, (WRONG,))) for route in routes]
            shares = [percent(counts.share(number, route)) for route in routes]
            rows.append((str(cell.key["sets"]), f"10^{k}", str(cell.samples), *shares, " ".join(wrong)))
    head = ("sets", "e", "of each", *WAYS, "wrong hulls")
    notes = (*INTERVALS, _WRONG_HULLS)
    return Table("interval", "Hull found with the scaled interval", head, tuple(rows), notes)


def _size_chart(plan: Plan, counts: Summary) -> Lines:
    shown = [(k, c) for k, c in cells(plan, sets=BOXES) if 99 <= int(c.key["to"]) <= 999]
    return Lines(
        "sizes",
        "The exact test: sets whose hull is found",
        "largest coordinate (integers)",
        "share of sets whose hull is found",
        tuple(Series(way, tuple((float(c.key["to"]), counts.share(k, way)) for k, c in shown)) for way in WAYS),
        percent=True,
        log_x=True,
        note=f"{shown[0][1].samples} sets of {POINTS} points at each size, the same for all arithmetics; "
        "bars: exact 95 % intervals",
    )


def _width_chart(plan: Plan, counts: Summary) -> Lines:
    ((number, cell),) = cells(plan, test="interval", sets=_SHOWN)
    return Lines(
        "interval",
        f"Chapter 7's interval, scaled: {_SHOWN}",
        "e, the distance within which a point counts as on a plane",
        "share of sets whose hull is found",
        tuple(Series(way, tuple((float(k), counts.share(number, within(way, k))) for k in WIDTHS)) for way in WAYS),
        percent=True,
        powers=True,
        note=f"{cell.samples} sets of {POINTS} points; bars: exact 95 % intervals",
    )


def _wrong_chart(plan: Plan, counts: Summary) -> Bars:
    return Bars(
        "wrong",
        "Plausible but wrong hulls, with the scaled interval",
        "e",
        "share of sets with a wrong hull",
        tuple(
            Series(
                way,
                tuple((f"10^{k}", exact(*_pooled(plan, counts, "interval", within(way, k), (WRONG,)))) for k in WIDTHS),
            )
            for way in WAYS
        ),
        percent=True,
        note=f"{sum(cell.samples for _, cell in cells(plan, test='interval'))} sets of {len(_INTERVAL)} kinds; "
        "bars: exact 95 % intervals",
    )


def _largest(plan: Plan, counts: Summary, way: str) -> int | None:
    best = None
    for number, cell in cells(plan, sets=BOXES):
        if counts.failed(number, way):
            break
        best = int(cell.key["to"])
    return best


def _verdicts(tested: Mapping[str, _Pairs], widened: Mapping[str, _Pairs]) -> Table:
    rows = tuple(
        (way, test, str(compared.better), str(compared.worse), compared.verdict)
        for test, pairs in (("exact", tested), ("interval", widened))
        for way, compared in pairs.items()
    )
    notes = (
        "The column *better* counts the sets for which the arithmetic does better than truncation, and *worse* those "
        "for which truncation does better. With the exact test, one of the two does better if it alone finds the "
        "hull. With the interval, it does better if it finds the hull at more widths. Of the sets in both columns, "
        "the verdict is *better* if significantly more than half are better, and *worse* if significantly fewer are: "
        "the exact 95 % interval (Clopper and Pearson) of the share does not contain one half.",
    )
    return Table(
        "pairs", "Compared with truncation, set by set", ("way", "test", "better", "worse", "verdict"), rows, notes
    )


def _sound_widths(plan: Plan, counts: Summary) -> Table:
    rows = tuple(
        row(cell.key["sets"], *(powers(k for k in WIDTHS if not counts.failed(number, within(way, k))) for way in WAYS))
        for number, cell in cells(plan, test="interval")
    )
    return Table("widths", "Widths e of the interval at which no set failed", ("sets", *WAYS), rows)


def _silent(plan: Plan, counts: Summary) -> Table:
    rows = tuple(
        (f"10^{k}", *(percent(exact(*_pooled(plan, counts, "interval", within(way, k), (WRONG,)))) for way in WAYS))
        for k in WIDTHS
    )
    return Table("silent", "Plausible but wrong hulls, with the interval", ("e", *WAYS), rows, INTERVALS)


def _conclusions(plan: Plan, counts: Summary) -> tuple[str, ...]:
    right, wrong, of = 0, 0, 0
    failed = []
    for way in WAYS:
        hits, sets = _pooled(plan, counts, "exact", way, DETERMINED)
        failed.append(f"{way}, {sets - hits:,} of {sets:,}")
        right, of = right + hits, of + sets
        wrong += _pooled(plan, counts, "exact", way, (WRONG,))[0]
    ((number, cell),) = cells(plan, sets=TENTHS)
    eight, binary = counts.share(number, TRUNCATING), counts.share(number, "float64")
    return (
        f"With the exact test, these numbers of sets failed, by arithmetic: {listed(failed)}.",
        f"With the exact test, all arithmetics together failed {of - right:,} times. Of these failures, {wrong:,} are "
        f"plausible but wrong hulls, and {of - right - wrong:,} are rejected sets or runs that did not end.",
        f"For the sets {cell.key['sets']}, truncation to eight digits finds {percent(eight)} of the hulls, and "
        f"float64, which cannot represent a tenth, finds {percent(binary)}.",
    )
