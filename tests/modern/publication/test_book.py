"""The book: text is never interpreted as markup, references resolve, and every card, row and statement occurs once."""

import json
import re
import sys
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from modern.claims.apparatus_checks import texts
from modern.claims.register import DOCUMENTS, statements_of
from modern.edition import programs
from modern.edition.sources import sources
from modern.publication.book import build as book
from modern.publication.book.markup import Markdown, columns_of, label, say, string, table
from modern.publication.book.parts import examples, fitted, listings, statements
from modern.publication.commentary import commentary
from modern.publication.facing import facing

compiler = pytest.importorskip("typst", reason="the book is set by typst")


def unescaped(written: str) -> str:
    """Return the text that Typst reads in a string of its code mode."""
    unquoted = re.sub(r'\\(["\\n])', lambda m: "\n" if m[1] == "n" else m[1], written[1:-1])
    return re.sub(r"\[U\+([0-9A-F]+)\]", lambda m: chr(int(m[1], 16)), unquoted)


@given(st.text(st.characters(exclude_characters="\t[]", exclude_categories=["Cs"]), max_size=40))
@settings(deadline=None)
def test_text_is_preserved(text: str) -> None:
    assert unescaped(string(text)) == text


def test_characters_are_no_markup_and_pictures_use_the_fonts(tmp_path: Path) -> None:
    text = '= #let x = 1 ; *a* _b_ `c` $d$ <e> @f [g] // h \\ i "j" - k + l / m ~ 1. n'
    (tmp_path / "b.typ").write_text(f"{say(text)}\n#metadata({string(text)}) <it>\n")
    (metadata,) = json.loads(compiler.query(str(tmp_path / "b.typ"), "<it>"))
    assert metadata["value"] == text
    text = '<text font-family="Helvetica, Arial, sans-serif">a</text>'
    svg = f'<svg><a href="x">{text}</a><style>.m{{font-family:monospace}}</style></svg>'
    sans = '<text font-family="IBM Plex Sans">a</text>'
    assert fitted(svg) == f"<svg>{sans}<style>.m{{font-family:'IBM Plex Mono'}}</style></svg>"


@given(st.text(max_size=20), st.text(max_size=20))
@settings(deadline=None)
def test_different_texts_have_different_labels(first: str, second: str) -> None:
    assert re.fullmatch(r"[A-Za-z0-9.-]*", label(first))
    if first.replace(" ", "-").replace("_", "-") != second.replace(" ", "-").replace("_", "-"):
        assert label(first) != label(second)


def typst(text: str, name: str = "how-to/x.md", known: tuple[str, ...] = ()) -> str:
    return Markdown(name, known, lambda file: "").typst(text)


def test_markdown_is_translated_with_titles_and_aligned_numbers() -> None:
    markup = typst("# A *b*\n\nSee `c` and [d](../e.md#f).\n\n- one\n- two\n\n| x | y |\n|---|---|\n| 1 | 2 |\n")
    title, paragraph, items, table_ = [part for part in markup.split("\n\n") if part]
    assert title == f'#[] <{label("how-to/x.md")}>\n== #"A b"; <{label("how-to/x.md", "a-b")}>'
    assert paragraph == '#"See ";#raw("c");#" and ";#"d";#".";', "a link that leads out of the book is plain text"
    assert items.split() == '#list([#"one"; ], [#"two"; ])'.split()
    assert table_.startswith("#tabular(8.5pt, (auto, auto,), ")
    assert typst("**Sizes**\n\n| a |\n|---|\n| 1 |\n").startswith("#block(sticky: true, [#strong[")
    for paragraph in ("**Sizes** of sets\n", "Of **sizes**\n", "Sizes\n"):
        assert "sticky" not in typst(paragraph)
    markup = typst("| set | share | note |\n|---|---|---|\n| a | 1.5 (1.2 to 1.8) % | x |\n| b | - | 3 |\n")
    assert "(left, right, left,)" in markup


