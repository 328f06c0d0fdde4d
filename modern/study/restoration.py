"""Measure the rules of restoration: damage programs at random, restore them by the rules, and count the errors.

The programs are the three listings, and those in a folder that the caller names.  :mod:`modern.edition.damage` damages
them at the rates at which the OCR damaged the listings (``as the OCR``).  At these rates few arithmetic signs are lost,
so few restored readings insert a sign.  Further copies therefore also lose a tenth of their signs and points (``signs
lost``).  :mod:`modern.edition.restorer` restores the copies in separate processes, which receive the damaged cards and
the printed results and cannot open the originals.
"""

import ast
import hashlib
import json
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, astuple, dataclass
from pathlib import Path
from queue import SimpleQueue
from random import Random
from typing import Any

from emulator.errors import FileError
from emulator.files import read_text, write_text
from emulator.language.statements import capitals
from emulator.progress import Progress
from modern.claims.full import definitions
from modern.edition import chapter6, programs
from modern.edition.damage import damaged, rates, with_lost_signs
from modern.edition.readings import attested, table
from modern.edition.readings import solid as _solid
from modern.edition.trials import Job, Trial
from modern.study.statistics import exact

Restorer = Callable[[Sequence[Job]], list[list[dict[str, Any]]]]
COPIES = "copies.jsonl"
LISTINGS = "the listings"
# The modules that damage and restore a copy.
RULES = ("damage", "readings", "card_readings", "trials", "restorer")
CLASSES = ("certain", "probable", "conjecture")
# The possible results for a card: its class of certainty, the ground, and whether the restored text is right.
KINDS = (
    *(("certain", ground, verdict) for ground in ("parse", "print") for verdict in ("right", "wrong")),
    *(("probable", ground, verdict) for ground in ("forced", "sibling") for verdict in ("right", "wrong")),
    ("conjecture", "attested", "right"),
    ("conjecture", "attested", "wrong"),
    ("abstained", "several readings", ""),
    ("abstained", "no exchange makes a statement", ""),
    ("abstained", "a statement of several cards", ""),
    ("unnoticed", "", ""),
)
# The number of copies that a round makes of the listings, and of the other programs, by the kind of damage.  A round
# makes more copies of the other programs because they are shorter and have more conjectures for the same work.
ROUND = {"as the OCR": (1, 120), "signs lost": (1, 50)}
LOST_SIGNS = 0.1
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
        LISTINGS,
        tuple(tuple(card.text for card in cards) for cards in decks),
        tuple(tuple(trials[name]) for name in programs.TEXTS),
    )


