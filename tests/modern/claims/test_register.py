"""The register: its rows, the evidence for them, and the detection of a wrong verdict."""

from __future__ import annotations

import re
import shlex
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest

from modern.claims import register
from modern.claims.register import DOCUMENTS, FAILS, HOLDS, Judgements, Verdict, decisions, judge, statements_of
from modern.cli.main import main
from tests.support.paths import ROOT

ROWS = [row for document in DOCUMENTS for row in statements_of(document)]
BY_ID = {row.id: row for row in ROWS}
COUNTEREXAMPLES = Path(ROOT, "transcripts", "counterexamples")
VALID_ROW = """[1.4]
kind = "claim"
words = "some words"
says = "Something."
"""


@pytest.mark.parametrize("document", DOCUMENTS)
def test_computed_verdicts_are_the_recorded_ones(document: str) -> None:
    assert [(row.statement.id, row.computed, row.message) for row in register.judged(document) if not row.agrees] == []


def test_rows_are_unique_decided_and_name_their_counterexamples() -> None:
    assert [name for name in decisions() if name not in BY_ID or BY_ID[name].same] == []
    assert {place: n for place, n in Counter((row.document, row.words) for row in ROWS).items() if n > 1} == {}
    for row in ROWS:
        assert 1 <= len(row.words.split()) <= register.MOST_WORDS
        assert row.says.endswith(".")
    assert {row.file for row in ROWS if row.file} == {path.name for path in COUNTEREXAMPLES.iterdir()} - {"README.md"}


@pytest.mark.parametrize(
    ("first", "second", "worst"),
    [
        (HOLDS, HOLDS, HOLDS),
        (HOLDS, register.CONDITION, register.CONDITION),
        (FAILS, HOLDS, FAILS),
        (register.UNTESTABLE, register.CONDITION, register.UNTESTABLE),
        (register.UNTESTABLE, FAILS, FAILS),
    ],
)
def test_worst_verdict_of_check_and_results_counts(first: Verdict, second: Verdict, worst: Verdict) -> None:
    row = replace(BY_ID["thesis.47"], results=("first", "second"))
    results = {"first": first, "second": second}
    judgement = judge(row, lambda _, name: results[name])
    assert judgement.computed == worst
    assert judgement.message.endswith("; compared with the published results first, second")
    failing_claim = replace(BY_ID["thesis.22"], results=("first",))
    assert judge(failing_claim, lambda *_: HOLDS).computed in (FAILS, *register.SLIPS)


@pytest.mark.parametrize(
    ("document", "kind", "names"),
    [
        ("thesis", "theorem", [f"4.{k}" for k in range(1, 9)]),
        ("thesis", "equation", ["(3.1)", "(3.2)", "(3.3)", "(3.4)", "(3.5)", "V_i compare"]),
        ("thesis", "figure", [f"Fig. {k}" for k in range(1, 5)]),
        ("thesis", "figure", ["flow chart of program 1", "program 2", "program 3"]),
        ("thesis", "table", ["Table 1", "theorem 4.8"]),
        ("thesis", "example", [f"Example {k}" for k in range(1, 7)]),
        ("appel-will", "figure", [f"Fig. {k}" for k in range(1, 24)]),
        ("appel-will", "property", ["material side of all planes", "cone", "dihedral", "polygons", "curve", "surface"]),
        ("appel-will", "step", [f"Step {k}" for k in range(1, 11)]),
        ("kovalevsky-schulz", "lemma", ["LZ", "CH", "BE"]),
        ("kovalevsky-schulz", "theorem", ["PL"]),
        ("kovalevsky-schulz", "equation", [f"({k})" for k in range(1, 7)]),
        ("kovalevsky-schulz", "figure", [f"Fig. {k}" for k in range(1, 13)]),
        ("kovalevsky-schulz", "table", ["Table 1", "Table 2", "Table 3", "Table 4", "diameter 8", "diameter 22"]),
        ("kovalevsky-schulz", "definition", ["AP", "CP", "CH", "VI", "ACC", "SC", "OP", "SON", "CS", "CL", "IN", "BD"]),
        ("kovalevsky-schulz", "definition", ["MA", "IC", "CN", "HN", "RG", "SO", "DHS", "TL", "CA", "TR", "SG"]),
        ("nakamae-nishita", "equation", [f"({k})" for k in range(1, 7)]),
        ("nakamae-nishita", "property", [f"Property {k}" for k in range(1, 5)]),
        ("nakamae-nishita", "figure", ["Fig. 1", "Fig. 2", "Fig. 3", "Fig. 4 (a)", "Fig. 4 (c)", "Fig. 4 (d)"]),
        ("nakamae-nishita", "table", ["Table 1 (a)", "(b)", "(c)", "(d)", "seconds"]),
        ("yau-srihari", "theorem", ["Theorem 1", "Theorem 2", "6-connected"]),
        ("yau-srihari", "figure", [f"Fig. {k}" for k in range(1, 7)]),
        ("yau-srihari", "complexity", ["O(n log n)", "O(n)", "O(n^3 log n)", "O(n^2)"]),
        ("yau-srihari", "definition", ["3.2.1", "3.2.2", "3.2.3", "half-cell expansion", "semidigital", "near if"]),
    ],
)
def test_every_numbered_item_has_a_row(document: str, kind: str, names: list[str]) -> None:
    text = " | ".join(row.says + " " + row.words for row in statements_of(document) if kind in row.kind)
    assert [name for name in names if name not in text] == []


