"""Study the two failures in about seventy examples that the thesis reports.

Sets like those of the thesis (:mod:`modern.study.families.thesis`), in groups of seventy, go through its programs as
listed, and with one corrected card.  Without the correction (row P3-025, KNOWN-FAULTS 1), program 3 can fail after it
has removed two planes inside the hull at the end of its table.  A set fails if the programs do not give its hull.
``samples`` counts the sets and is a multiple of seventy.

These sets have integer coordinates, for which eight digits are sufficient, so no set is rejected as DATA NOT
ACCEPTABLE.  The data sheet of chapter 5 (p. 58-59) has decimals.  Sets like this data sheet, ``samples`` / 70 for each
share of decimals, therefore go through the programs as listed too.
"""

from collections import Counter
from dataclasses import dataclass

from modern.geometry.hull import NOT_ACCEPTABLE
from modern.study import refusals
from modern.study.families.thesis import KINDS
from modern.study.outcomes import DETERMINED, DETERMINED_SQL, WRONG
from modern.study.plan import Cell, Plan, PlanError, Programs
from modern.study.report import (
    INTERVALS,
    Bars,
    Mark,
    Report,
    Series,
    Table,
    listed,
    percent,
    row,
    share_of,
    with_interval,
)
from modern.study.statistics import Interval, count, exact
from modern.study.store import Store

TITLE = "failures in seventy examples, with and without the correction of the last pair"
SEVENTY = 70
SAMPLES = 2_000 * SEVENTY
THESIS = 2
LISTED, MENDED = "as listed", "last pair mended"
_LIMIT = 200_000
# An event is called unusual if it occurs in a smaller share of the groups of seventy than this.
_RARE = 0.05
_IN_SPACE = ("slab", "plane and points")
# The number of the cell with the sets modelled on chapter 6; the following cells hold the data sheets.
_EXAMPLES = 0


