"""Exact polynomials and certificates of their signs, with which the proofs of theorems are checked.

A :class:`Step` of a proof states: if some polynomials (the hypotheses) have given signs, then another polynomial (the
conclusion) has a given sign.  The certificate of the step is an identity::

    multiplier * conclusion = sum of terms

The multiplier is a product of positive hypotheses.  Each term is a product of hypotheses and one more factor: a
positive number or a square.  If one of the hypotheses is an equation, this factor may be any polynomial.  Expanding
both sides therefore proves the step for all real numbers.  The sentences that connect the steps are not checked by
computation.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from itertools import product
from operator import mul
from random import Random
from typing import Literal, TypeAlias

from modern.claims.evidence import Check, Decision, attach, proved

Relation: TypeAlias = Literal[">", ">=", "="]
Monomial: TypeAlias = tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Polynomial:
    """A polynomial with integer coefficients; ``terms`` maps the sorted variables of a monomial to its coefficient."""

    terms: Mapping[Monomial, int]

    def __add__(self, addend: Polynomial | int) -> Polynomial:
        total = defaultdict(int, self.terms)
        for monomial, coefficient in polynomial(addend).terms.items():
            total[monomial] += coefficient
        return Polynomial({monomial: c for monomial, c in total.items() if c})

    def __mul__(self, factor: Polynomial | int) -> Polynomial:
        total: dict[Monomial, int] = defaultdict(int)
        for (m, c), (n, d) in product(self.terms.items(), polynomial(factor).terms.items()):
            total[tuple(sorted(m + n))] += c * d
        return Polynomial({monomial: c for monomial, c in total.items() if c})

    def __neg__(self) -> Polynomial:
        return self * -1

    def __sub__(self, subtrahend: Polynomial | int) -> Polynomial:
        return self + -polynomial(subtrahend)

    def __rsub__(self, minuend: int) -> Polynomial:
        return polynomial(minuend) - self

    __radd__ = __add__
    __rmul__ = __mul__

    def at(self, values: Mapping[str, int]) -> int:
        return sum(c * reduce(mul, (values[name] for name in m), 1) for m, c in self.terms.items())

    def variables(self) -> set[str]:
        return {name for monomial in self.terms for name in monomial}


Point: TypeAlias = tuple[Polynomial, ...]


def polynomial(value: Polynomial | int) -> Polynomial:
    return value if isinstance(value, Polynomial) else Polynomial({(): value} if value else {})


def variables(names: str) -> tuple[Polynomial, ...]:
    return tuple(Polynomial({(name,): 1}) for name in names.split())


def point(name: str, dimension: int) -> Point:
    """Return a point with variable coordinates, for example ``a_x`` and ``a_y``."""
    return variables(" ".join(f"{name}_{axis}" for axis in "xyz"[:dimension]))


def total(values: Iterable[Polynomial]) -> Polynomial:
    return sum(values, polynomial(0))


def dot(u: Sequence[Polynomial], v: Sequence[Polynomial]) -> Polynomial:
    return total(a * b for a, b in zip(u, v, strict=True))


def minus(p: Point, q: Point) -> Point:
    return tuple(a - b for a, b in zip(p, q, strict=True))


def turn(u: Point, v: Point) -> Polynomial:
    """Return the cross product of two vectors in the plane: it is positive if v is counterclockwise from u."""
    return u[0] * v[1] - u[1] * v[0]


def cross(u: Point, v: Point) -> Point:
    return tuple(u[i] * v[j] - u[j] * v[i] for i, j in ((1, 2), (2, 0), (0, 1)))


def bracket(a: Point, b: Point, c: Point) -> Polynomial:
    """Return twice the signed area of the triangle a b c; it is positive if c is to the left of the line a b."""
    return turn(minus(b, a), minus(c, a))


@dataclass(frozen=True, slots=True)
class Sign:
    """A polynomial with the statement that it is positive, not negative, or zero."""

    value: Polynomial
    relation: Relation

    def holds_at(self, values: Mapping[str, int]) -> bool:
        number = self.value.at(values)
        return number > 0 if self.relation == ">" else number >= 0 if self.relation == ">=" else number == 0


def positive(value: Polynomial) -> Sign:
    return Sign(value, ">")


def not_negative(value: Polynomial) -> Sign:
    return Sign(value, ">=")


def zero(value: Polynomial | int) -> Sign:
    return Sign(polynomial(value), "=")


IMPOSSIBLE = positive(polynomial(0))


@dataclass(frozen=True, slots=True)
class Term:
    """A term of a certificate: named hypotheses times a factor, which is squared if no hypothesis is an equation."""

    names: tuple[str, ...]
    factor: Polynomial


def term(names: str, factor: Polynomial | int = 1) -> Term:
    return Term(tuple(names.split()), polynomial(factor))


@dataclass(frozen=True, slots=True)
class Step:
    """A step of a proof: hypotheses by name, conclusion, and certificate (see :mod:`modern.claims.algebra`)."""

    says: str
    hypotheses: Mapping[str, Sign]
    conclusion: Sign
    terms: tuple[Term, ...] = ()
    multiplier: tuple[str, ...] = ()

    def is_valid(self) -> bool:
        """Return True if the certificate proves that the conclusion follows from the hypotheses."""
        names = {*self.multiplier, *(name for t in self.terms for name in t.names)}
        if not names <= self.hypotheses.keys() or any(self.hypotheses[n].relation != ">" for n in self.multiplier):
            return False
        total = -self._product(self.multiplier) * self.conclusion.value
        relations: list[Relation] = []
        for t in self.terms:
            used: set[Relation] = {self.hypotheses[name].relation for name in t.names}
            is_nonzero = t.factor.terms.keys() == {()}
            relations.append("=" if "=" in used else ">" if is_nonzero and ">=" not in used else ">=")
            total += self._product(t.names) * (t.factor if "=" in used else t.factor * t.factor)
        # The sum is positive if at least one term is; it is known to be zero only if every term contains an equation.
        proved: Relation = ">" if ">" in relations else ">=" if ">=" in relations else "="
        follows = {">": (">",), ">=": (">", ">=", "="), "=": ("=",)}[self.conclusion.relation]
        return not total.terms and proved in follows

    def _product(self, names: Sequence[str]) -> Polynomial:
        return reduce(mul, (self.hypotheses[name].value for name in names), polynomial(1))

    def refuting_values(self, seed: int, tries: int = 20000) -> Mapping[str, int] | None:
        """Search for small integers at which all hypotheses hold and the conclusion does not."""
        random = Random(seed)
        signs = (*self.hypotheses.values(), self.conclusion)
        names = sorted(set[str]().union(*(sign.value.variables() for sign in signs)))
        for _ in range(tries):
            values = {name: random.choice((-2, -1, -1, 0, 0, 0, 1, 1, 2)) for name in names}
            if not self.conclusion.holds_at(values) and all(s.holds_at(values) for s in self.hypotheses.values()):
                return values
        return None

    def alterations(self) -> Iterator[tuple[str, Step]]:
        """Yield altered steps: one without each used hypothesis, and one with the opposite conclusion."""
        for name in sorted({*self.multiplier, *(n for t in self.terms for n in t.names)}):
            rest = {key: sign for key, sign in self.hypotheses.items() if key != name}
            yield f"without {name}", replace(self, hypotheses=rest)
        if self.conclusion.value.terms:
            opposite = Sign(-self.conclusion.value - (self.conclusion.relation == "="), ">")
            yield "opposite conclusion", replace(self, conclusion=opposite)


@dataclass(frozen=True, slots=True)
class Proof:
    """A theorem in our words, the steps of its proof, and the argument that connects the steps."""

    theorem: str
    argument: str
    steps: tuple[Step, ...]

    @classmethod
    def of(cls, theorem: str, argument: str, *steps: Step) -> Proof:
        return cls(theorem, argument, steps)

    def check(self, conclusion: str = "") -> Check:
        """Return the check of the theorem, or of a conclusion that the argument contains."""
        return proved(self.argument, (step.is_valid() for step in self.steps), conclusion or self.theorem)


def proves(*statements: str, conclusion: str = "") -> Callable[[Callable[[], Proof]], Callable[[], Proof]]:
    """Decorate a function that returns a proof: name the statements that this proof decides.

    statements: ids of rows of the register.
    conclusion: what the argument says about these statements; by default, they are the theorem itself.
    """

    def decorate(proof: Callable[[], Proof]) -> Callable[[], Proof]:
        subject = (("proof", proof), ("conclusion", conclusion))
        attach(proof, [Decision(name, _check_of, subject) for name in statements])
        return proof

    return decorate


def _check_of(proof: Callable[[], Proof], conclusion: str) -> Check:
    return proof().check(conclusion)


def largest_value() -> Step:
    """Return the step that proves: if a linear function is largest at a mean of points, it is largest at each.

    The weights are positive, and their sum need not be 1.  A mean of more than two points is formed by combining two at
    a time.
    """
    w, w_p, w_q, l_x, l_p, l_q = variables("w w_p w_q L_x L_p L_q")
    return Step(
        "a combination of two values of which one is smaller is not the largest value",
        {
            "p": positive(l_x - l_p),
            "q": not_negative(l_x - l_q),
            "w_p": positive(w_p),
            "w_q": not_negative(w_q),
            "total": zero(w_p + w_q - w),
            "combined": zero(w * l_x - w_p * l_p - w_q * l_q),
        },
        IMPOSSIBLE,
        (term("w_p p"), term("w_q q"), term("total", -l_x), term("combined", -1)),
    )


def combination_satisfies() -> tuple[Step, ...]:
    """Return the steps that prove: a linear function that is at most 0 at two points is so at all points between."""
    p, q = point("p", 3), point("q", 3)
    slope = variables("L_1 L_2 L_3")
    level, share, l_p, l_q = variables("L_0 lambda L_p L_q")
    mixed = tuple((1 - share) * a + share * b for a, b in zip(p, q, strict=True))
    values = [dot(slope, x) + level for x in (p, q, mixed)]
    return (
        Step(
            "L of a combination is the combination of L",
            {},
            zero(values[2] - (1 - share) * values[0] - share * values[1]),
        ),
        Step(
            "a combination of values that are not positive is not positive",
            {
                "p": not_negative(-l_p),
                "q": not_negative(-l_q),
                "share": not_negative(share),
                "rest": not_negative(1 - share),
            },
            not_negative(-(1 - share) * l_p - share * l_q),
            (term("rest p"), term("share q")),
        ),
    )
