"""The command line: exit codes, one-line messages, pipes, and files written completely."""

import importlib
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from modern.cli import main
from modern.cli.arguments import COMMANDS
from tests.support.commands import DECK, call
from tests.support.paths import MACHINE_RUNS


def points(n: str, *cards: str) -> str:
    return "\n".join((n, *cards)) + "\n"


GOOD_POINT = "+.10000000E+01+.20000000E+01+.30000000E+01"

# name, contents of the file, arguments, part of the message
BAD_DECKS = [
    ("empty", "", "the deck is empty"),
    ("blank", "\n\n", "only blank cards"),
    (
        "no-number",
        points("XX", GOOD_POINT),
        ("card 1, column 1: the number of points, in columns 1-2, is 'XX', which is not a number"),
    ),
    ("zero", points(" 0", GOOD_POINT), "card 1, column 1: N is 0"),
    ("negative", points("-3", GOOD_POINT), "card 1, column 1: N is -3"),
    ("too-many", points("52", GOOD_POINT), "card 1, column 1: N is 52; the programs accept 1 to 51"),
    ("blank-n", points("  .", GOOD_POINT).replace(".", ""), "the number of points, in columns 1-2, is blank"),
    ("too-few", points(" 3", GOOD_POINT, GOOD_POINT), "card 3, column 1: the deck ends after 2 of 3 points"),
    (
        "no-coordinate",
        points(" 1", "+.10000000E+01  1.2.3       +.30000000E+01"),
        "card 2, column 15: y: '1.2.3' is no",
    ),
    ("lower-case", points(" 1", GOOD_POINT.replace("E", "e")), "card 2, column 11: 'e' is not in the card code"),
    ("strange", points(" 1", GOOD_POINT + " %"), "card 2, column 44: write '(' for '%', the character of a commercial"),
    ("tab", points(" 1", "\t1."), "card 2, column 1: character 0x09"),
    ("utf-8", points(" 1", "é"), "card 2, column 1: 'é' is not in the card code"),
    ("too-wide", points(" 1", GOOD_POINT + " " * 40 + "X"), "card 2, column 81: a card has 80 columns"),
    ("range", points(" 1", "9.E+99        0.            0."), "card 2, column 1: x: '9.E+99' is out of range"),
    ("second-set", points(" 1", GOOD_POINT, " 2", GOOD_POINT), "card 4, column 1: the deck ends after 1 of 2 points"),
]


@pytest.mark.parametrize(("text", "words"), [b[1:] for b in BAD_DECKS], ids=[b[0] for b in BAD_DECKS])
def test_an_invalid_deck_is_rejected(room: Path, capsys, text: str, words: str) -> None:
    Path("bad.deck").write_text(text, encoding="utf-8")
    code, out, err = call(capsys, "hull", "bad.deck")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert err.startswith("hull1620: bad.deck")
    assert words in err


BAD_SOURCES = [
    ("empty", "", "the deck is empty"),
    ("comment-only", "C  NOTHING\n", "the source deck has no statement"),
    ("no-statement", "      HELLO\n      END\n", "card 1, column 7: error: not a statement"),
    ("undefined-number", "      GO TO 7\n      END\n", "card 1, column 7: error: there is no statement number 7"),
    ("missing-format", "      READ 5,X\n      END\n", "card 1, column 7: error 13: there is no FORMAT number 5"),
    ("mixed", "      X=A*I\n      END\n", "card 1, column 11: error 5: fixed and floating point are mixed"),
    ("to-format", "      GO TO 1\n    1 FORMAT (I2)\n      END\n", "error: statement 1 is a FORMAT"),
    ("long-name", "      VERTEX=1.\n      END\n", "error 6: the name VERTEX"),
    ("hash", "      I1#1\n      END\n", "card 1, column 9: write '=' for '#', the character of a commercial"),
    ("wide", " " * 85 + "X\n", "card 1, column 81"),
]


@pytest.mark.parametrize(("text", "words"), [b[1:] for b in BAD_SOURCES], ids=[b[0] for b in BAD_SOURCES])
@pytest.mark.parametrize("command", ["run", "compile", "map"])
def test_an_invalid_program_is_rejected(room: Path, capsys, command: str, text: str, words: str) -> None:
    Path("bad.f").write_text(text, encoding="utf-8")
    code, out, err = call(capsys, command, "bad.f")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert words in err


