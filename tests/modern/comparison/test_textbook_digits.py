"""Textbook cases of numerical error in stochastic binary arithmetic, against their published significant digits.

CADNA's outputs are those of its examples, http://cadna.lip6.fr/Examples_Dir/ (ex1.php to ex6.php).
"""

from fractions import Fraction
from math import log10

from emulator.language.cards import deck_from_lines
from emulator.language.compiler import compile_deck
from emulator.numbers.sampled import SampledNumbers
from emulator.numbers.stochastic import stochastic
from modern.comparison.sampling import Printed, in_step


def printed(name: str, *lines: str, data: tuple[str, ...] = ()) -> tuple[Printed, ...]:
    """Return the numbers that a program prints in stochastic runs in step."""
    cards = [line if line[:5].strip().isdigit() else f"      {line}" for line in (*lines, "END")]
    numbers = stochastic(name)
    assert isinstance(numbers, SampledNumbers)
    return in_step(compile_deck(deck_from_lines("program", cards)), deck_from_lines("deck", data), numbers).printed


def digits(number: Printed) -> float:
    """Return the digits that CADNA prints: CESTAC's estimate, 0 for a computational zero."""
    assert number.estimate is not None
    return 0.0 if number.estimate.is_zero else number.estimate.cestac


SEEDS = range(1, 60, 10)
RUMP = ("P=9.*X*X*X*X-Y*Y*Y*Y+2.*Y*Y", "TYPE 1,P", "    1 FORMAT(E20.12)")


def test_rumps_polynomial_has_no_digit_at_one_point_and_fifteen_at_another() -> None:
    """S. M. Rump 1983; CADNA, example 1: P(10864, 18817) = @.0 and P(1/3, 2/3) = 0.802469135802469."""
    for seed in SEEDS:
        name = f"stochastic:53b:{seed}-{seed + 2}"
        assert digits(printed(name, "X=10864.", "Y=18817.", *RUMP)[0]) == 0
        assert abs(digits(printed(name, "X=1./3.", "Y=2./3.", *RUMP)[0]) - 15) <= 1


def test_rumps_royal_pain_has_no_digit() -> None:
    """S. M. Rump 1988: -0.827396059946821 (54767/66192); double precision gives another sign or 1E21."""
    (value,) = printed(
        "stochastic:53b:1-10",
        *("A=77617.", "B=33096.", "B2=B*B", "B4=B2*B2", "B6=B4*B2", "B8=B4*B4"),
        "F=333.75*B6+A*A*(11.*A*A*B2-B6-121.*B4-2.)+5.5*B8+A/(2.*B)",
        *("TYPE 1,F", "    1 FORMAT(E20.12)"),
    )
    assert digits(value) == 0


def test_mullers_recurrence_has_no_digit_after_iteration_15() -> None:
    """J.-M. Muller 1989; CADNA, example 4: no significant result in double precision after iteration 15."""
    values = printed(
        "stochastic:53b:1-10",
        *("A=5.5", "B=61./11.", "DO 2 I=3,25", "C=B", "B=111.-1130./B+3000./(A*B)", "A=C", "    2 TYPE 1,B"),
        "    1 FORMAT(E20.12)",
    )
    estimated = {iteration: digits(value) for iteration, value in enumerate(values, 3)}
    assert estimated[3] > 13
    assert max(estimated[iteration] for iteration in (16, 17)) <= 1
    assert estimated[13] > 0


def test_newtons_method_at_a_double_root_keeps_eight_digits() -> None:
    """CADNA, example 5: x(24) = 0.42857143 for the double root 3/7."""
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
    *("   20 CONTINUE", "DO 21 J=I,5", "Q=A(I,J)", "A(I,J)=A(L,J)", "   21 A(L,J)=Q", "P=A(I,I)", "M=I+1"),
    *("DO 22 J=M,5", "   22 A(I,J)=A(I,J)/P", "DO 40 K=M,4", "P=A(K,I)", "DO 40 J=M,5"),
    *("   40 A(K,J)=A(K,J)-P*A(I,J)", "A(4,5)=A(4,5)/A(4,4)", "DO 50 N=1,3", "I=4-N", "M=I+1", "DO 50 J=M,4"),
    *("   50 A(I,5)=A(I,5)-A(I,J)*A(J,5)", "DO 60 I=1,4", "   60 TYPE 61,A(I,5)", "   61 FORMAT(E16.8)"),
)
SYSTEM = (
    "         21.        130.          0.         2.1       153.1",
    "         13.         80.    4.74E+08        752.      849.74",
    "          0.         -.4  3.9816E+08         4.2      7.7816",
    "          0.          0.         1.7      9.E-09     2.6E-08",
)


def test_linear_system_of_cadna_has_three_four_six_and_seven_digits_in_single_precision() -> None:
    """CADNA, example 6: 0.999, 1.000, 0.999999E-8 and 1.000000, because @.0 is not taken as a pivot.

    If the three runs agree on the pivot by chance, the first three numbers have no digit.
    """
    estimates = []
    for seed in SEEDS:
        values = printed(f"stochastic:24b:{seed}-{seed + 2}", *GAUSS, data=SYSTEM)
        estimates.append([digits(value) for value in values])
        if max(estimates[-1][:3]) > 1:
            for value, exact, published in zip(values, ("1", "1", "1E-8", "1"), (3, 4, 6, 7), strict=True):
                assert abs(digits(value) - published) <= 1.1
                assert value.estimate is not None
                assert abs(value.estimate.mean / Fraction(exact) - 1) < Fraction(1, 10 ** (published - 2))
    assert sum(max(row[:3]) > 1 for row in estimates) >= len(SEEDS) / 2


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


def test_discriminant_of_cadnas_quadratic_has_no_digit() -> None:
    """CADNA, example 2: the discriminant of .3 x**2 - 2.1 x + 3.675 is 0, which standard arithmetic does not find."""
    lines = ("A=.3", "B=-2.1/A", "C=3.675/A", "D=B*B-4.*C", "TYPE 1,D", "    1 FORMAT(E16.8)")
    assert max(digits(printed(f"stochastic:24b:{seed}-{seed + 2}", *lines)[0]) for seed in SEEDS) < 1


def test_digits_of_the_determinant_of_a_hilbert_matrix_are_its_true_digits_within_one() -> None:
    """CADNA, example 3, shows the gradual loss at size 11; the exact determinant is the reciprocal of OEIS A005249."""
    (value,) = printed(
        "stochastic:53b:1-3",
        *("DIMENSION A(11,11)", "N=11", "DO 1 I=1,N", "DO 1 J=1,N", "K=I+J-1", "P=K", "    1 A(I,J)=1./P"),
        *("D=1.", "L=N-1", "DO 3 I=1,L", "P=A(I,I)", "D=D*P", "M=I+1", "DO 2 J=M,N", "    2 A(I,J)=A(I,J)/P"),
        *("DO 3 J=M,N", "Q=A(J,I)", "DO 3 K=M,N", "    3 A(J,K)=A(J,K)-Q*A(I,K)", "D=D*A(N,N)", "TYPE 4,D"),
        "    4 FORMAT(E16.8)",
    )
    assert value.estimate is not None
    assert abs(digits(value) + log10(abs(float(value.estimate.mean / Fraction("3.0190953345e-65") - 1)))) <= 1
