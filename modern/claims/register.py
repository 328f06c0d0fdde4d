"""A verdict on every statement of the five documents: what a row says, and what is found when it is computed.

``transcripts/statements`` has a file for each document, a row a statement.  A verdict is not taken from the row: a
*claim* is a function of this room that computes one; a *result* is one that ``reproduce`` judges anyway; a *test* is
named where the check takes too long to be made each time (tests/modern/claims/test_register.py sees that it is
there).  Only what cannot be tested has a reason and nothing else.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Any, Final, Literal, get_args

from modern.claims.published import CANNOT, CORRECTED, EXPLAINED, PAPERS, Finding, findings
from modern.edition.chapter6 import EXAMPLES
from modern.edition.reproduce import DIFFERENT, EXACT, Report, reproduce, summary

HOLDS: Final = "holds"
CONDITION: Final = "holds with a condition"
FAILS: Final = "does not hold"
UNTESTABLE: Final = "not testable"
Verdict = Literal["holds", "holds with a condition", "does not hold", "not testable"]
VERDICTS: tuple[Verdict, ...] = (HOLDS, CONDITION, FAILS, UNTESTABLE)
_FROM_BEST: tuple[Verdict, ...] = (HOLDS, CONDITION, UNTESTABLE, FAILS)

THESIS: Final = "thesis"
DOCUMENTS = (THESIS, "appel-will", "kovalevsky-schulz", "nakamae-nishita", "yau-srihari")
"""The five documents by their names on the command line."""
MOST_WORDS = 8
_FIELDS = {"id", "page", "kind", "words", "says", "verdict", "why", "claim", "result", "test", "file", "run", "part"}


class StatementError(ValueError):
    """A row that cannot be read; one line naming document and row."""


@dataclass(frozen=True, slots=True)
class Seen:
    """What a claim function found: a verdict, and what it saw in words."""

    verdict: Verdict
    words: str


def seen(holds: bool, words: str) -> Seen:
    """What a claim that holds or not has found."""
    return Seen(HOLDS if holds else FAILS, words)


@dataclass(frozen=True, slots=True)
class Statement:
    """A statement of a document.

    ``page``: the page, or the section where our text has no page numbers; ``kind``: theorem, lemma, definition,
    equation, figure, table, complexity, property, step, claim, slip, ...; ``words``: where it stands, at most eight
    words of our text of the document; ``says``: what it says, in ours; ``why``: the condition, or why it fails or is
    not tested.  ``claim``: ``module.function arguments`` of this room; ``results``: ids of what ``reproduce`` judges;
    ``tests``: test functions, ``file::name``.  ``file``: the smallest counterexample known, in
    ``transcripts/counterexamples``; ``run``: how a reader runs it.  ``part``: the theorem it belongs to, where the
    worked examples of chapter 4 are concerned.
    """

    document: str
    id: str
    page: str
    kind: str
    words: str
    says: str
    verdict: Verdict
    why: str = ""
    claim: str = ""
    results: tuple[str, ...] = ()
    tests: tuple[str, ...] = ()
    file: str = ""
    run: str = ""
    part: str = ""


@dataclass(frozen=True, slots=True)
class Judged:
    """A statement and what was found: ``found`` is None where only a test or a reason stands for the verdict."""

    statement: Statement
    found: Verdict | None
    seen: str

    @property
    def agrees(self) -> bool:
        """Whether what was found is the verdict of the row."""
        return self.found in (None, self.statement.verdict)


Results = Callable[[str, str], Verdict | None]
"""The verdict on a result by document and id, None for an id that is not one."""


def statements_folder() -> Traversable:
    """The data folder, in a checkout or an installed wheel."""
    return files("transcripts").joinpath("statements")


def counterexample(name: str) -> str:
    """The text of a file of ``transcripts/counterexamples``."""
    return files("transcripts").joinpath("counterexamples", name).read_text(encoding="utf-8")


@cache
def statements_of(document: str) -> tuple[Statement, ...]:
    """The rows of a document in its order.  Raises StatementError."""
    text = statements_folder().joinpath(f"{document}.toml").read_text(encoding="utf-8")
    return tuple(read_rows(document, text))


def read_rows(document: str, text: str) -> Iterator[Statement]:
    """The rows of a file.  Raises StatementError for a field that is not one, a verdict that is not, no evidence."""
    for raw in tomllib.loads(text).get("statement", ()):
        yield _row(document, raw)


def _row(document: str, raw: Mapping[str, Any]) -> Statement:
    where = f"{document}: {raw.get('id', 'a row without id')}"
    strange = raw.keys() - _FIELDS
    missing = {"id", "page", "kind", "words", "says", "verdict"} - raw.keys()
    if strange or missing:
        raise StatementError(f"{where}: {', '.join(sorted(strange or missing))} {'unknown' if strange else 'missing'}")
    if not raw["id"].startswith(f"{document}."):
        raise StatementError(f"{where}: an id is the document's name, a point and what tells it from its others")
    if raw["verdict"] not in get_args(Verdict):
        raise StatementError(f"{where}: a verdict is one of {', '.join(VERDICTS)}")
    if len(raw["words"].split()) > MOST_WORDS:
        raise StatementError(f"{where}: a locator has at most {MOST_WORDS} words")
    results, tests = _several(raw.get("result", ())), _several(raw.get("test", ()))
    computed = bool(raw.get("claim") or results or tests)
    if computed == (raw["verdict"] == UNTESTABLE) and not (computed and results):
        raise StatementError(f"{where}: {raw['verdict']} goes {'with' if not computed else 'without'} evidence")
    if raw["verdict"] != HOLDS and not raw.get("why"):
        raise StatementError(f"{where}: {raw['verdict']}: it is not said why")
    if raw["verdict"] == FAILS and not (raw.get("file") and raw.get("run")):
        raise StatementError(f"{where}: {FAILS}: there is no counterexample, or it is not said how it runs")
    simple = {name: raw[name] for name in _FIELDS - {"result", "test"} if name in raw}
    return Statement(document, **simple, results=results, tests=tests)


def _several(value: str | Iterable[str]) -> tuple[str, ...]:
    return (value,) if isinstance(value, str) else tuple(value)


def judge(statement: Statement, results: Results) -> Judged:
    """Compute what a row rests on; of several the worst.  Raises StatementError for one that does not exist."""
    verdicts: list[Verdict] = []
    words: list[str] = []
    if statement.claim:
        found = claimed(statement.claim)
        verdicts.append(found.verdict)
        words.append(found.words)
    for name in statement.results:
        verdict = results(statement.document, name)
        if verdict is None:
            raise StatementError(f"{statement.document}: {statement.id}: there is no result {name}")
        verdicts.append(verdict)
    if statement.results:
        words.append(f"judged above: {', '.join(statement.results)}")
    if verdicts:
        return Judged(statement, max(verdicts, key=_FROM_BEST.index), "; ".join(words))
    if statement.tests:
        return Judged(statement, None, f"checked by {', '.join(statement.tests)}")
    return Judged(statement, None, "")


@cache
def claimed(claim: str) -> Seen:
    """Run a claim, ``module.function arguments``.  Raises StatementError for one that does not exist."""
    name, *arguments = claim.split()
    module, _, function = name.rpartition(".")
    try:
        found = getattr(import_module(f"modern.claims.{module}"), function)
    except (ImportError, AttributeError):
        raise StatementError(f"there is no claim {name}") from None
    seen: Seen = found(*arguments)
    return seen


EXAMPLE: Final = "example "
"""How the id of a result of chapter 6 begins; its number follows."""
_OF_FINDING: Mapping[str, Verdict] = {
    EXACT: HOLDS,
    CORRECTED: HOLDS,
    EXPLAINED: FAILS,
    CANNOT: UNTESTABLE,
    DIFFERENT: FAILS,
}


class Judgements:
    """Verdicts on results: those judged already, and others judged when they are asked for."""

    def __init__(self, reports: Iterable[Report] = (), found: Iterable[Finding] = ()) -> None:
        self.known: dict[tuple[str, str], Verdict] = {}
        self.reported(reports)
        self.found(found)

    def reported(self, reports: Iterable[Report]) -> None:
        """Take in examples of chapter 6, each complete."""
        grouped: dict[int, list[Report]] = {}
        for report in reports:
            grouped.setdefault(report.example, []).append(report)
        for number, group in grouped.items():
            self.known[THESIS, f"{EXAMPLE}{number}"] = HOLDS if summary(group)[0] else FAILS

    def found(self, found: Iterable[Finding]) -> None:
        """Take in results of the later papers."""
        self.known.update({(finding.paper, finding.result.id): _OF_FINDING[finding.kind] for finding in found})

    def __call__(self, document: str, name: str) -> Verdict | None:
        if (document, name) not in self.known:
            number = name.removeprefix(EXAMPLE)
            if document == THESIS and number in map(str, EXAMPLES):
                self.reported(reproduce((int(number),)))
            for paper in PAPERS:
                if paper.name == document:
                    self.found(findings(paper))
        return self.known.get((document, name))
