"""A small 1620: it loads the cards of an object deck and executes their instructions.

The instructions are those of the reference card (X26-5743-2).  The emulator's arithmetic answers calls of IBM's
arithmetic routines, and the numbers that a program punches are collected.
"""

from collections.abc import Sequence

from emulator.language.ibm1962 import ITEM, LAST_ITEM
from emulator.numbers.accumulator import add, divide, divide_fixed, multiply, negate, subtract
from emulator.numbers.arithmetic import IBM1962, MINUS_ZERO, ZERO, from_integer, to_integer, wrap_integer

FLAGGED = "]JKLMNOPQR"
RULES = IBM1962.rules
FLOATING = {518: add, 408: subtract, 1378: multiply, 1862: divide}
Number = tuple[int, int]


class Core:
    """Core storage, loaded with the cards of an object program."""

    def __init__(self, cards: Sequence[str], size: int = 20000) -> None:
        self.digits, self.flags = [0] * size, [False] * size
        self.punched: list[int | Number] = []
        self.compared = 0
        self.returns = 0
        at, index = 8300, 0
        while _plain(cards[index][4:7]) != "999":
            self.put(at, cards[index][7:].partition("|")[0])
            at += int(_plain(cards[index][4:7]))
            index += 1
        units = size - 1
        for card in cards[index + 2 :]:
            fields = card.partition("|")[0]
            for start in range(len(fields) - 10, -1, -10):
                units = self._load_field(units, fields[start : start + 10]) - 10

    def _load_field(self, units: int, text: str) -> int:
        """Put what an entry of the symbol table describes into its field.  Return the last position it takes."""
        flagged = [character in FLAGGED for character in text]
        if flagged[8]:
            self.put(units - 9, text)
        elif flagged[9]:
            self.put(units - 9, text[:9] + _plain(text[9]))
        elif flagged[6]:
            self.put(units - 9, "49" + _plain(text[:5] + text[7:]))
        elif flagged[5]:
            return int(_plain(text[5:]))
        return units

    def put(self, at: int, text: str) -> None:
        for place, character in enumerate(text, at):
            self.flags[place] = character in FLAGGED
            self.digits[place] = int(_plain(character))

    def high(self, units: int) -> int:
        """Return the first position of a field."""
        position = units - 1
        while not self.flags[position]:
            position -= 1
        return position

    def number(self, units: int) -> int:
        """Return the signed number of a field."""
        size = int("".join(map(str, self.digits[self.high(units) : units + 1])))
        return -size if self.flags[units] else size

    def store(self, units: int, value: int, width: int) -> None:
        """Store a number in a field of ``width`` digits."""
        self.put(units - width + 1, f"{abs(value) % 10**width:0{width}d}")
        self.flags[units - width + 1] = True
        self.flags[units] = value < 0

    def copy(self, to: int, units: int) -> None:
        """Transmit a field (TF)."""
        length = units - self.high(units)
        self.digits[to - length : to + 1] = self.digits[units - length : units + 1]
        self.flags[to - length : to + 1] = self.flags[units - length : units + 1]

    def address(self, at: int) -> int:
        """Return the address in five positions.  A flag on the last one makes it indirect."""
        value = int("".join(map(str, self.digits[at : at + 5])))
        return self.address(value - 4) if self.flags[at + 4] else value

    def run(self, pc: int = 8300, most: int = 20000) -> None:
        """Execute instructions until a halt, or until the routine at ``pc`` returns."""
        for _ in range(most):
            operation = 10 * self.digits[pc] + self.digits[pc + 1]
            is_immediate = operation in (11, 12, 13, 14, 16, 17)
            p = self.address(pc + 2)
            # An indirect address does not exist where Q is data.
            q = pc + 11 if is_immediate else 0 if operation in (15, 48, 49) else self.address(pc + 7)
            if operation == 48 or (operation == 42 and not self.returns):
                return
            pc = self._execute(operation, p, q, pc)
        raise AssertionError("the program does not end")

    def _execute(self, operation: int, p: int, q: int, pc: int) -> int:
        """Execute an instruction and return the position of the next one."""
        after = pc + 12
        match operation:
            case 11 | 21 | 12 | 22:
                value = self.number(p) + (-self.number(q) if operation % 10 == 2 else self.number(q))
                self.store(p, value, p - self.high(p) + 1)
            case 13 | 23:
                length = p - self.high(p) + 1 + q - self.high(q) + 1
                value = self.number(p) * self.number(q)
                self.digits[80:100], self.flags[80:100] = [0] * 20, [False] * 20
                self.store(99, value, length)
                self.flags[100 - length] = False
            case 14 | 24:
                self.compared = self.number(p) - self.number(q)
            case 15:
                self.digits[p], self.flags[p] = self.digits[pc + 11], self.flags[pc + 11]
            case 16 | 26:
                self.copy(p, q)
            case 32 | 33:
                self.flags[p] = operation == 32
            case 42:
                after, self.returns = self.returns, 0
            case 43:
                after = p if self.digits[q] else after
            case 44:
                after = after if self.flags[q] else p
            case 46 | 47:
                is_on = {11: self.compared > 0, 12: self.compared == 0, 13: self.compared >= 0}[q // 100]
                after = p if is_on == (operation == 46) else after
            case 49:
                after = p
            case 17 | 27:
                after = self._call(p, self.address(pc + 7), after)
            case _:
                raise AssertionError(f"operation {operation} at {pc}")
        return after

    def _call(self, entry: int, operand: int, after: int) -> int:
        """Answer a call of IBM's library, or enter a routine of the program."""
        if entry > 8300:
            self.returns = after
            return entry
        if entry in FLOATING:
            self.set_fac(FLOATING[entry](*self.fac(60), *self.fac(operand), RULES)[:2])
        elif entry == 1756:
            self.set_fac(divide(*self.fac(operand), *self.fac(60), RULES)[:2])
        elif entry in (2644, 2700, 2748):
            x, y = self.number(60), self.number(operand)
            self.store(60, wrap_integer({2644: x + y, 2700: x - y, 2748: x * y}[entry]), 4)
        elif entry in (2816, 2876):
            x, y = self.number(60), self.number(operand)
            self.store(60, divide_fixed(*((y, x) if entry == 2816 else (x, y)))[0], 4)
        elif entry in (1238, 1306):
            to, units = (60, operand) if entry == 1238 else (operand, 60)
            self.copy(to, units)
            self.copy(to - 2, units - 2)
        elif entry == 2546:
            # The flag over the exponent tells a floating-point number from a fixed-point one.
            if self.flags[59]:
                self.set_fac(negate(*self.fac(60)))
            else:
                self.store(60, -self.number(60), 4)
        elif entry == 3222:
            self.set_fac(from_integer(self.number(60), RULES))
        elif entry == 3494:
            self.store(60, to_integer(*self.fac(60), RULES), 4)
            self.flags[59] = False
        elif entry in (ITEM, LAST_ITEM):
            self.punched.append(self.fac(operand) if self.flags[operand - 1] else self.number(operand))
        return after

    def fac(self, units: int) -> Number:
        """Return a floating-point number as mantissa and exponent."""
        mantissa, exponent = self.number(units - 2), self.number(units)
        return (mantissa, exponent) if mantissa else (0, MINUS_ZERO if self.flags[units - 2] else ZERO)

    def set_fac(self, number: Number) -> None:
        mantissa, exponent = number
        self.store(58, mantissa, 8)
        self.store(60, max(exponent, ZERO), 2)
        self.flags[58] = mantissa < 0 or exponent == MINUS_ZERO


def _plain(text: str) -> str:
    return "".join(str(FLAGGED.index(c)) if c in FLAGGED else c for c in text)
