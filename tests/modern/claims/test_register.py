"""A verdict on every statement: the rows, what they rest on, and that a wrong verdict is seen."""

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
    VERDICTS,
    Judgements,
    Seen,
    Statement,
    StatementError,
    Verdict,
    claimed,
    judge,
    read_rows,
    statements_of,
)
from modern.claims.thesis.chapter3_stages import KINDS
from modern.cli.main import main
from tests.support.paths import ROOT

ROWS = [row for document in DOCUMENTS for row in statements_of(document)]
FEW_POINTS = "thesis.chapter3_equations.few_points"
COUNTEREXAMPLES = Path(ROOT, "transcripts", "counterexamples")
GOOD = """[[statement]]
id = "x.1"
page = "1"
kind = "claim"
words = "some words"
says = "Something."
verdict = "holds"
claim = "thesis.chapter3_equations.few_points"
"""


@cache
def functions_of(path: str) -> frozenset[str]:
    tree = ast.parse(Path(ROOT, path).read_text(encoding="utf-8"))
    return frozenset(node.name for node in tree.body if isinstance(node, ast.FunctionDef))


@pytest.mark.parametrize("document", DOCUMENTS)
def test_every_claim_finds_the_verdict_of_its_row(document: str) -> None:
    results = Judgements()
    wrong = [
        (judged.statement.id, judged.found, judged.seen)
        for judged in (judge(row, results) for row in statements_of(document))
        if not judged.agrees
    ]
    assert wrong == []


@pytest.mark.parametrize("row", [row for row in ROWS if row.tests], ids=lambda row: row.id)
def test_a_test_that_a_row_names_exists(row: Statement) -> None:
    for name in row.tests:
        path, _, function = name.partition("::")
        assert function.startswith("test_")
        assert function in functions_of(path), name


def test_rows_have_distinct_ids_of_their_document_and_say_where_they_stand() -> None:
    assert max(Counter(row.id for row in ROWS).values()) == 1
    for row in ROWS:
        assert re.fullmatch(rf"{row.document}\.\d+", row.id)
        assert 1 <= len(row.words.split()) <= MOST_WORDS
        assert row.verdict in VERDICTS
        assert row.verdict == HOLDS or row.why
        assert row.says.endswith(".")


def test_no_two_rows_of_a_document_stand_at_the_same_words() -> None:
    assert {place: n for place, n in Counter((row.document, row.words) for row in ROWS).items() if n > 1} == {}


def test_of_a_claim_and_its_results_the_worst_counts() -> None:
    """Each alone spoils the verdict; a result that cannot be tested does not hide one that fails."""
    row = replace(
        statements_of("thesis")[0], claim="thesis.chapter3_equations.few_points", results=("one", "other"), tests=()
    )
    known: dict[str, Verdict] = {}

    def results(_: str, name: str) -> Verdict | None:
        return known.get(name)

    for one, other, worst in (
        (HOLDS, HOLDS, HOLDS),
        (HOLDS, CONDITION, CONDITION),
        (FAILS, HOLDS, FAILS),
        (UNTESTABLE, CONDITION, UNTESTABLE),
        (UNTESTABLE, FAILS, FAILS),
    ):
        known.update(one=one, other=other)
        assert judge(row, results).found == worst
    assert judge(row, results).seen.startswith("a point, a segment, a triangle; judged above: one, other")
    known.update(one=HOLDS, other=HOLDS)
    wrong = replace(row, claim="thesis.chapter2.vertex_with_minus")
    assert judge(wrong, results).found == FAILS


def test_what_is_computed_needs_no_stored_verdict() -> None:
    for row in ROWS:
        computed = bool(row.claim or row.results)
        assert computed or row.tests or row.verdict == UNTESTABLE, row.id


@pytest.mark.parametrize(
    ("document", "kind", "needed"),
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
        ("yau-srihari", "definition", ["3.2.1", "3.2.2", "3.2.3", "Half-cell", "semidigital", "Near"]),
    ],
)
def test_everything_with_a_number_has_a_row(document: str, kind: str, needed: list[str]) -> None:
    said = " | ".join(row.says + " " + row.words for row in statements_of(document) if row.kind == kind)
    assert [name for name in needed if name not in said] == []


def test_what_does_not_hold_has_a_counterexample_and_every_one_is_used() -> None:
    used = {row.file for row in ROWS if row.file}
    assert used == {path.name for path in COUNTEREXAMPLES.iterdir()} - {"README.md"}
    for row in ROWS:
        if row.verdict == FAILS:
            assert row.file
            assert row.run


