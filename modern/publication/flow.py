"""The flow of control of a program, box by box, as a flow chart of 1963 shows it.

A box is a run of statements of one kind with one way in: processing, input and output, a decision, a step that is
only gone through, or an end.  It is made from object code, so that a chart shows where the compiled program goes and
not what its cards seem to say: a DO becomes its first assignment and, after its last statement, the decision whether
to go round again.
"""

from __future__ import annotations

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
    """A way out of a box: what it is taken for (nothing where there is only one), its side, the box it goes to."""

    taken: str
    side: Side
    target: int


@dataclass(frozen=True, slots=True)
class Box:
    """One symbol of the chart.

    ``name`` is its first statement's number, else ``card N``, and ``label`` that number alone, or nothing; ``cards``
    are those it stands for; ``lines`` is what is written in it, a line a statement.
    """

    kind: Kind
    label: str
    name: str
    cards: tuple[int, ...]
    lines: tuple[str, ...]
    exits: tuple[Exit, ...]


@dataclass(frozen=True)
class Flow:
    """The boxes of a program, in the order of its cards; an exit names its target by its place here, from 0."""

    source: str
    boxes: tuple[Box, ...]

    def arrivals(self, target: int) -> tuple[tuple[int, int], ...]:
        """The ways that go to a box: box and place among its exits."""
        return self._arrivals[target]

    @cached_property
    def _arrivals(self) -> tuple[tuple[tuple[int, int], ...], ...]:
        found: list[list[tuple[int, int]]] = [[] for _ in self.boxes]
        for place, box in enumerate(self.boxes):
            for k, way in enumerate(box.exits):
                found[way.target].append((place, k))
        return tuple(tuple(ways) for ways in found)

    def table(self) -> tuple[tuple[str, str, str], ...]:
        """Every way from box to box, as words: from, taken for, to."""
        return tuple(
            (box.name, way.taken or "next", self.boxes[way.target].name) for box in self.boxes for way in box.exits
        )


def flow(program: Program) -> Flow:
    """The flow of a program.  An empty hopper, which ends a run at a READ, is not drawn."""
    parts = _parts(program)
    return Flow(program.source, _merged(_forwarded([_box(program, part, parts) for part in parts])))


@dataclass(frozen=True, slots=True)
class _Part:
    """A statement, or the closing of a DO: its instructions."""

    start: int
    end: int
    line: Line
    begins: bool

    @property
    def written(self) -> str:
        """The statement without its number."""
        text = " ".join(self.line.text.split())
        return text.removeprefix(str(self.line.label)).lstrip() if self.line.label else text


def _parts(program: Program) -> list[_Part]:
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
    """The box of one part, its targets by part."""
    at = {each.start: place for place, each in enumerate(parts)}
    place = at[part.start]
    code = program.code[part.start : part.end]
    last = code[-1]
    label, written = (str(part.line.label or ""), part.written) if part.begins else ("", "")

    def box(kind: Kind, lines: Iterable[str], *exits: tuple[str, Side, int]) -> Box:
        ways = tuple(Exit(taken, side, at[pc]) for taken, side, pc in exits)
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
        return box(
            "decision",
            (_again(program, last),),
            ("again", "left", program.loops[last.address][3]),
            ("done", "down", part.end),
        )
    if last.operation == op.STOP:
        return box("end", (written or "END",))
    if last.operation == op.BRANCH:
        return box("step", (), ("", "down", program.branches[last.address][0]))
    serves = any(i.operation in (op.BEGIN, op.PAUSE) for i in code)
    kind: Kind = "input/output" if serves else "processing" if len(code) > 1 else "step"
    after = part.end if place + 1 < len(parts) else part.start
    return box(kind, (_first_value(written),) if kind != "step" else (), ("", "down", after))


def _tested(written: str) -> str:
    """What an IF tests: the text between its outer parentheses."""
    return written[written.index("(") + 1 : written.rindex(")")].strip()


def _first_value(written: str) -> str:
    """A DO as the assignment it begins with: ``DO 101 I=1,N`` is ``I=1``; other statements as they stand."""
    words = written.split(None, 2)
    if len(words) == 3 and words[0] == "DO" and words[1].isdigit() and "=" in words[2]:
        variable, _, rest = words[2].partition("=")
        return f"{variable.strip()}={rest.split(',')[0].strip()}"
    return written


def _again(program: Program, test: Instruction) -> str:
    """The closing of a DO: ``I+1 <= N``."""
    variable, step, limit = (
        program.storage.name_of(field).removeprefix("constant ") for field in program.loops[test.address][:3]
    )
    return f"{variable}+{step} <= {limit}"


def _selected(targets: Sequence[int]) -> list[tuple[str, Side, int]]:
    """A computed GO TO: an exit a statement gone to, with the values it is gone to for."""
    values: dict[int, list[str]] = {}
    for value, target in enumerate(targets, 1):
        values.setdefault(target, []).append(str(value))
    return [(", ".join(taken), "right", target) for target, taken in values.items()]


def _forwarded(boxes: Sequence[Box]) -> list[Box | None]:
    """The boxes with a GO TO of no number drawn as the line it is: the box before it goes where it goes."""
    found: list[Box | None] = list(boxes)
    come_from = _sources(boxes)
    for place, box in enumerate(boxes):
        before = found[place - 1] if place else None
        if box.kind != "step" or box.label or come_from[place] != [place - 1] or before is None:
            continue
        if box.exits[0].target == place:
            continue
        ways = tuple(replace(way, target=box.exits[0].target) if way.target == place else way for way in before.exits)
        found[place - 1] = replace(before, exits=ways, cards=_together(before.cards, box.cards))
        found[place] = None
    return found


def _merged(boxes: Sequence[Box | None]) -> tuple[Box, ...]:
    """One box for statements of one kind that follow each other; then exits name their targets by place."""
    kept: list[Box] = []
    now_at: dict[int, int] = {}
    come_from = _sources(boxes)
    for place, box in enumerate(boxes):
        if box is None:
            continue
        last = kept[-1] if kept else None
        joined = (
            last is not None
            and last.kind == box.kind in ("processing", "input/output")
            and come_from[place] == [place - 1]
            and last.exits[0].target == place
        )
        if last is not None and joined:
            kept[-1] = replace(
                last, cards=_together(last.cards, box.cards), lines=last.lines + box.lines, exits=box.exits
            )
        else:
            kept.append(box)
        now_at[place] = len(kept) - 1
    return tuple(
        replace(box, exits=tuple(replace(way, target=now_at[way.target]) for way in box.exits)) for box in kept
    )


def _sources(boxes: Sequence[Box | None]) -> list[list[int]]:
    """For each box those that go to it."""
    found: list[list[int]] = [[] for _ in boxes]
    for place, box in enumerate(boxes):
        for way in box.exits if box else ():
            found[way.target].append(place)
    return found


def _together(some: tuple[int, ...], more: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(dict.fromkeys(some + more))
