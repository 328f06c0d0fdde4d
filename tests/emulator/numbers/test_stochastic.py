"""Stochastic arithmetic: against Python's decimal and binary floats, against theory, and the same in every engine."""

import math
import random
from collections.abc import Callable, Iterator
from decimal import ROUND_DOWN, Context, Decimal
from fractions import Fraction
from statistics import fmean

import pytest

from emulator.compiled.batch import run_batch
from emulator.errors import ArgumentError
from emulator.language.cards import deck_from_lines
from emulator.language.compiler import compile_deck
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from emulator.numbers import Trap, numbers
from emulator.numbers.stochastic import StochasticBinaryNumbers
from modern.port.points import fixed_arithmetic
from modern.port.procedure import convex_hull

RULES = ("", ":proportional")
WIDE = Context(prec=450, Emax=10**6, Emin=-(10**6))
EXACTLY: dict[str, Callable[[Decimal, Decimal], Decimal]] = {
    "add": WIDE.add,
    "subtract": WIDE.subtract,
    "subtract_reversed": lambda a, b: WIDE.subtract(b, a),
    "multiply": WIDE.multiply,
    "divide": WIDE.divide,
    "SQRT": lambda a, b: WIDE.sqrt(abs(a)),
}


def murmur(h: int) -> int:
    for shift, factor in ((16, 0x85EBCA6B), (13, 0xC2B2AE35)):
        h = (h ^ h >> shift) * factor % 2**32
    return h ^ h >> 16


