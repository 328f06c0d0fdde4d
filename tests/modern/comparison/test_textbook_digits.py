"""Textbook cases of numerical error in stochastic binary arithmetic, against their published significant digits.

The examples of CADNA and their outputs are those of "CADNA for C/C++ source codes", LIP6, 2015, section 4.2 (the user's
guide, also docs/ug_cadna.pdf in github.com/thelfer/cadna at 6795a76), and of http://cadna.lip6.fr/Examples_Dir/.  CADNA
prints the estimate rounded to an integer, and at most 7 or 15 digits.  The estimate of three runs varies with the seed,
so medians over several seeds are compared.  docs/how-to/numerical-tools.md states the counts.
"""

from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import cache
from math import log10
from statistics import median

from emulator.language.cards import deck_from_lines
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program
from emulator.numbers.sampled import SampledNumbers
from emulator.numbers.stochastic import stochastic
from modern.comparison.sampling import Printed, in_step
from tests.support.paths import ROOT


@cache
def compiled(*lines: str) -> Program:
    cards = [line if line[:5].strip().isdigit() else f"      {line}" for line in (*lines, "END")]
    return compile_deck(deck_from_lines("program", cards))


def printed(name: str, *lines: str, data: tuple[str, ...] = ()) -> tuple[Printed, ...]:
    """Return the numbers that a program prints in stochastic runs in step."""
    numbers = stochastic(name)
    assert isinstance(numbers, SampledNumbers)
    return in_step(compiled(*lines), deck_from_lines("deck", data), numbers).printed


def digits(number: Printed) -> float:
    """Return the digits that CADNA prints: CESTAC's estimate, 0 for a computational zero."""
    assert number.estimate is not None
    return 0.0 if number.estimate.is_zero else number.estimate.cestac


SEEDS = range(1, 60, 10)


def printed_in_runs(
    bits: int, *lines: str, seeds: Iterable[int] = SEEDS, data: tuple[str, ...] = ()
) -> list[list[float]]:
    """Return the digits of every printed number, for three runs in step from each seed."""
    return [list(map(digits, printed(f"stochastic:{bits}b:{s}-{s + 2}", *lines, data=data))) for s in seeds]


def assert_within_one(runs: list[list[float]], published: Sequence[int], most: int) -> str:
    """Compare the medians with the published digits.  Return how many numbers of all runs are within one digit."""
    for estimates, number in zip(zip(*runs, strict=True), published, strict=True):
        assert abs(min(round(median(estimates)), most) - number) <= 1
    near = sum(abs(min(round(e), most) - n) <= 1 for run in runs for e, n in zip(run, published, strict=True))
    return f"{near:,} of {len(runs) * len(published):,} results of single seeds"


def assert_documented(example: int, count: str) -> None:
    lines = (ROOT / "docs/how-to/numerical-tools.md").read_text(encoding="utf-8").splitlines()
    (row,) = (line for line in lines if line.startswith(f"| {example}, "))
    assert count in row, count


RUMP = ("P=9.*X*X*X*X-Y*Y*Y*Y+2.*Y*Y", "TYPE 1,P", "    1 FORMAT(E20.12)")


def test_rumps_polynomial_has_no_digit_at_one_point_and_fifteen_at_another() -> None:
    """S. M. Rump 1983; CADNA's site, example 1: P(10864, 18817) = @.0 and P(1/3, 2/3) = 0.802469135802469."""
    for seed in SEEDS:
        name = f"stochastic:53b:{seed}-{seed + 2}"
        assert digits(printed(name, "X=10864.", "Y=18817.", *RUMP)[0]) == 0
        assert abs(digits(printed(name, "X=1./3.", "Y=2./3.", *RUMP)[0]) - 15) <= 1


def test_rumps_royal_pain_has_no_digit() -> None:
    """S. M. Rump 1988; CADNA, example 1: res = @.0.  The exact value is -54767/66192."""
    (value,) = printed(
        "stochastic:53b:1-10",
        *("A=77617.", "B=33096.", "B2=B*B", "B4=B2*B2", "B6=B4*B2", "B8=B4*B4"),
        "F=333.75*B6+A*A*(11.*A*A*B2-B6-121.*B4-2.)+5.5*B8+A/(2.*B)",
        *("TYPE 1,F", "    1 FORMAT(E20.12)"),
    )
    assert digits(value) == 0


