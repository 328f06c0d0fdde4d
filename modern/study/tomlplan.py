"""Read a plan from a TOML file, which describes a study without Python code.

docs/how-to/own-study.md describes every key.  A cell uses all routes of the plan unless its key ``routes`` lists some.
The default key of a cell consists of its family and parameters.  ``family = "mine:points"`` names the function
``points`` of ``mine.py`` next to the plan or on Python's module path.  ``measures = ["mine:spread"]`` names a measure
in the same way.
"""

import re
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from emulator.errors import EmulatorError, quoted
from emulator.files import parse_toml, read_text
from modern.study.builtin import names as built_in_names
from modern.study.families import FAMILIES, check_keywords, family_of
from modern.study.families.given import file_points
from modern.study.plan import CHUNK, SEED, Cell, Plan, PlanError, Port, Programs, Route
from modern.study.run import check_cell, check_route

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
_EXPECTED = {str: "text", int: "an integer", bool: "true or false", tuple: "a list of texts"}
# Strings and comments of TOML, which may contain anything.
_MASKED = re.compile(
    r'"""(?:\\.|[^\\])*?"{3,5}|' r"'''.*?'{3,5}|" r'"(?:\\.|[^"\\\n])*"|' r"'[^'\n]*'|#[^\n]*", re.DOTALL
)
_HEADER = re.compile(r"\s*(\[\[?)\s*([\w.-]+)")


@dataclass(frozen=True, slots=True)
class _Section:
    """A section of a plan file: a ``[[route]]`` or ``[[cell]]``, or the keys before all sections.

    path: the file.  text: its whole text.  name, number: ``route`` or ``cell``, and the number of the section, from 1.
    """

    path: str
    text: str
    name: str = ""
    number: int = 0

    def error(self, message: str, key: str = "") -> PlanError:
        """Return an error that names the file, the section, and the line of the key or, without one, of the section."""
        section = f"{self.name} {self.number}: " if self.name else ""
        return PlanError(f"{self._place(key)}: {section}{message}")

    @contextmanager
    def locating(self, key: str = "") -> Iterator[None]:
        """Turn an error in the ``with`` block into a PlanError that names the file and the line."""
        try:
            yield
        except EmulatorError as error:
            raise PlanError(f"{self._place(key)}: {error}") from error

    def _place(self, key: str) -> str:
        """Return the file and the line of the key in this section.

        If the key has no line, return the line of the section.
        """
        sections, header_line = {"": 0}, 0
        current = ("", 0)
        for line_number, line in enumerate(_masked(self.text).split("\n"), 1):
            header = _HEADER.match(line)
            table, _, subtable = header[2].partition(".") if header else ("", "", "")
            if header and not subtable:
                sections[table] = sections.get(table, 0) + 1
                current = (table, sections[table])
            if current != (self.name, self.number):
                continue
            if key and (subtable == key or re.match(rf"\s*{re.escape(key)}\s*[.=]", line)):
                return f"{self.path}: line {line_number}"
            header_line = header_line or line_number * bool(header)
        return f"{self.path}: line {header_line}" if header_line else self.path

    def integer(self, data: Mapping[str, Any], key: str, default: int, least: int | None = None) -> int:
        value = data.get(key, default)
        if type(value) is not int or (least is not None and value < least):
            size = "" if least is None else f" of at least {least}"
            raise self.error(f"{key}: expected an integer{size}, found {quoted(value)}", key)
        return value

    def check_type(self, data: Mapping[str, Any], key: str, kind: type, expected: str) -> None:
        if key in data and not isinstance(data[key], kind):
            raise self.error(f"expected {key} to be {expected}, found {quoted(data[key])}", key)

    def check_keys(self, data: Mapping[str, Any], keys: tuple[str, ...]) -> None:
        for key in data:
            if key not in keys:
                raise self.error(f"unknown name {quoted(key)}; expected {', '.join(keys)}", key)


def _masked(text: str) -> str:
    """Return the text of a TOML file with the characters of strings and comments replaced by spaces."""
    return _MASKED.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def read_plan(path: str, samples: int | None = None, seed: int | None = None) -> Plan:
    """Read and check the plan of a file. Raise FileError or PlanError, with the line of the fault."""
    text = read_text(path)
    # TOML requires a digit before the point.  An epsilon is also accepted as the thesis writes it, .001.
    for match in reversed(list(re.finditer(r"(?m)^\s*epsilon\s*=\s*[+-]?(?=\.\d)", _masked(text)))):
        text = f"{text[: match.end()]}0{text[match.end() :]}"
    try:
        data = parse_toml(text)
    except ValueError as error:
        raise PlanError(f"{path}: {error}") from None
    _add_to_module_path(data, Path(path).resolve().parent)
    try:
        return _plan(data, path, text, samples, seed)
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


