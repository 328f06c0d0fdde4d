"""The figures of fortran_src/README.md, counted again."""

import pytest

from emulator.language.cards import read_deck
from emulator.language.objectcode import Program
from emulator.machine.result import Options
from modern.edition import chapter6, programs
from modern.thesis.batch import run_hulls
from modern.thesis.job import HullRun
from tests.support.paths import MACHINE_RUNS

RUNS = MACHINE_RUNS
README = " ".join(programs.sources().joinpath("README.md").read_text(encoding="utf-8").split())


@pytest.fixture(scope="module")
def never_run() -> dict[str, list[tuple[int, str]]]:
    """Return the statements of the three listings, except END, that no checked deck executes."""
    ran: dict[str, set[int]] = {name: set() for name in programs.TEXTS}
    data = [chapter6.input_deck(example) for example in chapter6.EXAMPLES]
    data += [read_deck(str(folder / "deck.cards")) for folder in sorted(RUNS.iterdir()) if folder.is_dir()]
    for first in ("program1", "program1_examples"):
        for hull_run in run_hulls(data, programs.program, Options(limit=200_000), first):
            assert isinstance(hull_run, HullRun)
            for step in hull_run.steps:
                if step.name in ran:
                    counted = zip(step.program.counters, step.result.counts, strict=True)
                    ran[step.name] |= {counter.statement for counter, n in counted if n}
    listed: dict[str, Program] = {name: programs.program(name) for name in programs.TEXTS}
    return {
        name: [(s.label, s.text) for i, s in enumerate(p.statements) if i not in ran[name] and s.text != "END"]
        for name, p in listed.items()
    }


def test_unexecuted_statements_and_characters_are_counted(never_run: dict[str, list[tuple[int, str]]]) -> None:
    missed = [text for statements in never_run.values() for _, text in statements]
    total = sum(len(programs.program(name).statements) for name in programs.TEXTS)
    characters = sum(len("".join(text.split())) for text in missed)
    assert f"executes {len(missed)} of the {total} statements ({characters} characters)" in README
    for name, statements in never_run.items():
        labels = ", ".join(str(label) for label, _ in statements if label)
        assert f"{name[:7]} {name[7]}: {labels}" in README, labels
    count = sum(len("".join(line.text.split())) for name in programs.TEXTS for line in programs.text(name).witness)
    assert f"The witness has {count:,} characters that are not blank" in README
