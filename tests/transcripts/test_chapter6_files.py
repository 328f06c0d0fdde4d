"""The printed examples of chapter 6 as card images: agreement with the print, committed files, altered data."""

import dataclasses
import re
from pathlib import Path

import pytest

from modern.edition import chapter6_cards
from modern.edition.apparatus import Line
from modern.edition.chapter6 import chapter6_folder
from modern.edition.chapter6_checks import check_arithmetic, check_chapter, check_files, check_tie, main

CHAPTER = chapter6_cards.load_chapter()
NAMES = [name for *_, name in chapter6_cards.device_files(CHAPTER)]


def altered(line: str, old: str, new: str) -> chapter6_cards.Chapter:
    """The chapter with one fragment of one line of the corrected print changed."""
    lines = tuple(Line(w.id, w.text.replace(old, new, 1), w.page) if w.id == line else w for w in CHAPTER.print)
    assert lines != CHAPTER.print
    return dataclasses.replace(CHAPTER, print=lines)


def test_files_are_built_completely_from_the_print(tmp_path: Path) -> None:
    assert check_chapter(CHAPTER) == ()
    folder = Path(str(chapter6_folder()))
    found = {p.relative_to(folder).as_posix() for p in folder.glob("example*/*")}
    assert found == set(NAMES)
    assert len(_digits()) == 2 * len([d for d in CHAPTER.layout.devices if d.layer == "layout"])
    names = chapter6_cards.write_files(CHAPTER, tmp_path)
    assert names == tuple(NAMES)
    assert {n: (tmp_path / n).read_text() for n in names} == dict(chapter6_cards.built_files(CHAPTER))
    assert not list(tmp_path.rglob("*.new"))


@pytest.mark.parametrize(("example", "program", "device", "name"), chapter6_cards.device_files(CHAPTER), ids=NAMES)
def test_committed_file_equals_its_build(example: int, program: int, device: str, name: str) -> None:
    committed = chapter6_folder().joinpath(*name.split("/")).read_bytes()
    images = chapter6_cards.card_images(CHAPTER, example, program, device)
    assert committed.decode("ascii") == "".join(image + "\n" for image in images)
    assert all(image == image.rstrip() and len(image) <= 80 and "\t" not in image for image in images)


@pytest.mark.parametrize("entry", [d for d in CHAPTER.layout.devices if d.layer == "layout"], ids=lambda d: str(d.file))
def test_cards_have_the_characters_of_the_print(entry) -> None:
    """Compare the committed file with the built lines, without the card reader."""
    committed = chapter6_folder().joinpath(*entry.file.split("/")).read_text(encoding="ascii")
    printed = "".join(line.text for line in chapter6_cards.printed_lines(CHAPTER, entry))
    assert "".join(committed.split()) == "".join(printed.split())


def test_printed_columns_are_the_nonblank_columns() -> None:
    for example, program, device, _ in chapter6_cards.device_files(CHAPTER):
        for card in chapter6_cards.cards(CHAPTER, example, program, device):
            if device == "typewriter":
                assert not card.tokens
                continue
            printed = {column for token in card.tokens for column in range(token.first, token.last + 1)}
            assert printed == {i for i, c in enumerate(card.image, start=1) if c != " "}
            assert (not card.tokens) == (card.image == "")


@pytest.mark.parametrize(
    ("example", "typed"),
    [
        (1, "CONVEX HULL"),
        (2, "CONVEX HULL"),
        (3, "CONVEX HULL"),
        (4, "POINTS ARE COPLANAR"),
        (5, "POINTS ARE NOT COPLANAR"),
        (6, "POINTS ARE NOT COPLANAR"),
    ],
)
def test_typed_line_as_chapter_5_states_it(example: int, typed: str) -> None:
    assert chapter6_cards.card_images(CHAPTER, example, 1, "typewriter") == (typed,)


@pytest.mark.parametrize(("example", "program"), [(4, 2), (5, 3), (6, 3)])
def test_programs_2_and_3_type_nothing(example: int, program: int) -> None:
    assert chapter6_cards.card_images(CHAPTER, example, program, "typewriter") == ()


def _digits() -> list[tuple[str, str, str]]:
    """Alter one digit of the first and of the last number of every printed device file."""
    places = []
    for entry in CHAPTER.layout.devices:
        found = [
            (line.id, n)
            for line in chapter6_cards.printed_lines(CHAPTER, entry)
            for n in re.findall(r"\.\d{8}E...", line.text)
        ]
        for line, number in (found[0], found[-1]) if found else ():
            digit = number[1]
            places.append((line, number, number.replace(digit, str((int(digit) + 1) % 10), 1)))
    return places


