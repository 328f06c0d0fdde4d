"""Write the results of the weight of evidence: a report, a table of all cards, and a table of undetected variants."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from importlib.resources import files
from pathlib import Path

from emulator.files import write_text
from modern.edition.programs import TEXTS
from modern.edition.variants import Variant
from modern.edition.weight import EQUATIONS, NOTICED, alike, by_card, equation_of, ordered, silent
from modern.formats.columns import csv_text

# The checks, other than the compiler, that confirm a reading.
CONFIRMING = ("print", "machine", "equation", "sibling")


def write_weight(folder: Path, answers: Mapping[str, str]) -> str:
    """Write ``report.md``, ``cards.csv`` and ``silent.csv`` to a folder, and return the text of the report.

    ``answers`` maps the key of each judged variant to the first check that detects it, ``nothing`` or ``no change``.
    """
    text = report(answers)
    write_text(str(folder / "report.md"), text)
    write_text(str(folder / "cards.csv"), csv_text(cards_table(answers)))
    rows = ((v.program, str(v.card), v.place, v.how, v.was, v.reads) for v in silent(answers))
    write_text(str(folder / "silent.csv"), csv_text([("program", "card", "place", "how", "was", "reads"), *rows]))
    return text


def cards_table(answers: Mapping[str, str]) -> Iterator[tuple[str, ...]]:
    """Yield the header of the table of cards, then a row for each card.

    A row has the statement, the number of its variants that each check detects, the formula that the statement
    computes, and the number of other cards with statements of the same form.
    """
    yield ("program", "card", "place", "statement", *NOTICED, "no change", "formula", "alike")
    for variant, count in by_card(answers):
        numbers = (str(count[name]) for name in (*NOTICED, "no change"))
        formula = equation_of(variant.program, variant.place)
        card = (variant.program, str(variant.card), variant.place, variant.was)
        yield (*card, *numbers, formula, str(alike(variant.was)))


def unvouched(answers: Mapping[str, str]) -> list[Variant]:
    """Return one variant of each card that no check confirms.

    Such a card has two or more undetected variants and no variant that a check of ``CONFIRMING`` detects.
    """
    return [
        variant
        for variant, count in by_card(answers)
        if count["nothing"] > 1 and not any(count[name] for name in CONFIRMING)
    ]


def report(answers: Mapping[str, str]) -> str:
    """Return the report: the template ``weight.md``, filled with the number of variants that each check detects."""
    everything = ordered()
    judged = [variant for variant in everything if variant.key in answers]
    counted = [variant for variant in judged if answers[variant.key] != "no change"]
    answer = Counter(answers[variant.key] for variant in counted)
    compiling, undetected = len(counted) - answer["compiler"], answer["nothing"]
    unconfirmed = unvouched(answers)
    cards_of = {name: [f"{v.place} `{v.was.strip()}`" for v in unconfirmed if v.program == name] for name in TEXTS}
    formulas: dict[str, list[str]] = {}
    for name, first, last, formula in EQUATIONS:
        formulas.setdefault(formula, []).append(f"{name} {first}" + (f" to {last}" if last != first else ""))
    per_program = {check: Counter(v.program for v in counted if answers[v.key] == check) for check in NOTICED}
    per_token: dict[str, Counter[str]] = {how: Counter() for how in sorted({v.how for v in counted})}
    for variant in counted:
        per_token[variant.how][answers[variant.key]] += 1
    return (
        files("modern.edition")
        .joinpath("weight.md")
        .read_text(encoding="utf-8")
        .format(
            judged=len(judged),
            variants=len(everything),
            sample=" They are a random sample, ordered by SHA-256." if len(judged) < len(everything) else "",
            unchanged=len(judged) - len(counted),
            rejected=answer["compiler"],
            counted=len(counted),
            compiling=compiling,
            detected=compiling - undetected,
            detected_share=_share(compiling - undetected, compiling),
            undetected=undetected,
            undetected_share=_share(undetected, compiling),
            programs=" | ".join(TEXTS),
            checks=" | ".join(NOTICED),
            by_program=_rows(
                {check: [*(per[name] for name in TEXTS), per.total()] for check, per in per_program.items()}
            ),
            by_token=_rows({how: [per[check] for check in NOTICED] for how, per in per_token.items()}),
            formulas="\n".join(f"| {formula} | {'; '.join(spans)} |" for formula, spans in formulas.items()),
            unconfirmed="\n".join(f"- {name} ({len(c)}): {'; '.join(c) or 'none'}" for name, c in cards_of.items()),
        )
    )


def _rows(counts: Mapping[str, Sequence[int]]) -> str:
    """Return the rows of a Markdown table of counts, preceded by the line that separates them from the table's head."""
    width = len(next(iter(counts.values()), ()))
    rows = (f"| {name} | {' | '.join(map(str, numbers))} |" for name, numbers in counts.items())
    return "\n".join(["|---|" + "---:|" * width, *rows])


def _share(part: int, total: int) -> str:
    return f"{100 * part / total:.1f} %" if total else "none"
