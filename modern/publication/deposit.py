"""Pack a deposit for archives: ``python -m modern.publication.deposit dist``.

The deposit is a BagIt bag (RFC 8493).  It contains the program as one file, the source, the wheel, the third-party
packages (:mod:`modern.publication.vendored`), the site, the book, the TEI documents, the benchmark and, optionally, the
rows of studies.  The files of :mod:`modern.publication.metadata` describe it.  The deposit is written as a folder and
as one compressed archive.  The same parts always give the same bytes.
"""

import gzip
import hashlib
import json
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import tomllib
from argparse import ArgumentParser
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from io import BytesIO
from pathlib import Path

from modern.edition.sources import sources
from modern.publication import vendored
from modern.publication.building import DIST, ROOT, BuildError, check_replaceable, citation, newest_wheel, run
from modern.publication.metadata import Part, Process, Work, codemeta, crate, data_package, work
from modern.publication.pyz import NAME
from modern.publication.tables import columns, csv_text
from modern.publication.tei import archive

_CACHES = {"node_modules", "__pycache__", ".mypy_cache", ".ruff_cache", ".pytest_cache"}
_NOT_SOURCE = {".git", ".venv", "dist", "build", "hull1620.egg-info"} | _CACHES
_MIT, _CC0 = "https://spdx.org/licenses/MIT", "https://creativecommons.org/publicdomain/zero/1.0/"
_OTHERS = "The licences of the packages, in wheels/licences"
_PYODIDE = "Pyodide: MPL-2.0 (pyodide/package.json)"
_THESIS = "Text of the thesis and the papers: rights of their authors and publishers, not ours to license"
_MIXED = "Code and documents MIT, data CC0, quoted sources not ours: source/LICENSE names the folders"
# The text of the deposit's README.txt, with names in braces for the facts.
TEMPLATE = Path(__file__).with_name("deposit_readme.txt")
# The folders and files that a deposit may contain, with their descriptions and licences.
CONTENTS = {
    "README.txt": Part("the contents of the deposit and how to use them", _MIT, "text/plain"),
    "codemeta.json": Part("the software, described by CodeMeta", _CC0, "application/ld+json"),
    "datapackage.json": Part("the tables, described by Frictionless schemas", _CC0, "application/json"),
    "hull1620.pyz": Part("the program as one file: python3 hull1620.pyz", _MIT, "application/zip"),
    "source/": Part("all files of the project", _MIXED),
    "source/emulator/": Part("code: the machine", _MIT),
    "source/modern/": Part("code: edition, exact hulls, studies, site", _MIT),
    "source/tests/": Part("code: the tests", _MIT),
    "source/docs/": Part("the documents; the tables of docs/studies are CC0", _MIT),
    "source/fortran_src/apparatus/": Part("data: the emendations of the listings", _CC0),
    "source/fortran_src/witness/": Part("the text of the listings as found", _THESIS),
    "source/transcripts/": Part("printed results as found, with their emendations (data CC0)", _THESIS),
    "wheel/": Part("the package that pip installs", _MIT),
    "wheels/": Part("the packages of others that run it and build the site and the book", _OTHERS),
    "pyodide/": Part("Python for browsers, which the site's machine loads", _PYODIDE),
    "site/": Part("the edition as a website: open site/index.html", _MIXED),
    "book/": Part("the edition as a book, PDF/A", _MIXED),
    "tei/": Part("listings and printed results with their emendations, TEI P5", _MIXED),
    "benchmark/": Part("the programs in C and Fortran, and exact verdicts of their decisions", _CC0),
    "benchmark/original/": Part("the programs as cards", _THESIS),
    "tables/": Part("the tables of the studies, each number in a cell of its own", _CC0),
    "rows/": Part("the results of studies, one row for each hull", _CC0),
}


@dataclass(frozen=True, slots=True)
class Parts:
    """The files of a deposit by their paths in the bag, and the paths of the executable files."""

    files: Mapping[str, bytes]
    executable: frozenset[str] = frozenset()


