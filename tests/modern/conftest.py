"""The browser of the tests of pages."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest

from tests.support import editions

if TYPE_CHECKING:
    from playwright.sync_api import Browser


@pytest.fixture(scope="session")
def chromium() -> Iterator[Browser]:
    """Start a headless Chromium, once for each worker: playwright cannot be started twice in a process."""
    if not editions.CHROMIUM:
        pytest.skip("chromium is missing (Debian: apt install chromium-headless-shell)")
    pytest.importorskip("playwright", reason="playwright controls the browser (extra test)")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as play:
        browser = play.chromium.launch(
            executable_path=editions.CHROMIUM,
            # Without hinting, letters look the same in the shell and in the whole browser.
            args=["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--font-render-hinting=none"],
        )
        yield browser
        browser.close()
