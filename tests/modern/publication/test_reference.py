"""The reference pages made from the code: every command with every option, every public name; the figures of a text."""

from __future__ import annotations

import argparse
import re
from types import ModuleType

import pytest

import hull1620
from modern.cli.arguments import COMMANDS
from modern.cli.main import build_parser
from modern.publication import commands, interface

PARSER = build_parser([])
FOUND = commands.commands(PARSER)
TEXT = commands.as_markdown(FOUND)


def sections(text: str, level: str) -> dict[str, str]:
    parts = re.split(rf"^{level} (.*)\n", text, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


@pytest.mark.parametrize("name", COMMANDS)
def test_every_option_of_a_command_stands_in_its_section(name: str) -> None:
    parser = build_parser([name])
    (one,) = [action.choices[name] for action in parser._actions if isinstance(action.choices, dict)]
    section = sections(TEXT, "##")[name]
    assert one.description in section
    for action in one._actions:
        for form in action.option_strings or [action.metavar]:
            assert re.search(rf"^\| .*`{re.escape(form)}[ =`]", section, re.MULTILINE), form
        assert "%(" not in section
    assert len(re.findall(r"^\| `", section, re.MULTILINE)) == len(one._actions)


def test_the_commands_stand_in_the_order_of_the_help() -> None:
    assert [command.name for command in FOUND] == list(COMMANDS)


def test_the_table_of_all_links_to_every_section() -> None:
    assert re.findall(r"^\| \[`([\w-]+)`\]\(#\1\) \| \w", TEXT, re.MULTILINE) == list(COMMANDS)
    assert list(sections(TEXT, "##")) == list(COMMANDS)


def test_an_argument_as_it_is_written() -> None:
    parser = argparse.ArgumentParser()
    one = parser.add_subparsers().add_parser("do", description="Does it.")
    one.add_argument("thing", metavar="THING", help="a | b")
    one.add_argument("rest", metavar="REST", nargs="*")
    one.add_argument("--size", type=int, default=3, help="how large (default: %(default)s)")
    one.add_argument("--kind", choices=("x", "y"), help="100 %% sure, with --size=3 x--y")
    one.add_argument("--secret", help=argparse.SUPPRESS)
    (command,) = commands.commands(parser)
    assert command.usage == "hull1620 do [OPTION ...] THING [REST ...]"
    assert commands.as_markdown([command]).splitlines()[-5:] == [
        "| `THING` | a \\| b |",
        "| `REST` | a program: a file, or the name of one built in |",
        "| `-h`, `--help` | show this help message and exit |",
        "| `--size SIZE` | how large (default: 3) |",
        "| `--kind {x,y}` | 100 % sure, with `--size=3` x--y |",
    ]


def test_a_parser_without_commands_is_refused() -> None:
    with pytest.raises(ValueError, match="no commands"):
        commands.commands(argparse.ArgumentParser(prog="alone"))


def test_every_public_name_has_a_section_with_its_docstring() -> None:
    found = sections(interface.as_markdown(interface.names(hull1620)), "###")
    assert sorted(found) == sorted(hull1620.__all__)
    for name, text in found.items():
        first = (getattr(hull1620, name).__doc__ or "").split("\n")[0].replace("``", "`")
        assert re.sub(r":\w+:`", "`", first) in text, name
        assert "object at" not in text
        assert " at 0x" not in text


def made_up() -> ModuleType:
    """A package of one function, one class and one error."""

    def join(points: object, *, how: str = "all", by: object = len) -> None:
        """Join ``points``; see :func:`other`.  As::

            join(1)

        points: any number of them, all:
        taken.  how: in what way.  Raises Trouble.
        """

    class Thing:
        """What joins."""

        def __init__(self, size: int = 3) -> None:
            self._size = size

        @property
        def size(self) -> int:
            """How large
            it is.
            """
            return self._size

        def grow(self, by: int) -> None:
            """Larger | smaller."""

        def silent(self) -> None:
            pass

    class Trouble(ValueError):
        """It cannot be."""

    package = ModuleType("made_up")
    package.__dict__.update(join=join, Thing=Thing, Trouble=Trouble, __all__=["Thing", "Trouble", "join"])
    return package


def test_a_function_a_class_and_an_error_as_they_are_set_out() -> None:
    found = interface.names(made_up())
    assert [(name.name, name.kind) for name in found] == [
        ("Thing", "class"),
        ("Trouble", "exception"),
        ("join", "function"),
    ]
    parts = sections(interface.as_markdown(found), "###")
    assert list(parts) == ["join", "Thing", "Trouble"]
    assert "join(points, *, how='all', by=len)" in parts["join"]
    assert "Join `points`; see `other`.  As:\n\n```text\njoin(1)\n```\n" in parts["join"]
    assert "- `points`: any number of them, all: taken.\n- `how`: in what way.\n\nRaises Trouble." in parts["join"]
    assert "Thing(size=3)" in parts["Thing"]
    assert "| `size` | How large it is. |\n| `grow(by)` | Larger \\| smaller. |" in parts["Thing"]
    assert "silent" not in parts["Thing"]
    assert "```" not in parts["Trouble"]
