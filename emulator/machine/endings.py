"""Why a run ended, in words: what the registers hold when the engine stops for good, and where a run loops."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from emulator.compiled import kernel as engine
from emulator.language.objectcode import Program
from emulator.machine.result import Ending
from emulator.numbers.arithmetic import FIXED_POINT, UNDEFINED


def stopped(program: Program, reason: int, registers: Sequence[int], held: int) -> Ending:
    """The ending for a reason the engine does not go on from; ``held`` is the exponent of the field at ADDRESS."""
    address, index, index2 = registers[engine.ADDRESS], registers[engine.INDEX], registers[engine.INDEX2]
    if reason == engine.AT_STOP:
        return Ending("stop" if program.code[registers[engine.PC]].second == 0 else "end")
    here = program.line_at(registers[engine.AT])
    name = program.storage.name_of
    where = f"{program.source}: card {here.place.card}"
    words = f"{here.label} {here.text}" if here.label else here.text
    if reason == engine.AT_UNDEFINED and held == UNDEFINED:
        return Ending("undefined", f"{where}: {name(address)} is undefined where it is computed with, in {words}")
    if reason == engine.AT_UNDEFINED:
        # Only with --bounds core: a neighbour's number of the other mode.
        mode = "fixed" if held == FIXED_POINT else "floating"
        return Ending("mode", f"{where}: {name(address)} holds a number in {mode} point, in {words}")
    if reason == engine.AT_BOUNDS:
        entry = program.storage.entry_of(address)
        subscript = f"{index},{index2}" if len(entry.shape) > 1 else str(index)
        shape = ",".join(map(str, entry.shape))
        return Ending("bounds", f"{where}: {entry.name}({subscript}) is outside {entry.name}({shape}), in {words}")
    if reason == engine.AT_OUTSIDE:
        return Ending("outside", f"{where}: a subscript reaches outside the data into the program, in {words}")
    return Ending("select", f"{where}: a computed GO TO with value {index}, in {words}")


def undecided(program: Program, at: int, error: str) -> Ending:
    """The ending where the numbers cannot say what a statement asks of them."""
    here = program.line_at(at)
    words = f"{here.label} {here.text}" if here.label else here.text
    return Ending("undecided", f"{program.source}: card {here.place.card}: {error}, in {words}")


def looped(program: Program, limit: int, before: Sequence[int], counts: Sequence[int]) -> Ending:
    """The ending at the statement limit: where the last statements were, from the counts before and after them."""
    ran = [
        (program.statements[counter.statement], new - old)
        for counter, old, new in zip(program.counters, before, counts, strict=True)
        if counter.begins and new > old
    ]
    if not ran:
        return Ending("limit", f"{program.source}: stopped after {limit} statements")
    cards = sorted({line.place.card for line, _ in ran})
    labels = [str(line.label) for line, _ in ran if line.label]
    span = f"card {cards[0]}" if len(cards) == 1 else f"cards {cards[0]} to {cards[-1]}"
    word = "statement" if len(labels) == 1 else "statements"
    among = f", {word} {', '.join(labels[:12])}{' ...' if len(labels) > 12 else ''}" if labels else ""
    what = "it loops on" if all(times > 1 for _, times in ran) else "it was on"
    return Ending("limit", f"{program.source}: stopped after {limit} statements; {what} {span}{among}")


def pausing(program: Program, statement: int) -> str:
    """The warning that goes with a PAUSE."""
    return f"{program.source}: PAUSE at {program.statements[statement].name}: the operator presses START"


def begun(program: Program, counts: Sequence[int]) -> int:
    """How many statements began, from the counts."""
    return sum(n for counter, n in zip(program.counters, counts, strict=True) if counter.begins)


def error_counts(errors: Mapping[tuple[str, int], int]) -> tuple[tuple[str, int], ...]:
    """Error codes and how often, from those by code and card."""
    return tuple((f"{code} on card {card}", n) for (code, card), n in sorted(errors.items()))
