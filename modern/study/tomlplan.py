"""A plan from a TOML file: a study without a line of Python.

::

    name = "mine"
    title = "What three digits do"
    question = "How often do the programs refuse them?"
    samples = 200                    # of each cell that does not say otherwise

    [[route]]
    name = "as listed"               # kind = "programs" where it does not say "port"

    [[route]]
    name = "float64"
    kind = "port"
    arithmetic = "float64"

    [[cell]]
    family = "integers"
    parameters = { digits = 3, n = [4, 20] }

    [[cell]]
    family = "file"                  # the points of a deck, CSV or OFF file, beside the plan
    parameters = { path = "mine.csv", shuffle = true }

Every route serves every cell that does not name its own (``routes = ["float64"]``).  A cell without ``key`` has its
family and parameters for one.  ``family = "mine:points"`` is the function ``points`` of ``mine.py`` beside the plan, or
wherever Python looks for modules; so it is with ``measures = ["mine:spread"]``.
"""

from __future__ import annotations

import sys
import tomllib
from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

from emulator.files import read_text
from modern.study.families.given import file_points
from modern.study.plan import SEED, Cell, Plan, PlanError, Port, Programs, Route

_SAMPLES = 1000
_HEAD = ("name", "title", "question", "samples", "seed", "notes", "route", "cell")
_CELL = ("key", "family", "parameters", "routes", "samples", "reference", "chunk")
_KINDS: tuple[tuple[str, type, str], ...] = (
    ("key", dict, "{ name = value }"),
    ("family", str, "text"),
    ("parameters", dict, "{ name = value }"),
    ("routes", list, "a list of names"),
    ("reference", str, "a route's name"),
)


def is_plan_file(name: str) -> bool:
    """Whether a study's name on the command line is a file's."""
    return name.endswith(".toml")


def read_plan(path: str, samples: int | None = None, seed: int | None = None) -> Plan:
    """The plan of a file; ``samples`` and ``seed`` go before the file's own.  Raises FileError, PlanError."""
    text = read_text(path)
    try:
        data = tomllib.loads(text)
    except RecursionError:
        raise PlanError(f"{path}: nested too deeply") from None
    except tomllib.TOMLDecodeError as error:
        raise PlanError(f"{path}: {str(error).splitlines()[0]}") from None
    _find_beside(data, Path(path).resolve().parent)
    try:
        return _plan(data, Path(path), samples, seed)
    except (TypeError, AttributeError) as error:
        raise PlanError(f"{path}: something is of a wrong kind: {error}") from None


def _find_beside(data: Mapping[str, Any], folder: Path) -> None:
    """Have Python look beside the plan too for the module of a family or measure of one's own."""
    parts = [part for name in ("cell", "route") for part in _listed(data.get(name)) if isinstance(part, dict)]
    names = [name for part in parts for name in (part.get("family"), *_listed(part.get("measures")))]
    modules = {name.partition(":")[0] for name in names if isinstance(name, str) and ":" in name}
    if any((folder / f"{module.partition('.')[0]}.py").exists() for module in modules) and str(folder) not in sys.path:
        sys.path.append(str(folder))


def _listed(value: Any) -> list[Any]:
    return value if isinstance(value, list) else []


def _plan(data: Mapping[str, Any], path: Path, samples: int | None, seed: int | None) -> Plan:
    _known(data, _HEAD, f"{path}")
    for name, kind, words in (("notes", list, "a list"), ("route", list, "[[route]]"), ("cell", list, "[[cell]]")):
        _of_kind(data, name, kind, words, f"{path}")
    routes: dict[str, Route] = {}
    for number, raw in enumerate(data.get("route", ()), 1):
        route = _route(raw, f"{path}: route {number}")
        if route.name in routes:
            raise PlanError(f"{path}: two routes have the name {route.name!r}")
        routes[route.name] = route
    if not routes:
        raise PlanError(f"{path}: there is no [[route]]")
    cells = []
    for number, raw in enumerate(data.get("cell", ()), 1):
        where = f"{path}: cell {number}"
        _known(raw, _CELL, where)
        size = samples or raw.get("samples", data.get("samples", _SAMPLES))
        cells.append(_cell(raw, routes, size, path.parent, where))
    name = str(data.get("name", path.stem))
    chosen = data.get("seed", SEED) if seed is None else seed
    if type(chosen) is not int:
        raise PlanError(f"{path}: the seed is a whole number")
    return Plan(
        name,
        str(data.get("title", name)),
        str(data.get("question", "")),
        tuple(cells),
        chosen,
        tuple(map(str, data.get("notes", ()))),
    )


def _route(raw: Mapping[str, Any], where: str) -> Route:
    values = {name: tuple(value) if isinstance(value, list) else value for name, value in raw.items()}
    kind = values.pop("kind", "programs")
    if kind not in ("programs", "port"):
        raise PlanError(f"{where}: kind is programs or port, not {kind!r}")
    made: type[Any] = Programs if kind == "programs" else Port
    types = {field.name: field for field in fields(made)}
    _known(values, tuple(types), where)
    if not isinstance(values.get("name"), str):
        raise PlanError(f"{where}: it has no name")
    sample = made("")
    for name, value in values.items():
        of_text = not isinstance(value, tuple) or all(isinstance(item, str) for item in value)
        if type(value) is not type(getattr(sample, name)) or not of_text:
            raise PlanError(f"{where}: {name} = {value!r} is of a wrong kind")
    route: Route = made(**values)
    return route


def _cell(raw: Mapping[str, Any], routes: Mapping[str, Route], samples: int, folder: Path, where: str) -> Cell:
    if "family" not in raw:
        raise PlanError(f"{where}: it has no family")
    for name, kind, words in _KINDS:
        _of_kind(raw, name, kind, words, where)
    named = raw.get("routes", list(routes))
    missing = [name for name in named if name not in routes]
    if missing:
        raise PlanError(f"{where}: there is no route {missing[0]!r}")
    family, parameters = str(raw["family"]), dict(raw.get("parameters", {}))
    shown = {name: str(value) for name, value in parameters.items()}
    if family == "file":
        if not isinstance(parameters.get("path"), str):
            raise PlanError(f"{where}: the family file needs a path")
        family, place = "points", folder / parameters.pop("path")
        parameters["points"] = file_points(str(place))
    if type(samples) is not int or type(raw.get("chunk", 1)) is not int:
        raise PlanError(f"{where}: samples and chunk are whole numbers")
    key = dict(raw.get("key", {"family": str(raw["family"]), **shown}))
    if not all(isinstance(value, str | int) for value in key.values()):
        raise PlanError(f"{where}: the values of its key are text or whole numbers")
    chosen = tuple(routes[name] for name in named)
    extra = {name: raw[name] for name in ("reference", "chunk") if name in raw}
    return Cell(key, family, parameters, chosen, samples, **extra)


def _of_kind(data: Mapping[str, Any], name: str, kind: type, words: str, where: str) -> None:
    if name in data and not isinstance(data[name], kind):
        raise PlanError(f"{where}: {name} is {words}, not {data[name]!r}")


def _known(data: Mapping[str, Any], names: tuple[str, ...], where: str) -> None:
    unknown = [name for name in data if name not in names]
    if unknown:
        raise PlanError(f"{where}: there is no {unknown[0]!r}; there are {', '.join(names)}")
