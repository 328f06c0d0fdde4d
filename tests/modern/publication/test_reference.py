"""The reference pages that Sphinx generates: all commands with all options, and all public names."""

from pathlib import Path

import pytest

import hull1620
from modern.cli.arguments import COMMANDS
from modern.cli.main import build_parser
from tests.support.editions import pages, words


def plain(text: str) -> str:
    """Return a text without line breaks and with straight quotation marks."""
    return " ".join(text.translate(dict(zip(map(ord, "‘’“”"), "''\"\"", strict=True))).split())


@pytest.mark.parametrize("command", COMMANDS)
def test_the_section_of_a_command_has_all_options_with_their_help(site: Path, command: str) -> None:
    (parser,) = [a.choices[command] for a in build_parser([command])._actions if isinstance(a.choices, dict)]
    page = pages(site)["reference/commands.html"]
    (section,) = page.root.xpath(f'//section[span[@id="{command}"] or @id="{command}"]')
    text = plain(words(section))
    assert plain(parser.description) in text
    for action in (action for action in parser._actions if action.dest != "help"):
        assert ", ".join(action.option_strings or [action.metavar]) in text
        # A default in the help is quoted, so only the text before it is compared.
        assert plain(action.help or "").partition("%")[0] in text


def test_every_public_name_has_an_entry(site: Path) -> None:
    page = pages(site)["reference/python.html"]
    assert {f"hull1620.{name}" for name in hull1620.__all__} <= set(page.ids)
    text = words(page.root)
    assert "object at" not in text
    assert " at 0x" not in text
