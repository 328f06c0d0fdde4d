"""The possible paths through object code, and warnings about those branches of a program that may be mistakes.

The warnings concern programs that compile.  They do not change the object code.  The 1620 gave no such warnings.
"""

from collections.abc import Iterator, Sequence

from emulator.errors import Diagnostic
from emulator.language import objectcode as op
from emulator.language.objectcode import Line, Program


def successors(program: Program) -> list[tuple[int, ...]]:
    """Return, for each instruction, the indices of the instructions that may be executed next.

    The index after the last instruction stands for the end of the run.  A READ may end the run, because the card reader
    may have no card left.
    """
    end = len(program.code)
    following: list[tuple[int, ...]] = []
    for pc, instruction in enumerate(program.code):
        operation, address = instruction.operation, instruction.address
        if operation in (op.BRANCH, op.IF, op.IFX, op.SWITCH):
            following.append(program.branches[address])
        elif operation == op.SELECT:
            following.append(program.branches[instruction.second])
        elif operation == op.DOTEST:
            following.append((program.loops[address][3], pc + 1))
        elif operation == op.STOP:
            following.append((end,))
        elif operation == op.BEGIN and program.verbs[address] == "READ":
            following.append((pc + 1, end))
        else:
            following.append((pc + 1,))
    return following


def flow_warnings(program: Program) -> Iterator[Diagnostic]:
    """Yield a warning for each group of unreachable statements and for each jump into the range of a DO."""
    follow = successors(program)
    yield from _unreachable(program, follow)
    yield from _jumps_into_loops(program, follow)


def _unreachable(program: Program, follow: Sequence[Sequence[int]]) -> Iterator[Diagnostic]:
    reached = _reached(follow, 0, range(len(follow)))
    # Adjacent unreachable statements share one message.  END is left out: it usually follows a STOP or GO TO.
    dead: list[Line] = []
    for pc, instruction in enumerate(program.code):
        if instruction.operation != op.COUNT or not program.counters[instruction.address].begins:
            continue
        is_end = program.code[pc + 1].operation == op.STOP and program.code[pc + 1].second == 1
        if pc not in reached and not is_end:
            dead.append(program.line_at(pc))
        elif dead:
            yield _unreachable_message(dead)
            dead = []
    if dead:
        yield _unreachable_message(dead)


def _unreachable_message(lines: Sequence[Line]) -> Diagnostic:
    also = f", nor can the statements after it up to card {lines[-1].place.card}" if len(lines) > 1 else ""
    return _warning(lines[0], f"this statement cannot be reached{also}")


def _jumps_into_loops(program: Program, follow: Sequence[Sequence[int]]) -> Iterator[Diagnostic]:
    # The range of a DO begins after the DO and ends with the DOTEST that follows its last statement.
    ranges = {
        range(program.loops[instruction.address][3], pc + 1): program.loops[instruction.address][0]
        for pc, instruction in enumerate(program.code)
        if instruction.operation == op.DOTEST
    }
    for pc, instruction in enumerate(program.code):
        if instruction.operation not in (op.BRANCH, op.IF, op.IFX, op.SWITCH, op.SELECT):
            continue
        for target in dict.fromkeys(follow[pc]):
            # A jump into a range is harmless if the program then leaves the range before the DOTEST: program 3 of the
            # thesis jumps to 133, where it types a message and goes to a statement outside.  A jump into nested ranges
            # is reported for the innermost range, which begins last.
            entered = [inside for inside in ranges if target in inside and pc not in inside]
            entered = [inside for inside in entered if inside[-1] in _reached(follow, target, inside)]
            if entered:
                innermost = max(entered, key=lambda inside: inside.start)
                do, name = program.line_at(innermost.start - 1), program.storage.name_of(ranges[innermost])
                label, card = program.line_at(target).label, do.place.card
                jump = f"this jump to statement {label} enters the loop of the DO on card {card} from outside"
                yield _warning(
                    program.line_at(pc), f"{jump}; the loop continues with the value that {name} has at the jump"
                )


def _reached(follow: Sequence[Sequence[int]], start: int, inside: range) -> set[int]:
    """Return the instructions that can be reached from ``start`` on a path that stays in ``inside``."""
    reached: set[int] = set()
    waiting = [start]
    while waiting:
        pc = waiting.pop()
        if pc in inside and pc not in reached:
            reached.add(pc)
            waiting.extend(follow[pc])
    return reached


def _warning(line: Line, message: str) -> Diagnostic:
    return Diagnostic(line.place.card, line.place.column, message, warning=True)
