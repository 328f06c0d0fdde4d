"""Where everything of a flow chart lies: boxes down a spine, jumps in lanes beside it, pages.

The layout is fixed by the flow alone.  Boxes stand in the order of the cards.  The ways out of an IF leave at fixed
sides: minus left, zero down, plus right; a jump without a choice turns right if it goes forward, left if back.  All
jumps to one box that arrive on one side share a *rail*, a vertical line in a lane; rails are nested by their length,
the shortest next to the boxes.  A jump to another page, or one for which no lane is left, is a pair of connectors
that bear the number of the statement gone to.  Lengths are pixels, y downward.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

from modern.publication.flow import Box, Flow

BOX = 244
"""Width of every box; decisions are as wide at their middle."""
ZONE = 38
"""Between a box and the first lane: what leaves it is named here, and connectors stand here."""
LANE = 11
LANES = 8
MARGIN = 14
LEFT = MARGIN + LANES * LANE + ZONE
RIGHT = LEFT + BOX
SPINE = LEFT + BOX // 2
RADIUS = 11
LETTER, ROW = 5.42, 12
"""Width of a letter and height of a row of type, nine pixels high, in a font of one width."""
WRAP = 39
_TURN, _LAND, _JOIN, _DOWN, _ARROW = 16, 2 * RADIUS + 2, 6, 12, 11

Where = Literal["left", "right"]


@dataclass(frozen=True, slots=True)
class Placed:
    """A box on a page: its place in the flow, its top, its height, and its lines as they are broken."""

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
    """One way from box to box, by its place among the exits of ``box``, as corners of a line.

    ``lane`` counts lanes from the boxes, from 0; -1 where the way is straight down or ends in a connector.
    ``connector`` is the centre of its circle, if it ends in one.
    """

    box: int
    way: int
    corners: tuple[tuple[int, int], ...]
    lane: int = -1
    connector: tuple[int, int] | None = None


@dataclass(frozen=True, slots=True)
class Landing:
    """A connector from which a line goes to a box: its centre, and the corners of the line."""

    box: int
    centre: tuple[int, int]
    corners: tuple[tuple[int, int], ...]


@dataclass(frozen=True, slots=True)
class Page:
    """One page: boxes, the ways that leave them, and the connectors by which others arrive."""

    height: int
    boxes: tuple[Placed, ...]
    paths: tuple[Path, ...]
    landings: tuple[Landing, ...]


@dataclass(frozen=True, slots=True)
class Chart:
    """A flow laid out on pages of one width."""

    flow: Flow
    pages: tuple[Page, ...]


def chart(flow: Flow, height: int = 1100) -> Chart:
    """Lay a flow out on pages of at most ``height``; a box that needs more has a page of its own."""
    return Chart(flow, tuple(_page(flow, first, last) for first, last in _breaks(flow, height)))


def wrapped(line: str, width: int = WRAP) -> tuple[str, ...]:
    """A statement in rows of at most ``width`` letters, broken after an operator, a comma or a blank, if it can be."""
    rows = []
    while len(line) > width:
        cut = max((k + 1 for k in range(width // 2, width) if line[k] in " ,)+-*/=("), default=width)
        rows.append(line[:cut].rstrip())
        line = "  " + line[cut:].lstrip()
    return (*rows, line)


def _size(box: Box) -> tuple[int, tuple[str, ...]]:
    """Height and lines of a box."""
    if box.kind == "step":
        return 2 * RADIUS, ()
    if box.kind != "decision":
        lines = tuple(row for line in box.lines for row in wrapped(line))
        return ROW * len(lines) + 10, lines
    lines = tuple(row for line in box.lines for row in wrapped(line, 26))
    # A diamond is as wide as its text where the text's upper and lower edges meet it.
    share = max(len(row) for row in lines) * LETTER / BOX
    tall = round(ROW * len(lines) / (1 - share)) + 8
    side = sum(way.side == "right" for way in box.exits)
    return max(tall, 40, (2 * RADIUS + 2) * (side + 1) if side > 1 else 0), lines


def _breaks(flow: Flow, height: int) -> list[tuple[int, int]]:
    """First box of each page and the one after its last: as few jumps between pages as may be, then few pages."""
    count = len(flow.boxes)
    sizes = [_size(box)[0] + _ARROW + _DOWN for box in flow.boxes]
    across = [0] * (count + 1)
    for place, box in enumerate(flow.boxes):
        for way in box.exits:
            low, high = sorted((place, way.target))
            for cut in range(low + 1, high + 1):
                across[cut] += 1
    # The cheapest way to end a page before each box; a page costs as much as ten jumps cut.
    best: list[tuple[int, int]] = [(0, 0)] * (count + 1)
    for end in range(1, count + 1):
        found, used = [], 0
        for start in range(end - 1, -1, -1):
            used += sizes[start]
            if start < end - 1 and (used > height or _plan(flow, range(start, end)).height > height):
                break
            found.append((best[start][0] + 10 + across[start], start))
        best[end] = min(found)
    pages = []
    end = count
    while end:
        pages.append((best[end][1], end))
        end = best[end][1]
    return pages[::-1]


@dataclass(frozen=True, slots=True)
class _Rail:
    """The vertical line all jumps to one box share that arrive on one side: the boxes it passes, by place."""

    target: int
    side: Where
    first: int
    last: int


@dataclass(frozen=True, slots=True)
class _Plan:
    """What a page holds: its boxes placed, lanes by target and side, the boxes landed on, and levels by box.

    Ways turn below a box at ``turns``; connectors lead to it at ``lands``, rails at ``joins``.
    """

    height: int
    placed: tuple[Placed, ...]
    lanes: dict[tuple[int, Where], int]
    landed: tuple[int, ...]
    turns: list[int]
    lands: list[int]
    joins: list[int]


def _plan(flow: Flow, inside: range) -> _Plan:
    ways = [(place, k) for place in inside for k in range(len(flow.boxes[place].exits))]
    lanes = _lanes(_rails(flow, inside, ways))
    landed = [
        target
        for target in inside
        if not all(place in inside and _joined(flow, inside, lanes, place, k) for place, k in flow.arrivals(target))
    ]
    placed, turns, lands, joins = _stack(flow, inside, set(landed), {target for target, _ in lanes})
    height = placed[-1].bottom + _TURN + RADIUS + MARGIN
    return _Plan(height, placed, lanes, tuple(landed), turns, lands, joins)


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
                centre = (edge + outward * (ZONE // 2), level)
                paths.append(Path(place, k, (*corners, (centre[0] - outward * RADIUS, level)), -1, centre))
                continue
            x, join = edge + outward * (ZONE + lane * LANE), plan.joins[landing]
            corners += [(x, level), (x, join), (SPINE, join), (SPINE, plan.placed[landing].top)]
            paths.append(Path(place, k, tuple(corners), lane))
    x = LEFT - ZONE // 2
    landings = []
    for target in plan.landed:
        level, top = plan.lands[target - first], plan.placed[target - first].top
        landings.append(Landing(target, (x, level), ((x + RADIUS, level), (SPINE, level), (SPINE, top))))
    return Page(plan.height, plan.placed, tuple(paths), tuple(landings))


def _side(flow: Flow, place: int, k: int) -> Where:
    """The side of the boxes a way that is not straight down takes."""
    way = flow.boxes[place].exits[k]
    if way.side != "down":
        return way.side
    return "right" if way.target > place else "left"


def _straight(flow: Flow, inside: range, place: int, k: int) -> bool:
    """Whether a way goes straight down to the next box of its page."""
    way = flow.boxes[place].exits[k]
    return way.side == "down" and way.target == place + 1 and way.target in inside


def _joined(flow: Flow, inside: range, lanes: dict[tuple[int, Where], int], place: int, k: int) -> bool:
    """Whether a way within its page is drawn to its end, and not cut by connectors."""
    return _straight(flow, inside, place, k) or (flow.boxes[place].exits[k].target, _side(flow, place, k)) in lanes


def _rails(flow: Flow, inside: range, ways: Iterable[tuple[int, int]]) -> list[_Rail]:
    passed: dict[tuple[int, Where], list[int]] = {}
    for place, k in ways:
        target = flow.boxes[place].exits[k].target
        if target in inside and not _straight(flow, inside, place, k):
            # A rail ends in the gap above its target.
            passed.setdefault((target, _side(flow, place, k)), []).extend((place, min(target, max(place, target - 1))))
    return [_Rail(target, side, min(places), max(places)) for (target, side), places in passed.items()]


def _lanes(rails: Sequence[_Rail]) -> dict[tuple[int, Where], int]:
    """A lane for every rail that gets one, the shortest first and next to the boxes."""
    taken: dict[tuple[Where, int], list[_Rail]] = {}
    found: dict[tuple[int, Where], int] = {}
    for rail in sorted(rails, key=lambda r: (r.last - r.first, r.first, r.target)):
        for lane in range(LANES):
            beside = taken.setdefault((rail.side, lane), [])
            # One box between them at least, so that no line ends where another begins.
            if all(rail.first > other.last + 1 or rail.last + 1 < other.first for other in beside):
                beside.append(rail)
                found[rail.target, rail.side] = lane
                break
    return found


def _stack(
    flow: Flow, inside: range, landed: set[int], joined: set[int]
) -> tuple[tuple[Placed, ...], list[int], list[int], list[int]]:
    """Boxes one below the other; the levels at which ways turn below each, and connectors and rails join above it."""
    placed: list[Placed] = []
    turns, lands, joins = [], [], []
    y = MARGIN
    for place in inside:
        lands.append(y + _LAND // 2)
        y += _LAND if place in landed else 0
        joins.append(y)
        y += (_JOIN if place in joined else 0) + _ARROW
        tall, lines = _size(flow.boxes[place])
        placed.append(Placed(place, y, tall, lines))
        y += tall
        turns.append(y + _TURN)
        bends = any(
            way.side == "down" and not _straight(flow, inside, place, k)
            for k, way in enumerate(flow.boxes[place].exits)
        )
        y += _TURN + RADIUS + 5 if bends else _DOWN
    return tuple(placed), turns, lands, joins


def _start(box: Box, placed: Placed, k: int) -> tuple[int, int]:
    """Where a way leaves its box."""
    way = box.exits[k]
    if way.side == "down":
        return SPINE, placed.bottom
    same = [j for j, other in enumerate(box.exits) if other.side == way.side]
    if len(same) == 1:
        return (LEFT if way.side == "left" else RIGHT), placed.middle
    # Several on one side leave one below the other, from the slant of the diamond.
    y = placed.top + placed.height * (same.index(k) + 1) // (len(same) + 1)
    from_middle = abs(2 * (y - placed.top) - placed.height) / placed.height
    return round(SPINE + BOX / 2 * (1 - from_middle)), y