def source_files() -> tuple[str, ...]:
    """Return the sorted paths of the project's files.

    In a git checkout these are the tracked files.  Elsewhere they are all files except build results and caches.
    """
    if (ROOT / ".git").exists():
        listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True).stdout
        return tuple(sorted(name for name in listed.decode().split("\0") if name and (ROOT / name).is_file()))
    paths = (path.relative_to(ROOT) for path in ROOT.rglob("*") if path.is_file() and not path.is_symlink())
    return tuple(
        sorted(path.as_posix() for path in paths if not _NOT_SOURCE & set(path.parts) and path.suffix != ".pyc")
    )


def gather(dist: Path, rows: Path | None = None) -> Parts:
    """Return the project's files, the results of all builds, and the third-party packages that were collected.

    ``dist`` is the folder of the builds, and ``rows`` is a folder with rows of studies to include.  Raise BuildError if
    the result of a build is missing.  The message names the command that makes it.
    """
    from modern.bench.benchmark import benchmark  # its imports take a second

    wheel = newest_wheel(dist) or dist / "hull1620.whl"
    site, book, pyz = dist / "edition", dist / "hull1620.pdf", dist / NAME
    builds = ((wheel, "wheel"), (pyz, "pyz"), (site / "index.html", "edition"), (book, "book"))
    for path, command in ((path, f"make {target}") for path, target in builds):
        if not path.is_file():
            raise BuildError(f"{path}: no such file; {command} builds it")
    files: dict[str, bytes] = {}
    executable = set()
    for name in source_files():
        files[f"source/{name}"] = (ROOT / name).read_bytes()
        if (ROOT / name).stat().st_mode & 0o100:
            executable.add(f"source/{name}")
    files[NAME] = pyz.read_bytes()
    executable.add(NAME)
    files |= vendored.files(dist / "wheels")
    files[f"wheel/{wheel.name}"] = wheel.read_bytes()
    files[f"book/{book.name}"] = book.read_bytes()
    files |= {f"site/{name}": data for name, data in _tree(site)}
    about = described()
    files |= {f"tei/{name}": text.encode() for name, text in archive(about.version).items()}
    files |= {f"benchmark/{name}": text.encode() for name, text in benchmark().items()}
    if rows is not None:
        if not rows.is_dir():
            raise BuildError(f"{rows}: expected a folder with the results (rows) of studies")
        files |= {f"rows/{name}": data for name, data in _tree(rows)}
    return Parts(files, frozenset(executable))


def _tree(folder: Path) -> Iterator[tuple[str, bytes]]:
    for path in sorted(folder.rglob("*")):
        if path.is_file():
            yield path.relative_to(folder).as_posix(), path.read_bytes()


