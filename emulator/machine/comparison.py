"""Compare the journals (decisions and stored values) of two runs of a program: find differences, count lost digits.

emulator/machine/divergence.py states the rules and runs the programs.
"""

import math
from collections import Counter
from dataclasses import dataclass, field
from fractions import Fraction

from emulator.language import objectcode as op
from emulator.language.objectcode import Line, Program
from emulator.machine.state import Entry
from emulator.numbers import Numbers
from emulator.numbers.base import Number
from emulator.numbers.exact import ExactNumbers
from emulator.numbers.shadowed import Shadowed, ShadowedNumbers

_DECISIONS = (op.IF, op.IFX, op.SELECT, op.DOTEST)


@dataclass(frozen=True, slots=True)
class Difference:
    """A value that differs between the studied run and the reference run.

    The statement ``line`` stored the value.  ``time`` is the number of this execution of the statement, counted from 1.
    For each run, ``names`` has the name of the variable and ``values`` the value stored.  ``relative`` is the
    difference of the two values divided by the value in the reference run, or None if that value is zero or not a
    number.  ``bound`` is the largest possible error of the value in the reference run, 0 if nothing was rounded.
    """

    line: Line
    time: int
    names: tuple[str, str]
    values: tuple[str, str]
    relative: float | None
    bound: Fraction = Fraction(0)


@dataclass(frozen=True, slots=True)
class Decision:
    """A decision (IF, computed GO TO or end of a DO) that has different outcomes in the two runs.

    ``time`` is the number of the execution of the statement ``line``, counted from 1.  ``values`` has the tested value
    of each run, and ``targets`` has the statement at which each run continues.
    """

    line: Line
    time: int
    values: tuple[str, str]
    targets: tuple[Line | None, Line | None]


@dataclass(frozen=True, slots=True)
class Loss:
    """The digits that the values of one statement lost before the first decision that differs between the runs.

    ``times`` values were compared, and ``differing`` of them differ.  ``worst`` and ``median`` are the largest and the
    median number of decimal digits that a value lost.
    """

    line: Line
    times: int
    differing: int
    worst: float
    median: float


@dataclass
class _Tally:
    """The compared values of one statement: their number, and a histogram of the digits that they lost."""

    times: int = 0
    differing: int = 0
    tenths: Counter[int] = field(default_factory=Counter)


