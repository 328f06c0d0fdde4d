"""The register of statements of the five documents, and the computation of their verdicts and grades.

``transcripts/statements`` holds one file for each document and one row for each statement.  A row records a verdict.
:func:`judge` computes it again, with a grade, from the checks of this package that name the row and from the published
results that the row names.  The grade of a definition that our code follows is *used*.  The grade of a statement that
cannot be tested is *quoted*, and its row gives the reason.
"""

import re
import tomllib
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache
from importlib import import_module
from importlib.resources import files
from importlib.resources.abc import Traversable
from pkgutil import iter_modules
from typing import Any, Final, Literal, get_args

from modern.claims.evidence import GRADES, Check, Decision, Grade, decisions_in
from modern.claims.published import CANNOT, CORRECTED, EXPLAINED, PAPERS, Finding, findings
from modern.edition.chapter6 import EXAMPLES
from modern.edition.reproduce import DIFFERENT, EXACT, Report, reproduce, summary

HOLDS: Final = "holds"
CONDITION: Final = "holds with a condition"
FAILS: Final = "does not hold"
USED: Final = "used"
UNTESTABLE: Final = "not testable"
Verdict = Literal[
    "holds",
    "holds with a condition",
    "does not hold",
    "slip, probably the OCR's",
    "slip of the print",
    "slip, either",
    "used",
    "not testable",
]
VERDICTS: tuple[Verdict, ...] = get_args(Verdict)
SLIPS: tuple[Verdict, ...] = VERDICTS[3:6]
# If several pieces of evidence give different verdicts, the statement has the one that is last in this list.
_FROM_BEST: tuple[Verdict, ...] = (USED, HOLDS, CONDITION, UNTESTABLE, *SLIPS, FAILS)
# The columns in which statements are counted; misprints and repetitions are counted apart from wrong claims.
SLIP: Final = "slip"
REPETITION: Final = "repetition"
COLUMNS = (HOLDS, CONDITION, FAILS, SLIP, USED, UNTESTABLE, REPETITION)

THESIS: Final = "thesis"
# The five documents by their names on the command line.
DOCUMENTS = (THESIS, "appel-will", "kovalevsky-schulz", "nakamae-nishita", "yau-srihari")
MOST_WORDS = 8
# The field with the reason of a verdict names the verdict.
_REASONS: Mapping[str, Verdict] = {
    "condition": CONDITION,
    "fails": FAILS,
    "slip_ocr": SLIPS[0],
    "slip_print": SLIPS[1],
    "slip_either": SLIPS[2],
    "untested": UNTESTABLE,
}
_OF_VERDICT = {*_REASONS, "code", "note", "result", "file", "run"}
_FIELDS = {"words", "says", "kind", "part", "same"} | _OF_VERDICT
# The kind of a statement is the first of these whose pattern occurs in the text "PAGE: PARAPHRASE [QUOTATION]".
_KINDS: Mapping[str, str] = {
    "figure": r"(^|: )Figs?\. |flow charts? (of|use)",
    "table": r"(^|: )(In )?Table \d|[Tt]he table of|of Table \d",
    "theorem": r": Theorem \S+:",
    "lemma": r": Lemma",
    "complexity": r"O\(",
    "property": r"^Properties|: Property",
    "step": r": (Step \d|Search rule|In step)",
    "equation": r"([Ff]ormula|[Ee]quation)s? \(|\[.*[\w})\]] = ",
    "definition": r": (By d|D)efinition|\bdefines\b|are defined by",
    "example": r": Example \d|example of theorem",
}
_COUNTEREXAMPLES: Final = "transcripts/counterexamples/"


class StatementError(ValueError):
    """An invalid row of a register; the message is one line that names the document and the row."""


@dataclass(frozen=True, slots=True)
class Statement:
    """A statement of a document.

    ``page`` may be a section.  ``words`` quotes at most eight words of the OCR text; ``says`` paraphrases the
    statement.  ``why`` is the condition, the reason why the statement fails, or the reason why it is not tested.
    ``results`` are ids of published results.  ``code`` names the code that follows a definition.  ``file`` is the
    smallest known counterexample, and ``run`` is the command that shows it.  ``part`` is the theorem to which a worked
    example of chapter 4 belongs.  ``same`` is the id of the row that this row repeats and whose verdict it shares.
    """

    document: str
    id: str
    page: str
    words: str
    says: str
    kind: str = "claim"
    verdict: Verdict = HOLDS
    why: str = ""
    results: tuple[str, ...] = ()
    code: str = ""
    file: str = ""
    run: str = ""
    part: str = ""
    same: str = ""


@dataclass(frozen=True, slots=True)
class Judged:
    """A row with its computed verdict, grade and evidence; if no evidence could be computed, the verdict is None."""

    statement: Statement
    computed: Verdict | None
    message: str
    grade: Grade = "quoted"
    checks: tuple[Check, ...] = ()

    @property
    def agrees(self) -> bool:
        """Return True if the computed verdict equals the recorded verdict, or if none was computed."""
        return self.computed in (None, self.statement.verdict)


