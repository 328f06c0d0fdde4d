"""Where two ways through a program meet again: the first statement that every path from either must come to.

That is the nearest common ancestor of two instructions in the tree of post-dominators, which is built by the
iteration of K. Cooper, T. Harvey and K. Kennedy (A Simple, Fast Dominance Algorithm, Rice University 2001) on the
program read backwards.
"""

from __future__ import annotations

from collections.abc import Sequence

from emulator.language import objectcode as op
from emulator.language.objectcode import Program


def successors(program: Program) -> list[tuple[int, ...]]:
    """For each instruction those that may follow it; the number after the last stands for the end of the run.

    A READ may find the hopper empty, which ends the run.
    """
    end = len(program.code)
    found: list[tuple[int, ...]] = []
    for pc, instruction in enumerate(program.code):
        operation, address = instruction.operation, instruction.address
        if operation in (op.BRANCH, op.IF, op.IFX, op.SWITCH):
            found.append(program.branches[address])
        elif operation == op.SELECT:
            found.append(program.branches[instruction.second])
        elif operation == op.DOTEST:
            found.append((program.loops[address][3], pc + 1))
        elif operation == op.STOP:
            found.append((end,))
        elif operation == op.BEGIN and program.verbs[address] == "READ":
            found.append((pc + 1, end))
        else:
            found.append((pc + 1,))
    return found


def post_dominators(follow: Sequence[Sequence[int]]) -> list[int]:
    """For each instruction the next one that no path from it to the end avoids; -1 where no path ends."""
    end = len(follow)
    before: list[list[int]] = [[] for _ in range(end + 1)]
    for pc, nexts in enumerate(follow):
        for after in nexts:
            before[after].append(pc)
    order = _order(before, end)
    place = {pc: k for k, pc in enumerate(order)}
    parent = [-1] * (end + 1)
    parent[end] = end
    changed = True
    while changed:
        changed = False
        for pc in order[1:]:
            joint = -1
            for after in follow[pc]:
                if after in place and parent[after] >= 0:
                    joint = after if joint < 0 else _joined(parent, place, joint, after)
            if joint != parent[pc]:
                parent[pc], changed = joint, True
    return parent


def _order(before: Sequence[Sequence[int]], end: int) -> list[int]:
    """Instructions from which the end can be reached, each after one that follows it, the end first."""
    seen = {end}
    finished: list[int] = []
    stack = [(end, iter(before[end]))]
    while stack:
        pc, rest = stack[-1]
        step = next((p for p in rest if p not in seen), None)
        if step is None:
            finished.append(pc)
            stack.pop()
        else:
            seen.add(step)
            stack.append((step, iter(before[step])))
    return finished[::-1]


def _joined(parent: Sequence[int], place: dict[int, int], first: int, second: int) -> int:
    while first != second:
        while place[first] > place[second]:
            first = parent[first]
        while place[second] > place[first]:
            second = parent[second]
    return first


def meeting(parents: Sequence[int], first: int, second: int) -> int:
    """The first instruction that every path from either of two comes to; -1 where there is none in the program."""
    end = len(parents) - 1
    path = set()
    while first >= 0 and first not in path:
        path.add(first)
        first = parents[first]
    while second >= 0 and second not in path:
        if second == end:
            return -1
        second = parents[second]
    return second if second != end else -1
