"""The layout of a flow chart: boxes along a vertical spine, jumps in lanes on both sides, and pages.

The layout depends only on the control flow. The boxes are in the order of the cards. The three exits of an IF have
fixed sides: minus is left, zero is down, and plus is right. An unconditional jump turns right if it goes forward and
left if it goes back. All jumps that arrive at a box on the same side share a *rail*, a vertical line in a lane. A
shorter rail is nearer to the boxes. A jump to another page, or a jump without a free lane, is drawn as a pair of
connectors with the number of the target statement. Lengths are in pixels, and y increases downward.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from modern.publication.flow import Box, Flow

# The width of every box; a decision has this width at its middle.
BOX = 244
# The width of the space between a box and the first lane, which holds the conditions of exits and the connectors.
ZONE = 38
LANE = 11
LANES = 8
MARGIN = 14
LEFT = MARGIN + LANES * LANE + ZONE
RIGHT = LEFT + BOX
SPINE = LEFT + BOX // 2
RADIUS = 11
# The width of a character and the height of a line in a monospaced font of nine pixels.
LETTER, ROW = 5.42, 12
WRAP = 39
_TURN, _LAND, _JOIN, _DOWN, _ARROW = 16, 2 * RADIUS + 2, 6, 12, 11

Where = Literal["left", "right"]


@dataclass(frozen=True, slots=True)
class Placed:
    """A box on a page. ``box`` is its index in the flow, and ``lines`` is its text broken into lines."""

    box: int
    top: int
    height: int
    lines: tuple[str, ...]

    @property
    def bottom(self) -> int:
        return self.top + self.height

    @property
    def middle(self) -> int:
        return self.top + self.height // 2


@dataclass(frozen=True, slots=True)
class Path:
    """The line that leaves an exit of a box.

    ``way`` is the index of the exit among those of the box. ``connector`` is the centre of the connector in which the
    line ends, or None if the line leads to a box.
    """

    box: int
    way: int
    corners: tuple[tuple[int, int], ...]
    connector: tuple[int, int] | None = None


@dataclass(frozen=True, slots=True)
class Landing:
    """A connector from which a line leads to a box. ``corners`` are the corners of the line."""

    box: int
    centre: tuple[int, int]
    corners: tuple[tuple[int, int], ...]


@dataclass(frozen=True, slots=True)
class Page:
    """A page: its boxes, the lines that leave them, and the connectors of jumps that arrive without a line."""

    height: int
    boxes: tuple[Placed, ...]
    paths: tuple[Path, ...]
    landings: tuple[Landing, ...]


@dataclass(frozen=True, slots=True)
class Chart:
    """The layout of a flow on pages of equal width."""

    flow: Flow
    pages: tuple[Page, ...]


def chart(flow: Flow, height: int = 860) -> Chart:
    """Lay out a flow on pages of at most ``height`` pixels. A taller box is placed on a separate page.

    A page of the default height fits on a sheet of paper if its letters have a size of 6.7 points.
    """
    return Chart(flow, tuple(_page(flow, first, last) for first, last in _breaks(flow, height)))


def sheets_of(chart: Chart) -> dict[int, int]:
    """Return, for each card, the number of the page that shows it, counted from 1."""
    return {
        card: number
        for number, page in enumerate(chart.pages, 1)
        for placed in page.boxes
        for card in chart.flow.boxes[placed.box].cards
    }


def wrapped(line: str, width: int = WRAP) -> tuple[str, ...]:
    """Break a statement into lines of at most ``width`` characters, if possible after an operator, comma or blank."""
    rows = []
    while len(line) > width:
        cut = max((k + 1 for k in range(width // 2, width) if line[k] in " ,)+-*/=("), default=width)
        rows.append(line[:cut].rstrip())
        line = "  " + line[cut:].lstrip()
    return (*rows, line)


def _size(box: Box) -> tuple[int, tuple[str, ...]]:
    if box.kind == "step":
        return 2 * RADIUS, ()
    if box.kind != "decision":
        lines = tuple(row for line in box.lines for row in wrapped(line))
        return ROW * len(lines) + 10, lines
    lines = tuple(row for line in box.lines for row in wrapped(line, 26))
    # The diamond must be as wide as the text at the upper and lower edges of the text.
    share = max(len(row) for row in lines) * LETTER / BOX
    tall = round(ROW * len(lines) / (1 - share)) + 8
    side = sum(way.side == "right" for way in box.exits)
    return max(tall, 40, (2 * RADIUS + 2) * (side + 1) if side > 1 else 0), lines


def _breaks(flow: Flow, height: int) -> list[tuple[int, int]]:
    """Divide the boxes into pages. Return the first box of each page and the box after its last box.

    The breaks minimise a cost by dynamic programming: ten for each page, and one for each jump between two pages.
    """
    count = len(flow.boxes)
    sizes = [_size(box)[0] + _ARROW + _DOWN for box in flow.boxes]
    # across[cut] is the number of jumps that a page break before the box `cut` would interrupt.
    across = [0] * (count + 1)
    for place, box in enumerate(flow.boxes):
        for way in box.exits:
            low, high = sorted((place, way.target))
            for cut in range(low + 1, high + 1):
                across[cut] += 1
    # best[end] is the smallest cost of the pages before the box `end`, with the first box of the last page.
    best: list[tuple[int, int]] = [(0, 0)] * (count + 1)
    for end in range(1, count + 1):
        candidates, used = [], 0
        for start in range(end - 1, -1, -1):
            used += sizes[start]
            # The sum of the sizes is a lower bound, because it ignores connectors and joins, so make the plan too.
            if start < end - 1 and (used > height or _plan(flow, range(start, end)).height > height):
                break
            candidates.append((best[start][0] + 10 + across[start], start))
        best[end] = min(candidates)
    # Follow the best breaks back from the last box.
    pages, end = [], count
    while end:
        pages.append((best[end][1], end))
        end = best[end][1]
    return pages[::-1]


@dataclass(frozen=True, slots=True)
class _Rail:
    """The vertical line that all jumps to a box share on one side. It passes the boxes ``first`` to ``last``."""

    target: int
    side: Where
    first: int
    last: int


@dataclass(frozen=True, slots=True)
class _Plan:
    """The layout of a page before its lines are drawn.

    ``lanes`` has the lane of each rail by target and side, and ``landed`` has the boxes to which connectors lead. For
    each box, three lists have vertical coordinates: ``turns`` has that at which a line leaving the box downward turns
    left or right, ``lands`` has that of the connector above the box, and ``joins`` has that at which the rails of jumps
    to the box end.
    """

    height: int
    placed: tuple[Placed, ...]
    lanes: dict[tuple[int, Where], int]
    landed: tuple[int, ...]
    turns: list[int]
    lands: list[int]
    joins: list[int]


def _plan(flow: Flow, inside: range) -> _Plan:
    lanes = _lanes(_rails(flow, inside))
    landed = tuple(
        target
        for target in inside
        if not all(place in inside and _joined(flow, inside, lanes, place, k) for place, k in flow.arrivals[target])
    )
    joined = {target for target, _ in lanes}
    placed: list[Placed] = []
    turns, lands, joins = [], [], []
    y = MARGIN
    for place in inside:
        # From top to bottom: the connector that leads to the box, the end of its rails, the box, the turn below it.
        lands.append(y + _LAND // 2)
        y += _LAND if place in landed else 0
        joins.append(y)
        y += (_JOIN if place in joined else 0) + _ARROW
        tall, lines = _size(flow.boxes[place])
        placed.append(Placed(place, y, tall, lines))
        y += tall
        turns.append(y + _TURN)
        ways = enumerate(flow.boxes[place].exits)
        bends = any(way.side == "down" and not _straight(flow, inside, place, k) for k, way in ways)
        y += _TURN + RADIUS + 5 if bends else _DOWN
    height = placed[-1].bottom + _TURN + RADIUS + MARGIN
    return _Plan(height, tuple(placed), lanes, landed, turns, lands, joins)


def _page(flow: Flow, first: int, end: int) -> Page:
    inside = range(first, end)
    plan = _plan(flow, inside)
    paths = []
    for place in inside:
        box = flow.boxes[place]
        for k, way in enumerate(box.exits):
            start, landing = _start(box, plan.placed[place - first], k), way.target - first
            if _straight(flow, inside, place, k):
                paths.append(Path(place, k, (start, (SPINE, plan.placed[landing].top))))
                continue
            side = _side(flow, place, k)
            outward, edge = (-1, LEFT) if side == "left" else (1, RIGHT)
            corners = [start] if way.side != "down" else [start, (SPINE, plan.turns[place - first])]
            level = corners[-1][1]
            lane = plan.lanes.get((way.target, side), -1)
            if lane < 0:
                # The target is on another page, or every lane of the side is taken: the line ends in a connector.
                centre = (edge + outward * (ZONE // 2), level)
                paths.append(Path(place, k, (*corners, (centre[0] - outward * RADIUS, level)), centre))
                continue
            # The line leaves the box, follows its rail to the level above the target, and enters the target from above.
            x, join = edge + outward * (ZONE + lane * LANE), plan.joins[landing]
            corners += [(x, level), (x, join), (SPINE, join), (SPINE, plan.placed[landing].top)]
            paths.append(Path(place, k, tuple(corners)))
    x = LEFT - ZONE // 2
    landings = []
    for target in plan.landed:
        level, top = plan.lands[target - first], plan.placed[target - first].top
        landings.append(Landing(target, (x, level), ((x + RADIUS, level), (SPINE, level), (SPINE, top))))
    return Page(plan.height, plan.placed, tuple(paths), tuple(landings))


def _side(flow: Flow, place: int, k: int) -> Where:
    """Return the side on which the line of an exit passes other boxes."""
    way = flow.boxes[place].exits[k]
    if way.side != "down":
        return way.side
    return "right" if way.target > place else "left"


def _straight(flow: Flow, inside: range, place: int, k: int) -> bool:
    """Return True if an exit goes straight down to the next box of its page."""
    way = flow.boxes[place].exits[k]
    return way.side == "down" and way.target == place + 1 and way.target in inside


def _joined(flow: Flow, inside: range, lanes: dict[tuple[int, Where], int], place: int, k: int) -> bool:
    """Return True if the line of an exit is drawn to its target without connectors."""
    return _straight(flow, inside, place, k) or (flow.boxes[place].exits[k].target, _side(flow, place, k)) in lanes


def _rails(flow: Flow, inside: range) -> list[_Rail]:
    passed: dict[tuple[int, Where], list[int]] = {}
    for place in inside:
        for k, way in enumerate(flow.boxes[place].exits):
            if way.target in inside and not _straight(flow, inside, place, k):
                # A rail ends in the gap above its target.
                end = min(way.target, max(place, way.target - 1))
                passed.setdefault((way.target, _side(flow, place, k)), []).extend((place, end))
    return [_Rail(target, side, min(places), max(places)) for (target, side), places in passed.items()]


def _lanes(rails: Sequence[_Rail]) -> dict[tuple[int, Where], int]:
    """Assign the rails to lanes, the shortest rail first. A rail for which no lane is free is omitted."""
    taken: dict[tuple[Where, int], list[_Rail]] = {}
    lanes: dict[tuple[int, Where], int] = {}
    for rail in sorted(rails, key=lambda r: (r.last - r.first, r.first, r.target)):
        for lane in range(LANES):
            in_lane = taken.setdefault((rail.side, lane), [])
            # At least one box lies between two rails of a lane, so that no line ends where another begins.
            if all(rail.first > present.last + 1 or rail.last + 1 < present.first for present in in_lane):
                in_lane.append(rail)
                lanes[rail.target, rail.side] = lane
                break
    return lanes


def _start(box: Box, placed: Placed, k: int) -> tuple[int, int]:
    way = box.exits[k]
    if way.side == "down":
        return SPINE, placed.bottom
    same = [j for j, exit in enumerate(box.exits) if exit.side == way.side]
    if len(same) == 1:
        return (LEFT if way.side == "left" else RIGHT), placed.middle
    # Several exits on one side leave the slanted edge of the diamond one below the other.
    y = placed.top + placed.height * (same.index(k) + 1) // (len(same) + 1)
    from_middle = abs(2 * (y - placed.top) - placed.height) / placed.height
    return round(SPINE + BOX / 2 * (1 - from_middle)), y
