"""Pack a deposit for archives: ``python -m modern.publication.deposit dist``.

The deposit is a BagIt bag (RFC 8493) with the source, the wheel, the site, the book, the TEI documents and, optionally,
the rows of studies.  It is described as an RO-Crate, by CodeMeta and by Frictionless schemas of its tables
(:mod:`modern.publication.metadata`).  The deposit is written as a folder and as one compressed archive.  The same parts
always give the same bytes.
"""

import gzip
import hashlib
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
from io import BytesIO
from pathlib import Path

from modern.edition.sources import sources
from modern.publication.building import DIST, ROOT, BuildError, check_replaceable, newest_wheel, read_citation, run
from modern.publication.metadata import Work, codemeta, crate, data_package, work
from modern.publication.tei import archive

_CACHES = {"node_modules", "__pycache__", ".mypy_cache", ".ruff_cache", ".pytest_cache"}
_NOT_SOURCE = {".git", ".venv", "dist", "build"} | _CACHES
# The folders of a deposit and a description of each.
FOLDERS = {
    "source": "all files of the project: programs in fortran_src, printed results in transcripts, tests",
    "wheel": "the package that pip installs",
    "site": "the edition as a website: open site/index.html",
    "book": "the edition as a book, PDF/A",
    "tei": "listings and printed results with their emendations, TEI P5",
    "rows": "the results of studies, one row for each hull",
}


@dataclass(frozen=True, slots=True)
class Parts:
    """The files of a deposit by their paths in the bag, and the paths of those that are executable."""

    files: Mapping[str, bytes]
    executable: frozenset[str] = frozenset()


def source_files(root: Path = ROOT) -> tuple[str, ...]:
    """Return the sorted paths of the project's files.

    In a git checkout these are the tracked files; elsewhere all files except build results and caches.
    """
    if (root / ".git").exists():
        listed = subprocess.run(["git", "ls-files", "-z"], cwd=root, capture_output=True, check=True).stdout
        return tuple(sorted(name for name in listed.decode().split("\0") if name and (root / name).is_file()))
    paths = (path.relative_to(root) for path in root.rglob("*") if path.is_file() and not path.is_symlink())
    return tuple(
        sorted(path.as_posix() for path in paths if not _NOT_SOURCE & set(path.parts) and path.suffix != ".pyc")
    )


def gather(wheel: Path, site: Path, book: Path, rows: Path | None = None, root: Path = ROOT) -> Parts:
    """Read the files of a deposit.  Raise BuildError for a missing part and name the command that builds it."""
    for path, command in ((wheel, "make wheel"), (site / "index.html", "make edition"), (book, "make book")):
        if not path.is_file():
            raise BuildError(f"{path}: no such file; {command} builds it")
    files: dict[str, bytes] = {}
    executable = set()
    for name in source_files(root):
        files[f"source/{name}"] = (root / name).read_bytes()
        if (root / name).stat().st_mode & 0o100:
            executable.add(f"source/{name}")
    files[f"wheel/{wheel.name}"] = wheel.read_bytes()
    files[f"book/{book.name}"] = book.read_bytes()
    files |= {f"site/{name}": data for name, data in _tree(site)}
    about = described(root)
    files |= {f"tei/{name}": text.encode() for name, text in archive(about.version).items()}
    if rows is not None:
        if not rows.is_dir():
            raise BuildError(f"{rows}: not a folder")
        files |= {f"rows/{name}": data for name, data in _tree(rows)}
    return Parts(files, frozenset(executable))


def _tree(folder: Path) -> Iterator[tuple[str, bytes]]:
    for path in sorted(folder.rglob("*")):
        if path.is_file():
            yield path.relative_to(folder).as_posix(), path.read_bytes()


def described(root: Path = ROOT) -> Work:
    """Return the description of the project from its own files.  Raise ValueError if they contradict each other."""
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    references = (f"{d.author}: {d.title}. {d.year}" for d in sources().documents)
    return work(read_citation((root / "CITATION.cff").read_text(encoding="utf-8")), project, references)


