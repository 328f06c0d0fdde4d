"""The FORMATs the transcripts' layout rests on are those of the restored decks."""

import tomllib
from importlib.resources import files

from emulator.language.formats import parse_format
from emulator.language.tree import Format, Place
from modern.edition import programs

LAYOUT = tomllib.loads(files("transcripts").joinpath("chapter6", "layout.toml").read_text(encoding="utf-8"))


def test_every_layout_format_is_that_of_the_deck() -> None:
    for entry in LAYOUT["format"]:
        text = entry["text"]
        spec, _ = parse_format(Format(text, tuple(Place(1, column) for column in range(1, len(text) + 1))))
        assert dict(programs.program(f"program{entry['program']}").formats)[entry["number"]] == spec, entry
