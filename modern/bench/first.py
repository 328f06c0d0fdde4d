"""A process that runs one deck on the compiled engine: ``python -m modern.bench.first`` with the deck as input."""

from __future__ import annotations

import sys

from emulator.compiled.batch import punched
from modern.bench.decks import LAYERS, OPTIONS, PROGRAM
from modern.edition import programs


def main() -> None:
    """Put out what program 3 punches."""
    sys.stdout.writelines(punched(programs.program(PROGRAM, LAYERS), [sys.stdin.read()], OPTIONS))


if __name__ == "__main__":
    main()