def others(folder: Path) -> Group:
    """Return the programs ``*.f`` of a folder with their ``.deck``, ``.operator`` and ``.output`` files.

    The name of an output, such as ``pi-2.output``, contains the numbers of the sense switches that are on.  Its lines
    begin with P (punched) or T (typed).  Raise FileError if the folder has no program.
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
                    tuple(line[1:] for line in read_text(str(output)).splitlines() if line.startswith("P")),
                    tuple(map(int, re.findall(r"-([1-4])", output.stem))),
                    operator,
                )
                for output in outputs
            )
        )
    cards = (tuple(capitals(read_text(str(path))).splitlines()) for path in paths)
    return Group("the other programs", tuple(cards), tuple(trials))


def damaged_copy(group: Group, damage: str, seed: int) -> list[Job]:
    """Return a damaged copy of each program.

    A comment card can lose its C.  The text of a comment is not damaged, because no rule restores it.
    """
    random = Random(f"{SEED} {group.name} {damage} {seed}")
    texts = [programs.text(name) for name in programs.TEXTS]
    comments = sum(
        line.text.strip().startswith("C  ") for name in programs.TEXTS for line in programs.committed(name).cards
    )
    lost = attested(row for text in texts for row in text.rows)["", "C"] / comments
    chances = with_lost_signs(LOST_SIGNS) if damage == "signs lost" else rates()
    jobs = []
    for cards, trials in zip(group.originals, group.trials, strict=True):
        copy = []
        for card in cards:
            if card.startswith("C"):
                copy.append(" " + card[1:] if random.random() < lost else card)
            else:
                copy.append("".join(damaged(card, chances, random)))
        jobs.append(Job(tuple(copy), trials))
    return jobs


@dataclass(frozen=True, slots=True)
class Copy:
    """A restored copy of a group of programs.

    damage: a key of ``ROUND``.  number: the number of the copy, from 0, among those of its group and damage.  damaged:
    the number of damaged cards.  counts: the number of cards with each result of ``KINDS``.
    """

    damage: str
    group: str
    number: int
    damaged: int
    counts: tuple[int, ...]

    @property
    def key(self) -> tuple[str, str, int]:
        return self.damage, self.group, self.number


def _copy(line: str) -> Copy:
    damage, group, number, damaged_cards, counts = json.loads(line)
    return Copy(damage, group, number, damaged_cards, tuple(counts))


def measure(folder: Path, groups: Sequence[Group], rounds: int, workers: int = 1) -> list[Copy]:
    """Damage and restore the copies of the rounds, and return them.

    The copies are kept in ``folder/copies.jsonl``, and copies already in this file are not restored again.  Raise
    FileError if the file holds copies of other programs or of other rules, or cannot be written.
    """
    head = json.dumps({"originals": _digest(groups), "rules": rules(), "kinds": KINDS})
    path = folder / COPIES
    tasks = [
        (damage, group, round_number * times + k)
        for round_number in range(rounds)
        for damage, copies in ROUND.items()
        for group, times in zip(groups, copies, strict=False)
        for k in range(times)
    ]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        lines = path.read_text(encoding="utf-8").split("\n") if path.exists() else [""]
        if lines[0] not in ("", head):
            raise FileError(f"{path}: holds copies of other programs or rules; choose another folder")
        # If a run was killed, its last line may be incomplete.  The line is then removed and its copy restored again.
        done = {copy.key: copy for copy in map(_copy, lines[1:-1])}
        remaining = [task for task in tasks if (task[0], task[1].name, task[2]) not in done]
        stored = (head, *(json.dumps(astuple(copy)) for copy in done.values()))
        write_text(str(path), "".join(line + "\n" for line in stored))
        with path.open("a", encoding="utf-8") as file:
            progress = Progress(len(tasks), len(tasks) - len(remaining))
            for copy in _restored_copies(remaining, workers):
                done[copy.key] = copy
                file.write(json.dumps(astuple(copy)) + "\n")
                file.flush()
                progress.add(1)
            progress.close()
    except (OSError, ValueError, TypeError) as error:
        raise FileError(f"{path}: {error}") from None
    return [done[damage, group.name, number] for damage, group, number in tasks]


def _digest(groups: Sequence[Group]) -> str:
    """Return a digest of the programs, their printed results, the rates of damage, and the table of confusables."""
    text = repr(
        (
            [(group.originals, group.trials) for group in groups],
            sorted(map(repr, rates().items())),
            LOST_SIGNS,
            sorted(map(repr, table())),
        )
    )
    return hashlib.sha256(text.encode()).hexdigest()


def rules() -> str:
    """Return a digest of the code that damages and restores a copy, without its docstrings."""
    code = [ast.unparse(node) for name in RULES for node in definitions(f"modern.edition.{name}").values()]
    own = definitions(__name__)
    code += [ast.unparse(own[name]) for name in ("damaged_copy", "restored_copy", "SEED")]
    return hashlib.sha256("".join(code).encode()).hexdigest()


def _restored_copies(tasks: Sequence[tuple[str, Group, int]], workers: int) -> Iterator[Copy]:
    with ExitStack() as stack:
        free: SimpleQueue[Restorer] = SimpleQueue()
        for _ in range(min(workers, len(tasks))):
            free.put(stack.enter_context(blind_restorer()))

        def restored(task: tuple[str, Group, int]) -> Copy:
            restore = free.get()
            try:
                return restored_copy(*task, restore)
            finally:
                free.put(restore)

        pool = stack.enter_context(ThreadPoolExecutor(workers))
        yield from pool.map(restored, tasks)


def restored_copy(damage: str, group: Group, number: int, restore: Restorer) -> Copy:
    """Damage and restore one copy of a group, and count the cards by result, as in ``KINDS``.

    If the restorer changes an undamaged card, this card counts as wrong.
    """
    jobs = damaged_copy(group, damage, number)
    kinds: Counter[tuple[str, str, str]] = Counter()
    damaged_cards = 0
    for job, original, emended in zip(jobs, group.originals, restore(jobs), strict=True):
        by_card = {entry["card"]: entry for entry in emended}
        for n, (card, truth) in enumerate(zip(job.cards, original, strict=True)):
            is_damaged = _solid(card) != _solid(truth)
            damaged_cards += is_damaged
            entry = by_card.get(n, {"certainty": "unnoticed", "ground": ""})
            if entry["certainty"] in CLASSES:
                verdict = "right" if _solid(entry["text"]) == _solid(truth) else "wrong"
                kinds[entry["certainty"], entry["ground"], verdict] += 1
            elif is_damaged:
                kinds[entry["certainty"], entry["ground"], ""] += 1
    return Copy(damage, group.name, number, damaged_cards, tuple(kinds[kind] for kind in KINDS))


@contextmanager
def blind_restorer() -> Iterator[Restorer]:
    """Start a process that cannot read the originals, and yield a function that restores damaged programs in it.

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


