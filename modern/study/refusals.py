"""Data sheets with decimals: how often the programs refuse them, and what share of them two refusals in seventy need.

The thesis explains its two failures by the limits of the machine: eight digits, for which its programs have a message,
DATA NOT ACCEPTABLE.  Sets like the data sheet of chapter 5 (:func:`modern.study.families.thesis.data_sheet`) are
refused the more often the more of their coordinates are decimals; the share of decimals is the variable here.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

from modern.geometry.hull import NOT_ACCEPTABLE
from modern.study.families.thesis import SHEET
from modern.study.outcomes import DETERMINED
from modern.study.plan import Cell, Plan, Programs
from modern.study.report import INTERVALS, Bars, Series, Table, percent, with_interval
from modern.study.statistics import Interval, count, exact
from modern.study.store import Store

SEVENTY, TWO = 70, 2
SHARES = (0, 2, 5, 10, 20, 50, 100, 250, 333)
"""Decimals in a thousand coordinates; 333 is the share on the data sheet."""
FORMS = {"alone": "as on the sheet (.0146)", "added": "added to a whole number (12.0146)"}


def cells(samples: int, route: Programs) -> tuple[Cell, ...]:
    """A cell for each share and form of decimals, through one route."""
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
    """Data sheets with one share of decimals, drawn in one form: how many, refused, and failed otherwise."""

    share: int
    form: str
    sets: int
    refused: int
    otherwise: int

    @property
    def rate(self) -> Interval:
        """How often such a set is refused."""
        return exact(self.refused, self.sets)


TWO_LIKELIEST = (TWO / (SEVENTY + 1), (TWO + 1) / (SEVENTY + 1))
"""Of how often a set is refused, the range in which two is the most probable number of seventy (binomial mode)."""


def measured(plan: Plan, store: Store) -> tuple[Sheets, ...]:
    """What the rows say of each cell of data sheets."""
    found = []
    for number, cell in enumerate(plan.cells):
        if "decimals" not in cell.key:
            continue
        counts = {key[0]: n for key, n in store.counts("outcome", cell=number).items()}
        refused = counts.get(NOT_ACCEPTABLE, 0)
        otherwise = sum(n for outcome, n in counts.items() if outcome not in (*DETERMINED, NOT_ACCEPTABLE))
        key = cell.key
        found.append(Sheets(int(key["decimals"]), str(key["form"]), cell.samples, refused, otherwise))
    return tuple(found)


def table(sheets: tuple[Sheets, ...]) -> Table:
    """A row for each share and form."""
    head = ("decimals", "drawn", "sets", "refused", "of seventy", "failed otherwise", "sheets in 70 for two")
    rows = tuple(
        (
            f"{s.share / 10:g} %",
            FORMS[s.form],
            str(s.sets),
            percent(s.rate),
            with_interval(count(s.refused, s.sets, SEVENTY), 1),
            str(s.otherwise),
            needed(s),
        )
        for s in sheets
    )
    notes = (
        "refused: DATA NOT ACCEPTABLE.  sheets in 70 for two: how many of seventy sets have to be such sheets, the "
        "others never refused, so that two is the most probable number of refusals.",
        *INTERVALS,
    )
    return Table("decimals", "Data sheets with decimals, as listed", head, rows, notes)


def needed(sheets: Sheets) -> str:
    """How many of seventy: from two refusals' lower to its upper bound of probability; more than 70: not possible."""
    if not sheets.refused:
        return "-"
    low, high = (SEVENTY * bound / sheets.rate.value for bound in TWO_LIKELIEST)
    return f"{low:.1f} to {high:.1f}" if low <= SEVENTY else "-"


def likely_shares(rates: tuple[tuple[int, float], ...]) -> tuple[float, float] | None:
    """The shares of decimals, in thousandths, between which two refusals of seventy are the most probable number, if
    all seventy sets have that share: where the measured frequencies, joined by straight lines, first pass the bounds.

    rates: (share, frequency of refusal), shares rising.  None where the frequencies do not pass both.
    """
    found = []
    for bound in TWO_LIKELIEST:
        for (x, low), (y, high) in pairwise(rates):
            if low < bound <= high:
                found.append(x + (y - x) * (bound - low) / (high - low))
                break
    return (found[0], found[1]) if len(found) == len(TWO_LIKELIEST) else None


def chart(sheets: tuple[Sheets, ...]) -> Bars:
    """Refusals against the share of decimals."""
    series = tuple(
        Series(words, tuple((f"{s.share / 10:g}", s.rate) for s in sheets if s.form == form or not s.share))
        for form, words in FORMS.items()
    )
    return Bars(
        "decimals",
        "Data sheets refused",
        "decimals, % of coordinates",
        "DATA NOT ACCEPTABLE, share of the sets",
        series,
        percent=True,
        note=f"{sheets[0].sets:,} sets of 8 points each; bars: exact 95 % intervals",
    )


def words(sheets: tuple[Sheets, ...]) -> tuple[str, ...]:
    """Two sentences: what each way of drawing the decimals needs."""
    said = []
    for form, drawn in FORMS.items():
        of_form = [s for s in sheets if s.form == form or not s.share]
        shares = likely_shares(tuple((s.share, s.rate.value) for s in of_form))
        printed = of_form[-1]
        said.append(
            f"Decimals {drawn}: with the sheet's third of decimals {percent(printed.rate)} are refused"
            + f"; {needed(printed)} such sheets among seventy make two refusals the most probable number"
            * bool(printed.refused)
            + (
                f", or a share of decimals from {shares[0] / 10:.2f} to {shares[1] / 10:.2f} % in all seventy."
                if shares
                else "; from which share on in all seventy two are the most probable number is not to be told."
            )
        )
    return tuple(said)