MISUSE = [
    (["run", "nosuch.f"], "nosuch.f: no such file or directory"),
    (["run", "."], ".: is a directory"),
    (["hull", "."], ".: is a directory"),
    (["hull", "nosuch"], "nosuch: no such file"),
    (["run", "good.f", "x.deck", "--arithmetic", "decimal"], "no arithmetic is called 'decimal'"),
    (["run", "good.f", "x.deck", "--arithmetic", "truncating:1"], "the number of digits must be 2 to 28"),
    (["run", "good.f", "x.deck", "--limit", "0"], "--limit: expected at least 1 statement, found 0"),
    (["run", "good.f", "x.deck", "--limit", "many"], "argument --limit: invalid int value"),
    (["run", "good.f", "x.deck", "--switch", "5"], "argument --switch: invalid choice: 5"),
    (["run", "good.f", "x.deck", "--punch", "nosuch/file"], "nosuch/file: no such file or directory"),
    (["run", "good.f", "x.deck", "--trace", "."], ".: is a directory"),
    (["run", "good.f", "x.deck", "--layers", "lacuna"], "--layers is for the built-in programs"),
    (["run", "program1", "good.deck", "--layers", "nosuch"], "has no layer 'nosuch'"),
    (["hull", "good.deck", "--layers", "nosuch"], "no program has a layer 'nosuch'; the layers are corrected, "),
    (["hull", "good.deck", "--core", "20000"], "OVERLAP"),
    (["run", "-", "-"], "cannot both come from standard input"),
    (["run", "program1"], "the hopper is empty at the first READ"),
    (["reproduce", "7"], "unknown name '7'"),
    (["apparatus", "--layer", "nosuch"], "unknown layer 'nosuch'"),
    (["apparatus", "--program", "4"], "'4' is not one of the programs 1, 2 and 3"),
    (["apparatus", "--weigh", "new", "--most", "-5"], "--most: expected at least 0, found -5"),
    (["apparatus", "--restore", "new", "--workers", "0"], "--workers: expected at least 1, found 0"),
    (["apparatus", "--most", "5"], "--most needs --weigh or --restore"),
    (["apparatus", "--weigh", "new", "--check"], "--weigh and --check cannot be combined; choose one"),
    (["apparatus", "--weigh", "new", "--program", "1"], "--program and --layer cannot be combined with --weigh"),
    (["cards", "nosuch.csv"], "nosuch.csv: no such file"),
    (["nosuch"], "invalid choice: 'nosuch'"),
    ([], "the following arguments are required: COMMAND"),
]


@pytest.mark.parametrize(("arguments", "words"), MISUSE, ids=[" ".join(m[0]) or "nothing" for m in MISUSE])
def test_misuse(room: Path, capsys, arguments: list[str], words: str) -> None:
    before = sorted(os.listdir())
    code, out, err = call(capsys, *arguments)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert words in err
    assert sorted(os.listdir()) == before


def test_hull_writes_cards_lines_and_a_profile_to_their_streams(room: Path, capsys) -> None:
    code, out, err = call(capsys, "hull", "good.deck")
    assert code == 0
    assert "CONVEX HULL HAS BEEN DETERMINED" in out
    assert err == "POINTS ARE NOT COPLANAR\n"
    code, _, err = call(capsys, "hull", "good.deck", "--profile")
    assert code == 0
    assert "time on a 1620 Model 1" in err
    assert all(len(line) <= 80 for line in err.splitlines())


def test_line_ends_blank_fields_and_repeated_points_are_accepted_with_a_warning(room: Path, capsys) -> None:
    Path("crlf.deck").write_bytes(DECK.replace("\n", "\r\n").rstrip().encode())
    assert call(capsys, "hull", "crlf.deck")[0] == 0
    Path("blank.deck").write_text(DECK.replace("+.00000000E+00", " " * 14), encoding="utf-8")
    code, _, err = call(capsys, "hull", "blank.deck")
    assert code == 0
    assert "warning: blank.deck: card 2, column 1: x: a blank field is read as zero" in err
    Path("twice.deck").write_text(DECK.replace(" 4", " 5") + "1.0           -.0           .0\n", encoding="utf-8")
    _, _, err = call(capsys, "hull", "twice.deck")
    assert "warning: twice.deck: card 6, column 1: the same point as on card 3" in err


