"""SOURCES.toml: every witness is a stated excerpt with a hash, and every row leads to a page and a line."""

import re
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest

from modern.claims.apparatus_checks import check_sources, texts
from modern.edition import sources
from modern.edition.apparatus import ApparatusError
from modern.edition.sources import Stretch, digest, place, read
from tests.support.paths import ROOT

TEXTS = texts()
TABLE = sources.sources()


def test_excerpts_and_ground_decks_have_their_hashes() -> None:
    witnesses = {str(path.relative_to(ROOT)) for path in ROOT.glob("*/witness/*.txt")}
    witnesses |= {str(path.relative_to(ROOT)) for path in ROOT.glob("transcripts/*/witness.txt")}
    assert {excerpt.file for excerpt in TABLE.excerpts} == witnesses
    assert {excerpt.text for excerpt in TABLE.excerpts} == set(TEXTS)
    assert {excerpt.document for excerpt in TABLE.excerpts} <= {document.id for document in TABLE.documents}
    assert all(proof.holds for proof in check_sources())
    decks = {str(path.relative_to(ROOT)) for path in (ROOT / "fortran_src" / "grounds").glob("*.deck")}
    assert {file for file, _ in TABLE.decks} == decks
    assert digest("## page 1\na\n## page 2\nb\n") == digest("a\nb\n") != digest("a\nc\n")


def test_a_changed_character_is_noticed(monkeypatch) -> None:
    """Change one character in each witness and each deck, one file at a time."""
    for name in [excerpt.file for excerpt in TABLE.excerpts] + [file for file, _ in TABLE.decks]:

        def changed(file: str, name: str = name) -> str:
            text = read(file)
            return text[:-2] + ("1" if text[-2] != "1" else "2") + text[-1:] if file == name else text

        with monkeypatch.context() as patch:
            patch.setattr(sources, "read", changed)
            assert sum(not proof.holds for proof in check_sources()) == 1, name


def test_every_line_with_words_is_a_line_of_the_document() -> None:
    for excerpt in TABLE.excerpts:
        document = TABLE.document(excerpt.document)
        lines = [line for line in read(excerpt.file).split("\n") if not line.startswith("## page ")]
        for number, line in enumerate(lines, 1):
            if line.strip():
                document_line = excerpt.line(number)
                assert document_line is not None, (excerpt.file, number)
                assert 1 <= document_line <= document.lines


def test_documents_state_pages_facts_and_folders() -> None:
    # They hold numbers, tables, captions and formulas: no line has more than 14 words.
    for excerpt in TABLE.excerpts:
        if excerpt.document != "butler-1963":
            for line in read(excerpt.file).split("\n"):
                assert len(re.findall(r"[A-Za-z]{2,}", line)) <= 14, line
    # The last line of each text has no line end, but it is counted and belongs to a page.
    for document in TABLE.documents:
        assert document.pages[-1][2] == document.lines
        for (_, first, last), (_, after, _) in pairwise(document.pages):
            assert first <= last < after
    for document in TABLE.documents:
        for field in ("author", "title", "year", "institution", "volume", "extent", "doi", "held", "rights"):
            assert getattr(document, field) or (field, document.id) == ("volume", "butler-1963")
        assert len(document.sha256) == 64
        assert "unknown" in document.held
    license_ = Path(ROOT / "LICENSE").read_text(encoding="utf-8")
    for excerpt in TABLE.excerpts:
        folder = str(Path(excerpt.file).parent)
        assert folder in license_, folder


def test_a_row_leads_to_its_page_and_its_line() -> None:
    """The first line of program 1 is line 822 of the thesis's text (page 64)."""
    assert place("program1", "2") == "line 823 of butler-1963"
    assert place("program1", "P1-008.16") == ""
    for text in TEXTS.values():
        for row in text.rows:
            assert row.page or text.id in ("kovalevsky_schulz", "nakamae_nishita_1972")
            assert any(place(text.id, c.line) or not c.line.isdigit() for c in row.changes)


def test_the_whole_text_is_compared_with_its_excerpts(monkeypatch) -> None:
    with pytest.raises(ApparatusError, match=r"^a\.txt: expected the text .* SHA-256 ca978112ca1bbdca"):
        list(check_sources(("a.txt", "a")))
    with pytest.raises(ApparatusError, match="expected the text"):
        list(check_sources(("empty.txt", "")))  # an empty file is not the same as no file
    whole = "first\nalpha beta gamma"
    excerpt = sources.Excerpt("t", "w.txt", "d", "", (Stretch(1, 1, 2, True),))
    names = ("id", "author", "title", "year", "kind", "institution", "volume", "extent", "doi", "held")
    document = sources.Document(**dict.fromkeys(names, "d"), sha256=digest(whole), bytes=22, characters=22, lines=2,
                                rights="", pages=())  # fmt: skip
    monkeypatch.setattr(sources, "sources", lambda: sources.Sources((document,), (excerpt,), (), ()))
    for witness, holds in (("alpha gamma\n", True), ("gamma alpha\n", False), ("beta gamma\n", True)):
        monkeypatch.setattr(sources, "read", lambda file, witness=witness: witness)
        assert [same for _, same, _ in sources.check_against("whole.txt", whole)] == [True, holds]
    for wrong in ({"lines": 1}, {"bytes": 21}, {"characters": 23}):
        table = sources.Sources((replace(document, **wrong),), (), (), ())
        monkeypatch.setattr(sources, "sources", lambda table=table: table)
        assert [same for _, same, _ in sources.check_against("whole.txt", whole)] == [False]
