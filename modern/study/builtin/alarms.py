"""Study which methods of error analysis notice that a program takes a wrong branch.

Every set goes through the corrected programs in eight-digit arithmetic.  Each decision up to the first wrong one is
compared with the decision of exact arithmetic on the same branch.  The study counts the decisions at which stochastic
arithmetic, intervals, sixteen digits and chapter 7's e raise an alarm (modern/study/alarms.py).  ``samples`` is the
number of point sets of each family.
"""

import json
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields
from functools import reduce
from typing import Any

from modern.study.alarms import ESTIMATING, METHODS
from modern.study.plan import Cell, Plan, Programs
from modern.study.report import (
    INTERVALS,
    Bars,
    Chart,
    Lines,
    Report,
    Series,
    Table,
    listed,
    percent,
    row,
    with_interval,
)
from modern.study.statistics import Interval, exact, mean
from modern.study.store import Store

TITLE = "which estimates of rounding errors tell a wrong decision from a right one"
SAMPLES = 5000
POINTS = 6
ROUTE = "corrected"
NAMES: Mapping[str, str] = {
    "cadna3": "CADNA, N = 3",
    "cadna10": "CADNA, N = 10",
    "parker10": "Stott Parker, N = 10",
    "vote10": "ten samples agree",
    "interval": "intervals",
    "double": "sixteen digits",
}
SHOWN = ("cadna3", "cadna10", "parker10", "interval", "double")
OPERATIONS = ("additions", "products", "quotients")
DIGITS = tuple(range(9))
# Exponents k of the tried e = 10**k.
POWERS = tuple(range(-9, 10))
FAMILIES: tuple[tuple[str, str, dict[str, int]], ...] = (
    ("thesis's kind", "thesis", {}),
    ("whole, 3 digits", "integers", {"digits": 3, "n": POINTS}),
    ("whole, 4 digits", "integers", {"digits": 4, "n": POINTS}),
    ("decimals, 3 digits", "decimals", {"digits": 3, "n": POINTS}),
    ("ball, 3 digits", "ball", {"digits": 3, "n": POINTS}),
    ("sphere, 3 digits", "sphere", {"digits": 3, "n": POINTS}),
    ("cube, 3 digits", "cube", {"digits": 3, "n": POINTS}),
    ("pyramid, 3 digits", "pyramid", {"digits": 3, "n": POINTS}),
    ("nearly flat, 3 digits", "near-coplanar", {"digits": 3, "n": POINTS, "gap": 1}),
)


def plan(samples: int = SAMPLES, seed: int = 1963) -> Plan:
    route = Programs(ROUTE, layers=("corrected",), core=60_000, limit=20_000, measures=("alarms",))
    cells = tuple(
        Cell({"sets": name}, family, parameters, (route,), samples, chunk=25) for name, family, parameters in FAMILIES
    )
    return Plan(
        "alarms",
        TITLE[0].upper() + TITLE[1:],
        "Stochastic arithmetic, intervals and higher precision estimate rounding errors without knowing the truth. How "
        "many wrong decisions of a program do they notice, and how many alarms do they raise at right ones?",
        cells,
        seed,
        (
            "All arithmetics repeat the operations of the machine on the branch that it took, from the numbers on the "
            "cards. Each program is judged up to its first wrong decision, so a run has at most one.",
            f"Sets have {POINTS} points, except those of the thesis's kind, whose numbers of points vary. Six points "
            "suffice for every kind of decision, and more points would mostly repeat them.",
        ),
    )


