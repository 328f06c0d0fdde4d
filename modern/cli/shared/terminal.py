"""A person at a terminal as the operator of a run.

No more is asked of the terminal than lines of text and single keys: no cursor movement but backspace, no colours.  It
is the controlling terminal, ``/dev/tty``, whatever the standard streams are.
"""

from __future__ import annotations

import os
import select
import signal
import termios
import time
from collections import deque
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from types import FrameType

from emulator.files import reason
from emulator.machine.console import Cards, command, done, flipped, wrapped
from emulator.machine.operator import Operator
from emulator.machine.result import Event
from emulator.machine.session import Action, Halt, Session
from emulator.machine.timing import TYPEWRITER_SECONDS
from emulator.machine.words import action_line, halt_line
from modern.cli.shared.console import UsageError

NARROWEST, WIDEST = 20, 100
ATTENTION, END, ENTER, ERASE, KILL = "\x03", "\x04", "\r\n", "\x7f\x08", "\x15"
_SWITCH_KEYS = {
    **{f"\x1b{n}": n for n in (1, 2, 3, 4)},
    **{f"\x1bO{letter}": n for n, letter in enumerate("PQRS", 1)},
    **{f"\x1b[1{n}~": n for n in (1, 2, 3, 4)},
    **{f"\x1b[[{letter}": n for n, letter in enumerate("ABCD", 1)},
}
"""Escape and a digit (Alt with it), and what terminals send for F1 to F4."""
_ATTENTIONS = (ATTENTION, "\x1ba", "\x1bA")


class Keys:
    """The keys and the paper of a terminal, one key at a time."""

    def __init__(self, handle: int) -> None:
        self._handle = handle
        self.gone = False
        self.called = False

    @property
    def width(self) -> int:
        """Columns to write in."""
        try:
            columns = os.get_terminal_size(self._handle).columns
        except OSError:
            columns = 0
        return min(max(columns or 80, NARROWEST), WIDEST) - 1

    def write(self, text: str) -> None:
        """Show text; a terminal that has gone shows nothing."""
        data = text.encode("ascii", "backslashreplace")
        while data and not self.gone:
            try:
                data = data[os.write(self._handle, data) :]
            except OSError:
                self.gone = True

    def waiting(self, seconds: float = 0.0) -> bool:
        """Whether a key has been pressed."""
        return self.gone or self.called or bool(select.select([self._handle], [], [], seconds)[0])

    def key(self) -> str:
        """The next key, with all that follows an escape; empty when the terminal has gone.

        ATTN is one key, whatever it was; ``called``, set at any time, counts as that key.
        """
        while not self.waiting(0.2):
            pass
        if self.called:
            self.called = False
            return ATTENTION
        found = self._byte()
        if found == "\x1b":
            while self.waiting(1.0) and not (self.gone or self.called) and len(found) < 6:
                found += self._byte()
                if found[-1] == "~" or (found[-1].isalpha() and found[-1] != "O") or found[1] not in "O[":
                    break
        return ATTENTION if found in _ATTENTIONS else found

    def _byte(self) -> str:
        try:
            data = os.read(self._handle, 1)
        except OSError:
            data = b""
        self.gone = self.gone or not data
        return data.decode("latin-1")