def test_links_are_references_within_the_book() -> None:
    known = (label("e.md", "f"), label("e.md"))
    assert f"#to(<{label('e.md', 'f')}>)" in typst("See [d](../e.md#f).", known=known)
    assert f"#to(<{label('e.md')}>)" in typst("See [d](../e.md#gone).", known=known)


def test_an_element_that_the_book_cannot_print_is_rejected() -> None:
    with pytest.raises(ValueError, match=r"^how-to/x\.md: the book cannot print an element of the type hr$"):
        typst("a\n\n***\n")


WIDTHS = st.lists(st.tuples(st.integers(1, 12), st.integers(0, 80)), min_size=1, max_size=12)


@given(WIDTHS)
def test_no_column_is_narrower_than_its_longest_word(columns: list[tuple[int, int]]) -> None:
    words = [word for word, _ in columns]
    widths = [word + more for word, more in columns]
    size, shares = columns_of(widths, words)
    assert 5 <= size <= 8.5
    if set(shares) == {"auto"}:
        assert sum(widths) + 2 * len(widths) <= 104
        return
    parts = [float(share.removesuffix("fr")) for share in shares]
    room = 104 * 8.5 / size
    if size > 5:
        assert all(room * part / sum(parts) > word for part, word in zip(parts, words, strict=True))


def test_wide_tables_are_broken_set_smaller_or_refused() -> None:
    assert "#tabular(8.5pt, (7.0fr, 97.0fr,)" in table(["a", "b"], [["x", "y"]], (5, 200))
    assert "#tabular(8.5pt, (auto, auto,)" in table(["a", "b"], [["x", "y"]], (5, 20))
    assert "#tabular(6.8pt, (32fr, 32fr, 32fr, 32fr,)" in table("abcd", ["abcd"], (30, 30, 30, 30))
    assert "#tabular(8.5pt" in table("ab", ["xy"], (60, 60)), "a sentence is broken"
    with pytest.raises(ValueError, match=r"the table a \| b needs letters of 4\.6 pt; the smallest are 6\.5 pt"):
        table(["a", "b"], [["x", "y"]], (96, 96), (93, 93))


def test_a_table_that_is_too_wide_is_split_and_both_halves_name_the_rows() -> None:
    rows = [["x", str(n), *"cdefgh"] for n in range(3)]
    halves = table("abCDEFGH", rows, (20,) * 8, (20,) * 8, (1, 3, 7)).split("#tabular")[1:]
    assert [re.findall(r"strong\(\[(.)\]\)", half) for half in halves] == [[*"abCDE"], [*"abFGH"]]
    assert ["(left, right, left, right, left,)" in halves[0], "(left, right, left, left, right,)" in halves[1]] == [
        True
    ] * 2
    assert all(float(half[1:4]) >= 6.5 for half in halves)


def test_every_card_row_comment_and_variable_of_the_listings_occurs_once() -> None:
    markup = "".join(listings())
    for name in programs.TEXTS:
        for card in facing(name).cards:
            assert markup.count(f" <{label('card', name, card.place)}>") == 1
        for row in texts()[name].rows:
            assert markup.count(f" <{label('row', row.id)}>") == 1
        for block in commentary(name).blocks:
            assert string(" ".join(block.text.split())) in markup
        assert {f"{variable.name} ({name})" for variable in commentary(name).variables} <= indexed(markup)


def test_variants_statements_and_notes_are_shown_once() -> None:
    markup = "".join(listings())
    cards = facing("program1_examples").cards
    shown = [card for card in cards if f" <{label('card', 'program1_examples', card.place)}>" in markup]
    new = {card.text for card in cards} - {card.text for card in facing("program1").cards}
    assert new <= {card.text for card in shown}
    assert len(shown) < len(cards) / 2
    markup = "".join(examples(lambda name, svg: name))
    reason = "The OCR dropped a zero from a run of zeros."
    rows = [row for row in texts()["chapter6"].rows if row.reason == reason]
    assert len(rows) > 100
    assert markup.count(reason) <= 6, "one note in each example"
    markup = "".join(statements())
    for name in DOCUMENTS:
        for row in statements_of(name):
            assert markup.count(f"<{label('row', row.id)}>") == 1
    for _, chapter in book.CHAPTERS:
        for name in chapter:
            assert name.startswith("@") or (book.DOCS / name).is_file()