def described() -> Work:
    """Return the description of the project from its own files. Raise ValueError if the files contradict each other."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    references = (f"{d.author}: {d.title}. {d.year}" for d in sources().documents)
    return work(citation(), project["project"], references, project["tool"]["deposit"])


def with_descriptions(parts: Parts) -> Parts:
    """Return the files of a deposit, together with the files that describe it.

    The files that describe it are README.txt, codemeta.json, the tables of the studies with datapackage.json, and the
    RO-Crate metadata.
    """
    about = described()
    files = dict(parts.files)
    tables = {
        f"tables/{name.partition('/docs/')[2]}": columns(name, data.decode())
        for name, data in files.items()
        if name.endswith(".csv") and "/docs/" in name
    }
    files |= {path: csv_text(table).encode() for path, table in tables.items()}
    files["datapackage.json"] = data_package(about, tables).encode()
    files["codemeta.json"] = codemeta(about).encode()
    files["README.txt"] = readme(about, Parts(files, parts.executable)).encode()
    crate_parts = {
        **{name: part for name, part in CONTENTS.items() if any(file.startswith(name) for file in files)},
        **{name: Part("a table of a study", _CC0, "text/csv") for name in tables},
        **{
            name: Part("the edition as a book", _MIXED, "application/pdf") for name in files if name.startswith("book/")
        },
    }
    files["ro-crate-metadata.json"] = crate(about, crate_parts, tuple(processes(files))).encode()
    return Parts(files, parts.executable)


def processes(files: Mapping[str, bytes]) -> Iterator[Process]:
    """Yield a description of the run of each study, read from the manifest of the study."""
    for name in sorted(files):
        match = re.fullmatch(r"source/docs/studies/([\w-]+)/manifest\.json", name)
        if not match:
            continue
        manifest = json.loads(files[name])
        folder = f"tables/studies/{match[1]}/"
        yield Process(
            match[1],
            manifest["plan"]["title"],
            " ".join(manifest["command"]),
            manifest["versions"],
            tuple(path for path in sorted(files) if path.startswith(folder)),
            f"{manifest['samples']} sets, seed {manifest['plan']['seed']}; decks {manifest['decks_sha256']}",
        )


def readme(about: Work, parts: Parts) -> str:
    """Return the text of README.txt, which addresses a reader who has only the deposit."""
    files = parts.files
    wheel = next(name for name in files if name.startswith("wheel/"))
    contents = "\n".join(
        f"  {name} ({_extent(name, files)})\n      {part.description}\n"
        f"      rights: {part.licence.removeprefix('https://')}"
        for name, part in CONTENTS.items()
        if any(file.startswith(name) for file in files)
    )
    left_out, pinned = vendored.left_out(files), vendored.locked()
    numpy = next((name.split("-", 2)[2] for name in files if name.startswith("wheels/numpy-")), "none")
    binary = sorted(re.findall(r"^wheels/([^-/]+)-[^/]+(?<!none-any)\.whl$", "\n".join(files), re.MULTILINE))
    without_wheel = [pin for pin in vendored.pins("dev") if pin.split("==")[0] in vendored.SOURCE_ONLY]
    total, wheels = (sum(len(files[name]) for name in files if name.startswith(start)) for start in ("", "wheels/"))
    hashes = "\n".join(
        f"  {hashlib.sha256(data).hexdigest()}  {name}"
        for name, data in sorted(files.items())
        if name == NAME or name.endswith(".whl") or name.startswith("book/")
    )
    source = {name.removeprefix("source/"): data for name, data in files.items() if name.startswith("source/")}
    identifiers = "\n".join(f"  {name:<11} {value}" for name, value in about.identifiers().items())
    return TEMPLATE.read_text(encoding="utf-8").format(
        title=about.title,
        version=about.version,
        date=about.date,
        author=about.author,
        description=about.description,
        total=total / 1e6,
        wheels=wheels / 1e6,
        contents=contents,
        left_out=left_out or "Nothing is left out: all parts that the project can collect are here.",
        wheel=wheel,
        numpy=numpy,
        numpy_version=next(pin.partition("==")[2] for pin in pinned if pin.startswith("numpy==")),
        pinned=", ".join(pinned),
        python=numpy.removesuffix(".whl"),
        binary=", ".join(binary) or "none",
        without_wheel=", ".join(without_wheel),
        epoch=int(datetime.fromisoformat(f"{about.date}T00:00+00:00").timestamp()),
        hashes=hashes,
        swhid=swhid(source, {name.removeprefix("source/") for name in parts.executable}),
        identifiers=identifiers,
    )


def _extent(name: str, files: Mapping[str, bytes]) -> str:
    sizes = [len(data) for file, data in files.items() if file.startswith(name)]
    return f"{f'{len(sizes):,} files, ' if name.endswith('/') else ''}{sum(sizes) / 1e6:.1f} MB"


def swhid(files: Mapping[str, bytes], executable: set[str]) -> str:
    """Return the Software Heritage identifier of a folder: git's hash of its tree (SWHID 1.2, section 5.3)."""

    def tree(prefix: str) -> bytes:
        entries: dict[bytes, bytes] = {}
        for name in (name for name in files if name.startswith(prefix)):
            first, slash, _ = name[len(prefix) :].partition("/")
            # Git sorts a folder as if its name ended with a slash, hence the slash in the key.
            if slash:
                if first.encode() + b"/" not in entries:
                    entries[first.encode() + b"/"] = b"40000 " + first.encode() + b"\0" + tree(f"{prefix}{first}/")
            else:
                mode = b"100755 " if name in executable else b"100644 "
                entries[first.encode()] = mode + first.encode() + b"\0" + _hash(b"blob", files[name])
        return _hash(b"tree", b"".join(entries[key] for key in sorted(entries)))

    return f"swh:1:dir:{tree('').hex()}"


