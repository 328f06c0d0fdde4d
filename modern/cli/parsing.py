"""What the arguments of several commands share: the parser that says an error in one line, and how a command begins."""

from __future__ import annotations

import argparse
from typing import TypeAlias

from modern.cli.exits import BAD_INPUT


class Parser(argparse.ArgumentParser):
    def error(self, message: str) -> None:  # type: ignore[override]
        """One line and exit 2, without the usage lines argparse would print first."""
        self.exit(BAD_INPUT, f"{self.prog}: {message} (try {self.prog} --help)\n")


Commands: TypeAlias = "argparse._SubParsersAction[Parser]"


def command(commands: Commands, name: str, help_: str, module: str) -> argparse.ArgumentParser:
    """A command's parser; ``module`` is imported when it is called."""
    parser = commands.add_parser(name, help=help_, description=help_[0].upper() + help_[1:] + ".")
    parser.set_defaults(module=module)
    return parser
