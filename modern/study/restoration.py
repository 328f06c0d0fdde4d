"""Measure the rules of restoration: damage programs blindly, restore them by the rules, and count the errors.

The three listings and programs of a folder are damaged by :mod:`modern.edition.damage` at the rates at which the OCR
damaged the listings.  :mod:`modern.edition.restorer` restores them in a separate process, which receives the damaged
cards and the printed results and cannot open the originals.  Each emended card is right or wrong.  The intervals are
Clopper and Pearson's (:mod:`modern.study.statistics`).
"""

import json
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from random import Random
from typing import Any

from emulator.errors import FileError
from emulator.files import read_text, write_text
from emulator.language.statements import capitals
from emulator.progress import Progress
from modern.edition import chapter6, programs
from modern.edition.damage import damaged, rates
from modern.edition.readings import attested
from modern.edition.trials import Job, Trial
from modern.study.statistics import exact

Restorer = Callable[[Sequence[Job]], list[list[dict[str, Any]]]]
FIELDS = ("group", "copy", "program", "card", "damaged", "class", "ground", "verdict")
CARDS = "cards.jsonl"
CLASSES = ("certain", "probable", "conjecture")
SEED = 1963


@dataclass(frozen=True, slots=True)
class Group:
    """Programs that are restored together: the name of the group, their cards, and their printed results."""

    name: str
    originals: tuple[tuple[str, ...], ...]
    trials: tuple[tuple[Trial, ...], ...]


def listings() -> Group:
    """Return the three listings with the printed examples.  Programs 2 and 3 read the printed intermediate decks."""
    trials: dict[str, list[Trial]] = {name: [] for name in programs.TEXTS}
    for example in chapter6.EXAMPLES:
        prints = [p for p in chapter6.prints(example) if p.device == "punch"]
        cards = tuple(card.text for card in chapter6.input_deck(example).cards)
        for p in sorted(prints, key=lambda p: p.program):
            final = p.program == prints[-1].program
            # The listing gives the printed results of program 1 in another order.
            trials[f"program{p.program}"].append(Trial(cards, tuple(p.lines), final=final, in_order=p.program > 1))
            cards = tuple(p.lines)
    decks = (programs.committed(name).cards for name in programs.TEXTS)
    return Group(
        "the listings",
        tuple(tuple(card.text for card in cards) for cards in decks),
        tuple(tuple(trials[name]) for name in programs.TEXTS),
    )


def others(folder: Path) -> Group:
    """Return the programs ``*.f`` of a folder with their ``.deck``, ``.operator`` and ``.output`` files.

    The name of an output has the sense switches that are on, and its lines begin with P (punched) or T (typed).
    Raise FileError if the folder has no program.
    """
    paths = sorted(folder.glob("*.f"))
    if not paths:
        raise FileError(f"{folder}: has no file whose name ends with .f")
    trials = []
    for path in paths:
        files = {ending: path.with_suffix(ending) for ending in (".deck", ".operator")}
        deck, operator = (read_text(str(file)) if file.exists() else "" for file in files.values())
        outputs = [p for p in sorted(folder.glob("*.output")) if p.stem.split("-")[0] == path.stem]
        trials.append(
            tuple(
                Trial(
                    tuple(deck.splitlines()),
                    tuple(line[1:] for line in read_text(str(output)).splitlines() if line[0] == "P"),
                    tuple(map(int, output.stem.split("-")[1:])),
                    operator,
                )
                for output in outputs
            )
        )
    cards = (tuple(capitals(read_text(str(path))).splitlines()) for path in paths)
    return Group("the other programs", tuple(cards), tuple(trials))


def damaged_copy(group: Group, seed: int) -> list[Job]:
    """Return a damaged copy of each program.  A comment can lose its C; its words, which no rule restores, stay."""
    random = Random(f"{SEED} {group.name} {seed}")
    texts = [programs.text(name) for name in programs.TEXTS]
    comments = sum(
        line.text.strip().startswith("C  ") for name in programs.TEXTS for line in programs.committed(name).cards
    )
    lost = attested(row for text in texts for row in text.rows)["", "C"] / comments
    jobs = []
    for cards, trials in zip(group.originals, group.trials, strict=True):
        copy = []
        for card in cards:
            if card.startswith("C"):
                copy.append(" " + card[1:] if random.random() < lost else card)
            else:
                copy.append("".join(damaged(card, rates(), random)))
        jobs.append(Job(tuple(copy), trials))
    return jobs


def measure(groups: Sequence[Group], copies: int) -> Iterator[dict[str, str]]:
    """Restore copies of each group and yield a row for each card that was damaged or emended."""
    tasks = [(group, seed) for seed in range(copies) for group in groups]
    progress = Progress(len(tasks), 0)
    with blind_restorer() as restore:
        for group, seed in tasks:
            yield from rows_of(group, seed, restore)
            progress.add(1)
    progress.close()


