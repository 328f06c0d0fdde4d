"""What the weight of evidence came to: a report, a table of cards and the readings nothing notices."""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path

from emulator.files import write_text
from modern.edition import programs
from modern.edition.variants import Variant
from modern.edition.weight import EQUATIONS, NOTICED, alike, by_card, equation_of, ordered, silent

SEEN = ("print", "machine", "equation", "sibling")
"""What vouches for a reading, besides that it compiles."""


def write_weight(folder: Path, answers: Mapping[str, str]) -> str:
    """Write ``report.md``, ``cards.csv`` and ``silent.csv`` in a folder; the report's text."""
    text = report(answers)
    write_text(str(folder / "report.md"), text)
    write_text(str(folder / "cards.csv"), _table(cards_table(answers)))
    rows = ((v.program, str(v.card), v.place, v.how, v.was, v.reads) for v in silent(answers))
    write_text(str(folder / "silent.csv"), _table([("program", "card", "place", "how", "was", "reads"), *rows]))
    return text


def _table(rows: Iterator[tuple[str, ...]] | list[tuple[str, ...]]) -> str:
    file = io.StringIO()
    csv.writer(file, lineterminator="\n").writerows(rows)
    return file.getvalue()


def cards_table(answers: Mapping[str, str]) -> Iterator[tuple[str, ...]]:
    """A row a card: place and words, what notices how many of its variants, its formula, how many cards are alike."""
    yield ("program", "card", "place", "statement", *NOTICED, "no change", "formula", "alike")
    for one, count in by_card(answers):
        numbers = (str(count[name]) for name in (*NOTICED, "no change"))
        formula = equation_of(one.program, one.place)
        yield (one.program, str(one.card), one.place, one.was, *numbers, formula, str(alike(one.was)))


def unvouched(answers: Mapping[str, str]) -> list[Variant]:
    """A variant of each card that only the compiler vouches for: two readings or more, and nothing notices any."""
    return [one for one, count in by_card(answers) if count["nothing"] > 1 and not any(count[name] for name in SEEN)]


def report(answers: Mapping[str, str]) -> str:
    """The report in Markdown."""
    everything = ordered()
    judged = [variant for variant in everything if variant.key in answers]
    counted = [variant for variant in judged if answers[variant.key] != "no change"]
    compiling = [variant for variant in counted if answers[variant.key] != "compiler"]
    unseen = [variant for variant in compiling if answers[variant.key] == "nothing"]
    lines = [
        "# The weight of evidence",
        "",
        "Each token of the three listings is altered in every way an OCR or a typist might have, one at a time; each",
        "variant compiled and run over the examples of chapter 6 and the decks of the second restoration.",
        "",
        f"{len(judged):,} of {len(everything):,} variants were judged"
        + (
            ", in an order of which any part is a fair sample (SHA-256 of the variant)."
            if len(judged) < len(everything)
            else "."
        ),
        f"{len(judged) - len(counted):,} have the object code and the storage map of the listing, and are not counted.",
        f"Of the other {len(counted):,} the compiler refuses {len(counted) - len(compiling):,};",
        f"of the {len(compiling):,} that compile",
        f"{len(compiling) - len(unseen):,} ({_share(len(compiling) - len(unseen), len(compiling))}) are noticed and",
        f"{len(unseen):,} ({_share(len(unseen), len(compiling))}) by nothing.",
        "",
        "| what notices first | " + " | ".join(programs.TEXTS) + " | all |",
        "|---|" + "---:|" * (len(programs.TEXTS) + 1),
    ]
    for name in NOTICED:
        per = Counter(v.program for v in counted if answers[v.key] == name)
        lines.append(f"| {name} | " + " | ".join(str(per[p]) for p in programs.TEXTS) + f" | {per.total()} |")
    lines += ["", "| what is altered | " + " | ".join(NOTICED) + " |", "|---|" + "---:|" * len(NOTICED)]
    for how in dict.fromkeys(sorted(v.how for v in counted)):
        seen = Counter(answers[v.key] for v in counted if v.how == how)
        lines.append(f"| {how} | " + " | ".join(str(seen[name]) for name in NOTICED) + " |")
    lines += ["", *_how_noticed(), "## Cards nothing vouches for", ""]
    lines += [
        "Two or more of their variants judged compile, and none is noticed by print, machine, equation or sibling:",
        "",
    ]
    found = unvouched(answers)
    for name in programs.TEXTS:
        cards = [f"{v.place} `{v.was.strip()}`" for v in found if v.program == name]
        lines.append(f"- {name} ({len(cards)}): " + ("; ".join(cards) if cards else "none"))
    lines += [
        "",
        "`cards.csv` has every card with what notices how many of its variants, `silent.csv` every reading that",
    ]
    lines += [f"nothing notices ({len(unseen):,})."]
    return "\n".join(lines) + "\n"


_HOW = """\
## How each of them notices

In this order; what notices a variant first is counted.

- `compiler`: the deck no longer compiles. A variant with the object code and the storage map of the listing is no
  reading of its own, and is not counted.
- `print`: a printed example of chapter 6 comes out otherwise. Of program 1 the state that made the examples is run,
  which has the same card; where it has not, the listing, whose cards agree with the print up to their order.
- `machine`: a deck of the second restoration comes out otherwise.
- `equation`: every run is the same, and the card is an assignment of floating-point numbers among those below, which
  compute a formula of chapter 3. They were found by reading chapter and listing side by side; who knows the formula
  sees that another reading is not it. `formula` in `cards.csv` names the formula of a card.
- `sibling`: every run is the same, no formula is computed, and two other cards or more of the three listings have the
  card's form, while the variant has the form of none. The form is the statement with its names and numbers replaced
  by the order in which they first stand in it: `X(K)=X(K+1)` and `Y(J)=Y(J+1)` have one form, `X(K)=X(J+1)` has
  another. `alike` in `cards.csv` is how many other cards have a card's form.

| formula of chapter 3 | cards |
|---|---|"""


def _how_noticed() -> Iterator[str]:
    yield from _HOW.splitlines()
    for formula in dict.fromkeys(formula for *_, formula in EQUATIONS):
        spans = [
            f"{name} {first}" + (f" to {last}" if last != first else "")
            for name, first, last, of in EQUATIONS
            if of == formula
        ]
        yield f"| {formula} | {'; '.join(spans)} |"
    yield ""


def _share(some: int, of: int) -> str:
    return f"{100 * some / of:.1f} %" if of else "none"
