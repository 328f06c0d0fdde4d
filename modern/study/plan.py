"""The plan of a study: its cells, the samples they draw, and the routes through which every sample is sent.

sample
    A set of points, drawn from a seed or given, together with its exact hull.
route (:class:`Programs`, :class:`Port`)
    One way to compute a hull: the 1620 programs with certain layers and arithmetic, or the modern port.  Reports also
    call it a treatment or a way.
cell (:class:`Cell`)
    Samples of one kind: one family of point sets with fixed parameters.  Every sample of a cell goes through all routes
    of the cell, so routes are compared on the same point sets.
chunk (:class:`Chunk`)
    Consecutive samples of a cell that are computed and stored together, in about a second.

The manifest stores a plan as JSON (:meth:`Plan.document`).  The seed of a sample depends only on the seed of the study,
the key of the cell and the index of the sample, and not on the number of workers or the order of the work.
"""

import hashlib
import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from traceback import extract_tb
from typing import Any, Literal, TypeVar

from emulator.errors import EmulatorError, quoted
from emulator.machine.result import DEFAULT_CORE, DEFAULT_LIMIT

F = TypeVar("F", bound=Callable[..., object])
Value = str | int
SEED = 1963
# The default number of samples in a chunk: about a second's work for small sets.
CHUNK = 200


class PlanError(EmulatorError):
    """Raised for a plan that cannot be carried out.  The message is one line."""


class StudyFileError(PlanError):
    """Raised if a file of a study cannot be written or read; the message, of one line, says what to do."""


@dataclass(frozen=True, slots=True)
class Programs:
    """A route through the emulated programs: program 1, then program 2 or 3, as program 1 requests.

    name: the name in tables.  state: the version of program 1, ``listing`` or ``examples``.  layers: the layers of
    the apparatus (the register of corrections to the printed listings) that are added to the three programs.  rows:
    single rows of the apparatus, added without the rest of their layer.  arithmetic: the name of an arithmetic
    (:func:`emulator.numbers.numbers`).  epsilon: the e of chapter 7, punched on the first card; it requires the layer
    ``epsilon``.  limit: the number of statements after which a run counts as endless.  core, bounds: as in
    :class:`emulator.machine.result.Options`.  uncut: True to keep all digits of the numbers that pass from one program
    to the next.  measures: the names of the measures to compute (:mod:`modern.study.measures`).
    """

    name: str
    state: Literal["listing", "examples"] = "listing"
    layers: tuple[str, ...] = ()
    rows: tuple[str, ...] = ()
    arithmetic: str = "truncating"
    epsilon: str | float = ""
    limit: int = DEFAULT_LIMIT
    core: int = DEFAULT_CORE
    bounds: Literal["strict", "core"] = "strict"
    uncut: bool = False
    measures: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "epsilon", str(self.epsilon))  # 0.001 and "0.001" are the same e


@dataclass(frozen=True, slots=True)
class Port:
    """A route through :func:`modern.port.convex_hull`.

    history: True to keep the stages H_1, H_2, ... of the construction for the measures.
    """

    name: str
    arithmetic: str = "exact"
    epsilon: str | float = ""
    translate: bool = False
    history: bool = False
    measures: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "epsilon", str(self.epsilon))  # 0.001 and "0.001" are the same e


Route = Programs | Port


@dataclass(frozen=True, slots=True)
class Cell:
    """Samples of one kind, from one family with fixed parameters.  Each sample goes through all routes of the cell.

    key: the parameters that tables show, in order.  A key is unique in a plan.  family: a name in
    :data:`modern.study.families.FAMILIES`, or ``module:function``.  parameters: the keyword arguments of the family.
    reference: the route whose order of vertices and planes the other routes are compared with (default: the first).
    chunk: the number of samples in a chunk.  Rows do not depend on this number.
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
        """Return the key as text: ``digits=3 n=20``."""
        return " ".join(f"{name}={value}" for name, value in self.key.items())

    def seed(self, study: int, index: int) -> str:
        """Return the seed of a sample: 32 hexadecimal digits of the SHA-256 of the study's seed, key and index."""
        text = json.dumps([study, list(self.key.items()), index])
        return hashlib.sha256(text.encode("ascii")).hexdigest()[:32]


