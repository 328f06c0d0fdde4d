"""Choose the operator of a run: a person at the terminal, a file or a log of answers, standard input, or nobody."""

import argparse
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass

from emulator.files import read_text, source_name, writing
from emulator.language import objectcode as op
from emulator.language.objectcode import Program
from emulator.machine.operator import FromFile, Logged, Operator
from modern.cli.shared.console import UsageError, print_notes
from modern.cli.shared.run_output import is_terminal


@dataclass(frozen=True)
class Attendance:
    """The operator of a run.

    show: a function that shows a typed line to a person at the terminal, or None.  file: the file whose lines answer
    the program's questions, or None.
    """

    operator: Operator
    show: Callable[[str], None] | None
    file: FromFile | None

    def print_unused(self) -> None:
        """Print a note if the run did not use all lines of the file of answers."""
        if self.file is not None and self.file.first_unused:
            print_notes([f"note: {self.file.name}: the run did not use line {self.file.first_unused} and later lines"])


@contextmanager
def attended(args: argparse.Namespace, program: Program | None = None) -> Iterator[Attendance]:
    """Yield the operator that ``--operator`` names; ``--log`` records the operator's actions.

    program: the program that asks the questions.  Without ``--operator``, the person at the terminal answers if the
    program has ACCEPT or PAUSE and all standard streams are the terminal.  Otherwise the answers are the lines of
    standard input, unless standard input is a deck or a terminal.  Raise UsageError, or FileError for an unreadable
    file.
    """
    name: str | None = args.operator
    inputs = [getattr(args, "program", None), args.deck]
    with ExitStack() as stack:
        file: FromFile | None = None
        show: Callable[[str], None] | None = None
        operator: Operator
        if name == "" or (name is None and program is not None and _has_questions(args, program)):
            from modern.cli.shared.terminal import terminal

            person = stack.enter_context(terminal(args.slow, waits=name is not None))
            operator, show = person, person.show
        elif name is not None and name != "none":
            if name == "-" and "-" in inputs:
                raise UsageError("--operator: standard input is already the program or the deck; name a file")
            operator = file = FromFile(source_name(name), read_text(name))
        else:
            reads_stdin = program is not None and "-" not in inputs and sys.stdin is not None and not sys.stdin.isatty()
            operator = Operator(sys.stdin if reads_stdin else ())
        if args.slow and show is None:
            raise UsageError("--slow needs an operator at the terminal; add --operator")
        if args.log is not None:
            operator = Logged(operator, stack.enter_context(writing(args.log)))
        yield Attendance(operator, show, file)


def _has_questions(args: argparse.Namespace, program: Program) -> bool:
    if not (args.deck and os.path.isfile(args.deck)):
        return False
    if not all(map(is_terminal, (sys.stdin, sys.stdout, sys.stderr))):
        return False
    return program.uses("ACCEPT") or any(i.operation == op.PAUSE for i in program.code)
