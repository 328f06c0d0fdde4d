"""The manifest: what a study is, with what it was made, and the sums that prove a repetition equal."""

from __future__ import annotations

import hashlib
import json
import platform
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from modern.study.plan import Plan, Programs, StudyFileError
from modern.study.routes import programs_of
from modern.study.store import put

NAME = "manifest.json"
_PACKAGES = ("hull1620", "numpy", "numba")
_PARTS = ("plan", "versions", "programs_sha256")
_ROLES = ("program2", "program3")


def versions() -> dict[str, str]:
    """The versions a study is made with; an empty text for a package that is not there."""
    found = {"python": platform.python_version()}
    for package in _PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = ""
    return found


_ROOMS = (
    *("emulator", "modern/geometry", "modern/formats", "modern/exact_hull", "modern/port", "modern/thesis"),
    *("modern/comparison", "modern/edition", "modern/study"),
)
"""What can change a row."""


def code_sums(plan: Plan) -> dict[str, str]:
    """SHA-256 of the code rows come from: hull1620's, and each module a family or measure of one's own is in."""
    own = {cell.family for cell in plan.cells}
    own |= {name for cell in plan.cells for route in cell.routes for name in route.measures}
    modules = sorted({name.partition(":")[0] for name in own if ":" in name})
    return {"hull1620": _own_sum()} | {name: _module_sum(name) for name in modules}


@cache
def _own_sum() -> str:
    digest = hashlib.sha256()
    root = Path(__file__).parents[2]
    for room in _ROOMS:
        for path in sorted((root / room).rglob("*")):
            if path.suffix in (".py", ".lark"):
                digest.update(f"{path.relative_to(root).as_posix()}\n".encode() + path.read_bytes())
    return digest.hexdigest()


def _module_sum(name: str) -> str:
    """The sum of a module's file; empty where it has none that can be read."""
    found = find_spec(name)
    try:
        return hashlib.sha256(Path(found.origin).read_bytes()).hexdigest() if found and found.origin else ""
    except OSError:
        return ""


def manifest(plan: Plan, command: Sequence[str], made: Mapping[str, str]) -> dict[str, Any]:
    """The manifest of a study that begins."""
    programs = {
        route.name: _programs(route) for cell in plan.cells for route in cell.routes if isinstance(route, Programs)
    }
    return {
        "study": plan.name,
        "command": list(command),
        "versions": dict(made),
        "plan": plan.document(),
        "programs_sha256": programs,
        "code_sha256": code_sums(plan),
        "samples": plan.samples,
        "complete": False,
    }


def write_manifest(folder: Path, document: Mapping[str, Any]) -> None:
    """Raises StudyFileError."""
    put(folder / NAME, json.dumps(document, indent=1) + "\n")


def read_manifest(folder: Path) -> dict[str, Any]:
    """Raises StudyFileError where there is none that can be read."""
    path = folder / NAME
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        if not isinstance(found, dict) or not all(isinstance(found.get(name), dict) for name in _PARTS):
            raise ValueError
    except OSError as error:
        raise StudyFileError(f"{path}: {(error.strerror or str(error)).lower()}") from None
    except ValueError:
        raise StudyFileError(f"{path}: not a manifest of a study") from None
    return found


def differences(there: Mapping[str, Any], here: Mapping[str, Any]) -> str:
    """The first thing in which a study begun differs from the one to be resumed; empty where nothing does."""
    was, now = there["plan"], here["plan"]
    if was.get("name") != now["name"]:
        return f"it is of the study {was.get('name')}, not {now['name']}"
    if was.get("seed") != now["seed"]:
        return f"its seed is {was.get('seed')}, not {now['seed']}"
    if there.get("samples") != here["samples"]:
        return f"it has {there.get('samples')} samples, not {here['samples']}; give the --samples it was begun with"
    if was != now:
        return "its plan is another"
    for package, wanted in here["versions"].items():
        other = there["versions"].get(package, "")
        if other != wanted:
            return f"it was begun with {package} {other or '(not installed)'}, not {wanted or '(not installed)'}"
    if there["programs_sha256"] != here["programs_sha256"]:
        return "its programs are others: the listings or their apparatus have changed"
    if "code_sha256" not in there:
        return "it does not say with what code it was begun"
    for name, wanted in here["code_sha256"].items():
        if there["code_sha256"].get(name) != wanted:
            return "hull1620's own code has changed" if name == "hull1620" else f"the module {name} has changed"
    return ""


def _programs(route: Programs) -> dict[str, str]:
    """SHA-256 of the statements of each program of a route, card by card."""
    first, load = programs_of(route)
    sums = {}
    for name in (first, *_ROLES):
        program = load(name)
        words = "".join(f"{line.place.card} {line.label} {line.text}\n" for line in program.statements)
        formats = "".join(f"{number} {spec}\n" for number, spec in program.formats)
        sums[name] = hashlib.sha256((words + formats).encode("ascii")).hexdigest()
    return sums
