"""The register: its rows, the evidence that they name, and the detection of a wrong verdict."""

from __future__ import annotations

import ast
import re
import shlex
from collections import Counter
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from modern.claims.register import (
    CONDITION,
    DOCUMENTS,
    FAILS,
    HOLDS,
    MOST_WORDS,
    UNTESTABLE,
    CheckResult,
    Judgements,
    StatementError,
    Verdict,
    judge,
    read_rows,
    run_claim,
    statements_of,
)
from modern.claims.thesis.chapter3_stages import PROPERTY_NAMES
from modern.cli.main import main
from tests.support.paths import ROOT

ROWS = [row for document in DOCUMENTS for row in statements_of(document)]
COUNTEREXAMPLES = Path(ROOT, "transcripts", "counterexamples")
CLAIM = 'claim = "thesis.chapter3_equations.few_points"'
VALID_ROW = f"""[[statement]]
id = "x.1"
page = "1"
kind = "claim"
words = "some words"
says = "Something."
verdict = "holds"
{CLAIM}
"""


@cache
def functions_of(path: str) -> frozenset[str]:
    tree = ast.parse(Path(ROOT, path).read_text(encoding="utf-8"))
    return frozenset(node.name for node in tree.body if isinstance(node, ast.FunctionDef))


@pytest.mark.parametrize("document", DOCUMENTS)
def test_computed_verdicts_are_the_recorded_ones(document: str) -> None:
    results = Judgements()
    disagreements = [
        (judged.statement.id, judged.computed, judged.message)
        for judged in (judge(row, results) for row in statements_of(document))
        if not judged.agrees
    ]
    assert disagreements == []


@pytest.mark.parametrize("name", sorted({name for row in ROWS for name in row.tests}))
def test_tests_named_in_rows_exist(name: str) -> None:
    path, _, function = name.partition("::")
    assert function.startswith("test_")
    assert function in functions_of(path)


def test_rows_have_unique_ids_and_quotations_and_end_in_a_full_stop() -> None:
    assert max(Counter(row.id for row in ROWS).values()) == 1
    assert {place: n for place, n in Counter((row.document, row.words) for row in ROWS).items() if n > 1} == {}
    for row in ROWS:
        assert re.fullmatch(rf"{row.document}\.\d+", row.id)
        assert 1 <= len(row.words.split()) <= MOST_WORDS
        assert row.says.endswith(".")


@pytest.mark.parametrize(
    ("first", "second", "worst"),
    [
        (HOLDS, HOLDS, HOLDS),
        (HOLDS, CONDITION, CONDITION),
        (FAILS, HOLDS, FAILS),
        (UNTESTABLE, CONDITION, UNTESTABLE),
        (UNTESTABLE, FAILS, FAILS),
    ],
)
def test_worst_verdict_of_claim_and_results_counts(first: Verdict, second: Verdict, worst: Verdict) -> None:
    row = replace(ROWS[0], claim="thesis.chapter3_equations.few_points", results=("first", "second"), tests=())
    results = {"first": first, "second": second}
    judged = judge(row, lambda _, name: results[name])
    assert judged.computed == worst
    assert judged.message.endswith("; published results: first, second")
    failing_claim = replace(row, claim="thesis.chapter2.vertex_formula_with_minus")
    assert judge(failing_claim, lambda *_: HOLDS).computed == FAILS


