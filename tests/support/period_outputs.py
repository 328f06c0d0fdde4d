"""An independent computation of the output of the programs in tests/data/period, in fractions of eight digits.

It follows the rules of the manual and uses nothing of ``emulator``.  Numbers have eight digits, every result is
truncated, and the smaller operand of a sum is truncated before the addition.  Fields are those of C26-5619 p. 35 to 43,
as IBM's FORTRAN II-D prints them (tests/data/compiler_runs).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from fractions import Fraction
from math import isqrt

from tests.support.paths import DATA

PERIOD = DATA / "period"


def cut(x: Fraction) -> Fraction:
    """Return a number truncated to eight digits."""
    unit = Fraction(10) ** (exponent(x) - 8)
    return int(x / unit) * unit


def exponent(x: Fraction) -> int:
    """Return the exponent e of .dddddddd times ten to e."""
    e = 0
    while x and abs(x) >= Fraction(10) ** e:
        e += 1
    while x and abs(x) < Fraction(10) ** (e - 1):
        e -= 1
    return e


class Eight:
    """A floating-point number of eight digits."""

    def __init__(self, x: Fraction | int | str) -> None:
        self.x = cut(Fraction(x))

    def _with(self, other: Eight | float, take: Callable[[Fraction, Fraction], Fraction]) -> Eight:
        return Eight(take(self.x, number(other).x))

    def __add__(self, other: Eight | float) -> Eight:
        def add(a: Fraction, b: Fraction) -> Fraction:
            if not a or not b:
                return a + b
            unit = Fraction(10) ** (max(exponent(a), exponent(b)) - 8)
            return (int(a / unit) + int(b / unit)) * unit

        return self._with(other, add)

    def __sub__(self, other: Eight | float) -> Eight:
        return self + -number(other)

    def __mul__(self, other: Eight | float) -> Eight:
        return self._with(other, lambda a, b: a * b)

    def __truediv__(self, other: Eight | float) -> Eight:
        return self._with(other, lambda a, b: a / b)

    def __neg__(self) -> Eight:
        return Eight(-self.x)

    def root(self) -> Eight:
        return Eight(Fraction(isqrt(int(self.x * 10**60)), 10**30))


def number(value: Eight | float) -> Eight:
    """Return a constant of the program as a number."""
    return value if isinstance(value, Eight) else Eight(repr(value) if isinstance(value, float) else value)


def i_field(n: int, width: int) -> str:
    return str(n).rjust(width)


def e_field(value: Eight, width: int = 14, decimals: int = 8) -> str:
    """Return a nonzero number in an E field, with the digits before the point that fit (compiler_runs/e)."""
    before = min(8 - decimals, width - 6 - decimals)
    e = exponent(value.x)
    digits = str(abs(value.x) / Fraction(10) ** (e - 8)).ljust(8, "0")[: before + decimals]
    sign = "-" if value.x < 0 else ""
    return f"{sign}{digits[:before]}.{digits[before:]}E{e - before:+03d}".rjust(width)


def f_field(value: Eight, width: int, decimals: int) -> str:
    """Return an F field: no zero before the point, a column for the sign, and E14.8 if it does not fit (p. 39)."""
    digits = str(int(abs(value.x) * 10**decimals)).rjust(decimals, "0")
    text = f"{digits[: len(digits) - decimals]}.{digits[len(digits) - decimals :]}"
    return (("-" if value.x < 0 else "") + text).rjust(width) if len(text) < width else e_field(value)


Lines = tuple[list[str], list[str]]
"""The cards punched and the lines typed."""


def table(switches: frozenset[int]) -> Lines:
    cards: list[str] = []
    typed: list[str] = []
    for a, b, h in (("1", "3", ".5"), (".25", ".75", ".25"), ("-1234.5", "-1234", ".5")):
        start, end, step = Eight(a), Eight(b), Eight(h)
        n = int(((end - start) / step + 1.5).x)
        cards.append(f"TABLE FROM {f_field(start, 8, 3)} TO {f_field(end, 8, 3)}     {i_field(n, 4)} LINES")
        cards += ["", "  I       X      X*X            1/X        ROOT"]
        x = start
        for i in range(1, n + 1):
            magnitude = x if x.x > 0 else -x
            fields = f_field(x, 8, 2) + f_field(x * x, 9, 4) + e_field(number(1.0) / x, 16)
            line = fields + f_field(magnitude.root(), 12, 6)
            if 1 in switches:
                typed.append(line)
            else:
                cards.append(i_field(i, 3) + line)
            x = x + step
    return cards, [*typed, "END OF TABLES"]


def pi(switches: frozenset[int]) -> Lines:
    cards: list[str] = []
    typed: list[str] = []
    for smallest in (Eight(".001"), Eight("1E-9")):
        total = Eight(0)
        for j, (q, w) in enumerate(((5, 16), (239, -4)), 1):
            x = number(1.0) / Eight(q)
            t, s, k = x, Eight(0), 1
            while True:
                d = t / Eight(k)
                if (d * d - smallest * smallest).x < 0:
                    break
                s = s + d
                if 2 in switches:
                    typed.append(i_field(j, 4) + i_field(k, 4) + e_field(d, 16) + e_field(s, 16))
                t = -t * x * x
                k += 2
            total = total + Eight(w) * s
        cards.append(f"TERMS DOWN TO {e_field(smallest, 8, 1)}     PI ={f_field(total, 11, 7)}")
    return cards, typed


def fibon(switches: frozenset[int]) -> Lines:
    whole, floating = [1, 1], [Eight(1), Eight(1)]
    while len(whole) < 22:
        whole.append((whole[-1] + whole[-2]) % 10000)
    while len(floating) < 60:
        floating.append(floating[-1] + floating[-2])
    fields = [i_field(n, 6) for n in whole]
    cards = ["".join(fields[k : k + 5]) for k in range(0, 22, 5)]
    cards += ["", " 22 IN FIXED POINT"]
    fields = [i_field(n, 4) + e_field(floating[n - 1], 16) for n in range(5, 61, 5)]
    cards += ["".join(fields[k : k + 2]) for k in range(0, 12, 2)]
    g = floating[-1] / floating[-2]
    return [*cards, "", "RATIO" + f_field(g, 11, 7) + e_field(g, 12, 4) + e_field(g, 13, 7) + e_field(g, 20, 2)], []


CASES = (
    (1, 1, [("1", "2"), ("2", "4.1"), ("3", "5.9"), ("4", "8.2"), ("5", "9.7")]),
    (27, 100, [("1.2", "-.5"), ("1.5", "-.3"), ("1.1", ".2"), ("1.9", ".8"), ("1.6", ".7"), ("1.4", ".1")]),
    (3, 10, [("1", "3"), ("2", "2"), ("3", "1")]),
)
"""Case number, divisor of x, and pairs.  In the second case F6.2 reads the numbers as hundredths, y too."""


def stats(switches: frozenset[int]) -> Lines:
    cards: list[str] = []
    for case, scale, pairs in CASES:
        xs = [Eight(Fraction(x) / scale) for x, _ in pairs]
        ys = [Eight(Fraction(y) / (100 if scale == 100 else 1)) for _, y in pairs]
        sx = sy = sxx = syy = sxy = Eight(0)
        for x, y in zip(xs, ys, strict=True):
            sx, sy, sxx, syy, sxy = sx + x, sy + y, sxx + x * x, syy + y * y, sxy + x * y
        a = Eight(len(pairs))
        xm, ym = sx / a, sy / a
        sdx = ((sxx - sx * xm) / (a - 1.0)).root()
        sdy = ((syy - sy * ym) / (a - 1.0)).root()
        r = (sxy - sx * ym) / ((a - 1.0) * sdx * sdy)
        cards += ["", f"CASE {i_field(case, 4)}    {i_field(len(pairs), 3)} PAIRS"]
        if 3 in switches:
            fields = [
                i_field(k, 4) + f_field(x, 9, 3) + f_field(y, 9, 3)
                for k, (x, y) in enumerate(zip(xs, ys, strict=True), 1)
            ]
            cards += ["".join(fields[k : k + 2]) for k in range(0, len(pairs), 2)]
        for name, mean, deviation in (("X", xm, sdx), ("Y", ym, sdy)):
            cards.append(f"MEAN {name} ={f_field(mean, 10, 4)}  SD ={f_field(deviation, 10, 4)}")
        cards.append(f"R ={f_field(r, 9, 5)}")
    return cards, []


def job(switches: frozenset[int]) -> Lines:
    """Compute the four problems of job.operator: Newton, regula falsi step by step, no change of sign, no slope."""
    cards: list[str] = []
    typed = ["STUDENT  417", "TYPE P,Q,R THEN A,B"]
    p, q, r = Eight(0), Eight(-2), Eight(-5)

    def cubic(x: Eight) -> Eight:
        return ((x + p) * x + q) * x + r

    def report(x: Eight, steps: int) -> None:
        coefficients = f_field(p, 9, 3) + f_field(q, 9, 3) + f_field(r, 9, 3)
        cards.append(i_field(417, 4) + coefficients + f_field(x, 13, 7) + i_field(steps, 4))
        typed.append(f"ROOT {f_field(x, 12, 7)}   {i_field(steps, 3)} STEPS")

    x, steps = Eight(2), 0
    while True:
        steps += 1
        h = cubic(x) / ((number(3.0) * x + number(2.0) * p) * x + q)
        x = x - h
        if steps >= 20 or (h * h - Eight("1E-14")).x <= 0:
            break
    report(x, steps)
    a, b = Eight(2), Eight(3)
    fa, fb = cubic(a), cubic(b)
    steps = 0
    while True:
        x = (a * fb - b * fa) / (fb - fa)
        steps += 1
        f = cubic(x)
        typed.append(i_field(steps, 4) + e_field(x, 16) + (e_field(f, 16) if f.x else "  .00000000E-99"))
        if (f * f - Eight("1E-10")).x <= 0 or steps >= 40:
            break
        if (f * fa).x <= 0:
            b, fb = x, f
        else:
            a, fa = x, f
    report(x, steps)
    return cards, [*typed, "NO SIGN CHANGE", "SLOPE IS ZERO"]


class Game:
    """A game of tic-tac-toe on squares 1 to 9: the squares of both players, and the lines typed."""

    def __init__(self, lines: list[set[int]]) -> None:
        self.lines, self.player, self.machine = lines, set[int](), set[int]()
        self.typed = ["TIC-TAC-TOE"]

    def free(self, squares: Iterable[int]) -> list[int]:
        return [k for k in squares if k not in self.player | self.machine]

    def end(self) -> str:
        if any(line <= self.player for line in self.lines):
            return "YOU WIN"
        if any(line <= self.machine for line in self.lines):
            return "I WIN"
        return "" if self.free(range(1, 10)) else "DRAW"

    def picture(self) -> list[str]:
        marks = [1 if k in self.player else 4 if k in self.machine else 0 for k in range(1, 10)]
        return ["".join(i_field(n, 2) for n in marks[k : k + 3]) for k in (0, 3, 6)]

    def move(self) -> None:
        """Win, else block the player, else take the first free square: center, corners, sides."""
        for own, other in ((self.machine, self.player), (self.player, self.machine)):
            completions = [line - own for line in self.lines if len(line & own) == 2 and not line & other]
            if completions:
                break
        (taken,) = completions[0] if completions else self.free((5, 1, 3, 7, 9, 2, 4, 6, 8))[:1]
        self.machine.add(taken)
        self.typed += [f"I TAKE{i_field(taken, 2)}", *self.picture()]


def tictac(switches: frozenset[int]) -> Lines:
    """Compute the three games of tictac.operator."""
    text = (PERIOD / "tictac.deck").read_text(encoding="ascii").rstrip()
    lines = [{int(text[k + 2 * j : k + 2 * j + 2]) for j in range(3)} for k in range(0, 48, 6)]
    cards: list[str] = []
    typed: list[str] = []
    for begins, moves in ((False, (1, 2, 7, 6, 8)), (True, (5, 10, 1, 7, 6, 8)), (True, (2, 4))):
        game = Game(lines)
        if begins:
            game.move()
        for square in moves:
            game.typed.append("YOUR MOVE")
            if square > 9:
                game.typed.append("NO SUCH SQUARE")
            elif not game.free([square]):
                game.typed.append(f"SQUARE{i_field(square, 2)} IS TAKEN")
            else:
                game.player.add(square)
                if not game.end():
                    game.move()
        cards += game.picture()
        typed += [*game.typed, game.end()]
    return cards, typed
