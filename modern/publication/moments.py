"""The points and the hull in a program's variables at the end of each block of its commentary.

The programs run with the decks of chapter 6. The *moment* of a block is the end of its first execution that changes the
points or the equations, or the end of its first execution if none changes them. ``marks`` of the commentary
(``fortran_src/commentary``) name the variables whose points are highlighted. For example, the marks
``I`` and ``I1 I2`` name variables that contain numbers of points, ``plane NETC`` names a variable that contains the
number of an equation, and ``at C1 C2 C3`` names variables that contain coordinates.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any

from emulator.language.objectcode import Line
from emulator.machine.machine import run_with_operator
from emulator.machine.operator import Operator
from emulator.machine.result import Options
from emulator.machine.session import Session
from modern.drawing.layout import fit
from modern.drawing.view import Eye, across, towards, view
from modern.edition import programs
from modern.geometry.vectors import Vector, cross, dot, minus
from modern.publication.commentary import Block, commentary
from modern.publication.decks import named_deck
from modern.publication.measured import LIMIT, runs
from modern.publication.panel import DEFINING, Record, exact, number

Point = tuple[float, ...]
Faces = tuple[tuple[Point, ...], ...]
# The direction of view for points in space.
EYE: Eye = (11, 13, 19)
_WIDTH, _HEIGHT, _MARGIN = 200, 130, 12
LEGEND = (
    "Pictures: the points in the program's variables at the end of the block. Filled: a vertex. Cross: a point that "
    "the program has deleted. Bold: a new equation. Dashed: a removed equation. Coloured: the named variables."
)


@dataclass(frozen=True, slots=True)
class State:
    """The points and faces in a program's variables. The first ``vertices`` points are the vertices."""

    points: tuple[Point, ...] = ()
    vertices: int = 0
    faces: Faces = ()

    def outline(self) -> tuple[frozenset[Point], frozenset[frozenset[Point]]]:
        """Return the points and the faces as sets, to compare two moments without regard to the order."""
        return frozenset(self.points), frozenset(map(frozenset, self.faces))


@dataclass(frozen=True, slots=True)
class Mark:
    """A highlighted point, segment or polygon. ``name`` has the names and values of its variables: ``I1 = 2``."""

    name: str
    corners: tuple[Point, ...]


@dataclass(frozen=True, slots=True)
class Moment:
    """The end of an execution of a block in a run of an example.

    ``statements`` is the number of statements executed so far. ``before`` and ``after`` are the states at the beginning
    and the end of the execution. ``cloud`` has all points of the run.
    """

    example: int
    statements: int
    before: State
    after: State
    marks: tuple[Mark, ...]
    cloud: tuple[Point, ...]

    def caption(self) -> str:
        """Return a sentence with the example, the number of statements and the highlighted variables."""
        names = ", ".join(mark.name for mark in self.marks if mark.name)
        faces, count = len(self.after.faces), len(self.after.points)
        points = f"{count} point{'s' * (count != 1)}"
        counts = f"{self.after.vertices} vertices, {faces} equations" if faces else points
        return f"Example {self.example} after {self.statements:,} statements: {counts}{'; ' if names else ''}{names}."


@cache
def moments(program: str) -> Mapping[int, Moment]:
    """Return the moments of a program by the first card of their block. A block without points has no moment."""
    result: dict[int, Moment] = {}
    blocks = commentary(program).blocks
    for run in reversed(runs(program)):
        if len(result) < len(blocks):
            suffix = "" if programs.built_in(program).number == 1 else "/punched"
            code, deck = programs.program(program), named_deck(f"example{run.example}{suffix}")
            recorder = _Recorder(blocks, run.example, Record(code))
            session = Session(code, deck, Options(limit=LIMIT), tracer=recorder)
            run_with_operator(session, Operator())
            result = recorder.moments() | result
    return result


@dataclass
class _Recorder:
    blocks: Sequence[Block]
    example: int
    record: Record
    _block: Block | None = None
    _before: State = field(default_factory=State)
    _count: int = 0
    _cloud: tuple[Point, ...] = ()
    # For the first card of each block: whether the execution changed the points or equations, and its moment.
    _moments: dict[int, tuple[bool, Moment]] = field(default_factory=dict)

    def __call__(self, line: Line, session: Session) -> None:
        self.record(line, session)
        if self._block is None or line.place.card not in self._block.cards:
            state = _state(self.record.picture(session))
            if self._block is not None and state.points:
                self._leave(self._block, state, session)
            if len(state.points) > len(self._cloud):
                self._cloud = state.points
            self._block = next(block for block in self.blocks if line.place.card in block.cards)
            self._before = state
        self._count += 1

    def _leave(self, block: Block, state: State, session: Session) -> None:
        changes = bool(self._before.points) and state.outline() != self._before.outline()
        known = self._moments.get(block.cards.start)
        if known is None or changes > known[0]:
            marks = tuple(_marks(block, state, session))
            moment = Moment(self.example, self._count, self._before, state, marks, ())
            self._moments[block.cards.start] = changes, moment

    def moments(self) -> dict[int, Moment]:
        """Return the moments by the first card of their block."""
        return {card: replace(moment, cloud=self._cloud) for card, (_, moment) in self._moments.items()}


