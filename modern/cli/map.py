"""``hull1620 map``: where every array and variable lies, and what number of points fits."""

from __future__ import annotations

import argparse
from collections.abc import Iterator

from emulator.language.objectcode import Program, code_positions
from emulator.language.storage import FIELD, core_address
from emulator.machine.session import overlap
from modern.cli.shared.console import OK
from modern.cli.shared.machine import layers_of, load_program
from modern.edition import programs
from modern.formats.deck import MAX_POINTS
from modern.thesis.capacity import array_lengths, largest

_PLURALS = {"constant": "constants", "temporary": "temporaries", "statement number": "statement numbers"}


def main(args: argparse.Namespace) -> int:
    """Print the map."""
    program = load_program(args.program, layers_of(args), args.upcase)
    for line in map_lines(program, args.core):
        print(line)
    if args.program in programs.NAMES:
        print(capacity_line(program, args.core))
    return OK


def map_lines(program: Program, core: int) -> Iterator[str]:
    """The storage map: addresses are those of a field's rightmost digit; element 1 lies highest."""
    yield f"{program.source}: storage in a machine of {core} positions (estimated program length marked ~)"
    yield f"  {'name':<20}{'kind':<18}{'fields':>7}  {'from':>6}  {'down to':>7}"
    for entry in program.storage.entries:
        if entry.shape:
            name = f"{entry.name}({','.join(map(str, entry.shape))})"
            yield _line(name, "array", entry.size, entry.first, core)
    for kind in ("variable", "constant", "temporary", "statement number"):
        entries = [entry for entry in program.storage.entries if entry.kind == kind and not entry.shape]
        for entry in entries if kind == "variable" else ():
            yield _line(entry.name, kind, 1, entry.first, core)
        if entries and kind != "variable":
            yield f"  {'':<20}{_PLURALS[kind]:<18}{len(entries):>7}"
    need = program.storage.fields * FIELD
    lowest = core_address(program.storage.fields, core) + 1
    code = code_positions(program)
    yield f"  data: {need} positions, from {core_address(0, core)} down to {lowest}"
    lacking = overlap(program, core)
    free = f"free between: ~{lowest - 8300 - code}" if not lacking else f"~{8300 + code - lowest} too many"
    yield f"  program: ~{code} positions from 08300; {free}"
    if lacking:
        yield f"  {lacking}"


def capacity_line(program: Program, core: int) -> str:
    """How many points fit the machine."""
    points = largest(program, core)
    arrays = f"  with arrays of {' and '.join(array_lengths(program))} fields"
    if points:
        return f"{arrays} about {points} points would fit; the thesis's N is {MAX_POINTS}"
    return f"{arrays} the program does not fit"


def _line(name: str, kind: str, size: int, first: int, core: int) -> str:
    highest, lowest = core_address(first, core), core_address(first + size - 1, core) - FIELD + 1
    return f"  {name:<20}{kind:<18}{size:>7}  {highest:>6}  {lowest:>7}"
