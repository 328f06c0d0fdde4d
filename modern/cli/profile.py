"""The profile of a run as text: the time table, the operations, the statements run most."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator

from emulator.language.objectcode import Program
from emulator.machine.result import Result
from emulator.machine.timing import Row, measure

_TOP = 10


def profile_lines(program: Program, result: Result) -> Iterator[str]:
    """Lines no wider than 80 columns."""
    timing = measure(program, result)
    yield f"{program.source}: {result.statements} statements; time on a 1620 Model 1:"
    yield f"  {'cause':<20}{'count':>9}{'seconds':>11}"
    for row in timing.processor:
        yield _line(row)
    yield f"  {'processor':<20}{'':>9}{timing.processor_seconds:>11.1f}"
    for row in timing.devices:
        yield _line(row)
    yield f"  {'all, one by one':<20}{'':>9}{timing.seconds:>11.1f}  (reader and punch may run beside)"
    if any(row.estimated for row in timing.processor):
        yield "  ~ contains times that are estimates (no source gives them)"
    operations = "operations: " + ", ".join(f"{name} {count}" for name, count in timing.operations)
    yield from textwrap.wrap(operations, 80, initial_indent="  ", subsequent_indent="    ")
    most = sorted(timing.statements, key=lambda pair: -pair[1])[:_TOP]
    yield f"  statements run most (of {len(timing.statements)} that ran):"
    for index, count in most:
        line = program.statements[index]
        yield f"  {count:>9}  card {line.place.card:>3} {line.label or '':>5} {line.text[:50]}"


def _line(row: Row) -> str:
    return f"  {row.cause:<20}{row.count:>9}{row.seconds:>11.1f}{'  ~' if row.estimated else ''}"