@pytest.mark.parametrize(
    ("document", "kind", "names"),
    [
        ("thesis", "theorem", ["4.1", "4.2", "4.3", "4.4", "4.5", "4.6", "4.7", "4.8"]),
        ("thesis", "equation", ["(3.1)", "(3.2)", "(3.3)", "(3.4)", "(3.5)", "V compares"]),
        (
            "thesis",
            "figure",
            ["Fig. 1", "Fig. 2", "Fig. 3", "Fig. 4", "flow chart of program 1", "program 2", "program 3"],
        ),
        ("thesis", "table", ["Table 1", "theorem 4.8"]),
        ("thesis", "example", [f"Example {k}" for k in range(1, 7)]),
        ("appel-will", "figure", [f"Fig. {k}" for k in range(1, 24)]),
        ("appel-will", "property", ["inside of all planes", "cone", "dihedral", "polygons", "curve", "surface"]),
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
    text = " | ".join(row.says + " " + row.words for row in statements_of(document) if row.kind == kind)
    assert [name for name in names if name not in text] == []


def test_every_counterexample_is_named_in_a_row() -> None:
    assert {row.file for row in ROWS if row.file} == {path.name for path in COUNTEREXAMPLES.iterdir()} - {"README.md"}


@pytest.mark.parametrize("run", sorted({row.run for row in ROWS if row.run}))
def test_commands_that_show_counterexamples_run(
    run: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    program, *arguments = shlex.split(run)
    assert program == "hull1620"
    assert main(arguments) in (0, 1)
    assert capsys.readouterr().out


def test_wrong_verdict_is_reported(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    results = Judgements()
    for row in [row for row in statements_of("thesis") if row.claim][::12]:
        assert not judge(replace(row, verdict=FAILS if row.verdict != FAILS else HOLDS), results).agrees
    monkeypatch.setattr("modern.claims.register.run_claim", lambda _: CheckResult(FAILS, "nothing"))
    row = next(row for row in statements_of("yau-srihari") if row.claim and row.verdict == HOLDS)
    assert main(["reproduce", row.id]) == 1
    assert "BUT the computed verdict is: does not hold" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("original", "replacement", "message"),
    [
        ("kind", "sort", "unknown field: sort"),
        ("x.1", "y.1", "x: y.1: expected an id of the form x.NUMBER"),
        ('page = "1"\n', "", "missing field: page"),
        ('"holds"', '"perhaps"', "expected one of the verdicts holds"),
        ("some words", "one two three four five six seven eight nine", "at most 8 words"),
        ('"holds"', '"not testable"', "must not name a claim or test"),
        (CLAIM, "", "must name a claim, result or test"),
        ('"holds"', '"holds with a condition"', "needs a reason"),
        ('"holds"', '"does not hold"\nwhy = "so"', "needs a counterexample"),
    ],
)
def test_invalid_row_is_rejected(original: str, replacement: str, message: str) -> None:
    assert list(read_rows("x", VALID_ROW))
    with pytest.raises(StatementError, match=re.escape(message)):
        list(read_rows("x", VALID_ROW.replace(original, replacement)))


def test_unknown_claim_or_result_is_named() -> None:
    for name in ("thesis.chapter3_equations.nothing", "nothing.at_all"):
        with pytest.raises(StatementError, match=f"there is no claim {re.escape(name)}"):
            run_claim(name)
    text = VALID_ROW.replace("x.1", "thesis.1").replace(CLAIM, 'result = "example 9"')
    (row,) = read_rows("thesis", text)
    with pytest.raises(StatementError, match="there is no result example 9"):
        judge(row, Judgements())


@pytest.mark.parametrize(
    "claim",
    [
        "chapter3_equations.procedure_against_judge",
        *(f"chapter3_stages.stage_property {name}" for name in PROPERTY_NAMES),
        "chapter3_stages.eliminated_points",
        "chapter2.planes_from_triples",
        "chapter2.lines_from_pairs",
        "chapter2.vertex_in_space",
        "chapter2.gift_wrapping planes",
        "chapter2.gift_wrapping lines",
        "chapter4_theorems.origin_is_third_point",
        "chapter3_steps.third_point",
        "chapter3_steps.mean_of_first_hull",
        "chapter3_steps.visible_planes counts",
        "chapter3_steps.visible_planes pairs",
        "projections.theorem_4_4",
        "chapter4_theorems.theorem_4_5",
        "chapter4_theorems.theorem_4_7",
        "chapter7.orientation_by_c",
        "chapter7.orientation_by_constant_term",
    ],
)
def test_verdict_is_the_same_for_twenty_sets(claim: str) -> None:
    """The command samples two sets of each dimension."""
    assert run_claim(f"thesis.{claim} 20").verdict == run_claim(f"thesis.{claim}").verdict


def test_reproduce_accepts_documents_theorems_and_statements(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["reproduce", "nakamae-nishita"]) == 0
    out = capsys.readouterr().out
    assert out.count("\n  nakamae-nishita.") == len(statements_of("nakamae-nishita"))
    assert main(["reproduce", "4.1", "thesis.1", "yau-srihari.61"]) == 0
    out = capsys.readouterr().out
    assert "Theorem 4.1 (p. 37-38)" in out
    assert "thesis.1 (abstract, claim): holds with a condition" in out
    assert "run: hull1620 octree-hull transcripts/counterexamples/yau_angle.csv --printed angle" in " ".join(
        out.split()
    )
    assert main(["reproduce", "yau"]) == 2
    assert "a document (thesis, appel-will" in capsys.readouterr().err


def test_every_claim_function_is_named_in_a_test() -> None:
    """The tests of each document spoil what its claims rely on."""
    texts = "".join(path.read_text(encoding="utf-8") for path in Path(__file__).parent.glob("test_*.py"))
    functions = {row.claim.split()[0].rpartition(".")[2] for row in ROWS if row.claim}
    assert sorted(name for name in functions if not re.search(rf'[".]{name}\b', texts)) == []
