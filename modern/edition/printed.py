"""The corrected print of chapter 6 as card images: one file an example, program and device."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from importlib.resources import files
from importlib.resources.abc import Traversable

from emulator.language.cards import Deck, deck_from_text

EXAMPLES = (1, 2, 3, 4, 5, 6)
THEOREMS = ("4.1", "4.2", "4.8")
DEVICES = ("punch", "typewriter")


@dataclass(frozen=True, slots=True)
class Print:
    """What the thesis prints (or, for a typewriter, states) of one device in one example, a card or line each."""

    example: int
    program: int
    device: str
    lines: tuple[str, ...]


def chapter6_folder() -> Traversable:
    """The data folder of chapter 6, in a checkout or an installed wheel."""
    return files("transcripts").joinpath("chapter6")


def input_deck(example: int, folder: Traversable | None = None) -> Deck:
    """The example's input data for program 1."""
    name = f"example{example}/program1.deck"
    text = (folder or chapter6_folder()).joinpath(*name.split("/")).read_text(encoding="ascii")
    return deck_from_text(name, text)


def prints(example: int, folder: Traversable | None = None) -> Iterator[Print]:
    """Every device of every program the example prints, program by program."""
    place = (folder or chapter6_folder()).joinpath(f"example{example}")
    for program in (1, 2, 3):
        for device in DEVICES:
            entry = place.joinpath(f"program{program}.{device}")
            if entry.is_file():
                yield Print(example, program, device, tuple(entry.read_text(encoding="ascii").splitlines()))
