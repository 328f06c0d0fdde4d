"""Evidence for statements: the result of a check, and a grade that says how strong the evidence is.

A check is a function that computes whether a statement holds and returns a :class:`Check`.  Only the constructors of
this module make a ``Check``.  Each constructor sets the grade and counts the evidence: :func:`proved` counts the steps
of an argument, :func:`exhausted` counts the members of a whole domain, and :func:`searched` counts the cases of a
generator.  The decorator :func:`claim` names the statements that a check decides.
"""

import inspect
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from random import Random
from typing import Any, Final, Generic, Literal, Self, TypeVar, get_args

from emulator.errors import EmulatorError

T = TypeVar("T")
F = TypeVar("F", bound=Callable[..., "Check"])
Grade = Literal["proved", "exhausted", "searched", "exhibited", "used", "quoted"]
# The grades of evidence, strongest first.
GRADES: tuple[Grade, ...] = get_args(Grade)
_ATTRIBUTE: Final = "decides"


@dataclass(frozen=True, slots=True)
class Evidence:
    """How the result of a check was obtained.

    ``domain`` is the argument of a proof, the set whose members were all tested, or the name of a generator.  ``seed``
    is the seed of the generator, if there is one.  ``violation`` is a case that violates the condition of the statement
    and refutes the statement. ``correction`` is the reading that makes a misprinted statement true.
    """

    grade: Grade
    cases: int = 1
    domain: str = ""
    seed: int | None = None
    violation: str = ""
    correction: str = ""

    def describe(self) -> str:
        """Return a text with the grade, the number of cases, and the violation or the correction, if any."""
        steps = "1 step" if self.cases == 1 else f"{self.cases} steps"
        parts = [f"proved: {self.domain} ({steps})" if self.grade == "proved" else ""]
        if self.grade in ("exhausted", "searched"):
            seed = "" if self.seed is None else f", seed {self.seed}"
            parts = [f"{self.grade}: {self.domain}, {self.cases:,} cases{seed}"]
        parts += [f"without its condition, the statement is refuted by {self.violation}" if self.violation else ""]
        parts += [f"true when read as {self.correction}" if self.correction else ""]
        return "; ".join(part for part in parts if part) or self.grade


@dataclass(frozen=True, slots=True)
class Check:
    """The result of a check: whether the statement holds, a message, and the evidence."""

    holds: bool
    message: str
    evidence: Evidence

    def unless(self, refutes: object, case: str) -> Self:
        """Add to this check that ``case``, which violates the condition of the statement, refutes the statement.

        If ``refutes`` is false, return the check unchanged.
        """
        return replace(self, evidence=replace(self.evidence, violation=case)) if refutes else self

    def misprinted(self, is_refuted: object, correction: str) -> Self:
        """Turn the check of a corrected reading into the check of a misprint if the printed reading is refuted."""
        evidence = replace(self.evidence, correction=correction if self.holds else "")
        return replace(self, holds=False, evidence=evidence) if is_refuted else self


@dataclass(frozen=True, slots=True)
class Generator(Generic[T]):
    """A generator of cases: ``draw`` makes a case from random numbers, and ``accepts`` excludes unsuitable cases."""

    name: str
    seed: int
    draw: Callable[[Random], T]
    accepts: Callable[[T], bool] = lambda case: True

    def cases(self, count: int) -> Iterator[T]:
        """Yield the first ``count`` accepted cases. Every call yields the same cases."""
        random = Random(self.seed)
        while count:
            case = self.draw(random)
            if self.accepts(case):
                count -= 1
                yield case


def proved(argument: str, steps: Iterable[object], message: str) -> Check:
    """Return the check of a proof; ``steps`` holds one truth value for each identity or case that the proof needs."""
    return _all("proved", argument, steps, message)


