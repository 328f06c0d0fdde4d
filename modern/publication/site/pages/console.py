"""The page with the emulator, and the page that compares the programs with exact arithmetic."""

from modern.publication.console import console_page, parting_page
from modern.publication.site.made import Made, Part, one_of


def make(argument: str) -> Made:
    """Return the controls of a page: ``machine`` or ``parting``."""
    page = console_page if one_of(argument, ("machine", "parting")) == "machine" else parting_page
    return Made((Part(html=page()),))
