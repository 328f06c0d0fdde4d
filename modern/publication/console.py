"""The emulator in the browser: the HTML of its two pages, and the file with Python and the project that both load.

The HTML templates of the pages and the script of the web worker are in ``docs/console``. The other scripts are in
``docs/_static``. Python for the browser is the npm package ``pyodide``, which ``docs/console/package-lock.json`` pins.
The project itself is loaded from its wheel, lark and mpmath from the installed packages. The script
``docs/console/compile.mjs`` compiles all modules for Python in the browser. Without the npm package or the wheel, the
pages only show recorded runs.
"""

import base64
import gzip
import hashlib
import html
import json
import shutil
import subprocess
import tempfile
import zipfile
from collections.abc import Mapping, Sequence
from io import BytesIO
from pathlib import Path

from modern.edition import programs
from modern.edition.chapter6 import input_deck
from modern.edition.sources import read
from modern.formats.points import parse_bytes
from modern.publication.building import ROOT, BuildError, fill, zipped
from modern.publication.commentary import commentary
from modern.publication.desk import Answer, Desk
from modern.publication.parting import parted
from modern.publication.pyz import files_of

SOURCE = ROOT / "docs" / "console"
PERIOD = ROOT / "tests" / "data" / "period"
# The files of the npm package that a page loads unchanged, and the archive of the standard library, of which it loads a
# part.
PYODIDE = ("pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm")
_LIBRARY, _LOCK = "python_stdlib.zip", "pyodide-lock.json"
# Modules and files that no page needs: the beginnings of their paths in the standard library and in the packages.
_NOT_LOADED = (
    *("tests", "__pyinstaller", "__pycache__", "email", "multiprocessing", "xml", "_pyrepl", "unittest", "http"),
    *("pdb.py", "doctest.py", "tarfile.py", "pydoc.py", "ctypes", "html", "xmlrpc", "wsgiref", "imaplib.py"),
    *("pickletools.py", "mailbox.py", "smtplib.py", "ftplib.py", "sqlite3", "difflib.py", "statistics.py"),
    *("_pyio.py", "optparse.py", "configparser.py", "pydoc_data", "emulator/compiled", "hull1620"),
    *("modern/claims", "modern/papers", "modern/study", "modern/cli", "modern/digital", "modern/port", "modern/bench"),
    *("modern/exact_hull", "modern/drawing", "transcripts/statements", "transcripts/appel_will_1976", "lark/tools"),
    *("modern/publication/book", "modern/publication/site", "modern/publication/tei", "modern/publication/deposit.py"),
    *("modern/publication/hull1620.odd", "modern/publication/proof_sheet", "lark/grammars/python.lark", "argparse.py"),
    *("_pydatetime.py", "ipaddress.py", "logging/handlers.py", "logging/config.py", "_sysconfigdata", "bdb.py"),
    *("asyncio/windows", "asyncio/proactor", "concurrent/futures/process.py", "pyodide/console.py", "plistlib.py"),
    *("emulator/translation", "modern/edition/chapter6_", "modern/edition/weight", "modern/edition/collation.py"),
    *("modern/edition/transcription.py", "modern/publication/chart", "modern/publication/console.py"),
    *("modern/publication/facing.py", "modern/publication/flow.py", "modern/publication/steps.py"),
    *("modern/publication/moments.py", "fortran_src/apparatus", "fortran_src/commentary", "fortran_src/witness"),
    *("fortran_src/silent.csv", "fortran_src/README.md", "transcripts/README.md"),
)
_ENCODINGS = ("__init__", "aliases", "ascii", "cp437", "latin_1", "utf_8")
# The seconds on a 1620 between two frames of the recorded run, and the speed at which it is shown, as a multiple of
# 1963.
_FRAME, _PACE = 1.0, 10


def console_page() -> str:
    """Return the HTML of the emulator's page, with a recorded run and sample programs in the style of 1962."""
    about = {
        name: [[b.title, b.cards[0], b.cards[-1], b.text] for b in commentary(name).blocks] for name in programs.NAMES
    }
    data = {"period": _period(), "commentary": about, "recorded": recorded_run(), "pace": _PACE}
    return fill(_frame("console.html"), RECORDED=html.escape(recorded()), DATA=_json(data))


def parting_page() -> str:
    """Return the HTML of the page that compares the programs with exact arithmetic.

    The page initially shows one result.
    """
    sets = point_sets()
    first = next(iter(sets.values()))
    return fill(_frame("parting.html"), POINTS=html.escape(first), SETS=_json(sets), FIRST=_json(parted(first)))


def point_sets() -> dict[str, str]:
    """Return the point sets that the page offers: for each name, a text with one point on each line."""
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
    """Return the operator's log of a run of program1_examples and then program 2 with the points of example 4."""
    desk = Desk(clock=lambda: 0.0)
    for program, deck in (("program1_examples", "example4"), ("program2", "PUNCHED")):
        desk.load({"program": program, "deck": deck})
        desk.run(1e9)
        desk.act("START")
        while not desk.run(1e9)["ended"]:
            pass
    return desk.log()


