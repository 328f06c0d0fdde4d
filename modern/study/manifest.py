"""The manifest of a study: its plan, and the versions and hashes by which a repetition can be compared with it."""

import hashlib
import json
import platform
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from emulator.files import reason
from modern.study.plan import Plan, Programs, StudyFileError
from modern.study.routes import programs_of
from modern.study.store import put

NAME = "manifest.json"
_PACKAGES = ("hull1620", "numpy", "numba")
_REQUIRED = ("plan", "versions", "programs_sha256")


def versions() -> dict[str, str]:
    """Return the versions of Python and of the packages on which a study depends.

    The version of a missing package is "".
    """
    installed = {"python": platform.python_version()}
    for package in _PACKAGES:
        try:
            installed[package] = version(package)
        except PackageNotFoundError:
            installed[package] = ""
    return installed


# The packages whose code can change a row.
_HASHED_PACKAGES = (
    *("emulator", "modern/geometry", "modern/formats", "modern/exact_hull", "modern/port", "modern/thesis"),
    *("modern/comparison", "modern/edition", "modern/study"),
)


def code_sums(plan: Plan) -> dict[str, str]:
    """Return the SHA-256 of hull1620's code and of each module of user-defined families and measures."""
    names = {cell.family for cell in plan.cells}
    names |= {name for cell in plan.cells for route in cell.routes for name in route.measures}
    modules = sorted({name.partition(":")[0] for name in names if ":" in name})
    return {"hull1620": _hull1620_sum()} | {name: _module_sum(name) for name in modules}


@cache
def _hull1620_sum() -> str:
    digest = hashlib.sha256()
    root = Path(__file__).parents[2]
    for package in _HASHED_PACKAGES:
        for path in sorted((root / package).rglob("*")):
            if path.suffix in (".py", ".lark"):
                digest.update(f"{path.relative_to(root).as_posix()}\n".encode() + path.read_bytes())
    return digest.hexdigest()


def _module_sum(name: str) -> str:
    spec = find_spec(name)
    try:
        return hashlib.sha256(Path(spec.origin).read_bytes()).hexdigest() if spec and spec.origin else ""
    except OSError:
        return ""


def plan_sum(document: Mapping[str, object]) -> str:
    """Return the SHA-256 of a plan's JSON data."""
    return hashlib.sha256(json.dumps(document, sort_keys=True).encode("ascii")).hexdigest()


def manifest(plan: Plan, command: Sequence[str], installed: Mapping[str, str]) -> dict[str, Any]:
    """Return the manifest of a new study; ``installed`` is the result of :func:`versions`."""
    programs = {
        route.name: _programs(route) for cell in plan.cells for route in cell.routes if isinstance(route, Programs)
    }
    return {
        "study": plan.name,
        "command": list(command),
        "versions": dict(installed),
        "plan": plan.document(),
        "plan_sha256": plan_sum(plan.document()),
        "programs_sha256": programs,
        "code_sha256": code_sums(plan),
        "samples": plan.samples,
        "complete": False,
    }


def write_manifest(folder: Path, document: Mapping[str, Any]) -> None:
    put(folder / NAME, json.dumps(document, indent=1) + "\n")


def read_manifest(folder: Path) -> dict[str, Any]:
    """Return the manifest of a study's folder.  Raise StudyFileError if it cannot be read."""
    path = folder / NAME
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
        if not isinstance(document, dict) or not all(isinstance(document.get(name), dict) for name in _REQUIRED):
            raise ValueError
    except OSError as error:
        raise StudyFileError(f"{path}: {reason(error)}") from None
    except ValueError:
        raise StudyFileError(f"{path}: expected the manifest of a study") from None
    return document


def first_difference(earlier: Mapping[str, Any], current: Mapping[str, Any]) -> str:
    """Describe the first difference between the manifest in the folder and the current one.

    Return an empty text if the manifests agree.
    """
    plan, current_plan = earlier["plan"], current["plan"]
    if plan.get("name") != current_plan["name"]:
        return f"the folder holds the study {plan.get('name')}, not {current_plan['name']}"
    if plan.get("seed") != current_plan["seed"]:
        return f"its seed is {plan.get('seed')}, not {current_plan['seed']}"
    if earlier.get("samples") != current["samples"]:
        return (
            f"it has {earlier.get('samples')} samples, not {current['samples']}; "
            "repeat the --samples of the command that began it"
        )
    if plan != current_plan:
        return "its plan differs from that of this command"
    for package, installed in current["versions"].items():
        before = earlier["versions"].get(package, "")
        if before != installed:
            return f"it was begun with {package} {before or '(not installed)'}, not {installed or '(not installed)'}"
    if earlier["programs_sha256"] != current["programs_sha256"]:
        return "the listings of the programs or their apparatus have changed since it was begun"
    if "code_sha256" not in earlier:
        return "its manifest does not record with which code it was begun"
    for name, digest in current["code_sha256"].items():
        if earlier["code_sha256"].get(name) != digest:
            return "the code of hull1620 has changed" if name == "hull1620" else f"the module {name} has changed"
    return ""


def _programs(route: Programs) -> dict[str, str]:
    first, load = programs_of(route)
    sums = {}
    for name in (first, "program2", "program3"):
        program = load(name)
        statements = "".join(f"{line.place.card} {line.label} {line.text}\n" for line in program.statements)
        formats = "".join(f"{number} {spec}\n" for number, spec in program.formats)
        sums[name] = hashlib.sha256((statements + formats).encode("ascii")).hexdigest()
    return sums
