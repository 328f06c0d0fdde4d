"""A study as data: what is drawn, what each sample is sent through, and how often.

Nothing here runs anything.  A plan becomes JSON (:meth:`Plan.document`) for the manifest, and its cells give every
sample a seed of its own, so that a sample depends on the study's seed, its cell's key and its index alone, and on no
worker count or order.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from random import Random
from traceback import extract_tb
from typing import Literal, TypeVar

from emulator.errors import EmulatorError
from emulator.machine.result import DEFAULT_CORE, DEFAULT_LIMIT

F = TypeVar("F", bound=Callable[..., object])
Value = str | int
SEED = 1963
"""The seed of a study that is given none."""
CHUNK = 200
"""Samples a chunk by default: about a second's work of small sets."""


class PlanError(EmulatorError):
    """A study that cannot be carried out as it is written; one line."""


class StudyFileError(PlanError):
    """A file of a study that cannot be written or read; one line that says what to do."""


@dataclass(frozen=True, slots=True)
class Programs:
    """A route through the emulated programs: program 1, then 2 or 3 as it types.

    name: what tables call it.  state: of program 1, ``listing`` or ``examples``.  layers: of the apparatus, added
    to the three programs.  rows: single rows of the apparatus, added without the rest of their layer.
    arithmetic: of the emulator, ``truncating``, ``ibm1962``, ``truncating:P``, ``guarded:P``, ``rounding:P``, or
    ``float64``, ``float32``, ``mp:BITS``, ``exact`` (:func:`emulator.numbers.numbers`).
    epsilon: chapter 7's e, punched after N; it needs the layer ``epsilon``.  limit: statements a program may run
    before it counts as endless.  core, bounds: as :class:`emulator.machine.result.Options` has them.  measures: names
    of further figures (:mod:`modern.study.measures`).
    """

    name: str
    state: Literal["listing", "examples"] = "listing"
    layers: tuple[str, ...] = ()
    rows: tuple[str, ...] = ()
    arithmetic: str = "truncating"
    epsilon: str = ""
    limit: int = DEFAULT_LIMIT
    core: int = DEFAULT_CORE
    bounds: Literal["strict", "core"] = "strict"
    uncut: bool = False
    measures: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Port:
    """A route through the modern port (:func:`modern.port.convex_hull`), with that function's parameters.

    ``history`` keeps the construction H_1, H_2, ... for the measures.
    """

    name: str
    arithmetic: str = "exact"
    epsilon: str = ""
    translate: bool = False
    history: bool = False
    measures: tuple[str, ...] = ()


Route = Programs | Port


@dataclass(frozen=True, slots=True)
class Cell:
    """Samples of one kind: one family with fixed parameters, every sample sent through every route.

    key: the parameters a table shows, in order; no two cells of a plan have the same.  family: a name of
    :data:`modern.study.families.FAMILIES`, or ``module:function``; parameters: its keyword arguments.  reference:
    the route whose order of cards counts as the order (default: the first).  chunk: samples worked on at once, about
    a second's work; rows do not depend on it.
    """

    key: Mapping[str, Value]
    family: str
    parameters: Mapping[str, object]
    routes: tuple[Route, ...]
    samples: int
    reference: str = ""
    chunk: int = CHUNK

    @property
    def name(self) -> str:
        """The key as text: ``digits=3 n=20``."""
        return " ".join(f"{name}={value}" for name, value in self.key.items())

    def seed(self, study: int, index: int) -> str:
        """The seed of a sample: 32 hexadecimal digits of SHA-256 of study seed, key and index."""
        text = json.dumps([study, list(self.key.items()), index])
        return hashlib.sha256(text.encode("ascii")).hexdigest()[:32]


def named(what: str, name: str, known: Mapping[str, F]) -> F:
    """The function of that name, or ``module:function`` of a user's own.  Raises PlanError."""
    if name in known:
        return known[name]
    module, colon, function = name.partition(":")
    if not colon:
        raise PlanError(f"no {what} is called {name!r}; there are {', '.join(known)} and module:function")
    if not all(part.isidentifier() for part in module.split(".")):
        raise PlanError(f"{what} {name}: {module!r} is not a module's name")
    with own_code(f"{what} {name}", module):
        loaded = import_module(module)
    found: F | None = getattr(loaded, function, None)
    if not callable(found):
        raise PlanError(f"{what} {name}: {module} has no function {function!r}")
    return found


@contextmanager
def own_code(where: str, module: str) -> Iterator[None]:
    """A user's module at work: what goes wrong in it becomes a PlanError with its file and line.

    Errors of this project pass; they are one line already.
    """
    try:
        yield
    except EmulatorError:
        raise
    except Exception as error:
        raise PlanError(f"{where}: {_words(error, module)}") from error


def _words(error: Exception, module: str) -> str:
    if isinstance(error, ModuleNotFoundError) and error.name in (module, module.partition(".")[0]):
        return f"no module is called {module!r}, beside the plan or where Python looks for modules"
    if isinstance(error, SyntaxError):
        return f"{Path(error.filename or module).name}, line {error.lineno}: {error.msg}"
    try:
        spec = find_spec(module)
    except (ImportError, ValueError):  # a name that no module can have
        spec = None
    lines = [frame.lineno for frame in extract_tb(error.__traceback__) if spec and frame.filename == spec.origin]
    place = f"{Path(spec.origin or module).name}, line {lines[-1]}: " if spec and lines else ""
    text = str(error).splitlines()
    return f"{place}{type(error).__name__}{': ' + text[0] if text else ''}"


def random_of(seed: str) -> Random:
    """The generator a sample is drawn with."""
    return Random(int(seed, 16))


@dataclass(frozen=True, slots=True)
class Chunk:
    """Samples ``start`` to ``stop`` (not included) of a cell, worked on at once; ``cell`` counts from 0."""

    cell: int
    start: int
    stop: int

    @property
    def name(self) -> str:
        """The name of its file, in the order of the cells and samples."""
        return f"{self.cell:04d}-{self.start:09d}.jsonl"


@dataclass(frozen=True, slots=True)
class Plan:
    """A study: its name, its question, its seed and its cells.

    notes: what a reader of the manifest should know, such as why the parameters are what they are.
    """

    name: str
    title: str
    question: str
    cells: tuple[Cell, ...]
    seed: int = SEED
    notes: tuple[str, ...] = field(default=())

    @property
    def samples(self) -> int:
        """Samples in all."""
        return sum(cell.samples for cell in self.cells)

    def chunks(self) -> Iterator[Chunk]:
        """All the work, in order."""
        for number, cell in enumerate(self.cells):
            for start in range(0, cell.samples, cell.chunk):
                yield Chunk(number, start, min(start + cell.chunk, cell.samples))

    def document(self) -> dict[str, object]:
        """The plan as JSON data: equal exactly for equal plans."""
        data = asdict(self)
        data["cells"] = [
            {**asdict(cell), "key": list(map(list, cell.key.items())), "routes": [document(r) for r in cell.routes]}
            for cell in self.cells
        ]
        return dict(json.loads(json.dumps(data)))


def document(route: Route) -> dict[str, object]:
    """A route as JSON data, with the kind it is; ``uncut`` stands there where it is asked for."""
    data = {"kind": "programs" if isinstance(route, Programs) else "port", **asdict(route)}
    if not data.get("uncut"):
        data.pop("uncut", None)
    return data
