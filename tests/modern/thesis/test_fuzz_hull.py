"""Random decks for ``hull1620 hull``, which never end in a traceback."""

import contextlib
import io
import tempfile
from pathlib import Path

from hypothesis import given, settings
from hypothesis import strategies as st

from emulator.language.cards import CHARACTERS
from modern.cli.main import main
from modern.formats.deck import coordinate_field

coordinate = st.one_of(
    st.integers(-9, 9).map(str),
    st.integers(-9999, 9999).map(str),
    st.tuples(st.integers(-(10**8) + 1, 10**8 - 1), st.integers(-90, 80)).map(lambda t: f"{t[0]}e{t[1]}"),
)
point = st.tuples(coordinate, coordinate, coordinate)
card_text = st.text(st.sampled_from(sorted(CHARACTERS)), max_size=80)


def run(text: str, *options: str) -> tuple[int, str]:
    """Return the exit code and the standard error of ``hull`` for a deck."""
    with tempfile.TemporaryDirectory() as room:
        path = Path(room) / "d"
        path.write_text(text, encoding="utf-8")
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main(["hull", str(path), "--limit", "200000", *options])
        return code, err.getvalue()


@settings(deadline=None, max_examples=40)
@given(
    st.lists(point, min_size=1, max_size=14),
    st.sampled_from(["strict", "core"]),
    st.sampled_from(["listing", "examples"]),
)
def test_any_points_end_with_exit_code_0_or_1(points: list[tuple[str, str, str]], bounds: str, programs: str) -> None:
    cards = ["".join(coordinate_field(x) for x in p) for p in points]
    code, err = run("\n".join([f"{len(points):2d}", *cards]), "--bounds", bounds, "--programs", programs)
    assert code in (0, 1), err


@settings(deadline=None, max_examples=40)
@given(st.lists(card_text, max_size=6))
def test_any_cards_end_with_an_exit_code_and_one_line(cards: list[str]) -> None:
    code, err = run("\n".join(cards))
    assert code in (0, 1, 2)
    if code == 2:
        assert err.count("\n") == 1
        assert err.startswith("hull1620: ")
