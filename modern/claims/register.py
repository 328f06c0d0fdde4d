"""The register of statements of the five documents, and the computation of their verdicts.

``transcripts/statements`` holds one file for each document and one row for each statement.  A row records a verdict and
names the evidence from which :func:`judge` computes it again: a *claim* is a function of this package, and a *result*
is a published result that ``reproduce`` judges too.  If the check takes too long, the row names a *test* instead.  If a
statement cannot be tested, the row gives the reason.
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
# The five documents by their names on the command line.
DOCUMENTS = (THESIS, "appel-will", "kovalevsky-schulz", "nakamae-nishita", "yau-srihari")
MOST_WORDS = 8
_FIELDS = {"id", "page", "kind", "words", "says", "verdict", "why", "claim", "result", "test", "file", "run", "part"}


class StatementError(ValueError):
    """An invalid row of a register; the message is one line that names the document and the row."""


@dataclass(frozen=True, slots=True)
class CheckResult:
    """The verdict that a claim function computed, and a message with the evidence."""

    verdict: Verdict
    message: str


def holds_if(passed: object, message: str, conditional: object = False) -> CheckResult:
    """Return HOLDS, or CONDITION if ``conditional``, for a check that passed, and FAILS otherwise."""
    return CheckResult((CONDITION if conditional else HOLDS) if passed else FAILS, message)


def fails_if(refuted: object, message: str) -> CheckResult:
    """Return FAILS if a counterexample refutes the statement, and HOLDS otherwise."""
    return CheckResult(FAILS if refuted else HOLDS, message)


@dataclass(frozen=True, slots=True)
class Statement:
    """A statement of a document.

    ``page`` may be a section.  ``words`` quotes at most eight words of our text of the document; ``says`` paraphrases
    the statement.  ``why`` is the condition, the reason why the statement fails, or the reason why it is not tested.
    ``claim`` is ``module.function arguments`` below :mod:`modern.claims`, ``results`` are ids of published results, and
    ``tests`` are test functions, ``file::name``.  ``file`` is the smallest known counterexample, and ``run`` the
    command that shows it.  ``part`` is the theorem to which a worked example of chapter 4 belongs.
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
    """A statement with its computed verdict, which is None if the evidence is a test or a reason only."""

    statement: Statement
    computed: Verdict | None
    message: str

    @property
    def agrees(self) -> bool:
        """Return True if the computed verdict equals the recorded one, or if no verdict was computed."""
        return self.computed in (None, self.statement.verdict)


# Returns the verdict on a result by document and id, or None for an unknown id.
Results = Callable[[str, str], Verdict | None]


def statements_folder() -> Traversable:
    """Return the data folder, in a checkout or an installed wheel."""
    return files("transcripts").joinpath("statements")


def counterexample(name: str) -> str:
    return files("transcripts").joinpath("counterexamples", name).read_text(encoding="utf-8")


@cache
def statements_of(document: str) -> tuple[Statement, ...]:
    """Return the rows of a document in the order of its file.  Raise StatementError for an invalid row."""
    text = statements_folder().joinpath(f"{document}.toml").read_text(encoding="utf-8")
    return tuple(read_rows(document, text))


def read_rows(document: str, text: str) -> Iterator[Statement]:
    """Yield the rows of a register.

    Raise StatementError for an unknown or missing field, an unknown verdict, or evidence that does not fit its verdict.
    """
    for raw in tomllib.loads(text).get("statement", ()):
        yield _row(document, raw)


