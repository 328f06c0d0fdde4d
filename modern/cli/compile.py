"""``hull1620 compile``: print the object code of a program, statement by statement, or punch its object deck."""

import argparse
from collections.abc import Iterator

from emulator.files import read_text, source_name, write_text
from emulator.language import objectcode as op
from emulator.language.objectcode import Instruction, Program
from emulator.objectdeck.cards import LOADER_CARDS, numbered, object_cards, with_library
from modern.cli.shared.console import OK, UsageError
from modern.cli.shared.programs import load_program


def main(args: argparse.Namespace) -> int:
    if args.library and not args.object:
        raise UsageError("--library applies only to an object deck; add --object")
    program = load_program(args)
    lines = _deck(program, args.core, args.library) if args.object else listing(program)
    write_text(args.output, "".join(f"{line}\n" for line in lines))
    return OK


def _deck(program: Program, core: int, library: str | None) -> list[str]:
    """Return the numbered cards of an object program, inserted into the deck ``library`` if it is named."""
    cards = object_cards(program, core)
    if library is None:
        return numbered(cards, LOADER_CARDS + 1)
    return with_library(cards, read_text(library).splitlines(), source_name(library))


def listing(program: Program) -> Iterator[str]:
    """Yield the object code: the text of each statement, followed by its instructions.

    An asterisk marks an instruction that is the target of a branch.
    """
    starts = {pc for branch in program.branches for pc in branch}
    for pc, instruction in enumerate(program.code):
        if instruction.operation == op.COUNT:
            counter = program.counters[instruction.address]
            line = program.statements[counter.statement]
            if counter.begins:
                yield f"card {line.place.card:>3}  {line.label or '':>5} {line.text}"
            else:
                yield f"          {counter.what} of card {line.place.card}"
            continue
        target = "*" if pc in starts else " "
        name = op.NAMES[instruction.operation]
        yield f"{target}{pc:>7}  {name:<9}{_operand(program, instruction):<28}{_meaning(instruction)}".rstrip()


def _meaning(instruction: Instruction) -> str:
    if op.repeats(instruction) > 1:
        return "all numbers of an array, one after another"
    return op.MEANINGS[op.NAMES[instruction.operation]]


def _operand(program: Program, instruction: Instruction) -> str:
    def labels(branch: int) -> str:
        return ", ".join(_label(program, pc) for pc in program.branches[branch])

    operation = instruction.operation
    if op.repeats(instruction) > 1:
        return f"{program.storage.entry_of(instruction.address).name}, {op.repeats(instruction)} elements"
    if operation <= op.ITEM or operation in (op.POWER, op.POWERX):
        return _field(program, instruction)
    if operation in (op.BRANCH, op.IF, op.IFX):
        return labels(instruction.address)
    if operation == op.SWITCH:
        return f"{instruction.second}: {labels(instruction.address)}"
    if operation == op.SELECT:
        return f"{_field(program, instruction)}: {labels(instruction.second)}"
    if operation == op.DOTEST:
        variable, step, limit, body = program.loops[instruction.address]
        name = program.storage.name_of
        return f"{name(variable)} + {name(step)} <= {name(limit)}: {body}"
    if operation == op.FUNCTION:
        return program.functions[instruction.address]
    if operation == op.BEGIN:
        return f"{program.verbs[instruction.address]} by FORMAT {program.formats[instruction.second][0]}"
    return ""


def _field(program: Program, instruction: Instruction) -> str:
    if instruction.subscript < 0:
        return program.storage.name_of(instruction.address)
    subscript = program.subscripts[instruction.subscript]
    name = program.storage.entry_of(subscript.array).name
    parts = [_part(program, subscript.v1, subscript.c1, subscript.o1)]
    if subscript.columns:
        parts.append(_part(program, subscript.v2, subscript.c2, subscript.o2))
    return f"{name}({','.join(parts)})"


def _part(program: Program, variable: int, factor: int, addend: int) -> str:
    if variable < 0:
        return str(addend)
    times = f"{factor}*" if factor != 1 else ""
    return f"{times}{program.storage.name_of(variable)}" + (f"{addend:+d}" if addend else "")


def _label(program: Program, pc: int) -> str:
    line = program.line_at(pc)
    return f"{line.label or f'card {line.place.card}'}"
