"""Collect the third-party packages of the deposit: ``python -m modern.publication.vendored dist/wheels``.

The deposit contains the wheels of the run-time dependencies and of the packages that build the wheel, the site and the
book, at the versions that ``locks`` pins with hashes.  It also contains the part of Pyodide that the emulator's page
loads.  A binary wheel fits only the platform of the machine that collects it.  Pip takes the wheels from its cache or
from a package registry.  If neither of them has a wheel, the deposit lacks this wheel, and the deposit's README names
it.
"""

import re
import subprocess
import sys
import tempfile
import tomllib
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from importlib.metadata import PackageNotFoundError, requires
from io import BytesIO
from pathlib import Path

from packaging.requirements import Requirement  # packaging is a dependency of Sphinx
from packaging.utils import canonicalize_name, parse_wheel_filename
from packaging.version import Version

from modern.publication.building import DIST, ROOT, BuildError, run

WHEELS = DIST / "wheels"
PYODIDE = ROOT / "docs" / "console" / "node_modules" / "pyodide"
# The packages in run.lock that only the build of the wheel needs.
_BUILD = ("setuptools",)
# The packages of the extra ``edition`` that are published without a wheel.  Only the packing of the deposit needs them.
SOURCE_ONLY = ("bagit",)


def locked() -> dict[str, str]:
    """Return the pinned run-time dependencies: the requirement with its hashes, by ``NAME==VERSION``."""
    return {pin: block for pin, block in pins("run").items() if pin.split("==")[0] not in _BUILD}


def collected() -> dict[str, str]:
    """Return the pins of all packages whose wheels the deposit should contain, as :func:`locked` does.

    The packages are the run-time dependencies, the build tools of the wheel, the extra ``edition``, and their
    dependencies.
    """
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    extra = project["project"]["optional-dependencies"]["edition"]
    names = _with_dependencies((*extra, *project["build-system"]["requires"], "build")) - set(SOURCE_ONLY)
    return locked() | {pin: block for pin, block in pins("dev").items() if pin.split("==")[0] in names}


def pins(lock: str) -> dict[str, str]:
    """Return the requirements in the file ``locks/LOCK.lock``, with their hashes, by ``NAME==VERSION``."""
    blocks = re.split(r"\n(?=\S)", (ROOT / "locks" / f"{lock}.lock").read_text(encoding="utf-8").strip())
    return {block.split(" ")[0]: block for block in blocks}


def _with_dependencies(roots: Sequence[str]) -> set[str]:
    queue, visited = [Requirement(line) for line in roots], set[tuple[str, frozenset[str]]]()
    while queue:
        requirement = queue.pop()
        name, extras = canonicalize_name(requirement.name), frozenset(requirement.extras)
        if (name, extras) in visited:
            continue
        visited.add((name, extras))
        try:
            dependencies = [Requirement(line) for line in requires(name) or ()]
        except PackageNotFoundError:
            raise BuildError(f"{name} is missing: pip install 'hull1620[edition]' build") from None
        queue += (
            d for d in dependencies if not d.marker or any(d.marker.evaluate({"extra": e}) for e in extras or ("",))
        )
    return {name for name, _ in visited}


def download(folder: Path) -> str:
    """Download the missing wheels into a folder, remove wheels of other versions, and return a summary."""
    folder.mkdir(parents=True, exist_ok=True)
    wanted = {_of_pin(pin): block for pin, block in collected().items()}
    for path in folder.glob("*.whl"):
        # The block of a wheel that is present need not be downloaded.
        if wanted.pop(parse_wheel_filename(path.name)[:2], None) is None:
            path.unlink()
    if wanted:
        with tempfile.TemporaryDirectory() as room:
            requirements = Path(room) / "run.txt"
            requirements.write_text("\n".join(wanted.values()) + "\n", encoding="utf-8")
            command = [sys.executable, "-m", "pip", "download", "--quiet", "--disable-pip-version-check", "--no-deps"]
            command += ["--require-hashes", "--only-binary", ":all:", "--dest", str(folder), "-r", str(requirements)]
            process = subprocess.run(command, capture_output=True, text=True, check=False)
        if process.returncode:
            reason = process.stderr.strip().rpartition("\n")[2]
            return f"{folder}: the deposit will lack {len(wanted)} wheels, because pip failed: {reason}"
    sizes = [path.stat().st_size for path in folder.glob("*.whl")]
    return f"{folder}: {len(sizes)} wheels, {sum(sizes) / 1e6:.1f} MB"


def _of_pin(pin: str) -> tuple[str, Version]:
    """Return the normalised name and the version of a pin, ``NAME==VERSION`` or ``NAME[EXTRA]==VERSION``."""
    requirement = Requirement(pin)
    return canonicalize_name(requirement.name), Version(str(requirement.specifier).removeprefix("=="))


def files(wheels: Path = WHEELS, pyodide: Path = PYODIDE) -> dict[str, bytes]:
    """Return the third-party files by their paths in the deposit: wheels, their licences, and Pyodide."""
    result: dict[str, bytes] = {}
    for path in sorted(wheels.glob("*.whl")):
        data = path.read_bytes()
        result[f"wheels/{path.name}"] = data
        result |= {f"wheels/licences/{name}": text for name, text in _licences(data)}
    for path in sorted(pyodide.rglob("*")) if (pyodide / "package.json").is_file() else ():
        if path.is_file() and path.suffix not in (".map", ".d.ts"):
            result[f"pyodide/{path.relative_to(pyodide).as_posix()}"] = path.read_bytes()
    return result


def _licences(wheel: bytes) -> Iterator[tuple[str, bytes]]:
    with zipfile.ZipFile(BytesIO(wheel)) as archive:
        for name in archive.namelist():
            folder, _, rest = name.partition(".dist-info/")
            if rest and re.search(r"licen[cs]e|copying|notice|METADATA$", rest, re.IGNORECASE) and name[-1] != "/":
                yield f"{folder}/{rest.replace('/', '-')}", archive.read(name)


def left_out(names: Mapping[str, bytes]) -> str:
    """Return a sentence that names the wheels and other parts that a deposit lacks, or an empty string.

    ``names`` has the paths of the files in the deposit as keys.
    """
    wheels = [name.removeprefix("wheels/") for name in names if re.fullmatch(r"wheels/[^/]+\.whl", name)]
    present = {parse_wheel_filename(name)[:2] for name in wheels}
    packages = [pin for pin in collected() if _of_pin(pin) not in present]
    missing = [f"the wheels of {', '.join(packages)}"] if packages else []
    missing += [] if any(name.startswith("pyodide/") for name in names) else ["Pyodide"]
    reason = "the machine that packed it had neither a package registry nor a cache with them"
    return f"LEFT OUT of this deposit, because {reason}: {' and '.join(missing)}." if missing else ""


def main(arguments: Sequence[str]) -> int:
    """Collect the wheels in the named folder, by default ``dist/wheels``.  Return exit code 0, or 2 after an error."""
    return run("vendored", lambda: download(Path(arguments[0]) if arguments else WHEELS))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