def named(kind: str, name: str, known: Mapping[str, F]) -> F:
    """Return the function called ``name`` in ``known``, or the user's function that ``module:function`` names.

    kind: what the function is, for messages, such as "family".  Raise PlanError if there is no such function.
    """
    if name in known:
        return known[name]
    module, colon, function = name.partition(":")
    if not colon:
        raise PlanError(f"no {kind} is called {quoted(name)}; expected {', '.join(known)} or module:function")
    if not all(part.isidentifier() for part in module.split(".")):
        raise PlanError(f"{kind} {name}: {quoted(module)} is not a module name")
    with user_code(f"{kind} {name}", module):
        loaded = import_module(module)
    user_function: F | None = getattr(loaded, function, None)
    if not callable(user_function):
        raise PlanError(f"{kind} {name}: {module} has no function {quoted(function)}")
    return user_function


@contextmanager
def user_code(where: str, module: str) -> Iterator[None]:
    """Turn an exception of a user's module into a PlanError with file and line.  Raise EmulatorErrors unchanged."""
    try:
        yield
    except EmulatorError:
        raise
    except Exception as error:
        raise PlanError(f"{where}: {_user_error(error, module)}") from error


def _user_error(error: Exception, module: str) -> str:
    if isinstance(error, ModuleNotFoundError) and error.name in (module, module.partition(".")[0]):
        return f"no module is called {quoted(module)} next to the plan or on Python's module path"
    if isinstance(error, SyntaxError):
        return f"{Path(error.filename or module).name}, line {error.lineno}: {error.msg}"
    try:
        spec = find_spec(module)
    except (ImportError, ValueError):  # find_spec rejects names that no module can have
        spec = None
    lines = [frame.lineno for frame in extract_tb(error.__traceback__) if spec and frame.filename == spec.origin]
    location = f"{Path(spec.origin or module).name}, line {lines[-1]}: " if spec and lines else ""
    message = str(error).splitlines()
    return f"{location}{type(error).__name__}{': ' + message[0] if message else ''}"


@dataclass(frozen=True, slots=True)
class Chunk:
    """Consecutive samples: those of cell ``cell`` with the indices ``start`` to ``stop`` - 1, all counted from 0."""

    cell: int
    start: int
    stop: int

    @property
    def name(self) -> str:
        """Return the name of the chunk's file.

        If the files are sorted by name, they are in the order of cells and samples.
        """
        return f"{self.cell:04d}-{self.start:09d}.jsonl"


@dataclass(frozen=True, slots=True)
class Plan:
    """A study: its name, question, seed and cells, and notes for readers of the manifest."""

    name: str
    title: str
    question: str
    cells: tuple[Cell, ...]
    seed: int = SEED
    notes: tuple[str, ...] = ()

    @property
    def samples(self) -> int:
        """Return the number of samples in all cells."""
        return sum(cell.samples for cell in self.cells)

    def chunks(self) -> Iterator[Chunk]:
        """Yield all chunks in order.  The first chunks are small (1, 2, 4, ... samples), so that rows appear soon."""
        size = 1
        for number, cell in enumerate(self.cells):
            start = 0
            while start < cell.samples:
                stop = min(start + min(size, cell.chunk), cell.samples)
                yield Chunk(number, start, stop)
                start, size = stop, 2 * size

    def document(self) -> dict[str, object]:
        """Return the plan as JSON data.  Two plans have equal data if and only if they are equal."""
        data = asdict(self)
        data["cells"] = [
            {**asdict(cell), "key": list(map(list, cell.key.items())), "routes": [document(r) for r in cell.routes]}
            for cell in self.cells
        ]
        return dict(json.loads(json.dumps(data)))

    @classmethod
    def of_document(cls, data: Mapping[str, Any]) -> "Plan":
        """Return a plan from JSON data.  Raise KeyError, TypeError, ValueError or AttributeError for invalid data."""
        cells = tuple(
            Cell(**{**cell, "key": dict(cell["key"]), "routes": tuple(map(_route_of_document, cell["routes"]))})
            for cell in data["cells"]
        )
        return cls(**{**data, "cells": cells, "notes": tuple(data["notes"])})


def document(route: Route) -> dict[str, object]:
    """Return a route as JSON data with its kind.  ``uncut`` is included only if it is true."""
    data = {"kind": "programs" if isinstance(route, Programs) else "port", **asdict(route)}
    if not data.get("uncut"):
        data.pop("uncut", None)
    return data


def _route_of_document(data: Mapping[str, Any]) -> Route:
    values = {name: tuple(value) if isinstance(value, list) else value for name, value in data.items()}
    route_type: type[Any] = Programs if values.pop("kind") == "programs" else Port
    route: Route = route_type(**values)
    return route
