"""The built-in programs and decks of the emulator's page, by name."""

from importlib.resources import files
from importlib.resources.abc import Traversable

from emulator.language.cards import Deck, deck_from_text
from modern.edition.chapter6 import EXAMPLES, chapter6_folder, input_deck
from modern.edition.programs import BUILT_INS

# The kinds of decks: points for program 1, or the cards that program 1 punches for program 2 or for program 3.
POINTS, PLANE, SPACE = "points", "plane", "space"
_KINDS = {1: POINTS, 2: PLANE, 3: SPACE}
# The kind of the cards that program 1 punches for examples 4 to 6. Examples 1 to 3 need no second program.
_PUNCHED = {4: PLANE, 5: SPACE, 6: SPACE}
_FOLDERS = {"grounds": ("fortran_src", "grounds"), "counterexamples": ("transcripts", "counterexamples")}


def offered() -> dict[str, list[list[str]]]:
    """Return ``programs`` and ``decks`` as lists of name, title and kind.

    A program can read the decks that have the same kind as the program.
    """
    programs = [[b.name, b.title, _KINDS[b.number]] for b in BUILT_INS]
    decks = [[f"example{n}", f"example {n} of chapter 6", POINTS] for n in EXAMPLES]
    decks += [[f"example{n}/punched", f"example {n}, punched by program 1", kind] for n, kind in _PUNCHED.items()]
    for folder in _FOLDERS:
        names = sorted(path.name for path in _folder(folder).iterdir() if path.name.endswith(".deck"))
        decks += [[f"{folder}/{name[:-5]}", f"{folder}: {name[:-5]}", POINTS] for name in names]
    return {"programs": programs, "decks": decks}


def named_deck(name: str) -> Deck:
    """Return a deck that :func:`offered` lists.  Raise ValueError for an unknown name."""
    folder, _, stem = name.rpartition("/")
    try:
        if not folder and stem in {f"example{n}" for n in EXAMPLES}:
            return input_deck(int(stem[7:]))
        if stem == "punched" and folder.removeprefix("example").isdigit():
            return deck_from_text(name, chapter6_folder().joinpath(folder, "program1.punch").read_text("ascii"))
        if folder in _FOLDERS:
            return deck_from_text(name, _folder(folder).joinpath(f"{stem}.deck").read_text("ascii"))
    except OSError:
        pass
    raise ValueError(f"unknown deck {name!r}")


def _folder(name: str) -> Traversable:
    package, folder = _FOLDERS[name]
    return files(package).joinpath(folder)
