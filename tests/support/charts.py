"""Check flow charts: every branch is drawn once, lines avoid boxes and one another, and connectors do not overlap."""

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import combinations, pairwise

from emulator.language import objectcode as op
from emulator.language.objectcode import Program
from modern.publication.chart import BOX, LEFT, LETTER, RADIUS, RIGHT, Chart, Page
from modern.publication.flow import Flow

Segment = tuple[int, int, int, int]


def ways(program: Program) -> Counter[tuple[int, str, int]]:
    """Count every decision and GO TO of the object code: its card, the value it is taken for, and the target card.

    Only the instructions are read.
    """
    card = {}
    first_card = 0
    for pc, instruction in enumerate(program.code):
        if instruction.operation == op.COUNT:
            counter = program.counters[instruction.address]
            first_card = program.statements[counter.statement].place.card
        card[pc] = first_card
    branches: Counter[tuple[int, str, int]] = Counter()
    for pc, instruction in enumerate(program.code):
        operation = instruction.operation
        if operation in (op.IF, op.IFX):
            targets = dict(zip("-0+", program.branches[instruction.address], strict=True))
        elif operation == op.SWITCH:
            targets = dict(zip(("on", "off"), program.branches[instruction.address], strict=True))
        elif operation == op.SELECT:
            choices = program.branches[instruction.second]
            targets = {
                ", ".join(str(k) for k, choice in enumerate(choices, 1) if choice == target): target
                for target in choices
            }
        elif operation == op.BRANCH:
            targets = {"": program.branches[instruction.address][0]}
        else:
            continue
        for taken, target in targets.items():
            branches[card[pc], taken, card[target]] += 1
    return branches


def drawn_ways(flow: Flow) -> Counter[tuple[int, str, int]]:
    """Count the same for the boxes of a flow; the end of a DO counts only if a GO TO, its second card, follows."""
    branches: Counter[tuple[int, str, int]] = Counter()
    for box in flow.boxes:
        for way in box.exits:
            closing = way.taken in ("again", "done")
            if not closing or (way.taken == "done" and len(box.cards) > 1):
                branches[box.cards[-1], "" if closing else way.taken, flow.boxes[way.target].cards[0]] += 1
    return branches


def faults(chart: Chart) -> list[str]:
    """Return the faults of a chart."""
    messages = []
    drawn = Counter((path.box, path.way) for page in chart.pages for path in page.paths)
    expected = Counter((place, k) for place, box in enumerate(chart.flow.boxes) for k in range(len(box.exits)))
    if drawn != expected:
        messages.append(f"branches drawn more than once or not at all: {(drawn - expected) + (expected - drawn)}")
    placed = [box.box for page in chart.pages for box in page.boxes]
    if placed != list(range(len(chart.flow.boxes))):
        messages.append("boxes are missing, doubled or out of order")
    for number, page in enumerate(chart.pages, 1):
        messages += [f"page {number}: {fault}" for fault in _page_faults(chart.flow, page)]
    return messages


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
    # Two jumps to the same box may share a line; two jumps to different boxes may not.
    for (corners, target, name), (corners2, target2, name2) in combinations(lines, 2):
        if target != target2 and any(_overlap(a, b) for a in _segments(corners) for b in _segments(corners2)):
            yield f"{name} and {name2} lie on one line"
    circles = [(path.connector, f"way {path.box}.{path.way}") for path in page.paths if path.connector]
    circles += [(landing.centre, f"landing at {landing.box}") for landing in page.landings]
    for (a, name), (b, name2) in combinations(circles, 2):
        if (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 < 4 * RADIUS**2:
            yield f"the connectors of {name} and {name2} touch"
    for (x, y), name in circles:
        for corners, _, line_name in lines:
            if line_name != name and any(_near(x, y, segment) for segment in _segments(corners)):
                yield f"{line_name} runs through the connector of {name}"
    for box in page.boxes:
        if any(len(line) * LETTER > BOX - 16 for line in box.lines):
            yield f"a line is too long for box {box.box}"
    edges = [(box.top, box.bottom) for box in page.boxes]
    if any(below[0] <= above[1] for above, below in pairwise(edges)) or edges[-1][1] > page.height:
        yield "boxes overlap or leave the page"


def _segments(corners: Sequence[tuple[int, int]]) -> list[Segment]:
    return [(*a, *b) for a, b in pairwise(corners)]


def _overlap(a: Segment, b: Segment) -> bool:
    """Return True if two vertical or horizontal segments share more than a point."""
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