class Comparison:
    """The results so far of a comparison of two runs."""

    def __init__(self, program: Program, studied: Numbers, reference: Numbers) -> None:
        self._program, self._studied, self._reference = program, studied, reference
        self._statement_of = program.statement_numbers
        self._decides = [i.operation in _DECISIONS for i in program.code]
        self._counts = [i.operation == op.COUNT for i in program.code]
        # The number of executions of each instruction, separately for each element of an array that is read as a whole.
        self._times: Counter[tuple[int, int]] = Counter()
        self._whole = [op.repeats(i) > 1 for i in program.code]
        self._tallies: dict[int, _Tally] = {}
        # The P of divergence.py: the number of digits of the less precise arithmetic, or 0 if both are exact.
        digits = min(studied.digits, reference.digits)
        self.digits = digits if math.isfinite(digits) else 0.0
        # The number of digits with which irrational exact values, such as roots, are compared.
        self._exactly = 2 * int(self.digits) + 20
        self.first_value: Difference | None = None
        self.first_decision: Decision | None = None
        self.compared = self.tested = self.values = self.values_in_step = self.within = self.decisions = 0
        self.uncertain = ""

    def differs(self, entry: Entry, reference_entry: Entry) -> bool:
        """Compare the next entries of both journals.  Return True if they are decisions with different outcomes."""
        pc = entry[0]
        if self._counts[pc]:
            return False
        place = pc, entry[1] if self._whole[pc] else 0
        self._times[place] += 1
        if not self._decides[pc]:
            self._store(entry, reference_entry, self._times[place])
            return False
        self.tested += 1
        if entry[1] == reference_entry[1]:
            return False
        # An IF compares with zero.  If zero lies within the error bound, the reference itself may have taken the wrong
        # branch.
        bound, value = self._bound(reference_entry[2]), self._value(self._reference, reference_entry[2])
        if bound is None or (bound and (value is None or abs(Fraction(value)) <= bound)):
            self.uncertain = self._uncertainty(pc, reference_entry[2], bound)
            return True
        self.decisions += 1
        if self.first_decision is None:
            self.first_decision = Decision(
                self._line(pc),
                self._times[place],
                self._texts(entry[2], reference_entry[2], tested=True),
                (self._target(entry[1]), self._target(reference_entry[1])),
            )
        return True

    def _store(self, entry: Entry, reference_entry: Entry, time: int) -> None:
        pc = entry[0]
        self.compared += 1
        lost, relative, within = self._lost(entry, reference_entry)
        self.within += within
        if lost is not None:
            self.values += 1
            if self.first_value is None:
                name = self._program.storage.name_of
                self.first_value = Difference(
                    self._line(pc),
                    time,
                    (name(entry[1]), name(reference_entry[1])),
                    self._texts(entry[2], reference_entry[2]),
                    relative,
                    self._bound(reference_entry[2]) or Fraction(0),
                )
        # After a decision that differs, a difference does not mean lost digits.
        if self.decisions:
            return
        tally = self._tallies.setdefault(self._statement_of[pc], _Tally())
        tally.times += 1
        if lost is not None:
            self.values_in_step += 1
            tally.differing += 1
        # Losses are counted in tenths of a digit, so that the histogram stays small whatever the number of values.
        tally.tenths[round(10 * (lost or 0.0))] += 1

    def _bound(self, value: Number) -> Fraction | None:
        """Return the largest possible error of a value of the reference: 0 if it is exact, None if it is unknown."""
        if not isinstance(value, Shadowed) or not isinstance(self._reference, ShadowedNumbers):
            return Fraction(0)
        return self._reference.error(value)

    def _uncertainty(self, pc: int, value: Number, bound: Fraction | None) -> str:
        """Return a message for an IF: rounding in the reference run may have changed the sign of the tested value."""
        card, name, text = self._line(pc).place.card, self._reference.name, self._reference.text(value)
        size = "any amount" if bound is None else f"1E{math.ceil(_logarithm(bound)):+03d}"
        remedy = "compare with exact arithmetic, or with more digits"
        return (
            f"at card {card} the tested value is {text} in {name}, and rounding may have changed it by {size}; {remedy}"
        )

    def _lost(self, entry: Entry, reference_entry: Entry) -> tuple[float | None, float | None, bool]:
        """Return the digits lost, the relative difference, and True if the reference's rounding explains a difference.

        The digits and the relative difference are None if the values are equal or rounding explains their difference.
        """
        # If the entries change different fields, for example because a subscript differs, all digits count as lost.
        if entry[1] == reference_entry[1]:
            x = self._value(self._studied, entry[2])
            y = self._value(self._reference, reference_entry[2])
            if x is None and y is None:
                # Undefined fields, infinities and NaNs are compared by their names.
                if _text(self._studied, entry[2], None) == _text(self._reference, reference_entry[2], None):
                    return None, None, False
            elif x == y:
                return None, None, False
            elif x is not None and y is not None:
                bound = self._bound(reference_entry[2])
                if bound is None or abs(Fraction(x) - y) <= bound:
                    return None, None, True
            if x is not None and y:
                # The number of digits that agree is -log10 |(x - y) / y|.
                logarithm = _logarithm(abs(Fraction(x) - y)) - _logarithm(abs(Fraction(y)))
                relative = 10**logarithm if abs(logarithm) < 300 else None
                return min(max(self.digits + logarithm, 0.0), self.digits), relative, False
        return self.digits, None, False

    def _value(self, numbers: Numbers, value: Number) -> Fraction | int | None:
        return value if value is None or isinstance(value, int) else numbers.exact(value, self._exactly)

    def _texts(self, studied: Number, reference: Number, tested: bool = False) -> tuple[str, str]:
        """Return both values as text, with all their digits if shorter texts would be equal.

        If ``tested`` is true, an IF tested the values.  The sign of a zero is then not shown, because an IF ignores it.
        """
        texts = []
        for wide in (False, True):
            pairs = (self._studied, studied), (self._reference, reference)
            texts = [_text(n, value, self._value(n, value) if wide else None) for n, value in pairs]
            if texts[0] != texts[1]:
                break
        first, second = ("0" if tested and text == "-0" else text for text in texts)
        return first, second

    def _line(self, pc: int) -> Line:
        return self._program.statements[self._statement_of[pc]]

    def _target(self, pc: int) -> Line | None:
        """Return the statement that begins at an instruction, or None at the end of the program."""
        return self._line(pc) if pc < len(self._statement_of) else None

    def losses(self) -> tuple[Loss, ...]:
        """Return the losses of all statements, the largest first, and equal losses in the order of the cards."""
        lines = self._program.statements
        losses = [_loss(lines[statement], tally) for statement, tally in self._tallies.items()]
        return tuple(sorted(losses, key=lambda loss: (-loss.worst, -loss.median, loss.line.place.card)))


def _loss(line: Line, tally: _Tally) -> Loss:
    # The median of an even number of values is the mean of the two in the middle.
    lost = sorted(tally.tenths.elements())
    middle = (lost[(len(lost) - 1) // 2] + lost[len(lost) // 2]) / 2
    return Loss(line, tally.times, tally.differing, lost[-1] / 10, middle / 10)


def _logarithm(value: Fraction) -> float:
    """Return the decimal logarithm of a number that may be too large or too small for a float."""
    return math.log10(value.numerator) - math.log10(value.denominator)


def _text(numbers: Numbers, value: Number, exact: Fraction | int | None) -> str:
    """Return the text of ``exact`` if it is given, otherwise the text of ``value`` in its own arithmetic."""
    if value is None:
        return "undefined"
    if isinstance(value, int):
        return str(value)
    return numbers.text(value) if exact is None else ExactNumbers().text(exact)