@pytest.mark.parametrize("run", sorted({row.run for row in ROWS if row.run}))
def test_commands_that_show_counterexamples_run(run: str, capsys, monkeypatch) -> None:
    monkeypatch.chdir(ROOT)
    program, *arguments = shlex.split(run)
    assert program == "hull1620"
    assert main(arguments) in (0, 1)
    assert capsys.readouterr().out


def test_wrong_verdict_is_reported(capsys, monkeypatch) -> None:
    results = Judgements()
    checked = [row for row in statements_of("thesis") if row.id in decisions() and row.verdict not in register.SLIPS]
    for row in checked[::12]:
        assert not judge(replace(row, verdict=FAILS if row.verdict != FAILS else HOLDS), results).agrees
    row = next(row for row in statements_of("yau-srihari") if row.id in decisions() and row.verdict == HOLDS)
    wrong = replace(row, verdict=FAILS)
    monkeypatch.setattr("modern.cli.reproduce.statements_of", lambda _: (wrong,))
    assert main(["reproduce", row.id]) == 1
    assert "BUT the computed verdict is: holds" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("original", "replacement", "message"),
    [
        ("kind", "sort", "x.1: unknown field: sort"),
        ("[1.4]", "[first.4]", "x: expected [NUMBER.PAGE] as name of each table; found 'first'"),
        ("[1.4]", "[1]", "x: expected [NUMBER.PAGE] as name of each table; found '1'"),
        ('says = "Something."\n', "", "x.1: missing field: says"),
        ("some words", "one two three four five six seven eight nine", "at most 8 words"),
        ("kind =", 'code = "math.pi"\nuntested =', "expected at most one verdict, with a reason; found untested, code"),
        ('kind = "claim"', 'condition = ""', "expected at most one verdict, with a reason; found condition"),
        ("kind =", "fails =", "needs a counterexample"),
        ("kind =", "same = 2\nfails =", "a row with the field 'same' must not have fails"),
        ('kind = "claim"', "same = 2", "expected in 'same' a row without 'same'; found x.2"),
    ],
)
def test_invalid_row_is_rejected(original: str, replacement: str, message: str) -> None:
    assert list(register.read_rows("x", VALID_ROW))
    with pytest.raises(register.StatementError, match=re.escape(message)):
        list(register.read_rows("x", VALID_ROW.replace(original, replacement)))


def test_repetitions_and_slips_are_counted_separately() -> None:
    repeated = VALID_ROW.replace("[1.4]", "[2.5]") + "same = 1"
    first, second = register.read_rows("x", VALID_ROW + 'untested = "lost"\n' + repeated)
    assert (second.verdict, second.why, second.same) == (register.UNTESTABLE, "lost", first.id)
    numbers = sum(map(register.counts, DOCUMENTS), Counter())
    assert numbers.total() == len(ROWS)
    assert numbers["repetition"] == sum(bool(row.same) for row in ROWS)
    assert numbers["slip"] == sum(row.verdict in register.SLIPS and not row.same for row in ROWS)


def test_missing_evidence_is_named() -> None:
    for fields, message in (
        ({"results": ("example 9",)}, "the field 'results' names example 9, which is not a published result"),
        ({"id": "thesis.999"}, "thesis.999: the verdict is 'holds', but there is no check"),
        ({"verdict": register.UNTESTABLE}, "the verdict is 'not testable', but there is a check"),
        ({"code": "modern.port.nothing"}, "the field 'code' names modern.port.nothing, which does not exist"),
    ):
        with pytest.raises(register.StatementError, match=re.escape(message)):
            judge(replace(BY_ID["thesis.47"], **fields), Judgements())


def test_reproduce_accepts_documents_theorems_and_statements(capsys) -> None:
    assert main(["reproduce", "nakamae-nishita"]) == 0
    out = capsys.readouterr().out
    assert out.count("\n  nakamae-nishita.") == len(statements_of("nakamae-nishita"))
    assert main(["reproduce", "4.1", "thesis.1", "yau-srihari.61"]) == 0
    out = capsys.readouterr().out
    assert "Theorem 4.1 (p. 37-38)" in out
    assert "thesis.1 (abstract, claim): holds with a condition" in out
    command = "run: hull1620 octree-hull transcripts/counterexamples/yau_angle.csv --printed angle"
    assert command in " ".join(out.split())
    assert main(["reproduce", "yau"]) == 2
    assert "a document (thesis, appel-will" in capsys.readouterr().err
