"""What a visitor does at the emulator's page in Chromium, for its tests."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import pytest

from modern.publication.console import SOURCE
from tests.modern.publication.test_site_layout import problems
from tests.support.editions import LONG

if TYPE_CHECKING:
    from playwright.sync_api import Page

needs_pyodide = pytest.mark.skipif(
    not (SOURCE / "node_modules" / "pyodide").is_dir(),
    reason="pyodide is missing (npm ci --ignore-scripts --prefix docs/console)",
)


def state(page: Page, *states: str) -> str:
    """Wait until the machine is in one of the states, and return it with the message of the page."""
    page.wait_for_selector(", ".join(f"#desk[data-state={name}]" for name in states), timeout=LONG)
    return page.inner_text("#desk-state")


def give(page: Page, name: str, text: str) -> None:
    page.set_input_files("#desk-files", [{"name": name, "mimeType": "text/plain", "buffer": text.encode("ascii")}])


def load(page: Page, program: str, deck: str | None = None) -> str:
    """Choose a program and a deck, load them, and return the message of the page."""
    page.select_option("#desk-program", program)
    if deck is not None:
        page.select_option("#desk-deck", deck)
    page.click("#desk-load")
    return state(page, "waits", "refused")


def press(page: Page, key: str = "START") -> str:
    """Press a key and return the message when the machine halts or ends."""
    page.evaluate("document.getElementById('desk').dataset.state = 'pressed'")
    page.click(f"[data-words={key}]")
    # START on an idle machine first loads the program, which waits for a moment.
    page.wait_for_function(
        """() => ["waits", "ended"].includes(document.getElementById("desk").dataset.state)
          && !document.getElementById("desk-state").textContent.endsWith("is loaded. Press START.")""",
        timeout=LONG,
    )
    return page.inner_text("#desk-state")


def cards(page: Page) -> list[str]:
    texts: list[str] = page.eval_on_selector_all("#desk-stacker li", "all => all.map(one => one.textContent.trimEnd())")
    return texts


def paper(page: Page) -> list[str]:
    lines: list[str] = page.eval_on_selector_all(
        "#desk-paper .desk-typed", "all => all.map(one => one.textContent.trimEnd())"
    )
    return lines


def fit(page: Page) -> None:
    """Check the layout of the desk in its present state, in a wide and a narrow window and in both themes."""
    for width, theme in itertools.product((360, 1280), ("dark", "light")):
        page.set_viewport_size({"width": width, "height": 800})
        page.emulate_media(color_scheme="dark" if theme == "dark" else "light")
        # Lists and paper may be empty here.
        messages = [message for message in problems(page) if not message.startswith("empty")]
        assert messages == [], f"{width} pixels, {theme}"
        assert page.evaluate("document.documentElement.scrollWidth") == width
