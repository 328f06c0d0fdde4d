"""The port under the 1620's arithmetics compared with the cards that the emulated programs punch, including signs of
zeros.

HULL1620_SETS sets the number of random decks of a test.
"""

import os
import random
from collections.abc import Callable, Iterable
from functools import cache, partial
from pathlib import Path

import pytest

from emulator.language.cards import Deck, deck_from_lines
from emulator.machine.result import Options
from emulator.numbers import numbers
from modern.edition import programs
from modern.formats.deck import coordinate_field
from modern.geometry.hull import DETERMINED, ERROR, NOT_ACCEPTABLE, TABLE_FULL, Hull
from modern.port.points import first_of_equals, take
from modern.thesis.batch import run_hulls
from modern.thesis.job import HullRun
from tests.support.paths import MACHINE_RUNS
from tests.support.ported import convex_hull
from tests.support.punched import differences, from_cards, from_run

SETS = int(os.environ.get("HULL1620_SETS", "150"))
RUNS = MACHINE_RUNS
CORE = 60_000
"""The layer ``corrected`` has larger tables than a memory of 40,000 positions holds."""

Point = tuple[str, str, str]
SPANS = (1, 2, 3, 5, 9, 20, 99, 999)
COUNTS = (1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 15, 20, 25, 30, 40, 51)


def anywhere(r: random.Random, n: int) -> list[Point]:
    a = r.choice(SPANS)
    return [point(r.randint(-a, a) for _ in range(3)) for _ in range(n)]


def grid(r: random.Random, n: int) -> list[Point]:
    a = r.choice((1, 2, 3))
    return [point(r.randint(0, a) for _ in range(3)) for _ in range(n)]


def in_line(r: random.Random, n: int) -> list[Point]:
    origin, step = (tuple(r.randint(-9, 9) for _ in range(3)) for _ in range(2))
    return [point(o + t * s for o, s in zip(origin, step, strict=True)) for t in (r.randint(-6, 6) for _ in range(n))]


def in_plane(r: random.Random, n: int) -> list[Point]:
    a = r.choice((1, 5, 20))
    u, v, o = (tuple(r.randint(-a, a) for _ in range(3)) for _ in range(3))
    m = r.choice((1, 2, 3, 8))
    steps = [(r.randint(-m, m), r.randint(-m, m)) for _ in range(n)]
    return [point(o[i] + s * u[i] + t * v[i] for i in range(3)) for s, t in steps]


def on_sphere(r: random.Random, n: int) -> list[Point]:
    radius = r.choice((5, 30, 90, 900))
    points = []
    for _ in range(n):
        x = [r.gauss(0, 1) for _ in range(3)]
        size = sum(c * c for c in x) ** 0.5
        points.append(point(round(c / size * radius) for c in x))
    return points


def digits(r: random.Random, n: int) -> list[Point]:
    d = r.randint(1, 8)
    exponents = (0, 0, -d, r.randint(-3, 3))
    return [point(f"{r.randint(1 - 10**d, 10**d - 1)}e{r.choice(exponents)}" for _ in range(3)) for _ in range(n)]


def wild(r: random.Random, n: int) -> list[Point]:
    """Draw exponents at which products overflow or vanish."""
    e = r.choice((0, 30, 33, 45, 90, -30, -33, -49, -90))
    return [point(f"{r.randint(-99, 99)}e{e + r.randint(-4, 4)}" for _ in range(3)) for _ in range(n)]


def minus_zeros(r: random.Random, n: int) -> list[Point]:
    return [point(r.choice(("-0", "0", "1", "-1", "2")) for _ in range(3)) for _ in range(n)]


INTEGERS = (anywhere, anywhere, grid, in_line, in_plane, in_plane, on_sphere)
KINDS = (*INTEGERS, digits, digits, wild, minus_zeros)
Kind = Callable[[random.Random, int], list[Point]]


def point(coordinates: Iterable[object]) -> Point:
    x, y, z = (str(c) for c in coordinates)
    return x, y, z


def points_of(seed: int, arithmetic: str, kinds: tuple[Kind, ...] = ()) -> list[Point]:
    """Draw the points of a deck, distinct in the given arithmetic."""
    r = random.Random(seed)
    n = r.choice(COUNTS) if r.random() < 0.4 else r.randint(3, 14)
    points = r.choice(kinds or KINDS)(r, n)
    arithmetic_of_deck, coordinates = take(points, arithmetic)
    distinct, _ = first_of_equals(arithmetic_of_deck.keys(coordinates))
    return [points[k] for k in distinct]


@cache
def hull_of(seed: int, arithmetic: str) -> Hull:
    return convex_hull(points_of(seed, arithmetic), arithmetic)


def deck(points: list[Point], epsilon: str = "") -> Deck:
    cards = ["".join(coordinate_field(x, True) for x in p) for p in points]
    return deck_from_lines("deck", [f"{len(points):2d}{epsilon}", *cards])


