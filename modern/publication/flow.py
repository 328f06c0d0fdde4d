"""The control flow of a program as the boxes of a flow chart in the style of 1963.

A box is a sequence of statements of one kind, which control can enter only at its first statement. The kinds are
processing, input and output, a decision, an empty step, and an end. The boxes are derived from object code, so that the
chart shows the control flow of the compiled program. A DO becomes two boxes: its first assignment and, after its last
statement, the decision whether to repeat the loop.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

from emulator.language import objectcode as op
from emulator.language.objectcode import LIST_PASS, LIST_REST, Instruction, Line, Program

Kind = Literal["processing", "input/output", "decision", "step", "end"]
Side = Literal["left", "down", "right"]


@dataclass(frozen=True, slots=True)
class Exit:
    """An exit of a box: its condition ``taken`` (empty for a single exit), its side, and the index of its target."""

    taken: str
    side: Side
    target: int


@dataclass(frozen=True, slots=True)
class Box:
    """A symbol of the chart.

    ``label`` is the number of its first statement, or empty. ``name`` is that number or ``card N``. ``cards`` are the
    numbers of the cards that the box represents. ``lines`` is its text, one line for each statement.
    """

    kind: Kind
    label: str
    name: str
    cards: tuple[int, ...]
    lines: tuple[str, ...]
    exits: tuple[Exit, ...]


@dataclass(frozen=True)
class Flow:
    """The boxes of a program in the order of its cards. An exit names its target by the index in ``boxes``."""

    source: str
    boxes: tuple[Box, ...]

    @cached_property
    def arrivals(self) -> tuple[tuple[tuple[int, int], ...], ...]:
        """For each box, the exits that lead to it, as pairs: the index of the exit's box and the exit's index there."""
        arrivals: list[list[tuple[int, int]]] = [[] for _ in self.boxes]
        for place, box in enumerate(self.boxes):
            for k, way in enumerate(box.exits):
                arrivals[way.target].append((place, k))
        return tuple(map(tuple, arrivals))

    def table(self) -> tuple[tuple[str, str, str], ...]:
        """Return every transition as three texts: the name of a box, a condition, and the name of the target."""
        return tuple(
            (box.name, way.taken or "next", self.boxes[way.target].name) for box in self.boxes for way in box.exits
        )


def flow(program: Program) -> Flow:
    """Return the control flow of a program, without the end of a run at a READ that finds no card."""
    parts = _parts(program)
    return Flow(program.source, _merged(_forwarded([_box(program, part, parts) for part in parts])))


@dataclass(frozen=True, slots=True)
class _Part:
    """The instructions of a statement, or, if ``begins`` is False, those that close a DO after its last statement."""

    start: int
    end: int
    line: Line
    begins: bool

    @property
    def written(self) -> str:
        text = " ".join(self.line.text.split())
        return text.removeprefix(str(self.line.label)).lstrip() if self.line.label else text


def _parts(program: Program) -> list[_Part]:
    # A statement and the closing of a DO begin with a COUNT; those inside input and output lists are skipped.
    counts = [
        (pc, program.counters[i.address])
        for pc, i in enumerate(program.code)
        if i.operation == op.COUNT and program.counters[i.address].what not in (LIST_PASS, LIST_REST)
    ]
    ends = [pc for pc, _ in counts[1:]] + [len(program.code)]
    return [
        _Part(pc, end, program.statements[counter.statement], counter.begins)
        for (pc, counter), end in zip(counts, ends, strict=True)
    ]


def _box(program: Program, part: _Part, parts: Sequence[_Part]) -> Box:
    """Return the box of one statement's instructions. An exit names its target by the index in ``parts``."""
    index_of = {known.start: index for index, known in enumerate(parts)}
    code = program.code[part.start : part.end]
    last = code[-1]
    label, written = (str(part.line.label or ""), part.written) if part.begins else ("", "")

    def box(kind: Kind, lines: Iterable[str], *exits: tuple[str, Side, int]) -> Box:
        ways = tuple(Exit(taken, side, index_of[pc]) for taken, side, pc in exits)
        return Box(kind, label, label or f"card {part.line.place.card}", (part.line.place.card,), tuple(lines), ways)

    if last.operation in (op.IF, op.IFX):
        ways = zip("-0+", ("left", "down", "right"), program.branches[last.address], strict=True)
        return box("decision", (_tested(written),), *ways)  # type: ignore[arg-type]
    if last.operation == op.SWITCH:
        on, off = program.branches[last.address]
        return box("decision", (_tested(written),), ("on", "left", on), ("off", "right", off))
    if last.operation == op.SELECT:
        return box("decision", (written.rpartition(",")[2].strip(),), *_selected(program.branches[last.second]))
    if last.operation == op.DOTEST and not part.begins:
        test, first = _loop_test(program, last), program.loops[last.address][3]
        return box("decision", (test,), ("again", "left", first), ("done", "down", part.end))
    if last.operation == op.STOP:
        return box("end", (written or "END",))
    if last.operation == op.BRANCH:
        return box("step", (), ("", "down", program.branches[last.address][0]))
    uses_device = any(i.operation in (op.BEGIN, op.PAUSE) for i in code)
    kind: Kind = "input/output" if uses_device else "processing" if len(code) > 1 else "step"
    after = part.start if part is parts[-1] else part.end
    return box(kind, (_first_value(written),) if kind != "step" else (), ("", "down", after))