def _hash(kind: bytes, data: bytes) -> bytes:
    return hashlib.sha1(kind + b" %d\0" % len(data) + data, usedforsecurity=False).digest()


def write(out: Path, parts: Parts) -> tuple[Path, Path]:
    """Write the bag as a folder in ``out`` and as an archive next to it, and return both paths.

    Raise BuildError if the folder exists and is not a bag, or if the package bagit is missing.
    """
    try:
        import bagit
    except ImportError:
        raise BuildError("bagit, which packs the deposit, is missing: pip install 'hull1620[edition]'") from None
    about = described()
    name = f"{about.name}-{about.version}-deposit"
    bag, archive = out / name, out / f"{name}.tar.gz"
    check_replaceable(bag, "bagit.txt", "a BagIt bag")
    out.mkdir(parents=True, exist_ok=True)
    described_parts = with_descriptions(parts)
    with tempfile.TemporaryDirectory(prefix=".deposit-", dir=out) as folder:
        new_bag, new_archive = Path(folder) / bag.name, Path(folder) / archive.name
        for name, data in sorted(described_parts.files.items()):
            path = new_bag / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
            path.chmod(0o755 if name in parts.executable else 0o644)
        information = {
            "Source-Organization": about.author,
            "External-Description": about.description,
            "External-Identifier": f"{about.name} {about.version}",
            "Bagging-Date": about.date,
        }
        bagit.make_bag(str(new_bag), information, checksums=["sha512"])
        new_archive.write_bytes(_packed(new_bag, parts.executable))
        if bag.exists():
            shutil.move(bag, Path(folder) / "before")
        new_bag.rename(bag)
        new_archive.replace(archive)
    return bag, archive


def _packed(folder: Path, executable: frozenset[str]) -> bytes:
    buffer = BytesIO()
    with tarfile.open(fileobj=buffer, mode="w", format=tarfile.PAX_FORMAT) as archive:
        for path in sorted(path for path in folder.rglob("*") if path.is_file()):
            name = path.relative_to(folder).as_posix()
            entry = tarfile.TarInfo(f"{folder.name}/{name}")
            entry.size, entry.mode = path.stat().st_size, 0o755 if name.removeprefix("data/") in executable else 0o644
            with path.open("rb") as file:
                archive.addfile(entry, file)
    return gzip.compress(buffer.getvalue(), 9, mtime=0)


def main(arguments: Sequence[str]) -> int:
    """Pack the results of all other builds. Return the exit code: 0, or 2 after an error message."""
    parser = ArgumentParser(prog="deposit", description="Pack a deposit for archives.")
    parser.add_argument("out", nargs="?", type=Path, default=DIST, help="output folder (default: dist)")
    parser.add_argument("--rows", type=Path, help="a folder with results of studies (rows) to include")
    args = parser.parse_args(arguments)

    def summary() -> str:
        parts = gather(DIST, args.rows)
        bag, archive = write(args.out, parts)
        note = vendored.left_out(parts.files)
        return f"{bag}: a BagIt bag; {archive.name}: {archive.stat().st_size / 1e6:.1f} MB{note and chr(10)}{note}"

    return run("deposit", summary)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