def _plan(data: Mapping[str, Any], path: str, text: str, samples: int | None, seed: int | None) -> Plan:
    head = _Section(path, text)
    head.check_keys(data, _HEAD)
    for key, expected in (("notes", "a list"), ("route", "[[route]]"), ("cell", "[[cell]]")):
        head.check_type(data, key, list, expected)
    name = str(data.get("name", Path(path).stem))
    if name in built_in_names():
        raise head.error(f"{quoted(name)} is the name of a built-in study; choose another name", "name")
    default_samples = head.integer(data, "samples", _SAMPLES, 1)
    plan_seed = head.integer(data, "seed", SEED)
    routes: dict[str, Route] = {}
    for number, raw in enumerate(data.get("route", ()), 1):
        section = _Section(path, text, "route", number)
        route = _route(raw, section)
        if route.name in routes:
            raise section.error(f"two routes have the name {quoted(route.name)}", "name")
        routes[route.name] = route
    if not routes:
        raise PlanError(f"{path}: expected at least one section [[route]], found none")
    cells = []
    for number, raw in enumerate(data.get("cell", ()), 1):
        section = _Section(path, text, "cell", number)
        section.check_keys(raw, _CELL)
        cell_samples = section.integer(raw, "samples", default_samples, 1)
        cell = _cell(raw, routes, samples or cell_samples, section)
        with section.locating():
            check_cell(cell, plan_seed if seed is None else seed)
        cells.append(cell)
    return Plan(
        name,
        str(data.get("title", name)),
        str(data.get("question", "")),
        tuple(cells),
        plan_seed if seed is None else seed,
        tuple(map(str, data.get("notes", ()))),
    )


def _route(raw: Mapping[str, Any], section: _Section) -> Route:
    values = {name: tuple(value) if isinstance(value, list) else value for name, value in raw.items()}
    kind = values.pop("kind", "programs")
    if kind not in ("programs", "port"):
        raise section.error(f"expected kind programs or port, found {quoted(kind)}", "kind")
    route_type: type[Any] = Programs if kind == "programs" else Port
    section.check_keys(values, tuple(field.name for field in fields(route_type)))
    if not isinstance(values.get("name"), str):
        raise section.error("the key 'name' is missing")
    epsilon = values.get("epsilon")
    if type(epsilon) in (int, float, str):
        values["epsilon"] = f"0{epsilon}" if str(epsilon).startswith(".") else str(epsilon)
    default = route_type("")
    for name, value in values.items():
        has_only_text = not isinstance(value, tuple) or all(isinstance(element, str) for element in value)
        if type(value) is not type(getattr(default, name)) or not has_only_text:
            expected = _EXPECTED[type(getattr(default, name))]
            raise section.error(f"{name}: expected {expected}, found {quoted(raw[name])}", name)
    route: Route = route_type(**values)
    with section.locating():
        check_route(route)
    return route


def _cell(raw: Mapping[str, Any], routes: Mapping[str, Route], samples: int, section: _Section) -> Cell:
    if "family" not in raw:
        raise section.error("the key 'family' is missing")
    for name, kind, expected in _TYPES:
        section.check_type(raw, name, kind, expected)
    route_names = raw.get("routes", list(routes))
    missing = [name for name in route_names if name not in routes]
    if missing:
        raise section.error(f"there is no route {quoted(missing[0])}; the routes are {', '.join(routes)}", "routes")
    family, parameters = str(raw["family"]), dict(raw.get("parameters", {}))
    default_key = {"family": family, **{name: str(value) for name, value in parameters.items()}}
    if family == "file":
        if not isinstance(parameters.get("path"), str):
            raise section.error("the family 'file' needs the parameter 'path'", "parameters")
        family, path = "points", Path(section.path).parent / parameters.pop("path")
        with section.locating("parameters"):
            parameters["points"] = file_points(str(path))
    if ":" not in family and family not in FAMILIES:
        choices = ", ".join((*FAMILIES, "file"))
        raise section.error(f"no family is called {quoted(family)}; expected {choices} or module:function", "family")
    with section.locating("family"):
        family_of(family)
    with section.locating("parameters"):
        check_keywords(family, parameters)
    optional = {"chunk": section.integer(raw, "chunk", CHUNK, 1), "reference": raw.get("reference", "")}
    key = dict(raw.get("key", default_key))
    if not all(isinstance(value, str | int) for value in key.values()):
        raise section.error("the values in the table key must be text or integers", "key")
    return Cell(key, family, parameters, tuple(routes[name] for name in route_names), samples, **optional)
