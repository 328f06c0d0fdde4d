"""Read a plan from a TOML file, which describes a study without Python code.

::

    name = "mine"
    title = "What three digits do"
    question = "How often do the programs refuse them?"
    samples = 200                    # the default for each cell

    [[route]]
    name = "as listed"               # kind = "programs" is the default

    [[route]]
    name = "float64"
    kind = "port"
    arithmetic = "float64"

    [[cell]]
    family = "integers"
    parameters = { digits = 3, n = [4, 20] }

    [[cell]]
    family = "file"                  # the points of a deck, CSV or OFF file next to the plan
    parameters = { path = "mine.csv", shuffle = true }

A cell uses all routes unless it lists some (``routes = ["float64"]``).  The default key of a cell is its family and
parameters.  ``family = "mine:points"`` is the function ``points`` of ``mine.py`` next to the plan or on
Python's module path; ``measures = ["mine:spread"]`` works the same way.
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
_TYPES: tuple[tuple[str, type, str], ...] = (
    ("key", dict, "{ name = value }"),
    ("family", str, "text"),
    ("parameters", dict, "{ name = value }"),
    ("routes", list, "a list of names"),
    ("reference", str, "a route's name"),
)


def is_plan_file(name: str) -> bool:
    """Return True if the name of a study on the command line is the name of a file."""
    return name.endswith(".toml")


def read_plan(path: str, samples: int | None = None, seed: int | None = None) -> Plan:
    """Read the plan of a file; ``samples`` and ``seed`` override those of the file.  Raise FileError or PlanError."""
    text = read_text(path)
    try:
        data = tomllib.loads(text)
    except RecursionError:
        raise PlanError(f"{path}: nested too deeply") from None
    except tomllib.TOMLDecodeError as error:
        raise PlanError(f"{path}: {str(error).splitlines()[0]}") from None
    _add_to_module_path(data, Path(path).resolve().parent)
    try:
        return _plan(data, Path(path), samples, seed)
    except (TypeError, AttributeError) as error:
        raise PlanError(f"{path}: a value has the wrong type: {error}") from None


def _add_to_module_path(data: Mapping[str, Any], folder: Path) -> None:
    """Add the folder of the plan to the module path if it contains the module of a user-defined family or measure."""
    sections = [section for name in ("cell", "route") for section in _list(data.get(name)) if isinstance(section, dict)]
    names = [name for section in sections for name in (section.get("family"), *_list(section.get("measures")))]
    modules = {name.partition(":")[0] for name in names if isinstance(name, str) and ":" in name}
    if any((folder / f"{module.partition('.')[0]}.py").exists() for module in modules) and str(folder) not in sys.path:
        sys.path.append(str(folder))


def _list(value: Any) -> list[Any]:
    return value if isinstance(value, list) else []


def _plan(data: Mapping[str, Any], path: Path, samples: int | None, seed: int | None) -> Plan:
    _check_names(data, _HEAD, f"{path}")
    for name, expected in (("notes", "a list"), ("route", "[[route]]"), ("cell", "[[cell]]")):
        _check_type(data, name, list, expected, f"{path}")
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
        _check_names(raw, _CELL, where)
        size = samples or raw.get("samples", data.get("samples", _SAMPLES))
        cells.append(_cell(raw, routes, size, path.parent, where))
    name = str(data.get("name", path.stem))
    plan_seed = data.get("seed", SEED) if seed is None else seed
    if type(plan_seed) is not int:
        raise PlanError(f"{path}: the seed must be an integer")
    return Plan(
        name,
        str(data.get("title", name)),
        str(data.get("question", "")),
        tuple(cells),
        plan_seed,
        tuple(map(str, data.get("notes", ()))),
    )


def _route(raw: Mapping[str, Any], where: str) -> Route:
    values = {name: tuple(value) if isinstance(value, list) else value for name, value in raw.items()}
    kind = values.pop("kind", "programs")
    if kind not in ("programs", "port"):
        raise PlanError(f"{where}: expected kind programs or port, found {kind!r}")
    route_type: type[Any] = Programs if kind == "programs" else Port
    _check_names(values, tuple(field.name for field in fields(route_type)), where)
    if not isinstance(values.get("name"), str):
        raise PlanError(f"{where}: it has no name")
    default = route_type("")
    for name, value in values.items():
        has_only_text = not isinstance(value, tuple) or all(isinstance(element, str) for element in value)
        types = (str, int, float) if name == "epsilon" else (type(getattr(default, name)),)
        if type(value) not in types or not has_only_text:
            raise PlanError(f"{where}: {name} = {value!r} has the wrong type")
    route: Route = route_type(**values)
    return route


def _cell(raw: Mapping[str, Any], routes: Mapping[str, Route], samples: int, folder: Path, where: str) -> Cell:
    if "family" not in raw:
        raise PlanError(f"{where}: it has no family")
    for name, kind, expected in _TYPES:
        _check_type(raw, name, kind, expected, where)
    route_names = raw.get("routes", list(routes))
    missing = [name for name in route_names if name not in routes]
    if missing:
        raise PlanError(f"{where}: there is no route {missing[0]!r}")
    family, parameters = str(raw["family"]), dict(raw.get("parameters", {}))
    default_key = {"family": family, **{name: str(value) for name, value in parameters.items()}}
    if family == "file":
        if not isinstance(parameters.get("path"), str):
            raise PlanError(f"{where}: the family file needs a path")
        family, path = "points", folder / parameters.pop("path")
        parameters["points"] = file_points(str(path))
    if type(samples) is not int or type(raw.get("chunk", 1)) is not int:
        raise PlanError(f"{where}: samples and chunk must be integers")
    key = dict(raw.get("key", default_key))
    if not all(isinstance(value, str | int) for value in key.values()):
        raise PlanError(f"{where}: the values of its key must be text or integers")
    cell_routes = tuple(routes[name] for name in route_names)
    optional = {name: raw[name] for name in ("reference", "chunk") if name in raw}
    return Cell(key, family, parameters, cell_routes, samples, **optional)


def _check_type(data: Mapping[str, Any], name: str, kind: type, expected: str, where: str) -> None:
    if name in data and not isinstance(data[name], kind):
        raise PlanError(f"{where}: expected {name} to be {expected}, found {data[name]!r}")


def _check_names(data: Mapping[str, Any], names: tuple[str, ...], where: str) -> None:
    unknown = [name for name in data if name not in names]
    if unknown:
        raise PlanError(f"{where}: unknown name {unknown[0]!r}; expected {', '.join(names)}")
