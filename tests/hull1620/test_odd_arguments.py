"""Public functions reject odd arguments with a documented error, within a second."""

import time
import warnings
from collections.abc import Callable, Iterator
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hull1620
from hull1620 import EmulatorError

SQUARE = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
PROGRAM = hull1620.load_program("program1")
DECK = hull1620.data_deck(SQUARE)
BAD_NUMBERS = [
    *(None, True, 1j, np.nan, np.inf, -np.inf, np.bool_(True), np.datetime64("2020"), object()),
    *(Decimal("1e99999999"), Decimal("-1e-99999999"), Decimal("nan"), Decimal("sNaN"), Decimal("inf"), 10**20_000),
    *(Fraction(1, 10**20_000), "", "x", "1/0", "1//2", "1e99999999", "9" * 5000, "1/" + "9" * 5000, "0x10", "1_000"),
    *("nan", "١", "1 2", b"1", bytearray(b"1"), [], [1], (), {}, {1}, range(3), np.array([1.0]), np.array(1.0), len),
]  # fmt: skip
LARGE = np.longdouble(10) ** 4900
NUMBERS = [*BAD_NUMBERS, 0, -0.0, 2**1023, 2.0**1023, 5e-324, LARGE, np.float16(1), np.uint64(2**63)]
BAD_POINTS = [
    *(None, 5, 1.5, True, "", "abc", b"", b"abc", bytearray(b"abc"), memoryview(b"abcabcabc"), len, [], (), {}),
    *({(0, 0, 0)}, frozenset({(1, 2, 3)}), {(0, 0, 0): 1}, {1: (0, 0, 0)}, iter([]), range(3), [[]], [[], []], [1, 2]),
    *([(1, 2)], [(1, 2, 3, 4)], [(1, 2, 3), (1, 2)], ["abc"], [b"abc"], [{1, 2, 3}], [{1: 1, 2: 2, 3: 3}], [None]),
    *([(0, 0, 0), 5], [(0, 0, (1,))], np.zeros(3), np.zeros((2, 2)), np.zeros((2, 3, 3)), np.zeros((2, 3), complex)),
    *(np.zeros((2, 3), bool), np.zeros((2, 3), "M8[s]"), np.array("abc"), np.array(5), np.empty((0, 3))),
    *(np.array([[1, 2, 3], [4, 5]], object), np.full((4, 3), np.nan), np.array([["a"] * 3] * 4)),
    *(np.full((4, 3), np.inf), np.ma.masked_array(np.eye(3), np.eye(3)), np.ma.masked_all((4, 3)), np.zeros(2, "i,i")),
]  # fmt: skip
POINTS = [
    *BAD_POINTS,
    *([*SQUARE[1:], (number, 0, 0)] for number in NUMBERS),
    *(np.ma.masked_array(np.eye(3)), np.zeros((4, 3)), np.eye(3, dtype=np.longdouble) * LARGE),
    *(np.eye(4, 3) * 2.0**1023, np.eye(4, 3) * 5e-324, (row for row in SQUARE), map(iter, SQUARE), SQUARE * 50),
]
ODD = [*BAD_POINTS, *BAD_NUMBERS, hull1620.exact_hull(SQUARE), DECK, PROGRAM, Path("absent"), "absent\0", "a" * 5000]


def use_hull(hull: Any, folder: Path) -> None:
    """Read every attribute of an accepted hull and save it."""
    for name in ("points", "exact_points", "simplices", "equations", "neighbors", "volume", "area", "squared_areas"):
        getattr(hull, name)
    repr(hull)
    for extension in ("off", "json", "svg"):
        try:
            hull.save(folder / f"hull.{extension}", digits=5)
        except hull1620.ExportError:
            assert extension == "svg"


def on_points(name: str, **options: Any) -> tuple[str, Callable[[Any, Path], object], list[Any]]:
    return name, lambda value, folder: use_hull(getattr(hull1620, name)(value, **options), folder), POINTS


def on_options(name: str, *arguments: Any, option: str) -> tuple[str, Callable[[Any, Path], object], list[Any]]:
    function = getattr(hull1620, name)
    return f"{name} {option}", lambda value, folder: function(*arguments, **{option: value}), [*NUMBERS, *BAD_POINTS]


def on_first(name: str, *more: Any) -> tuple[str, Callable[[Any, Path], object], list[Any]]:
    return name, lambda value, folder: getattr(hull1620, name)(value, *more), ODD


CASES = [
    on_points("exact_hull"),
    on_points("convex_hull"),
    on_points("convex_hull", arithmetic="float64", on_refusal="return"),
    on_points("convex_hull", arithmetic="truncating"),
    on_points("convex_hull", arithmetic="mp:200"),
    ("data_deck", lambda value, folder: hull1620.data_deck(value), POINTS),
    ("draw", lambda value, folder: hull1620.draw(value), POINTS),
    on_options("convex_hull", SQUARE, option="epsilon"),
    on_options("convex_hull", SQUARE, option="arithmetic"),
    on_options("convex_hull", SQUARE, option="on_refusal"),
    on_options("data_deck", SQUARE, option="epsilon"),
    on_options("draw", SQUARE, option="eye"),
    on_options("run_hull", DECK, option="options"),
    on_options("run_hull", DECK, option="layers"),
    on_options("read_volume", "ball:2", option="threshold"),
    on_first("numbers"),
    on_first("profile"),
    on_first("load_program"),
    on_first("compile_deck"),
    on_first("translate"),
    on_first("read_deck"),
    on_first("read_points"),
    on_first("read_volume"),
    on_first("read_hull"),
    on_first("run_hull"),
    on_first("diverge", DECK, hull1620.numbers("truncating"), hull1620.numbers("exact")),
    on_first("measure", None),
    ("run_batch", lambda value, folder: hull1620.run_batch(PROGRAM, value), [v for v in ODD if v is not DECK]),
    on_first("voxel_hull"),
    on_first("digital_hull"),
    on_first("run_study", "absent"),
]


@pytest.fixture
def quiet() -> Iterator[None]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


@pytest.mark.parametrize(("name", "function", "values"), CASES, ids=[case[0] for case in CASES])
def test_odd_arguments_raise_a_documented_error_within_a_second(
    name: str, function: Callable[[Any, Path], object], values: list[Any], tmp_path: Path, quiet: None
) -> None:
    # Loading the modules and compiling the engine are not measured.
    if values is POINTS:
        function(SQUARE, tmp_path)
    elif name == "run_batch":
        hull1620.run_batch(PROGRAM, [DECK])
    for value in values:
        start = time.process_time()
        try:
            function(value, tmp_path)
        except EmulatorError as error:
            assert "\n" not in str(error)  # noqa: PT017
        except Exception as error:
            pytest.fail(f"{name} of {value!r:.80} raises {type(error).__name__}: {error!s:.200}")
        assert time.process_time() - start < 1, f"{value!r:.80}"
