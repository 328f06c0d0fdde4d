"""Restore damaged programs by the written rules of the edition, without an editor.

The rules are those of ``fortran_src/README.md``.  A *reading* of a card is a text that the restorer may accept.  It may
differ from the damaged text only by *exchanges*: replacements of misread characters by the table of confusables.  An
exchange needs a ground:

``parse``   of the readings with the fewest exchanges, only this reading compiles: it has the form of a statement, the
            statements to which it refers exist, no other card has its statement number, and its names occur elsewhere
``print``   with this reading the program reproduces more lines of its printed results than with every other reading.  A
            card that compiles and to which no other rule applies is emended only if all results are then reproduced.
``forced``  only this reading equals another card (a sibling) in which names are exchanged.  A card that compiles is
            emended in this way only if it has at least 20 characters and the reading has at least two siblings.
            The equations of chapter 3 are symmetric in x, y and z; therefore their cards are siblings of each other.
``sibling`` the same as ``forced``, but the reading inserts a character

A reading with the ground ``parse`` or ``print`` is *certain*.  A reading that only siblings support is *probable*.  If
no ground decides, the reading whose exchange occurs most often in the apparatus is accepted as a *conjecture*.  If
several readings remain equal, the restorer abstains.

The restorer is a function of the damaged cards, the table, and the printed results.  If the module runs as a program
(``python -m modern.edition.restorer``), it reads the cards and results from standard input, and an audit hook rejects
every attempt to open a listing, a witness, an apparatus or a test.
"""

import json
import os
import re
import sys
from collections import Counter
from collections.abc import Mapping, Sequence, Set
from dataclasses import asdict, dataclass, field
from itertools import islice
from typing import Any, Literal

from modern.edition.card_readings import exchanges, fault, form, is_prose, labels, names, progress, statement
from modern.edition.readings import Pair, solid
from modern.edition.trials import Job, Trial, score, score_of

Certainty = Literal["certain", "probable", "conjecture", "abstained"]
# EXCHANGES is the greatest number of exchanges on a card, BEAM that of the texts to which another exchange is applied,
# and RUNS that of the readings that are run to find an error.
EXCHANGES, BEAM, RUNS = 3, 30, 30
# A continuation card.
_CONTINUATION = re.compile(r" {5}[^ 0]")
# A card with at least this number of characters and no siblings is suspicious if another reading of it has siblings.
ALONE = 20


@dataclass(frozen=True, slots=True)
class Restored:
    """A card that the restorer changed, or for which it abstained.

    ``card`` is the index of the card from 0, and ``text`` is its text without blanks.
    """

    card: int
    text: str
    certainty: Certainty
    ground: str


@dataclass(slots=True)
class _Program:
    """A program during its restoration.

    ``open`` has, for each undecided card, its possible readings with their exchanges.  ``done`` has the decided cards.
    """

    cards: list[str]
    trials: tuple[Trial, ...]
    open: dict[int, list[tuple[str, tuple[Pair, ...]]]] = field(default_factory=dict)
    done: dict[int, Restored] = field(default_factory=dict)


def restore(jobs: Sequence[Job], weights: Mapping[str, int]) -> list[list[Restored]]:
    """Restore programs together, because the cards of one program may be siblings of cards of another.

    Return, for each program, the cards that are changed or for which the restorer abstains.  ``weights`` has the number
    of places in which the apparatus uses each pair.  The key of a pair consists of its witness, a tab and its lemma.
    """
    every = [_Program([_solid(card) for card in job.cards], job.trials) for job in jobs]
    for program, job in zip(every, jobs, strict=True):
        for n, card in enumerate(program.cards):
            if fault(card) is None:
                continue
            if any(_CONTINUATION.match(line) for line in job.cards[n : n + 2]):
                program.done[n] = Restored(n, solid(card), "abstained", "a statement of several cards")
            elif is_prose(job.cards[n]):
                program.cards[n] = "C  " + card
                program.done[n] = Restored(n, "C" + solid(card), "certain", "parse")
            else:
                _by_form(program, n)
    for program in every:
        _by_compiler(program)
    for program in every:
        for n in list(program.open):
            program.cards[n] = _likeliest(program.open[n], weights)
    forms = Counter(form(card) for program in every for card in program.cards)
    for program in every:
        for n in list(program.open):
            _decide(program, n, forms, weights)
        _unlike_siblings(program, forms)
        _find_by_print(program, forms, weights)
    return [sorted(program.done.values(), key=lambda r: r.card) for program in every]


def _solid(card: str) -> str:
    """Return a card without blanks.  Comments and FORMATs, whose blanks may count, are returned unchanged."""
    return card if card.startswith("C  ") or "RMAT" in card.replace(" ", "") else "".join(card.split())


