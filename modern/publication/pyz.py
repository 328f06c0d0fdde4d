"""Build the program as one file, ``hull1620.pyz``: ``python -m modern.publication.pyz dist``.

The file contains the wheel, lark and mpmath, and needs only Python.  A command that needs numpy reports that numpy is
missing.  The emulator in the browser loads the same packages.
"""

import sys
import zipfile
from collections.abc import Iterator, Sequence
from importlib.metadata import distribution
from pathlib import Path

from modern.publication.building import DIST, BuildError, newest_wheel, run, zipped

NAME = "hull1620.pyz"
_PACKAGES = ("lark", "mpmath")
_LEFT_OUT = ("/tests/", "/__pyinstaller/", "__pycache__")
# Python compiles only this file before it checks the version, so every Python 3 must be able to read it.
_MAIN = """import sys

if sys.version_info < (3, 11):
    sys.exit("hull1620.pyz: expected Python 3.11 or later, found " + sys.version.split()[0])

from hull1620.__main__ import main

if __name__ == "__main__":
    sys.exit(main())
"""


def pyz(wheel: Path) -> bytes:
    """Return the program as one executable archive.  The same wheel and packages always give the same bytes."""
    return zipped({**files_of(wheel), "__main__.py": _MAIN.encode()}, prefix=b"#!/usr/bin/env python3\n")


def files_of(wheel: Path) -> dict[str, bytes]:
    """Return the files of the wheel, lark and mpmath by name."""
    with zipfile.ZipFile(wheel) as archive:
        files = {name: archive.read(name) for name in archive.namelist() if not name.endswith("/")}
    for package in _PACKAGES:
        files |= dict(_installed(package))
    return files


def _installed(package: str) -> Iterator[tuple[str, bytes]]:
    for file in distribution(package).files or ():
        name = file.as_posix()
        if name.startswith("..") or any(part in f"/{name}" for part in _LEFT_OUT):
            continue
        if file.suffix in (".py", ".lark") or "license" in name.lower():
            yield name, Path(str(file.locate())).read_bytes()


def main(arguments: Sequence[str]) -> int:
    """Build the file in the named folder, by default ``dist``. Return the exit code: 0, or 2 after an error message."""
    out = Path(arguments[0]) if arguments else DIST

    def build() -> str:
        wheel = newest_wheel()
        if wheel is None:
            raise BuildError(f"{DIST}: no wheel; make wheel builds it")
        data = pyz(wheel)
        out.mkdir(parents=True, exist_ok=True)
        (out / NAME).write_bytes(data)
        (out / NAME).chmod(0o755)
        return f"{out / NAME}: {len(data) / 1e6:.1f} MB"

    return run("pyz", build)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
