"""What each way of rounding buys: truncation, IBM's rounded product, a guard digit, rounding everywhere, floats.

Two tests are tried.  With the exact one, the thesis's, the three points of a plane must give zero in its equation;
decimal ways go through the programs with the layer ``corrected``, binary ones through the port.  With chapter 7's
interval (thesis p. 117), scaled to the equation, all go through the port.  ``samples`` counts the sets of a cell.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from modern.study.charts import Bars, Lines, Series
from modern.study.filing import DETERMINED, WRONG
from modern.study.plan import Cell, Plan, Port, Programs, Route
from modern.study.report import INTERVALS, Report
from modern.study.statistics import exact, wilson
from modern.study.store import Store
from modern.study.summary import Summary, cells, summary
from modern.study.tables import Table, percent
from modern.study.words import powers, series

TITLE = "what ways of rounding buy: truncation, rounded products, a guard digit, floats"
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
WIDTHS = tuple(range(-6, 0))
"""Half the width of the interval is 10 to these powers, times the equation's largest coefficient A, B or C."""
BOXES = "whole numbers"
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
    """The name of the route with the interval of that width."""
    return f"{way}, e = 10^{power}"


def plan(samples: int = SAMPLES, seed: int = 1963) -> Plan:
    """The plan for ``samples`` sets of each kind and size."""
    tested: tuple[Route, ...] = (
        *(Programs(way, layers=("corrected",), arithmetic=a, core=60_000, limit=200_000) for way, a in DECIMAL.items()),
        *(Port(way, way) for way in BINARY),
    )
    widened = tuple(Port(within(way, k), DECIMAL.get(way, way), epsilon=f"rel:1E{k}") for k in WIDTHS for way in WAYS)
    return Plan(
        "rounding",
        TITLE[0].upper() + TITLE[1:],
        "The thesis's machine truncates. What would rounded products, a guard digit, rounding everywhere, or a present "
        "computer's floats have bought, and how often is a hull silently wrong?",
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
            "The products A x, B y, C z are at most four times the cube of the largest coordinate each: their sum has "
            "8 digits at most up to coordinates of about 200, 24 bits up to about 110, 53 bits up to about 80,000. So "
            "most sizes of whole numbers lie from 150 to 500, where eight digits begin to fail; 9, 99, 999 and 9999 "
            "are the whole numbers of 1 to 4 digits.",
            "The interval is scaled: a point within e (times at most the square root of 3) of a plane counts as on "
            "it. The sets it is tried on are those the exact test refuses.",
            f"All sets have {POINTS} points and go through every way, so that ways are compared set by set.",
        ),
    )


@dataclass(frozen=True, slots=True)
class _Against:
    """A way against truncation on the same sets: where it does better, and where worse."""

    better: int
    worse: int

    @property
    def verdict(self) -> str:
        """What the sets tell, by the exact interval of the share that is better."""
        if self.better + self.worse == 0:
            return "no difference"
        share = exact(self.better, self.better + self.worse)
        return "better" if share.low > 0.5 else "worse" if share.high < 0.5 else "no difference that can be told"


def report(plan: Plan, store: Store) -> Report:
    """Tables, charts and words."""
    found = summary(store)
    tested = {way: _compared(plan, store, way, "exact") for way in WAYS[1:]}
    widened = {way: _compared(plan, store, way, "interval") for way in WAYS[1:]}
    return Report(
        (_main(plan, found, tested, widened), _sizes(plan, found), _widths(plan, found)),
        (_size_chart(plan, found), _width_chart(plan, found), _wrong_chart(plan, found)),
        tuple(_words(plan, found, tested, widened)),
    )


def _compared(plan: Plan, store: Store, way: str, test: str) -> _Against:
    """Set by set: whether the hull is found or, with the interval, at how many widths."""
    better = worse = 0
    for number, cell in cells(plan, test=test):
        hits: dict[str, list[int]] = {way: [0] * cell.samples, TRUNCATING: [0] * cell.samples}
        asked = store.query(
            f"SELECT route, place FROM runs WHERE cell = ? AND outcome IN ({', '.join('?' * len(DETERMINED))})",
            (number, *DETERMINED),
        )
        for route, place in asked:
            name = route.split(",")[0]
            if name in hits:
                hits[name][place] += 1
        pairs = list(zip(hits[way], hits[TRUNCATING], strict=True))
        better += sum(a > b for a, b in pairs)
        worse += sum(a < b for a, b in pairs)
    return _Against(better, worse)


