"""The documents of the edition, and the excerpts of their OCR texts that serve as witnesses.

The data are in ``fortran_src/SOURCES.toml``.  The project works from the OCR text of each document, but contains only
the excerpts.  SOURCES.toml records a hash of each excerpt, and the lines of the document from which its lines were
copied.  :func:`check_files` verifies the hashes.  For a user who has the whole text of a document,
:func:`check_against` compares the excerpts with this text.
"""

import hashlib
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from modern.edition.apparatus import PAGE_MARK, ApparatusError


@dataclass(frozen=True, slots=True)
class Document:
    """A document, as SOURCES.toml describes it.

    ``bytes``, ``characters`` and ``lines`` are the size of its OCR text.  ``pages`` has the name, the first and the
    last line of each page.
    """

    id: str
    author: str
    title: str
    year: str
    kind: str
    institution: str
    volume: str
    extent: str
    doi: str
    held: str
    sha256: str
    bytes: int
    characters: int
    lines: int
    rights: str
    pages: tuple[tuple[str, int, int], ...]


@dataclass(frozen=True, slots=True)
class Stretch:
    """A range of lines of a witness, and the lines of the document from which they were copied.

    ``at`` is the number of the first line in the document.  If ``part``, the witness has only some of the words of each
    line.
    """

    first: int
    last: int
    at: int
    part: bool


@dataclass(frozen=True, slots=True)
class Excerpt:
    """An excerpt of a document, which is the witness of a text.

    ``text`` is the id of the text, ``document`` is the id of the document, and ``stretches`` has the copied lines.
    """

    text: str
    file: str
    document: str
    sha256: str
    stretches: tuple[Stretch, ...]

    def line(self, witness_line: int) -> int | None:
        """Return the number of the document's line from which a witness line was copied.

        Return None for a blank line between two stretches.
        """
        for stretch in self.stretches:
            if stretch.first <= witness_line <= stretch.last:
                return stretch.at + witness_line - stretch.first
        return None


@dataclass(frozen=True, slots=True)
class Transcription:
    """Another transcription of a document.

    ``file`` is the file of its collation, and ``sha256`` is the hash of this file.  Both are empty if there is no
    collation.
    """

    id: str
    document: str
    title: str
    address: str
    held: str
    independence: str
    file: str = ""
    sha256: str = ""


@dataclass(frozen=True, slots=True)
class Sources:
    """The contents of SOURCES.toml.

    ``decks`` has the file and the hash of each data deck that supports an emendation.  ``layered`` has the hash of the
    cards of each program with one optional layer: program, layer, hash.
    """

    documents: tuple[Document, ...]
    excerpts: tuple[Excerpt, ...]
    decks: tuple[tuple[str, str], ...]
    layered: tuple[tuple[str, str, str], ...]
    transcriptions: tuple[Transcription, ...] = ()

    def document(self, name: str) -> Document:
        return next(document for document in self.documents if document.id == name)

    def collated(self, document: str) -> tuple[Transcription, ...]:
        """Return the transcriptions of a document whose collations are in the project."""
        return tuple(entry for entry in self.transcriptions if entry.document == document and entry.file)

    def excerpt(self, text: str) -> Excerpt:
        """Return the excerpt that is the witness of a text.  Raise ApparatusError if there is none."""
        for excerpt in self.excerpts:
            if excerpt.text == text:
                return excerpt
        raise ApparatusError(f"SOURCES.toml: {text} has no witness")


# The fields of a document that have another name in SOURCES.toml.
_RENAMED = {"pages": "extent", "held_lines": "lines", "pages_of_lines": "pages"}


@cache
def sources() -> Sources:
    """Return the contents of SOURCES.toml."""
    data = tomllib.loads(files("fortran_src").joinpath("SOURCES.toml").read_text(encoding="utf-8"))
    return Sources(
        tuple(map(_document, data["document"])),
        tuple(map(_excerpt, data["excerpt"])),
        tuple((raw["file"], raw["sha256"]) for raw in data["deck"]),
        tuple((raw["program"], raw["layer"], raw["sha256"]) for raw in data["layered"]),
        tuple(Transcription(**raw) for raw in data["transcription"]),
    )


