"""The layout of rendered pages: no text overlaps another or is clipped, no box is empty, and pages look as before."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import pytest

from tests.modern.publication.test_site_browser import opened
from tests.support import editions
from tests.support.paths import DATA, ROOT

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

CHECK = (ROOT / "tests" / "support" / "layout.js").read_text(encoding="utf-8").partition("(open)")
Theme = Literal["light", "dark"]
WINDOWS: tuple[tuple[int, Theme, bool], ...] = (
    *((360, "light", False), (768, "dark", False), (1280, "light", False)),
    *((1280, "dark", True), (360, "dark", True)),
)
"""The widths and themes of the check; True opens everything that the reader can open."""

PAPER = 673
"""The width of a printed A4 page without its margins, in pixels."""

PICTURES = (("example2.html", ".print-cards"), ("program3.html", "[id='147']"), ("index.html", "h1"))
REFERENCES = DATA / "site"
TOLERANCE = 0.02
"""The share of pixels that may differ, because versions of Chromium draw letters differently."""


def problems(tab: Page, is_open: bool = False) -> list[str]:
    """Return the problems in the layout of a page; ``is_open`` first opens everything that the reader can open."""
    found: list[str] = tab.evaluate(f"{CHECK[1]}{CHECK[2]}", is_open)
    return found


def test_no_text_overlaps_or_is_clipped(chromium: Browser, site: Path) -> None:
    every = len(editions.page_of_each_kind(site)) == len(editions.pages(site))
    messages = []
    with opened(chromium, site, "index.html") as (tab, errors):
        for name in editions.pages(site) if every else editions.READ_CLOSELY:
            tab.goto(f"{site.as_uri()}/{name}")
            for width, theme, is_open in WINDOWS:
                tab.set_viewport_size({"width": width, "height": 800})
                tab.emulate_media(color_scheme=theme)
                messages += [f"{name}, {width} pixels, {theme}: {problem}" for problem in problems(tab, is_open)]
            tab.set_viewport_size({"width": PAPER, "height": 800})
            tab.emulate_media(media="print", color_scheme="light")
            messages += [f"{name}, print: {problem}" for problem in problems(tab)]
            tab.emulate_media(media="null")
    assert errors + messages == []


@pytest.mark.parametrize(
    ("style", "message"),
    [
        (".print-cards .line { margin-right: -5rem; white-space: nowrap }", "overlap"),
        (".print-cards code { display: block; overflow: hidden; width: 3rem; white-space: pre }", "clipped"),
        ("article > section > p { width: 120vw; text-align: right }", "beyond the window"),
        ("article { min-width: 110vw }", "beyond the window: the page scrolls"),
        ("h1 { font-size: 0 } h1 + p { height: 0; overflow: hidden }", "hidden"),
    ],
)
def test_a_broken_style_is_reported(chromium: Browser, site: Path, style: str, message: str) -> None:
    with opened(chromium, site, "example2.html") as (tab, _):
        tab.add_style_tag(content=style)
        assert [problem for problem in problems(tab) if problem.startswith(message)]


def test_a_control_that_leaves_its_column_is_reported(chromium: Browser, site: Path) -> None:
    with opened(chromium, site, "parting.html") as (tab, _):
        tab.add_style_tag(content=".parting-room select { width: 30rem; max-width: none }")
        assert "beyond its column: “parting-sets”" in problems(tab)


def test_an_empty_box_and_a_table_that_scrolls_are_reported(chromium: Browser, site: Path) -> None:
    with opened(chromium, site, "get.html", width=360) as (tab, _):
        tab.evaluate("document.querySelector('article p').replaceChildren()")
        tab.add_style_tag(content=".wide table { width: 60rem !important }")
        assert {problem.partition(":")[0] for problem in problems(tab)} >= {"empty", "scrolls sideways"}


@pytest.mark.parametrize(("page", "part"), PICTURES, ids=[page for page, _ in PICTURES])
def test_a_page_looks_like_its_reference_picture(chromium: Browser, site: Path, page: str, part: str) -> None:
    """Delete the file in tests/data/site to replace it with the present picture."""
    image = pytest.importorskip("PIL.Image", reason="Pillow compares pictures")
    import numpy as np

    with opened(chromium, site, page) as (tab, _):
        tab.evaluate("document.fonts.ready")
        shot = image.open(BytesIO(tab.locator(part).first.screenshot())).convert("L")
    reference = REFERENCES / f"{page.removesuffix('.html')}.png"
    if not reference.exists():
        reference.parent.mkdir(exist_ok=True)
        shot.quantize(8).save(reference, optimize=True)
        pytest.fail(f"{reference.name} was missing; look at the new picture and commit it")
    expected = image.open(reference).convert("L")
    assert abs(shot.width - expected.width) + abs(shot.height - expected.height) <= 6
    size = (min(shot.width, expected.width), min(shot.height, expected.height))
    pictures = [np.asarray(picture.crop((0, 0, *size)), dtype=int) for picture in (shot, expected)]
    share = float((abs(pictures[0] - pictures[1]) > 96).mean())
    assert share <= TOLERANCE, f"{share:.1%} of the pixels differ"
