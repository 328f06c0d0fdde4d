"""The TEI documents are valid and complete: witness, decks and cards can be restored byte for byte."""

import random
import re
from functools import cache
from pathlib import Path
from xml.etree.ElementTree import Element, fromstring

import pytest
from lxml import etree

from modern.claims.apparatus_checks import texts
from modern.claims.register import DOCUMENTS, statements_of
from modern.edition.chapter6_cards import device_files, load_chapter
from modern.edition.programs import BUILT_INS, TEXTS
from modern.edition.sources import read, sources
from modern.publication import tei_reading as reading
from modern.publication.commentary import commentary
from modern.publication.tei import documents, tei
from modern.publication.tei_header import CERTAINTY, PATCHES
from modern.publication.tei_schema import odd, schema
from tests.support.commands import call

TEI = "{http://www.tei-c.org/ns/1.0}"
ID = "{http://www.w3.org/XML/1998/namespace}id"
NAMES = tuple(texts())


@cache
def written(name: str) -> str:
    return tei(name, "0.0")


@cache
def own() -> etree.RelaxNG:
    return etree.RelaxNG(etree.fromstring(schema().encode()))


def root(name: str) -> Element:
    return reading.parsed(name, written(name))


@pytest.mark.parametrize("name", documents())
def test_every_document_is_valid(name: str) -> None:
    own().assertValid(etree.fromstring(written(name).encode()))


@pytest.mark.parametrize("name", documents())
def test_every_reference_has_a_target(name: str) -> None:
    document = fromstring(written(name))
    ids = {element.get(ID) for element in document.iter() if element.get(ID)}
    for element in document.iter():
        for attribute in ("corresp", "target", "targetEnd", "ana", "wit", "who", "resp", "edRef"):
            for reference in element.get(attribute, "").split():
                file, _, target = reference.partition("#")
                if file.endswith(".xml"):
                    assert f' xml:id="{target}"' in written(file.removesuffix(".xml")), reference
                elif reference.startswith("#"):
                    assert target in ids, reference


def test_the_odd_documents_every_element_and_no_more() -> None:
    specified = set(re.findall(r'<elementSpec ident="(\w+)"', odd()))
    assert all(re.search(rf'include="[^"]*\b{name}\b', odd()) for name in specified)
    used = {element.tag.removeprefix(TEI) for name in documents() for element in fromstring(written(name)).iter()}
    assert used == specified


@pytest.mark.parametrize(
    ("what", "instead"),
    [
        (' resp="#ed" cert="high"', ' resp="#ed" cert="certain"'),
        (' wit="#ocr"', ""),
        ("<lem ", "<lemma "),
        ('<div type="listing"', '<div type="lines"'),
        (' method="parallel-segmentation"', ' method="double-end-point"'),
        ('xml:id="P1-002"', 'xml:id="P1-001"'),
        (' type="typewriter"', ' type="screen"'),
        ('<corr type="epsilon"', '<corr cert="low" type="epsilon"'),
        ('when="1963"', 'when="June 1963"'),
    ],
)
def test_the_schema_rejects_other_documents(what: str, instead: str) -> None:
    name = "chapter6" if "typewriter" in what else "program1"
    assert what in written(name)
    changed = (
        written(name).replace(what, instead, 1).replace("</lem>", "</lemma>" if "lemma" in instead else "</lem>", 1)
    )
    try:
        document = etree.fromstring(changed.encode())
    except etree.XMLSyntaxError:
        assert "lemma" in instead or "xml:id" in instead
        return
    assert not own().validate(document)


@pytest.mark.parametrize("name", NAMES)
def test_the_witness_is_restored(name: str) -> None:
    assert reading.witness(root(name)) == read(sources().excerpt(name).file)


@pytest.mark.parametrize("name", TEXTS)
def test_the_deck_is_restored(name: str) -> None:
    assert reading.corrected(root(name)) == read(f"fortran_src/{name}.f")


def test_states_and_cards_are_restored_from_tei() -> None:
    layers = next(b.layers for b in BUILT_INS if b.name == "program1_examples")
    assert reading.corrected(root("program1"), layers) == read("fortran_src/program1_examples.f")
    files = [file for _, _, _, file in device_files(load_chapter())]
    assert list(reading.parts(root("chapter6"))) == files
    for file in files:
        assert reading.part(root("chapter6"), file) == read(f"transcripts/chapter6/{file}")
    changed = written("program2").replace("GO TO", "GO TQ", 1)
    decks = [reading.corrected(reading.parsed("x", source)) for source in (written("program2"), changed)]
    assert sum(a != b for a, b in zip(*decks, strict=True)) == 1