def plan(samples: int = SAMPLES, seed: int = 1963) -> Plan:
    """Return the plan for ``samples`` sets.  Raise PlanError unless ``samples`` is a multiple of seventy."""
    if samples < SEVENTY or samples % SEVENTY:
        raise PlanError(f"seventy: the number of samples must be a multiple of {SEVENTY}, found {samples}")
    routes = (Programs(LISTED, limit=_LIMIT), Programs(MENDED, rows=("P3-025",), limit=_LIMIT))
    return Plan(
        "seventy",
        TITLE[0].upper() + TITLE[1:],
        "The thesis reports two failures in about seventy examples and attributes them to the limits of the computer. "
        "How many failures do seventy such sets have, and of what kind?",
        (
            Cell({}, "thesis", {}, routes, samples, chunk=3 * SEVENTY),
            *refusals.cells(samples // SEVENTY, Programs(LISTED, limit=_LIMIT)),
        ),
        seed,
        (
            "The thesis does not describe its seventy examples. Chapter 6 prints six of them, one for each kind of "
            "output and two for points in space: three points, a line, one point, a plane, and two sets in space, one "
            "of them a plane with points off it. Each kind is modelled on one of the six, and all are equally likely; "
            "modern/study/families/thesis.py describes the coordinates. The report also gives the failures of each "
            "kind, from which those of seventy sets of any other composition can be computed.",
            "The two points printed from the data sheet of chapter 5 have two decimals among six coordinates; chapter "
            "6 has none among its 138. The share of decimals in the seventy examples is not known. So it is varied, "
            "with two ways of drawing decimals, and the report gives the shares that make two rejections likeliest.",
            f"A run of more than {_LIMIT} statements counts as endless.",
        ),
    )


@dataclass(frozen=True, slots=True)
class _Route:
    """The results of one route: the number of failures in each group of seventy sets, and the number for each cause."""

    name: str
    failures: tuple[int, ...]
    causes: Counter[tuple[str, str]]

    @property
    def sets(self) -> int:
        return SEVENTY * len(self.failures)

    @property
    def failed(self) -> int:
        return sum(self.failures)

    @property
    def mean(self) -> Interval:
        """Return the expected number of failures in seventy sets, with its binomial interval."""
        return count(self.failed, self.sets, SEVENTY)

    def groups(self, least: int, most: int = SEVENTY) -> Interval:
        """Return the share of groups of seventy sets that have ``least`` to ``most`` failures."""
        return exact(sum(least <= n <= most for n in self.failures), len(self.failures))


def report(plan: Plan, store: Store) -> Report:
    as_listed, mended = _route(store, LISTED), _route(store, MENDED)
    kinds = store.counts("tags.kind", "route", "outcome", cell=_EXAMPLES)
    sheets = refusals.measured(plan, store)
    return Report(
        (
            _main(as_listed, mended),
            _distribution(as_listed, mended),
            _by_kind(kinds),
            _causes(as_listed, mended),
            refusals.table(sheets),
        ),
        (_chart(as_listed, mended), _kind_chart(kinds), refusals.chart(sheets)),
        (
            *_conclusions(as_listed, mended, kinds, _longest(store)),
            *refusals.conclusions(sheets),
            _comparison(as_listed, sheets),
        ),
    )


def _route(store: Store, name: str) -> _Route:
    groups = store.query(
        f"SELECT SUM(outcome NOT IN {DETERMINED_SQL}) FROM runs WHERE cell = ? AND route = ? "
        f"GROUP BY place / {SEVENTY} ORDER BY place / {SEVENTY}",
        (_EXAMPLES, name),
    )
    failures = tuple(failed for (failed,) in groups)
    counts = store.counts("outcome", "detail", cell=_EXAMPLES, route=name)
    causes = {cause: n for cause, n in counts.items() if cause[0] not in DETERMINED}
    return _Route(name, failures, Counter(causes))


def _longest(store: Store) -> int:
    longest = store.query(
        f"SELECT MAX(json_extract(figures, '$.statements')) FROM runs WHERE cell = ? AND outcome IN {DETERMINED_SQL}",
        (_EXAMPLES,),
    )
    return int(next(iter(longest))[0] or 0)


def _main(*routes: _Route) -> Table:
    head = ("program", "sets", "failed", "of all sets", "failures in 70", "70s with 2", "70s with 2 or more")
    rows = []
    for route in routes:
        share, groups = exact(route.failed, route.sets), (route.groups(THESIS, THESIS), route.groups(THESIS))
        rows.append(row(route.name, route.sets, route.failed, share, with_interval(route.mean), *groups))
    notes = (
        "The numbers in parentheses are exact 95 % intervals (Clopper and Pearson). The mean and interval of "
        "*failures in 70* are seventy times the share of failures, because sets are drawn independently. *70s* are "
        "groups of seventy sets.",
    )
    return Table("table", "Failures in seventy examples", head, tuple(rows), notes)


def _distribution(*routes: _Route) -> Table:
    head = ("failures", *(f"70s, {route.name}" for route in routes), *(f"share, {route.name}" for route in routes))
    most = max(max(route.failures) for route in routes)
    counts = [Counter(route.failures) for route in routes]
    rows = tuple(
        row(k, *(count[k] for count in counts), *(route.groups(k, k) for route in routes)) for k in range(most + 1)
    )
    return Table("distribution", "Failures per group of seventy sets", head, rows, INTERVALS)


def _by_kind(kinds: dict[tuple[str, ...], int]) -> Table:
    rows = []
    for kind in _names(kinds):
        shares = [_share(kinds, (kind,), route) for route in (LISTED, MENDED)]
        rows.append(row(kind, _of(kinds, (kind,)), *shares))
    head = ("kind", "sets", f"failed, {LISTED}", f"failed, {MENDED}")
    return Table("kinds", "Failures by kind of set", head, tuple(rows), INTERVALS)


def _causes(*routes: _Route) -> Table:
    names = sorted({key for route in routes for key in route.causes})
    rows = []
    for cause in names:
        shares = [exact(route.causes[cause], route.sets) for route in routes]
        rows.append(row(*cause, *(route.causes[cause] for route in routes), *shares))
    head = ("outcome", "where", *(route.name for route in routes), *(f"of all, {route.name}" for route in routes))
    return Table("causes", "How the sets failed", head, tuple(rows), INTERVALS)


def _chart(*routes: _Route) -> Bars:
    most = max(max(route.failures) for route in routes)
    series = tuple(Series(r.name, tuple((str(k), r.groups(k, k)) for k in range(most + 1))) for r in routes)
    return Bars(
        "seventy",
        "Failures in seventy sets like the thesis's",
        "failures in 70 sets",
        "share of the groups of seventy",
        series,
        percent=True,
        marks=(Mark(THESIS, "the thesis: 2 in about 70", upright=True),),
        note=f"{len(routes[0].failures):,} times 70 sets; bars: exact 95 % intervals",
    )


def _kind_chart(kinds: dict[tuple[str, ...], int]) -> Bars:
    names = _names(kinds)
    series = tuple(
        Series(route, tuple((name, _share(kinds, (name,), route)) for name in names)) for route in (LISTED, MENDED)
    )
    return Bars(
        "kinds",
        "Failures by kind of set",
        "",
        "share of sets that fail",
        series,
        percent=True,
        note="bars: exact 95 % intervals",
    )


def _names(kinds: dict[tuple[str, ...], int]) -> list[str]:
    return [kind for kind in KINDS if any(key[0] == kind for key in kinds)]


def _of(kinds: dict[tuple[str, ...], int], names: tuple[str, ...], route: str = LISTED) -> int:
    return sum(n for key, n in kinds.items() if key[0] in names and key[1] == route)


def _share(kinds: dict[tuple[str, ...], int], names: tuple[str, ...], route: str) -> Interval:
    return exact(*_failed(kinds, names, route))


def _failed(kinds: dict[tuple[str, ...], int], names: tuple[str, ...], route: str) -> tuple[int, int]:
    failed = sum(n for key, n in kinds.items() if key[0] in names and key[1] == route and key[2] not in DETERMINED)
    return failed, _of(kinds, names, route)


def _conclusions(as_listed: _Route, mended: _Route, kinds: dict[tuple[str, ...], int], longest: int) -> tuple[str, ...]:
    causes = as_listed.causes
    digits, wrong = (
        sum(n for (outcome, _), n in causes.items() if outcome == counted) for counted in (NOT_ACCEPTABLE, WRONG)
    )
    frequent = (f"{outcome} {where}, {share_of(n, as_listed.failed)}" for (outcome, where), n in causes.most_common(3))
    conclusions = [
        f"On average, seventy sets like those of the thesis have {with_interval(as_listed.mean)} failures with the "
        f"programs as listed, {_compared_with_two(as_listed.mean)}. Of the groups of seventy sets, "
        f"{percent(as_listed.groups(THESIS, THESIS))} have exactly two failures and "
        f"{percent(as_listed.groups(THESIS))} have two or more. "
        f"Two failures in seventy are {_unusual(as_listed.groups(THESIS))}.",
        "The most frequent failures of the programs as listed are, with the statements at which they occur and their "
        f"share of all failures: {listed(frequent)}. Of the failures, {share_of(digits, as_listed.failed)}, end with "
        f"DATA NOT ACCEPTABLE, the message for too few digits, and {share_of(wrong, as_listed.failed)}, are plausible "
        "but wrong hulls.",
        "With one more card, which corrects the removal of the last pair of planes (emendation P3-025), seventy sets "
        f"have {with_interval(mended.mean)} failures on average, {as_listed.mean.value - mended.mean.value:.2f} fewer "
        "than with the programs as listed.",
        f"The longest run that gave a hull executed {longest:,} statements. A run of more than {_LIMIT:,} statements "
        "counts as endless.",
    ]
    space = tuple(name for name in _names(kinds) if name in _IN_SPACE)
    if space:
        failed = _failed(kinds, space, LISTED)
        share, seventy = exact(*failed), count(*failed, SEVENTY)
        conclusions[2] += (
            f" Of the sets of points in space, {percent(share)} fail with the programs as listed, so seventy such sets "
            f"have {with_interval(seventy, 1)} failures on average."
        )
    return tuple(conclusions)


def _compared_with_two(failures: Interval) -> str:
    if failures.high < THESIS:
        return "fewer than the two of the thesis"
    return (
        "more than the two of the thesis"
        if failures.low > THESIS
        else "not significantly different from the two of the thesis"
    )


def _unusual(share: Interval) -> str:
    """Describe how unusual it is that a group of seventy sets has two failures or more."""
    if share.low > _RARE:
        return "not unusual for such sets"
    return "unusual for such sets" if share.high < _RARE else "possibly unusual; there are too few groups to decide"


def _comparison(as_listed: _Route, sheets: tuple[refusals.Sheets, ...]) -> str:
    printed = [s for s in sheets if s.share == max(sheet.share for sheet in sheets)]
    needed = " or ".join(refusals.needed(s) for s in printed)
    return (
        "Two explanations of the two failures are possible. The first explanation is limits of the machine, as the "
        f"thesis says. It is enough if {needed} of the seventy sets are like the data sheet of the thesis, and the "
        "message of a rejection names the cause. But none of the six sets that the thesis prints in full has a "
        "decimal. The second explanation is faults of the programs: such failures occur even with small integers, and "
        f"{percent(as_listed.groups(THESIS))} of the groups of seventy have two or more failures from this cause "
        "alone. But these runs end in ERROR IN PROGRAM, in a loop or in a wrong hull, which the author would hardly "
        "have attributed to too few digits. The thesis does not say which explanation holds. The two failures may "
        "also have different causes."
    )