def with_descriptions(parts: Parts, root: Path = ROOT) -> Parts:
    """Add the files that describe a deposit: README.txt, CodeMeta, the data package and the RO-Crate."""
    about = described(root)
    files = dict(parts.files)
    tables = {name: data.decode() for name, data in files.items() if name.endswith(".csv") and "/docs/" in name}
    files["datapackage.json"] = data_package(about, tables).encode()
    files["codemeta.json"] = codemeta(about).encode()
    files["README.txt"] = readme(about, Parts(files, parts.executable), root).encode()
    folders = {name: description for name, description in FOLDERS.items() if _has_folder(files, name)}
    kinds = {
        "README.txt": ("the contents of the deposit and how to use them", "text/plain"),
        "codemeta.json": ("the software, described by CodeMeta", "application/ld+json"),
        "datapackage.json": ("the tables, described by Frictionless schemas", "application/json"),
        **{name: ("the edition as a book", "application/pdf") for name in files if name.startswith("book/")},
        **{name: ("the package that pip installs", "application/zip") for name in files if name.startswith("wheel/")},
    }
    files["ro-crate-metadata.json"] = crate(about, folders, kinds).encode()
    return Parts(files, parts.executable)


def readme(about: Work, parts: Parts, root: Path = ROOT) -> str:
    """Return the README.txt of a deposit, for a reader who has only the deposit."""
    files = parts.files
    wheel = next(name for name in files if name.startswith("wheel/"))
    lock = (root / "locks" / "run.lock").read_text(encoding="utf-8")
    required = {re.split(r"[^A-Za-z0-9_-]", requirement)[0] for requirement in about.requirements}
    pinned = [line.split(" ")[0] for line in lock.splitlines() if line.split("==")[0] in required]
    contents = "\n".join(f"  {name + '/':<10}{text}" for name, text in FOLDERS.items() if _has_folder(files, name))
    source = {name.removeprefix("source/"): data for name, data in files.items() if name.startswith("source/")}
    return f"""{about.title}
Version {about.version}, {about.date}, by {about.author}.

{about.description}.

Contents (this folder is the "data" folder of a BagIt bag, RFC 8493):

{contents}

Start with site/index.html in any browser, or with the book. source/README.md describes the
software; source/LICENSE states the rights in each file.

To reproduce the results you need Python {about.python} and some wheels: this one and those of
{", ".join(pinned)} (source/locks/run.lock has their hashes). Without a network:

  python3 -m venv env
  env/bin/python -m pip install --no-index --find-links FOLDER_OF_WHEELS {wheel}
  env/bin/hull1620 reproduce

The last command computes every result that the thesis and four later papers print. Its exit
code is 0 if all results agree with the recorded verdicts.

To verify the files: manifest-sha512.txt, one folder up, has the SHA-512 of every file, and
"python -m bagit --validate FOLDER" compares them. The source as a Software Heritage
directory: {swhid(source, {name.removeprefix("source/") for name in parts.executable})}
"""


def _has_folder(files: Mapping[str, bytes], folder: str) -> bool:
    return any(name.startswith(f"{folder}/") for name in files)


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


def write(out: Path, parts: Parts, root: Path = ROOT) -> tuple[Path, Path]:
    """Write the bag as a folder in ``out`` and as an archive next to it, and return both paths.

    Raise BuildError if the folder exists and is not a bag, or if the package bagit is missing.
    """
    try:
        import bagit
    except ImportError:
        raise BuildError("bagit packs the deposit: pip install 'hull1620[edition]'") from None
    about = described(root)
    name = f"{about.name}-{about.version}-deposit"
    bag, archive = out / name, out / f"{name}.tar.gz"
    check_replaceable(bag, "bagit.txt", "a BagIt bag")
    out.mkdir(parents=True, exist_ok=True)
    described_parts = with_descriptions(parts, root)
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
    """Pack the results of ``make wheel``, ``make edition`` and ``make book``.  Return 0, or 2 after one line."""
    parser = ArgumentParser(prog="deposit", description="Pack a deposit for archives.")
    parser.add_argument("out", nargs="?", type=Path, default=DIST, help="output folder (default: dist)")
    parser.add_argument("--rows", type=Path, help="a folder with rows of studies to include")
    args = parser.parse_args(arguments)

    def summary() -> str:
        parts = gather(newest_wheel() or DIST / "hull1620.whl", DIST / "edition", DIST / "hull1620.pdf", args.rows)
        bag, archive = write(args.out, parts)
        return f"{bag}: a BagIt bag; {archive.name}: {archive.stat().st_size / 1e6:.1f} MB"

    return run("deposit", summary)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
