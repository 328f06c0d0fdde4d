"""The collation of another transcription, tested on synthetic transcriptions whose truth is known."""

import json
import os
import re
from collections import Counter
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import pytest

from modern.cli.apparatus import show
from modern.cli.main import main
from modern.edition import collation, programs, sources
from modern.edition.alignment import distance
from modern.edition.apparatus import ApparatusError
from modern.edition.collation import collate, from_json, shared_errors, to_csv, to_json, verdicts_by_id
from modern.edition.tokens import rivals, spans
from modern.edition.transcription import align, edition_cards, read_lines
from modern.publication import tei_header
from modern.publication.tei import tei
from modern.publication.tei_header import ID, TEI
from tests.modern.edition.synthetic import scores, synthetic

TRANSCRIPTIONS = int(os.environ.get("HULL1620_COLLATED", "2"))
"""The number of synthetic transcriptions; 20 is the number in the documents."""


def test_synthetic_transcriptions_are_aligned_and_classified() -> None:
    total: Counter[str] = Counter()
    for seed in range(TRANSCRIPTIONS):
        truth = synthetic(seed, 0.01 + 0.07 * seed / max(TRANSCRIPTIONS - 1, 1))
        total += scores(truth, collate(truth.text))
    assert total["false"] == 0
    assert total["planted"] >= 40 * TRANSCRIPTIONS
    assert total["aligned"] >= 0.995 * total["cards"]
    assert total["right"] >= 0.99 * total["readings"]
    assert total["right"] - total["alike"] >= 0.985 * total["readings"]


def witness(name: str) -> str:
    return programs.sources().joinpath("witness", f"{name}.txt").read_text(encoding="utf-8")


def test_the_witness_has_every_card_but_the_conjectures_and_shares_its_own_errors(monkeypatch) -> None:
    """Page 68 is one line in the witness of program 1, so that it must be divided."""
    text = "\n".join(witness(name) for name in programs.TEXTS)
    result = collate(text)
    absent = [f"{c.program} {c.place}" for n, c in enumerate(edition_cards()) if not result.cards[n].lines]
    assert absent == ["program1 131+1", "program1 154+2", "program1 154+3"]
    shared, places = shared_errors(result)
    assert shared > 0.9 * places > 30
    row = programs.text("program2").row("P2-020")
    monkeypatch.setattr(collation, "registered", lambda: (replace(result, id="ours"),))
    assert verdicts_by_id(row) == {"ours": ("supports a rival",)}


def test_retyped_pages_and_numbers_of_formats_confirm_their_cards() -> None:
    cards = [card.text for card in programs.committed("program3").cards[40:75]]
    result = collate("\n".join(cards).lower())
    assert [card.card for card in result.cards if card.lines] == [
        n for n, card in enumerate(edition_cards()) if card.program == "program3" and 41 <= card.number <= 75
    ]
    assert not any(r.verdict in ("contradicts", "supports a rival") for c in result.cards for r in c.readings)
    formats = [card.text for card in programs.committed("program2").cards if re.match(r" +\d+ FORMAT", card.text)]
    result = collate("\n".join(formats))
    readings = [card.readings[0].verdict for card in result.cards if card.lines]
    assert readings == ["confirms"] * len(formats)
    cut = collate("\n".join(card[:24] for card in _page()))
    ends = [card.readings[-1] for card in cut.cards if card.lines and not card.readings[-1].transcription]
    assert ends
    assert {reading.verdict for reading in ends} == {"unreadable"}


def _page(first: int = 40, last: int = 75) -> list[str]:
    return [card.text for card in programs.committed("program3").cards[first:last]]


@pytest.mark.parametrize(
    ("typed", "lines_without_card"),
    [
        (lambda cards: "\r\n".join(cards), []),
        (lambda cards: "\r".join(cards), []),
        (lambda cards: "\f".join(["\n".join(cards[:20]) + "\n", "\n".join(cards[20:])]), []),
        (lambda cards: "\n".join(card.replace("      ", "\t", 1) for card in cards), []),
        (lambda cards: "\n".join(f" {card}" for card in cards), []),
        (lambda cards: "\n".join(f"{n:>3}: {card}" for n, card in enumerate(cards, 1)), []),
        (lambda cards: "\n\n".join(f"{2 * n - 1:04d}\t{card.strip()}" for n, card in enumerate(cards, 1)), []),
        (lambda cards: "\n".join(f"{card:<72}BUTL{n:04d}" for n, card in enumerate(cards, 1)), []),
        (lambda cards: "\n".join(f"{n:>3}: {card:<72}BUTL{n:04d}" for n, card in enumerate(cards, 1)), []),
        (lambda cards: "\n".join(cards).translate(str.maketrans("-*=,", "\u2212\u00d7\uff1d\u201a")), []),
        (lambda cards: "\n".join(["94", "Program 3, not coplanar", *cards, "- 94 -"]), [1, 2, 38]),
        (lambda cards: "\n".join(cards + cards), list(range(36, 71))),
    ],
    ids="crlf cr form-feed tabs shifted numbered numbered-by-line identified both typographic header twice".split(),
)
def test_a_page_typed_by_hand_confirms_its_cards_only(typed, lines_without_card) -> None:
    text = typed(_page())
    result = collate(text)
    expected = [n for n, card in enumerate(edition_cards()) if card.program == "program3" and 41 <= card.number <= 75]
    assert [card.card for card in result.cards if card.lines] == expected
    assert {reading.verdict for n in expected for reading in result.cards[n].readings} == {"confirms"}
    used = {line for card in result.cards for line in card.lines}
    assert [number for number, _ in read_lines(text) if number not in used] == lines_without_card


