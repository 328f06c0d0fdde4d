"""A deposit for archives: ``python -m modern.publication.deposit dist``.

A BagIt bag (RFC 8493) with the source, the wheel, the site, the book, the TEI documents and the studies' rows where
they are at hand; described as an RO-Crate, by CodeMeta and, its tables, by Frictionless schemas
(:mod:`modern.publication.metadata`).  It lies there as a folder and as one file, and both are the same bytes whenever
they are made of the same parts.
"""

from __future__ import annotations

import argparse
import gzip
import hashlib
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path

from modern.edition.sources import sources
from modern.publication import tei
from modern.publication.metadata import Work, codemeta, crate, data_package, work

ROOT = Path(__file__).parents[2]
_SKIPPED = {
    ".git",
    ".venv",
    "dist",
    "build",
    "node_modules",
    "__pycache__",
    ".mypy_cache",
    ".ruff_cache",
    ".pytest_cache",
}
_OURS = "bagit.txt"
FOLDERS = {
    "source": "every file of the project: decks in fortran_src, prints in transcripts, vectors in tests/data",
    "wheel": "the project as it is installed",
    "site": "the edition as pages: open site/index.html",
    "book": "the edition as a book, PDF/A",
    "tei": "listings and prints with their apparatus, TEI P5",
    "rows": "rows of studies, as they were judged",
}


class DepositError(Exception):
    """Why there is no deposit, in one line."""


@dataclass(frozen=True, slots=True)
class Parts:
    """What a deposit is made of: files by their paths in the bag, and which of them may be run."""

    files: Mapping[str, bytes]
    executable: frozenset[str] = frozenset()


def source_files(root: Path = ROOT) -> tuple[str, ...]:
    """The project's files: those git tracks, or of a copy without git all but what is made.  Sorted paths."""
    if (root / ".git").exists():
        listed = subprocess.run(["git", "ls-files", "-z"], cwd=root, capture_output=True, check=True).stdout
        return tuple(sorted(name for name in listed.decode().split("\0") if name and (root / name).is_file()))
    found = (path.relative_to(root) for path in root.rglob("*") if path.is_file() and not path.is_symlink())
    return tuple(sorted(path.as_posix() for path in found if not _SKIPPED & set(path.parts) and path.suffix != ".pyc"))


def gather(wheel: Path, site: Path, book: Path, rows: Path | None = None, root: Path = ROOT) -> Parts:
    """The parts of a deposit.  Raises DepositError for one that is not there."""
    for path, words in ((wheel, "make wheel"), (site / "index.html", "make edition"), (book, "make book")):
        if not path.is_file():
            raise DepositError(f"{path}: is not there; {words} makes it")
    files: dict[str, bytes] = {}
    runs = set()
    for name in source_files(root):
        files[f"source/{name}"] = (root / name).read_bytes()
        if (root / name).stat().st_mode & 0o100:
            runs.add(f"source/{name}")
    files[f"wheel/{wheel.name}"] = wheel.read_bytes()
    files[f"book/{book.name}"] = book.read_bytes()
    files |= {f"site/{name}": data for name, data in _tree(site)}
    about = described(root)
    files |= {f"tei/{name}.xml": tei.tei(name, about.version).encode() for name in tei.names()}
    files["tei/hull1620.rng"] = tei.schema().encode()
    if rows is not None:
        if not rows.is_dir():
            raise DepositError(f"{rows}: is no folder of rows")
        files |= {f"rows/{name}": data for name, data in _tree(rows)}
    return Parts(files, frozenset(runs))


def _tree(folder: Path) -> Iterator[tuple[str, bytes]]:
    for path in sorted(folder.rglob("*")):
        if path.is_file():
            yield path.relative_to(folder).as_posix(), path.read_bytes()


def described(root: Path = ROOT) -> Work:
    """The work as the project's own files describe it.  Raises ValueError where they do not agree."""
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    named = (f"{d.author}: {d.title}. {d.year}" for d in sources().documents)
    return work((root / "CITATION.cff").read_text(encoding="utf-8"), project, named)


def with_descriptions(parts: Parts, root: Path = ROOT) -> Parts:
    """The parts with the files that describe them."""
    about = described(root)
    files = dict(parts.files)
    tables = {name: data.decode() for name, data in files.items() if name.endswith(".csv") and "/docs/" in name}
    files["datapackage.json"] = data_package(about, tables).encode()
    files["codemeta.json"] = codemeta(about).encode()
    files["README.txt"] = readme(about, Parts(files, parts.executable), root).encode()
    folders = {name: words for name, words in FOLDERS.items() if any(f.startswith(f"{name}/") for f in files)}
    kinds = {
        "README.txt": ("what is here and how to use it", "text/plain"),
        "codemeta.json": ("the software, described by CodeMeta", "application/ld+json"),
        "datapackage.json": ("the tables, described by Frictionless schemas", "application/json"),
        **{name: ("the edition as a book", "application/pdf") for name in files if name.startswith("book/")},
        **{name: ("the project as it is installed", "application/zip") for name in files if name.startswith("wheel/")},
    }
    files["ro-crate-metadata.json"] = crate(about, folders, kinds).encode()
    return Parts(files, parts.executable)