def _document(raw: Mapping[str, Any]) -> Document:
    values = {_RENAMED.get(name, name): value for name, value in raw.items()}
    return Document(**{**values, "pages": tuple(map(tuple, values["pages"]))})


def _excerpt(raw: Mapping[str, Any]) -> Excerpt:
    lines = tuple(
        Stretch(first, last, s["document"], s.get("part", False))
        for s in raw["lines"]
        for first, last in [s["witness"]]
    )
    return Excerpt(raw["text"], raw["file"], raw["document"], raw["sha256"], lines)


def read(file: str) -> str:
    """Return the text of a data file, given by its path in the project."""
    package, *parts = file.split("/")
    return files(package).joinpath(*parts).read_text(encoding="utf-8")


def digest(text: str) -> str:
    """Return the SHA-256 of a text without the page marks."""
    unmarked = "".join(line for line in text.splitlines(keepends=True) if not line.startswith(PAGE_MARK))
    return hashlib.sha256(unmarked.encode()).hexdigest()


def check_files() -> Iterator[tuple[str, bool, str]]:
    """Check the hash of each excerpt, of each collation and of each deck of a ground.

    Yield triples: the name of the file, True if the hash is right, and a message.  All decks have one triple, with the
    name ``grounds``.
    """
    table = sources()
    recorded = []
    for excerpt in table.excerpts:
        count = sum(s.last - s.first + 1 for s in excerpt.stretches)
        recorded.append((excerpt.file, excerpt.sha256, f"{count} lines of {excerpt.document}"))
    recorded += [(entry.file, entry.sha256, "a collation") for entry in table.transcriptions if entry.file]
    for file, sha256, message in recorded:
        same = digest(read(file)) == sha256
        yield file, same, message if same else "CHANGED: its hash is not that of SOURCES.toml"
    wrong = [file for file, sha in table.decks if digest(read(file)) != sha]
    yield "grounds", not wrong, f"CHANGED: {', '.join(wrong)}" if wrong else f"{len(table.decks)} decks"


def check_against(name: str, text: str) -> Iterator[tuple[str, bool, str]]:
    """Compare the whole text of a document, the contents of the file ``name``, with its recorded size and excerpts.

    Yield triples: the subject, True if it agrees, and a message.  Raise ApparatusError if the text is not that of a
    document.
    """
    sha = hashlib.sha256(text.encode()).hexdigest()
    table = sources()
    known = [document for document in table.documents if document.sha256 == sha]
    if not known:
        raise ApparatusError(
            f"{name}: expected the text of a document; none in SOURCES.toml has the SHA-256 {sha[:16]}"
        )
    whole = text.split("\n")
    document = known[0]
    size = (len(text.encode()), len(text), len(whole))
    same = size == (document.bytes, document.characters, document.lines)
    message = "{} bytes, {} characters, {} lines".format(*size)
    yield document.id, same, message if same else f"DIFFERS from SOURCES.toml: {message}"
    for excerpt in table.excerpts:
        if excerpt.document != document.id:
            continue
        lines = [line for line in read(excerpt.file).split("\n") if not line.startswith(PAGE_MARK)]
        wrong = [n for s in excerpt.stretches for n in range(s.first, s.last + 1) if not _same(lines, whole, s, n)]
        message = f"DIFFERS from {document.id} in line {wrong[0]}" if wrong else f"equal to the lines of {document.id}"
        yield excerpt.file, not wrong, message


def _same(lines: list[str], whole: list[str], stretch: Stretch, number: int) -> bool:
    witness_line, document_line = lines[number - 1], whole[stretch.at + number - stretch.first - 1]
    if not stretch.part:
        return witness_line == document_line
    # The witness may omit words but not change their order, so each word is searched for in the rest of the line.
    rest = iter(document_line.split())
    return witness_line.strip() in document_line or all(word in rest for word in witness_line.split())


def place(text: str, line: str) -> str:
    """Return the place of a line in its document, such as ``line 17 of butler-1963``.

    Return an empty text for an inserted card.
    """
    document_line = sources().excerpt(text).line(int(line)) if line.isdigit() else None
    return f"line {document_line} of {sources().excerpt(text).document}" if document_line else ""
