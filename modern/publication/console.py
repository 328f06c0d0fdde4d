"""The machine in the page: what its two pages hold when they are made, and what is laid beside them to be loaded.

The pages' HTML and their worker lie in ``docs/console``, their scripts in ``docs/_static``.  Python for the browser is
the npm package ``pyodide``, which ``package-lock.json`` there names with its hash; the project itself goes into the
page as its wheel, unpacked, with lark and mpmath as they are installed where the site is built.  Without the npm
package, or without a wheel, the site has recorded answers alone, and says so.
"""

from __future__ import annotations

import gzip
import html
import json
import shutil
import zipfile
from collections.abc import Iterator, Mapping
from importlib.metadata import distribution
from io import BytesIO
from pathlib import Path

from modern.edition.chapter6 import input_deck
from modern.edition.sources import read
from modern.formats.points import parse_bytes
from modern.publication.desk import Desk
from modern.publication.parting import parted

ROOT = Path(__file__).parents[2]
SOURCE = ROOT / "docs" / "console"
PERIOD = ROOT / "tests" / "data" / "period"
PYODIDE = ("pyodide.mjs", "pyodide.asm.mjs", "python_stdlib.zip", "pyodide-lock.json")
"""What of the npm package a page loads as it is."""
PACKED = "pyodide.asm.wasm"
"""What it loads compressed: servers do not compress it by themselves, and it is two thirds of all."""
_NEEDS = ("lark", "mpmath")
_LEFT_OUT = ("/tests/", "/__pyinstaller/", "__pycache__")
_EPOCH = (1980, 1, 1, 0, 0, 0)


def console_page() -> str:
    """The console's HTML: its controls, a recorded session, and programs in the manner of the time."""
    return _filled("console.html", RECORDED=html.escape(recorded()), PERIOD=_json(_period()))


def parting_page() -> str:
    """The HTML of the page where 1963 and exact numbers part: point sets by name, and the answer to the first."""
    sets = point_sets()
    first = next(iter(sets.values()))
    return _filled("parting.html", POINTS=html.escape(first), SETS=_json(sets), FIRST=_json(parted(first)))


def point_sets() -> dict[str, str]:
    """Sets to begin with, a point a line."""
    thirds = "\n".join(f"{x} {y} 0" for x, y in ((0, 0), (90, 10), (100, 60), (40, 90), (-30, 60), (30, 40), (50, 35)))
    decks = {
        "four points of five digits: three vertices lost": read("transcripts/counterexamples/silent.deck"),
        "example 6 of the thesis": input_deck(6).text(),
        "example 5 of the thesis": input_deck(5).text(),
        "a pyramid over four points": read("fortran_src/grounds/pyramid5.deck"),
    }
    found = {name: "\n".join(" ".join(p) for p in parse_bytes(t.encode(), name).points) for name, t in decks.items()}
    return found | {"seven points in a plane, to be dragged": thirds, "a triangle and its middle, in thirds": _THIRDS}


_THIRDS = "0 0 0\n1 0 0\n0 1 0\n.33333333 .33333333 0\n.5 .5 0"


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


def lay(folder: Path, wheel: Path | None, source: Path = SOURCE) -> int:
    """Lay everything the pages load into ``folder``; returns its size in bytes, 0 where there is no machine to lay."""
    folder.mkdir(parents=True, exist_ok=True)
    npm, size = source / "node_modules" / "pyodide", 0
    if npm.is_dir() and wheel is not None:
        (folder / "pyodide").mkdir(exist_ok=True)
        for name in PYODIDE:
            shutil.copyfile(npm / name, folder / "pyodide" / name)
        packed = folder / "pyodide" / f"{PACKED}.gzip"
        packed.write_bytes(gzip.compress((npm / PACKED).read_bytes(), mtime=0))
        shutil.copyfile(source / "worker.mjs", folder / "worker.mjs")
        (folder / "packages.zip").write_bytes(packages(wheel))
        # The worker itself and pyodide.mjs are modules, whose loading nobody can count.
        fetched = [folder / "pyodide" / name for name in PYODIDE if name != "pyodide.mjs"]
        counted = [*fetched, packed, folder / "packages.zip"]
        size = sum(path.stat().st_size for path in counted)
    (folder / "size.js").write_text(f"window.hull1620Bytes = {size};\n", encoding="ascii")
    return size


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


def _period() -> Mapping[str, str]:
    """The programs of the time and their decks, by name."""
    files = (path for path in sorted(PERIOD.glob("*.*")) if path.suffix in (".f", ".deck"))
    return {path.name: path.read_text(encoding="ascii") for path in files}


def _filled(name: str, **marks: str) -> str:
    page = (SOURCE / name).read_text(encoding="utf-8")
    for mark, text in marks.items():
        page = page.replace(f"__{mark}__", text)
    return page


def _json(value: object) -> str:
    """JSON that a script element may hold."""
    return json.dumps(value).replace("<", "\\u003c")
