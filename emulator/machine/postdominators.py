"""Post-dominators, which give the first instruction that every path from either of two instructions passes.

An instruction is post-dominated by those that lie on all its paths to the end of the program; the nearest of them is
its parent in the tree of post-dominators.  Two branches of a program join at the nearest common ancestor of their first
instructions.  The tree is computed by the iteration of K. Cooper, T. Harvey and K. Kennedy (A Simple, Fast Dominance
Algorithm, Rice University 2001), applied to the reversed flow graph.
"""

from __future__ import annotations

from collections.abc import Sequence


def post_dominators(follow: Sequence[Sequence[int]]) -> list[int]:
    """Return the nearest post-dominator of each instruction, or -1 if no path from it leads to the end."""
    end = len(follow)
    before: list[list[int]] = [[] for _ in range(end + 1)]
    for pc, nexts in enumerate(follow):
        for after in nexts:
            before[after].append(pc)
    # ``parent`` is the tree found so far.  The nodes are visited in reverse postorder of the reversed graph, so that a
    # successor usually has its parent before its predecessors; a few rounds reach the fixed point.
    order = _order(before, end)
    place = {pc: k for k, pc in enumerate(order)}
    parent = [-1] * (end + 1)
    parent[end] = end
    changed = True
    while changed:
        changed = False
        for pc in order[1:]:
            # The parent of a node is the nearest common ancestor of all its successors that are already in the tree.
            joint = -1
            for after in follow[pc]:
                if after in place and parent[after] >= 0:
                    joint = after if joint < 0 else _joined(parent, place, joint, after)
            if joint != parent[pc]:
                parent[pc], changed = joint, True
    return parent


def _order(before: Sequence[Sequence[int]], end: int) -> list[int]:
    """Return the instructions from which the end can be reached, in reverse postorder of the reversed graph.

    The depth-first search keeps its own stack: a program can be longer than Python's recursion limit.
    """
    visited = {end}
    finished: list[int] = []
    stack = [(end, iter(before[end]))]
    while stack:
        pc, remaining = stack[-1]
        step = next((p for p in remaining if p not in visited), None)
        if step is None:
            finished.append(pc)
            stack.pop()
        else:
            visited.add(step)
            stack.append((step, iter(before[step])))
    return finished[::-1]


def _joined(parent: Sequence[int], place: dict[int, int], first: int, second: int) -> int:
    """Return the nearest common ancestor of two nodes: climb from the later one until both are the same."""
    while first != second:
        while place[first] > place[second]:
            first = parent[first]
        while place[second] > place[first]:
            second = parent[second]
    return first


def meeting(parents: Sequence[int], first: int, second: int) -> int:
    """Return the first instruction on every path from both of two instructions, or -1 if that is the end."""
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