def indexed(markup: str) -> set[str]:
    return set(re.findall(r'#idx\("([^"]+)"\);', markup))


def test_the_book_indexes_terms_and_names_its_sources(whole: tuple[str, Path]) -> None:
    entries = indexed(whole[0])
    assert {"Butler, Karen Jensen", "Yau, M.-M.", "apparatus", "ATTN", "quickhull", "NE (program3)"} <= entries
    front = whole[0].partition("#outline")[0]
    for text in ("Edition 0.1.0", "CC0 1.0", "MIT licence", "have not seen its pages", "IBM Plex"):
        assert text in front
    bibliography = whole[0].partition('= #"Bibliography";')[2]
    assert all(document.title in bibliography for document in sources().documents)
    assert "doi:10.1147/rd.206.0590" in bibliography


@pytest.fixture(scope="module")
def whole(tmp_path_factory) -> tuple[str, Path]:
    folder = tmp_path_factory.mktemp("book")
    return book.typst(folder), folder


def test_every_reference_of_the_book_resolves(whole: tuple[str, Path]) -> None:
    text, folder = whole
    labels = re.findall(r" <([\w.-]+)>", text)
    assert len(labels) == len(set(labels)), sorted({name for name in labels if labels.count(name) > 1})[:5]
    assert not re.search(r'\{[a-z]+\}";#raw', text), "the book has no roles"
    references = set(re.findall(r"#(?:to|link)\(<([\w.-]+)>\)", text))
    assert len(references) > 50
    assert references <= set(labels)
    pictures = set(re.findall(r'"([\w.-]+\.svg)"', text))
    assert pictures == {file.name for file in folder.iterdir()}


def test_the_book_is_pdf_a(whole: tuple[str, Path]) -> None:
    """Typst checks the rules of PDF/A-2a when it writes the file; this test checks the parts that a reader relies on.

    No independent validator, such as veraPDF, has been run.
    """
    text, folder = whole
    made = book.pdf(text, folder)
    assert made.startswith(b"%PDF-1.7")
    assert b"<pdfaid:part>2</pdfaid:part>" in made
    assert {b"IBMPlexSerif", b"IBMPlexSans", b"IBMPlexMono"} <= {
        name[:-7] for name in re.findall(rb"IBMPlex\w+-Regular", made)
    } | set(re.findall(rb"\+(IBMPlex(?:Serif|Sans|Mono))", made))
    assert b"<pdfaid:conformance>A</pdfaid:conformance>" in made
    for needed in (b"/Marked true", b"/StructTreeRoot", b"/Lang(en)", b"/S/GTS_PDFA1", b"/S/H1", b"/S/TH"):
        assert needed in made
    for forbidden in (b"/Encrypt", b"/JavaScript", b"/Launch", b"/EmbeddedFile"):
        assert forbidden not in made
    embedded = len(re.findall(rb"/FontFile\d? ", made))
    assert made.count(b"/Type/FontDescriptor") == embedded == made.count(b"/ToUnicode ") > 5, "every font is embedded"
    assert len(re.findall(rb"/S/Figure\b", made)) == len(re.findall(rb"/Alt\b", made)) > 50


def test_without_typst_the_message_names_the_package(tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.setattr(book, "typst", lambda folder: "")
    monkeypatch.setitem(sys.modules, "typst", None)
    assert book.main([str(tmp_path / "x.pdf")]) == 2
    assert capsys.readouterr().err == f"book: {book.MISSING_TYPST}\n"
    assert not (tmp_path / "x.pdf").exists()


def test_raised_digits_become_superscripts() -> None:
    assert say("e = 10\u207b\u2076.") == '#"e = 10";#super("\u22126");#".";'
    assert say("") == ""