def check_cards(hulls: list[Hull], decks: list[Deck], arithmetic: str, *layers: str) -> None:
    """Run the programs on all decks at once, compiled if possible, and compare their cards with the hulls."""

    load = partial(programs.with_layers, layers=layers)
    runs = run_hulls(decks, load, Options(numbers=numbers(arithmetic), core=CORE, limit=3_000_000))
    for hull, run, cards in zip(hulls, runs, decks, strict=True):
        assert isinstance(run, HullRun)
        assert differences(hull, from_run(run)) == [], cards.cards


@pytest.mark.parametrize("arithmetic", ["truncating", "truncating:4", "ibm1962", "guarded:5", "rounding:5"])
def test_port_reproduces_the_cards_of_layer_corrected(arithmetic: str) -> None:
    seeds = range(SETS)
    hulls = [hull_of(seed, arithmetic) for seed in seeds]
    check_cards(hulls, [deck(points_of(seed, arithmetic)) for seed in seeds], arithmetic, "corrected")
    assert {DETERMINED, NOT_ACCEPTABLE, ERROR} <= {hull.status for hull in hulls}


def test_port_reproduces_the_cards_of_the_listing_if_no_correction_mattered() -> None:
    hulls = {seed: hull_of(seed, "truncating") for seed in range(SETS)}
    plain = [seed for seed, hull in hulls.items() if not hull.corrected and hull.status != TABLE_FULL]
    check_cards([hulls[seed] for seed in plain], [deck(points_of(seed, "truncating")) for seed in plain], "truncating")
    assert len(plain) > sum(bool(hull.corrected) for hull in hulls.values()) > 0


def test_port_reproduces_the_cards_of_layer_epsilon() -> None:
    """Chapter 7, thesis p. 117-118: e follows N on the first card."""
    hulls, decks = [], []
    for seed in range(SETS):
        epsilon = random.Random(seed).choice(("0", "1e-3", "5e-1", "1", "25e-1", "1e2", "1e4"))
        points = points_of(seed, "truncating")
        hulls.append(convex_hull(points, "truncating", epsilon=epsilon))
        decks.append(deck(points, coordinate_field(epsilon)))
    check_cards(hulls, decks, "truncating", "corrected", "epsilon")


def test_port_reproduces_the_cards_of_layer_translation() -> None:
    """Chapter 7, thesis p. 118-119. Integers only: longer numbers lose digits on the way to C and back."""
    sets = [points_of(seed, "truncating", INTEGERS) for seed in range(SETS)]
    hulls = [convex_hull(points, "truncating", translate=True) for points in sets]
    check_cards(hulls, list(map(deck, sets)), "truncating", "corrected", "translation")


def test_every_correction_takes_effect_on_its_deck_in_the_apparatus() -> None:
    met = {}
    for row in (row for name in programs.TEXTS for row in programs.text(name).rows if row.layer == "corrected"):
        cards = read_ground(row.ground["deck"])
        met[row.id] = set(convex_hull(cards, "truncating").corrected)
    for name in ("P2-023", "P2-024", "P2-025", "P3-025", "P3-026", "P3-027", "P3-028"):
        assert name in met[name], met


def read_ground(name: str) -> list[Point]:
    lines = programs.sources().joinpath("grounds", f"{name}.deck").read_text().splitlines()
    return card_points(lines)


def card_points(lines: list[str]) -> list[Point]:
    count = int(lines[0][:2])
    return [(c[:14].strip(), c[14:28].strip(), c[28:42].strip()) for c in lines[1 : count + 1]]


FOLDERS = sorted(path for path in RUNS.iterdir() if path.is_dir())


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_port_reproduces_the_cards_of_period_compilers(folder: Path) -> None:
    """Use tests/data/machine_runs: cards of object programs by IBM's and another compiler, without corrections."""
    hull = convex_hull(card_points((folder / "deck.cards").read_text().splitlines()), "truncating")
    typed = "".join(path.read_text() for path in sorted(folder.glob("program[123].typewriter")))
    if hull.corrected:
        assert ERROR in typed or list(folder.glob("*.endless"))
        return
    last = max(folder.glob("program[123].cards"))
    status = next((message for message in (NOT_ACCEPTABLE, ERROR) if message in typed), DETERMINED)
    punched = from_cards(last.read_text().splitlines(), status)
    assert differences(hull, punched) == []


def test_comparison_reports_changed_statuses_signs_of_zero_and_order() -> None:
    hull = convex_hull([(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4), (1, 1, 1)], "truncating")
    (run,) = run_hulls([deck(list(hull.points))], programs.program, Options())
    assert isinstance(run, HullRun)
    cards = list(run.final.result.punched)
    assert differences(hull, from_cards(cards)) == []
    assert [d.split(":")[0] for d in differences(hull, from_cards(cards, ERROR))] == ["status"]
    equation = next(k for k, card in enumerate(cards) if "-.00000000E-99" in card)
    changed = [*cards[:equation], cards[equation].replace("-.00", " .00"), *cards[equation + 1 :]]
    assert [d.split(":")[0] for d in differences(hull, from_cards(changed))] == ["equations"]
    first = next(k for k, card in enumerate(cards) if card.startswith("  1 "))
    cards[first], cards[first + 1] = cards[first + 1], cards[first]
    assert [d.split(":")[0] for d in differences(hull, from_cards(cards))] == ["vertices"]
