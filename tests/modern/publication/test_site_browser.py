"""The site in a real Chromium, from the file system: no error on any page, small windows, keyboard, print, axe.

``HULL1620_AXE=all`` takes axe to every page in both themes, which takes some minutes; otherwise it takes a page of each
kind in the light theme (``test_site.py`` computes the contrast of all colours in both).
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import pytest

from tests.support import editions
from tests.support.editions import pages

if TYPE_CHECKING:
    from playwright.sync_api import Browser
    from playwright.sync_api import Page as Tab

AXE = editions.MODULES / "axe-core" / "axe.min.js"
TAGS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]
KINDS = (
    *("index.html", "program2.html", "chart2.html", "errors.html", "article.html", "genindex.html", "search.html"),
    *("programs.html", "reference/commands.html", "how-to/own-study.html", "explanation/studies.html"),
    *("studies/divergence/report.html", "reference/storage.html", "papers/appel_will.html"),
)
ALL = os.environ.get("HULL1620_AXE") == "all"
Theme = Literal["light", "dark"]


@contextmanager
def opened(
    chromium: Browser, site: Path, address: str, width: int = 1280, theme: Theme = "light", script: bool = True
) -> Iterator[tuple[Tab, list[str]]]:
    """A page of the site in a window of its own, and what its console says of errors."""
    context = chromium.new_context(
        viewport={"width": width, "height": 800},
        color_scheme=theme,
        reduced_motion="reduce",
        java_script_enabled=script,
    )
    tab = context.new_page()
    said: list[str] = []
    tab.on("console", lambda message: said.append(message.text) if message.type == "error" else None)
    tab.on("pageerror", lambda error: said.append(str(error)))
    tab.on("requestfailed", lambda request: said.append(f"not loaded: {request.url}"))
    tab.goto(f"{site.as_uri()}/{address}")
    yield tab, said
    context.close()


def test_every_page_loads_without_an_error_and_fits_a_small_window(chromium: Browser, site: Path) -> None:
    wrong = []
    for name in pages(site):
        with opened(chromium, site, name, width=360) as (tab, said):
            wrong += [f"{name}: {line}" for line in said]
            width = tab.evaluate("document.documentElement.scrollWidth")
            if width > 360:
                wrong.append(f"{name}: {width} pixels wide")
    assert wrong == []


def _violations(tab: Tab) -> list[str]:
    tab.evaluate(AXE.read_text(encoding="utf-8"))
    found = tab.evaluate(
        "tags => axe.run(document, {runOnly: tags, resultTypes: ['violations'], preload: false})", TAGS
    )
    return [f"{one['id']}: {node['html'][:160]}" for one in found["violations"] for node in one["nodes"][:3]]


def test_axe_finds_nothing(chromium: Browser, site: Path) -> None:
    if not AXE.exists():
        pytest.skip("axe is not there: npm ci --prefix docs/console")
    wrong = []
    themes: tuple[Theme, ...] = ("light", "dark") if ALL else ("light",)
    for name in pages(site) if ALL else KINDS:
        for theme in themes:
            with opened(chromium, site, name, theme=theme) as (tab, _):
                wrong += [f"{name}, {theme}: {one}" for one in _violations(tab)]
    assert wrong == []


def test_a_row_opens_by_keyboard(chromium: Browser, site: Path) -> None:
    with opened(chromium, site, "program3.html#143") as (tab, _):
        row = tab.locator("#P3-013")
        assert not row.is_visible()
        tab.keyboard.press("Tab")
        while tab.evaluate("document.activeElement.tagName") != "SUMMARY":
            tab.keyboard.press("Tab")
        assert tab.evaluate("document.activeElement.closest('.card').id") == "143"
        tab.keyboard.press("Enter")
        assert row.is_visible()
        tab.keyboard.press("Enter")
        assert not row.is_visible()


def test_the_address_of_a_row_opens_it(chromium: Browser, site: Path) -> None:
    with opened(chromium, site, "program3.html#P3-013") as (tab, _):
        assert tab.locator("#P3-013").is_visible()
        top = tab.evaluate("document.getElementById('P3-013').getBoundingClientRect().top")
        bar = tab.evaluate("document.querySelector('.controls').getBoundingClientRect().bottom")
        assert bar <= top < 800


def test_the_address_of_a_card_is_below_the_bar(chromium: Browser, site: Path) -> None:
    for place in ("147", "147+2", "before-161"):
        with opened(chromium, site, f"program3.html#{place}") as (tab, _):
            top = tab.evaluate(f"document.getElementById('{place}').getBoundingClientRect().top")
            bar = tab.evaluate("document.querySelector('.controls').getBoundingClientRect().bottom")
            assert bar <= top + 1 < 800, place


def test_keys_go_from_emendation_to_emendation(chromium: Browser, site: Path) -> None:
    with opened(chromium, site, "program3.html#105+3") as (tab, _):
        tab.keyboard.press("n")
        tab.keyboard.press("n")
        assert tab.evaluate("decodeURIComponent(location.hash)") == "#130"
        tab.keyboard.press("p")
        assert tab.evaluate("decodeURIComponent(location.hash)") == "#before-114"


def test_layers_and_examples_are_chosen_without_a_script(chromium: Browser, site: Path) -> None:
    with opened(chromium, site, "program3.html", script=False) as (tab, _):
        other = tab.locator("[id='142'] .otherwise.of-corrected")
        assert not other.is_visible()
        tab.locator("#layer-corrected").check()
        assert other.is_visible()
        first, last = (tab.locator(f"[id='147'] .run.example-{n}") for n in (5, 6))
        assert last.is_visible()
        assert not first.is_visible()
        tab.locator("#example-5").check()
        assert first.is_visible()
        assert not last.is_visible()


def test_the_index_finds_a_name_and_goes_there(chromium: Browser, site: Path) -> None:
    with opened(chromium, site, "addresses.html") as (tab, said):
        tab.locator("#find").fill("error 5")
        assert tab.locator("ul.addresses li:visible").first.inner_text().startswith("error 5")
        tab.locator("#find").fill("P3-025")
        assert tab.locator("#found").inner_text() == "1 found"
        tab.keyboard.press("Enter")
        tab.wait_for_url("**/program3.html#P3-025")
        assert said == []


def test_search_finds_words_from_the_file_system(chromium: Browser, site: Path) -> None:
    with opened(chromium, site, "search.html?q=KELEQ") as (tab, said):
        tab.locator("#search-results li a").first.wait_for()
        assert "program3.html" in " ".join(
            tab.eval_on_selector_all("#search-results a", "links => links.map(link => link.getAttribute('href'))")
        )
        assert said == []


def test_printed_a_listing_is_stacked_and_its_rows_are_open(chromium: Browser, site: Path) -> None:
    with opened(chromium, site, "program3.html", theme="dark") as (tab, _):
        tab.emulate_media(media="print")
        tab.evaluate("window.dispatchEvent(new Event('beforeprint'))")
        witness, deck = (tab.locator(f"[id='143'] .{side}").bounding_box() for side in ("witness", "deck"))
        assert witness
        assert deck
        assert witness["y"] + witness["height"] <= deck["y"] + 1
        assert abs(witness["x"] - deck["x"]) <= 1
        assert tab.locator("#P3-013").is_visible()
        assert tab.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
        assert not tab.locator(".controls").is_visible()


def test_without_a_script_the_whole_text_is_there(chromium: Browser, site: Path) -> None:
    with opened(chromium, site, "program2.html", script=False) as (tab, _):
        assert tab.locator("li.card").count() == 262
        tab.locator("[id='146'] summary").click()
        assert tab.locator("#P2-010").is_visible()
