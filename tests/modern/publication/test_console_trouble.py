"""The emulator page in Chromium when something goes wrong or is repeated: refusals, endless runs, logs and links.

The tests need Chromium, playwright and the npm package pyodide (``npm ci --prefix docs/console``); otherwise they are
skipped with a message.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from modern.publication.desk import Desk
from tests.support.console import cards, fit, give, load, needs_pyodide, press, state
from tests.support.desks import Pair, played
from tests.support.editions import LONG

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = needs_pyodide


def test_a_refused_load_empties_the_machine(tab: Page) -> None:
    load(tab, "program1", "example1")
    give(tab, "bad.f", "      I=\n      END\n")
    tab.wait_for_function("document.getElementById('desk-program').value === 'bad.f'")
    message = load(tab, "bad.f")
    assert message.startswith("Refused: bad.f: card 1, column 8: error: the statement ends too soon")
    assert message.endswith("Correct the cards at the Keypunch, or choose others and press Load.")
    assert tab.locator("#desk-listing li").count() == 0
    assert tab.inner_text("#desk-statements") == "of 0"
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


def test_a_damaged_link_is_reported_and_a_link_opened_while_the_emulator_loads_is_followed(chromium, served) -> None:
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
