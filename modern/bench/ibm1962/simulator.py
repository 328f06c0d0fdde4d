"""The simulator ``i1620`` of SIMH: load a deck, set positions of core storage, run, and return what the run wrote."""

from __future__ import annotations

import os
import re
import select
import shutil
import subprocess
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

SECONDS = 20.0

# Lines of the output that the simulator itself writes, not the simulated program.
_SIMULATOR = re.compile(r"IBM 1620 simulator|CD[PR]: |HALT instruction|Goodbye|\d{5}:\t|Invalid |No card in")
# What it writes may follow a typed line at once, because the carriage returns only before the next line.
_POSITION = re.compile(r"(\d{5}):\t([0-9A-F]{2})\n?")
_TROUBLE = re.compile(r"^(?:Invalid|No card in) [^\n]*$", re.MULTILINE)


class Unavailable(Exception):
    """The simulator or the object deck is missing.  The message says how to provide it."""


class Failed(Exception):
    """The simulator did not finish a run."""


@dataclass(frozen=True, slots=True)
class Run:
    """The output of a run: typed lines, punched cards (80 columns), and the positions that were examined.

    ``trouble`` is the simulator's message if an invalid instruction or address stopped the run, else "".
    """

    typed: tuple[str, ...]
    punched: tuple[str, ...]
    core: Mapping[int, int] = field(default_factory=dict)
    trouble: str = ""

    def field(self, address: int) -> list[int]:
        """Return ten examined digits, those of the field whose low-order position is ``address``."""
        return [self.core[position] for position in range(address - 9, address + 1)]


def simulator() -> str:
    """Return the command of the simulator.  Raise Unavailable if it is not installed."""
    command = os.environ.get("I1620", "i1620")
    if shutil.which(command) is None:
        raise Unavailable(f"the simulator {command!r} is not installed; install simh or set I1620 to its command")
    return command


def object_deck() -> list[str]:
    """Return the cards of IBM's object deck of 1962 without its data.  Raise Unavailable if it cannot be read."""
    name = os.environ.get("OBJECT_DECK")
    if not name:
        raise Unavailable("set OBJECT_DECK to the file of the object deck of 1962 (tic3d.txt)")
    try:
        cards = Path(name).read_text(encoding="latin1").splitlines()
    except OSError as error:
        raise Unavailable(f"the object deck {name} cannot be read: {error.strerror}") from None
    # Cards of the data have TTT in columns 73 to 75.
    return [card for card in cards if len(card) > 75 and card[72:75] != "TTT"]


def run(
    deck: Sequence[str],
    *,
    start: int | None = None,
    core: int = 20000,
    stored: Mapping[int, Sequence[int]] | None = None,
    cards: Sequence[str] = (),
    keys: Sequence[str] = (),
    switches: Sequence[int] = (),
    examine: Sequence[tuple[int, int]] = (),
    starts: int = 0,
    seconds: float = SECONDS,
) -> Run:
    """Load a deck, continue at ``start`` (default: where the loader halts), and return the output.

    Parameters
    ----------
    deck, cards
        The cards to load, and the data cards behind them.
    stored
        Positions to set after loading: the digits and flags from each address on.
    keys
        The lines to type, one for each time that the program waits for the typewriter.
    switches
        The sense switches that are on.
    examine
        Ranges of positions to return, first and last.
    starts
        The number of times that START is pressed after a PAUSE.

    Raises
    ------
    Unavailable
        If the simulator is not installed.
    Failed
        If the run takes longer than ``seconds``.
    """
    script = [f"set cpu {core // 1000}K", "deposit arstop 0", "attach cdr deck.txt", "attach -n cdp punched.txt"]
    script += [f"deposit sw{number} 1" for number in switches]
    script.append("boot cdr")
    for address, positions in (stored or {}).items():
        script += [f"deposit {address + k} {position:X}" for k, position in enumerate(positions)]
    script.append("continue" if start is None else f"go {start}")
    script += ["continue"] * starts
    script += [f"examine {first}-{last}" for first, last in examine]
    script += ["detach all", "quit"]
    with TemporaryDirectory(prefix="i1620-") as folder:
        here = Path(folder)
        (here / "deck.txt").write_text("".join(f"{card}\n" for card in (*deck, *cards)), encoding="latin1")
        (here / "run.ini").write_text("\n".join(script) + "\n")
        log = _typewriter([simulator(), "run.ini"], here, keys, seconds)
        path = here / "punched.txt"
        punched = path.read_text(encoding="latin1").splitlines() if path.exists() else []
    trouble = _TROUBLE.search(log)
    return Run(
        tuple(_typed(_POSITION.sub("", log))),
        tuple(punched),
        {int(address): int(position, 16) for address, position in _POSITION.findall(log)},
        trouble[0] if trouble else "",
    )


def _typed(log: str) -> Iterator[str]:
    """Yield the lines that the program typed, without the prompts for the keyboard.

    The carriage returns before each line, so that a line ends where the next one begins.
    """
    # The simulator's own lines come before or after those of the program, depending on the buffers of its version.
    lines = log.partition("LOAD DATA\n")[2].split("\n")
    yield from (line.removeprefix(">") for line in lines if line and not _SIMULATOR.match(line))


def _typewriter(command: list[str], folder: Path, keys: Sequence[str], seconds: float) -> str:
    """Run the simulator and type a line at each prompt.  Return everything it wrote.  Raise Failed."""
    deadline = time.monotonic() + seconds
    waiting = list(keys)
    log = b""
    # The simulator polls the keyboard while it runs, so that reading must not block and earlier keys would be lost.
    keyboard, typing = os.pipe()
    os.set_blocking(keyboard, False)
    with (
        os.fdopen(typing, "wb", buffering=0) as hands,
        subprocess.Popen(
            command, cwd=folder, stdin=keyboard, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
        ) as process,
    ):
        os.close(keyboard)
        assert process.stdout is not None
        try:
            while True:
                ready = select.select([process.stdout], [], [], max(0.0, deadline - time.monotonic()))[0]
                if not ready:
                    raise Failed(f"the simulator did not finish within {seconds:g} seconds; it wrote {log[-200:]!r}")
                text = os.read(process.stdout.fileno(), 65536)
                if not text:
                    break
                log += text
                if log.endswith(b"\n>"):
                    if not waiting:
                        raise Failed("the program waits for a typed line, but no more lines were provided")
                    hands.write(waiting.pop(0).encode() + b"\r")
        finally:
            process.kill()
    return log.decode("latin1").replace("\r", "")
