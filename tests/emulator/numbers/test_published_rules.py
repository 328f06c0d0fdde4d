"""The published vectors compared with the rules that state them, their table of counts, and changed rules."""

import ast
from collections import Counter

import pytest

from emulator.numbers.arithmetic import FAMILIES, MAX_DIGITS, MIN_DIGITS, Profile, Rules, profile
from emulator.numbers.arithmetic import PROFILES as OF_THE_TIME
from emulator.numbers.base import Trap
from emulator.numbers.decimal import DecimalNumbers, Pair
from tests.support.paths import PUBLISHED, ROOT
from tests.support.published import specification as spec
from tests.support.published.lines import SUFFIX, Vector, load, names, parsed
from tests.support.published.results import RULES

ANY = "any"
"""The profile of the operations whose results are the same under every profile."""
PROFILES = sorted({vector.profile for name in names() for vector in load(name)} - {ANY})


@pytest.mark.parametrize("operation", sorted(RULES))
def test_every_published_line_follows_from_the_rules(operation: str) -> None:
    for vector in load(operation):
        by = spec.arithmetic("truncating" if vector.profile == ANY else vector.profile)
        assert RULES[operation](vector.operands, by) == (vector.result, vector.code), vector
        assert vector.digits == (0 if vector.profile == ANY else by.digits)


def test_published_files_cover_every_operation_rule_and_error_code() -> None:
    assert names() == sorted(RULES)
    assert {path.name for path in PUBLISHED.iterdir() if path.suffix != SUFFIX} == {"README.md", "counts.tsv"}
    # The rules of ``truncating1962`` are those of ``truncating`` and ``ibm1962``.
    assert set(OF_THE_TIME) - {"truncating1962"} <= set(PROFILES)
    assert {f"{name.partition(':')[0]}:P" for name in PROFILES if ":" in name} == set(FAMILIES)
    assert {MIN_DIGITS, MAX_DIGITS} <= {profile(name).digits for name in PROFILES}
    codes = set()
    for name in names():
        for vector in load(name):
            assert vector.operation == name
            codes.add(vector.code)
    assert codes == {"", *(f"E{n}" for n in range(1, 9)), "F8", "INVALID", "RANGE"}


def test_counts_table_matches_the_vectors() -> None:
    header, *lines = (PUBLISHED / "counts.tsv").read_text(encoding="ascii").splitlines()
    operation, kind, *profiles = header.split("\t")
    assert (operation, kind) == ("operation", "class")
    stated = Counter[tuple[str, str, str]]()
    for line in lines:
        name, kind, *counts = line.split("\t")
        stated.update({(name, profile, kind): int(count) for profile, count in zip(profiles, counts, strict=True)})
    assert +stated == table()


def test_rules_do_not_import_the_emulator() -> None:
    folder = ROOT / "tests" / "support" / "published"
    for path in folder.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            imported = [node.module or ""] if isinstance(node, ast.ImportFrom) else []
            imported += [name.name for name in node.names] if isinstance(node, ast.Import) else []
            for name in imported:
                assert name.partition(".")[0] not in ("emulator", "modern"), f"{path.name} imports {name}"
                own = name.startswith("tests.support.published")
                assert own or not name.startswith("tests") or name == "tests.support.paths", f"{path.name}: {name}"


def table() -> Counter[tuple[str, str, str]]:
    """Return the number of lines of each operation, profile and class."""
    return Counter((v.operation, v.profile, v.kind) for name in names() for v in load(name))


@pytest.mark.parametrize(
    "line",
    [
        "add1 add .1E+01 .1E+01",
        "add1 add .1E+01 .1E+01 ->",
        "add1 -> .1E+01",
        "add1 add .1E+01 -> .1E+01 E1 E2",
        "add0 add .1E+01 -> .1E+01",
    ],
)
def test_invalid_line_is_rejected_with_its_number(line: str) -> None:
    valid = "version: 1\nprofile: truncating\ndigits: 8\nclass: plain\nadd0 add .1E+01 .1E+01 -> .2E+01\n"
    assert len(list(parsed(valid))) == 1
    with pytest.raises(ValueError, match="line 6"):
        list(parsed(valid + line))
    with pytest.raises(ValueError, match="line 1"):
        list(parsed("add0 add .1E+01 .1E+01 -> .2E+01"))


def number(text: str, digits: int) -> Pair:
    mantissa, _, exponent = text.replace(".", "").partition("E")
    if not int(mantissa):
        return 0, -100 if text.startswith("-") else -99
    return int(mantissa), int(exponent)


def calculate(system: DecimalNumbers, vector: Vector) -> tuple[Pair, str]:
    """Return the result and error code of a number system for a vector."""
    a, *rest = vector.operands
    first = number(a, vector.digits)
    if vector.operation == "power":
        return system.integer_power(first, int(rest[0]))
    if vector.operation == "squareroot":
        return system.function("SQRT", first)
    operation = {"subtractfrom": system.subtract_reversed}.get(vector.operation) or getattr(system, vector.operation)
    try:
        return operation(first, number(rest[0], vector.digits)), ""
    except Trap as trap:
        return trap.value, f"E{trap.event}"


CALCULATIONS = ("add", "subtract", "subtractfrom", "multiply", "divide", "power", "squareroot")


def differs(rules_tried: Profile) -> bool:
    """Return True if any published vector of a profile has another result under the given rules."""
    system = DecimalNumbers(rules_tried)
    vectors = (v for name in CALCULATIONS for v in load(name) if v.profile == rules_tried.name)
    return any(calculate(system, v) != (number(v.result, v.digits), v.code) for v in vectors)


@pytest.mark.parametrize("name", PROFILES)
def test_unchanged_rules_give_every_line(name: str) -> None:
    assert not differs(profile(name))


GUARD, STICKY, SUMS, PRODUCTS, QUOTIENTS = Rules._fields[3:8]
AS_1962 = Rules._fields[8]
CHANGES = [
    *(
        (name, rule, 1)
        for name in ("truncating", "truncating:4", "truncating:28")
        for rule in (GUARD, PRODUCTS, QUOTIENTS)
    ),
    *((name, GUARD, 0) for name in ("guarded:8", "guarded:4")),
    *(
        (name, rule, 0)
        for name in PROFILES
        if name.startswith("rounding")
        for rule in (STICKY, SUMS, PRODUCTS, QUOTIENTS)
        # With two digits, the two guard digits already decide the rounding of every sum.
        if (name, rule) != ("rounding:2", STICKY)
    ),
    *((name, GUARD, 1) for name in PROFILES if name.startswith("rounding")),
    *(("ibm1962", rule, 0) for rule in (PRODUCTS, AS_1962)),
    *(("ibm1962", rule, 1) for rule in (GUARD, QUOTIENTS)),
    ("truncating", AS_1962, 1),
]


@pytest.mark.parametrize(("name", "rule", "value"), CHANGES)
def test_vectors_detect_every_changed_rule(name: str, rule: str, value: int) -> None:
    rules = profile(name).rules
    assert getattr(rules, rule) != value
    assert differs(Profile(name, rules._replace(**{rule: value})))