@dataclass
class _Group:
    """Counts of the runs of one or several cells.

    wrong: runs with a wrong decision.  sound: runs in which all decisions are right.  The other attributes are counts
    by method.  noticed: runs with an alarm at the first wrong decision.  repaired: runs in which the method, used to
    decide, would take the right branch at the first wrong decision.  warned: runs with an alarm at or before the first
    wrong decision.  alarmed: sound runs with an alarm.  spoiled: sound runs with a decision that the method would
    change.  false: alarms at right decisions.
    """

    wrong: int = 0
    sound: int = 0
    right_decisions: int = 0
    noticed: Counter[str] = field(default_factory=Counter)
    repaired: Counter[str] = field(default_factory=Counter)
    warned: Counter[str] = field(default_factory=Counter)
    alarmed: Counter[str] = field(default_factory=Counter)
    spoiled: Counter[str] = field(default_factory=Counter)
    false: Counter[str] = field(default_factory=Counter)

    def add(self, figures: Mapping[str, Any]) -> None:
        """Add the figures of one run to the counts."""
        is_wrong = bool(figures["first"])
        self.wrong, self.sound = self.wrong + is_wrong, self.sound + (not is_wrong)
        self.right_decisions += figures["tests"] - is_wrong
        for name, alarms, spoils, caught, repaired in _by_method(figures):
            self.false[name] += alarms
            if is_wrong:
                self.noticed[name] += caught
                self.repaired[name] += repaired
                self.warned[name] += bool(caught or alarms)
            else:
                self.alarmed[name] += alarms > 0
                self.spoiled[name] += spoils > 0

    def __add__(self, other: "_Group") -> "_Group":
        return _Group(*(getattr(self, part.name) + getattr(other, part.name) for part in fields(self)))

    def best_e(self) -> int:
        """Return the k for which e = 10**k notices the most wrong decisions.

        If there are several, return the least.
        """
        return max(POWERS, key=lambda k: self.noticed[e_name(k)])

    def share(self, counter: Counter[str], name: str) -> Interval | None:
        """Return a method's count as a share of all sound runs, or of all wrong runs, depending on ``counter``."""
        of = self.sound if counter is self.alarmed or counter is self.spoiled else self.wrong
        return exact(counter[name], of) if of else None


def _by_method(figures: Mapping[str, Any]) -> Iterator[tuple[str, int, int, int, int]]:
    """Yield for each method and each e: its name, and its figures ``false``, ``spoils``, ``caught`` and ``repaired``.

    :func:`modern.study.alarms.alarms` explains the figures.
    """
    for name in METHODS:
        numbers = (figures.get(f"{name}_{figure}", 0) for figure in ("false", "spoils", "caught", "repaired"))
        false, spoils, caught, repaired = numbers
        yield name, false, spoils, caught, repaired
    right = {int(k): int(n) for k, n in (pair.split(":") for pair in figures["e_right"].split())}
    for k in POWERS:
        alarms = sum(n for power, n in right.items() if power <= k)
        caught = "e_first" in figures and figures["e_first"] <= k
        yield e_name(k), alarms, alarms, caught, caught and figures["e_repaired"]


@dataclass
class _Rows:
    """The numbers that the report shows, counted over runs.

    ``groups`` has the counts of runs and alarms for each cell of the study, and ``places`` has those for each statement
    at which a run took its first wrong decision.
    """

    groups: dict[int, _Group] = field(default_factory=dict)
    places: dict[str, _Group] = field(default_factory=dict)
    # For each method and number of true digits: the mean estimate of each run.
    digits: dict[tuple[str, int], list[float]] = field(default_factory=dict)
    numbers: Counter[int] = field(default_factory=Counter)
    # For each method: the number of runs with an estimate, and with an estimate that is more than a digit too large.
    estimated: Counter[str] = field(default_factory=Counter)
    optimistic: Counter[str] = field(default_factory=Counter)
    operations: Counter[str] = field(default_factory=Counter)

    @property
    def all(self) -> _Group:
        return reduce(lambda a, b: a + b, self.groups.values())


def e_name(power: int) -> str:
    """Return the name under which the report counts chapter 7's e = 10**power as a method."""
    return f"e = 10^{power}"


def report(plan: Plan, store: Store) -> Report:
    rows = _Rows()
    for cell, text in store.query("SELECT cell, figures FROM runs ORDER BY cell, place"):
        figures = json.loads(text)
        if "tests" in figures:
            _count(rows, cell, figures)
    charts: tuple[Chart, ...] = (_bars(plan, rows, "noticed"), _bars(plan, rows, "alarms"), _digit_chart(rows))
    tables = (_main(rows), _families(plan, rows), _e_table(rows), _digit_table(rows), _places(rows), _costs(rows))
    return Report(tables, charts, _conclusions(rows))


def _count(rows: _Rows, cell: int, figures: Mapping[str, Any]) -> None:
    rows.groups.setdefault(cell, _Group()).add(figures)
    if figures["first"]:
        rows.places.setdefault(figures["first"], _Group()).add(figures)
    for name in OPERATIONS:
        rows.operations[name] += figures[name]
    for name in ESTIMATING:
        entries = [(d, figures[f"{name}_digits_{d}"].split()) for d in DIGITS if f"{name}_digits_{d}" in figures]
        for d, (number, average, _) in entries:
            rows.digits.setdefault((name, d), []).append(float(average))
            rows.numbers[d] += int(number) if name == ESTIMATING[0] else 0
        rows.estimated[name] += bool(entries)
        rows.optimistic[name] += any(int(over) for _, (_, _, over) in entries)