@pytest.mark.parametrize(("line", "old", "new"), _digits())
def test_guard_one_altered_digit_is_caught(line: str, old: str, new: str) -> None:
    chapter = altered(line, old, new)
    assert check_files(chapter, chapter6_folder())
    assert check_tie(chapter) == ()


@pytest.mark.parametrize(
    ("line", "old", "new", "fault"),
    [
        ("67", ".65020000", ".65030000", "2/program1.punch: an endpoint is not a point of the input deck"),
        ("31", ".15880000", ".15890000", "1/program1.punch: equation 3 does not vanish at its vertices"),
        ("213", ".19000000", ".18000000", "5/program1.punch: its points differ from those of the input deck"),
        ("320", ".17100000", ".17200000", "5/program3.punch: equation 4 does not vanish at its vertices"),
        ("178", "15", "16", "5/program1.deck: card 1: N is not 15, the number of points of the deck"),
        ("385", "N=10", "N=11", "6/program3.punch: card 3: N is not 10, the number of points of the deck"),
    ],
)
def test_guard_arithmetic_of_the_print(line: str, old: str, new: str, fault: str) -> None:
    assert f"example{fault}" in check_arithmetic(altered(line, old, new))


def test_guard_a_reversed_plane_is_caught() -> None:
    """An equation with all signs reversed still vanishes at its vertices, but the points then lie outside."""
    lines = [
        Line(w.id, re.sub(r"(-?)(\.\d+E)", lambda m: ("" if m[1] else "-") + m[2], w.text), w.page)
        if w.id in ("316", "317", "318")
        else w
        for w in CHAPTER.print
    ]
    faults = check_arithmetic(dataclasses.replace(CHAPTER, print=tuple(lines)))
    assert faults == ("example5/program3.punch: equation 3 has a point of the deck on its positive side",)


def test_guard_lines_must_be_used_exactly_once() -> None:
    layout = dataclasses.replace(CHAPTER.layout, headings=CHAPTER.layout.headings[1:])
    assert check_tie(chapter6_cards.rebuilt(CHAPTER.text, layout)) == (
        "line 1 of the corrected print belongs to no card and no heading",
    )
    layout = dataclasses.replace(CHAPTER.layout, headings=(*CHAPTER.layout.headings, "58"))
    assert check_tie(chapter6_cards.rebuilt(CHAPTER.text, layout)) == ("line 58 of the corrected print is used twice",)


def test_guard_a_changed_device_file_is_caught(tmp_path: Path) -> None:
    chapter6_cards.write_files(CHAPTER, tmp_path)
    assert check_files(CHAPTER, tmp_path) == ()
    path = tmp_path / "example5" / "program3.punch"
    path.write_text(path.read_text().replace(".24000000E+02", ".24000001E+02"))
    (tmp_path / "example1" / "program1.deck").unlink()
    assert check_files(CHAPTER, tmp_path) == (
        "example1/program1.deck is missing",
        "example5/program3.punch differs from the file built from witness, apparatus and layout",
    )


@pytest.mark.parametrize(
    ("line", "old", "new", "message"),
    [
        ("67", ".65020000E+04", ".6502E+04", r"columns 8 to 21: line 67: expected a number of 14 columns"),
        ("66", "1", "1234", r"line 66: 1234 is wider than its field$"),
        ("60", "ARE COLLINEAR", "ARE COLL", r"line 60: expected 9 characters of words, found 'COLL'$"),
        ("90", "DETERMINED", "DETERMINED 5", r"line 90: '5' remains after the last field$"),
    ],
)
def test_a_print_that_does_not_fit_is_one_clear_line(line: str, old: str, new: str, message: str) -> None:
    with pytest.raises(chapter6_cards.TranscriptError, match=message) as caught:
        chapter6_cards.card_images(altered(line, old, new), 2, 1, "punch")
    assert "\n" not in str(caught.value)
    assert str(caught.value).startswith("example2/program1.punch: ")


def test_devices_and_options_that_do_not_exist_are_rejected(capsys) -> None:
    with pytest.raises(chapter6_cards.TranscriptError, match=r"^chapter 6 has no punch for example 7, program 1$"):
        chapter6_cards.card_images(CHAPTER, 7, 1, "punch")
    assert main(["--check"]) == 0
    assert capsys.readouterr().out == ""
    assert main(["--run"]) == 2
    assert capsys.readouterr().err.startswith("usage: ")
