"""The editor's tool for chapter 6: write the device files from their sources, or check everything.

Nothing here reads a run of a program.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from modern.edition.chapter6 import LayoutError, chapter6_folder
from modern.edition.chapter6_cards import load_chapter, write_files
from modern.edition.chapter6_checks import check_chapter


def main(arguments: Sequence[str] | None = None) -> int:
    """``--write`` the device files or ``--check`` the chapter; returns the exit status."""
    asked = list(sys.argv[1:] if arguments is None else arguments)
    if asked not in (["--write"], ["--check"]):
        print("usage: python -m modern.edition --write | --check", file=sys.stderr)
        return 2
    try:
        chapter = load_chapter()
        if asked == ["--write"]:
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