@pytest.mark.parametrize("text", ["", "\n \n", "  GO TO 104\n", "(a) The hull is convex.\n(b) (c)\nI = 1\nEND\n"])
def test_a_text_that_decides_no_card_is_rejected_in_one_line(text: str, tmp_path: Path, capsys) -> None:
    (tmp_path / "page.txt").write_text(text, encoding="utf-8")
    assert main(["apparatus", "--collate", str(tmp_path / "page.txt")]) == 2
    message = capsys.readouterr().err
    assert "can be assigned to a card of the listings" in message
    assert message.count("\n") == 1


def test_no_rival_typed_on_a_single_page_is_confirmed() -> None:
    """One page does not show which errors the typist makes, so that a rival may be unreadable, but never confirms."""
    texts, tested = _page(), 0
    first = next(n for n, card in enumerate(edition_cards()) if card.program == "program3") + 40
    for n in range(first, first + len(texts), 5):
        for rival in (r for r in rivals().get(n, ()) if r.first == r.last and r.origin == "silent"):
            a, b = spans(n)[rival.first]
            solid = edition_cards()[n].solid
            typed = [*texts[: n - first], solid[:a] + rival.text + solid[b:], *texts[n - first + 1 :]]
            assert collate("\n".join(typed)).cards[n].readings[rival.first].verdict != "confirms"
            tested += 1
    assert tested > 5


def test_another_number_contradicts_and_a_rival_is_supported() -> None:
    lines = [card.text for card in programs.committed("program1").cards]
    n = next(k for k, line in enumerate(lines) if "IF(N-2)102,107,134" in line.replace(" ", ""))
    verdicts = []
    for number in ("105", "999", "10"):
        changed = [*lines[:n], lines[n].replace("107", number), *lines[n + 1 :]]
        reading = next(r for r in collate("\n".join(changed)).cards[n].readings if r.edition == "107")
        verdicts.append((reading.verdict, reading.transcription))
    assert verdicts == [("supports a rival", "105"), ("contradicts", "999"), ("contradicts", "10")]


def test_collations_cover_every_card_and_are_saved() -> None:
    for n, card in enumerate(edition_cards()):
        assert "".join(card.solid[a:b] for a, b in spans(n)) == card.solid
    assert align("It was a bright cold day in April, and the clocks were striking thirteen.\n") == {}
    result = collate(witness("program2"), "ours.txt")
    assert from_json(to_json(result), "x.json") == result
    assert to_csv(result).count("\n") == 1 + sum(len(card.readings) for card in result.cards)
    assert not any(entry.file for entry in sources.sources().transcriptions)
    assert collation.registered() == ()
    assert verdicts_by_id(programs.text("program2").row("P2-020")) == {}


@pytest.mark.parametrize(("a", "b", "expected"), [("", "AB", 2), ("KITTEN", "SITTING", 3), ("GOTO100", "GOTO100", 0)])
def test_edit_distance(a: str, b: str, expected: int) -> None:
    assert distance(a, b) == distance(b, a) == expected


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            {"edition": "0"},
            "x.json: the collation was made for other cards of the listings; collate the transcription again",
        ),
        ({"format": "other"}, "x.json: is not a collation"),
        ({"cards": [["program1", 1, [], "cc", {}]]}, "x.json: is not a collation"),
    ],
)
def test_a_file_that_is_no_collation_is_rejected(change: dict[str, object], message: str) -> None:
    data = json.loads(to_json(collate("\n".join(_page())))) | change
    with pytest.raises(ApparatusError, match="^" + message):
        from_json(json.dumps(data), "x.json")


def test_a_registered_collation_is_a_witness_in_apparatus_and_tei(monkeypatch) -> None:
    """The cards as edited, but without the fourth group of FORMAT 7, confirm a row and support a rival of another."""
    cards = [card.text for card in programs.committed("program2").cards]
    n = next(k for k, card in enumerate(cards) if card.startswith("    7 FORMAT"))
    cards[n] = cards[n].replace(",2X,E14.8)", ")")
    entry = sources.Transcription(
        "retyped", "butler-1963", "a retyping", "", "", "independent", "fortran_src/collations/retyped.json", "0" * 64
    )
    table = replace(sources.sources(), transcriptions=(entry,))
    for module in (collation, tei_header):
        monkeypatch.setattr(module, "sources", lambda: table)
    monkeypatch.setattr(collation, "read", lambda file: to_json(collate("\n".join(cards))))
    collation.registered.cache_clear()
    try:
        confirmed, rival = (programs.text("program2").row(name) for name in ("P2-004", "P2-020"))
        assert "    collated  retyped: confirms" in list(show(confirmed, 100))
        assert "    collated  retyped: supports a rival" in list(show(rival, 100))
        root = ElementTree.fromstring(tei("program2", "1"))
        tags = {"tei": TEI}
        assert [w.get(ID) for w in root.iterfind(".//tei:listWit/tei:witness", tags)] == ["print", "ocr", "retyped"]
        apps = {app.get(ID): app for app in root.iterfind(".//tei:app", tags)}
        assert apps["P2-004"].find("tei:lem", tags).get("wit") == "#print #retyped"
        assert apps["P2-020"].find("tei:rdg", tags).get("wit") == "#ocr #retyped"
    finally:
        collation.registered.cache_clear()