def test_a_run_ends_at_the_empty_hopper_or_an_invalid_field(room: Path, capsys) -> None:
    assert call(capsys, "run", "good.f", "x.deck") == (
        0,
        " .20000000E+01\n .30000000E+01\n",
        "note: good.f: the run ended after reading 2 cards, because the hopper was empty at the READ of statement 1 "
        "(card 1)\n",
    )
    # Any READ of ``run`` may find the hopper empty. ``hull`` requires complete data sets.
    Path("short.deck").write_text(" 3\n" + GOOD_POINT + "\n", encoding="utf-8")
    assert call(capsys, "run", "program1", "short.deck")[:2] == (0, "")
    code, out, err = call(capsys, "hull", "short.deck")
    assert (code, out) == (2, "")
    assert "short.deck: card 2, column 1: the deck ends after 1 of 3 points" in err
    Path("bad.deck").write_text("2.\nABC\n", encoding="utf-8")
    assert call(capsys, "run", "good.f", "bad.deck")[::2] == (
        2,
        "hull1620: bad.deck: card 2, column 1: 'ABC' is not a number\n",
    )


@pytest.mark.parametrize(("run", "typed"), [("04_cube8", "ERROR IN PROGRAM"), ("18_dec3_n6", "DATA NOT ACCEPTABLE")])
def test_a_refusal_gives_exit_code_1(capsys, run: str, typed: str) -> None:
    deck = MACHINE_RUNS / run / "deck.cards"
    code, _, err = call(capsys, "hull", str(deck))
    assert code == 1
    assert typed in err


def test_switch_1_and_the_limit_determine_how_long_a_run_continues(capsys) -> None:
    # KNOWN-FAULTS 10.
    deck = MACHINE_RUNS / "18_dec3_n6" / "deck.cards"
    off = call(capsys, "hull", str(deck))
    on = call(capsys, "hull", str(deck), "--switch", "1", "--limit", "100000")
    assert off[2].count("DATA NOT ACCEPTABLE") == 1
    assert on[2].count("DATA NOT ACCEPTABLE") > 1
    deck = MACHINE_RUNS / "39_prism_n10" / "deck.cards"
    code, out, err = call(capsys, "hull", str(deck), "--limit", "100000")
    assert code == 1
    assert "program3.f: stopped after 100000 statements; the last statements form a loop on cards" in err
    assert "CONVEX HULL" in out


def test_reproduce_as_json(room: Path, capsys) -> None:
    code, _, _ = call(capsys, "reproduce", "3", "--json", "v.json")
    document = json.loads(Path("v.json").read_text(encoding="utf-8"))
    assert code == 0
    assert document["reproduced"] is True
    assert {r["verdict"] for r in document["results"]} == {"exact"}
    code, out, _ = call(capsys, "reproduce", "3", "--json", "-")
    assert json.loads(out) == document


def test_reproduce_and_apparatus_print_plain_text(capsys) -> None:
    code, out, _ = call(capsys, "reproduce", "5")
    assert code == 0
    assert "\x1b" not in out
    assert "exact in another order" in out
    assert "Every printed result is reproduced." in out
    code, out, _ = call(capsys, "apparatus", "--program", "1", "--layer", "lacuna")
    assert code == 0
    assert out.splitlines()[-1] == "2 rows"
    assert "INN=0" in out


def test_reproduce_shows_the_cards_that_differ(monkeypatch, capsys) -> None:
    from modern.edition import programs, reproduce

    other = programs.deck("program1_examples").text().replace("E(LL)=2.", "E(LL)=5.")
    from emulator.language.cards import deck_from_text
    from emulator.language.compiler import compile_deck

    changed = compile_deck(deck_from_text("p", other))
    kept = programs.program
    monkeypatch.setattr(
        "modern.cli.reproduce.reproduce",
        lambda examples: reproduce.reproduce(examples, lambda n: changed if n == "program1_examples" else kept(n)),
    )
    code, out, _ = call(capsys, "reproduce", "5")
    assert code == 1
    assert "printed" in out
    assert "NOT every printed result is reproduced." in out


