"""Let the person at the terminal be the operator of a run.

The terminal needs only two abilities: to show lines of text, with backspace as the only movement of the cursor, and to
send single keys. The module uses the controlling terminal, ``/dev/tty``, even if the standard streams are redirected.
"""

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
# The keys of the sense switches: Escape or Alt with a digit, and the sequences that terminals send for F1 to F4.
_SWITCH_KEYS = {
    **{f"\x1b{n}": n for n in (1, 2, 3, 4)},
    **{f"\x1bO{letter}": n for n, letter in enumerate("PQRS", 1)},
    **{f"\x1b[1{n}~": n for n in (1, 2, 3, 4)},
    **{f"\x1b[[{letter}": n for n, letter in enumerate("ABCD", 1)},
}
_ATTENTIONS = (ATTENTION, "\x1ba", "\x1bA")


class Keys:
    """The keyboard and the screen of a terminal, read key by key.

    is_gone: True if the terminal has been closed.  was_interrupted: True if SIGINT arrived, which counts as ATTN.
    """

    def __init__(self, handle: int) -> None:
        self._handle = handle
        self.is_gone = False
        self.was_interrupted = False

    @property
    def width(self) -> int:
        """Return the number of columns available for text."""
        try:
            columns = os.get_terminal_size(self._handle).columns
        except OSError:
            columns = 0
        return min(max(columns or 80, NARROWEST), WIDEST) - 1

    def write(self, text: str) -> None:
        """Show text on the terminal, unless the terminal has been closed."""
        data = text.encode("ascii", "backslashreplace")
        while data and not self.is_gone:
            try:
                data = data[os.write(self._handle, data) :]
            except OSError:
                self.is_gone = True

    def is_ready(self, seconds: float = 0.0) -> bool:
        """Return True if a key can be read within the given time."""
        return self.is_gone or self.was_interrupted or bool(select.select([self._handle], [], [], seconds)[0])

    def key(self) -> str:
        """Return the next key with its escape sequence, or an empty string if the terminal has been closed.

        Every way to press ATTN is returned as ATTENTION.
        """
        while not self.is_ready(0.2):
            pass
        if self.was_interrupted:
            self.was_interrupted = False
            return ATTENTION
        key = self._byte()
        if key == "\x1b":
            # An escape sequence ends with "~" or with a letter, but an O in second place does not end it.
            while self.is_ready(1.0) and not (self.is_gone or self.was_interrupted) and len(key) < 6:
                key += self._byte()
                if key[-1] == "~" or (key[-1].isalpha() and key[-1] != "O") or key[1] not in "O[":
                    break
        return ATTENTION if key in _ATTENTIONS else key

    def _byte(self) -> str:
        try:
            data = os.read(self._handle, 1)
        except OSError:
            data = b""
        self.is_gone = self.is_gone or not data
        return data.decode("latin-1")


