"""The emulator in the browser: the HTML of its two pages, and the files that they load.

The HTML and the worker are in ``docs/console``, the scripts in ``docs/_static``.  Python for the browser is the npm
package ``pyodide``, which ``docs/console/package-lock.json`` pins.  The project itself is loaded from its wheel, lark
and mpmath from the installed packages.  Without the npm package or the wheel, the pages show recorded answers only.
"""

import gzip
import html
import json
import shutil
from collections.abc import Mapping
from pathlib import Path

from modern.edition.chapter6 import input_deck
from modern.edition.sources import read
from modern.formats.points import parse_bytes
from modern.publication.building import ROOT
from modern.publication.desk import Desk
from modern.publication.parting import parted
from modern.publication.pyz import packages

SOURCE = ROOT / "docs" / "console"
PERIOD = ROOT / "tests" / "data" / "period"
# The files of the npm package that a page loads unchanged.
PYODIDE = ("pyodide.mjs", "pyodide.asm.mjs", "python_stdlib.zip", "pyodide-lock.json")
# The file that a page loads compressed; it is two thirds of the total and servers do not compress it.
PACKED = "pyodide.asm.wasm"


def console_page() -> str:
    """Return the HTML of the emulator: its controls, a recorded session, and programs in the style of the period."""
    return _filled("console.html", RECORDED=html.escape(recorded()), PERIOD=_json(_period()))


def parting_page() -> str:
    """Return the HTML of the page that compares the programs with exact arithmetic, with the result for one set."""
    sets = point_sets()
    first = next(iter(sets.values()))
    return _filled("parting.html", POINTS=html.escape(first), SETS=_json(sets), FIRST=_json(parted(first)))


def point_sets() -> dict[str, str]:
    """Return the point sets that the page offers, one point per line."""
    plane = ((0, 0), (90, 10), (100, 60), (40, 90), (-30, 60), (30, 40), (50, 35))
    solid = ((123, 456, 789), (987, 654, 321), (111, 999, 555), (345, 678, 901), (222, 333, 444), (871, 12, 345))
    decks = {
        "four points of five digits: a wrong hull": read("transcripts/counterexamples/silent.deck"),
        "example 5 of the thesis: the true hull": input_deck(5).text(),
        "a cube: rejected because of a fault": read("transcripts/counterexamples/cube.deck"),
    }
    sets = {name: "\n".join(" ".join(p) for p in parse_bytes(t.encode(), name).points) for name, t in decks.items()}
    return sets | {
        "six points of three digits: rejected": "\n".join(" ".join(map(str, point)) for point in solid),
        "seven points in a plane, which can be dragged": "\n".join(f"{x} {y} 0" for x, y in plane),
    }


def recorded() -> str:
    """Return the operator's log of example 4: a run of program1_examples, then of program 2 with the punched cards."""
    desk = Desk(clock=lambda: 0.0)
    for program, deck in (("program1_examples", "example4"), ("program2", "stacker")):
        desk.load({"program": program, "deck": deck})
        desk.run(1e9)
        desk.act("START")
        while not desk.run(1e9)["ended"]:
            pass
    return desk.log()


def install_machine(folder: Path, wheel: Path | None, source: Path = SOURCE) -> int:
    """Write the files that the pages load into ``folder`` and return their size in bytes.

    Without a wheel or the npm package, the size is 0, and only ``size.js`` is written, from which the pages learn that
    the emulator is missing.
    """
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
        # The progress bar cannot count the worker and pyodide.mjs: the browser loads them as modules.
        fetched = [folder / "pyodide" / name for name in PYODIDE if name != "pyodide.mjs"]
        counted = [*fetched, packed, folder / "packages.zip"]
        size = sum(path.stat().st_size for path in counted)
    (folder / "size.js").write_text(f"window.hull1620Bytes = {size};\n", encoding="ascii")
    return size


def _period() -> Mapping[str, str]:
    files = (path for path in sorted(PERIOD.glob("*.*")) if path.suffix in (".f", ".deck"))
    return {path.name: path.read_text(encoding="ascii") for path in files}


def _filled(name: str, **placeholders: str) -> str:
    page = (SOURCE / name).read_text(encoding="utf-8")
    for placeholder, text in placeholders.items():
        page = page.replace(f"__{placeholder}__", text)
    return page


def _json(value: object) -> str:
    """Return JSON that is safe inside a script element."""
    return json.dumps(value).replace("<", "\\u003c")
