"""Collect the packages of others that the deposit contains: ``python -m modern.publication.vendored dist/wheels``.

These are the wheels of the run-time dependencies, as pinned with hashes in ``locks/run.lock``, and the part of Pyodide
that the emulator's page uses.  Pip takes the wheels from its cache or a package registry.  If neither has them, they
are left out, and the deposit's README says so.
"""

import re
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from io import BytesIO
from pathlib import Path

from modern.publication.building import DIST, ROOT, run

WHEELS = DIST / "wheels"
PYODIDE = ROOT / "docs" / "console" / "node_modules" / "pyodide"
# The packages of the lock that only the build of the wheel needs.
_BUILD = ("setuptools",)


def locked(root: Path = ROOT) -> dict[str, str]:
    """Return the pinned run-time dependencies: the requirement with its hashes, by ``NAME==VERSION``."""
    blocks = re.split(r"\n(?=\S)", (root / "locks" / "run.lock").read_text(encoding="utf-8").strip())
    pins = {block.split(" ")[0]: block for block in blocks}
    return {pin: block for pin, block in pins.items() if pin.split("==")[0] not in _BUILD}


def download(folder: Path) -> str:
    """Put the wheels into a folder, and return a summary.  Wheels of other versions are removed."""
    folder.mkdir(parents=True, exist_ok=True)
    pins = locked()
    wanted = {_stem(pin) for pin in pins}
    for path in folder.glob("*.whl"):
        if "-".join(path.name.lower().split("-")[:2]) not in wanted:
            path.unlink()
    if len(list(folder.glob("*.whl"))) < len(pins):
        with tempfile.TemporaryDirectory() as room:
            requirements = Path(room) / "run.txt"
            requirements.write_text("\n".join(pins.values()) + "\n", encoding="utf-8")
            command = [sys.executable, "-m", "pip", "download", "--quiet", "--disable-pip-version-check", "--no-deps"]
            command += ["--require-hashes", "--only-binary", ":all:", "--dest", str(folder), "-r", str(requirements)]
            process = subprocess.run(command, capture_output=True, text=True, check=False)
        if process.returncode:
            return f"{folder}: the deposit will be without wheels: {process.stderr.strip().splitlines()[-1:]}"
    return f"{folder}: {', '.join(sorted(path.name for path in folder.glob('*.whl')))}"


def _stem(pin: str) -> str:
    return pin.replace("==", "-").lower()


def files(wheels: Path = WHEELS, pyodide: Path = PYODIDE) -> dict[str, bytes]:
    """Return the files of others by their paths in the deposit: wheels, their licences, and Pyodide."""
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
    """Return a sentence that names the parts that a deposit with these files lacks, or an empty string."""
    pins = [pin for pin in locked() if not any(n.lower().startswith(f"wheels/{_stem(pin)}-") for n in names)]
    missing = [f"the wheels of {', '.join(pins)}"] if pins else []
    missing += [] if any(name.startswith("pyodide/") for name in names) else ["Pyodide"]
    reason = "the machine that packed it had neither a package registry nor a cache with them"
    return f"LEFT OUT of this deposit, because {reason}: {' and '.join(missing)}." if missing else ""


def main(arguments: Sequence[str]) -> int:
    """Collect the wheels in the named folder, by default ``dist/wheels``.  Return 0, or 2 after one line."""
    return run("vendored", lambda: download(Path(arguments[0]) if arguments else WHEELS))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
