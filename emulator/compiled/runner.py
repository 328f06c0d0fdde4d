"""The compiled engine with one program in core: blocks of packed decks in, one row of numbers and a log a deck out.

numba compiles :func:`emulator.compiled.deck.run_decks` and what it calls as they stand.  Numbers must fit into 64 bits:
nine digits are the most, whose products have eighteen.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import accumulate, chain
from typing import Any

import numpy as np

from emulator.compiled import deck as decks
from emulator.compiled import devices, kernel
from emulator.jit.functions import Compiled, NotInstalled
from emulator.language.cards import CHARACTERS, COLUMNS, MAX_CARDS, Deck, deck_from_lines
from emulator.language.compiler import compile_deck
from emulator.language.formats import MAX_RECORD, Literal
from emulator.language.objectcode import Flat, Program, flatten
from emulator.machine.interpreter import AT_LIMIT
from emulator.machine.result import Options
from emulator.machine.session import loaded, refuse_overlap
from emulator.machine.state import FLOATING
from emulator.numbers.decimal import DecimalNumbers
from emulator.numbers.fields import Field

MAX_DIGITS = 9
INSTEAD = "the plain engine runs instead"

BLOCK = 128
"""The most decks at a time."""
LOG_ROOM = 1 << 20
MOST_LOG_ROOM = 1 << 26
"""Room for the log of a block; a deck that needs more than the most is left to the plain kernel."""

WAYS = ("E<", "E>", "F<", "F>", "I<", "I>")
"""What Result.numbers counts, in order of Report.numbers."""

_VERBS = {"READ": devices.READ, "PUNCH": devices.PUNCH, "ACCEPT": devices.ACCEPT}
_KINDS = {"E": devices.E_FIELD, "F": devices.F_FIELD, "I": devices.I_FIELD}
_CARD_CODES = "".join(sorted(CHARACTERS)).encode("ascii")


def why_plain(options: Options) -> str:
    """Return one line saying why these options need the interpreter, or "" if the compiled engine can run them.

    Only :class:`Runner` finds out whether the machine code can be compiled or loaded.
    """
    if not isinstance(options.numbers, DecimalNumbers):
        return f"the compiled engine has no {options.numbers.name} numbers: {INSTEAD}"
    if options.uncut:
        return f"the compiled engine keeps no numbers beside the cards: {INSTEAD}"
    profile = options.numbers.profile
    if profile.digits > MAX_DIGITS:
        return f"{profile.name} has {profile.digits} digits, the compiled engine has at most {MAX_DIGITS}: {INSTEAD}"
    try:
        run_decks()
    except NotInstalled as error:
        return f"{error}: {INSTEAD}"
    return ""


@cache
def run_decks() -> Compiled:
    """:func:`emulator.compiled.deck.run_decks` for numba to compile.  Raises emulator.jit.functions.NotInstalled."""
    # Nothing is divided by zero and no array is made, so that numba need not look for the one nor count the other's
    # users.  The second option is named in the docstring of numba.extending.register_jitable only; without it a run
    # takes a sixth longer, as every call counts each array it is given.
    return Compiled(decks.run_decks, error_model="numpy", _nrt=False)


def compile_engine() -> None:
    """Compile the engine, or load it from numba's cache.

    A study calls this before its worker processes start, so that they find the machine code in the cache.
    Raises :class:`emulator.jit.functions.NotInstalled`.
    """
    Runner(compile_deck(deck_from_lines("empty", ["END"])), Options())


def packed(deck: Deck) -> bytes | None:
    """80 codes a card; None for what only a deck not made by emulator/language/cards.py can hold."""
    return _columns([card.text for card in deck.cards])


def packed_text(text: str) -> bytes | None:
    """The same of a deck's text; None for what is not a deck: reading it card by card says why."""
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
    """A deck's row of the report, as numbers of Python."""

    reason: int
    cards_read: int
    held: int
    log: bytes
    registers: list[int]
    counts: list[int]
    before: list[int]
    numbers: list[int]
    errors: list[tuple[int, int]]
    """(CODES * statement + number of the code, how often)"""
    pauses: list[int]
    """Statements, in order of their first pause."""

    def lines(self) -> list[str]:
        """The log: a letter and a text each."""
        return self.log.decode("ascii").split("\n")[:-1]


class Runner:
    """One program in core, ready to be run over blocks of decks.

    Raises what Machine does, and emulator.jit.functions.NotInstalled.
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
        flags = options.bounds == "strict", profile.types_errors, options.hopper == "any"
        self.setting = (options.limit, *map(int, flags))
        # Kept code that is damaged, or a numba of another kind, is found out here, before a deck is begun.
        self.kernel = run_decks().ready(*self._arguments([]))

    def runs(self, packed: Sequence[bytes | None]) -> Iterator[Run | None]:
        """One after the other; None for a deck that needs a Machine.  At most BLOCK decks."""
        at = 0
        while at < len(packed):
            # What cannot be packed goes in as an empty hopper.
            found = self._some([deck or b"" for deck in packed[at:]])
            for run in found:
                yield None if packed[at] is None else run
                at += 1
            if not found:
                # Not even one deck's log had room.
                log = self.report.log
                if len(log) < MOST_LOG_ROOM:
                    self.report = self.report._replace(log=_codes(bytes(4 * len(log))))
                else:
                    yield None
                    at += 1

    def _some(self, packed: list[bytes]) -> list[Run | None]:
        """As many decks as the log has room for."""
        return [self._run(d) for d in range(self.kernel(*self._arguments(packed)))]

    def _arguments(self, packed: list[bytes]) -> tuple[Any, ...]:
        """What the kernel is called with for these decks."""
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
    flat = Flat._make(map(_short, flatten(program)))
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
