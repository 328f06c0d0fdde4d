"""The site in Chromium, opened as files: no error on any page, small windows, keyboard, print, accessibility.

By default, expensive checks use one page of each kind.  ``HULL1620_PAGES=all`` checks every page.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Literal
from urllib.parse import unquote, urlsplit

import pytest

from tests.support import editions
from tests.support.editions import page_of_each_kind, pages

if TYPE_CHECKING:
    from playwright.sync_api import Browser
    from playwright.sync_api import Page as Tab

AXE = editions.MODULES / "axe-core" / "axe.min.js"
TAGS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]
KINDS = (
    *("index.html", "program2.html", "chart2.html", "example2.html", "errors.html", "article.html", "search.html"),
    *("reference/commands.html", "reference/storage.html", "papers/appel_will.html", "console.html"),
)
"""The pages that axe checks by default."""
REPEATED = "section[id^=page-] ~ section[id^=page-], ol.cards > li:nth-child(n + 25)"
"""The sections of a listing after the first, and the cards after the 24th: axe needs seconds for these repetitions."""
Theme = Literal["light", "dark"]


@contextmanager
def opened(
    chromium: Browser, site: Path, address: str, width: int = 1280, theme: Theme = "light", script: bool = True
) -> Iterator[tuple[Tab, list[str]]]:
    """Open a page of the site in a new window; yield it with the list of its errors, which grows."""
    context = chromium.new_context(
        viewport={"width": width, "height": 800},
        color_scheme=theme,
        reduced_motion="reduce",
        java_script_enabled=script,
    )
    tab = context.new_page()
    errors: list[str] = []
    tab.on("console", lambda message: errors.append(message.text) if message.type == "error" else None)
    tab.on("pageerror", lambda error: errors.append(str(error)))
    # The next page may be opened before the icon is loaded; then Chromium aborts the request.
    aborted_icon = ("net::ERR_ABORTED", "favicon.svg")
    tab.on(
        "requestfailed",
        lambda request: (
            None
            if (request.failure, request.url.rpartition("/")[2]) == aborted_icon
            else errors.append(f"not loaded: {request.url}")
        ),
    )
    tab.goto(f"{site.as_uri()}/{address}")
    yield tab, errors
    context.close()


def test_pages_load_without_an_error_and_fit_a_small_window(chromium: Browser, site: Path) -> None:
    """The test of the layout does the same for the pages that it opens."""
    too_wide = []
    with opened(chromium, site, "index.html", width=360) as (tab, errors):
        for name in [name for name in page_of_each_kind(site) if name not in editions.READ_CLOSELY]:
            tab.goto(f"{site.as_uri()}/{name}")
            width = tab.evaluate("document.documentElement.scrollWidth")
            if width > 360:
                too_wide.append(f"{name}: {width} pixels wide")
    assert errors + too_wide == []


def test_the_stepper_and_the_slider_of_the_home_page_move(chromium: Browser, site: Path) -> None:
    with opened(chromium, site, "index.html") as (tab, errors):
        stages = tab.locator("ol.stepper > li")
        assert [stage.is_visible() for stage in stages.all()] == [True, False, False, False]
        tab.get_by_role("button", name="Next point").click()
        assert [stage.is_visible() for stage in stages.all()] == [False, True, False, False]
        slider, verdict = tab.get_by_role("slider"), tab.locator(".slider strong")
        assert verdict.inner_text() == "All three are zero. The program continues."
        slider.press("End")
        assert verdict.inner_text() == "DATA NOT ACCEPTABLE"
        assert errors == []
    with opened(chromium, site, "index.html", script=False) as (tab, _):
        assert all(stage.is_visible() for stage in tab.locator("ol.stepper > li").all())


def test_the_home_page_is_light_and_does_not_move_while_it_loads(chromium: Browser, site: Path) -> None:
    context = chromium.new_context(viewport={"width": 1280, "height": 800})
    tab = context.new_page()
    loaded: set[str] = set()
    tab.on("requestfinished", lambda request: loaded.add(request.url))
    tab.add_init_script(
        "window.shift = 0; new PerformanceObserver(list => list.getEntries().forEach("
        "entry => { window.shift += entry.value; }))"
        ".observe({type: 'layout-shift', buffered: true})"
    )
    tab.goto(f"{site.as_uri()}/index.html")
    tab.evaluate("document.fonts.ready.then(() => new Promise(done => setTimeout(done, 300)))")
    sizes = [Path(unquote(urlsplit(url).path)).stat().st_size for url in loaded]
    assert 100_000 < sum(sizes) <= 400_000
    assert tab.evaluate("window.shift") < 0.05
    context.close()


def violations(tab: Tab, name: str, rules: list[str]) -> list[str]:
    """Run axe on a page and return its findings."""
    tab.evaluate(AXE.read_text(encoding="utf-8"))
    tab.evaluate("selector => document.querySelectorAll(selector).forEach(element => element.remove())", REPEATED)
    run = "rules => axe.run({runOnly: rules, resultTypes: ['violations'], preload: false})"
    report = tab.evaluate(run, rules)
    return [f"{name}: {v['id']}: {node['html'][:160]}" for v in report["violations"] for node in v["nodes"][:3]]


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_axe_finds_no_violation(chromium: Browser, site: Path, theme: Theme) -> None:
    """All rules in the light theme; in the dark theme, which differs in colours only, the contrast of text."""
    if not AXE.exists():
        pytest.skip("axe is missing: npm ci --prefix docs/console")
    every = len(page_of_each_kind(site)) == len(pages(site))
    names = pages(site) if every else KINDS if theme == "light" else ("index.html", "program2.html", "errors.html")
    rules = TAGS if theme == "light" or every else ["color-contrast"]
    findings: list[str] = []
    with opened(chromium, site, "index.html", theme=theme) as (tab, _):
        for name in names:
            tab.goto(f"{site.as_uri()}/{name}")
            findings += violations(tab, name, rules)
    assert findings == []


def test_the_keyboard_opens_and_closes_a_row_and_goes_to_emendations(chromium: Browser, site: Path) -> None:
    with opened(chromium, site, "program3.html#143") as (tab, _):
        row = tab.locator("#P3-013")
        assert row.is_visible()
        tab.keyboard.press("Tab")
        while tab.evaluate("document.activeElement.tagName") != "SUMMARY":
            tab.keyboard.press("Tab")
        assert tab.evaluate("document.activeElement.closest('.card').id") == "143"
        tab.keyboard.press("Enter")
        assert not row.is_visible()
        tab.keyboard.press("Enter")
        assert row.is_visible()
        tab.goto(f"{site.as_uri()}/program3.html#105+3")
        tab.keyboard.press("n")
        tab.keyboard.press("n")
        assert tab.evaluate("decodeURIComponent(location.hash)") == "#130"
        tab.keyboard.press("p")
        assert tab.evaluate("decodeURIComponent(location.hash)") == "#before-114"


def test_an_address_scrolls_its_card_or_row_below_the_controls(chromium: Browser, site: Path) -> None:
    with opened(chromium, site, "program3.html#P3-013") as (tab, _):
        assert tab.locator("#P3-013").is_visible()
        for place in ("P3-013", "147", "147+2", "before-161"):
            tab.goto(f"{site.as_uri()}/program3.html#{place}")
            top = tab.evaluate(f"document.getElementById('{place}').getBoundingClientRect().top")
            bar = tab.evaluate("document.querySelector('.controls').getBoundingClientRect().bottom")
            assert bar <= top + 1 < 800, place


def test_layers_and_examples_can_be_chosen_without_javascript(chromium: Browser, site: Path) -> None:
    with opened(chromium, site, "program3.html", script=False) as (tab, _):
        variant = tab.locator("[id='142'] .otherwise.of-corrected")
        assert not variant.is_visible()
        tab.locator("#layer-corrected").check()
        assert variant.is_visible()
        first, last = (tab.locator(f"[id='147'] .run.example-{n}") for n in (5, 6))
        assert last.is_visible()
        assert not first.is_visible()
        tab.locator("#example-5").check()
        assert first.is_visible()
        assert not last.is_visible()


def test_the_index_filters_and_opens_the_first_match(chromium: Browser, site: Path) -> None:
    with opened(chromium, site, "addresses.html") as (tab, errors):
        tab.locator("#find").fill("error 5")
        assert tab.locator("ul.addresses li:visible").first.inner_text().startswith("error 5")
        tab.locator("#find").fill("P3-025")
        assert tab.locator("#found").inner_text() == "1 found"
        tab.keyboard.press("Enter")
        tab.wait_for_url("**/program3.html#P3-025")
        assert errors == []


QUERIES = {
    "147": "program3.html#147",
    "statement 147 of program 2": "program2.html#147",
    "error 5": "errors.html#error-5",
    "E3": "errors.html#error-E3",
    "P1-039": "program1.html#P1-039",
    "C6-038": "example2.html#C6-038",
    "game": "how-to/machine-page.html#play-tic-tac-toe",
    "licence": "get.html#licences",
    "PDF": "get.html",
    "download": "get.html",
    "TEI": "get.html",
    "NETC": "program3.html#name-NETC",
    "KELEQ": "program3.html#name-KELEQ",
    "Butler": "explanation/context.html#the-author",
    "quickhull": "explanation/method.html",
    "data not acceptable": "known-faults.html#fault-6",
    "sense switch": "reference/operator.html",
    "cube": "known-faults.html#fault-2",
}


def test_a_search_shows_the_right_place_first(chromium: Browser, site: Path) -> None:
    first: dict[str, str] = {}
    with opened(chromium, site, "search.html") as (tab, errors):
        for query in QUERIES:
            tab.goto(f"{site.as_uri()}/search.html?q={query}")
            links = tab.locator("#places a, #search-results a")
            links.first.wait_for()
            first[query] = str(links.first.get_attribute("href"))
        assert errors == []
    assert first == QUERIES


def test_the_navigation_has_at_most_eight_entries_and_long_pages_a_list_of_their_sections(chromium, site) -> None:
    with opened(chromium, site, "program3.html", width=360, script=False) as (tab, _):
        entries = tab.locator(".sidebar-tree > ul > li > a").all_text_contents()
        assert entries == ["Story", "Programs", "Examples", "Machine", "Verdicts", "Learn", "Reference", "Get it"]
        jump = tab.get_by_role("navigation", name="Sections of this page")
        assert jump.bounding_box() is not None
        jump.get_by_text("97", exact=True).click()
        assert tab.url.endswith("#page-97")
        assert 0 <= tab.evaluate("document.getElementById('page-97').getBoundingClientRect().top") < 200
        box = jump.bounding_box()
        assert box is not None
        assert abs(box["y"] + box["height"] - 800) <= 1


def test_a_printed_listing_is_stacked_with_open_rows(chromium: Browser, site: Path) -> None:
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


@pytest.mark.parametrize("example", [4, 6])
def test_an_example_prints_on_at_most_twelve_sheets(chromium: Browser, site: Path, example: int) -> None:
    with opened(chromium, site, f"example{example}.html") as (tab, _):
        sheets = len(re.findall(rb"/Type ?/Page\b", tab.pdf(format="A4", prefer_css_page_size=True)))
    assert 4 <= sheets <= 12


@pytest.mark.parametrize(
    ("address", "target"), [("statements/thesis.html", "thesis.16"), ("program3.html", "name-NETC")]
)
def test_the_target_of_an_address_is_below_the_bar(chromium: Browser, site: Path, address: str, target: str) -> None:
    with opened(chromium, site, f"{address}#{target}") as (tab, _):
        top, bar = tab.evaluate(
            "id => [document.getElementById(id).getBoundingClientRect().top,"
            " document.querySelector('.controls').getBoundingClientRect().bottom]",
            target,
        )
        assert 0 < bar <= top < 800


def test_the_cards_of_a_listing_have_the_width_of_the_page(chromium: Browser, site: Path) -> None:
    with opened(chromium, site, "program3.html") as (tab, _):
        card, page = (
            tab.evaluate("name => document.querySelector(name).clientWidth", name) for name in (".card", "article")
        )
        assert card > 0.95 * page > 800


def test_the_search_has_no_descriptions_of_commands_as_names(site: Path) -> None:
    index = (site / "searchindex.js").read_text(encoding="utf-8")
    assert "&#x27;" not in index
    assert '"Punch points as a data deck":' not in index


@pytest.mark.parametrize("width", [360, 1280])
def test_the_next_page_is_at_the_right(chromium: Browser, site: Path, width: int) -> None:
    with opened(chromium, site, "parting.html", width=width) as (tab, _):
        previous, following = (tab.locator(f".related-pages .{name}-page").bounding_box() for name in ("prev", "next"))
        assert previous is not None
        assert following is not None
        assert previous["x"] + previous["width"] + 10 < following["x"]


def test_a_shadow_shows_that_a_listing_continues(chromium: Browser, site: Path) -> None:
    """Above the text at the right edge there is a shadow at the start of the lines, and none at their end."""
    with opened(chromium, site, "wrong.html", width=360) as (tab, _):
        pre = tab.locator("article pre").first
        assert pre.evaluate("element => element.scrollWidth - element.clientWidth") > 50
        pre.evaluate("element => { element.scrollIntoView(); window.scrollBy(0, -200); }")
        box = pre.bounding_box()
        assert box is not None
        clip = {"x": box["x"] + box["width"] - 8, "y": box["y"] + 2, "width": 6, "height": 4}
        before = tab.screenshot(clip=clip)  # type: ignore[arg-type]
        pre.evaluate("element => { element.scrollLeft = 10000; }")
        assert tab.screenshot(clip=clip) != before  # type: ignore[arg-type]
