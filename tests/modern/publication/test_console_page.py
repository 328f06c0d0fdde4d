"""The emulator page in Chromium: it must give the same output as the desk, and so as the command line.

The tests need Chromium, playwright and the npm package pyodide (``npm ci --prefix docs/console``); otherwise they are
skipped with a message.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from modern.edition.chapter6 import prints
from tests.support.console import cards, fit, load, needs_pyodide, paper, press, state
from tests.support.editions import LONG

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

pytestmark = needs_pyodide


def reach(page: Page, selector: str) -> None:
    """Press Tab until the element has the focus."""
    for _ in range(120):
        page.keyboard.press("Tab")
        if page.evaluate("s => document.activeElement.matches(s)", selector):
            return
    pytest.fail(f"the keyboard does not reach {selector}")


def test_the_keyboard_alone_loads_starts_stops_and_steps(tab: Page) -> None:
    tab.evaluate("document.activeElement.blur(); document.getElementById('desk').dataset.state = 'keyboard'")
    reach(tab, "#desk-program")
    tab.keyboard.type("program 1 in", delay=5)
    reach(tab, "#desk-deck")
    tab.keyboard.type("example 4 of", delay=5)
    reach(tab, "#desk-load")
    tab.keyboard.press("Enter")
    assert state(tab, "waits") == "program1_examples.f is loaded. Press START."
    reach(tab, "#desk-where")
    tab.keyboard.type("CARD 92")
    tab.keyboard.press("Enter")
    reach(tab, "[data-words=START]")
    tab.evaluate("document.getElementById('desk').dataset.state = 'started'")
    tab.keyboard.press("Enter")
    assert "before" in state(tab, "waits")
    assert tab.inner_text("#desk-card") == "card 92"
    reach(tab, "[data-words=STEP]")
    tab.keyboard.press("Space")
    tab.wait_for_function("document.getElementById('desk-card').textContent !== 'card 92'", timeout=LONG)
    reach(tab, "#desk-clear")
    tab.keyboard.press("Enter")
    reach(tab, "[data-words=START]")
    tab.evaluate("document.getElementById('desk').dataset.state = 'started'")
    tab.keyboard.press("Space")
    assert state(tab, "ended").startswith("The run has ended.")
    reach(tab, "#desk-stacker")
    assert cards(tab) == {(p.program, p.device): list(p.lines) for p in prints(4)}[1, "punch"]


def test_the_first_decision_that_exact_arithmetic_takes_otherwise_is_shown(tab: Page) -> None:
    load(tab, "program1", "counterexamples/silent")
    press(tab)
    tab.click("#desk-decide")
    tab.wait_for_function(
        "/run program 3 with the punched cards/.test(document.getElementById('desk-state').textContent)", timeout=LONG
    )
    tab.evaluate("document.getElementById('desk').dataset.state = 'pressed'")
    tab.click("#desk-next")
    state(tab, "ended")
    tab.click("#desk-decide")
    tab.wait_for_function(
        "/card 185.*eight digits: 0, .*exact: 27180, /.test(document.getElementById('desk-state').textContent)",
        timeout=LONG,
    )
    assert tab.inner_text("#desk-card") == "card 185"
    assert tab.is_visible("#desk-true")
    assert tab.inner_text("#desk-caption").startswith("Left: the hull in the machine. Right: the true hull.")
    fit(tab)
    assert "Card 185 decided wrongly" in (message := press(tab))
    assert message.endswith("Differences: 3 missing vertices.")
    left, right = "Left: the hull on the punched cards.", "Right: the true hull."
    legend = f"{left} {right} Blue ring: a vertex that the program does not punch."
    assert tab.inner_text("#desk-caption") == legend
    assert [tab.locator(f"#desk-{part} .m-mark").count() for part in ("picture", "true")] == [3, 3]
    assert [tab.locator(f"#desk-{part} .is-vertex").count() for part in ("picture", "true")] == [1, 4]
    fit(tab)


def test_example_5_runs_from_the_first_deck_to_the_last_card_and_goes_back(tab: Page) -> None:
    printed = {(p.program, p.device): list(p.lines) for p in prints(5)}
    assert load(tab, "program1_examples", "example5").endswith("is loaded. Press START.")
    press(tab)
    assert paper(tab) == ["POINTS ARE NOT COPLANAR"]
    assert cards(tab) == printed[1, "punch"]
    tab.click("#desk-next")
    state(tab, "ended")
    final = cards(tab)
    assert final == printed[3, "punch"]
    tab.wait_for_function("document.querySelectorAll('#desk [data-lamp].is-on').length === 1")
    assert tab.inner_text("#desk-caption").startswith("Hull 3: 6 equations through 5 vertices.")
    tab.fill("#desk-statement", "400")
    tab.click("#desk-jump button")
    assert "before" in state(tab, "waits")
    assert cards(tab) == final[: len(cards(tab))] != final
    tab.click("#desk-back")
    tab.wait_for_function("document.getElementById('desk-statements').textContent === 'of 399'")
    press(tab)
    assert cards(tab) == final
    tab.click("[data-look=core]")
    tab.focus("#desk-core")
    tab.evaluate("document.getElementById('desk-core').scrollIntoView()")
    for _ in range(159):
        tab.keyboard.press("ArrowDown")
    tab.keyboard.press("Enter")
    tab.wait_for_function(
        "/^X\\(.*Digits .*Written last by card/.test(document.getElementById('desk-field').textContent)"
    )
    tab.click("[data-look=points]")


CLIPPED = """() => ["hopper", "stacker", "listing"].flatMap((name) => {
  const list = document.getElementById(`desk-${name}`), range = document.createRange();
  const edge = list.getBoundingClientRect().left + list.clientLeft + list.clientWidth;
  return [...list.children].map((row) => {
    range.selectNodeContents(row);
    return [row.textContent, range.getBoundingClientRect().right];
  }).filter(([text, right]) => right > edge && (name === "listing" || text.length <= 42)).map(([text]) => text);
})"""
"""The cards that leave their lists: cards of the program, and cards with at most three coordinates of 14 columns."""

CUT_MENUS = """() => ["program", "deck"].flatMap((name) => {
  const menu = document.getElementById(`desk-${name}`), pen = document.createElement("canvas").getContext("2d");
  const style = getComputedStyle(menu);
  pen.font = `${style.fontSize} ${style.fontFamily}`;
  const room = menu.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight) - 18;
  return [...menu.options].map(({ text }) => text).filter((text) => pen.measureText(text).width > room);
})"""
"""The titles that are wider than their menu, whose arrow is 18 pixels wide."""


def test_cards_menus_and_commentary_fit_their_places(tab: Page) -> None:
    for width, program, deck in ((1280, "program1_examples", "example5"), (1280, "program3", "example5/punched")):
        tab.set_viewport_size({"width": width, "height": 900})
        load(tab, program, deck)
        press(tab)
        assert tab.evaluate(CLIPPED) == []
        assert tab.evaluate(CUT_MENUS) == []
        assert tab.locator(".machine ~ p").first.evaluate("one => one.clientWidth") <= 46 * 16
        tab.set_viewport_size({"width": 360, "height": 740})
        lines = "one => one.getBoundingClientRect().height / parseFloat(getComputedStyle(one).lineHeight)"
        shown = tab.locator("#desk-about").evaluate(lines)
        assert shown == pytest.approx(round(shown), abs=0.01), "no line of the commentary is cut"
        tab.click(".m-tabs [data-view=cards]")
        assert [card for card in tab.evaluate(CLIPPED) if len(card) <= 42] == []
        tab.click(".m-tabs [data-view=program]")
        tab.evaluate("scrollTo(0, document.body.scrollHeight)")
        end = "document.querySelector('footer').getBoundingClientRect().bottom"
        assert tab.evaluate(f"{end} < document.querySelector('.m-keys').getBoundingClientRect().top")
    tab.set_viewport_size({"width": 1280, "height": 800})


def test_pages_ask_for_javascript_only_without_it(chromium: Browser, served: str) -> None:
    for is_on in (True, False):
        context = chromium.new_context(java_script_enabled=is_on)
        page = context.new_page()
        # Without its scripts, the page is as it is before they run.
        page.route("**/*.js*", lambda route: route.abort())
        for name, state_id in (("console.html", "desk-state"), ("parting.html", "parting-says")):
            page.goto(f"{served}/{name}")
            message = page.inner_text(f"#{state_id}")
            assert ("needs JavaScript" in message) is not is_on
        context.close()


def test_tic_tac_toe_is_won_by_typing_the_number_of_a_square(tab: Page) -> None:
    assert load(tab, "tictac.f").startswith("tictac.f")
    assert tab.input_value("#desk-deck") == "tictac.deck"
    press(tab)
    for move in "1974":
        tab.wait_for_selector("#desk-ruler:not([hidden])")
        tab.wait_for_function(
            "(({ scrollTop, clientHeight, scrollHeight }) => scrollTop + clientHeight > scrollHeight - 2)"
            "(document.getElementById('desk-paper'))"
        )
        tab.fill("#desk-line", move)
        assert f"I2 in columns 1 to 2\n         1         2\n12345678901234567890\nI2                  \n {move}" in (
            tab.inner_text("#desk-ruler")
        )
        tab.press("#desk-line", "Enter")
        tab.wait_for_function("m => document.getElementById('desk-paper').textContent.includes(' ' + m)", arg=move)
        state(tab, "waits")
    tab.wait_for_function("document.getElementById('desk-paper').textContent.includes('YOU WIN')")
    fit(tab)
    assert tab.is_visible(".m-try a")
    tab.evaluate(
        "deskPage.speeds[0].checked = true;"
        "deskPage.paper(['A TYPED LINE'], 'typed');"
        "deskPage.paper(['a note'], 'note');"
    )
    assert tab.inner_text("#desk-paper").rstrip().split("\n")[-2:] == ["A TYPED LINE", "a note"]
    tab.check("[name=desk-speed][value='0']")


def test_the_keypunch_shows_errors_next_to_their_cards_and_loads_three_cards(tab: Page) -> None:
    tab.select_option("#desk-program", "tictac.f")
    tab.click("#desk-punch-open")
    assert tab.input_value("#punch-name") == "tictac2.f", "the sample is not overwritten"
    assert "TIC-TAC-TOE" in tab.input_value("#punch-text")
    tab.click("#punch-new")
    assert tab.input_value("#punch-name") == "mine.f"
    assert tab.input_value("#punch-text").count("\n") == 3
    tab.fill("#punch-text", "      TYPE 5\n    5 FORMAT(2HHI\n      END\n")
    tab.wait_for_function("document.querySelector('#punch-messages li:nth-child(2)')?.textContent")
    fit(tab)
    tab.fill("#punch-text", "      TYPE 5\n    5 FORMAT(2HHI)\n      END\n")
    tab.wait_for_function("document.getElementById('punch-state').textContent === 'No errors.'")
    tab.click("#punch-use")
    state(tab, "waits")
    assert [tab.input_value(f"#desk-{name}") for name in ("program", "deck")] == ["mine.f", ""]
    load(tab, "mine.f", "")
    press(tab)
    assert paper(tab) == ["HI"]


def test_the_desk_runs_example_6_from_a_folder_without_a_server(chromium: Browser, folder: Path) -> None:
    page = chromium.new_page(viewport={"width": 360, "height": 740}, reduced_motion="reduce")
    page.goto(f"{folder.as_uri()}/console.html#program=program1_examples&deck=example6&speed=0&next=1")
    page.wait_for_function("/3 with/.test(document.getElementById('desk-next').textContent)", timeout=4 * LONG)
    page.wait_for_function("document.getElementById('desk-card').textContent === 'card 11'", timeout=LONG)
    state(page, "ended")
    assert cards(page) == {(p.program, p.device): list(p.lines) for p in prints(6)}[3, "punch"]
    assert page.evaluate("document.documentElement.scrollWidth") == 360
    page.close()


def test_the_comparison_in_the_page_equals_that_in_python(chromium: Browser, served: str) -> None:
    from modern.publication.console import point_sets
    from modern.publication.parting import parted

    page = chromium.new_page()
    page.goto(f"{served}/parting.html")
    assert "missed: point 1, point 2, point 3" in page.inner_text("#parting-answer")
    page.click("#parting-begin")
    page.wait_for_selector("#parting[data-state=on]", timeout=2 * LONG)
    for name, text in list(point_sets().items())[1:3]:
        page.select_option("#parting-sets", name)
        expected = parted(text)
        page.wait_for_function(
            "w => document.getElementById('parting-answer').innerText.includes(w)",
            arg=expected["says"][0],
            timeout=LONG,
        )
        for line in (*expected["says"], *expected["reason"], expected["part"]):
            shown_line = line.replace("fortran_src/KNOWN-FAULTS.md", "Faults of the originals")
            assert shown_line in page.inner_text("#parting-answer")
        assert page.evaluate(OVERPRINTED) == []
        shown = page.locator(".parting-true").count()
        faces = expected["true"]["faces"]
        edges = {frozenset(pair) for face in faces for pair in zip(face, face[1:] + face[:1], strict=True)}
        assert shown == len(edges)
    page.fill("#parting-points", "1 2")
    page.click("#parting-go")
    page.wait_for_function("/Not run/.test(document.getElementById('parting-answer').innerText)", timeout=LONG)
    page.close()


def test_the_page_is_kept_for_a_visit_without_a_network(tab: Page) -> None:
    parts = ["console.html", "console/worker.js", "console/size.js", "_static/desk/run.js", "console/machine.gzip"]
    missing = tab.evaluate(
        """async (parts) => {
          const cache = await caches.open("hull1620-machine");
          const isKept = (part) => cache.match(new URL(part, location.href), { ignoreSearch: true });
          return (await Promise.all(parts.map(async (part) => (await isKept(part)) ? "" : part))).filter(Boolean);
        }""",
        parts,
    )
    assert missing == []


OVERPRINTED = """() => {
  const picture = document.getElementById("parting-picture");
  const dots = [...picture.querySelectorAll("circle")].map(({ cx, cy, r }) => [cx, cy, r].map((x) => x.baseVal.value));
  return [...picture.querySelectorAll("text")].filter((text) => {
    const { x, y, width, height } = text.getBBox();
    const beyond = (at, from, to) => Math.max(from - at, 0, at - to);
    // Digits fill the middle of the height of a line.
    const [top, bottom] = [y + height / 4, y + 0.75 * height];
    return dots.some(([a, b, radius]) => Math.hypot(beyond(a, x, x + width), beyond(b, top, bottom)) < radius);
  }).map((text) => text.textContent);
}"""
"""The numbers of points over which a dot or a ring is printed."""


def test_the_menu_names_own_points_and_numbers_are_next_to_dots(chromium: Browser, served: str) -> None:
    page = chromium.new_page()
    page.goto(f"{served}/parting.html")
    assert page.locator("#parting-picture text").count() == 4
    assert page.evaluate(OVERPRINTED) == []
    preset = page.input_value("#parting-sets")
    points = page.input_value("#parting-points")
    page.fill("#parting-points", "0 0 0\n1 2 3\n")
    assert page.input_value("#parting-sets") == "your own points"
    page.select_option("#parting-sets", preset)
    assert page.input_value("#parting-points").strip() == points.strip()
    page.select_option("#parting-sets", "your own points")
    assert page.input_value("#parting-points") == "0 0 0\n1 2 3\n"
    page.fill("#parting-points", points)
    assert page.input_value("#parting-sets") == preset
    page.close()


def test_a_point_can_be_dragged(chromium: Browser, served: str) -> None:
    page = chromium.new_page()
    page.goto(f"{served}/parting.html")
    page.select_option("#parting-sets", "seven points in a plane, which can be dragged")
    before = page.input_value("#parting-points")
    box = page.locator("[data-n='0']").bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.down()
    page.mouse.move(box["x"] + 40, box["y"] + 30)
    page.mouse.up()
    after = page.input_value("#parting-points").split("\n")
    assert after[0] != before.split("\n")[0]
    assert after[1:] == before.split("\n")[1:]
    assert page.input_value("#parting-sets") == "your own points"
    page.close()
