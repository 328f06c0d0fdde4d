"""Generate code for expressions, in a fixed order of operations, on which the sign of every zero result depends.

The order was determined from the object code of PDQ FORTRAN.  With this order, every zero that the thesis prints has
its printed sign, and the only known program that IBM's compiler of 1962 compiled has the same operations.  Operations
run from left to right (C26-5619 p. 19).  If the right operand is itself an expression, it is computed in FAC, and the
left operand is then combined with FAC.  Signs are deferred: the compiler remembers whether the accumulator or a
temporary field holds the negative of its value, and chooses addition or subtraction accordingly.  The sign is reversed
only before the value is stored, tested, or passed to a function or a power.  So ``A-B*C-D`` is computed as B*C - A + D.
The sign of this sum is reversed at the end, which makes a result of zero a minus zero.
"""

from dataclasses import dataclass, field

from emulator.errors import Refused
from emulator.language import objectcode as op
from emulator.language.foreign import suggest_function
from emulator.language.objectcode import Counter, Instruction, Subscript
from emulator.language.storage import Allocator
from emulator.language.tree import Expression, Number, Power, Product, Reference, Sum
from emulator.numbers.arithmetic import TRUNCATING
from emulator.numbers.fields import FieldError, parse_constant

# The library functions. Each may also be written with a final F (C26-5619 p. 63, 66).
LIBRARY = ("SIN", "COS", "ATAN", "EXP", "LOG", "SQRT")

_ROLES = ("to", "from", "+", "-", "-r", "*", "/", "/r", "reverse")
_FLOATING = dict(
    zip(_ROLES, (op.TOFAC, op.FMFAC, op.FAD, op.FSB, op.FSBR, op.FMP, op.FDV, op.FDVR, op.RSGN), strict=True)
)
_FIXED = dict(zip(_ROLES, (op.TOFIX, op.FMFIX, op.XAD, op.XSB, op.XSBR, op.XMP, op.XDV, op.XDVR, op.RSGX), strict=True))


@dataclass(frozen=True, slots=True)
class Operand:
    """An operand of an instruction: the address of a variable or constant, or an array element with its subscript."""

    address: int
    subscript: int = -1


