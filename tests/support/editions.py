"""The site built once for all tests, whatever worker asks first; a page as its ids and links; Chromium, where it is."""

from __future__ import annotations

import fcntl
import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from shutil import which
from urllib.parse import unquote, urlsplit

import lxml.html
from lxml.etree import _Element

from tests.support.paths import ROOT

CHROMIUM = which("chromium") or which("chromium-browser") or ""
MODULES = ROOT / "docs" / "console" / "node_modules"
"""Where ``npm ci --prefix docs/console`` puts axe and html-validate."""


def build(out: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    """Build the site into a folder, as ``make edition`` does."""
    words = [sys.executable, "-m", "modern.publication.site.build", str(out)]
    told = {**os.environ, "PYTHONPATH": str(ROOT), **environment}
    return subprocess.run(words, capture_output=True, text=True, check=False, cwd=ROOT, env=told)


@contextmanager
def once(folder: Path) -> Iterator[bool]:
    """Whether the caller is the first to come here; others wait until the first is done."""
    with (folder / "site.lock").open("a+") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield not (folder / "site.done").exists()
        (folder / "site.done").touch()


def built(folder: Path) -> Path:
    """The site, built in ``folder`` by the first that asks.  Raises AssertionError where it does not build."""
    site = folder / "site"
    with once(folder) as first:
        if first:
            done = build(site)
            assert done.returncode == 0, done.stdout + done.stderr
    return site


@dataclass(frozen=True)
class Page:
    """A page: where it lies, its element, its ids in order."""

    name: str
    root: _Element
    ids: tuple[str, ...]

    def addresses(self) -> Iterator[str]:
        """Everything the page leads to or loads, as it is written."""
        for attribute in ("href", "src", "data-src"):
            yield from (str(found) for found in self.root.xpath(f"//@{attribute}"))


@cache
def pages(site: Path) -> dict[str, Page]:
    """All pages of a site by their path in it."""
    found = {}
    for file in sorted(site.rglob("*.html")):
        root = lxml.html.fromstring(file.read_bytes())
        name = file.relative_to(site).as_posix()
        found[name] = Page(name, root, tuple(str(id) for id in root.xpath("//@id")))
    return found


def dead(site: Path) -> Iterator[str]:
    """Every address of a page that leads nowhere, with the page."""
    known = pages(site)
    ids = {name: frozenset(page.ids) for name, page in known.items()}
    for page in known.values():
        for address in page.addresses():
            parts = urlsplit(address)
            if parts.scheme in ("http", "https", "data", "mailto", "javascript"):
                continue
            file = (site / page.name).parent / unquote(parts.path) if parts.path else site / page.name
            if not file.is_file():
                yield f"{page.name}: {address}: there is no such file"
                continue
            target = file.resolve().relative_to(site.resolve()).as_posix()
            if parts.fragment and target in ids and unquote(parts.fragment) not in ids[target]:
                yield f"{page.name}: {address}: there is no such id"


def words(element: _Element) -> str:
    """The text of an element."""
    return str(element.text_content())