def test_check_names_card_and_column(room: Path, capsys) -> None:
    Path("bad.f").write_text("      A=B+\n      GO TO 3\n      END\n", encoding="utf-8")
    code, out, err = call(capsys, "check", "bad.f")
    assert (code, err) == (2, "")
    lines = out.splitlines()
    assert lines[0].startswith("bad.f: card 1, column 10: error:")
    assert lines[2].index("^") - 4 == 9
    assert call(capsys, "check", "program3")[0] == 0


def test_map_and_compile_print_tables(capsys) -> None:
    code, out, _ = call(capsys, "map", "program3")
    assert code == 0
    assert "X(51)" in out
    assert "39879" in out
    code, out, _ = call(capsys, "compile", "program2")
    assert code == 0
    assert "RSGN" in out


def test_points_become_cards_and_are_truncated_on_request(room: Path, capsys) -> None:
    Path("p.csv").write_text("x,y,z\n1,-2.5,3e-2\n\n0,.125,-0\n", encoding="utf-8")
    code, out, err = call(capsys, "cards", "p.csv")
    assert (code, err) == (0, "")
    assert out == (" 2\n+.10000000E+01-.25000000E+01+.30000000E-01\n+.00000000E+00+.12500000E+00-.00000000E+00\n")
    assert call(capsys, "cards", "p.csv", "-o", "p.deck")[:2] == (0, "")
    assert Path("p.deck").read_text(encoding="utf-8") == out
    Path("p.csv").write_text("1,2,-1234.56789\n", encoding="utf-8")
    assert "-.12345678E+04" in call(capsys, "cards", "p.csv", "--truncate")[1]


CSV_FAULTS = [
    ("1,2\n", "line 1, column 1: expected a point x,y,z, found 2 fields"),
    ("1,2,x\n", "line 1, field 3: 'x' is not a decimal number"),
    ("1,2,123456789\n", "line 1, field 3: 9 significant digits"),
    ("1,2,1e100\n", "line 1, field 3: out of range"),
    ("", "there are no points"),
    ("1,2,3\n" * 100, "100 points"),
    ("nan,inf,3\n", "line 1, field 1: 'nan' is not a decimal number"),
]


@pytest.mark.parametrize(("text", "words"), CSV_FAULTS)
def test_cards_rejects_points_that_no_card_holds(room: Path, capsys, text: str, words: str) -> None:
    Path("p.csv").write_text(text, encoding="utf-8")
    code, out, err = call(capsys, "cards", "p.csv", "-o", "p.deck")
    assert (code, out) == (2, "")
    assert words in err
    assert not Path("p.deck").exists()


def test_help_imports_nothing_that_only_a_run_needs() -> None:
    # Help needs only the errors and the names of the formats from this project.
    code = f"""
import sys, emulator, modern
from modern.cli.main import main
for words in ([], *([name] for name in {list(COMMANDS)})):
    try:
        main([*words, "--help"])
    except SystemExit as left:
        assert left.code == 0, words
    own = {{name for name in sys.modules if name.startswith(("emulator.", "modern.")) and ".cli" not in name}}
    assert not {{"numpy", "lark", "mpmath"}} & set(sys.modules), words
    assert own == {{"emulator.errors", "modern.formats"}}, (words, own)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("usage: hull1620") == len(COMMANDS) + 1


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_has_a_module_with_a_main_and_an_entry_in_the_arguments(name: str) -> None:
    module = importlib.import_module(f"modern.cli.{name.replace('-', '_')}")
    assert callable(module.main)
    assert not hasattr(module, "arguments")


def test_every_module_is_a_command_or_serves_several() -> None:
    modules = {path.stem for path in Path(main.__file__).parent.glob("*.py")}
    assert modules == {name.replace("-", "_") for name in COMMANDS} | {"__init__", "main", "arguments"}