def readme(about: Work, parts: Parts, root: Path = ROOT) -> str:
    """Plain text for somebody who has the bag and nothing else."""
    files = parts.files
    wheel = next(name for name in files if name.startswith("wheel/"))
    lock = (root / "locks" / "run.lock").read_text(encoding="utf-8")
    needed = {re.split(r"[^A-Za-z0-9_-]", each)[0] for each in about.needs}
    pinned = [line.split(" ")[0] for line in lock.splitlines() if line.split("==")[0] in needed]
    held = "\n".join(f"  {name + '/':<10}{words}" for name, words in FOLDERS.items() if _has(files, name))
    whole = {name.removeprefix("source/"): data for name, data in files.items() if name.startswith("source/")}
    return f"""{about.title}
Version {about.version}, {about.date}, by {about.author}.

{about.description}.

What is here (this folder is "data" of a BagIt bag, RFC 8493):

{held}

Read first: site/index.html in any browser, or the book. source/README.md tells what the
software does; source/LICENSE says file by file what is whose.

To do it again you need Python {about.python} and some wheels: this one and those of
{", ".join(pinned)} (their hashes stand in source/locks/run.lock). Without a network:

  python3 -m venv env
  env/bin/python -m pip install --no-index --find-links FOLDER_OF_WHEELS {wheel}
  env/bin/hull1620 reproduce

The last command computes everything that the thesis and four later papers print, and ends
with exit code 0 where all comes out as it is recorded.

To see that nothing has changed: every file's SHA-512 stands in manifest-sha512.txt one
folder up; "python -m bagit --validate FOLDER" compares them. The source as a Software
Heritage directory: {swhid(whole, {name.removeprefix("source/") for name in parts.executable})}
"""


def _has(files: Mapping[str, bytes], folder: str) -> bool:
    return any(name.startswith(f"{folder}/") for name in files)


def swhid(files: Mapping[str, bytes], executable: set[str]) -> str:
    """The Software Heritage identifier of a folder (SWHID 1.2, 5.3): git's hash of its tree."""

    def tree(prefix: str) -> bytes:
        inside = sorted(name for name in files if name.startswith(prefix))
        entries: dict[bytes, bytes] = {}
        for name in inside:
            first, slash, _ = name[len(prefix) :].partition("/")
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


def write(out: Path, parts: Parts, root: Path = ROOT) -> tuple[Path, Path]:
    """Write the bag into the folder ``out`` and as one file beside it; returns both.

    Raises DepositError where something that is no bag stands in the way, or a package is missing.
    """
    try:
        import bagit
    except ImportError:
        raise DepositError("the deposit is packed by bagit: pip install 'hull1620[edition]'") from None
    about = described(root)
    bag, packed = out / f"{about.name}-{about.version}-deposit", out / f"{about.name}-{about.version}-deposit.tar.gz"
    if bag.exists() and not (bag / _OURS).is_file():
        raise DepositError(f"{bag}: is there and is no bag; nothing is replaced")
    out.mkdir(parents=True, exist_ok=True)
    whole = with_descriptions(parts, root)
    with tempfile.TemporaryDirectory(prefix=".deposit-", dir=out) as room:
        made = Path(room) / bag.name
        for name, data in sorted(whole.files.items()):
            path = made / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
            path.chmod(0o755 if name in whole.executable else 0o644)
        bagit.make_bag(str(made), _information(about), checksums=["sha512"])
        beside = Path(room) / packed.name
        beside.write_bytes(_packed(made, whole.executable))
        if bag.exists():
            shutil.move(bag, Path(room) / "before")
        made.rename(bag)
        beside.replace(packed)
    return bag, packed


def _information(about: Work) -> dict[str, str]:
    return {
        "Source-Organization": about.author,
        "External-Description": about.description,
        "External-Identifier": f"{about.name} {about.version}",
        "Bagging-Date": about.date,
    }


def _packed(folder: Path, executable: frozenset[str]) -> bytes:
    """A folder as a compressed tar archive in which nothing tells when or by whom it was made."""
    held = BytesIO()
    with tarfile.open(fileobj=held, mode="w", format=tarfile.PAX_FORMAT) as archive:
        for path in sorted(path for path in folder.rglob("*") if path.is_file()):
            name = path.relative_to(folder).as_posix()
            entry = tarfile.TarInfo(f"{folder.name}/{name}")
            entry.size, entry.mode = path.stat().st_size, 0o755 if name.removeprefix("data/") in executable else 0o644
            with path.open("rb") as file:
                archive.addfile(entry, file)
    return gzip.compress(held.getvalue(), 9, mtime=0)


def main(words: Sequence[str]) -> int:
    """Make the deposit of what ``make wheel``, ``edition`` and ``book`` have made.  0, or 2 with one line."""
    parser = argparse.ArgumentParser(prog="deposit", description="Pack a deposit for archives.")
    parser.add_argument(
        "out", nargs="?", type=Path, default=ROOT / "dist", help="the folder it goes to (default: dist)"
    )
    parser.add_argument("--rows", type=Path, help="a folder with rows of studies")
    args = parser.parse_args(words)
    made = ROOT / "dist"
    wheel = max(made.glob("hull1620-*.whl"), key=lambda path: path.stat().st_mtime, default=made / "hull1620.whl")
    try:
        bag, packed = write(args.out, gather(wheel, made / "edition", made / "hull1620.pdf", args.rows))
    except (DepositError, ValueError, OSError) as error:
        print(f"deposit: {error}", file=sys.stderr)
        return 2
    print(f"{bag}: a bag; {packed.name}: {packed.stat().st_size / 1e6:.1f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
