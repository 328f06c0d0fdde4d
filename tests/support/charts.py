"""What a flow chart must keep: every way once, no line through a box, no two jumps on one line, connectors clear."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import combinations, pairwise

from emulator.language import objectcode as op
from emulator.language.objectcode import Program
from modern.publication.chart import BOX, LEFT, LETTER, RADIUS, RIGHT, Chart, Page
from modern.publication.flow import Flow

Segment = tuple[int, int, int, int]


def ways(program: Program) -> Counter[tuple[int, str, int]]:
    """Every choice and GO TO of the object code: card it stands on, what it is taken for, card gone to.

    Read off the instructions alone.
    """
    card = {}
    begins = 0
    for pc, instruction in enumerate(program.code):
        if instruction.operation == op.COUNT:
            counter = program.counters[instruction.address]
            begins = program.statements[counter.statement].place.card
        card[pc] = begins
    found: Counter[tuple[int, str, int]] = Counter()
    for pc, instruction in enumerate(program.code):
        operation = instruction.operation
        if operation in (op.IF, op.IFX):
            targets = dict(zip("-0+", program.branches[instruction.address], strict=True))
        elif operation == op.SWITCH:
            targets = dict(zip(("on", "off"), program.branches[instruction.address], strict=True))
        elif operation == op.SELECT:
            among = program.branches[instruction.second]
            targets = {
                ", ".join(str(k) for k, other in enumerate(among, 1) if other == target): target for target in among
            }
        elif operation == op.BRANCH:
            targets = {"": program.branches[instruction.address][0]}
        else:
            continue
        for taken, target in targets.items():
            found[card[pc], taken, card[target]] += 1
    return found


def drawn_ways(flow: Flow) -> Counter[tuple[int, str, int]]:
    """The same of a flow's boxes; of the closing of a DO only what goes on by a GO TO, its second card."""
    found: Counter[tuple[int, str, int]] = Counter()
    for box in flow.boxes:
        for way in box.exits:
            closing = way.taken in ("again", "done")
            if not closing or (way.taken == "done" and len(box.cards) > 1):
                found[box.cards[-1], "" if closing else way.taken, flow.boxes[way.target].cards[0]] += 1
    return found


def faults(chart: Chart) -> list[str]:
    """What is wrong with a chart; nothing if it is right."""
    wrong = []
    drawn = Counter((path.box, path.way) for page in chart.pages for path in page.paths)
    wanted = Counter((place, k) for place, box in enumerate(chart.flow.boxes) for k in range(len(box.exits)))
    if drawn != wanted:
        wrong.append(f"ways drawn more than once or not at all: {(drawn - wanted) + (wanted - drawn)}")
    placed = [box.box for page in chart.pages for box in page.boxes]
    if placed != list(range(len(chart.flow.boxes))):
        wrong.append("boxes are missing, doubled or out of order")
    for number, page in enumerate(chart.pages, 1):
        wrong += [f"page {number}: {fault}" for fault in _page_faults(chart.flow, page)]
    return wrong


def _page_faults(flow: Flow, page: Page) -> Iterator[str]:
    lines = [
        (path.corners, flow.boxes[path.box].exits[path.way].target, f"way {path.box}.{path.way}") for path in page.paths
    ]
    lines += [(landing.corners, landing.box, f"landing at {landing.box}") for landing in page.landings]
    for corners, _, name in lines:
        for box in page.boxes:
            for x1, y1, x2, y2 in _segments(corners):
                if min(x1, x2) < RIGHT and max(x1, x2) > LEFT and min(y1, y2) < box.bottom and max(y1, y2) > box.top:
                    slanted = flow.boxes[box.box].kind == "decision" and y1 == y2 and min(x1, x2) > LEFT + BOX // 2
                    if not (slanted and name.startswith(f"way {box.box}.")):
                        yield f"{name} runs through box {box.box}"
    for (one, to, name), (two, other_to, other) in combinations(lines, 2):
        if to != other_to and any(_overlap(a, b) for a in _segments(one) for b in _segments(two)):
            yield f"{name} and {other} lie on one line"
    circles = [(path.connector, f"way {path.box}.{path.way}") for path in page.paths if path.connector]
    circles += [(landing.centre, f"landing at {landing.box}") for landing in page.landings]
    for (a, name), (b, other) in combinations(circles, 2):
        if (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 < 4 * RADIUS**2:
            yield f"the connectors of {name} and {other} touch"
    for (x, y), name in circles:
        for corners, _, other in lines:
            if other != name and any(_near(x, y, segment) for segment in _segments(corners)):
                yield f"{other} runs through the connector of {name}"
    for box in page.boxes:
        if any(len(line) * LETTER > BOX - 16 for line in box.lines):
            yield f"a line is too long for box {box.box}"
    edges = [(box.top, box.bottom) for box in page.boxes]
    if any(below[0] <= above[1] for above, below in pairwise(edges)) or edges[-1][1] > page.height:
        yield "boxes overlap or leave the page"


def _segments(corners: Sequence[tuple[int, int]]) -> list[Segment]:
    return [(*a, *b) for a, b in pairwise(corners)]


def _overlap(a: Segment, b: Segment) -> bool:
    """Whether two upright or level segments share more than a point."""
    for x, y in ((0, 1), (1, 0)):
        if a[x] == a[x + 2] == b[x] == b[x + 2]:
            low = max(min(a[y], a[y + 2]), min(b[y], b[y + 2]))
            high = min(max(a[y], a[y + 2]), max(b[y], b[y + 2]))
            return low < high
    return False


def _near(x: int, y: int, segment: Segment) -> bool:
    x1, y1, x2, y2 = segment
    dx, dy = max(min(x1, x2) - x, 0, x - max(x1, x2)), max(min(y1, y2) - y, 0, y - max(y1, y2))
    return dx * dx + dy * dy < RADIUS * RADIUS
