"""Post-dominators: the instructions that lie on every path from an instruction to the end of the program.

Two branches of a program join at the first instruction that post-dominates both of their first instructions.
"""

from collections.abc import Sequence
from functools import reduce
from operator import and_


def post_dominators(follow: Sequence[Sequence[int]]) -> list[int]:
    """Return the post-dominators of each instruction, itself included, as a set of bits: 2**n for instruction n.

    ``follow`` holds the possible successors of each instruction.  The index after the last instruction stands for the
    end of the program.  The last set in the list belongs to the end.  An instruction without a path to the end has the
    set 0.
    """
    end = len(follow)
    sets = [0] * end + [1 << end]
    # An instruction is post-dominated by itself and by the common post-dominators of its successors.  Repeating this
    # from the last instruction to the first until nothing changes gives the largest sets that satisfy it.
    changed = True
    while changed:
        changed = False
        for pc in reversed(range(end)):
            known = [sets[after] for after in follow[pc] if sets[after]]
            new = reduce(and_, known) | 1 << pc if known else 0
            if new != sets[pc]:
                sets[pc], changed = new, True
    return sets


def meeting(sets: Sequence[int], first: int, second: int) -> int:
    """Return the first instruction on every path from either of two instructions to the end, or -1 if there is none.

    ``sets`` are the post-dominators of all instructions.  The end does not count as an instruction.
    """
    # The post-dominators of an instruction form a chain.  The common part of two chains is the chain of the instruction
    # at which the paths join.
    common = sets[first] & sets[second]
    junction = sets.index(common) if common else -1
    return junction if junction < len(sets) - 1 else -1
