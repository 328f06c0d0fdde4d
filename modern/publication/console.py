"""The machine in the page: what the site needs of it beside :mod:`modern.publication.desk`.

The page's files lie in ``docs/console``.  Python for the browser is the npm package ``pyodide``, which
``package-lock.json`` there names with its hash; the project itself goes into the page as its wheel, unpacked, with lark
and mpmath as they are installed where the site is built.  Without the npm package the site has the recorded session
alone.
"""

from __future__ import annotations

import html
import json
import shutil
import zipfile
from collections.abc import Iterator, Mapping
from importlib.metadata import distribution
from io import BytesIO
from pathlib import Path

from modern.publication.desk import Desk

PYODIDE = ("pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm", "python_stdlib.zip", "pyodide-lock.json")
"""What of the npm package the page loads."""
OURS = ("console.js", "console.css", "worker.mjs")
_NEEDS = ("lark", "mpmath")
_LEFT_OUT = ("/tests/", "/__pyinstaller/", "__pycache__")
_EPOCH = (1980, 1, 1, 0, 0, 0)


def fragment(source: Path, period: Path, folder: str, size: int) -> str:
    """The page's HTML: controls, the recorded session, and the programs of ``period``.

    ``source`` is ``docs/console``, ``folder`` where :func:`lay` has laid its files, as the page sees it; ``size`` what
    it gave, 0 where the machine is not in the site.
    """
    says = (
        f"It loads Python and this project into the page, {size / 1e6:.1f} MB; nothing leaves your computer."
        if size
        else "This site was built without the machine (npm ci --prefix docs/console, and build again)."
    )
    filled = {
        "__SAYS__": html.escape(says),
        "__BYTES__": str(size),
        "__RECORDED__": html.escape(recorded()),
        "__PERIOD__": json.dumps(_period(period), sort_keys=True).replace("<", "\\u003c"),
        "__FOLDER__": html.escape(folder),
    }
    page = (source / "console.html").read_text(encoding="utf-8")
    for mark, text in filled.items():
        page = page.replace(mark, text)
    return page if size else page.replace(f'<script src="{folder}/console.js" defer></script>\n', "")


def recorded() -> str:
    """The log of example 4: program 1 in the state of the examples, and program 2 with the cards it punched."""
    desk = Desk(clock=lambda: 0.0)
    for program, deck in (("program1_examples", "example4"), ("program2", "stacker")):
        desk.load({"program": program, "deck": deck})
        desk.run(1e9)
        desk.act("START")
        while not desk.run(1e9)["ended"]:
            pass
    return desk.log()


def lay(source: Path, wheel: Path, folder: Path) -> int:
    """Lay everything the page loads into ``folder``; returns its size in bytes, 0 where npm's package is not there."""
    npm = source / "node_modules" / "pyodide"
    folder.mkdir(parents=True, exist_ok=True)
    for name in OURS:
        shutil.copyfile(source / name, folder / name)
    if not npm.is_dir():
        return 0
    (folder / "pyodide").mkdir(exist_ok=True)
    for name in PYODIDE:
        shutil.copyfile(npm / name, folder / "pyodide" / name)
    (folder / "packages.zip").write_bytes(packages(wheel))
    loaded = [folder / "pyodide" / name for name in PYODIDE] + [folder / "packages.zip", folder / "worker.mjs"]
    return sum(path.stat().st_size for path in loaded)


def packages(wheel: Path) -> bytes:
    """The wheel, lark and mpmath in one archive, the same bytes for the same files."""
    found: dict[str, bytes] = {}
    with zipfile.ZipFile(wheel) as archive:
        found |= {name: archive.read(name) for name in archive.namelist() if not name.endswith("/")}
    for package in _NEEDS:
        found |= dict(_installed(package))
    held = BytesIO()
    with zipfile.ZipFile(held, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, data in sorted(found.items()):
            archive.writestr(zipfile.ZipInfo(name, _EPOCH), data, zipfile.ZIP_DEFLATED)
    return held.getvalue()


def _installed(package: str) -> Iterator[tuple[str, bytes]]:
    """The files of an installed package that a program imports, and its licence."""
    for file in distribution(package).files or ():
        name = file.as_posix()
        if name.startswith("..") or any(part in f"/{name}" for part in _LEFT_OUT):
            continue
        if file.suffix in (".py", ".lark") or "license" in name.lower():
            yield name, Path(str(file.locate())).read_bytes()


def _period(folder: Path) -> Mapping[str, str]:
    """The programs of the time and their decks, by name."""
    return {
        path.name: path.read_text(encoding="ascii")
        for path in sorted(folder.glob("*.*"))
        if path.suffix in (".f", ".deck")
    }