@pytest.mark.parametrize("run", sorted({row.run for row in ROWS if row.run}))
def test_a_counterexample_runs_as_its_row_says(
    run: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    program, *arguments = shlex.split(run)
    assert program == "hull1620"
    assert main(arguments) in (0, 1)
    assert capsys.readouterr().out


def test_a_wrong_verdict_is_seen(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """Each computed row with another verdict disagrees; the command ends with 1 and says so."""
    results = Judgements()
    some = [row for row in statements_of("thesis") if row.claim][::12]
    for row in some:
        other = FAILS if row.verdict != FAILS else HOLDS
        assert not judge(replace(row, verdict=other), results).agrees
    monkeypatch.setattr("modern.claims.register.claimed", lambda _: Seen(FAILS, "nothing"))
    row = next(row for row in statements_of("yau-srihari") if row.claim and row.verdict == HOLDS)
    assert main(["reproduce", row.id]) == 1
    assert "BUT what is found: does not hold" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (GOOD.replace("kind", "sort"), "sort unknown"),
        (GOOD.replace("x.1", "y.1"), "x: y.1: an id is the document's name, a point and "),
        (GOOD.replace('page = "1"\n', ""), "page missing"),
        (GOOD.replace('"holds"', '"perhaps"'), "a verdict is one of holds"),
        (GOOD.replace("some words", "one two three four five six seven eight nine"), "at most 8 words"),
        (GOOD.replace('"holds"', '"not testable"'), "without evidence"),
        (GOOD.replace('claim = "thesis.chapter3_equations.few_points"\n', ""), "with evidence"),
        (GOOD.replace('"holds"', '"holds with a condition"'), "it is not said why"),
        (GOOD.replace('"holds"', '"does not hold"\nwhy = "so"'), "there is no counterexample"),
    ],
)
def test_a_row_that_is_none_is_refused(text: str, words: str) -> None:
    assert list(read_rows("x", GOOD))
    with pytest.raises(StatementError, match=re.escape(words)):
        list(read_rows("x", text))


def test_claims_and_results_that_do_not_exist_are_named() -> None:
    with pytest.raises(StatementError, match=r"no claim thesis\.chapter3_equations\.nothing"):
        claimed("thesis.chapter3_equations.nothing")
    with pytest.raises(StatementError, match=r"no claim nothing\.at_all"):
        claimed("nothing.at_all")
    text = GOOD.replace("x.1", "thesis.1").replace(
        'claim = "thesis.chapter3_equations.few_points"', 'result = "example 9"'
    )
    (row,) = read_rows("thesis", text)
    with pytest.raises(StatementError, match="there is no result"):
        judge(row, Judgements())


@pytest.mark.parametrize(
    "claim",
    [
        "thesis.chapter3_equations.procedure_is_right",
        *(f"thesis.chapter3_stages.approximations {kind}" for kind in KINDS),
        "thesis.chapter3_stages.eliminated",
        "thesis.chapter2.all_triples",
        "thesis.chapter2.all_pairs",
        "thesis.chapter2.vertex_in_space",
        "thesis.chapter2.rotations planes",
        "thesis.chapter2.rotations lines",
        "thesis.chapter4_theorems.none_below_the_origin",
        "thesis.chapter3_steps.third_point",
        "thesis.chapter3_steps.mean_is_inside",
        "thesis.chapter3_steps.visible_planes counts",
        "thesis.chapter3_steps.visible_planes pairs",
        "thesis.chapter4_theorems.theorem_4_4",
        "thesis.chapter4_theorems.theorem_4_5",
        "thesis.chapter4_theorems.theorem_4_7",
        "thesis.chapter7.turned_by_c",
        "thesis.chapter7.constant_term_is_enough",
    ],
)
def test_more_sets_than_the_command_takes(claim: str) -> None:
    """The command looks at two sets of a dimension, this at twenty."""
    assert claimed(f"{claim} 20").verdict == claimed(claim).verdict


def test_names_of_documents_and_statements(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["reproduce", "yau-srihari"]) == 0
    out = capsys.readouterr().out
    assert out.count("\n  yau-srihari.") == len(statements_of("yau-srihari"))
    assert "run: hull1620 octree-hull transcripts/counterexamples/yau_angle.csv --printed angle" in " ".join(
        out.split()
    )
    assert main(["reproduce", "4.1", "thesis.1"]) == 0
    out = capsys.readouterr().out
    assert "Theorem 4.1 (p. 37-38)" in out
    assert "thesis.1 (abstract, claim): holds with a condition" in out
    assert main(["reproduce", "yau"]) == 2
    assert "the documents are thesis, appel-will" in capsys.readouterr().err