def identity(difference: Callable[..., int], degrees: Sequence[int], message: str, argument: str) -> Check:
    """Return the check of a polynomial identity; ``degrees`` has the degree of ``difference`` in each variable.

    ``argument`` states why the message follows from the identity.

    ``difference`` computes one side of the identity minus the other.  A polynomial of degree d in a variable that is
    zero at d + 1 values of this variable is zero at all values.  So the difference is zero everywhere if it is zero on
    a grid with d + 1 values for each variable.
    """
    values = [difference(*point) == 0 for point in product(*(range(-(d // 2), d - d // 2 + 1) for d in degrees))]
    grid = f"A polynomial in {len(degrees)} variables is 0 if it is 0 at more values of each variable than its degree"
    return proved(f"{argument} {grid}", values, message)


def exhausted(domain: str, outcomes: Iterable[object], message: str) -> Check:
    """Return the check of a statement about a whole domain; ``outcomes`` has one truth value for each member."""
    return _all("exhausted", domain, outcomes, message)


def searched(generator: Generator[Any], cases: int, outcomes: Iterable[object], message: str) -> Check:
    """Return the check of ``cases`` cases of a generator; ``outcomes`` has any number of truth values for each case."""
    check = _all("searched", generator.name, outcomes, message)
    return replace(check, evidence=replace(check.evidence, cases=cases, seed=generator.seed))


def search(generator: Generator[T], statement: Callable[[T], object], cases: int, message: str) -> Check:
    """Return the check of a statement about each case of a generator.

    If a case refutes the statement, the message names a case that is as small as :func:`shrink` can make it.
    """
    for case in generator.cases(cases):
        if not statement(case):
            smallest = shrink(case, lambda smaller: generator.accepts(smaller) and not statement(smaller))
            return searched(generator, cases, [False], f"refuted by {smallest}")
    return searched(generator, cases, [cases], message)


def exhibited(holds: object, message: str) -> Check:
    """Return the check of a statement that one instance shows; ``holds`` tells whether the instance does show it."""
    return Check(bool(holds), message, Evidence("exhibited"))


def refuted(by: object, message: str) -> Check:
    """Return the check of a statement that a counterexample refutes; ``by`` is true if the counterexample does so."""
    return Check(not by, message, Evidence("exhibited"))


def slip(as_printed: object, as_corrected: object, correction: str, message: str) -> Check:
    """Return the check of a misprint, which must be false as printed and true as corrected."""
    evidence = Evidence("exhibited", 2, correction=correction if as_corrected else "")
    return Check(bool(as_printed), message, evidence)


def _all(grade: Grade, domain: str, outcomes: Iterable[object], message: str) -> Check:
    values = [bool(outcome) for outcome in outcomes]
    return Check(all(values) and bool(values), message, Evidence(grade, len(values), domain))


def shrink(case: T, fails: Callable[[T], bool]) -> T:
    """Return a smaller case that still fails: nested tuples lose elements, and integers are brought closer to 0."""
    while (smaller := next((c for c in _smaller(case) if _fails(c, fails)), None)) is not None:
        case = smaller
    return case


def _fails(case: T, fails: Callable[[T], bool]) -> bool:
    # A smaller case may be one to which the statement does not apply, for example too few points.
    try:
        return fails(case)
    except (ArithmeticError, AssertionError, EmulatorError, LookupError, ValueError):
        return False


def _smaller(case: Any) -> Iterator[Any]:
    if isinstance(case, tuple):
        yield from (case[:k] + case[k + 1 :] for k in range(len(case)))
        yield from ((*case[:k], inner, *case[k + 1 :]) for k, part in enumerate(case) for inner in _smaller(part))
    elif isinstance(case, int) and case:
        yield from (value for value in (0, int(case / 2), case - 1 if case > 0 else case + 1) if value != case)


@dataclass(frozen=True, slots=True)
class Decision:
    """A check with its arguments for one statement; ``full`` is the number of cases of its full search, if any."""

    statement: str
    function: Callable[..., Check]
    subject: tuple[tuple[str, Any], ...] = ()
    full: int = 0

    def run_full(self) -> Check:
        """Run the check with the number of cases of the full search."""
        return self.function(**dict(self.subject), cases=self.full)


def claim(*statements: str, full: int = 0, **subject: Any) -> Callable[[F], F]:
    """Name the statements that a check decides.

    statements: ids of rows of the register.
    full: the number of cases of the full search.  A check with a full search must have a parameter ``cases``.
    subject: arguments that select the subject of the check, for example one of several tables.  They must not say what
    the verdict is.
    """

    def decorate(function: F) -> F:
        if full and "cases" not in inspect.signature(function).parameters:
            raise TypeError(f"{function.__qualname__}: a check with a full search needs the parameter 'cases'")
        attach(function, [Decision(name, function, tuple(subject.items()), full) for name in statements])
        return function

    return decorate


def attach(function: Callable[..., object], decisions: list[Decision]) -> None:
    """Add decisions to a function, from which :func:`decisions_in` reads them."""
    function.__dict__.setdefault(_ATTRIBUTE, []).extend(decisions)


def decisions_in(module: object) -> Iterator[Decision]:
    """Yield a :class:`Decision` for each statement that a check of the module decides, in the order of the source."""
    for value in vars(module).values():
        if inspect.isfunction(value) and value.__module__ == getattr(module, "__name__", ""):
            yield from reversed(getattr(value, _ATTRIBUTE, ()))