def _main(rows: _Rows) -> Table:
    group, lines = rows.all, []
    for name in (*METHODS, e_name(group.best_e())):
        shares = [group.share(counter, name) for counter in (group.noticed, group.warned, group.repaired)]
        false = [group.share(counter, name) for counter in (group.alarmed, group.spoiled)]
        per_decision = f"{100 * group.false[name] / max(group.right_decisions, 1):.2f} %"
        lines.append(row(NAMES.get(name, name), group.wrong, *shares, group.sound, *false, per_decision))
    of_wrong = ("runs with a wrong decision", "noticed", "noticed or announced", "decided rightly")
    head = ("method", *of_wrong, "sound runs", "false alarm", "would go wrong", "alarms at right decisions")
    notes = (
        *INTERVALS,
        "A method notices a wrong decision if it raises an alarm there, and announces it by an alarm at an earlier "
        "decision. All decisions of a sound run are right. A method would go wrong if its own decision would be wrong "
        "somewhere in a sound run. The e of the last row notices the largest number of wrong decisions of these runs; "
        "of several such e, it is the smallest.",
        "CADNA's criterion takes a number for zero if the estimate C of its significant digits is at most 0, as Vignes "
        "defines it. CADNA's library prints @.0 already if C is less than 0.5.",
    )
    return Table("table", "Wrong decisions noticed, and false alarms", head, tuple(lines), notes)


def _families(plan: Plan, rows: _Rows) -> Table:
    lines = []
    for number, group in rows.groups.items():
        for name in (*METHODS, e_name(group.best_e())):
            noticed, alarmed = group.share(group.noticed, name), group.share(group.alarmed, name)
            key = plan.cells[number].key["sets"]
            lines.append(row(key, NAMES.get(name, name), group.wrong, noticed, group.sound, alarmed))
    head = ("sets", "method", "runs with a wrong decision", "noticed", "sound runs", "false alarm")
    notes = (
        *INTERVALS,
        "The row of chapter 7's e uses, for each family, the e that notices the most wrong decisions; of several such "
        "e, the smallest.",
    )
    return Table("families", "Wrong decisions noticed, and false alarms, by family", head, tuple(lines), notes)


def _e_table(rows: _Rows) -> Table:
    group = rows.all
    lines = tuple(
        row(f"10^{k}", group.share(group.noticed, e_name(k)), group.share(group.alarmed, e_name(k))) for k in POWERS
    )
    return Table("e", "Chapter 7's e, all families", ("e", "noticed", "false alarm"), lines, INTERVALS)


def _digit_table(rows: _Rows) -> Table:
    lines = []
    for d in DIGITS:
        if rows.numbers[d]:
            means = [mean(rows.digits[name, d], least=0.0, most=8.0) for name in ESTIMATING]
            lines.append((str(d), str(rows.numbers[d]), *(with_interval(estimate) for estimate in means)))
    shares = (
        percent(exact(rows.optimistic[name], rows.estimated[name])) for name in ESTIMATING if rows.estimated[name]
    )
    lines.append(("more than one digit too many", str(rows.estimated[ESTIMATING[0]]), *shares))
    head = ("true digits", "numbers", *(NAMES[name] for name in ESTIMATING))
    notes = (
        "The table groups the inexact numbers that decisions test by their correct digits, rounded to an integer, and "
        "gives the mean of the estimates with Student's 95 % interval over runs. The last row has the share of runs "
        "with a number whose estimate is more than one digit too large (exact 95 % interval).",
    )
    return Table("digits", "Digits estimated against true digits", head, tuple(lines), notes)


def _places(rows: _Rows) -> Table:
    ordered = sorted(rows.places.items(), key=lambda item: (-item[1].wrong, item[0]))
    lines = tuple(
        row(place, group.wrong, *(group.share(group.noticed, name) for name in METHODS)) for place, group in ordered
    )
    head = ("first wrong decision", "runs", *(NAMES[name] for name in METHODS))
    return Table("places", "Where the first wrong decision is, and who notices it", head, lines, INTERVALS)


def _double_cost(rows: _Rows) -> float:
    ops = rows.operations

    def microseconds(p: int) -> int:
        product, quotient = 560 + 40 * p + 168 * p * p, 160 + 520 * p * p + 740 * p
        return ops["additions"] * (160 + 80 * p) + ops["products"] * product + ops["quotients"] * quotient

    return microseconds(16) / microseconds(8)