def rows_of(group: Group, seed: int, restore: Restorer) -> Iterator[dict[str, str]]:
    """Damage and restore one copy of a group, and yield a row for each card that was damaged or emended."""
    jobs = damaged_copy(group, seed)
    results = restore(jobs)
    for number, (job, original, emended) in enumerate(zip(jobs, group.originals, results, strict=True), 1):
        by_card = {entry["card"]: entry for entry in emended}
        for n, (card, truth) in enumerate(zip(job.cards, original, strict=True)):
            is_damaged = _solid(card) != _solid(truth)
            if not is_damaged and n not in by_card:
                continue
            entry = by_card.get(n, {"certainty": "unnoticed", "ground": "", "text": card})
            decided = entry["certainty"] in CLASSES
            right = _solid(entry["text"]) == _solid(truth) if decided else False
            verdict = ("right" if right else "wrong") if decided else ""
            yield {
                "group": group.name,
                "copy": str(seed),
                "program": str(number),
                "card": str(n + 1),
                "damaged": "yes" if is_damaged else "no",
                "class": str(entry["certainty"]),
                "ground": str(entry["ground"]),
                "verdict": verdict,
            }


def _solid(text: str) -> str:
    return "".join(text.split())


@contextmanager
def blind_restorer() -> Iterator[Restorer]:
    """Start a process that knows only what it is sent, and yield a function that restores damaged programs in it.

    The function raises FileError if the process fails.
    """
    uses = attested(row for name in programs.TEXTS for row in programs.text(name).rows)
    weights = {f"{witness}\t{lemma}": count for (witness, lemma), count in uses.items()}
    command = [sys.executable, "-m", "modern.edition.restorer"]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, encoding="utf-8"
    ) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        sent, received = process.stdin, process.stdout

        def restore(jobs: Sequence[Job]) -> list[list[dict[str, Any]]]:
            print(json.dumps({"jobs": [asdict(job) for job in jobs], "weights": weights}), file=sent, flush=True)
            answer = received.readline()
            if not answer:
                raise FileError("the process of the restorer ended; its message is above")
            result: list[list[dict[str, Any]]] = json.loads(answer)
            return result

        try:
            yield restore
        finally:
            sent.close()


def summary(rows: Sequence[Mapping[str, str]]) -> list[tuple[str, ...]]:
    """Return a table: for each class and ground the emended cards, the damaged ones, the errors, and their interval."""
    counted = Counter((row["class"], row["ground"], row["verdict"]) for row in rows)
    lines: list[tuple[str, ...]] = [
        ("class", "ground", "emended cards", "damaged cards", "wrong", "error rate", "95 % interval")
    ]
    for name in CLASSES:
        grounds = sorted({ground for cls, ground, _ in counted if cls == name})
        for ground in (*grounds, "all"):
            chosen = [row for row in rows if row["class"] == name and ground in (row["ground"], "all")]
            wrong = sum(row["verdict"] == "wrong" for row in chosen)
            if chosen:
                rate = exact(wrong, len(chosen))
                share = (f"{100 * rate.value:.2f} %", f"{100 * rate.low:.2f} to {100 * rate.high:.2f} %")
                damaged_cards = sum(row["damaged"] == "yes" for row in chosen)
                lines.append((name, ground, str(len(chosen)), str(damaged_cards), str(wrong), *share))
    for name in ("abstained", "unnoticed"):
        number = sum(row["class"] == name and row["damaged"] == "yes" for row in rows)
        lines.append((name, "all", "", str(number), "", "", ""))
    lines.append(("all", "all", "", str(sum(row["damaged"] == "yes" for row in rows)), "", "", ""))
    return lines


def write_restoration(folder: Path, rows: Sequence[Mapping[str, str]]) -> str:
    """Write ``cards.jsonl``, a line for each row, to a folder, and return the table as text."""
    folder.mkdir(parents=True, exist_ok=True)
    lines = [list(FIELDS), *([row[name] for name in FIELDS] for row in rows)]
    write_text(str(folder / CARDS), "".join(json.dumps(line) + "\n" for line in lines))
    table = summary(rows)
    widths = [max(map(len, column)) for column in zip(*table, strict=True)]
    return "".join(
        "  ".join(cell.ljust(w) for cell, w in zip(line, widths, strict=True)).rstrip() + "\n" for line in table
    )


def read_restoration(folder: Path) -> list[dict[str, str]]:
    """Return the rows that :func:`write_restoration` wrote to a folder."""
    head, *lines = map(json.loads, read_text(str(folder / CARDS)).splitlines())
    return [dict(zip(head, line, strict=True)) for line in lines]
