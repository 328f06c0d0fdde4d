"""The part of the study ``seventy`` about data sheets with decimals: how often the programs reject such sets.

The thesis attributes its two failures in about seventy sets to the eight digits of the machine.  The programs reject
sets like the data sheet of chapter 5 (:func:`modern.study.families.thesis.data_sheet`) more often if more of their
coordinates are decimals.  The report states how many such sets among seventy would explain two rejections.
"""

from dataclasses import dataclass
from itertools import pairwise

from modern.geometry.hull import NOT_ACCEPTABLE
from modern.study.families.thesis import SHEET
from modern.study.outcomes import DETERMINED
from modern.study.plan import Cell, Plan, Programs
from modern.study.report import INTERVALS, Bars, Series, Table, percent, row, with_interval
from modern.study.statistics import Interval, count, exact
from modern.study.store import Store

SEVENTY, TWO = 70, 2
# How many of a thousand coordinates are decimals; 333 is the share on the data sheet of chapter 5.
SHARES = (0, 2, 5, 10, 20, 50, 100, 250, 333)
FORMS = {"alone": "as on the sheet (.0146)", "added": "added to a whole number (12.0146)"}


def cells(samples: int, route: Programs) -> tuple[Cell, ...]:
    """Return the cells of the study: one for each share and each form of decimals."""
    return tuple(
        Cell(
            {"decimals": share, "form": form},
            "thesis",
            {"kinds": {SHEET: 1}, "decimals": share, "form": form},
            (route,),
            samples,
        )
        for form in FORMS
        for share in SHARES
        if share or form == "alone"
    )


@dataclass(frozen=True, slots=True)
class Sheets:
    """The results of all data sheets with one share and form of decimals.

    share: how many of 1,000 coordinates are decimals.  sets: the number of data sheets.  refused: the number of data
    sheets that the programs rejected.  otherwise: the number of those that failed in another way.
    """

    share: int
    form: str
    sets: int
    refused: int
    otherwise: int

    @property
    def rate(self) -> Interval:
        """Return the share of these data sheets that the programs reject."""
        return exact(self.refused, self.sets)


# The range of the probability of rejection in which two of seventy is the most probable number (binomial mode).
TWO_LIKELIEST = (TWO / (SEVENTY + 1), (TWO + 1) / (SEVENTY + 1))


def measured(plan: Plan, store: Store) -> tuple[Sheets, ...]:
    """Return the counts of the study for each share and form of decimals."""
    sheets = []
    for number, cell in enumerate(plan.cells):
        if "decimals" not in cell.key:
            continue
        counts = {key[0]: n for key, n in store.counts("outcome", cell=number).items()}
        refused = counts.get(NOT_ACCEPTABLE, 0)
        otherwise = sum(n for outcome, n in counts.items() if outcome not in (*DETERMINED, NOT_ACCEPTABLE))
        key = cell.key
        sheets.append(Sheets(int(key["decimals"]), str(key["form"]), cell.samples, refused, otherwise))
    return tuple(sheets)


def table(sheets: tuple[Sheets, ...]) -> Table:
    """Return a table with a row for each share and form of decimals."""
    head = ("decimals", "drawn", "sets", "refused", "of seventy", "failed otherwise", "sheets in 70 for two")
    rows = []
    for s in sheets:
        of_seventy = with_interval(count(s.refused, s.sets, SEVENTY), 1)
        rows.append(row(f"{s.share / 10:g} %", FORMS[s.form], s.sets, s.rate, of_seventy, s.otherwise, needed(s)))
    notes = (
        "A set is refused if a program types DATA NOT ACCEPTABLE. The last column tells how many of seventy sets "
        "must be such data sheets to make two the most probable number of rejections, if the other sets are never "
        "rejected.",
        *INTERVALS,
    )
    return Table("decimals", "Data sheets with decimals, as listed", head, tuple(rows), notes)


def needed(sheets: Sheets) -> str:
    """Return how many of seventy sets must be data sheets for two to be the most probable number of rejections."""
    if not sheets.refused:
        return "-"
    low, high = (SEVENTY * bound / sheets.rate.value for bound in TWO_LIKELIEST)
    return f"{low:.1f} to {high:.1f}" if low <= SEVENTY else "-"


def likely_shares(rates: tuple[tuple[int, float], ...]) -> tuple[float, float] | None:
    """Return the least and the greatest share of decimals at which two of seventy sets are most probably rejected.

    Shares are in thousandths.  ``rates`` holds pairs (share, frequency of rejection) with ascending shares, between
    which the function interpolates linearly.  Return None if the rates do not reach both ends of the range.
    """
    crossings = []
    for bound in TWO_LIKELIEST:
        for (x, low), (y, high) in pairwise(rates):
            if low < bound <= high:
                crossings.append(x + (y - x) * (bound - low) / (high - low))
                break
    return (crossings[0], crossings[1]) if len(crossings) == len(TWO_LIKELIEST) else None


def chart(sheets: tuple[Sheets, ...]) -> Bars:
    """Return the chart of the share of rejected data sheets against the share of decimals."""
    series = tuple(
        Series(description, tuple((f"{s.share / 10:g}", s.rate) for s in sheets if s.form == form or not s.share))
        for form, description in FORMS.items()
    )
    return Bars(
        "decimals",
        "Data sheets rejected",
        "decimals, % of coordinates",
        "share of sets with DATA NOT ACCEPTABLE",
        series,
        percent=True,
        note=f"{sheets[0].sets:,} sets of 8 points each; bars: exact 95 % intervals",
    )


def conclusions(sheets: tuple[Sheets, ...]) -> tuple[str, ...]:
    """Return the conclusions about data sheets, one paragraph for each form of decimals."""
    paragraphs = []
    for form, drawn in FORMS.items():
        of_form = [s for s in sheets if s.form == form or not s.share]
        shares = likely_shares(tuple((s.share, s.rate.value) for s in of_form))
        printed = of_form[-1]
        text = (
            f"For decimals {drawn}: if a third of the coordinates are decimals, as on the data sheet, the programs "
            f"reject {percent(printed.rate)} of the sets."
        )
        if printed.refused:
            text += (
                f" Two rejections in seventy sets are the most probable number if {needed(printed)} of the seventy "
                "sets are like this data sheet"
            )
            if shares is not None:
                low, high = (f"{share / 10:.2f}" for share in shares)
                text += f", or if the share of decimals in all seventy sets is from {low} to {high} %"
            text += "."
        if shares is None:
            text += (
                " The share of decimals in all seventy sets that would make two rejections most probable cannot be "
                "determined."
            )
        paragraphs.append(text)
    return tuple(paragraphs)