def _pooled(plan: Plan, found: Summary, test: str, route: str, outcomes: tuple[str, ...]) -> tuple[int, int]:
    """How many sets of all kinds are filed so, and of how many."""
    numbers = [number for number, _ in cells(plan, test=test)]
    return sum(found.hits(k, route, outcomes) for k in numbers), sum(found.of(k, route) for k in numbers)


def _main(plan: Plan, found: Summary, tested: Mapping[str, _Against], widened: Mapping[str, _Against]) -> Table:
    rows = []
    for way in WAYS:
        right, of = _pooled(plan, found, "exact", way, DETERMINED)
        wrong, _ = _pooled(plan, found, "exact", way, (WRONG,))
        pairs = [f"{one.better} / {one.worse}" if one else "-" for one in (tested.get(way), widened.get(way))]
        largest = str(_largest(plan, found, way) or "-")
        share = percent(exact(wrong, of - right)) if right < of else "-"
        rows.append((way, largest, str(of), str(of - right), str(wrong), share, *pairs))
    head = (
        "way",
        "whole numbers up to",
        "sets",
        "failed",
        "wrong hulls",
        "of the failed",
        "against truncating",
        "with the interval",
    )
    notes = (
        "In brackets: 95 % intervals, exact (Clopper and Pearson).",
        "Sets, failed and wrong hulls: with the exact test. Whole numbers up to: the largest size tried with which, "
        "and with all smaller ones, no set failed. Against truncating: sets it finds and truncating does not / the "
        "other way round. With the interval: sets whose hull it finds at more / at fewer widths than truncating.",
    )
    return Table("table", "Ways of rounding, all sets", head, tuple(rows), notes)


def _sizes(plan: Plan, found: Summary) -> Table:
    rows = []
    for number, cell in cells(plan, test="exact"):
        sets = " to ".join(str(value) for name, value in cell.key.items() if name != "test")
        wrong = [str(found.hits(number, way, (WRONG,))) for way in WAYS]
        rows.append((sets, str(cell.samples), *(percent(found.share(number, way)) for way in WAYS), " ".join(wrong)))
    head = ("sets", "of each", *WAYS, "wrong hulls")
    notes = (*INTERVALS, "Wrong hulls: how many, in the order of the columns.")
    return Table("exact", "Hull found with the exact test", head, tuple(rows), notes)


def _widths(plan: Plan, found: Summary) -> Table:
    rows = []
    for number, cell in cells(plan, test="interval"):
        for k in WIDTHS:
            routes = [within(way, k) for way in WAYS]
            wrong = [str(found.hits(number, route, (WRONG,))) for route in routes]
            shares = [percent(found.share(number, route)) for route in routes]
            rows.append((str(cell.key["sets"]), f"10^{k}", str(cell.samples), *shares, " ".join(wrong)))
    head = ("sets", "e", "of each", *WAYS, "wrong hulls")
    notes = (*INTERVALS, "Wrong hulls: how many, in the order of the columns.")
    return Table("interval", "Hull found with the scaled interval", head, tuple(rows), notes)


def _size_chart(plan: Plan, found: Summary) -> Lines:
    shown = [(k, c) for k, c in cells(plan, sets=BOXES) if 99 <= int(c.key["to"]) <= 999]
    return Lines(
        "sizes",
        "The exact test: sets whose hull is found",
        "largest coordinate (whole numbers)",
        "hull found, of all sets",
        tuple(Series(way, tuple((float(c.key["to"]), found.share(k, way)) for k, c in shown)) for way in WAYS),
        percent=True,
        log_x=True,
        note=f"{shown[0][1].samples} sets of {POINTS} points at each size, the same for all ways; "
        "bars: 95 % intervals (Wilson)",
    )


def _width_chart(plan: Plan, found: Summary) -> Lines:
    ((number, cell),) = cells(plan, test="interval", sets=_SHOWN)
    return Lines(
        "interval",
        f"Chapter 7's interval, scaled: {_SHOWN}",
        "k, where e = 10^k is the distance from a plane that counts as on it",
        "hull found, of all sets",
        tuple(Series(way, tuple((float(k), found.share(number, within(way, k))) for k in WIDTHS)) for way in WAYS),
        percent=True,
        note=f"{cell.samples} sets of {POINTS} points; bars: 95 % intervals (Wilson)",
    )


def _wrong_chart(plan: Plan, found: Summary) -> Bars:
    return Bars(
        "wrong",
        "Wrong hulls that look right, with the scaled interval",
        "e",
        "wrong hull, of all sets",
        tuple(
            Series(
                way,
                tuple((f"10^{k}", wilson(*_pooled(plan, found, "interval", within(way, k), (WRONG,)))) for k in WIDTHS),
            )
            for way in WAYS
        ),
        percent=True,
        note=f"{sum(cell.samples for _, cell in cells(plan, test='interval'))} sets of {len(_INTERVAL)} kinds; "
        "bars: 95 % intervals (Wilson)",
    )


