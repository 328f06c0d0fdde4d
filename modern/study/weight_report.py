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
from modern.study.weight import NOTICED, by_card, equation_of, ordered, silent

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
    """A row a card: its place and words, what notices how many of its variants, and its formula of chapter 3."""
    yield ("program", "card", "place", "statement", *NOTICED, "no change", "formula")
    for one, count in by_card(answers):
        numbers = (str(count[name]) for name in (*NOTICED, "no change"))
        yield (one.program, str(one.card), one.place, one.was, *numbers, equation_of(one.program, one.place))


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
        f"{len(judged) - len(counted):,} change nothing in the object code and are not counted. Of the other",
        f"{len(counted):,} the compiler refuses {len(counted) - len(compiling):,};",
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
    lines += [
        "",
        "`equation` and `sibling` are comparisons by eye, not runs: the card computes a formula of chapter 3, or has",
    ]
    lines += ["the form of two others at least.", "", "## Cards nothing vouches for", ""]
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


def _share(some: int, of: int) -> str:
    return f"{100 * some / of:.1f} %" if of else "none"