# A function from document and id of a published result to its verdict, or to None if the id is unknown.
Results = Callable[[str, str], Verdict | None]


def statements_folder() -> Traversable:
    """Return the folder of the registers, in a checkout or in an installed wheel."""
    return files("transcripts").joinpath("statements")


@cache
def statements_of(document: str) -> tuple[Statement, ...]:
    """Return the rows of a document in the order of its file.  Raise StatementError for an invalid row."""
    text = statements_folder().joinpath(f"{document}.toml").read_text(encoding="utf-8")
    return tuple(read_rows(document, text))


def read_rows(document: str, text: str) -> Iterator[Statement]:
    """Yield the rows of a register.  A row that repeats another one gets the verdict of that row.

    Raise StatementError for an unknown or missing field, an unknown verdict, or fields that do not fit the verdict.
    """
    rows = {number: _row(document, number, raw) for number, raw in tomllib.loads(text).items()}
    for row in rows.values():
        if not row.same:
            yield row
            continue
        origin = rows.get(row.same.partition(".")[2])
        if origin is None or origin.same:
            raise StatementError(f"{row.id}: expected in 'same' a row without 'same'; found {row.same}")
        yield replace(row, verdict=origin.verdict, why=origin.why, file=origin.file, run=origin.run)


def _row(document: str, number: str, tables: Mapping[str, Any]) -> Statement:
    place = f"{document}.{number}"
    if not number.isdecimal() or not isinstance(tables, Mapping) or len(tables) != 1:
        raise StatementError(f"{document}: expected [NUMBER.PAGE] as name of each table; found {number!r}")
    ((page, raw),) = tables.items()
    if unknown := raw.keys() - _FIELDS:
        raise StatementError(f"{place}: unknown field: {', '.join(sorted(unknown))}")
    if missing := {"words", "says"} - raw.keys():
        raise StatementError(f"{place}: missing field: {', '.join(sorted(missing))}")
    if len(raw["words"].split()) > MOST_WORDS:
        raise StatementError(f"{place}: expected in 'words' a quotation of at most {MOST_WORDS} words")
    if "same" in raw and (extra := raw.keys() & _OF_VERDICT):
        raise StatementError(f"{place}: a row with the field 'same' must not have {', '.join(sorted(extra))}")
    deciding = [name for name in (*_REASONS, "code") if name in raw]
    if len(deciding) > 1 or not all(map(raw.get, deciding)):
        raise StatementError(f"{place}: expected at most one verdict, with a reason; found {', '.join(deciding)}")
    verdict = _REASONS.get(deciding[0], USED) if deciding else HOLDS
    why = raw.get(deciding[0]) if deciding and verdict != USED else raw.get("note", "")
    # The command that shows a counterexample names its file, or is the one that computes the verdict.
    file = raw.get("file", raw.get("run", "").partition(_COUNTEREXAMPLES)[2].partition(" ")[0])
    run = raw.get("run", f"hull1620 reproduce {place}" if file else "")
    if verdict == FAILS and not file:
        raise StatementError(f"{place}: a row with the verdict {FAILS!r} needs a counterexample in 'file' or 'run'")
    text = f"{page}: {raw['says']} [{raw['words']}]"
    of_verdict = {USED: "definition or step", **dict.fromkeys(SLIPS, SLIP)}.get(verdict, "claim")
    kind = raw.get("kind", next((kind for kind, form in _KINDS.items() if re.search(form, text)), of_verdict))
    same = f"{document}.{raw['same']}" if "same" in raw else ""
    results, code, part = _as_tuple(raw.get("result", ())), raw.get("code", ""), raw.get("part", "")
    return Statement(
        document, place, page, raw["words"], raw["says"], kind, verdict, why, results, code, file, run, part, same
    )


def _as_tuple(value: str | Iterable[str]) -> tuple[str, ...]:
    return (value,) if isinstance(value, str) else tuple(value)


@cache
def decisions() -> Mapping[str, tuple[Decision, ...]]:
    """Return the checks of all documents by the ids of the statements that they decide.

    The invariants and every module below ``modern/claims/DOCUMENT/`` are searched for functions with the decorator
    ``claim``.
    """
    packages = [import_module(f"modern.claims.{document.replace('-', '_')}") for document in DOCUMENTS]
    modules = [module.name for p in packages for module in iter_modules(p.__path__, f"{p.__name__}.")]
    by_statement: dict[str, list[Decision]] = {}
    for name in (*modules, "modern.claims.invariants"):
        for decision in decisions_in(import_module(name)):
            by_statement.setdefault(decision.statement, []).append(decision)
    return {name: tuple(of_statement) for name, of_statement in by_statement.items()}


