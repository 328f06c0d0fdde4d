"""The compiled engine with one program: it runs decks of character codes, and returns counts and a log for each.

numba compiles the unchanged Python code of :func:`emulator.compiled.deck.run_decks` and of the functions that it calls.
Numbers have at most nine digits, because products must fit into 64 bits.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import accumulate, chain
from typing import Any

import numpy as np

from emulator.compiled import deck as decks
from emulator.compiled import devices, kernel
from emulator.jit.functions import Compiled, NotInstalled
from emulator.language.cards import CHARACTERS, COLUMNS, MAX_CARDS, RECORD_MARKS, Deck, deck_from_lines
from emulator.language.compiler import compile_deck
from emulator.language.formats import MAX_RECORD, Literal
from emulator.language.objectcode import Flat, Program
from emulator.machine.interpreter import AT_LIMIT
from emulator.machine.result import Options
from emulator.machine.state import FLOATING, loaded, refuse_overlap
from emulator.numbers.decimal import DecimalNumbers
from emulator.numbers.fields import Field

MAX_DIGITS = 9
INSTEAD = "using the interpreter instead"

# The largest number of decks in one call of the compiled code.
BLOCK = 128
# The initial and the largest size of a block's log in bytes.  A deck that needs more runs in the interpreter.
LOG_ROOM, MOST_LOG_ROOM = 1 << 20, 1 << 26

# The keys of Result.numbers, in the order of the counts in a row of Report.numbers.
WAYS = ("E<", "E>", "F<", "F>", "I<", "I>")

_VERBS = {"READ": devices.READ, "PUNCH": devices.PUNCH, "ACCEPT": devices.ACCEPT}
_KINDS = {"E": devices.E_FIELD, "F": devices.F_FIELD, "I": devices.I_FIELD}
_CARD_CODES = "".join(sorted(CHARACTERS.difference(RECORD_MARKS))).encode("ascii")


def why_plain(options: Options) -> str:
    """Return one line that says why these options need the interpreter, or "" if the compiled engine supports them."""
    if not isinstance(options.numbers, DecimalNumbers):
        return f"the compiled engine does not support {options.numbers.name} arithmetic: {INSTEAD}"
    if options.uncut:
        return f"the compiled engine does not support --uncut: {INSTEAD}"
    profile = options.numbers.profile
    if profile.digits > MAX_DIGITS:
        return (
            f"{profile.name} has {profile.digits} digits; the compiled engine supports at most {MAX_DIGITS}: {INSTEAD}"
        )
    try:
        run_decks()
    except NotInstalled as error:
        return f"{error}: {INSTEAD}"
    return ""


@cache
def run_decks() -> Compiled:
    """Return ``deck.run_decks`` prepared for compilation.  Raise NotInstalled if numba cannot be used."""
    # The code never divides by zero, so numba need not check divisors (error_model).  It creates no arrays, so numba
    # need not count references to them (_nrt).  The second option is documented only in
    # numba.extending.register_jitable; without it a run takes a sixth longer, because every call counts each of its
    # arrays.
    return Compiled(decks.run_decks, error_model="numpy", _nrt=False)


def must_compile() -> bool:
    """Return True if numba is available but has not compiled the engine yet.  The interpreter is faster until then."""
    try:
        return run_decks().must_compile
    except NotInstalled:
        return False


def compile_engine() -> None:
    """Compile the engine, or load it from numba's cache.  Raise NotInstalled if numba cannot be used.

    A study calls this function in a separate process, while its workers begin with the interpreter.
    """
    Runner(compile_deck(deck_from_lines("empty", ["END"])), Options())


def packed(deck: Deck) -> bytes | None:
    """Return 80 character codes for each card, or None if a card has a record mark or an invalid character."""
    return _columns([card.text for card in deck.cards])


def packed_text(text: str) -> bytes | None:
    """Return 80 character codes for each card of a deck's text, or None if the interpreter must read the text.

    The interpreter must read texts with record marks, invalid characters or too many cards.
    """
    lines = text.replace("\r\n", "\n").split("\n")
    if lines[-1] == "":
        lines.pop()
    if len(lines) > MAX_CARDS:
        return None
    return _columns([line.rstrip(" ") for line in lines])


def _columns(lines: list[str]) -> bytes | None:
    packed = "".join([line.ljust(COLUMNS) for line in lines]).encode("ascii", "replace")
    if len(packed) != COLUMNS * len(lines) or packed.translate(None, _CARD_CODES):
        return None
    return packed


@dataclass(frozen=True, slots=True)
class Run:
    """The counts, registers and log of one compiled run, as Python integers."""

    reason: int
    cards_read: int
    held: int
    log: bytes
    registers: list[int]
    counts: list[int]
    before: list[int]
    numbers: list[int]
    # Each pair has CODES * statement + error code, and the number of occurrences.
    errors: list[tuple[int, int]]
    # The PAUSE statements that were executed, in order of their first execution.
    pauses: list[int]

    def lines(self) -> list[str]:
        """Return the lines of the log; each consists of a letter that names the operation and a text."""
        return self.log.decode("ascii").split("\n")[:-1]


class Runner:
    """The compiled engine with one program, for blocks of decks.

    Raise DeckError if the program does not fit the machine, and :class:`emulator.jit.functions.NotInstalled` if numba
    cannot be used.
    """

    def __init__(self, program: Program, options: Options) -> None:
        assert isinstance(options.numbers, DecimalNumbers)
        profile = options.numbers.profile
        refuse_overlap(program, options.core)
        values, kinds = loaded(program, options.numbers)
        start = [value if kind == FLOATING else (value, kind) for value, kind in zip(values, kinds, strict=True)]
        self.code, self.forms = _code(program), _forms(program)
        self.start = decks.Start(_row(m for m, _ in start), _short(e for _, e in start))
        fields, statements = len(values), len(program.statements)
        self.core = kernel.Core(
            mantissas=_row([0] * fields),
            exponents=_short([0] * fields),
            switches=_row([int(n in options.switches) for n in (1, 2, 3, 4)]),
        )
        self.tools = devices.Tools(
            texts=_codes(bytes(self.forms.texts)),
            devices=_row([0] * devices.DEVICES),
            line=_codes(bytes(devices.LINE_ROOM)),
            field=_codes(bytes(MAX_RECORD)),
        )
        widths = {
            "ends": devices.ENDS,
            "registers": kernel.REGISTERS,
            "counts": len(program.counters),
            "before": len(program.counters),
            "numbers": len(WAYS),
            "errors": devices.CODES * statements,
            "pauses": statements,
        }
        rows: dict[str, Any] = {name: np.zeros((BLOCK, width), np.int64) for name, width in widths.items()}
        self.report = devices.Report(**rows, log=_codes(bytes(LOG_ROOM)))
        self.rules = profile.rules
        flags = options.bounds == "strict", options.hopper == "any"
        self.setting = (options.limit, *map(int, flags))
        # Load or compile the machine code now, so that a failure is noticed before the first deck.
        self.kernel = run_decks().ready(*self._arguments([]))

    def runs(self, packed: Sequence[bytes | None]) -> Iterator[Run | None]:
        """Yield a run for each deck, or None if only the interpreter can run the deck.  Accept at most BLOCK decks."""
        at = 0
        while at < len(packed):
            # A deck that could not be packed is passed as an empty deck, to keep the order.
            completed = self.kernel(*self._arguments([deck or b"" for deck in packed[at:]]))
            runs = [self._run(d) for d in range(completed)]
            for run in runs:
                yield None if packed[at] is None else run
                at += 1
            if not runs:
                # The log is too small for a single deck: enlarge it.
                log = self.report.log
                if len(log) < MOST_LOG_ROOM:
                    self.report = self.report._replace(log=_codes(bytes(4 * len(log))))
                else:
                    yield None
                    at += 1

    def _arguments(self, packed: list[bytes]) -> tuple[Any, ...]:
        first = _row(accumulate((len(deck) // COLUMNS for deck in packed), initial=0))
        cards = devices.Cards(_codes(b"".join(packed)), first)
        return self.code, self.forms, self.start, cards, self.core, self.tools, self.report, self.rules, self.setting

    def _run(self, d: int) -> Run | None:
        report: Any = self.report
        reason, cards_read, start, end, held = report.ends[d].tolist()
        if reason == devices.NOT_HERE:
            return None
        errors, pauses = report.errors[d], report.pauses[d]
        paused = np.flatnonzero(pauses)
        return Run(
            reason=reason,
            cards_read=cards_read,
            held=held,
            log=report.log[start:end].tobytes(),
            registers=report.registers[d].tolist(),
            counts=report.counts[d].tolist(),
            before=report.before[d].tolist() if reason == AT_LIMIT else [],
            numbers=report.numbers[d].tolist(),
            errors=[(k, int(errors[k])) for k in np.flatnonzero(errors).tolist()],
            pauses=paused[np.argsort(pauses[paused])].tolist(),
        )


def _row(numbers: Iterable[int]) -> Any:
    return np.array(list(numbers), dtype=np.int64)


def _short(numbers: Iterable[int]) -> Any:
    return np.array(list(numbers), dtype=np.int32)


def _codes(text: bytes) -> Any:
    return np.array(bytearray(text), dtype=np.uint8)


def _code(program: Program) -> devices.Code:
    roots = [int(name == "SQRT") for name in program.functions]
    verbs = [_VERBS.get(verb, devices.TYPE) for verb in program.verbs]
    *rows, fields = program.flat
    flat = Flat._make([*map(_short, rows), fields])
    marks = devices.Marks(_short(flat.seconds), _short(program.statement_numbers), _short(verbs))
    return devices.Code(flat, marks, _short(roots))


def _forms(program: Program) -> devices.Forms:
    forms: list[tuple[int, int, int, int, int]] = []
    parts: list[tuple[int, int, int, int]] = []
    texts = ""
    for _, spec in program.formats:
        first = len(parts)
        for part in spec.specs:
            if isinstance(part, Field):
                parts.append((_KINDS[part.kind], part.width, part.decimals, 0))
            elif isinstance(part, Literal):
                parts.append((devices.TEXT, len(part.text), 0, len(texts)))
                texts += part.text
            else:
                parts.append((devices.SLASH, 0, 0, 0))
        forms.append((first, len(parts), first + spec.again, int(spec.has_fields), spec.charge))
    return devices.Forms(
        _row(chain.from_iterable(forms)), _row(chain.from_iterable(parts)), _codes(texts.encode("ascii"))
    )