def test_rows_and_tokens_refer_to_the_print() -> None:
    document = fromstring(written("chapter6"))
    lines = {ab.get("{http://www.w3.org/XML/1998/namespace}id") for ab in document.iter(TEI + "ab")}
    ties = [seg.get("corresp", "") for seg in document.iter(TEI + "seg") if not seg.get(ID)]
    assert len(ties) > 1000
    assert {tie.removeprefix("#") for tie in ties} <= lines
    source = written("program1")
    assert re.search('<rdg type="rejected"', "".join(map(written, NAMES)))
    before = reading.corrected(reading.parsed("x", source))
    after = reading.corrected(reading.parsed("x", re.sub(r'(<rdg type="rejected"[^>]*>)[^<]*', r"\1NOT", source)))
    assert before == after


@pytest.mark.parametrize("name", NAMES)
def test_every_row_has_reason_evidence_certainty_and_rejected_readings(name: str) -> None:
    document = fromstring(written(name))
    apps = {app.get(ID): app for app in document.iter(TEI + "app")}
    for row in texts()[name].rows:
        app = apps[row.id]
        notes = {note.get("type"): note.text for note in app.iterfind(TEI + "note")}
        assert (notes["reason"], notes["evidence"]) == (row.reason, row.evidence)
        certainties = {element.get("cert") for element in (app, *app) if element.get("cert")}
        assert certainties == (set() if row.layer in PATCHES else {CERTAINTY[row.certainty]})
        rejected = [reading.text for reading in app.iterfind(TEI + "rdg") if reading.get("type") == "rejected"]
        assert rejected == [rejection.reading for rejection in row.rejected]
        ground = app.find(f"{TEI}note/{TEI}fs")
        assert (None if ground is None else ground.get("type")) == row.ground.get("kind")


@pytest.mark.parametrize("name", NAMES)
def test_apps_contain_readings_of_sources_only(name: str) -> None:
    document = fromstring(written(name))
    inline = [app for app in document.iter(TEI + "app") if app.find(TEI + "lem") is not None]
    assert not {app.get("type") for app in inline} & set(PATCHES)
    assert "columns" not in {app.get("ana", "").partition("#kind-")[2] for app in inline}
    assert "displaced" not in {
        app.get("ana", "").partition("#kind-")[2] for app in inline if app[0].text and app[1].text
    }
    assert all(choice.find(f"{TEI}corr").get("cert") is None for choice in document.iter(TEI + "choice"))


def test_displaced_pieces_return_to_the_places_of_the_print() -> None:
    source = written("chapter6")
    line = next(ab for ab in fromstring(source).iter(TEI + "ab") if ab.get(ID) == "chapter6-l81")
    assert [element.tag.removeprefix(TEI) for element in line][1:] == "anchor space anchor space space anchor".split()
    assert " 1 .00000000E-99 .71020000E+04 .00000000E-99\n" in reading.corrected(root("chapter6"))
    # Without its transposition a piece is lost, and the OCR text does not change.
    damaged = reading.parsed("x", source.replace('<ptr target="#C6-038-1" />', '<ptr target="#nowhere" />'))
    assert " .00000000E-99 .71020000E+04 .00000000E-99\n" in reading.corrected(damaged)
    assert reading.witness(damaged) == reading.witness(root("chapter6"))


@pytest.mark.parametrize("name", TEXTS)
def test_the_commentary_is_in_the_document(name: str) -> None:
    document = fromstring(written(name))
    lines = [ab.get(ID) for ab in document.iter(TEI + "ab")]
    notes = [note for note in document.iter(TEI + "note") if note.get("type") == "commentary"]
    assert [note.findtext(TEI + "label") for note in notes] == [block.title for block in commentary(name).blocks]
    for note in notes:
        first, last = (lines.index(note.get(end, "")[1:]) for end in ("target", "targetEnd"))
        assert first <= last
    labels = [label.text for label in document.iterfind(f".//{TEI}list/{TEI}label")]
    assert labels == [variable.name for variable in commentary(name).variables]


@pytest.mark.parametrize("document", DOCUMENTS)
def test_every_verdict_points_to_the_words_of_its_statement(document: str) -> None:
    tree = fromstring(written(f"statements-{document}"))
    quotations = {f"#{ab.get(ID)}": ab.findtext(TEI + "quote") for ab in tree.iter(TEI + "ab")}
    spans = list(tree.iter(TEI + "span"))
    assert [(span.get("target"), span.text) for span in spans] == [
        (f"#{row.id}", row.verdict) for row in statements_of(document)
    ]
    assert quotations == {f"#{row.id}": row.words for row in statements_of(document)}