def _largest(plan: Plan, found: Summary, way: str) -> int | None:
    """The largest size with which, and with all smaller ones, no set failed."""
    best = None
    for number, cell in cells(plan, sets=BOXES):
        if found.failed(number, way):
            break
        best = int(cell.key["to"])
    return best


def _words(plan: Plan, found: Summary, tested: Mapping[str, _Against], widened: Mapping[str, _Against]) -> list[str]:
    sizes: dict[int | None, list[str]] = {}
    for way in WAYS:
        sizes.setdefault(_largest(plan, found, way), []).append(way)
    reach = [
        f"{size or 'none'} with {series(ways)}" for size, ways in sorted(sizes.items(), key=lambda one: one[0] or 0)
    ]
    first = (
        f"The largest whole numbers up to which no set of {POINTS} points failed with the exact test are, of the sizes "
        f"tried, {'; '.join(reach)}. "
        f"Against truncation, on the same sets of all kinds, {_told(tested, 'found and {} lost')}."
    )
    third = (
        "With the interval a way does better on a set than truncation where it finds its hull at more of the widths: "
        f"{_told(widened, 'better and {} worse')}. {_windows(plan, found)}"
    )
    return [first, _refusals(plan, found) + _decimal_sets(plan, found), third, _silent(plan, found)]


def _told(pairs: Mapping[str, _Against], words: str) -> str:
    return "; ".join(f"{way}: {one.better} {words.format(one.worse)} ({one.verdict})" for way, one in pairs.items())


def _refusals(plan: Plan, found: Summary) -> str:
    """How many of the failures with the exact test nobody would notice."""
    told, others = [], 0
    for way in WAYS:
        right, of = _pooled(plan, found, "exact", way, DETERMINED)
        wrong, _ = _pooled(plan, found, "exact", way, (WRONG,))
        others += of - right - wrong
        if right < of:
            told.append(f"{way}, {wrong} of {of - right}, {percent(exact(wrong, of - right))}")
    if not told:
        return "With the exact test no set failed in any way of rounding."
    return (
        "Of the sets that failed with the exact test so many ended in a wrong hull that looks like a right one (95 %, "
        "exact): "
        f"{'; '.join(told)}.{' The others were refused or did not end.' if others else ''}"
    )


def _decimal_sets(plan: Plan, found: Summary) -> str:
    """What decimal numbers are worth where the coordinates are decimals."""
    ((number, cell),) = cells(plan, sets=TENTHS)
    eight, binary = found.share(number, TRUNCATING), found.share(number, "float64")
    if eight.low <= binary.high:
        return ""
    return (
        f" Decimals need a decimal machine: of the sets {cell.key['sets']}, truncation to eight digits finds "
        f"{percent(eight)}; float64, which cannot hold a tenth, {percent(binary)}."
    )


def _windows(plan: Plan, found: Summary) -> str:
    """The widths at which no set failed, by kind of set."""
    told = []
    for number, cell in cells(plan, test="interval"):
        by_width: dict[str, list[str]] = {}
        for way in WAYS:
            clean = powers((k for k in WIDTHS if not found.failed(number, within(way, k))), "at no width")
            by_width.setdefault(clean, []).append(way)
        told.append(f"{cell.key['sets']}: " + ", ".join(f"{w} ({series(ways)})" for w, ways in by_width.items()))
    return f"Widths e at which no set failed: {'; '.join(told)}."


def _silent(plan: Plan, found: Summary) -> str:
    """How often the interval makes a hull wrong that looks right."""
    told, some = [], False
    for way in (TRUNCATING, "rounding", "float64"):
        shares = {k: wilson(*_pooled(plan, found, "interval", within(way, k), (WRONG,))) for k in WIDTHS}
        first, worst = shares[WIDTHS[0]], max(WIDTHS, key=lambda k: shares[k].value)
        some = some or shares[worst].value > 0
        told.append(
            f"{way}, {percent(first)} at e = 10^{WIDTHS[0]} and {percent(shares[worst])} at 10^{worst}"
            if shares[worst].value > first.value
            else f"{way}, {percent(first)} at e = 10^{WIDTHS[0]} and at no width more"
        )
    return (
        "The interval has its price in wrong hulls that look right; of its sets, at the narrowest width and at the "
        f"worst: {'; '.join(told)}."
        if some
        else "With the interval no hull that looks right was wrong."
    )