def _by_form(program: _Program, n: int) -> None:
    """Find the statements that can be made from a card with the fewest exchanges."""
    card = program.cards[n]
    frontier: list[tuple[int, str, tuple[Pair, ...]]] = [(progress(card), card, ())]
    readings: dict[str, tuple[Pair, ...]] = {}
    for _ in range(EXCHANGES):
        following: dict[str, tuple[int, tuple[Pair, ...]]] = {}
        for column, text, pairs in frontier:
            for new, pair in exchanges(text):
                column_of_fault = fault(new)
                if column_of_fault is None and statement(new)[0] is not None:
                    readings.setdefault(new, (*pairs, pair))
                elif column_of_fault is not None and (reached := progress(new)) >= column:
                    following.setdefault(new, (reached, (*pairs, pair)))
        if readings:
            break
        # Only texts whose first error is farther to the right are extended.
        best = sorted(((f, t, p) for t, (f, p) in following.items()), key=lambda x: (-x[0], x[1]))
        frontier = best[:BEAM]
    if readings:
        program.open[n] = list(readings.items())
    else:
        program.done[n] = Restored(n, card, "abstained", "no exchange makes a statement")


def _by_compiler(program: _Program) -> None:
    """Reduce the readings of each card to those with which the whole program compiles."""
    for n, readings in list(program.open.items()):
        others = [card for k, card in enumerate(program.cards) if k != n and k not in program.open]
        numbers = {labels(card)[0] for card in others}
        possible = {labels(text)[0] for k, rest in program.open.items() for text, _ in rest if k != n}
        known = {name for card in others for name in names(card)}
        referenced = {number for card in others for number in labels(card)[1]} - numbers
        allowed = [(text, pairs) for text, pairs in readings if _permits(text, numbers, known, possible)]
        # If the program allows no reading, another exchange is tried, such as the minus sign of IF(N9).
        allowed = allowed or [
            (new, (*pairs, pair))
            for text, pairs in readings
            for new, pair in exchanges(text)
            if len(pairs) < EXCHANGES and _permits(new, numbers, known, possible) and statement(new)[0] is not None
        ]
        # A number to which another card refers and that no card has belongs to this one.
        needed = [(text, pairs) for text, pairs in allowed if labels(text)[0] in referenced]
        readings = needed or allowed or readings
        if len({solid(text) for text, _ in readings}) == 1:
            _accept(program, n, readings[0][0], "certain", "parse")
        else:
            program.open[n] = readings


def _permits(text: str, numbers: Set[str], known: Set[str], possible: Set[str] = frozenset()) -> bool:
    """Return True if the statements to which a card refers exist, its number is unique, and its names are known."""
    label, references = labels(text)
    exists = all(number in numbers or number in possible or number == label for number in references)
    return exists and not (label and label in numbers) and names(text) <= known


def _accept(program: _Program, n: int, text: str, certainty: Certainty, ground: str) -> None:
    program.open.pop(n, None)
    program.cards[n] = text
    program.done[n] = Restored(n, solid(text), certainty, ground)


def _likeliest(readings: Sequence[tuple[str, tuple[Pair, ...]]], weights: Mapping[str, int]) -> str:
    return max(readings, key=lambda reading: (_weight(reading[1], weights), reading[0]))[0]


def _weight(pairs: Sequence[Pair], weights: Mapping[str, int]) -> int:
    return min((weights.get(f"{pair.witness}\t{pair.lemma}", 0) for pair in pairs), default=0)


def _decide(program: _Program, n: int, forms: Counter[str], weights: Mapping[str, int]) -> None:
    """Choose among readings that compile, first by printed results, then by siblings, then by frequent exchanges."""
    readings = program.open[n]
    present = program.cards[n]
    if len(readings) <= 12 and program.trials:
        matches = {text: _matching(program, n, text) for text, _ in readings}
        best = max(matches.values())
        winners = [text for text, count in matches.items() if count == best]
        if len(winners) == 1:
            # A result of 0 lines only shows that the other readings do not compile.
            _accept(program, n, winners[0], "certain", "print" if best else "parse")
            return
        readings = [(text, pairs) for text, pairs in readings if text in winners]
    own = Counter({form(present): 1})
    alike = [(text, pairs) for text, pairs in readings if forms[form(text)] > own[form(text)]]
    if len(alike) == 1:
        _accept(program, n, alike[0][0], *_by_sibling(alike[0][1]))
        return
    ranked = sorted(alike or readings, key=lambda reading: -_weight(reading[1], weights))
    first, second = (_weight(pairs, weights) for _, pairs in ranked[:2])
    if first > second:
        _accept(program, n, ranked[0][0], "conjecture", "attested")
    else:
        program.open.pop(n)
        program.done[n] = Restored(n, solid(present), "abstained", "several readings")


def _allows(program: _Program, n: int, text: str) -> bool:
    """Return True if a reading of a card compiles with the other cards."""
    others = [card for k, card in enumerate(program.cards) if k != n]
    known = {name for card in others for name in names(card)}
    return _permits(text, {labels(card)[0] for card in others}, known) and statement(text)[0] is not None


def _is_statement(program: _Program, n: int) -> bool:
    """Return True for a card that compiles and on which the rules did not abstain."""
    abstained = n in program.done and program.done[n].certainty == "abstained"
    return not abstained and statement(program.cards[n])[0] is not None