def _costs(rows: _Rows) -> Table:
    """Return a table of the time that each method takes, computed with the instruction times of a 1620 Model 1."""
    factors = {"cadna3": 3.0, "cadna10": 10.0, "parker10": 10.0, "vote10": 10.0, "interval": 2.0}
    factors["double"] = _double_cost(rows)
    lines = tuple((NAMES[name], f"{factors[name]:.1f}") for name in METHODS)
    notes = (
        "The table compares the time of the digit arithmetic with that of a plain run: additions take 160 + 80 P, "
        "products 560 + 40 P + 168 P^2, quotients 160 + 740 P + 520 P^2 microseconds with P digits (A26-5706-3). "
        "Intervals take two operations for each operation of a plain run, or more if an interval contains zero. "
        "Chapter 7's e takes an additional comparison.",
    )
    return Table("cost", "Cost relative to a plain run", ("method", "times a plain run"), lines, notes)


def _bars(plan: Plan, rows: _Rows, name: str) -> Bars:
    is_noticed = name == "noticed"
    series = []
    for method in SHOWN:
        points: list[tuple[str, Interval]] = []
        for number, group in rows.groups.items():
            share = group.share(group.noticed if is_noticed else group.alarmed, method)
            if share and group.wrong:
                points.append((str(plan.cells[number].key["sets"]), share))
        series.append(Series(NAMES[method], tuple(points)))
    title = "Wrong decisions that the methods notice" if is_noticed else "Sound runs with a false alarm"
    y = "share of runs with a wrong decision" if is_noticed else "share of sound runs"
    note = f"{plan.cells[0].samples} sets of each family; bars: exact 95 % intervals"
    return Bars(name, title, "", y, tuple(series), percent=True, note=note)


def _digit_chart(rows: _Rows) -> Lines:
    series = tuple(
        Series(
            NAMES[name],
            tuple(
                (float(d), mean(rows.digits[name, d], least=0.0, most=8.0)) for d in DIGITS if (name, d) in rows.digits
            ),
        )
        for name in ESTIMATING
    )
    truth = Series("true", tuple((float(d), Interval(float(d), float(d), float(d))) for d in DIGITS))
    note = "numbers tested by a decision; bars: 95 % intervals of the mean (Student's)"
    return Lines(
        "digits", "Estimated against true digits", "true digits", "estimated digits", (*series, truth), note=note
    )


def _conclusions(rows: _Rows) -> tuple[str, ...]:
    group = rows.all
    if not group.wrong:
        return ("No run took a wrong decision.",)
    # Sets without any rounding would only dilute the false alarms.
    hard = reduce(lambda a, b: a + b, (each for each in rows.groups.values() if each.wrong))
    e = e_name(group.best_e())
    noticed = {name: row(group.share(group.noticed, name))[0] for name in (*METHODS, e)}
    alarmed = {name: row(hard.share(hard.alarmed, name))[0] for name in (*METHODS, e)}
    complete = listed(NAMES[name] for name in METHODS if group.noticed[name] == group.wrong)
    fewer = group.noticed["cadna10"] < group.noticed["cadna3"]
    optimistic = percent(exact(rows.optimistic["cadna3"], rows.estimated["cadna3"]))
    quiet = not group.alarmed["double"] and group.noticed["double"] == group.wrong
    return (
        f"Of {group.wrong:,} runs in which eight-digit arithmetic took a wrong branch, CADNA's criterion noticed "
        f"{noticed['cadna3']} with three samples and {noticed['cadna10']} with ten"
        + (", because the program branches on a single number, not on their mean" if fewer else "")
        + f". An alarm says little about a branch: of {hard.sound:,} runs of the same families in which every branch "
        f"was right, the criterion with three samples raised an alarm in {alarmed['cadna3']}, and intervals, which "
        f"miss no wrong branch, in {alarmed['interval']}. "
        + (
            f"Sixteen digits, at {_double_cost(rows):.1f} times the cost of a plain run, took every branch as exact "
            "arithmetic does: a proof shows that 3d + 4 digits are enough for coordinates of d digits, except for the "
            "choice of the first line. An estimate of the error cannot give such a guarantee."
            if quiet
            else f"Sixteen digits noticed {noticed['double']} and raised a false alarm in {alarmed['double']}."
        ),
        f"Stott Parker's criterion, which judges a single sample, noticed {noticed['parker10']}. These methods noticed "
        f"all wrong decisions: {complete}.",
        f"Chapter 7's e noticed at most {noticed[e]} of the wrong decisions, at {e}. This e raises an alarm in "
        f"{alarmed[e]} of the runs without a wrong decision. In {optimistic} of the runs with rounding errors, CADNA "
        "with three samples claimed more than one digit too many for some number that a decision tests.",
    )