class Terminal(Operator):
    """Shows what the typewriter types, and asks the person at the terminal.

    ``slow``: lines appear at the typewriter's speed.  ``waits``: a machine just loaded waits for START.
    """

    present = True

    def __init__(self, keys: Keys, slow: bool = False, waits: bool = True) -> None:
        super().__init__()
        self._keys, self._slow, self._waits = keys, slow, waits
        self._ahead: deque[str] = deque()
        self._cards = Cards()
        self._session: Session | None = None
        self._halt: Halt | None = None
        self._commands = False
        self._line = ""

    def happened(self, events: Sequence[Event]) -> None:
        self._cards.see(events)

    def show(self, line: str) -> None:
        """A line of the typewriter."""
        for start in range(len(line) + 1 if self._slow else 0):
            self._keys.write(line[start : start + 1] or "\n")
            self._collect()
            if ATTENTION in self._ahead:
                self._keys.write(line[start + 1 :] + "\n" * (start < len(line)))
                return
            time.sleep(TYPEWRITER_SECONDS)
        if not self._slow:
            self._keys.write(line + "\n")

    def attend(self, session: Session) -> Iterator[Action]:
        if session is not self._session:
            self._session, self._cards = session, Cards()
            self._say(f"{session.program.source} is loaded; Ctrl-C or Esc A: ATTN; F1 to F4, or Esc 1 to 4: switches")
            if self._waits:
                yield Action("ATTN")
                return
        self._collect()
        for key in [key for key in self._ahead if key == ATTENTION or key in _SWITCH_KEYS]:
            self._ahead.remove(key)
            if key == ATTENTION:
                yield Action("ATTN")
            else:
                yield self._switched(flipped(session, _SWITCH_KEYS[key]))
        if self._keys.gone:
            yield Action("STOP")

    def answer(self, session: Session, halt: Halt) -> Action:
        if halt is not self._halt:
            self._stand(session, halt)
        while True:
            line = self._read("1620> " if self._commands else "")
            if self._keys.gone:
                return Action("STOP")
            if line in _SWITCH_KEYS:
                return self._switched(flipped(session, _SWITCH_KEYS[line]))
            if line == END:
                return Action("STOP")
            if line == ATTENTION:
                if not self._commands:
                    self._commands = True
                    self._say("Enter: back to the line; STOP: end the run; ?: help")
            elif not self._commands:
                return Action("ENTER", text=line)
            else:
                found = command(session, line, self._cards, self._keys.width)
                if isinstance(found, list):
                    self._keys.write("".join(text + "\n" for text in found))
                    continue
                if found.word in ("START", "STEP") and halt.what == "accept":
                    self._commands = False
                    self._say(halt_line(halt))
                if found.word == "SWITCH":
                    self._say(action_line(found))
                if found.word != "START" or halt.what != "accept":
                    return found

    def _stand(self, session: Session, halt: Halt) -> None:
        """The machine has come to stand: say why."""
        if halt.why == "step" and session.last is not None:
            self._keys.write("".join(text + "\n" for text in done(session, session.last, self._keys.width)))
        self._halt = halt
        self._commands = halt.what != "accept"
        self._say(halt_line(halt))

    def _switched(self, action: Action) -> Action:
        self._say(action_line(action))
        return action

    def _say(self, text: str) -> None:
        self._keys.write("".join(f"-- {line}\n" for line in wrapped(text, self._keys.width - 3)))

    def _collect(self) -> None:
        """Take the keys pressed while the machine runs; they are for whatever asks next."""
        while not self._keys.gone and self._keys.waiting():
            self._ahead.append(self._keys.key())

    def _read(self, prompt: str) -> str:
        """A line, in capitals as the typewriter has them; or one of ATTENTION, END and the switch keys.

        What was typed before a switch key stays for the next call.
        """
        self._keys.write(prompt + self._line)
        while not self._keys.gone:
            key = self._ahead.popleft() if self._ahead else self._keys.key()
            if key and key in ENTER:
                self._keys.write("\n")
                line, self._line = self._line, ""
                return line
            if key == ATTENTION or key in _SWITCH_KEYS or (key == END and not self._line):
                self._keys.write("\n")
                self._line = "" if key == ATTENTION else self._line
                return key
            if key and key in ERASE and self._line:
                self._erase(prompt, 1)
            elif key == KILL:
                self._erase(prompt, len(self._line))
            elif len(key) == 1 and " " <= key <= "~":
                self._line += key.upper()
                self._keys.write(key.upper())
        return ""

    def _erase(self, prompt: str, count: int) -> None:
        """Take back the last characters; where they reach back over a line's end, show what is left on a new one."""
        left, row = self._line[: len(self._line) - count], self._keys.width + 1
        if len(prompt + left) // row == len(prompt + self._line) // row:
            self._keys.write("\b \b" * count)
        else:
            self._keys.write("\n" + prompt + left)
        self._line = left


@contextmanager
def terminal(slow: bool = False, waits: bool = True) -> Iterator[Terminal]:
    """The operator at the controlling terminal, whose settings are put back afterwards.

    Raises UsageError where there is none.
    """
    try:
        handle = os.open("/dev/tty", os.O_RDWR | os.O_NOCTTY)
    except OSError as error:
        raise UsageError(f"--operator: there is no terminal to talk to (/dev/tty: {reason(error)})") from None
    try:
        before = termios.tcgetattr(handle)
        keyed = termios.tcgetattr(handle)
        keyed[3] &= ~(termios.ICANON | termios.ECHO)
        # Ctrl-C comes as a key; Ctrl-Z and Ctrl-\ do what they always do.
        keyed[6][termios.VINTR] = b"\x00"
        keyed[6][termios.VMIN], keyed[6][termios.VTIME] = 1, 0

        def resumed(number: int, frame: FrameType | None) -> None:
            with suppress(termios.error):
                termios.tcsetattr(handle, termios.TCSANOW, keyed)

        def interrupted(number: int, frame: FrameType | None) -> None:
            keys.called = True

        keys = Keys(handle)
        continued = signal.signal(signal.SIGCONT, resumed)
        called = signal.signal(signal.SIGINT, interrupted)
        # A terminal that goes away is found gone at the next key, and the run stopped, what it did being kept.
        hung_up = signal.signal(signal.SIGHUP, signal.SIG_IGN)
        try:
            termios.tcsetattr(handle, termios.TCSADRAIN, keyed)
            yield Terminal(keys, slow, waits)
        finally:
            signal.signal(signal.SIGCONT, continued)
            signal.signal(signal.SIGHUP, hung_up)
            signal.signal(signal.SIGINT, called)
            with suppress(termios.error):
                termios.tcsetattr(handle, termios.TCSADRAIN, before)
    finally:
        os.close(handle)