def _row(document: str, raw: Mapping[str, Any]) -> Statement:
    place = f"{document}: {raw.get('id', 'a row without id')}"
    unknown = raw.keys() - _FIELDS
    missing = {"id", "page", "kind", "words", "says", "verdict"} - raw.keys()
    if unknown or missing:
        raise StatementError(
            f"{place}: {'unknown' if unknown else 'missing'} field: {', '.join(sorted(unknown or missing))}"
        )
    if not raw["id"].startswith(f"{document}."):
        raise StatementError(f"{place}: expected an id of the form {document}.NUMBER")
    verdict = raw["verdict"]
    if verdict not in get_args(Verdict):
        raise StatementError(f"{place}: expected one of the verdicts {', '.join(VERDICTS)}; found {verdict!r}")
    if len(raw["words"].split()) > MOST_WORDS:
        raise StatementError(f"{place}: expected a quotation of at most {MOST_WORDS} words")
    results, tests = _as_tuple(raw.get("result", ())), _as_tuple(raw.get("test", ()))
    has_evidence = bool(raw.get("claim") or results or tests)
    if verdict == UNTESTABLE and has_evidence and not results:
        raise StatementError(f"{place}: a row with the verdict {UNTESTABLE!r} must not name a claim or test")
    if verdict != UNTESTABLE and not has_evidence:
        raise StatementError(f"{place}: a row with the verdict {verdict!r} must name a claim, result or test")
    if verdict != HOLDS and not raw.get("why"):
        raise StatementError(f"{place}: a row with the verdict {verdict!r} needs a reason in the field 'why'")
    if verdict == FAILS and not (raw.get("file") and raw.get("run")):
        raise StatementError(f"{place}: a row with the verdict {FAILS!r} needs a counterexample in 'file' and 'run'")
    simple = {name: raw[name] for name in _FIELDS - {"result", "test"} if name in raw}
    return Statement(document, **simple, results=results, tests=tests)


def _as_tuple(value: str | Iterable[str]) -> tuple[str, ...]:
    return (value,) if isinstance(value, str) else tuple(value)


def judge(statement: Statement, results: Results) -> Judged:
    """Compute the verdict of a row from its evidence.  If there are several verdicts, the worst is used.

    Raise StatementError if the row names a claim or result that does not exist.
    """
    verdicts: list[Verdict] = []
    messages: list[str] = []
    if statement.claim:
        check = run_claim(statement.claim)
        verdicts.append(check.verdict)
        messages.append(check.message)
    for name in statement.results:
        verdict = results(statement.document, name)
        if verdict is None:
            raise StatementError(f"{statement.document}: {statement.id}: there is no result {name}")
        verdicts.append(verdict)
    if statement.results:
        messages.append(f"published results: {', '.join(statement.results)}")
    if verdicts:
        return Judged(statement, max(verdicts, key=_FROM_BEST.index), "; ".join(messages))
    if statement.tests:
        return Judged(statement, None, f"checked by {', '.join(statement.tests)}")
    return Judged(statement, None, "")


@cache
def run_claim(claim: str) -> CheckResult:
    """Run a claim, ``module.function arguments``.  Raise StatementError if the function does not exist."""
    name, *arguments = claim.split()
    module, _, function_name = name.rpartition(".")
    try:
        function = getattr(import_module(f"modern.claims.{module}"), function_name)
    except (ImportError, AttributeError):
        raise StatementError(f"there is no claim {name}") from None
    result: CheckResult = function(*arguments)
    return result


# The prefix of the id of a result of chapter 6; the number of the example follows.
EXAMPLE: Final = "example "
_VERDICT_OF_FINDING: Mapping[str, Verdict] = {
    EXACT: HOLDS,
    CORRECTED: HOLDS,
    EXPLAINED: FAILS,
    CANNOT: UNTESTABLE,
    DIFFERENT: FAILS,
}


class Judgements:
    """The verdicts on published results.  Some are given at the start; the others are computed at their first use."""

    def __init__(self, reports: Iterable[Report] = ()) -> None:
        self.known: dict[tuple[str, str], Verdict] = {}
        self.add_examples(reports)

    def add_examples(self, reports: Iterable[Report]) -> None:
        """Add the verdicts on complete examples of chapter 6."""
        by_example: dict[int, list[Report]] = {}
        for report in reports:
            by_example.setdefault(report.example, []).append(report)
        for example, group in by_example.items():
            self.known[THESIS, f"{EXAMPLE}{example}"] = HOLDS if summary(group)[0] else FAILS

    def add_findings(self, paper_findings: Iterable[Finding]) -> None:
        """Add the verdicts on results of the later papers."""
        for finding in paper_findings:
            self.known[finding.paper, finding.result.id] = _VERDICT_OF_FINDING[finding.kind]

    def __call__(self, document: str, name: str) -> Verdict | None:
        if (document, name) not in self.known:
            example = name.removeprefix(EXAMPLE)
            if document == THESIS and example in map(str, EXAMPLES):
                self.add_examples(reproduce((int(example),)))
            for paper in PAPERS:
                if paper.name == document:
                    self.add_findings(findings(paper))
        return self.known.get((document, name))