@cache
def _run(function: Callable[..., Check], subject: tuple[tuple[str, Any], ...]) -> Check:
    return function(**dict(subject))


def judge(statement: Statement, results: Results) -> Judged:
    """Compute the verdict and the grade of a row from its evidence.

    The verdict is the worst one of all evidence, and the grade is the strongest among the evidence for that verdict.  A
    repetition is judged by the row that it repeats.  Raise StatementError if the row has no evidence, if its evidence
    does not fit its verdict, or if it names a result or code that does not exist.
    """
    own_id = statement.same or statement.id
    checks = tuple(_run(decision.function, decision.subject) for decision in decisions().get(own_id, ()))
    graded = [(_verdict(check, statement), check.evidence.grade) for check in checks]
    messages = [check.message for check in checks]
    row = statement
    if statement.same:
        row = next(other for other in statements_of(statement.document) if other.id == statement.same)
    for name in row.results:
        verdict = results(row.document, name)
        if verdict is None:
            raise StatementError(f"{row.id}: the field 'results' names {name}, which is not a published result")
        graded.append((verdict, "quoted" if verdict == UNTESTABLE else "exhibited"))
    if row.results:
        messages.append(f"compared with the published results {', '.join(row.results)}")
    if row.code:
        resolve(row)
        graded.append((USED, "used"))
        messages.append(f"used by {row.code}")
    if bool(graded) == (row.verdict == UNTESTABLE) and not row.results:
        raise StatementError(f"{row.id}: the verdict is {row.verdict!r}, but there is {'a' if graded else 'no'} check")
    if not graded:
        return Judged(statement, None, "")
    worst = max((verdict for verdict, _ in graded), key=_FROM_BEST.index)
    grade = min((grade for verdict, grade in graded if verdict == worst), key=GRADES.index)
    return Judged(statement, worst, "; ".join(messages), grade, checks)


def _verdict(check: Check, statement: Statement) -> Verdict:
    """Return the verdict of a check.

    A check can prove a misprint, but not whether the OCR or the print made it: this is recorded in the row.
    """
    if check.holds:
        return CONDITION if check.evidence.violation else HOLDS
    return (statement.verdict if statement.verdict in SLIPS else SLIPS[2]) if check.evidence.correction else FAILS


def resolve(row: Statement) -> object:
    """Return the object that the field ``code`` of a row names.  Raise StatementError if it does not exist."""
    parts = row.code.split(".")
    for count in range(len(parts) - 1, 0, -1):
        module, names = ".".join(parts[:count]), parts[count:]
        try:
            value: Any = import_module(module)
            for name in names:
                value = getattr(value, name)
        except (ImportError, AttributeError):
            continue
        return value
    raise StatementError(f"{row.id}: the field 'code' names {row.code}, which does not exist")


@cache
def judged(document: str) -> tuple[Judged, ...]:
    """Return all rows of a document with their computed verdicts and grades.  This takes a few seconds."""
    results = Judgements()
    return tuple(judge(row, results) for row in statements_of(document))


def column(row: Statement) -> str:
    """Return the column of :data:`COLUMNS` in which a row is counted."""
    return REPETITION if row.same else SLIP if row.verdict in SLIPS else row.verdict


def counts(document: str) -> Counter[str]:
    """Count the rows of a document by column; repetitions and slips have their own columns."""
    return Counter(map(column, statements_of(document)))


def grades(judgements: Iterable[Judged]) -> Counter[Grade]:
    """Return the number of statements of each grade among those that hold, with or without a condition."""
    return Counter(row.grade for row in judgements if column(row.statement) in (HOLDS, CONDITION))


# Ids of results of chapter 6 consist of this prefix and the number of the example.
EXAMPLE: Final = "example "
_VERDICT_OF_FINDING: Mapping[str, Verdict] = {
    EXACT: HOLDS,
    CORRECTED: HOLDS,
    EXPLAINED: FAILS,
    CANNOT: UNTESTABLE,
    DIFFERENT: FAILS,
}


class Judgements:
    """The verdicts on published results.  Some are given in advance; the others are computed when first requested."""

    def __init__(self, reports: Iterable[Report] = ()) -> None:
        self.known: dict[tuple[str, str], Verdict] = {}
        self.add_examples(reports)

    def add_examples(self, reports: Iterable[Report]) -> None:
        """Add the verdicts on the results of chapter 6 from reports that cover complete examples."""
        by_example: dict[int, list[Report]] = {}
        for report in reports:
            by_example.setdefault(report.example, []).append(report)
        for example, group in by_example.items():
            self.known[THESIS, f"{EXAMPLE}{example}"] = HOLDS if summary(group)[0] else FAILS

    def add_findings(self, paper_findings: Iterable[Finding]) -> None:
        """Add the verdicts on published results of the later papers."""
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