def _unlike_siblings(program: _Program, forms: Counter[str]) -> None:
    """Emend a card if one of its names occurs nowhere else, or if only another reading of the card has siblings."""
    uses = Counter(name for card in program.cards for name in names(card))
    for n, card in enumerate(program.cards):
        if "FORMAT" in card or not _is_statement(program, n):
            continue
        unknown = {name for name in names(card) if uses[name] == 1 and len(name) > 1}
        if not unknown and (forms[form(card)] > 1 or len(card) < ALONE):
            continue
        alike: dict[str, Pair] = {}
        readings: dict[str, Pair] = {}
        for text, pair in exchanges(card):
            has_siblings = forms[form(text)] > 1 and form(text) != form(card)
            if (unknown or has_siblings) and not names(text) & unknown and _allows(program, n, text):
                readings.setdefault(text, pair)
                if has_siblings:
                    alike.setdefault(text, pair)
        by_name = bool(unknown) and len(readings) == 1
        chosen = readings if by_name else alike
        if len(chosen) == 1:
            [(text, pair)] = chosen.items()
            before, after = _matching(program, n, card), _matching(program, n, text)
            if after > before:
                _accept(program, n, text, "certain", "print")
            elif after == before:
                _accept(program, n, text, *(("certain", "parse") if by_name else _by_sibling((pair,))))


def _by_sibling(pairs: Sequence[Pair]) -> tuple[Certainty, str]:
    """Return the certainty and the ground of a reading that only siblings support."""
    return "probable", "forced" if all(pair.witness for pair in pairs) else "sibling"


def _matching(program: _Program, n: int, text: str) -> int:
    """Return the score (:func:`modern.edition.trials.score`) of the program with ``text`` as card ``n``."""
    return score(_with(program, n, text), program.trials)


def _find_by_print(program: _Program, forms: Counter[str], weights: Mapping[str, int]) -> None:
    """Find exchanges with which a program reproduces its printed results.

    The exchanges are kept only if the program reproduces all printed results in the end.
    """
    cards, done = list(program.cards), dict(program.done)
    while True:
        lines = tuple(program.cards)
        # The shortest result that is not reproduced is tried, because its runs take the least time.
        failing = [trial for trial in program.trials if 0 <= score_of(lines, trial) < 1000]
        if not failing:
            break
        trial = min(failing, key=lambda trial: len(trial.printed))
        candidates: dict[tuple[int, str], Pair] = {}
        for n, card in enumerate(lines):
            for text, pair in exchanges(card) if _is_statement(program, n) else ():
                candidates.setdefault((n, text), pair)
        readings = [
            (bool(forms[form(text)]), weight, n, text)
            for (n, text), pair in candidates.items()
            if (weight := _weight((pair,), weights)) > 1
        ]
        readings.sort(key=lambda reading: reading[:2], reverse=True)
        compiling = islice(((n, text) for *_, n, text in readings if _allows(program, n, text)), RUNS)
        counts = {(n, text): score_of(_with(program, n, text), trial) for n, text in compiling}
        best = max(counts.values(), default=0)
        winners = [key for key, count in counts.items() if count == best]
        # Errors on different cards can improve the result equally; two readings of one card leave it undecided.
        if best <= score_of(lines, trial) or len({n for n, _ in winners}) < len(winners):
            break
        if _matching(program, *winners[0]) <= score(lines, program.trials):
            break
        _accept(program, *winners[0], "certain", "print")
    if any(score_of(tuple(program.cards), trial) < 1000 for trial in program.trials):
        program.cards, program.done = cards, done


def _with(program: _Program, n: int, text: str) -> tuple[str, ...]:
    return (*program.cards[:n], text, *program.cards[n + 1 :])


_FORBIDDEN = re.compile(r"\.(?:f|txt|deck|output|punch|csv|md|jsonl?)$|program\d\.toml|SOURCES\.toml|tests?[/\\]")


def seal() -> None:
    """Prevent this process from opening a listing, witness, apparatus or test, and from running programs."""

    def watch(event: str, arguments: tuple[Any, ...]) -> None:
        if event in ("subprocess.Popen", "os.system", "os.exec", "os.posix_spawn", "socket.connect"):
            raise PermissionError(f"the restorer may not use {event}")
        if event == "open" and isinstance(arguments[0], (str, bytes, os.PathLike)):
            path = os.fsdecode(arguments[0])
            if _FORBIDDEN.search(path):
                raise PermissionError(f"the restorer may not read {os.path.basename(path)}")

    sys.addaudithook(watch)


def main() -> None:
    seal()
    for line in sys.stdin:
        data = json.loads(line)
        jobs = [Job(tuple(raw["cards"]), tuple(map(_trial, raw["trials"]))) for raw in data["jobs"]]
        print(json.dumps([[asdict(card) for card in cards] for cards in restore(jobs, data["weights"])]), flush=True)


def _trial(raw: dict[str, Any]) -> Trial:
    values: dict[str, Any] = {name: tuple(value) if isinstance(value, list) else value for name, value in raw.items()}
    return Trial(**values)


if __name__ == "__main__":
    main()
