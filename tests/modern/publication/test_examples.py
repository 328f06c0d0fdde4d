"""The data behind the pages of examples, statements, faults and questions."""

import re
from xml.etree.ElementTree import fromstring

import pytest

from modern.claims.register import DOCUMENTS, statements_of
from modern.edition.chapter6 import EXAMPLES, prints
from modern.edition.chapter6_cards import load_chapter
from modern.edition.sources import read
from modern.publication.examples import differing, example, homes, rest
from modern.publication.numbered import numbered
from modern.publication.site.made import make
from modern.publication.site.pages.texts import FILES


def parsed(html: str) -> None:
    """Parse HTML as XML, with void elements closed, and fail if its elements are not nested correctly."""
    closed = re.sub(r"<(input|br|img|hr|col)\b([^>]*)>", r"<\1\2/>", html).replace("&nbsp;", " ")
    closed = re.sub(r" (checked|hidden|disabled|open)(?=[ />])", r' \1=""', closed)
    fromstring(f"<x>{closed.replace('<wbr>', '')}</x>")


@pytest.mark.parametrize("number", EXAMPLES)
def test_every_card_of_the_print_and_of_the_run_is_shown(number: int) -> None:
    shown = {(part.program, part.device): [card.print for card in part.cards] for part in example(number)}
    for printed in prints(number):
        assert shown[printed.program, printed.device] == list(printed.lines)
    for part in example(number):
        if part.reports:
            produced = next(r.produced for r in part.reports if r.state == "examples")
            assert [card.run for card in part.cards] == list(produced)
            assert all(not card.differs for card in part.cards), "every example is reproduced to the character"
        else:
            assert part.device == "deck"


@pytest.mark.parametrize("number", EXAMPLES)
def test_every_line_of_the_witness_is_shown_once_with_its_text(number: int) -> None:
    witness = {line.id: line.text for line in load_chapter().text.witness}
    for part in example(number):
        sources = [source for card in part.cards for source in card.sources]
        assert len({source.line for source in sources}) == len(sources)
        assert all(source.text == witness[source.line] for source in sources)
        assert bool(sources) != part.stated


def test_changes_and_rows_of_chapter_6_are_shown_in_their_examples() -> None:
    card = example(1)[0].cards[1]
    (source,) = card.sources
    assert source.text == "- +.20000000E+01-.50000000E+01+.20000000E+02"
    assert source.changed == ((0, 2),)
    assert source.at == 1823
    touched = {row.id for number in EXAMPLES for part in example(number) for row in part.rows}
    assert set(homes()) == touched
    others = {row.id for row in rest()}
    assert {row.id for row in load_chapter().text.rows} == touched | others
    assert others == {"C6-009", "C6-084", "C6-277"}, "what stands between the cards"
    (section,) = make("example", "rest")
    assert set(re.findall(r'<article [^>]*id="([^"]+)"', section.html)) == others


@pytest.mark.parametrize(
    ("expected", "actual", "spans"),
    [
        ("abc", "abc", ()),
        ("abc", "axc", ((1, 2),)),
        ("abc", "abcd", ((3, 4),)),
        ("abcd", "abc", ((0, 3),)),
        ("", "x", ((0, 1),)),
    ],
)
def test_differing_returns_the_spans_that_differ(expected, actual, spans) -> None:
    assert differing(expected, actual) == spans


@pytest.mark.parametrize("number", EXAMPLES)
def test_the_html_of_an_example_is_well_formed(number: int) -> None:
    made = make("example", str(number))
    for part in made:
        parsed(part.html)
    ids = re.findall(r'\bid="([^"]+)"', "".join(part.html for part in made))
    assert len(ids) == len(set(ids))
    assert {part.id for part in example(number)} <= {part.id for part in made}


@pytest.mark.parametrize("name", DOCUMENTS)
def test_every_statement_is_on_its_page_with_its_verdict(name: str) -> None:
    made = make("statements", name)
    html = "".join(part.html for part in made)
    parsed(html)
    for row in statements_of(name):
        assert html.count(f'id="{row.id}"') == 1
    assert html.count("<strong>does not hold</strong>") == sum(
        r.verdict == "does not hold" for r in statements_of(name)
    )


@pytest.mark.parametrize("file", FILES)
def test_numbered_items_are_complete(file: str) -> None:
    opening, items, closing = numbered(file)
    source = read(file)
    assert opening
    assert len(items) == len(re.findall(r"^\d+\. ", source, re.MULTILINE))
    for item in items:
        assert item.title
        assert "\n" not in item.title
    words = re.sub(
        r"\W+", " ", " ".join([f"{i.title} {i.text} {i.preamble} {i.section}" for i in items]) + " ".join(closing)
    )
    for word in re.findall(r"\w{7,}", source.split("\n1. ", 1)[1]):
        assert word in words or word in opening, word
    sections = [part.id for part in make("texts", file) if part.id.startswith(f"{FILES[file]}-")]
    assert sections == [f"{FILES[file]}-{item.number}" for item in items]


def test_faults_show_their_decks_and_the_wrong_hull_its_card() -> None:
    _, items, _ = numbered("fortran_src/KNOWN-FAULTS.md")
    assert items[0].decks == ("lastpair",)
    html = "".join(part.html for part in make("texts", "fortran_src/KNOWN-FAULTS.md"))
    for item in items:
        for deck in item.decks:
            assert read(f"fortran_src/grounds/{deck}.deck").splitlines()[1] in html
    made = make("console", "wrong")
    html = "".join(part.html for part in made)
    parsed(html)
    assert "missed: point 1, point 2, point 3" in html
    assert re.search(r'href="@/program3\.html#\S+">program 3, ', html)


def test_items_out_of_order_are_rejected(tmp_path: object, monkeypatch) -> None:
    from pathlib import Path

    from modern.publication import numbered as module

    place = Path(str(tmp_path))
    (place / "x.md").write_text("# T\n\nWords.\n\n1. **One.** a\n3. **Three.** b\n")
    monkeypatch.setattr(module, "ROOT", place)
    with pytest.raises(ValueError, match=r"x\.md: the items are not numbered 1, 2, 3 and so on"):
        numbered("x.md")