@dataclass
class Emitter:
    """The object code of a program, with its subscripts and storage fields, while the compiler generates it."""

    allocator: Allocator = field(default_factory=Allocator)
    code: list[Instruction] = field(default_factory=list)
    subscripts: dict[Subscript, int] = field(default_factory=dict)
    arrays: dict[str, tuple[int, ...]] = field(default_factory=dict)
    counters: list[Counter] = field(default_factory=list)
    # Products and parenthesized sums of the current statement are groups, numbered as they are completed.  ``held`` is
    # the number of the group in the accumulator, or -1.
    groups: int = 0
    held: int = -1
    # The mode of each expression of the current statement, by the expression's identity: True for fixed point.
    modes: dict[int, bool] = field(default_factory=dict)

    def emit(self, operation: int, operand: Operand | None = None, address: int = 0, second: int = 0) -> None:
        if operand is None:
            self.code.append(Instruction(operation, address, -1, second))
        else:
            self.code.append(Instruction(operation, operand.address, operand.subscript, second))

    def count(self, statement: int, begins: bool, what: str) -> None:
        """Emit a COUNT instruction, which begins a section of code without branches into or out of it."""
        self.counters.append(Counter(statement, begins, what))
        self.emit(op.COUNT, address=len(self.counters) - 1)

    def begin_statement(self) -> None:
        """Free the fields of the previous statement's intermediate results for the next statement."""
        self.groups, self.held = 0, -1
        self.modes.clear()

    def group(self) -> None:
        """Number the product or parenthesized sum in the accumulator: the first one of a statement is 0, the next 1."""
        self.held, self.groups = self.groups, self.groups + 1

    def temporary(self) -> Operand:
        """Return the temporary field that is reserved for the intermediate result in the accumulator."""
        if self.held < 0:
            self.group()
        return Operand(self.allocator.place("temporary", f"temporary {self.held}").first)

    def constant(self, number: Number) -> Operand:
        if number.floating:
            try:
                parse_constant(number.text, TRUNCATING.rules)
            except FieldError as error:
                raise Refused(number.place, f"constant {error}") from None
        return Operand(self.allocator.place("constant", f"constant {number.text}").first)

    def variable(self, reference: Reference) -> Operand:
        """Return the operand of a variable or array element.  Raise Refused if the reference is invalid."""
        shape = self.arrays.get(reference.name)
        if shape is None:
            if reference.arguments:
                raise unknown_function(reference)
            return Operand(self.allocator.place("variable", reference.name).first)
        if not reference.arguments:
            raise Refused(reference.place, f"the array {reference.name} needs a subscript here")
        if len(reference.arguments) != len(shape):
            raise Refused(
                reference.place,
                f"{reference.name} needs {len(shape)} subscript{'s' * (len(shape) > 1)} (see its DIMENSION), "
                f"found {len(reference.arguments)}",
            )
        entry = self.allocator.place("array", reference.name, shape)
        parts = [self.subscript(argument) for argument in reference.arguments]
        # Constant subscripts within the array give a fixed address.  Others are computed at run time unchecked, so
        # they may reach outside the array as they did on the machine.
        if all(v < 0 for v, _, _ in parts) and all(1 <= o <= d for (_, _, o), d in zip(parts, shape, strict=True)):
            offset = parts[0][2] - 1 + (shape[0] * (parts[1][2] - 1) if len(parts) > 1 else 0)
            return Operand(entry.first + offset)
        (v1, c1, o1), rows = parts[0], shape[0]
        v2, c2, o2 = parts[1] if len(parts) > 1 else (-1, 0, 1)
        columns = shape[1] if len(shape) > 1 else 0
        description = Subscript(entry.first, v1, c1, o1, rows, v2, c2, o2, columns)
        return Operand(entry.first, self.subscripts.setdefault(description, len(self.subscripts)))

    def subscript(self, argument: Expression) -> tuple[int, int, int]:
        """Return a subscript ``c*v+k`` as three integers: the storage field of v (-1 if v is absent), c, and k.

        Raise Refused if the subscript has another form.
        """
        term, addend = argument, 0
        if isinstance(argument, Sum):
            if argument.minus or len(argument.rest) != 1:
                raise Refused(
                    argument.place, "expected a subscript v, c, v+c, v-c, c*v, c*v+c or c*v-c (variable v, constant c)"
                )
            (sign, constant), term = argument.rest[0], argument.first
            addend = (1 if sign == "+" else -1) * self._whole(constant)
        # What remains is v, c, c*v or c*c, where a product must begin with its constant.
        factor = 1
        if isinstance(term, Product):
            if len(term.rest) != 1 or term.rest[0][0] != "*":
                raise Refused(
                    term.place, "expected a subscript v, c, v+c, v-c, c*v, c*v+c or c*v-c (variable v, constant c)"
                )
            factor, term = self._whole(term.first), term.rest[0][1]
        # A constant subscript has no variable.  Its factor and its constant are combined into the addend.
        if isinstance(term, Number):
            return -1, 0, factor * self._whole(term) + addend
        if (
            not isinstance(term, Reference)
            or term.arguments
            or term.name in self.arrays
            or not is_fixed_name(term.name)
        ):
            raise Refused(term.place, "the variable of a subscript must be a fixed-point variable without subscript")
        return self.variable(term).address, factor, addend

    @staticmethod
    def _whole(expression: Expression) -> int:
        if not isinstance(expression, Number) or expression.floating:
            raise Refused(expression.place, "the constants of a subscript must be integers")
        return int(expression.text)

    def fixed(self, expression: Expression) -> bool:
        """Return True for a fixed-point expression.  Raise Refused if fixed and floating point are mixed."""
        # Every level of parentheses calls this method.  The cache keeps the time for nested parentheses linear.
        mode = self.modes.get(id(expression))
        if mode is None:
            mode = self.modes[id(expression)] = self._mode(expression)
        return mode

    def _mode(self, expression: Expression) -> bool:
        if isinstance(expression, Number):
            return not expression.floating
        if isinstance(expression, Reference):
            if function_of(expression, self.arrays):
                return False
            return is_fixed_name(expression.name)
        if isinstance(expression, Power):
            if self.fixed(expression.base):
                raise Refused(expression.place, "a fixed-point quantity may not be raised to a power", 5)
            self.fixed(expression.exponent)
            return False
        # All operands of a sum or product must have the mode of the first one (p. 19).
        mode = self.fixed(expression.first)
        for _, part in expression.rest:
            if self.fixed(part) != mode:
                raise Refused(part.place, "fixed and floating point are mixed in one expression", 5)
        return mode

    def load(self, expression: Expression) -> None:
        """Emit code that leaves the value of ``expression`` in the fixed or floating accumulator."""
        self.settle(self.deferred(expression), self.fixed(expression))

    def settle(self, negative: bool, fixed: bool) -> None:
        """Emit code that reverses the sign of the accumulator if it holds the negative of the value."""
        if negative:
            table, last = _FIXED if fixed else _FLOATING, self.code[-1]
            if last.operation == table["-"]:
                # FSBR does the same as FSB followed by RSGN.
                self.code[-1] = Instruction(table["-r"], last.address, last.subscript, last.second)
            else:
                self.emit(table["reverse"])

    def deferred(self, expression: Expression) -> bool:
        """Emit code that leaves a value or its negative in the accumulator.  Return True if it is the negative."""
        table = _FIXED if self.fixed(expression) else _FLOATING
        bare, negative = _unsigned(expression)
        operand = self.simple(bare)
        if operand is not None:
            self.emit(table["to"], operand)
            self.held = -1
        elif isinstance(bare, (Sum, Product)):
            negative ^= self._chain(bare, table)
        elif isinstance(bare, Power):
            self._power(bare)
        elif isinstance(bare, Reference):
            self._function(bare)
        return negative

    def _part(self, expression: Expression) -> bool:
        """Emit code for one operand of a sum or product.  Return True if the accumulator holds minus the operand."""
        negative = self.deferred(expression)
        if isinstance(expression, Sum):
            self.group()
        return negative

    def _load_part(self, expression: Expression) -> None:
        self.settle(self._part(expression), self.fixed(expression))

    def simple(self, expression: Expression) -> Operand | None:
        """Return the operand of a constant, a variable or an array element, or None for any other expression."""
        if isinstance(expression, Number):
            return self.constant(expression)
        if isinstance(expression, Reference) and not function_of(expression, self.arrays):
            return self.variable(expression)
        return None

    def _chain(self, expression: Sum | Product, table: dict[str, int]) -> bool:
        """Emit code that combines the operands of a sum or product from left to right.

        Return True if the accumulator then holds the negative of the result.

        ``waiting`` is the left operand while it is in a storage field and not in the accumulator.  A right operand that
        must be computed needs the accumulator, so the left operand stays in a field, if necessary a temporary one, and
        is then combined with the accumulator.  ``minus`` is True if the field or the accumulator holds the negative of
        the left operand.  ``negative`` is the same for the right operand.
        """
        first, minus = _unsigned(expression.first)
        minus ^= isinstance(expression, Sum) and expression.minus
        waiting = self.simple(first)
        if waiting is None:
            minus ^= self._part(first)
        for sign, part in expression.rest:
            bare, negative = _unsigned(part)
            operand = self.simple(bare)
            is_computed = operand is None
            if is_computed:
                # The result so far is in the accumulator: save it before the accumulator is used again.
                if waiting is None:
                    waiting = self.temporary()
                    self.emit(table["from"], waiting)
                negative ^= self._part(bare)
                operand = waiting
            elif waiting is not None:
                self.emit(table["to"], waiting)
                self.held = -1
            # The sum keeps the sign of the accumulator.  If the two operands have different deferred signs, they are
            # subtracted.
            if isinstance(expression, Sum):
                negative ^= sign == "-"
                sign = "+" if negative == minus else "-"
                minus = negative if is_computed else minus
            else:
                minus ^= negative
                sign = "/r" if is_computed and sign == "/" else sign
            self.emit(table[sign], operand)
            waiting = None
        # IBM's compiler reserved a field for every product, whether or not the code uses it.
        if isinstance(expression, Product):
            self.group()
            self.temporary()
        return minus

    def _power(self, expression: Power) -> None:
        base, exponent = expression.base, expression.exponent
        # A ** B is POWER, A ** 2 is a product, and any other A ** J is POWERX.
        # The base stays in its field, or in a temporary, while the exponent is computed in FAC.
        operand = self.simple(base)
        if not self.fixed(exponent):
            if operand is None:
                self._load_part(base)
                operand = self.temporary()
                self.emit(op.FMFAC, operand)
            self._load_part(exponent)
            self.emit(op.POWER, operand)
            self.held = -1
            return
        # The known object code computes a square as the product of the base with itself.
        if isinstance(exponent, Number) and exponent.text == "2":
            self._load_part(base)
            if operand is None:
                operand = self.temporary()
                self.emit(op.FMFAC, operand)
            self.emit(op.FMP, operand)
            self.group()
            self.temporary()
            return
        # The exponent is computed first, because POWERX takes the base from FAC.
        power = self.simple(exponent)
        if power is None:
            self._load_part(exponent)
            power = self.temporary()
            self.emit(op.FMFIX, power)
        self._load_part(base)
        self.emit(op.POWERX, power)
        self.held = -1

    def _function(self, reference: Reference) -> None:
        name = function_of(reference, self.arrays)
        if len(reference.arguments) != 1:
            raise Refused(reference.place, f"{reference.name} needs exactly one argument")
        if self.fixed(reference.arguments[0]):
            raise Refused(reference.place, f"{reference.name} needs a floating-point argument", 5)
        self.load(reference.arguments[0])
        self.emit(op.FUNCTION, address=LIBRARY.index(name))
        self.held = -1


def is_fixed_name(name: str) -> bool:
    """Return True for the name of an integer variable, which begins with I, J, K, L, M or N (C26-5619 p. 16)."""
    return name[0] in "IJKLMN"


def function_of(reference: Reference, arrays: dict[str, tuple[int, ...]]) -> str:
    """Return the name of the library function that an expression such as ``SIN(X)`` calls, or an empty string."""
    if not reference.arguments or reference.name in arrays:
        return ""
    name = reference.name.removesuffix("F")
    return name if name in LIBRARY else ""


def unknown_function(reference: Reference) -> Refused:
    """Return the error for a name with arguments that is neither an array nor a library function."""
    advice = suggest_function(reference.name, LIBRARY)
    message = f"{reference.name} is neither an array nor a library function; {advice}"
    return Refused(reference.place, message, about=reference.name)


def _unsigned(expression: Expression) -> tuple[Expression, bool]:
    """Return an expression without the minus signs before it, and True if the number of these signs was odd."""
    if isinstance(expression, Sum) and not expression.rest:
        inner, odd = _unsigned(expression.first)
        return inner, odd ^ expression.minus
    return expression, False
