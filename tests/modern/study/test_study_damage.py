"""Damage in the folder of a study: rows are compared with their checksums, and the index is made again."""

import random
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from emulator.files import UNFINISHED
from modern.cli.main import main
from modern.study import run_study
from modern.study.index import NAME as INDEX
from modern.study.store import Store, StudyFileError
from tests.support.studied import PLAN, contents


@pytest.mark.usefixtures("_without_plots")
def test_chunk_written_but_not_yet_indexed_is_counted_once(finished: Path, copied: Path) -> None:
    """Every third chunk lacks its index entries; another chunk's file is half written."""
    chunks = list(PLAN.chunks())
    for chunk in chunks[::3]:
        with sqlite3.connect(copied / INDEX) as index:
            for table in ("samples", "runs"):
                index.execute(
                    f"DELETE FROM {table} WHERE cell = ? AND place BETWEEN ? AND ?",
                    (chunk.cell, chunk.start, chunk.stop - 1),
                )
    (copied / "rows" / chunks[1].name).unlink()
    (copied / "rows" / f"{UNFINISHED}{chunks[1].name}").write_text("half a li")
    run_study(PLAN, copied, workers=1, quiet=True, resume=True)
    assert contents(copied) == contents(finished)


@pytest.mark.parametrize("damage", ["absent", "text", "truncated", "zeros"])
@pytest.mark.usefixtures("_without_plots")
def test_damaged_index_is_rebuilt(finished: Path, copied: Path, damage: str) -> None:
    index = copied / INDEX
    intact = index.read_bytes()
    if damage == "absent":
        index.unlink()
    else:
        damaged = {"text": b"this is no database" * 99, "truncated": intact[: len(intact) // 2]}
        index.write_bytes(damaged.get(damage, bytes(len(intact))))
    run_study(PLAN, copied, workers=1, quiet=True, resume=True)
    assert contents(copied) == contents(finished)


def test_file_of_rows_that_is_not_of_the_plan_is_named(copied: Path) -> None:
    (copied / "rows/0009-000000000.jsonl").write_text("{}\n")
    with pytest.raises(StudyFileError, match=r"0009-000000000.jsonl is not a file of rows of this study"):
        run_study(PLAN, copied, workers=1, quiet=True, resume=True)


def test_digit_changed_in_100_places_of_the_rows_is_always_noticed_with_file_and_line(finished, copied, capsys) -> None:
    rng = random.Random(1963)
    files = sorted((copied / "rows").iterdir())
    assert main(["study", "--verify", str(copied)]) == 0
    assert capsys.readouterr().out == f"{copied}: 44 of 44 rows are present and match their checksums\n"
    with closing(Store.open(copied, PLAN)) as store:
        for _ in range(100):
            path = rng.choice(files)
            intact = path.read_bytes()
            place = rng.choice([place for place, byte in enumerate(intact) if chr(byte).isdigit()])
            digit = rng.choice([digit for digit in b"0123456789" if digit != intact[place]])
            path.write_bytes(intact[:place] + bytes([digit]) + intact[place + 1 :])
            line = intact.count(b"\n", 0, place) + 1
            _, (message,) = store.verify()
            assert message.startswith(f"{path}: line {line} (sample "), message
            assert "is damaged; delete the file, and --resume computes it again" in message
            with pytest.raises(StudyFileError) as rejection:
                store.missing()
            assert str(rejection.value) == message
            path.write_bytes(intact)


def test_verify_reports_every_damaged_file_and_resume_stops(finished: Path, copied: Path, capsys) -> None:
    paths = [copied / "rows" / name for name in ("0000-000000007.jsonl", "0001-000000004.jsonl")]
    for path in paths:
        path.write_text(path.read_text().replace('"seed":"', '"seed":"0', 1))
    assert main(["study", "--verify", str(copied)]) == 2
    out, err = capsys.readouterr()
    assert out == f"{copied}: 35 of 44 rows are present and match their checksums\n"
    assert err.splitlines() == [
        f"hull1620: {path}: line 1 (sample {sample}) is damaged; delete the file, and --resume computes it again"
        for path, sample in zip(paths, (7, 4), strict=True)
    ]
    with pytest.raises(StudyFileError, match=r"0000-000000007.jsonl: line 1 \(sample 7\) is damaged"):
        run_study(PLAN, copied, workers=1, quiet=True, resume=True)
    paths[0].unlink()
    paths[1].write_bytes((finished / "rows" / paths[1].name).read_bytes())
    assert main(["study", "--verify", str(copied)]) == 2
    assert "5 rows are missing; --resume computes them" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ('"decks_sha256": "', '"decks_sha256": "0', "decks_sha256 is not the SHA-256 of the decks in the rows"),
        ('"cells": [', '"cells": 5, "other": [', "the plan in the manifest is damaged"),
        ('"family": "integers"', '"family": "ball"', "the plan in the manifest is damaged"),
    ],
)
def test_verify_reports_a_damaged_manifest(before, after, message, finished, copied, capsys) -> None:
    path = copied / "manifest.json"
    text = path.read_text()
    assert before in text
    path.write_text(text.replace(before, after, 1))
    assert main(["study", "--verify", str(copied)]) == 2
    assert capsys.readouterr().err == f"hull1620: {path}: {message}\n"


@pytest.mark.parametrize("damage", ["empty", "short", "truncated", "noise", "different", "long", "list"])
@pytest.mark.usefixtures("_without_plots")
def test_damaged_file_of_rows_is_named_and_not_counted(finished: Path, copied: Path, damage: str) -> None:
    path = copied / "rows/0000-000000007.jsonl"
    intact = path.read_bytes()
    lines = intact.splitlines(keepends=True)
    path.write_bytes(
        {
            "empty": b"",
            "short": b"".join(lines[:-1]),
            "truncated": intact[:-9],
            "noise": b"\xff\x00" * 400,
            "different": (copied / "rows/0000-000000012.jsonl").read_bytes(),
            "long": intact + lines[0],
            "list": b"[1]\n" * 5,
        }[damage]
    )
    for index in copied.glob(f"{INDEX}*"):
        index.unlink()
    with pytest.raises(StudyFileError, match=r"0000-000000007.jsonl: line \d.* is damaged") as rejection:
        run_study(PLAN, copied, workers=1, quiet=True, resume=True)
    assert "\n" not in str(rejection.value)
    path.unlink()
    run_study(PLAN, copied, workers=1, quiet=True, resume=True)
    assert contents(copied) == contents(finished)
