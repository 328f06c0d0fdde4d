"""Where every text comes from: documents, the excerpts of them that are witnesses, and the way back to a line.

The data are ``fortran_src/SOURCES.toml``.  Of each document the project has used the text an OCR made; that text is no
part of it, a witness is a stated excerpt with its own hash.  :func:`check_files` compares the hashes with what is
there, :func:`check_against` the excerpts with the whole text of a document, for whoever holds it.
"""

from __future__ import annotations

import hashlib
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from modern.edition.apparatus import PAGE_MARK, ApparatusError


@dataclass(frozen=True, slots=True)
class Document:
    """A document and what is held of it: its OCR text by SHA-256 and length.

    ``lines`` counts the last one too, which has no line end; ``pages`` says of lines of that text (first, last) what
    pages they are; "unknown" stands where a fact is.
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
    """Lines ``first`` to ``last`` of a witness are the document's from ``at`` on; with ``part``, words of them."""

    first: int
    last: int
    at: int
    part: bool


@dataclass(frozen=True, slots=True)
class Excerpt:
    """A witness: the text (of the apparatus) it is of, its file, its document, its hash and its lines."""

    text: str
    file: str
    document: str
    sha256: str
    stretches: tuple[Stretch, ...]

    def line(self, witness_line: int) -> int | None:
        """The document's line a witness line is; None for one of ours (blank, between two stretches)."""
        for stretch in self.stretches:
            if stretch.first <= witness_line <= stretch.last:
                return stretch.at + witness_line - stretch.first
        return None


@dataclass(frozen=True, slots=True)
class Sources:
    """All of SOURCES.toml; ``decks`` are files of ours and their hashes."""

    documents: tuple[Document, ...]
    excerpts: tuple[Excerpt, ...]
    decks: tuple[tuple[str, str], ...]

    def document(self, name: str) -> Document:
        return next(document for document in self.documents if document.id == name)

    def excerpt(self, text: str) -> Excerpt:
        """The excerpt that is the witness of a text.  Raises ApparatusError."""
        for excerpt in self.excerpts:
            if excerpt.text == text:
                return excerpt
        raise ApparatusError(f"SOURCES.toml: no excerpt is the witness of {text}")


@cache
def sources() -> Sources:
    """The table of sources."""
    data = tomllib.loads(files("fortran_src").joinpath("SOURCES.toml").read_text(encoding="utf-8"))
    return Sources(
        tuple(
            Document(
                **{name: raw[name] for name in ("id", "author", "title", "year", "kind", "institution", "volume")},
                extent=raw["pages"],
                **{name: raw[name] for name in ("doi", "held", "sha256", "bytes", "characters")},
                lines=raw["held_lines"],
                rights=raw["rights"],
                pages=tuple((page, first, last) for page, first, last in raw["pages_of_lines"]),
            )
            for raw in data["document"]
        ),
        tuple(
            Excerpt(
                raw["text"],
                raw["file"],
                raw["document"],
                raw["sha256"],
                tuple(
                    Stretch(s["witness"][0], s["witness"][1], s["document"], s.get("part", False)) for s in raw["lines"]
                ),
            )
            for raw in data["excerpt"]
        ),
        tuple((raw["file"], raw["sha256"]) for raw in data["deck"]),
    )


def read(file: str) -> str:
    """A data file by its path in the project, in a checkout or an installed wheel."""
    package, *parts = file.split("/")
    return files(package).joinpath(*parts).read_text(encoding="utf-8")


def digest(text: str) -> str:
    """SHA-256 of a text without our page marks."""
    kept = "".join(line for line in text.splitlines(keepends=True) if not line.startswith(PAGE_MARK))
    return hashlib.sha256(kept.encode()).hexdigest()


def check_files() -> Iterator[tuple[str, bool, str]]:
    """Each excerpt and each deck of a ground: its file, whether it has its hash, and words."""
    table = sources()
    for excerpt in table.excerpts:
        same = digest(read(excerpt.file)) == excerpt.sha256
        count = sum(s.last - s.first + 1 for s in excerpt.stretches)
        words = f"{count} lines of {excerpt.document}"
        yield excerpt.file, same, words if same else f"it is NOT the excerpt of {excerpt.document} it was"
    wrong = [file for file, sha in table.decks if digest(read(file)) != sha]
    yield "grounds", not wrong, f"{len(table.decks)} decks" if not wrong else f"{', '.join(wrong)}: NOT as it was"


def check_against(text: str) -> Iterator[tuple[str, bool, str]]:
    """The length of the document whose whole text this is, and each of its excerpts, compared line by line.

    Raises ApparatusError for a text that is none of the documents'.
    """
    sha = hashlib.sha256(text.encode()).hexdigest()
    table = sources()
    known = [document for document in table.documents if document.sha256 == sha]
    if not known:
        raise ApparatusError(f"a text with SHA-256 {sha[:16]}... is none of the documents in SOURCES.toml")
    whole = text.split("\n")
    document = known[0]
    found = (len(text.encode()), len(text), len(whole))
    same = found == (document.bytes, document.characters, document.lines)
    words = "{} bytes, {} characters, {} lines".format(*found)
    yield document.id, same, words if same else f"it has {words}, NOT as SOURCES.toml says"
    for excerpt in table.excerpts:
        if excerpt.document != document.id:
            continue
        lines = [line for line in read(excerpt.file).split("\n") if not line.startswith(PAGE_MARK)]
        wrong = [n for s in excerpt.stretches for n in range(s.first, s.last + 1) if not _same(lines, whole, s, n)]
        words = f"its lines are those of {document.id}" if not wrong else f"line {wrong[0]} is NOT the text's"
        yield excerpt.file, not wrong, words


def _same(lines: list[str], whole: list[str], stretch: Stretch, number: int) -> bool:
    mine, other = lines[number - 1], whole[stretch.at + number - stretch.first - 1]
    if not stretch.part:
        return mine == other
    rest = iter(other.split())
    return mine.strip() in other or all(word in rest for word in mine.split())


def place(text: str, line: str) -> str:
    """Where a line of a witness stands: the line of its document's text; empty for a card a row put in."""
    found = sources().excerpt(text).line(int(line)) if line.isdigit() else None
    return f"line {found} of {sources().excerpt(text).document}" if found else ""
