"""Write the device files of chapter 6 from witness, apparatus and layout, or check the chapter."""

import sys
from collections.abc import Sequence
from pathlib import Path

from modern.edition.chapter6 import LayoutError, chapter6_folder
from modern.edition.chapter6_cards import load_chapter, write_files
from modern.edition.chapter6_checks import check_chapter


def main(arguments: Sequence[str] | None = None) -> int:
    """Run with ``--write`` or ``--check`` and return the exit status."""
    options = list(sys.argv[1:] if arguments is None else arguments)
    if options not in (["--write"], ["--check"]):
        print("usage: python -m modern.edition --write | --check", file=sys.stderr)
        return 2
    try:
        chapter = load_chapter()
        if options == ["--write"]:
            for name in write_files(chapter, Path(str(chapter6_folder()))):
                print(name)
            return 0
        faults = check_chapter(chapter)
    except (ValueError, LayoutError) as error:
        print(error, file=sys.stderr)
        return 1
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    raise SystemExit(main())
