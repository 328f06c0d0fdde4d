"""The emulator page in Chromium: it must give the same output as the desk, and so as the command line.

The tests need Chromium, playwright and the npm package pyodide (``npm ci --prefix docs/console``); otherwise they are
skipped with a message.
"""

from __future__ import annotations

import itertools
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from modern.edition.chapter6 import prints
from modern.publication.console import SOURCE
from modern.publication.desk import Desk
from tests.modern.publication.test_site_layout import problems
from tests.support.desks import Pair, played
from tests.support.editions import LONG

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

pytestmark = pytest.mark.skipif(
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
    assert tab.inner_text("#desk-caption") == "Left: the hull in the machine. Right: the true hull."
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


def test_tic_tac_toe_is_won_by_typing_the_number_of_a_square(tab: Page) -> None:
    assert load(tab, "tictac.f").startswith("tictac.f")
    assert tab.input_value("#desk-deck") == "tictac.deck"
    press(tab)
    for move in "1974":
        tab.wait_for_selector("#desk-ruler:not([hidden])")
        tab.fill("#desk-line", move)
        assert f"I2 in columns 1 to 2\n         1         2\n12345678901234567890\nI2                  \n {move}" in (
            tab.inner_text("#desk-ruler")
        )
        tab.press("#desk-line", "Enter")
        tab.wait_for_function("m => document.getElementById('desk-paper').textContent.includes(' ' + m)", arg=move)
        state(tab, "waits")
    tab.wait_for_function("document.getElementById('desk-paper').textContent.includes('YOU WIN')")
    fit(tab)


def test_a_refused_load_empties_the_machine(tab: Page) -> None:
    load(tab, "program1", "example1")
    give(tab, "bad.f", "      I=\n      END\n")
    tab.wait_for_function("document.getElementById('desk-program').value === 'bad.f'")
    message = load(tab, "bad.f")
    assert message.startswith("Refused: bad.f: card 1, column 8: error: the statement ends too soon")
    assert tab.locator("#desk-listing li").count() == 0
    fit(tab)
    tab.click("[data-words=ATTN]")
    tab.wait_for_function("document.getElementById('desk-paper').textContent.includes('nothing is loaded')")
    assert tab.inner_text("#desk-state") == message
    tab.select_option("#desk-program", "stats.f")
    assert press(tab).startswith("The run has ended.")


def test_a_slice_that_fails_is_reported_and_start_loads_again(tab: Page) -> None:
    load(tab, "stats.f")
    tab.evaluate("deskRun.ask('pace', 'fast')")
    assert press(tab).startswith("The emulator reports: TypeError")
    tab.evaluate("deskRun.ask('pace', 0)")
    assert press(tab).startswith("The run has ended.")


def test_an_earlier_load_does_not_press_start_on_a_later_one(tab: Page) -> None:
    load(tab, "stats.f")
    tab.evaluate("Promise.all([deskRun.load(true, '131'), deskRun.load()])")
    assert state(tab, "waits") == "stats.f is loaded. Press START."
    log = tab.evaluate("deskRun.ask('log')").rpartition("LOAD")[2]
    assert "START" not in log
    assert "BREAK" not in log


def test_start_loads_again_after_a_load_that_fails(tab: Page) -> None:
    load(tab, "stats.f")
    tab.evaluate("deskChoice.took = deskChoice.request; deskChoice.request = () => ({})")
    tab.click("#desk-load")
    assert state(tab, "ended") == "The emulator reports: KeyError: 'program'"
    assert tab.locator("#desk-listing li").count() == 0
    tab.evaluate("deskChoice.request = deskChoice.took")
    assert press(tab).startswith("The run has ended.")


def test_a_load_or_a_key_ends_the_repetition_of_a_log(tab: Page) -> None:
    # START waits for a halt of a program that has none.
    cards = "CARDS count.f\nCARD       X=0.\nCARD     1 X=X+1.\nCARD       GO TO 1\nCARD       END\n"
    log = cards + 2 * "LOAD count.f\nSTART\n"
    tab.select_option("#desk-program", "stats.f")
    tab.evaluate("log => Promise.all([deskRun.replay(log), deskRun.load()])", log)
    assert state(tab, "waits") == "stats.f is loaded. Press START."
    assert press(tab).startswith("The run has ended.")
    assert tab.evaluate("deskRun.ask('log')").rpartition("LOAD ")[2].startswith("stats.f")
    give(tab, "session.operator", log)
    state(tab, "runs")
    tab.click("[data-words=ATTN]")
    assert "stopped (attention) before" in state(tab, "waits")
    assert press(tab, "STOP").startswith("The run has stopped")
    assert "the rest of the log is not repeated" in tab.inner_text("#desk-paper")
    assert "START" not in tab.evaluate("deskRun.ask('log')").rpartition("LOAD ")[2]


def test_a_slow_compilation_restarts_the_emulator_and_a_failing_one_does_not(tab: Page) -> None:
    tab.evaluate(
        """async () => {
          const { setTimeout } = window;
          window.setTimeout = (action, time) => setTimeout(action, time / 20);
          const { request } = deskChoice;
          deskChoice.request = () => ({});
          await deskRun.load();
          await new Promise((done) => setTimeout(done, 700));
          if (!deskRun.isOn) throw new Error("the emulator was restarted after a load that failed");
          Object.assign(deskChoice, { request });
          window.setTimeout = (action) => setTimeout(action, 0);
          deskRun.load();
          await new Promise((done) => setTimeout(done, 20));
          Object.assign(window, { setTimeout });
        }"""
    )
    tab.wait_for_function("!deskRun.isOn")
    tab.wait_for_function(
        "/stopped after 10 seconds/.test(document.getElementById('desk-state').textContent)", timeout=LONG
    )
    tab.select_option("#desk-program", "stats.f")
    tab.evaluate("document.getElementById('desk').dataset.state = 'pressed'")
    tab.click("[data-words=START]")
    tab.wait_for_selector("#desk[data-state=ended]", timeout=4 * LONG)
    assert cards(tab)[-1].strip() == "R = -1.00000"


def test_the_keypunch_shows_errors_next_to_their_cards_and_loads_three_cards(tab: Page) -> None:
    tab.select_option("#desk-program", "program1")
    tab.click("#desk-punch-open")
    tab.fill("#punch-text", "      TYPE 5\n    5 FORMAT(2HHI\n      END\n")
    tab.wait_for_function("document.querySelector('#punch-messages li:nth-child(2)')?.textContent")
    fit(tab)
    tab.fill("#punch-text", "      TYPE 5\n    5 FORMAT(2HHI)\n      END\n")
    tab.wait_for_function("document.getElementById('punch-state').textContent === 'No errors.'")
    tab.click("#punch-use")
    load(tab, "mine.f", "")
    press(tab)
    assert paper(tab) == ["HI"]


def test_a_link_opens_a_moment_and_a_log_of_several_loads_is_repeated(tab: Page) -> None:
    address = "#program=program3&deck=example5/punched&speed=0&stop=125"
    tab.evaluate("document.getElementById('desk').dataset.state = 'linked'")
    tab.evaluate("hash => { location.hash = hash; }", address)
    tab.wait_for_function("document.getElementById('desk-state').textContent.includes('statement 125')", timeout=LONG)
    desk = Desk()
    sessions = [played(desk, Pair(p, p, d)) for p, d in (("program1_examples", "example4"), ("program2", "PUNCHED"))]
    tab.evaluate("document.getElementById('desk').dataset.state = 'replaying'")
    give(tab, "session.operator", desk.log())
    tab.wait_for_function("document.querySelectorAll('#desk-stacker li').length > 40", timeout=LONG)
    state(tab, "ended")
    assert cards(tab) == [card.rstrip() for card in sessions[1].punched]


def test_a_long_run_can_be_stopped(tab: Page) -> None:
    give(tab, "loop.f", "      X=0.\n    1 X=X+1.\n      GO TO 1\n      END\n")
    tab.wait_for_function("document.getElementById('desk-program').value === 'loop.f'")
    load(tab, "loop.f", "")
    tab.click("[data-words=START]")
    state(tab, "runs")
    fit(tab)
    tab.click("[data-words=ATTN]")
    assert "stopped (attention) before" in state(tab, "waits")
    message = press(tab, "STOP")
    assert message.startswith("The run has stopped")
    tab.click("[data-words=ATTN]")
    tab.wait_for_function("document.getElementById('desk-paper').textContent.includes('the run has ended: press Load')")
    assert tab.inner_text("#desk-state") == message


def test_an_endless_run_is_recognised_and_a_chosen_program_starts_without_a_load(tab: Page) -> None:
    give(tab, "loop.f", "    1 GO TO 1\n      END\n")
    tab.wait_for_function("document.getElementById('desk-state').textContent.startsWith('loop.f with')")
    assert press(tab).startswith("Without an action of yours, this run never ends: it repeats the same st")
    press(tab, "STOP")
    tab.select_option("#desk-program", "stats.f")
    assert tab.inner_text("#desk-state") == "stats.f with stats.deck. Press START."
    assert press(tab).startswith("The run has ended.")
    assert cards(tab)[-1].strip() == "R = -1.00000"


def test_a_damaged_link_is_reported_and_a_link_opened_while_the_emulator_loads_is_followed(
    chromium: Browser, served: str
) -> None:
    page = chromium.new_page()
    page.goto(f"{served}/console.html#program=mine.f&program-cards=!!!")
    page.wait_for_selector("#desk[data-state=on]", timeout=4 * LONG)
    damaged = (
        "document.getElementById('desk-state').textContent === 'The cards in the address of the page are damaged.'"
    )
    page.wait_for_function(damaged)
    page.goto("about:blank")
    page.goto(f"{served}/console.html#program=stats.f&deck=stats.deck")
    page.evaluate("location.hash = 'program=program3&deck=example5/punched&speed=0&stop=125'")
    page.wait_for_function(
        "document.getElementById('desk-state').textContent.includes('statement 125')", timeout=4 * LONG
    )
    page.evaluate("location.hash = 'program=mine.f&program-cards=!!!'")
    page.wait_for_function(damaged)
    page.close()


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
            assert line in page.inner_text("#parting-answer")
        shown = page.locator(".parting-true").count()
        assert shown == len(expected["true"]["faces"])
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
    page.close()