class Terminal(Operator):
    """An operator who reads the typed lines at the terminal and types the answers there.

    slow: True to show lines at the speed of the typewriter. waits: True if a program that has just been loaded waits
    for START.
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
        """Show a line of the typewriter. If it is shown slowly, ATTN completes it at once."""
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
            self._note(
                f"{session.program.source} is loaded. Ctrl-C, or Esc and A: ATTN, which stops the program before its "
                "next statement. F1 to F4, or Esc and 1 to 4: turn a sense switch on or off"
            )
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
        if self._keys.is_gone:
            yield Action("STOP")

    def answer(self, session: Session, halt: Halt) -> Action:
        if halt is not self._halt:
            self._report_halt(session, halt)
        while True:
            line = self._read("1620> " if self._commands else "")
            if self._keys.is_gone:
                return Action("STOP")
            if line in _SWITCH_KEYS:
                return self._switched(flipped(session, _SWITCH_KEYS[line]))
            if line == END:
                return Action("STOP")
            if line == ATTENTION:
                if not self._commands:
                    self._commands = True
                    self._note("Type a command. Enter: back to the line that ACCEPT reads. STOP: end the run. ?: help")
            elif not self._commands:
                return Action("ENTER", text=line)
            else:
                reply = command(session, line, self._cards, self._keys.width)
                if isinstance(reply, list):
                    self._keys.write("".join(text + "\n" for text in reply))
                    continue
                if reply.word in ("START", "STEP") and halt.what == "accept":
                    self._commands = False
                    self._note(halt_line(halt))
                if reply.word == "SWITCH":
                    self._note(action_line(reply))
                if reply.word != "START" or halt.what != "accept":
                    return reply

    def _report_halt(self, session: Session, halt: Halt) -> None:
        if halt.why == "step" and session.last is not None:
            self._keys.write("".join(text + "\n" for text in done(session, session.last, self._keys.width)))
        self._halt = halt
        self._commands = halt.what != "accept"
        self._note(halt_line(halt))

    def _switched(self, action: Action) -> Action:
        self._note(action_line(action))
        return action

    def _note(self, text: str) -> None:
        self._keys.write("".join(f"-- {line}\n" for line in wrapped(text, self._keys.width - 3)))

    def _collect(self) -> None:
        """Collect the keys that were pressed while the machine ran, as the beginning of the next answer."""
        while not self._keys.is_gone and self._keys.is_ready():
            self._ahead.append(self._keys.key())

    def _read(self, prompt: str) -> str:
        """Return a line that the operator types, in capitals, or one of ATTENTION, END and the switch keys.

        Text that was typed before a switch key is kept for the next call.
        """
        self._keys.write(prompt + self._line)
        while not self._keys.is_gone:
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
        """Erase the last characters of the line that the operator is typing.

        If these characters begin on an earlier row of the screen, which backspace cannot reach, the remaining text is
        shown again on a new row.
        """
        remaining, row = self._line[: len(self._line) - count], self._keys.width + 1
        if len(prompt + remaining) // row == len(prompt + self._line) // row:
            self._keys.write("\b \b" * count)
        else:
            self._keys.write("\n" + prompt + remaining)
        self._line = remaining


@contextmanager
def terminal(slow: bool = False, waits: bool = True) -> Iterator[Terminal]:
    """Yield the operator at the controlling terminal, and restore its settings afterwards.

    Raise UsageError if there is no controlling terminal.
    """
    try:
        handle = os.open("/dev/tty", os.O_RDWR | os.O_NOCTTY)
    except OSError as error:
        raise UsageError(f"--operator: no terminal (/dev/tty: {reason(error)}); use --operator=FILE") from None
    try:
        original = termios.tcgetattr(handle)
        key_by_key = termios.tcgetattr(handle)
        key_by_key[3] &= ~(termios.ICANON | termios.ECHO)
        # Ctrl-C is read as a key; Ctrl-Z and Ctrl-\ keep their usual effect.
        key_by_key[6][termios.VINTR] = b"\x00"
        key_by_key[6][termios.VMIN], key_by_key[6][termios.VTIME] = 1, 0

        def resumed(number: int, frame: FrameType | None) -> None:
            with suppress(termios.error):
                termios.tcsetattr(handle, termios.TCSANOW, key_by_key)

        def interrupted(number: int, frame: FrameType | None) -> None:
            keys.was_interrupted = True

        keys = Keys(handle)
        old_continue = signal.signal(signal.SIGCONT, resumed)
        old_interrupt = signal.signal(signal.SIGINT, interrupted)
        # If the terminal is closed, the next key reports it and the run stops with its results kept.
        old_hangup = signal.signal(signal.SIGHUP, signal.SIG_IGN)
        try:
            termios.tcsetattr(handle, termios.TCSADRAIN, key_by_key)
            yield Terminal(keys, slow, waits)
        finally:
            signal.signal(signal.SIGCONT, old_continue)
            signal.signal(signal.SIGHUP, old_hangup)
            signal.signal(signal.SIGINT, old_interrupt)
            with suppress(termios.error):
                termios.tcsetattr(handle, termios.TCSADRAIN, original)
    finally:
        os.close(handle)