def recorded_run() -> Answer:
    """Return a recorded run of program 3 with example 5, which the page shows until Python is loaded.

    In the result, ``load`` is the answer to the request that loads the program. ``frames`` has an answer for each slice
    of the run. A slice covers about one second on the 1620.
    """
    desk = Desk(clock=lambda: 0.0, small=10)
    load = desk.load({"program": "program3", "deck": "example5/punched"})
    frames = [desk.run(1e9)]
    desk.act("START")
    picture: Answer = {}
    while not frames[-1]["ended"]:
        # The clock stands still, so that the pace alone ends a slice.
        frame = desk.run(1000 * _FRAME, 1.0)
        is_same, picture = frame["picture"] == picture, frame["picture"]
        frames.append({key: value for key, value in frame.items() if key != "picture" or not is_same})
    return {"load": load, "frames": frames}


def install_machine(folder: Path, wheel: Path | None) -> int:
    """Write the files that the pages load into ``folder``, and return the number of bytes that a browser loads.

    ``machine.gzip`` contains all files that Python needs. ``machine.js`` has the same bytes for a site that is opened
    without a web server, because such a page can load only scripts. Without a wheel or the npm package, the function
    returns 0, and only ``size.js`` is written, which tells the pages that the emulator is missing.
    """
    folder.mkdir(parents=True, exist_ok=True)
    npm, size, version = SOURCE / "node_modules" / "pyodide", 0, ""
    if npm.is_dir() and wheel is not None:
        lock = json.loads((npm / _LOCK).read_text("utf-8"))
        files = {name: (npm / name).read_bytes() for name in PYODIDE}
        with zipfile.ZipFile(npm / _LIBRARY) as archive:
            library = {name: archive.read(name) for name in archive.namelist() if not name.endswith("/")}
        files[_LIBRARY], compiled = _compiled(npm, [_stored(library), packages(wheel)])
        with zipfile.ZipFile(BytesIO(compiled)) as archive:
            files |= {f"packages/{name}": archive.read(name) for name in archive.namelist()}
        files["lock.json"] = json.dumps(lock | {"packages": {}}).encode()
        data = packed(files)
        size, version = len(data), hashlib.sha256(data).hexdigest()[:16]
        (folder / "machine.gzip").write_bytes(data)
        worker = (SOURCE / "worker.js").read_text("utf-8")
        local = f"window.hull1620Local = {_json({'worker': worker, 'machine': base64.b64encode(data).decode()})};\n"
        (folder / "machine.js").write_text(local, encoding="utf-8")
        shutil.copyfile(SOURCE / "worker.js", folder / "worker.js")
        # A service worker controls only the pages in its own folder.
        shutil.copyfile(SOURCE / "cache.js", folder.parent / "cache.js")
    known = f'window.hull1620Bytes = {size};\nwindow.hull1620Version = "{version}";\n'
    (folder / "size.js").write_text(known, encoding="ascii")
    return size


def packages(wheel: Path) -> bytes:
    """Return an archive of those modules and data files of the wheel, lark and mpmath that a page may use."""
    return _stored(files_of(wheel))


def packed(files: Mapping[str, bytes]) -> bytes:
    """Pack several files into one compressed file with an index of their sizes."""
    index = json.dumps({name: len(content) for name, content in files.items()}).encode()
    return gzip.compress(len(index).to_bytes(4, "little") + index + b"".join(files.values()), mtime=0)


def _compiled(npm: Path, archives: Sequence[bytes]) -> list[bytes]:
    """Return the archives with compiled modules in place of the source code."""
    if not (node := shutil.which("node")):
        raise BuildError("node is missing, which compiles the modules of the emulator for the browser; install Node.js")
    with tempfile.TemporaryDirectory() as folder:
        paths = [Path(folder) / f"{number}.zip" for number in range(len(archives))]
        for path, archive in zip(paths, archives, strict=True):
            path.write_bytes(archive)
        command = [node, str(SOURCE / "compile.mjs"), str(npm), *map(str, paths)]
        process = subprocess.run(command, capture_output=True, text=True, check=False)
        if process.returncode:
            raise BuildError(f"the modules were not compiled: {process.stderr.strip()[-300:]}")
        return [path.read_bytes() for path in paths]


def _is_loaded(name: str) -> bool:
    folder, _, module = name.rpartition("/")
    if folder == "encodings" and module.removesuffix(".py") not in _ENCODINGS:
        return False
    return not any(f"/{name}".startswith(f"/{part}") or f"/{part}/" in f"/{name}" for part in _NOT_LOADED)


def _stored(files: Mapping[str, bytes]) -> bytes:
    """Return an uncompressed archive of the files that a page needs. The whole download is compressed later."""
    return zipped({name: data for name, data in files.items() if _is_loaded(name)}, compression=zipfile.ZIP_STORED)


def _period() -> Mapping[str, str]:
    files = (path for path in sorted(PERIOD.glob("*.*")) if path.suffix in (".f", ".deck"))
    return {path.name: path.read_text(encoding="ascii") for path in files}


def _frame(name: str) -> str:
    return (SOURCE / name).read_text(encoding="utf-8")


def _json(value: object) -> str:
    """Return JSON without the character <, so that it cannot end the script element that contains it."""
    return json.dumps(value, separators=(",", ":")).replace("<", "\\u003c")
