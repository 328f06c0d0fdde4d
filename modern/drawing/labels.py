"""Place the numbers of vertices in a picture so that they overlap neither lines nor each other, if there is space.

Every label has a fixed set of candidate positions around its vertex, each with a cost. The cheapest position is chosen
for each label in turn, repeatedly, until no label moves. Only sums, products and quotients are used, which every
machine rounds alike. Therefore every machine produces the same picture.
"""

from collections.abc import Sequence
from dataclasses import dataclass

Place = tuple[float, float]
Line = tuple[Place, Place]
_Box = tuple[float, float, float, float]

HEIGHT = 13.0
_WIDTH = 7.4
_ROUNDS = 4
_ROUND = tuple(
    (a / 1000, b / 1000)
    for a, b in (
        *((1000, 0), (924, 383), (707, 707), (383, 924), (0, 1000), (-383, 924), (-707, 707), (-924, 383)),
        *((-1000, 0), (-924, -383), (-707, -707), (-383, -924), (0, -1000), (383, -924), (707, -707), (924, -383)),
    )
)
_GAPS = (6.5, 10.0, 15.0)
_ON_LABEL, _ON_MARK, _OUTSIDE, _ON_LINE, _NEARER, _FARTHER, _INWARD = 60.0, 25.0, 200.0, 8.0, 12.0, 0.8, 1.5


@dataclass(frozen=True, slots=True)
class Label:
    """A text to be placed next to the point (x, y), in pixels with y downward."""

    x: float
    y: float
    text: str
    # The font size.
    size: float = HEIGHT

    @property
    def half(self) -> Place:
        """Half the width and half the height of the text in pixels, estimated from the number of characters."""
        return len(self.text) * self.size * _WIDTH / HEIGHT / 2, self.size / 2


def place_labels(
    labels: Sequence[Label], lines: Sequence[Line], marks: Sequence[Place], size: Place
) -> tuple[Place, ...]:
    """Return the centre of each label. ``lines`` and ``marks`` are lines and points to avoid; ``size`` is the size of
    the picture.
    """
    if not labels:
        return ()
    middle = (sum(label.x for label in labels) / len(labels), sum(label.y for label in labels) / len(labels))
    candidates = []
    for label in labels:
        other_points = [(other.x, other.y) for other in labels if other is not label]
        candidates.append(_candidates(label, lines, [*marks, *other_points], middle, size))
    chosen = [_cheapest([cost for _, cost in placements]) for placements in candidates]
    neighbours = [
        [k for k, neighbour in enumerate(labels) if k != order and _near(label, neighbour)]
        for order, label in enumerate(labels)
    ]
    # Each round places the labels one by one, with the current positions of the neighbours as obstacles.
    for _ in range(_ROUNDS):
        previous = list(chosen)
        for order, label in enumerate(labels):
            taken = [_box(candidates[k][chosen[k]][0], labels[k].half, 1.0) for k in neighbours[order]]
            costs = [
                cost + _ON_LABEL * sum(_overlap(_box(centre, label.half, 1.0), box) for box in taken)
                for centre, cost in candidates[order]
            ]
            chosen[order] = _cheapest(costs)
        if chosen == previous:
            break
    return tuple(placements[choice][0] for placements, choice in zip(candidates, chosen, strict=True))


def _cheapest(costs: Sequence[float]) -> int:
    return min(range(len(costs)), key=costs.__getitem__)


def _near(a: Label, b: Label) -> bool:
    reach = 2 * (_GAPS[-1] + HEIGHT) + 2
    return abs(a.x - b.x) <= reach + 2 * (a.half[0] + b.half[0]) and abs(a.y - b.y) <= reach + 2 * HEIGHT


def _candidates(
    label: Label, lines: Sequence[Line], marks: Sequence[Place], middle: Place, size: Place
) -> list[tuple[Place, float]]:
    """Return the candidate positions of a label's centre, each with its cost without regard to other labels."""
    half = label.half
    reach = _GAPS[-1] + 2 * half[0] + HEIGHT
    around = (label.x - reach, label.y - reach, label.x + reach, label.y + reach)
    lines = [line for line in lines if crosses(line, around)]
    marks = [mark for mark in marks if _within(mark, around)]
    outward = (label.x - middle[0], label.y - middle[1])
    span = max(abs(outward[0]), abs(outward[1]), 1.0)
    placements = []
    for step, gap in enumerate(_GAPS):
        for dx, dy in _ROUND:
            centre = (label.x + dx * (gap + half[0]), label.y + dy * (gap + half[1]))
            box = _box(centre, half, 1.5)
            cost = step * _FARTHER - _INWARD * (dx * outward[0] + dy * outward[1]) / span
            cost += _ON_LINE * sum(crosses(line, box) for line in lines)
            cost += _ON_MARK * sum(_within(mark, _box(centre, half, 4.0)) for mark in marks)
            own = (centre[0] - label.x) ** 2 + (centre[1] - label.y) ** 2
            cost += _NEARER * any((centre[0] - x) ** 2 + (centre[1] - y) ** 2 < own for x, y in marks)
            if not (box[0] >= 0 and box[1] >= 0 and box[2] <= size[0] and box[3] <= size[1]):
                cost += _OUTSIDE
            placements.append((centre, cost))
    return placements


def _box(centre: Place, half: Place, room: float) -> _Box:
    wide, tall = half[0] + room, half[1] + room
    return centre[0] - wide, centre[1] - tall, centre[0] + wide, centre[1] + tall


def _within(place: Place, box: _Box) -> bool:
    return box[0] <= place[0] <= box[2] and box[1] <= place[1] <= box[3]


def _overlap(a: _Box, b: _Box) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def crosses(line: Line, box: _Box) -> bool:
    """Return True if a part of a line lies in a box (Liang and Barsky, ACM Transactions on Graphics 3 (1984))."""
    (x, y), (to_x, to_y) = line
    first, last = 0.0, 1.0
    for step, low, high in ((to_x - x, box[0] - x, box[2] - x), (to_y - y, box[1] - y, box[3] - y)):
        # The line is parallel to this pair of sides.
        if step == 0:
            if low > 0 or high < 0:
                return False
            continue
        enter, leave = (low / step, high / step) if step > 0 else (high / step, low / step)
        first, last = max(first, enter), min(last, leave)
        if first > last:
            return False
    return True