def _tested(written: str) -> str:
    return written[written.index("(") + 1 : written.rindex(")")].strip()


def _first_value(written: str) -> str:
    """Return the first assignment of a DO (``I=1`` for ``DO 101 I=1,N``), and any other statement unchanged."""
    tokens = written.split(None, 2)
    if len(tokens) == 3 and tokens[0] == "DO" and tokens[1].isdigit() and "=" in tokens[2]:
        variable, _, rest = tokens[2].partition("=")
        return f"{variable.strip()}={rest.split(',')[0].strip()}"
    return written


def _loop_test(program: Program, test: Instruction) -> str:
    names = map(program.storage.name_of, program.loops[test.address][:3])
    variable, step, limit = (name.removeprefix("constant ") for name in names)
    return f"{variable}+{step} <= {limit}"


def _selected(targets: Sequence[int]) -> list[tuple[str, Side, int]]:
    """Return the exits of a computed GO TO: one for each target, with the values that select it."""
    values: dict[int, list[str]] = {}
    for value, target in enumerate(targets, 1):
        values.setdefault(target, []).append(str(value))
    return [(", ".join(taken), "right", target) for target, taken in values.items()]


def _forwarded(boxes: Sequence[Box]) -> list[Box | None]:
    """Replace each unnumbered GO TO by None, and let the exit of the box before it lead to the target of the GO TO."""
    forwarded: list[Box | None] = list(boxes)
    come_from = _sources(boxes)
    for place, box in enumerate(boxes):
        # A box is removed only if control reaches it from nowhere but the box before it.
        before = forwarded[place - 1] if place else None
        if box.kind != "step" or box.label or come_from[place] != [place - 1] or before is None:
            continue
        ways = tuple(replace(way, target=box.exits[0].target) if way.target == place else way for way in before.exits)
        forwarded[place - 1] = replace(before, exits=ways, cards=_union(before.cards, box.cards))
        forwarded[place] = None
    return forwarded


def _merged(boxes: Sequence[Box | None]) -> tuple[Box, ...]:
    """Merge consecutive boxes of processing, or of input and output, and renumber the targets of the exits."""
    merged: list[Box] = []
    new_index: dict[int, int] = {}
    come_from = _sources(boxes)
    for place, box in enumerate(boxes):
        if box is None:
            continue
        last = merged[-1] if merged else None
        # Two boxes are one if they are of the same kind and no jump arrives between them.
        joins_last = (
            last is not None
            and last.kind == box.kind in ("processing", "input/output")
            and come_from[place] == [place - 1]
            and last.exits[0].target == place
        )
        if last is not None and joins_last:
            cards = _union(last.cards, box.cards)
            merged[-1] = replace(last, cards=cards, lines=last.lines + box.lines, exits=box.exits)
        else:
            merged.append(box)
        new_index[place] = len(merged) - 1
    return tuple(
        replace(box, exits=tuple(replace(way, target=new_index[way.target]) for way in box.exits)) for box in merged
    )


def _sources(boxes: Sequence[Box | None]) -> list[list[int]]:
    sources: list[list[int]] = [[] for _ in boxes]
    for place, box in enumerate(boxes):
        for way in box.exits if box else ():
            sources[way.target].append(place)
    return sources


def _union(first: tuple[int, ...], second: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(dict.fromkeys(first + second))
