"""The files that a visitor of the site can download.

The site contains all of them, so it works without a network.  The wheel, the one-file program and the book are included
if they have been built.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from modern.edition import programs
from modern.publication.building import DIST, ROOT, citation, newest_wheel, zipped
from modern.publication.deposit import source_files
from modern.publication.tei import archive

FOLDER = "get"
_DEVICES = (".deck", ".punch", ".typewriter")
_TABLES = (".csv", ".json", ".jsonl")


@dataclass(frozen=True, slots=True)
class Download:
    """A file in the folder of downloads.

    ``files`` has the contents of the files in a zip archive by name.  For a download that is not an archive, it has
    only the file itself.
    """

    name: str
    title: str
    licence: str
    files: Mapping[str, bytes]

    @property
    def packed(self) -> bool:
        return self.name.endswith(".zip")


def downloads() -> Iterator[Download]:
    """Yield everything that can be downloaded, in the order of the page."""
    version = str(citation()["version"])
    sources = source_files()
    if (wheel := newest_wheel()) is not None:
        yield Download(wheel.name, "The software as a Python wheel", "MIT", {wheel.name: wheel.read_bytes()})
    if (pyz := DIST / "hull1620.pyz").is_file():
        licence = "MIT; contains lark (MIT) and mpmath (BSD)"
        yield Download(pyz.name, "The software as one file, without numpy", licence, {pyz.name: pyz.read_bytes()})
    yield Download("source.zip", "The whole source, with tests and documents", "MIT, CC0; see LICENSE", _read(sources))
    if (book := DIST / "hull1620.pdf").is_file():
        files = {book.name: book.read_bytes()}
        yield Download(book.name, "The edition as a book, PDF/A", "CC0; quotations: LICENSE", files)
    for name in programs.NAMES:
        text = programs.deck(name).text().encode("ascii")
        title = f"{programs.built_in(name).title.capitalize()}, as cards"
        yield Download(f"{name}.f", title, "the thesis's; quoted", {f"{name}.f": text})
    decks = [name for name in sources if name.startswith(("fortran_src/", "transcripts/")) and name.endswith(_DEVICES)]
    yield Download("decks.zip", "All data decks, punched cards and typed lines", "the thesis's; quoted", _read(decks))
    documents = {name: text.encode() for name, text in archive(version).items()}
    yield Download("tei.zip", "The edition in TEI P5, with its schema and ODD", "CC0", documents)
    tables = [name for name in sources if name.startswith(("docs/studies", "docs/weight")) and name.endswith(_TABLES)]
    yield Download("tables.zip", "All tables of the studies", "CC0", _read(tables))
    registers = [n for n in sources if n.endswith(".toml") and n.startswith(("fortran_src/apparatus", "transcripts/"))]
    yield Download("registers.zip", "The apparatus and the verdicts", "CC0", _read(registers))


def _read(names: Iterable[str]) -> Mapping[str, bytes]:
    return {name: (ROOT / name).read_bytes() for name in names}


def write(folder: Path) -> None:
    """Write all downloads into a new folder.  The same files always give the same bytes."""
    folder.mkdir()
    for item in downloads():
        data = zipped(item.files) if item.packed else next(iter(item.files.values()))
        (folder / item.name).write_bytes(data)
