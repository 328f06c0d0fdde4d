"""Compute the measure ``alarms``: which methods of error analysis notice that a program takes a wrong branch.

The operations of each program of a run are recorded on a tape (emulator/machine/tape.py) and repeated in other
arithmetics along the branch that the machine took.  A decision is *wrong* if the exact value of the tested number leads
to another target.  Only decisions up to the first wrong decision are judged, because after a wrong decision the run
computes something other than the exact run.

A method raises an *alarm* at a decision if it cannot confirm the target that the machine took:

- ``cadna3`` and ``cadna10``: among 3 or 10 samples with random rounding (CESTAC), the mean has no significant digit by
  the criterion of CADNA, or leads to another target.
- ``parker10``: the same condition for ten samples, but with the criterion of Stott Parker, which estimates the
  significant digits of a single sample.
- ``vote10``: the ten samples, each by its own sign, do not all lead to the target that the machine took.
- ``interval``: the bounds of the number do not both lead to the target that the machine took.
- ``double``: arithmetic with twice the digits leads to another target.

The measure also records which branch a program would take if it used a method to decide.  With ``cadna3``, ``cadna10``
and ``parker10``, a number without a significant digit counts as zero.  With ``vote10``, the branch to which most of the
ten samples lead is taken.  Chapter 7's e applies to the decisions that the layer ``epsilon`` changes.  This tolerance
raises an alarm if the number is within e of zero, but not zero, and zero leads to another target.  The measure records
the least power of ten that, used as e, would raise an alarm.
"""

import hashlib
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from math import inf, log10, sqrt
from typing import Any

import numpy as np

from emulator.compiled.replay import enclosed, exactly, repetitions
from emulator.machine.result import Options
from emulator.machine.tape import ADD, DIVIDE, MULTIPLY, SUBTRACT, Tape, Test, record
from emulator.numbers import numbers
from emulator.numbers.arithmetic import Rules, profile
from emulator.numbers.decimal import DecimalNumbers
from emulator.numbers.interval import Interval
from modern.edition import programs
from modern.study.outcomes import Figures, position
from modern.study.sample import Sample
from modern.thesis.job import HullRun

DIGITS = 8
SAMPLES = 10
# The number of samples N, and the factor of |mean| / deviation whose logarithm is the number of significant digits:
# sqrt(N) / t for CADNA, where t is Student's for 95 % and N - 1 degrees of freedom (J. Vignes, A stochastic arithmetic
# for reliable scientific computation, Math. Comput. Simulation 35 (1993) 233-261), and 1 for Stott Parker (Monte Carlo
# arithmetic, UCLA CSD-970002, 1997; confidence by D. Sohier et al., ACM Trans. Math. Softw. 47 (2021) 10).
CRITERIA = {
    "cadna3": (3, sqrt(3) / 4.302652729911275),
    "cadna10": (10, sqrt(10) / 2.2621571628540993),
    "parker10": (10, 1.0),
}
METHODS = (*CRITERIA, "vote10", "interval", "double")
# The methods that estimate significant digits.
ESTIMATING = (*CRITERIA, "interval")
# The number of statements after which a recorded run ends.
LIMIT = 20_000
# The exponent recorded for a decision that no e changes.
NO_E = 999


@dataclass
class _Tally:
    """Counts of one run: its decisions, the alarms of each method, and its estimated digits.

    first: the statement of the first wrong decision.  alarms: by method, the number of right decisions with an alarm.
    spoils: by method, the number of right decisions that the method would change.  caught: by method, 1 if it raises an
    alarm at the first wrong decision.  repaired: by method, 1 if it takes the right branch at the first wrong decision.
    e_right: for each k, the number of right decisions at which e = 10**k is the least power of ten that raises an
    alarm.  e_first: this k at the first wrong decision.  digits: the estimates of the correct digits of numbers, by
    method and by the true number of correct digits.
    """

    tests: int = 0
    first: str = ""
    alarms: Counter[str] = field(default_factory=Counter)
    spoils: Counter[str] = field(default_factory=Counter)
    caught: dict[str, int] = field(default_factory=dict)
    repaired: dict[str, int] = field(default_factory=dict)
    e_right: Counter[int] = field(default_factory=Counter)
    e_first: int | None = None
    digits: dict[tuple[str, int], list[float]] = field(default_factory=dict)