def drawn(seed: int, count: int) -> Decimal:
    """Return the documented random number as a fraction of 1."""
    return Decimal(10**8 * murmur(murmur(count) ^ murmur(seed ^ 0x9E3779B9)) // 2**32).scaleb(-8)


def rounds_up(cut: Decimal, number: Decimal, rule: str) -> bool:
    return cut > 0 and (cut > number if rule else number >= Decimal("0.5"))


def rounded(exact: Decimal, digits: int, rule: str, number: Decimal) -> Decimal:
    """Round to the given digits as the documentation says, with decimal's own truncation."""
    low = Context(prec=digits, rounding=ROUND_DOWN, Emax=10**6, Emin=-(10**6)).plus(exact)
    unit = Decimal((0, (1,), low.adjusted() - digits + 1))
    cut = WIDE.divide(abs(WIDE.subtract(exact, low)), unit)
    return WIDE.add(low, unit.copy_sign(exact)) if rounds_up(cut, number, rule) else low


def operations(digits: int, reach: int, count: int) -> Iterator[tuple[str, tuple[int, int], tuple[int, int]]]:
    """Yield random operations; every tenth cancels leading digits."""
    chance = random.Random(digits * 1000 + reach)
    for k in range(count):
        first, second = (
            (chance.choice((1, -1)) * chance.randrange(10 ** (digits - 1), 10**digits), chance.randint(-reach, reach))
            for _ in range(2)
        )
        if k % 10 == 0 and 10 ** (digits - 1) < abs(first[0]) < 10**digits - 1:
            second = -first[0] + chance.choice((0, 1, -1)), first[1]
        yield chance.choice(list(EXACTLY)), first, second


def decimal_mismatches(digits: int, rule: str, reach: int, count: int) -> list[object]:
    seed = digits + reach
    system = numbers(f"stochastic:{digits}:{seed}{rule}")
    mismatches: list[object] = []
    for n, (operation, first, second) in enumerate(operations(digits, reach, count), 1):
        a, b = (Decimal(m).scaleb(e - digits, WIDE) for m, e in (first, second))
        try:
            m, e = (
                system.function("SQRT", first)[0] if operation == "SQRT" else getattr(system, operation)(first, second)
            )
        except Trap:
            continue
        exact = EXACTLY[operation](a, b)
        expected = rounded(exact, digits, rule, drawn(seed, n)) if exact else exact
        if Decimal(m).scaleb(e - digits, WIDE) != expected:
            mismatches.append((operation, first, second))
    return mismatches


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("digits", [2, 8, 9, 28])
def test_decimal_results_equal_those_of_pythons_decimal(digits: int, rule: str) -> None:
    assert not decimal_mismatches(digits, rule, 4, 300)
    assert not decimal_mismatches(digits, rule, 40, 300)


@pytest.mark.parametrize("rule", RULES)
def test_binary_results_are_the_neighbouring_doubles_that_the_draws_choose(rule: str) -> None:
    system, chance = numbers(f"stochastic:53b:7{rule}"), random.Random(7)
    assert isinstance(system, StochasticBinaryNumbers)
    for n in range(1, 600):
        a, b = (chance.uniform(-1, 1) * 2.0 ** chance.randint(-9, 9) for _ in range(2))
        operation = chance.choice(("add", "subtract", "multiply", "divide"))
        x, y = Fraction(a), Fraction(b)
        exact = {"add": x + y, "subtract": x - y, "multiply": x * y, "divide": x / y}[operation]
        low = float(exact)
        if abs(Fraction(low)) > abs(exact):
            low = math.nextafter(low, 0.0)
        high = math.nextafter(low, math.copysign(math.inf, exact))
        cut = (exact - Fraction(low)) / (Fraction(high) - Fraction(low))
        is_up = rounds_up(WIDE.divide(Decimal(cut.numerator), Decimal(cut.denominator)), drawn(7, n), rule)
        first, second = (system.nearest(*v.as_integer_ratio()) for v in (a, b))
        assert float(getattr(system, operation)(first, second)) == (high if is_up else low)


def errors(name: str, count: int) -> Iterator[tuple[float, float]]:
    """Yield the error of products in units of the last digit, and the part f of the exact product that is cut."""
    system, chance = numbers(name), random.Random(11)
    for _ in range(count):
        a, b = (chance.randrange(10**7, 10**8) for _ in range(2))
        m, e = system.multiply((a, 0), (b, 0))
        unit = 10 ** (8 + e)
        yield (m * unit - a * b) / unit, a * b % unit / unit


@pytest.mark.parametrize(("rule", "square"), [("", 1 / 3), (":proportional", 1 / 6)])
def test_mean_and_variance_of_rounding_errors_are_those_of_theory(rule: str, square: float) -> None:
    """For f uniform in [0, 1): CESTAC has the mean 1/2 - f and mean square 1/3, proportional rounding 0 and 1/6."""
    pairs = list(errors(f"stochastic:8:3{rule}", 20_000))
    centred = [error - (0 if rule else 0.5 - f) for error, f in pairs]
    assert abs(fmean(centred)) < 3 * math.sqrt(fmean(c * c for c in centred) / len(pairs))
    squares = [error * error for error, _ in pairs]
    spread = math.sqrt((fmean(s * s for s in squares) - fmean(squares) ** 2) / len(pairs))
    assert abs(fmean(squares) - square) < 3 * spread


@pytest.mark.parametrize(("rule", "share"), [("", 0.5), (":proportional", 0.2)])
def test_share_of_results_rounded_up_over_the_seeds(rule: str, share: float) -> None:
    """1 + 0.2 units of the last digit is rounded up with probability 1/2, or 0.2."""
    results = [numbers(f"stochastic:8:{seed}{rule}").add((10**7, 1), (2 * 10**7, -7)) for seed in range(4_000)]
    assert abs(fmean(m - 10**7 for m, _ in results) - share) < 3 * math.sqrt(share * (1 - share) / 4_000)


@pytest.mark.parametrize("rule", RULES)
def test_functions_and_powers_round_the_exact_result_at_random(rule: str) -> None:
    for operation, operand, exact in (
        ("EXP", (10**7, 1), Decimal(1).exp()),
        ("LOG", (2 * 10**7, 1), WIDE.ln(Decimal(2))),
        (2, (12345678, 1), Decimal("1.2345678") ** 2),
        (-3, (3 * 10**7, 1), WIDE.power(Decimal(3), -3)),
        (5, (11 * 10**6, 1), Decimal("1.61051")),
    ):
        for seed in range(40):
            system = numbers(f"stochastic:8:{seed}{rule}")
            function = (
                system.integer_power if isinstance(operation, int) else lambda x, name, s=system: s.function(name, x)
            )
            (m, e), code = function(operand, operation)
            assert not code
            assert Decimal(m).scaleb(e - 8) == rounded(exact, 8, rule, drawn(seed, 1))


LOOP = (
    *("      S=0.", "      A=.1", "      DO 5 I=1,60", "      A=A*1.0123-.3", "      C=SQRT(A*A/7.+S)"),
    *("      IF(A-1.)5,4,4", "    4 A=A**2-A**(-1)", "    5 S=S+C-A/3.", "      PUNCH 1,S,A", "    1 FORMAT(2E16.8)"),
    "      END",
)


@pytest.mark.parametrize("name", ["stochastic:8:1", "stochastic:9:2:proportional", "stochastic:2:3:proportional"])
def test_interpreter_and_compiled_engine_take_the_same_random_numbers(name: str) -> None:
    program, empty = compile_deck(deck_from_lines("loop", LOOP)), deck_from_lines("deck", [])
    options, notes = Options(numbers=numbers(name)), list[str]()
    first, second = run_batch(program, [empty, empty], options, notes.append)
    assert first == second == Machine(program, empty, options).run()
    assert not [note for note in notes if "stochastic" in note]


def test_runs_with_other_seeds_differ_and_each_run_begins_again() -> None:
    program, empty = compile_deck(deck_from_lines("loop", LOOP)), deck_from_lines("deck", [])
    options = [Options(numbers=numbers(f"stochastic:{width}:{seed}")) for width in ("8", "53b") for seed in (1, 2)]
    cards = [Machine(program, empty, option).run().punched for option in options]
    assert len(set(cards[:2])) == 2
    assert cards == [Machine(program, empty, option).run().punched for option in options]


@pytest.mark.parametrize("name", ["stochastic:8:1", "stochastic:53b:4:proportional"])
def test_port_calculates_with_stochastic_numbers(name: str) -> None:
    arithmetic = fixed_arithmetic(name)
    assert arithmetic is not None
    assert arithmetic.name == name
    third = arithmetic.quotient(arithmetic.number(1), 3)
    assert 0 < abs(arithmetic.exact(third, 1) - Fraction(1, 3)) < Fraction(1, 10**8)
    assert len(convex_hull([(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4), (1, 1, 1)], name).vertices) == 4


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("stochastic:8", "expected stochastic:P:SEED for P decimal digits, or stochastic:BITSb:SEED for BITS bits"),
        ("stochastic:8:1:up", "only :proportional may follow"),
        ("stochastic:8:1:", "only :proportional may follow"),
        ("stochastic:1:1", "the number of digits must be 2 to 28"),
        ("stochastic:1b:1", "the number of bits must be 2 to 100000"),
        ("stochastic:8:4294967296", "the seed must be 0 to 4294967295"),
        ("stochastics:8:1", "stochastic:P:SEED"),
    ],
)
def test_incomplete_names_are_explained(name: str, message: str) -> None:
    with pytest.raises(ArgumentError, match=message):
        numbers(name)
