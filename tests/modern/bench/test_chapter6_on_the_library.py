"""The committed results of chapter 6 on IBM's library: complete, up to date, and quoted correctly."""

import csv
import re
import tomllib
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest

from emulator.numbers import numbers
from modern.bench.ibm1962.chapter6 import FOLDER, NAMES, program_digest, verdicts
from modern.bench.ibm1962.objectdecks import COLUMNS, OPTIONS, library
from modern.bench.ibm1962.simulator import Unavailable
from modern.edition import programs
from modern.edition.chapter6 import EXAMPLES, input_deck, prints
from modern.thesis.job import run_hull

PAGE = Path("docs/explanation/library-of-1962.md")


def rows(name: str) -> list[dict[str, str]]:
    return list(csv.DictReader((Path(FOLDER) / name).read_text(encoding="ascii").splitlines()))


def test_the_results_cover_every_card_and_row_with_the_present_programs() -> None:
    printed = [p for example in EXAMPLES for p in prints(example) if p.device == "punch"]
    cards = [(p.example, p.program, n) for p in printed for n in range(1, len(p.lines) + 1)]
    assert [(int(r["example"]), int(r["program"]), int(r["card"])) for r in rows("chapter6.csv")] == cards
    assert len(cards) == 312
    means = tomllib.loads((Path(FOLDER) / "means.toml").read_text(encoding="ascii"))
    assert means["programs"] == {name: program_digest(name) for name in NAMES}
    entries = [(name, programs.built_in(name)) for name in NAMES]
    expected = [(n, r.id) for n, e in entries for r in programs.text(e.text).rows if r.layer in e.layers]
    assert [(row["program"], row["row"]) for row in rows("apparatus.csv")] == expected


def test_the_page_quotes_the_counts() -> None:
    text = PAGE.read_text(encoding="utf-8")
    same = Counter((row["example"], row["program"]) for row in rows("chapter6.csv") if row["verdict"] == "same")
    assert sorted(map(int, re.findall(r"(\d+) of \d+(?: cards)? \|", text))) == sorted(same.values())
    answers = Counter(row["answer"] for row in rows("apparatus.csv"))
    totals = list(map(int, re.findall(r"^\| the .* \| \d+ \| \d+ \| \d+ \| (\d+) \|$", text, re.MULTILINE)))
    assert totals == [answers[answer] for answer in ("compiler", "library", "no change", "nothing")]


@pytest.mark.parametrize("arithmetic", ["ibm1962", "truncating1962"])
def test_the_emulator_punches_the_printed_cards_by_the_rules_of_the_library(arithmetic: str) -> None:
    compared = 0
    for example in EXAMPLES:
        options = replace(OPTIONS, numbers=numbers(arithmetic))
        steps = run_hull(input_deck(example), programs.program, options, NAMES[0]).steps
        for step, printed in zip(steps, (p for p in prints(example) if p.device == "punch"), strict=True):
            assert [card[:COLUMNS].rstrip() for card in step.result.punched] == [
                line.rstrip() for line in printed.lines
            ]
            compared += len(printed.lines)
    assert compared == 312


def test_the_library_repeats_an_example() -> None:
    """Example 4 alone: the whole experiment takes minutes (``python -m modern.bench.ibm1962 chapter6``)."""
    try:
        library()
    except Unavailable as reason:
        pytest.skip(str(reason))
    assert {row.verdict for row in verdicts((4,))} == {"same"}
