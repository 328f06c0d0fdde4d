"""The emulator page in Chromium: it must give the same output as the desk, and so as the command line.

The tests need Chromium, playwright and the npm package pyodide (``npm ci --prefix docs/console``); otherwise they are
skipped with a message.
"""

from __future__ import annotations

import random
import threading
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from modern.edition.chapter6 import prints
from modern.formats.deck import data_deck
from modern.publication.console import SOURCE, install_machine
from modern.publication.desk import Desk
from tests.support.desks import PAIRS, Pair, Played, played
from tests.support.editions import packed

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

pytestmark = pytest.mark.skipif(
    not (SOURCE / "node_modules" / "pyodide").is_dir(),
    reason="pyodide is missing (npm ci --ignore-scripts --prefix docs/console)",
)
LONG = 60_000
"""The longest time to wait for the page, in milliseconds."""


class Quiet(SimpleHTTPRequestHandler):
    """A server of a folder that does not log requests."""

    def log_message(self, format: str, *args: Any) -> None:
        """Log nothing."""


@pytest.fixture(scope="module")
def served(site: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Serve the site with the emulator on the loopback interface and yield its address."""
    room = tmp_path_factory.mktemp("console")
    folder = room / "site"
    folder.mkdir()
    for entry in site.iterdir():
        if entry.name != "console":
            (folder / entry.name).symlink_to(entry)
    assert install_machine(folder / "console", packed(room)) > 0
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=str(folder)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()
    server.server_close()


@pytest.fixture(scope="module")
def tab(chromium: Browser, served: str) -> Iterator[Page]:
    """Return the emulator page, switched on."""
    page = chromium.new_page(viewport={"width": 1280, "height": 1000})
    page.goto(f"{served}/console.html")
    switch_on(page)
    yield page
    page.close()


def switch_on(page: Page) -> None:
    page.click("#desk-begin")
    page.wait_for_selector(".desk-parts:not([hidden])", timeout=2 * LONG)


def stands(page: Page, *states: str) -> str:
    """Wait until the machine waits or the run has ended, and return the state."""
    selector = ", ".join(f"#desk[data-state={state}]" for state in states or ("waits", "ended"))
    page.wait_for_selector(selector, timeout=LONG)
    return str(page.get_attribute("#desk", "data-state"))


def give(page: Page, name: str, text: str) -> None:
    page.set_input_files("#desk-files", [{"name": name, "mimeType": "text/plain", "buffer": text.encode("ascii")}])


def load(page: Page, pair: Pair) -> bool:
    """Choose and load a program and a deck; return True if the emulator accepts them."""
    if pair.source:
        give(page, pair.program, pair.source)
    if pair.cards:
        give(page, pair.deck, pair.cards)
    page.wait_for_function(
        "([p, d]) => [...document.querySelectorAll('option')].filter(o => o.value === p || o.value === d).length > 1",
        arg=[pair.program, pair.deck],
    )
    page.select_option("#desk-program", pair.program)
    page.select_option("#desk-deck", pair.deck)
    page.set_checked("#desk-upcase", pair.upcase)
    page.evaluate(
        """() => {
          document.getElementById('desk').dataset.state = 'loading';
          document.getElementById('desk-paper').replaceChildren();
          for (const one of document.querySelectorAll('[data-switch]')) one.ariaChecked = 'false';
        }"""
    )
    page.click("#desk-load")
    page.wait_for_function(
        "document.querySelector('.desk-note') || document.getElementById('desk').dataset.state !== 'loading'",
        timeout=LONG,
    )
    return page.get_attribute("#desk", "data-state") != "loading"


def gave(page: Page, taken: bool) -> Played:
    """Return the lines on the typewriter and the cards in the stacker."""
    lines = page.eval_on_selector_all("#desk-stacker li", "all => all.map(one => one.textContent)")
    typed = page.eval_on_selector_all("#desk-paper .desk-typed", "all => all.map(one => one.textContent.slice(0, -1))")
    notes = page.eval_on_selector_all("#desk-paper .desk-note", "all => all.map(one => one.textContent.slice(0, -1))")
    said = [note for note in notes if not taken or note.startswith(("hull1620:", "warning:", "note:"))]
    if not taken and said:
        said[0] = f"hull1620: {said[0]}"
    return Played(taken, [line if line != " " else "" for line in lines] if taken else [], typed, said)


def play(page: Page, pair: Pair) -> Played:
    """Load and run a pair on the page; the operator's actions follow whenever the machine waits."""
    if not load(page, pair):
        return gave(page, False)
    assert stands(page) == "waits"
    actions = [line for line in pair.operator if not line.startswith("*")]
    typed_by_hand: list[str] = []
    while actions and actions[0].startswith("SWITCH"):
        page.click(f"[data-switch='{actions.pop(0).split()[1]}']")
    action = "START"
    while True:
        page.evaluate("document.getElementById('desk').dataset.state = 'asked'")
        if action.startswith("ENTER"):
            page.fill("#desk-line", action[6:])
            page.press("#desk-line", "Enter")
            typed_by_hand.append(action[6:].upper())
        elif action.startswith("SWITCH"):
            page.click(f"[data-switch='{action.split()[1]}']")
        else:
            page.click(f"[data-words='{action}']")
        if stands(page) == "ended":
            break
        action = actions.pop(0) if actions else "START"
    output = gave(page, True)
    for line in typed_by_hand:
        output.typed.remove(line)
    return output


@pytest.mark.parametrize("pair", [p for p in PAIRS if p.shows != "endless"], ids=lambda pair: pair.name)
def test_cards_lines_and_messages_equal_those_of_the_desk(tab: Page, pair: Pair) -> None:
    assert play(tab, pair) == played(Desk(), pair)


def test_example_4_is_reproduced_from_deck_to_last_card(tab: Page) -> None:
    first = play(tab, Pair("one", "program1_examples", "example4"))
    assert first.typed == ["POINTS ARE COPLANAR"]
    tab.click("#desk-again")
    second = play(tab, Pair("two", "program2", "stacker"))
    printed = {(p.program, p.device): list(p.lines) for p in prints(4)}
    assert first.punched == printed[1, "punch"]
    assert second.punched == printed[2, "punch"]


def test_a_rejection_with_switch_1_off_and_on(tab: Page) -> None:
    draw = random.Random(1)
    points = [[str(draw.randint(-999, 999) / 10) for _ in range(3)] for _ in range(20)]
    cards = data_deck(points, "decimals.deck").text()
    outputs = []
    for switch in ((), ("SWITCH 1 ON",)):
        first = play(tab, Pair("one", "program1", "decimals.deck", cards=cards))
        assert first.typed == ["POINTS ARE NOT COPLANAR"]
        tab.click("#desk-again")
        pair = Pair("two", "program3", "stacker", operator=switch)
        on_page = play(tab, pair)
        desk = Desk()
        played(desk, Pair("one", "program1", "decimals.deck", cards=cards))
        assert on_page == played(desk, pair)
        assert "DATA NOT ACCEPTABLE" in on_page.typed
        outputs.append((on_page.typed, on_page.punched))
    assert outputs[0] != outputs[1], "switch 1 makes the program type more"


def test_an_endless_loop_can_be_stopped(tab: Page) -> None:
    loop = Pair("loop", "loop.f", "", source="    1 GO TO 1\n      END\n")
    assert load(tab, loop)
    stands(tab)
    tab.click("[data-words='START']")
    stands(tab, "runs")
    tab.wait_for_timeout(300)
    tab.evaluate(
        """async () => {
          document.querySelector("[data-words='ATTN']").click();
          const state = document.getElementById('desk').dataset;
          while (state.state !== 'waits') await new Promise((next) => setTimeout(next, 5));
        }"""
    )
    assert "stopped (attention) before statement 1" in tab.inner_text("#desk-state")
    tab.click("[data-words='STOP']")
    assert stands(tab, "ended") == "ended"


def test_console_commands_are_answered(tab: Page) -> None:
    assert load(tab, Pair("x", "program1", "example1"))
    stands(tab)
    for command, answer in (("BREAK 131", "BREAK 131"), ("SWITCH", "1 OFF, 2 OFF"), ("NONSENSE", "is not a command")):
        tab.fill("#desk-line", command)
        tab.press("#desk-line", "Enter")
        tab.wait_for_function("w => document.getElementById('desk-paper').textContent.includes(w)", arg=answer)
    assert tab.locator("#desk-variables").inner_text().startswith("X(51): 0 of 51 defined")


def test_9999_bad_cards_are_reported_and_the_page_stays_responsive(tab: Page) -> None:
    source = "".join(f"      GO TO {n}\n" for n in range(1, 9999)) + "      END\n"
    give(tab, "bad.f", source)
    tab.wait_for_function("[...document.querySelectorAll('#desk-program option')].some(o => o.value === 'bad.f')")
    tab.select_option("#desk-program", "bad.f")
    tab.select_option("#desk-deck", "")
    tab.click("#desk-load")
    assert tab.evaluate("1 + 1") == 2
    tab.wait_for_function(
        "/bad.f: card|stopped after 10 seconds/.test(document.getElementById('desk-state').textContent)", timeout=20_000
    )
    tab.wait_for_function("!/Loading/.test(document.getElementById('desk-state').textContent)", timeout=2 * LONG)


def test_a_page_reloaded_during_a_run_starts_again(tab: Page) -> None:
    assert load(tab, Pair("loop", "loop.f", "", source="    1 GO TO 1\n      END\n"))
    stands(tab)
    tab.click("[data-words='START']")
    stands(tab, "runs")
    errors: list[str] = []
    tab.on("pageerror", lambda error: errors.append(str(error)))
    tab.reload()
    assert tab.is_visible(".desk-recorded")
    switch_on(tab)
    pair = next(pair for pair in PAIRS if pair.name == "program1 example1")
    assert play(tab, pair) == played(Desk(), pair)
    assert errors == []


def test_the_comparison_in_the_page_equals_that_in_python(chromium: Browser, served: str) -> None:
    from modern.publication.console import point_sets
    from modern.publication.parting import parted

    page = chromium.new_page()
    page.goto(f"{served}/parting.html")
    assert "missed: point 1, point 2, point 3" in page.inner_text("#parting-answer")
    page.click("#parting-begin")
    page.wait_for_selector("#parting[data-state=on]", timeout=2 * LONG)
    for name, text in list(point_sets().items())[1:]:
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