def alarms(sample: Sample, run: HullRun) -> Figures:
    """Count the decisions up to the first wrong one, and the alarms that each method of error analysis raises.

    ``first`` is the statement of the first wrong decision.  For each method M, ``M_false`` is the number of alarms at
    right decisions, and ``M_spoils`` is the number of right decisions that M would change.  ``M_caught`` is 1 if M
    raises an alarm at the first wrong decision, and ``M_repaired`` is 1 if M takes the right branch at this decision.
    """
    tally, counts = _Tally(), Counter[int]()
    seed = int(hashlib.sha256("\n".join(card.text for card in sample.deck.cards).encode("ascii")).hexdigest()[:7], 16)
    for step in run.steps:
        options = Options(numbers("truncating"), core=60_000, limit=LIMIT)
        tape = record(step.program, step.deck, options)
        counts.update(tape.operations)
        for test, known in _decided(tape, seed + 100 * step.number):
            line = step.program.line_at(test.instruction)
            if _judged(tally, test, known, line.text in _with_e(step.name)):
                tally.first = f"{step.name} {position(step.program, line)}"
                break
        if tally.first:
            break
    return {
        "tests": tally.tests,
        "first": tally.first,
        **{f"{name}_false": tally.alarms[name] for name in METHODS},
        **{f"{name}_spoils": tally.spoils[name] for name in METHODS},
        **{f"{name}_caught": caught for name, caught in tally.caught.items()},
        **{f"{name}_repaired": repaired for name, repaired in tally.repaired.items()},
        "e_right": " ".join(f"{k}:{n}" for k, n in sorted(tally.e_right.items())),
        **({} if tally.e_first is None else {"e_first": tally.e_first}),
        **{
            f"{name}_digits_{true}": f"{len(estimates)} {sum(estimates) / len(estimates):.3f} "
            f"{sum(estimate > true + 1.5 for estimate in estimates)}"
            for (name, true), estimates in sorted(tally.digits.items())
        },
        "additions": counts[ADD] + counts[SUBTRACT],
        "products": counts[MULTIPLY],
        "quotients": counts[DIVIDE],
    }


def _decided(tape: Tape, seed: int) -> Iterator[tuple[Test, dict[str, Any]]]:
    """Yield each decision of a recorded run up to the first wrong one, with the tested number in each arithmetic."""
    exact = exactly(tape, DIGITS)
    wrong = (k for k, test in enumerate(tape.tests) if test.target(exact[test.place]) != test.taken)
    tape = tape.until(next(wrong, len(tape.tests) - 1))
    if not tape.is_rounded(exact, DIGITS):
        # All arithmetics hold the exact numbers, because none rounds a result that has eight digits.
        for test in tape.tests:
            value = exact[test.place]
            estimate = (float(value), False, float(DIGITS))
            known = {
                "interval": (value, value),
                "double": value,
                "samples": [value],
                **dict.fromkeys(CRITERIA, estimate),
            }
            yield test, {"exact": value, "machine": tape.number(test.place), **known}
        return
    bounds, long = enclosed(tape, DIGITS), profile(f"truncating:{2 * DIGITS}").rules
    ((double, _),) = repetitions(tape, DIGITS, [long])
    samples = repetitions(tape, DIGITS, (_rules(seed + k) for k in range(SAMPLES)))
    drawn = np.array([np.array(m, float) * 10.0 ** (np.array(e, float) - DIGITS) for m, e in samples])
    estimates = {name: _estimated(drawn[:number], factor) for name, (number, factor) in CRITERIA.items()}
    for k, (test, column) in enumerate(zip(tape.tests, drawn.T.tolist(), strict=True)):
        known = {"interval": bounds[test.place], "double": double[k], "samples": column}
        known |= {name: values[k] for name, values in estimates.items()}
        yield test, {"exact": exact[test.place], "machine": tape.number(test.place), **known}


