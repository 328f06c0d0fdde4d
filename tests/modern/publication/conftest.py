"""Fixtures of this folder: the site, built once for all workers, one browser for each worker, and the desk."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from tests.support import editions

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page


@pytest.fixture(scope="session")
def site(shared: Path) -> Path:
    """Return the site, which is built once."""
    pytest.importorskip("sphinx", reason="Sphinx builds the site (extra edition)")
    return editions.built(shared)


class Quiet(SimpleHTTPRequestHandler):
    """A server of a folder that does not log requests."""

    def log_message(self, format: str, *args: Any) -> None:
        """Log nothing."""


@pytest.fixture(scope="session")
def folder(site: Path, shared: Path) -> Path:
    """Return a copy of the site with the emulator, which is made once."""
    return editions.equipped(shared)


@pytest.fixture(scope="session")
def served(folder: Path) -> Iterator[str]:
    """Serve the site with the emulator on the loopback interface and yield its address."""
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=str(folder)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()
    server.server_close()


@pytest.fixture(scope="session")
def tab(chromium: Browser, served: str) -> Iterator[Page]:
    """Return the emulator page with the machine on, at full speed."""
    page = chromium.new_page(viewport={"width": 1280, "height": 800})
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(f"{served}/console.html")
    assert page.inner_text("#desk-listing li:nth-child(1)") == "C     CONVEX HULL-PROGRAM 3-NOT COPLANAR"
    page.wait_for_function("parseInt(document.getElementById('desk-read').textContent) > 2", timeout=editions.LONG)
    assert [page.input_value(f"#desk-{name}") for name in ("program", "deck")] == ["program3", "example5/punched"]
    page.wait_for_selector("#desk[data-state=waits]", timeout=4 * editions.LONG)
    assert page.input_value("#desk-program") == "program1_examples"
    assert page.inner_text("#desk-listing li:nth-child(1)") == "C     CONVEX HULL-PROGRAM 1"
    page.check("[name=desk-speed][value='0']")
    yield page
    assert errors == []
    page.close()