def _state(now: Mapping[str, Any]) -> State:
    if not now:
        return State()
    points = tuple(tuple(point) for point in now["points"])
    faces = tuple(tuple(points[n] for n in face) for face in now["faces"])
    return State(points, now["vertices"], faces)


def _marks(block: Block, state: State, session: Session) -> Iterator[Mark]:
    """Yield the marks of a block, except those whose variables do not contain numbers of existing points."""
    for mark in block.marks:
        kind, *names = mark.split() if mark.startswith(("plane ", "line ", "at ")) else ("points", *mark.split())
        values = [_value(name, session) for name in names]
        if None in values:
            continue
        numbers = [int(value or 0) for value in values]
        label = ", ".join(f"{name} = {n}" for name, n in zip(names, numbers, strict=True) if not name.isdigit())
        if kind == "at":
            yield Mark("the inside point", (tuple(value or 0.0 for value in values),))
            continue
        if kind in ("plane", "line"):
            tables = [table for name in DEFINING if len(table := session.program.storage.fields_of(name)) > 1]
            fields = [table[numbers[0] - 1] for table in tables if 0 < numbers[0] <= len(table)]
            numbers = [int(number(session, field) or 0) for field in fields]
        if numbers and all(0 < n <= len(state.points) for n in numbers):
            yield Mark(label, tuple(state.points[n - 1] for n in numbers))


def _value(name: str, session: Session) -> float | None:
    if name.isdigit():
        return float(name)
    return number(session, session.program.storage.fields_of(name).start)


def drawn(moment: Moment) -> str:
    """Return the picture of a moment as SVG, with CSS classes for its colours.

    Faces that the block has added are bold, and those that it has removed are dashed. A cross marks a point that the
    program has deleted, and a filled circle a vertex.
    """
    place, height = _projection(moment.cloud)

    def path(corners: Sequence[Point], kind: str) -> str:
        return f'<path class="{kind}" d="M{"L".join("{:.1f} {:.1f}".format(*place(point)) for point in corners)}Z"/>'

    now, before = moment.after, moment.before
    old = {frozenset(face) for face in before.faces}
    present = {frozenset(face) for face in now.faces}
    items = [path(mark.corners, "mark") for mark in moment.marks if len(mark.corners) > 1]
    items += [path(face, "gone") for face in before.faces if frozenset(face) not in present]
    items += [path(face, "face" if frozenset(face) in old or not old else "new") for face in now.faces]
    for point in moment.cloud:
        x, y = place(point)
        if point not in now.points:
            items.append(f'<path class="cross" d="M{x - 3:.1f} {y - 3:.1f}l6 6m0 -6l-6 6"/>')
        else:
            is_vertex = now.points.index(point) < now.vertices
            items.append(f'<circle class="{"vertex" if is_vertex else "point"}" cx="{x:.1f}" cy="{y:.1f}" r="3"/>')
    for mark in moment.marks:
        if len(mark.corners) == 1:
            x, y = place(mark.corners[0])
            items.append(f'<circle class="ring" cx="{x:.1f}" cy="{y:.1f}" r="7"/>')
    size = f'viewBox="0 0 {_WIDTH} {height}" width="{_WIDTH}" height="{height}"'
    return f'<svg class="moment" {size} aria-hidden="true">{"".join(items)}</svg>'


def _projection(cloud: Sequence[Point]) -> tuple[Callable[[Point], tuple[float, float]], int]:
    """Return the function that maps a point in space to a place in the picture, and the height of the picture."""
    sight = view(_eye([exact(point) for point in cloud]))
    pixel, height = fit([sight.project(exact(point)) for point in cloud], _WIDTH, _HEIGHT, _MARGIN)
    return lambda point: pixel(sight.project(exact(point))).place, height


def _eye(points: Sequence[Vector]) -> Eye:
    """Return a direction of view for points. If all lie in a line or plane, the view is perpendicular to it."""
    apart = [line for point in points if any(line := minus(point, points[0]))]
    normal = next((n for line in apart if any(n := cross(apart[0], line))), None)
    if normal is None:
        return across(apart[0]) if apart else EYE
    return EYE if any(dot(normal, line) for line in apart) else towards(normal)
