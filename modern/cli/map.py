"""``hull1620 map``: print the addresses of arrays and variables, and how many points fit into core."""

import argparse
from collections.abc import Iterator

from emulator.language.objectcode import Program
from emulator.language.storage import FIELD, core_address
from emulator.objectdeck.extent import extent
from modern.cli.shared.console import OK
from modern.cli.shared.programs import load_program
from modern.edition import programs
from modern.formats.deck import MAX_POINTS
from modern.thesis.capacity import array_lengths, largest

_PLURALS = {"constant": "constants", "temporary": "temporaries", "statement number": "statement numbers"}


def main(args: argparse.Namespace) -> int:
    program = load_program(args)
    for line in map_lines(program, args.core):
        print(line)
    if args.program in programs.NAMES:
        print(capacity_line(program, args.core))
    return OK


def map_lines(program: Program, core: int) -> Iterator[str]:
    """Yield the storage map.

    The address of a field is that of its rightmost digit.  Element 1 of an array has the highest address.
    """
    size = extent(program)
    about = "~" if size.inferred else ""
    note = " (~: partly estimated)" if size.inferred else ""
    yield f"{program.source}: storage in a machine of {core} positions{note}"
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
    lowest = core_address(program.storage.fields, core) + 1
    yield f"  data: {size.data} positions, from {core_address(0, core)} down to {lowest}"
    excess = size.excess(core)
    free = f"{about}{excess} positions too many" if excess > 0 else f"free between program and data: {about}{-excess}"
    yield f"  program: {about}{size.code} positions from 08300; {free}"
    if excess > 0:
        yield f"  {size.overlap(core)}"


def capacity_line(program: Program, core: int) -> str:
    """Return a line that says how many points the program could process in a machine of ``core`` positions."""
    points = largest(program, core)
    arrays = f"  with arrays of {' and '.join(array_lengths(program))} fields"
    if points:
        return f"{arrays}, about {points} points would fit; the thesis limits N to {MAX_POINTS}"
    return f"{arrays}, the program does not fit"


def _line(name: str, kind: str, size: int, first: int, core: int) -> str:
    highest, lowest = core_address(first, core), core_address(first + size - 1, core) - FIELD + 1
    return f"  {name:<20}{kind:<18}{size:>7}  {highest:>6}  {lowest:>7}"