def summary(copies: Sequence[Copy]) -> list[tuple[str, ...]]:
    """Return a table with the number of emended cards and of wrong readings for each damage, certainty and ground.

    The last column counts the errors in copies of the listings.  For cards without a restored text, the table gives
    the number of damaged cards.  Intervals are exact 95 % intervals (Clopper and Pearson).
    """
    header = ("damage", "class", "ground", "cards", "wrong", "error rate", "95 % interval", "wrong in the listings")
    lines: list[tuple[str, ...]] = [header]
    for damage in ROUND:
        chosen = [copy for copy in copies if copy.damage == damage]
        total, in_listings = _total(chosen), _total([copy for copy in chosen if copy.group == LISTINGS])
        for cls in (*CLASSES, "abstained", "unnoticed"):
            grounds = dict.fromkeys(ground for name, ground, _ in KINDS if name == cls)
            for ground in (*grounds, "all") if len(grounds) > 1 else ("all",):
                kinds = [kind for kind in KINDS if kind[0] == cls and ground in (kind[1], "all")]
                cards = sum(total[kind] for kind in kinds)
                share: tuple[str, ...] = ("", "", "", "")
                if cls in CLASSES and cards:
                    rate = exact(wrong := _wrong(total, kinds), cards)
                    low, high = 100 * rate.low, 100 * rate.high
                    part = f"{_wrong(in_listings, kinds)} of {sum(in_listings[kind] for kind in kinds)}"
                    share = (str(wrong), f"{100 * rate.value:.2f} %", f"{low:.2f} to {high:.2f} %", part)
                lines.append((damage, cls, ground, str(cards), *share))
        lines.append((damage, "damaged", "all", str(sum(copy.damaged for copy in chosen)), "", "", "", ""))
    return lines


def _total(copies: Sequence[Copy]) -> Counter[tuple[str, str, str]]:
    total = Counter[tuple[str, str, str]]()
    for copy in copies:
        total.update(dict(zip(KINDS, copy.counts, strict=True)))
    return total


def _wrong(total: Mapping[tuple[str, str, str], int], kinds: Sequence[tuple[str, str, str]]) -> int:
    return sum(total[kind] for kind in kinds if kind[2] == "wrong")


def read_restoration(folder: Path) -> list[Copy]:
    """Return the copies that :func:`measure` wrote to a folder."""
    _, *lines = read_text(str(folder / COPIES)).splitlines()
    return [_copy(line) for line in lines]
