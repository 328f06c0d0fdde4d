"""Each link of the site to the emulator's page starts its program, and the program reaches its known end."""

from __future__ import annotations

import random
import re
from html import unescape
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import parse_qs

import pytest

from modern.publication.console import PERIOD, SOURCE
from modern.publication.decks import offered
from tests.support.editions import LONG

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = pytest.mark.skipif(
    not (SOURCE / "node_modules" / "pyodide").is_dir(),
    reason="pyodide is missing (npm ci --ignore-scripts --prefix docs/console)",
)
DETERMINED = "CONVEX HULL HAS BEEN DETERMINED"
ERROR = "ERROR IN PROGRAM"
NO_ROOM = "The run has stopped: program3.f: card 89: MM(99) is outside its DIMENSION MM(98)"
# By the deck of the link: the program that ends the run, and a line that it then shows.
ENDS = {
    **{f"example{n}": ("program1_examples.f", "CONVEX HULL") for n in (1, 2, 3)},
    **{f"example{n}": (f"program{2 + (n > 4)}.f", DETERMINED) for n in (4, 5, 6)},
    **{f"{folder}/between": ("program2.f", DETERMINED) for folder in ("counterexamples", "grounds")},
    **{f"{folder}/table": ("program3.f", NO_ROOM) for folder in ("counterexamples", "grounds")},
    **{f"{folder}/throughc": ("program3.f", ERROR) for folder in ("counterexamples", "grounds")},
    **{f"{folder}/zeroplane": ("program3.f", ERROR) for folder in ("counterexamples", "grounds")},
    "counterexamples/cube": ("program3.f", ERROR),
    "counterexamples/silent": ("program3.f", DETERMINED),
    "counterexamples/z_in_39": ("program3.f", DETERMINED),
    "grounds/lastpair": ("program3.f", ERROR),
    "grounds/lastplane": ("program3.f", "this run never ends: it repeats the same 230,000 statements"),
    "grounds/polygon51": (
        "program2.f",
        "The run has stopped: program2.f: card 116: A(52) is outside its DIMENSION A(51)",
    ),
    "grounds/renumber": ("program2.f", DETERMINED),
    "fibon.deck": ("fibon.f", "RATIO  1.6180339"),
    "job.deck": ("job.f", "TYPE P,Q,R THEN A,B"),
    "pi.deck": ("pi.f", "PI =  3.1415928"),
    "stats.deck": ("stats.f", "R = -1.00000"),
    "table.deck": ("table.f", "END OF TABLES"),
    "tictac.deck": ("tictac.f", "YOUR MOVE"),
}


def links(site: Path) -> dict[str, dict[str, str]]:
    """Return the parameters of every link of the site to a moment of the machine."""
    pages = (path.read_text(encoding="utf-8") for path in sorted(site.rglob("*.html")))
    queries = {unescape(query) for page in pages for query in re.findall(r'console\.html\?([^"#]+)"', page)}
    return {query: {key: values[0] for key, values in parse_qs(query).items()} for query in queries}


def opened(page: Page, query: str, speed: int = 0) -> None:
    page.evaluate(
        "query => { document.getElementById('desk').dataset.state = 'linked'; location.hash = query; }",
        f"{query}&speed={speed}",
    )


def test_every_example_fault_counterexample_and_period_program_has_a_link(site: Path) -> None:
    decks = {name for name, _, _ in offered()["decks"] if "punched" not in name}
    decks |= {path.name for path in PERIOD.glob("*.deck")}
    assert {link["deck"] for link in links(site).values() if "stop" not in link} == ENDS.keys() <= decks
    assert {deck for deck in decks if not deck.startswith("grounds/")} <= ENDS.keys()


def test_every_linked_run_reaches_its_known_end(site: Path, tab: Page) -> None:
    for query, link in sorted(links(site).items()):
        if "stop" in link:
            continue
        opened(tab, query)
        program, line = ENDS[link["deck"]]
        tab.wait_for_function(
            """([program, line]) => deskShow.loaded?.program === program
              && ["ended", "waits"].includes(document.getElementById("desk").dataset.state)
              && ["state", "paper", "stacker"].some((id) =>
                document.getElementById(`desk-${id}`).textContent.includes(line))""",
            arg=[program, line],
            timeout=2 * LONG,
        )


def test_a_link_sets_the_speed_of_a_machine_that_is_on(tab: Page) -> None:
    opened(tab, "program=program1_examples&deck=example4", speed=1)
    tab.wait_for_selector("#desk[data-state=runs]", timeout=LONG)
    tab.wait_for_timeout(1000)
    assert tab.get_attribute("#desk", "data-state") == "runs", "example 4 takes longer on a 1620"
    opened(tab, "program=program1_examples&deck=example5", speed=0)
    tab.wait_for_selector("#desk[data-state=ended]", timeout=LONG)


def test_a_sample_of_the_links_of_cards_stops_before_them(site: Path, tab: Page) -> None:
    stops = sorted(query for query, link in links(site).items() if "stop" in link)
    assert len(stops) > 900
    for query in random.Random(1963).sample(stops, 12):
        opened(tab, query)
        card = parse_qs(query)["stop"][0].lower()
        tab.wait_for_selector("#desk[data-state=waits]", timeout=LONG)
        tab.wait_for_function(
            "card => document.getElementById('desk-card').textContent === card", arg=card, timeout=LONG
        )
