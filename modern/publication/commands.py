"""The reference of the commands, made from their parsers: every argument with what its help says.

:func:`commands` reads a parser (that of ``modern.cli.main``) into plain data, :func:`as_markdown` sets them out; site
and book put the text where a page says ``{{ commands }}`` (``modern/publication/figures.py``).
"""

from __future__ import annotations

import re
from argparse import SUPPRESS, Action, ArgumentParser
from collections.abc import Iterable
from dataclasses import dataclass

_COUNTED = {"": "{}", "?": "[{}]", "*": "[{} ...]", "+": "{} ..."}
_UNSAID = "a program: a file, or the name of one built in"


@dataclass(frozen=True, slots=True)
class Argument:
    """An option or an operand.

    ``forms``: how it is written; ``value``: what is written after an option; ``says``: its help; ``count``: of an
    operand ``?`` where it may be left out, ``*`` where there may be any number, ``+`` at least one.
    """

    forms: tuple[str, ...]
    value: str
    says: str
    count: str = ""

    @property
    def is_option(self) -> bool:
        """Whether it begins with a minus."""
        return self.forms[0].startswith("-")


@dataclass(frozen=True, slots=True)
class Command:
    """A command: its name, what it does in one sentence, its line of usage, its arguments in the order of the help."""

    name: str
    says: str
    usage: str
    arguments: tuple[Argument, ...]


def commands(parser: ArgumentParser) -> tuple[Command, ...]:
    """Every command of a parser that has commands, in its order.  Raises ValueError for one that has none."""
    for action in parser._actions:  # argparse has no public list of them
        if isinstance(action.choices, dict):
            return tuple(_command(name, one) for name, one in action.choices.items())
    raise ValueError(f"{parser.prog} has no commands")


def _command(name: str, parser: ArgumentParser) -> Command:
    arguments = tuple(_argument(action) for action in parser._actions if action.help is not SUPPRESS)
    operands = (_COUNTED[one.count].format(one.forms[0]) for one in arguments if not one.is_option)
    usage = " ".join((f"hull1620 {name}", "[OPTION ...]", *operands))
    return Command(name, parser.description or "", usage, tuple(sorted(arguments, key=lambda one: one.is_option)))


def _argument(action: Action) -> Argument:
    choices = [str(choice) for choice in action.choices or ()]
    value = action.metavar if isinstance(action.metavar, str) else "{" + ",".join(choices) + "}" if choices else ""
    if not value and action.nargs != 0:
        value = action.dest.upper()
    says = (action.help or "") % {**vars(action), "prog": "hull1620"}
    if action.option_strings:
        return Argument(tuple(action.option_strings), value if action.nargs != 0 else "", says)
    return Argument((value,), "", says, str(action.nargs or ""))


def as_markdown(found: Iterable[Command]) -> str:
    """A table of all, then a section a command: what it does, its usage, a table of its arguments."""
    found = tuple(found)
    lines = [f"| [`{command.name}`](#{command.name}) | {_cell(command.says)} |" for command in found]
    return "\n\n".join(["\n".join(("| command | what it does |", "|---|---|", *lines)), *map(_section, found)])


def _section(command: Command) -> str:
    lines = [f"## {command.name}", "", command.says, "", "```text", command.usage, "```", ""]
    lines += ["| argument | what it says |", "|---|---|"]
    lines += [f"| {_written(one)} | {_said(one.says) or _UNSAID} |" for one in command.arguments]
    return "\n".join(lines)


def _written(argument: Argument) -> str:
    joined = "" if argument.value.startswith("=") or not argument.value else " "
    return ", ".join(f"`{_cell(form + joined + argument.value)}`" for form in argument.forms)


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")


def _said(text: str) -> str:
    """A help as a cell: options in it are names, so that no two minuses become a dash."""
    return re.sub(r"(?<![\w`-])--[a-z][\w=-]*", lambda found: f"`{found[0]}`", _cell(text))