def test_the_command_writes_reads_and_validates(tmp_path: Path, capsys) -> None:
    folder = tmp_path / "tei"
    assert call(capsys, "tei", "--all", str(folder)) == (0, "", "")
    assert {path.name for path in folder.iterdir()} == {
        *(f"{name}.xml" for name in documents()),
        "hull1620.rng",
        "hull1620.odd",
    }
    deck = read("fortran_src/program3.f")
    assert call(capsys, "tei", "--read", str(folder / "program3.xml")) == (0, deck, "")
    assert call(capsys, "tei", "--read", str(folder / "program3.xml"), "--witness")[1] == read(
        "fortran_src/witness/program3.txt"
    )
    card = read("transcripts/chapter6/example4/program1.deck")
    asked = ("tei", "--read", str(folder / "chapter6.xml"), "--part", "example4/program1.deck")
    assert call(capsys, *asked) == (0, card, "")
    assert call(capsys, "tei", "--schema") == (0, schema(), "")
    assert call(capsys, "tei", "nakamae_nishita_1972", "--check") == (0, "nakamae_nishita_1972: valid\n", "")


def test_an_invalid_document_is_reported_in_one_line(tmp_path: Path, capsys) -> None:
    other_schema = tmp_path / "other.rng"
    other_schema.write_text(schema().replace('<element name="ab">', '<element name="line">'))
    code, out, err = call(capsys, "tei", "program1", "--check", str(other_schema))
    assert (code, err) == (1, "")
    assert re.fullmatch(r"program1: line \d+: .+\n", out)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("tei",), "expected a text, or --all with a folder; the texts are program1,"),
        (("tei", "program4"), "unknown text 'program4'; expected one of program1,"),
        (("tei", "program1", "--witness"), "--witness needs --read"),
        (("tei", "program1", "--schema"), "program1: --all, --schema and --read do not accept a text"),
        (("tei", "--read", "x.xml", "--witness", "--layers", "ocr"), "choose one"),
        (("tei", "--read", "no.xml"), "no.xml"),
        (("tei", "--check", "bad.rng"), "bad.rng: not a RELAX NG schema"),
        (("tei", "--read", "bad.xml"), "bad.xml, line 1, column 1: not well-formed XML"),
        (("tei", "--read", "other.xml"), "other.xml: not a TEI document with a text"),
        (("tei", "--read", "good.xml", "--layers", "ocr,nosuch"), "good.xml: unknown layer 'nosuch'"),
        (("tei", "--read", "good.xml", "--part", "x"), "good.xml: unknown part 'x'; the document has none"),
        (("tei", "--read", "good.xml", "-o", "good.xml"), "which would be overwritten"),
        (("tei", "--all", "good.xml"), "good.xml: not a directory"),
    ],
)
def test_wrong_use_is_reported_in_one_line(arguments, message, tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    Path("bad.rng").write_text("<x", encoding="utf-8")
    Path("bad.xml").write_text("", encoding="utf-8")
    Path("other.xml").write_text("<TEI/>", encoding="utf-8")
    Path("good.xml").write_text(written("program2"), encoding="utf-8")
    code, out, err = call(capsys, *arguments)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert message in err


def test_a_damaged_document_is_read_or_rejected_with_one_line(tmp_path: Path, capsys) -> None:
    draw = random.Random(1963)
    source = written("program2")
    exit_codes = set()
    for _ in range(12):
        at = draw.randrange(len(source))
        damaged = tmp_path / "damaged.xml"
        damaged.write_text(
            source[:at] + draw.choice(["", "<", "&", "9", '"', "</ab>"]) + source[at + draw.randrange(40) :],
            encoding="utf-8",
        )
        code, _, err = call(capsys, "tei", "--read", str(damaged))
        assert (code, err.count("\n")) in ((0, 0), (2, 1)), err
        exit_codes.add(code)
    assert 2 in exit_codes
    wide = tmp_path / "wide.xml"
    wide.write_text(re.sub(r'quantity="\d+"', 'quantity="81"', written("chapter6")), encoding="utf-8")
    code, _, err = call(capsys, "tei", "--read", str(wide), "--part", "example1/program1.deck")
    assert (code, err) == (2, f"hull1620: {wide}: a space of '81' characters; a card has 80 columns\n")
