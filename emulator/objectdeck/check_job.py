"""Prepare the files of a job for SIMH, and compare the cards that it punched.

This script needs nothing but Python 3.  ``hull1620 export-job`` writes it as check.py into the folder of a job.

    python3 check.py disk monitor.pack monitor.dsk
    python3 check.py join compile.cards pdq.txt program.cards pdq-fixed.txt
    python3 check.py compare expected.cards punched.cards

``disk`` converts a disk image from text (on each line a sector number, a comma and 105 digits) to the form that SIMH
reads.  ``join`` writes several decks to one file, one after the other.  ``compare`` lists the differences by class.  It
exits with 1 if a difference belongs to no known class, if the order differs, or if no card was punched.  After an
error, every command exits with 2.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from collections.abc import Callable

# The digit that each character of a disk in text form stands for; a flag adds 16.
DIGITS = {c: n for n, c in enumerate('0123456789|=@  }]JKLMNOPQR!$-  "') if c != " "}

# The digits of a sector: five of its address and 100 of data.
SECTOR = 105

NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:E[-+]\d\d)?")

CLASSES = {
    "sign of zero": "one zero has a minus sign and the other has none",
    "notation": "equal numbers that are printed differently",
    "last digits": "floating-point numbers that differ by less than 20 units of the eighth digit",
    "order": "a card that occurs, but at another place",
    "other": "any other difference",
}


def disk(source: str, target: str) -> None:
    """Convert a disk from text form to the form of the simulator SIMH: one byte for each digit."""
    digits = bytearray()
    with open(source, encoding="latin-1") as file:
        for number, line in enumerate(file, 1):
            sector, comma, text = line.rstrip("\r\n").partition(",")
            if not comma and not sector.strip():
                continue
            place, expected = f"{source}, line {number}", len(digits) // SECTOR
            if not comma or not sector.strip().isdecimal():
                raise ValueError(f"{place}: expected a sector number, a comma and {SECTOR} digits")
            if int(sector) != expected:
                raise ValueError(f"{place}: expected sector {expected}, found {int(sector)}; a sector is lost or moved")
            if len(text) != SECTOR:
                raise ValueError(
                    f"{place}: expected {SECTOR} digits, found {len(text)}; a line is truncated, or two are joined"
                )
            for column, character in enumerate(text, len(sector) + 2):
                if character not in DIGITS:
                    raise ValueError(f"{place}, column {column}: invalid digit {character!r}")
                digits.append(DIGITS[character])
    if not digits:
        raise ValueError(f"{source}: no sector; expected a disk in text form")
    with open(target, "wb") as file:
        file.write(digits)


def join(target: str, *sources: str) -> None:
    """Write several decks to one file, one after the other."""
    cards = [card for source in sources for card in deck(source)]
    with open(target, "w", encoding="latin-1", newline="\n") as file:
        file.writelines(card + "\n" for card in cards)


def deck(name: str) -> list[str]:
    """Return the cards of a file: columns 1 to 80 without trailing blanks."""
    with open(name, encoding="latin-1") as file:
        return [line.rstrip("\r\n")[:80].rstrip() for line in file]


def numbers(card: str) -> list[str]:
    """Return the numbers on a card; exponents punched by PDQ FORTRAN are converted to IBM's notation."""
    return NUMBER.findall(re.sub(r"E (?=\d\d)", "E+", card))


def kind(expected: str, punched: str) -> str:
    """Classify the difference between two numbers: sign of zero, notation, last digits, or other."""
    a, b = float(expected), float(punched)
    if a == b:
        return "sign of zero" if a == 0 and (expected[0] == "-") != (punched[0] == "-") else "notation"
    floating = "." in expected and "." in punched
    return "last digits" if floating and abs(a - b) <= 20e-8 * max(abs(a), abs(b)) else "other"


def differences(expected: str, punched: str) -> list[str]:
    """Return the classes (such as ``last digits``) of all differences between two cards."""
    ours, theirs = numbers(expected), numbers(punched)
    text = [re.sub(r"[ E]", "", NUMBER.sub("", re.sub(r"E (?=\d\d)", "E+", c))) for c in (expected, punched)]
    if text[0] != text[1] or len(ours) != len(theirs):
        return ["other"]
    return [kind(a, b) for a, b in zip(ours, theirs, strict=True) if a != b] or ["notation"]


def compare(expected_name: str, punched_name: str) -> int:
    """Print the differences of two decks by class.

    Return 1 if the class of a difference is ``order`` or ``other``, or if no card was punched, else 0.
    """
    expected, punched = deck(expected_name), [card[:77].rstrip() for card in deck(punched_name)]
    common = Counter(expected) & Counter(punched)
    classes: Counter[str] = Counter()
    same = 0
    for number in range(max(len(expected), len(punched))):
        a = expected[number] if number < len(expected) else "(no card)"
        b = punched[number] if number < len(punched) else "(no card)"
        if a == b:
            same += 1
            continue
        kinds = differences(a, b)
        if "other" in kinds and (common[a] or a == "(no card)") and (common[b] or b == "(no card)"):
            kinds = ["order"]
        classes.update(kinds)
        if set(kinds) == {"notation"}:
            continue
        print(f"card {number + 1}: {', '.join(sorted(set(kinds)))}\n  expected {a}\n  punched  {b}")
    print(f"{len(expected)} cards expected, {len(punched)} punched, {same} equal")
    for name, count in classes.items():
        print(f"{count:>6} {name}: {CLASSES[name]}")
    return 1 if classes["other"] or classes["order"] or not punched else 0


if __name__ == "__main__":
    commands: dict[str, Callable[..., int | None]] = {"disk": disk, "join": join, "compare": compare}
    if len(sys.argv) < 4 or sys.argv[1] not in commands:
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    try:
        sys.exit(commands[sys.argv[1]](*sys.argv[2:]))
    except (OSError, TypeError, ValueError) as error:
        print(f"check.py {sys.argv[1]}: {error}", file=sys.stderr)
        sys.exit(2)