def test_mullers_recurrence_has_the_digits_that_cadna_prints() -> None:
    """J.-M. Muller 1989; CADNA, example 4: U(3) = 0.55901639344262E+001 to U(30) = 0.100000000000000E+003.

    The numbers after U(17) have digits again, but of a wrong limit: 100 instead of 6.
    """
    published = [14, 13, 12, 11, 9, 8, 7, 6, 4, 3, 2, 1, 0, 0, 0, 1, 3, 4, 5, 6, 8, 9, 10, 11, 12, 14, 15, 15]
    lines = ("A=5.5", "B=61./11.", "DO 2 I=3,30", "C=B", "B=111.-1130./B+3000./(A*B)", "A=C", "    2 TYPE 1,B")
    assert_documented(4, assert_within_one(printed_in_runs(53, *lines, "    1 FORMAT(E20.12)"), published, 15))


def test_newtons_method_at_a_double_root_keeps_eight_digits() -> None:
    """CADNA's site, example 5: x(24) = 0.42857143 for the double root 3/7."""
    values = printed(
        "stochastic:53b:1-3",
        *("Y=.5", "DO 2 I=1,100", "X=Y"),
        "Y=X-(1.47*X**3+1.19*X**2-1.83*X+.45)/(4.41*X**2+2.38*X-1.83)",
        *("D=X-Y", "IF(D)4,3,5", "    4 D=-D", "    5 IF(D-1.E-12)3,2,2", "    2 CONTINUE", "    3 TYPE 1,Y"),
        "    1 FORMAT(E20.12)",
    )
    assert abs(digits(values[0]) - 8) <= 1


GAUSS = (
    *("DIMENSION A(4,5)", "READ 1,((A(I,J),J=1,5),I=1,4)", "    1 FORMAT(5E12.5)", "DO 40 I=1,3", "P=0.", "L=I"),
    *("DO 20 J=I,4", "Q=A(J,I)", "IF(Q)11,12,12", "   11 Q=-Q", "   12 IF(Q-P)20,20,13", "   13 P=Q", "L=J"),
    *("   20 CONTINUE", "DO 21 J=I,5", "Q=A(I,J)", "A(I,J)=A(L,J)", "   21 A(L,J)=Q", "P=1./A(I,I)", "M=I+1"),
    *("DO 22 J=M,5", "   22 A(I,J)=A(I,J)*P", "DO 40 K=M,4", "P=A(K,I)", "DO 40 J=M,5"),
    *("   40 A(K,J)=A(K,J)-P*A(I,J)", "A(4,5)=A(4,5)/A(4,4)", "DO 50 N=1,3", "I=4-N", "M=I+1", "DO 50 J=M,4"),
    *("   50 A(I,5)=A(I,5)-A(I,J)*A(J,5)", "DO 60 I=1,4", "   60 TYPE 61,A(I,5)", "   61 FORMAT(E16.8)"),
)
SYSTEM = (
    "         21.        130.          0.         2.1       153.1",
    "         13.         80.    4.74E+08        752.      849.74",
    "          0.         -.4  3.9816E+08         4.2      7.7816",
    "          0.          0.         1.7      9.E-09     2.6E-08",
)


def test_linear_system_of_cadna_has_its_digits_in_single_precision() -> None:
    """CADNA, example 6: 0.99E+000, 0.100E+001, 0.999999E-008, 0.100000E+001, because @.0 is not taken as a pivot."""
    runs = printed_in_runs(24, *GAUSS, seeds=range(1, 60, 3), data=SYSTEM)
    assert_documented(6, assert_within_one(runs, (2, 3, 6, 6), 7))
    assert min(map(min, runs)) > 1.5
    for value, exact in zip(printed("stochastic:24b:1-3", *GAUSS, data=SYSTEM), ("1", "1", "1E-8", "1"), strict=True):
        assert value.estimate is not None
        assert abs(value.estimate.mean / Fraction(exact) - 1) < Fraction(1, 10)


