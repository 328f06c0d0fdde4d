"""Control SIMH's simulator of the 1620, ``i1620``: load a deck, set core storage, run, and return the output."""

from __future__ import annotations

import os
import re
import select
import shutil
import subprocess
import time
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

SECONDS = 20.0

# Jobs that one simulator executes, and the instructions that each of them may execute.
BATCH, STEPS = 500, 5_000_000

# Lines of the output that the simulator itself writes, not the simulated program.
_SIMULATOR = re.compile(
    r"IBM 1620 simulator|CD[PR]: |HALT instruction|Goodbye|\d{4,5}:\t|Invalid |No card in|Step expired|%SIM-INFO|"
    r"/.*\.ini-\d"
)
# The simulator may write a position directly after a typed line, because the carriage returns before the next line.
_POSITION = re.compile(r"(\d{4,5}):\t([0-9A-F]{2})\n?")
_TIME = re.compile(r"^TIME:\t(\d+)\n", re.MULTILINE)
# The milliseconds that one unit of the simulator's counter of time stands for.
_UNIT = 0.004
_TROUBLE = re.compile(r"^(?:Invalid|No card in|Step expired) ?[^\n]*$", re.MULTILINE)


class Unavailable(Exception):
    """Raised if the simulator or IBM's object deck is missing.  The message says how to provide it."""


class Failed(Exception):
    """Raised if the simulator did not finish a run."""


@dataclass(frozen=True, slots=True)
class Run:
    """The output of a run: typed lines, punched cards of 80 columns, and the examined positions of core storage.

    ``core`` maps the address of each position to its contents.  ``trouble`` is the simulator's message if an invalid
    instruction or address stopped the run, otherwise it is empty.
    """

    typed: tuple[str, ...]
    punched: tuple[str, ...]
    core: Mapping[int, int] = field(default_factory=dict)
    trouble: str = ""
    # The time of the executed instructions, or None if the simulator does not count it (instruction_times.patch).
    milliseconds: float | None = None

    def field(self, address: int) -> list[int]:
        """Return the ten digits of the storage field whose last digit is at ``address``."""
        return [self.core[position] for position in range(address - 9, address + 1)]


@dataclass(frozen=True, slots=True)
class Job:
    """A program to run on the loaded library.

    ``start`` is its first instruction, ``stored`` maps addresses to the digits to store there, and ``examine`` has the
    first and the last address of each range of storage to return.
    """

    start: int
    stored: Mapping[int, Sequence[int]]
    cards: Sequence[str] = ()
    examine: Sequence[tuple[int, int]] = ()


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
    core: int = 20000,
    cards: Sequence[str] = (),
    keys: Sequence[str] = (),
    starts: Sequence[Collection[int]] = (),
    seconds: float = SECONDS,
    timed: bool = False,
) -> Run:
    """Load a deck into the simulated 1620, run it, and return the output.

    Parameters
    ----------
    deck, cards
        The cards to load, and the data cards that follow them.
    keys
        The lines to type, one for each time that the program waits for the typewriter.
    starts
        For each time that START is pressed after a PAUSE, the sense switches that are on.
    timed
        Return also the time of the instructions executed after loading.

    Raises
    ------
    Unavailable
        If the simulator is not installed, or does not count the time.
    Failed
        If the run takes longer than ``seconds``.
    """
    script = ["attach -n cdp punched-0", "boot cdr", *(["deposit time 0"] if timed else []), "continue"]
    for on in starts:
        script += [*(f"deposit sw{number} {int(number in on)}" for number in (1, 2, 3, 4)), "continue"]
    script += ["examine time"] if timed else []
    log, (punched,) = _execute(script, {"deck": [*deck, *cards]}, 1, keys, core, seconds)
    result = _result(log.partition("LOAD DATA\n")[2], punched)
    if timed and result.milliseconds is None:
        raise Unavailable("this simulator does not count time; apply modern/bench/ibm1962/instruction_times.patch")
    return result


def run_jobs(deck: Sequence[str], jobs: Sequence[Job], keys: Sequence[str] = ()) -> list[Run]:
    """Load a deck once for many jobs, run them one after the other, and return their outputs.

    Core storage is not cleared between jobs: the library's working storage passes from each job to the next.  Raise
    Unavailable if the simulator is missing, or Failed if a run fails.
    """
    results: list[Run] = []
    for at in range(0, len(jobs), BATCH):
        batch = jobs[at : at + BATCH]
        script, files = ["attach -n cdp loading", "boot cdr"], {"deck": deck}
        for k, job in enumerate(batch):
            files[f"cards-{k}"] = job.cards
            script += [f"attach -n cdp punched-{k}", f"attach cdr cards-{k}"]
            for address, positions in job.stored.items():
                script += [f"deposit {address + n} {position:X}" for n, position in enumerate(positions)]
            script += [f"deposit pc {job.start}", "echo JOB", f"step {STEPS}"]
            script += [f"examine {first}-{last}" for first, last in job.examine]
        log, punched = _execute(script, files, len(batch), keys, 20000, SECONDS + len(batch))
        results += map(_result, log.split("JOB\n")[1:], punched)
    return results


def _execute(
    script: Sequence[str],
    files: Mapping[str, Sequence[str]],
    count: int,
    keys: Sequence[str],
    core: int,
    seconds: float,
) -> tuple[str, list[list[str]]]:
    """Run the simulator with files of cards.  Return its log and the contents of ``count`` files of punched cards."""
    first = [f"set cpu {core // 1000}K", "deposit arstop 0", "attach cdr deck"]
    with TemporaryDirectory(prefix="i1620-") as folder:
        here = Path(folder)
        for name, cards in files.items():
            (here / name).write_text("".join(f"{card}\n" for card in cards), encoding="latin1")
        (here / "run.ini").write_text("\n".join([*first, *script, "detach all", "quit"]) + "\n")
        log = _typewriter([simulator(), "run.ini"], here, keys, seconds)
        paths = [here / f"punched-{k}" for k in range(count)]
        return log, [path.read_text(encoding="latin1").splitlines() if path.exists() else [] for path in paths]


def _result(log: str, punched: Sequence[str]) -> Run:
    trouble, time_counted = _TROUBLE.search(log), _TIME.search(log)
    lines = _TIME.sub("", _POSITION.sub("", log)).split("\n")
    # The simulator's own lines come before or after those of the program, depending on the buffers of its version.
    typed = (line.removeprefix(">") for line in lines if line and not _SIMULATOR.match(line))
    return Run(
        tuple(typed),
        tuple(punched),
        {int(address): int(position, 16) for address, position in _POSITION.findall(log)},
        trouble[0] if trouble else "",
        _UNIT * int(time_counted[1]) if time_counted else None,
    )


def _typewriter(command: list[str], folder: Path, keys: Sequence[str], seconds: float) -> str:
    """Run the simulator, type one of the lines ``keys`` at each prompt, and return all output of the simulator.

    Raise Failed if the simulator takes longer than ``seconds`` or prompts for more lines than ``keys`` has.
    """
    deadline = time.monotonic() + seconds
    waiting = list(keys)
    log = b""
    # The simulator polls the keyboard while it runs.  A terminal is therefore needed, and each line is typed only after
    # its prompt, because lines that are typed earlier would be lost.
    typing, keyboard = os.openpty()
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
