"""Write the results of the weight of evidence: a report, a table of cards and the undetected variants."""

import csv
import io
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path

from emulator.files import write_text
from modern.edition import programs
from modern.edition.variants import Variant
from modern.edition.weight import EQUATIONS, NOTICED, alike, by_card, equation_of, ordered, silent

# The checks, other than the compiler, that confirm a reading.
CONFIRMING = ("print", "machine", "equation", "sibling")


def write_weight(folder: Path, answers: Mapping[str, str]) -> str:
    """Write ``report.md``, ``cards.csv`` and ``silent.csv`` to a folder, and return the text of the report."""
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
    """Yield a row for each card: its statement, its variants by check, its formula and the number of similar cards."""
    yield ("program", "card", "place", "statement", *NOTICED, "no change", "formula", "alike")
    for variant, count in by_card(answers):
        numbers = (str(count[name]) for name in (*NOTICED, "no change"))
        formula = equation_of(variant.program, variant.place)
        card = (variant.program, str(variant.card), variant.place, variant.was)
        yield (*card, *numbers, formula, str(alike(variant.was)))


def unvouched(answers: Mapping[str, str]) -> list[Variant]:
    """Return a variant of each card that has two or more undetected variants and that only the compiler confirms."""
    return [
        variant
        for variant, count in by_card(answers)
        if count["nothing"] > 1 and not any(count[name] for name in CONFIRMING)
    ]


def report(answers: Mapping[str, str]) -> str:
    everything = ordered()
    judged = [variant for variant in everything if variant.key in answers]
    counted = [variant for variant in judged if answers[variant.key] != "no change"]
    compiling = [variant for variant in counted if answers[variant.key] != "compiler"]
    undetected = [variant for variant in compiling if answers[variant.key] == "nothing"]
    detected = len(compiling) - len(undetected)
    sample = " They are a random sample, ordered by SHA-256." if len(judged) < len(everything) else ""
    lines = [
        "# The weight of evidence",
        "",
        "How sure is each character of the listings? To find out, each token of the three listings was altered in",
        "every way in which an OCR or a typist might have altered it, one at a time. Each variant was compiled and",
        "run on the examples of chapter 6 and on the decks of the second restoration. If no check distinguishes a",
        "reading from its variants, the reading rests on the witness alone.",
        "",
        f"{len(judged):,} of {len(everything):,} variants were judged.{sample}",
        f"{len(judged) - len(counted):,} of them have the object code and the storage map of the listing and are not",
        f"counted. The compiler rejects {len(counted) - len(compiling):,} of the other {len(counted):,}.",
        f"{len(compiling):,} variants compile: a check detects {detected:,} of them"
        f" ({_share(detected, len(compiling))}),",
        f"and no check detects {len(undetected):,} ({_share(len(undetected), len(compiling))}).",
        "",
        "| first check that detects the variant | " + " | ".join(programs.TEXTS) + " | all |",
        "|---|" + "---:|" * (len(programs.TEXTS) + 1),
    ]
    for name in NOTICED:
        per = Counter(v.program for v in counted if answers[v.key] == name)
        lines.append(f"| {name} | " + " | ".join(str(per[p]) for p in programs.TEXTS) + f" | {per.total()} |")
    lines += ["", "| altered token | " + " | ".join(NOTICED) + " |", "|---|" + "---:|" * len(NOTICED)]
    for how in dict.fromkeys(sorted(v.how for v in counted)):
        by_check = Counter(answers[v.key] for v in counted if v.how == how)
        lines.append(f"| {how} | " + " | ".join(str(by_check[name]) for name in NOTICED) + " |")
    lines += ["", *_how_noticed(), "## Cards that no check confirms", ""]
    lines += [
        "Two or more variants of these cards compile, and print, machine, equation and sibling detect none of them:",
        "",
    ]
    unconfirmed = unvouched(answers)
    for name in programs.TEXTS:
        cards = [f"{v.place} `{v.was.strip()}`" for v in unconfirmed if v.program == name]
        lines.append(f"- {name} ({len(cards)}): " + ("; ".join(cards) if cards else "none"))
    lines += [
        "",
        "`cards.csv` lists every card with the number of its variants that each check detects. `silent.csv` lists the",
        f"{len(undetected):,} variants that no check detects.",
    ]
    return "\n".join(lines) + "\n"


_HOW = """\
## The checks

A variant is counted under the first of these checks that detects it.

- `compiler`: the deck no longer compiles. A variant with the object code and the storage map of the listing is not a
  different reading and is not counted.
- `print`: a printed example of chapter 6 is no longer reproduced. Program 1 runs in the state that produced the
  examples if the card is in it. Otherwise the listing runs, and its cards must agree with the print up to their order.
- `machine`: a deck of the second restoration gives a different result.
- `equation`: all runs are the same, and the card is a floating-point assignment of the table below, which computes a
  formula of chapter 3. The table was compiled by reading chapter and listing side by side. A reader who knows the
  formula sees that the variant is wrong. The column `formula` of `cards.csv` names the formula of a card.
- `sibling`: all runs are the same, the card computes no formula, and at least two other cards of the three listings
  have its form, while no card has the form of the variant. The form of a statement has each name and number replaced
  by the order of its first occurrence: `X(K)=X(K+1)` and `Y(J)=Y(J+1)` have the same form, `X(K)=X(J+1)` has another.
  The column `alike` of `cards.csv` counts the other cards with the same form.

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


def _share(part: int, total: int) -> str:
    return f"{100 * part / total:.1f} %" if total else "none"