def test_quadratic_of_kahan_has_half_the_digits() -> None:
    """W. Kahan 2004, On the cost of floating-point computation: of the root 1.000000028975958 half the digits."""
    values = printed(
        "stochastic:53b:1-10",
        *("A=94906265.625", "B=-189812534.", "C=94906268.375", "D=B*B-4.*A*C", "IF(D)2,3,3", "    2 D=0."),
        *("    3 X=(-B+SQRT(D))/(2.*A)", "TYPE 1,X", "    1 FORMAT(E20.12)"),
    )
    assert abs(digits(values[0]) - 8) <= 1
    assert values[0].estimate is not None
    assert abs(values[0].estimate.mean - Fraction("1.000000028975958")) < Fraction(1, 10**7)


def test_discriminant_of_cadnas_quadratic_is_zero_and_its_root_has_seven_digits() -> None:
    """CADNA, example 2, .3 x**2 - 2.1 x + 3.675: d = @.0, and the double solution is 0.3499999E+001.

    Doubles find two complex roots.  In a few runs, all three discriminants are equal by chance.
    """
    lines = ("A=.3", "B=-2.1/A", "C=3.675/A", "D=B*B-4.*C", "TYPE 1,D", "IF(D)3,2,3", "    2 X=-B*.5", "TYPE 1,X")
    runs = printed_in_runs(24, *lines, "    3 STOP", "    1 FORMAT(E16.8)", seeds=range(1, 90, 3))
    double = [estimates for estimates in runs if len(estimates) == 2]
    assert len(double) >= 0.85 * len(runs)
    assert_documented(2, f"{len(double)} of {len(runs)} seeds")
    assert_within_one(double, (0, 7), 7)


def test_pivots_and_determinant_of_a_hilbert_matrix_have_the_digits_that_cadna_prints() -> None:
    """CADNA, example 3: pivots 0.100000000000000E+001 to 0.13E-011, determinant 0.30E-064.

    The exact determinant is the reciprocal of an entry of OEIS A005249.
    """
    lines = (
        *("DIMENSION A(11,11)", "N=11", "DO 1 I=1,N", "DO 1 J=1,N", "K=I+J-1", "P=K", "    1 A(I,J)=1./P"),
        *("D=1.", "L=N-1", "DO 3 I=1,L", "TYPE 4,A(I,I)", "D=D*A(I,I)", "X=1./A(I,I)", "M=I+1", "DO 2 J=M,N"),
        *("    2 A(I,J)=A(I,J)*X", "DO 3 J=M,N", "X=A(J,I)", "DO 3 K=M,N", "    3 A(J,K)=A(J,K)-X*A(I,K)"),
        *("TYPE 4,A(N,N)", "D=D*A(N,N)", "TYPE 4,D", "    4 FORMAT(E16.8)"),
    )
    published = (15, 15, 14, 12, 11, 9, 8, 7, 6, 4, 2, 2)
    assert_documented(3, assert_within_one(printed_in_runs(53, *lines), published, 15))
    value = printed("stochastic:53b:1-3", *lines)[-1]
    assert value.estimate is not None
    assert abs(digits(value) + log10(abs(float(value.estimate.mean / Fraction("3.0190953344493e-65") - 1)))) <= 1


def test_share_of_runs_that_agree_on_a_wrong_number_is_cadnas() -> None:
    """CADNA, example 7, "when CADNA fails": 24,666 of 100,000 computations have no digit lost and a wrong result."""
    lines = ("X=6.83561E+5", "Y=6.83560E+5", "Z=1.00000000007", "R=Z-X", "S=Z-Y", "R=R+Y", "S=S+X", "S=S-2.", "R=R+S")
    runs = printed_in_runs(53, *lines, "TYPE 1,R", "    1 FORMAT(E20.12)", seeds=range(1, 600, 3))
    wrong = sum(estimates[0] > 1 for estimates in runs)
    assert abs(wrong / len(runs) - 0.24666) <= 3 * (0.24666 * 0.75334 / len(runs)) ** 0.5
    assert_documented(7, f"{wrong} of {len(runs)}")
