"""FPCore files against a parser of the standard's grammar, and the folder for authors of tools."""

import csv
import io
import json
import random
from collections.abc import Mapping
from fractions import Fraction

import pytest
from lark import Lark, Token, Tree

from emulator.language.cards import deck_from_lines
from emulator.language.compiler import compile_deck
from emulator.translation.fpcore import Formula, statements
from modern.bench.benchmark import benchmark
from modern.bench.formulas import formulas, fpcore
from modern.cli.main import main
from modern.edition import programs

# FPCore 2.0, section 1 (https://fpbench.org/spec/fpcore-2.0.html), without loops and tensors.
GRAMMAR = r"""
start: core+
core: "(" "FPCore" SYMBOL? "(" SYMBOL* ")" property* expr ")"
property: ":" NAME data
?expr: number | SYMBOL -> symbol | "(" OPERATION expr+ ")" -> operation
number: DECNUM | RATIONAL
data: expr | STRING | "(" SYMBOL+ ")"
OPERATION.3: /(\+|-|\*|\/|fabs|sqrt|sin|cos|atan|exp|log|pow|and|<=)(?=[\s(])/
RATIONAL.2: /[+-]?[0-9]+\/[0-9]*[1-9][0-9]*/
DECNUM.1: /[-+]?([0-9]+(\.[0-9]+)?|\.[0-9]+)(e[-+]?[0-9]+)?(?=[\s()])/
SYMBOL: /[a-zA-Z~!@$%^&*_\-+=<>.?\/:][a-zA-Z0-9~!@$%^&*_\-+=<>.?\/:]*/
NAME: /[a-z]+/
STRING: /"([^\\"]|\\.)*"/
COMMENT: /;[^\n]*/
%import common.WS
%ignore WS
%ignore COMMENT
"""
PARSER = Lark(GRAMMAR, parser="earley", lexer="dynamic")
Number = float | Fraction


def parsed(text: str) -> list[Tree[Token]]:
    return [core for core in PARSER.parse(text).children if isinstance(core, Tree)]


def evaluated(node: Tree[Token] | Token, values: Mapping[str, Number]) -> Number:
    assert isinstance(node, Tree)
    first = str(node.children[0])
    if node.data == "symbol":
        return values[first]
    if node.data == "number":
        return float(first)
    operands = [evaluated(child, values) for child in node.children[1:]]
    if first == "-" and len(operands) == 1:
        return -operands[0]
    a, b = operands
    return {"+": lambda: a + b, "-": lambda: a - b, "*": lambda: a * b, "/": lambda: a / b}[first]()


FORMULAS = {formula.name: (name, formula) for name, group in formulas().items() for formula in group}


@pytest.mark.parametrize("name", FORMULAS)
def test_fpcore_computes_what_the_code_does(name: str) -> None:
    """The body has the code's values in doubles, bit for bit, and :spec has them in exact numbers."""
    formula: Formula = FORMULAS[name][1]
    (core,) = parsed(formula.text())
    body = core.children[-1]
    spec = next(
        tree.children[1] for tree in core.iter_subtrees() if tree.data == "property" and tree.children[0] == "spec"
    )
    assert isinstance(spec, Tree)
    source = random.Random(name)
    for _ in range(100):
        floats = [source.uniform(-formula.most, formula.most) for _ in formula.arguments]
        assert evaluated(body, dict(zip(formula.arguments, floats, strict=True))) == formula.computed(*floats)
        exact = [Fraction(source.randint(1, formula.most) * source.choice((-1, 1))) for _ in formula.arguments]
        values: dict[str, Number] = dict(zip(formula.arguments, exact, strict=True))
        assert evaluated(spec.children[0], values) == evaluated(body, values) == formula.computed(*exact)


@pytest.mark.parametrize("name", formulas())
def test_a_file_of_formulas_follows_the_grammar(name: str) -> None:
    properties = [[str(p.children[0]) for p in core.find_data("property")] for core in parsed(fpcore(name))]
    assert all(sorted(names) == ["cite", "description", "name", "pre", "precision", "spec"] for names in properties)
    assert len(properties) == len(formulas()[name])


def test_statements_of_programs_follow_the_grammar() -> None:
    text = statements(programs.program("program2"))
    assert len(parsed(text)) == text.count("(FPCore") > 30
    cards = ["DIMENSION X(9)", "A=SQRTF(X(2*I+1)**2-1.5E-3)**J", "N=I*2", "B=N*I", "C=-SINF(4.)/A**B", "END"]
    text = statements(compile_deck(deck_from_lines("my.f", cards)))
    assert len(parsed(text)) == 2
    assert "(FPCore (X_2xIp1 J)" in text
    assert "(pow (sqrt (fabs (- (* X_2xIp1 X_2xIp1) 1.5e-3))) J))" in text
    assert "; my.f, card 4: B=N*I: fixed-point arithmetic has no counterpart" in text


@pytest.fixture(scope="module")
def texts() -> dict[str, str]:
    return benchmark(6)


def test_benchmark_is_reproducible_and_complete(texts: dict[str, str], tmp_path_factory) -> None:
    verdicts = json.loads(texts["verdicts.json"])
    assert len(verdicts) == 21
    for verdict in verdicts:
        rows = list(csv.DictReader(io.StringIO(texts[f"decisions/{verdict['deck']}.csv"])))
        assert len(rows) == verdict["decisions"] > 0
        assert texts[f"decks/{verdict['deck']}.deck"]
        for arithmetic, first in verdict["first_wrong"].items():
            column = [row[f"{arithmetic}_verdict"] for row in rows]
            assert (column.index("wrong") + 1 if "wrong" in column else None) == first
            assert set(column[: (first or len(rows) + 1) - 1]) <= {"right"}
    assert any(verdict["first_wrong"]["float64"] for verdict in verdicts)
    again = benchmark(1)
    assert {
        name: text for name, text in texts.items() if name in again and name.startswith("dec")
    }.items() <= again.items()


def test_verdicts_agree_with_the_exact_value(texts: dict[str, str]) -> None:
    """The sign of an exact value is the outcome of its IF."""
    for name, text in texts.items():
        for row in csv.DictReader(io.StringIO(text)) if name.startswith("decisions/") else ():
            if row["kind"] == "IF":
                value = row["value"]
                sign = 0 if value in ("0", "-0") else -1 if value.startswith("-") else 1
                assert sign == int(row["outcome"]), row


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "expected a program with --to, or --benchmark DIR"),
        (["program1"], "expected a program with --to"),
        (["program1", "--to", "c", "--benchmark", "x"], "omit the program, --to, --layers, --upcase and -o"),
        (["--benchmark", "x", "-o", "y"], "omit the program, --to, --layers, --upcase and -o"),
        (["thesis", "--to", "fpcore", "--upcase"], "--layers and --upcase apply to programs only"),
        (["thesis", "--to", "c"], "thesis is a document; its formulas can only be written with --to fpcore"),
    ],
)
def test_wrong_arguments_are_reported(arguments: list[str], message: str, capsys) -> None:
    assert main(["translate", *arguments]) == 2
    assert message in capsys.readouterr().err


def test_command_writes_each_language(capsys) -> None:
    for program, language, first in (
        ("program1", "c", "/* program1.f, translated"),
        ("program1", "fortran", "! program1.f, translated"),
        ("program1", "fpcore", "; program1.f, card 12"),
        ("thesis", "fpcore", "; Formulas of thesis"),
    ):
        assert main(["translate", program, "--to", language]) == 0
        assert capsys.readouterr().out.startswith(first)
