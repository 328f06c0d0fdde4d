"""Support for tests of the site: build it once for all workers, read its pages, and find Chromium.

Set ``HULL1620_SITE`` to the folder of a site that is already built to skip the build.
"""

import fcntl
import os
import re
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from urllib.parse import unquote, urlsplit

import lxml.html
from lxml.etree import _Element

from modern.publication.console import install_machine
from tests.support.paths import ROOT

CHROMIUM = next(filter(None, map(shutil.which, ("chromium-headless-shell", "chromium", "chromium-browser"))), "")
"""The path of a browser. Debian's browser without a window needs a third of the processor time of the whole one."""

MODULES = ROOT / "docs" / "console" / "node_modules"
"""The folder into which ``npm ci --prefix docs/console`` installs axe and html-validate."""

LONG = 30_000
"""The longest time to wait for the page of the emulator, in milliseconds."""

PACKAGES = ("hull1620", "emulator", "modern", "fortran_src", "transcripts")


def build(out: Path) -> None:
    """Build the site into a folder as ``make edition`` does, with an unusual time zone, locale and hash seed."""
    environment = {"PYTHONPATH": str(ROOT), "PYTHONHASHSEED": "1963", "TZ": "Pacific/Auckland", "LC_ALL": "C"}
    process = subprocess.run(
        [sys.executable, "-m", "modern.publication.site.build", str(out)],
        capture_output=True,
        text=True,
        check=False,
        cwd=ROOT,
        env={**os.environ, **environment},
    )
    assert process.returncode == 0, process.stdout + process.stderr


def packed(room: Path) -> Path:
    """Pack the packages of this checkout into an archive with the layout of a wheel."""
    archive = room / "packages.whl"
    with zipfile.ZipFile(archive, "w") as file:
        for package in PACKAGES:
            for path in sorted((ROOT / package).rglob("*")):
                if path.is_file() and "__pycache__" not in path.parts:
                    file.write(path, path.relative_to(ROOT).as_posix())
    return archive


@contextmanager
def first_caller(folder: Path, name: str) -> Iterator[bool]:
    """Yield True to the first process that enters with this name, and False to those that enter after it has left."""
    with (folder / f"{name}.lock").open("a+") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield not (folder / f"{name}.done").exists()
        (folder / f"{name}.done").touch()


def built(folder: Path) -> Path:
    """Return the site in ``folder``; the first process of the test session that calls this function builds it."""
    if "HULL1620_SITE" in os.environ:
        return Path(os.environ["HULL1620_SITE"])
    site = folder / "site"
    with first_caller(folder, "site") as is_first:
        if is_first:
            build(site)
    return site


def equipped(folder: Path) -> Path:
    """Return a copy of the site with the emulator; the first process that calls this makes it in ``folder``."""
    site, copy = built(folder), folder / "equipped"
    with first_caller(folder, "equipped") as is_first:
        if is_first:
            shutil.rmtree(copy, ignore_errors=True)  # what a failed attempt left
            copy.mkdir()
            for entry in site.iterdir():
                if entry.name != "console":
                    (copy / entry.name).symlink_to(entry)
            assert 0 < install_machine(copy / "console", packed(folder)) < 7_000_000
    return copy


def begin(folder: Path) -> subprocess.Popen[bytes]:
    """Start to build the site and its emulator in the background, so that no test has to wait for the whole build.

    A failure is not reported: the first test that needs the site builds it again, and reports what is wrong.
    """
    command = [sys.executable, "-c", f"from tests.support.editions import *; equipped(Path({str(folder)!r}))"]
    return subprocess.Popen(command, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


@dataclass(frozen=True)
class Page:
    """A page of the site: its path, its HTML, and the ids in it in order."""

    name: str
    root: _Element
    ids: tuple[str, ...]

    def addresses(self) -> Iterator[str]:
        """Yield every address that the page links to or loads, as it is written."""
        for attribute in ("href", "src", "data-src"):
            yield from (str(address) for address in self.root.xpath(f"//@{attribute}"))


@cache
def pages(site: Path) -> dict[str, Page]:
    """Return all pages of a site by their path in it."""
    by_name = {}
    for file in sorted(site.rglob("*.html")):
        root = lxml.html.fromstring(file.read_bytes())
        name = file.relative_to(site).as_posix()
        by_name[name] = Page(name, root, tuple(str(id) for id in root.xpath("//@id")))
    return by_name


_SIMILAR = re.compile(r"((program|chart)(1|1_examples|3)|example[13-5])\.html|statements/[^kt]")
"""Pages that one generator makes from the same code and template as a page that is not listed here."""


READ_CLOSELY = (
    *("index.html", "program2.html", "chart2.html", "example4.html", "errors.html", "get.html", "parting.html"),
    *("reference/storage.html", "statements/yau-srihari.html", "papers/appel_will.html", "explanation/studies.html"),
    *("console.html", "search.html", "article.html", "studies/alarms/report.html"),
)
"""The pages whose layout is checked; with ``HULL1620_PAGES=all``, the check reads all pages."""


def page_of_each_kind(site: Path) -> tuple[str, ...]:
    """Return the pages for expensive checks: all pages, except those that differ from another page in data only.

    With ``HULL1620_PAGES=all``, as before a release, these are all pages.
    """
    every = os.environ.get("HULL1620_PAGES") == "all"
    return tuple(name for name in pages(site) if every or not _SIMILAR.match(name))


def dead(site: Path) -> Iterator[str]:
    """Yield a message for every address on a page whose file or id does not exist."""
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
    """Return the text of an element."""
    return str(element.text_content())