def _rules(seed: int) -> Rules:
    system = numbers(f"stochastic:{DIGITS}:{seed}")
    assert isinstance(system, DecimalNumbers)
    return system.profile.rules


def _estimated(drawn: Any, factor: float) -> list[tuple[float, bool, float]]:
    """Return for each number its samples' mean, True if no digit is significant, and how many digits are significant.

    If all samples of a number are equal, all its digits are significant.
    """
    results = []
    for mean, deviation in zip(drawn.mean(axis=0).tolist(), drawn.std(axis=0, ddof=1).tolist(), strict=True):
        ratio = factor * abs(mean) / deviation if deviation else inf
        results.append((mean, ratio <= 1, _clipped(log10(ratio) if ratio > 0 else 0.0)))
    return results


def _clipped(digits: float) -> float:
    return min(max(digits, 0.0), float(DIGITS))


@cache
def _with_e(program: str) -> frozenset[str]:
    """Return the statements of a program that the layer ``epsilon``, which implements chapter 7's e, changes."""
    texts = [
        {line.text for line in programs.with_layers(program, layers).statements}
        for layers in (("corrected",), ("corrected", "epsilon"))
    ]
    return frozenset(texts[0] - texts[1])


def _judged(tally: _Tally, test: Test, known: Mapping[str, Any], has_e: bool) -> bool:
    """Count the alarms of all methods at one decision. Return True if the machine decided wrongly."""
    target = test.target
    right = target(known["exact"])
    wrong = right != test.taken
    tally.tests += 1
    low, high = known["interval"]
    reached = {target(bound) for bound in (low, high)} | ({target(0)} if low <= 0 <= high else set())
    votes = Counter(map(target, known["samples"]))
    # For each method: the target that it would take, or None if it cannot decide, and whether it raises an alarm.
    decisions: dict[str, tuple[int | None, bool]] = {
        "double": (target(known["double"]), target(known["double"]) != test.taken),
        "interval": (min(reached) if len(reached) == 1 else None, reached != {test.taken}),
        "vote10": (max(sorted(votes), key=lambda each: votes[each]), set(votes) != {test.taken}),
    }
    for name in CRITERIA:
        mean, noise, _ = known[name]
        decision = target(0 if noise else mean)
        decisions[name] = decision, noise or decision != test.taken
    mantissa, exponent = known["machine"]
    # The least power of ten that is not below the number, if e could change the decision.
    can_change = has_e and mantissa and target(0) != test.taken
    e = exponent - (abs(mantissa) == 10 ** (DIGITS - 1)) if can_change else NO_E
    if wrong:
        tally.caught = {name: int(alarm) for name, (_, alarm) in decisions.items()}
        tally.repaired = {name: int(decision == right) for name, (decision, _) in decisions.items()}
        tally.e_first = e
        tally.repaired["e"] = int(target(0) == right)
    else:
        for name, (chosen, alarm) in decisions.items():
            tally.alarms[name] += alarm
            tally.spoils[name] += chosen is not None and chosen != right
        if e != NO_E:
            tally.e_right[e] += 1
    if known["exact"] and mantissa:
        _count_digits(tally, known, (low, high))
    return wrong


def _count_digits(tally: _Tally, known: Mapping[str, Any], bounds: Interval) -> None:
    """Record the estimates of a number's correct digits, with the true number of correct digits as the key.

    Nothing is recorded for a number without error.
    """
    mantissa, exponent = known["machine"]
    ratio = float(known["exact"]) / (mantissa * 10.0 ** (exponent - DIGITS))
    # A relative error below the last digit of the machine is a rounding error of this computation.
    if ratio == 0 or abs(1 / ratio - 1) < 10.0 ** -(DIGITS + 2):
        return
    true = round(_clipped(-log10(abs(1 / ratio - 1))))
    low, high = map(float, bounds)
    middle, half = abs(low + high) / 2, (high - low) / 2
    width = 0.0 if half >= middle else -log10(half / middle) if half else DIGITS
    estimates = {**{name: known[name][2] for name in CRITERIA}, "interval": _clipped(width)}
    for name, estimate in estimates.items():
        tally.digits.setdefault((name, true), []).append(estimate)
