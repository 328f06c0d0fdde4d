"""Reading and writing of files: one-line errors, and no partly written file."""

import os
from contextlib import AbstractContextManager
from pathlib import Path
from typing import IO, Any

import pytest

from emulator.errors import FileError
from emulator.files import read_bytes, read_text, write_text, writing, writing_bytes


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("missing", "missing: no such file or directory"),
        (".", ".: is a directory"),
        ("", "a file without a name cannot be read"),
        ("a\0b", "'a\\x00b': not a valid file name"),
        ("x" * 5000, "x" * 5000 + ": file name too long"),
    ],
)
def test_unreadable_file_gives_a_one_line_error(tmp_path: Path, monkeypatch, name: str, message: str) -> None:
    monkeypatch.chdir(tmp_path)
    for read in (read_bytes, read_text):
        with pytest.raises(FileError) as caught:
            read(name)
        assert str(caught.value) == message


def test_caller_can_name_the_file_in_messages() -> None:
    with pytest.raises(FileError, match=r"^a: line 8: no such file or directory$"):
        read_bytes("/nowhere/at all", "a: line 8")


@pytest.mark.parametrize(
    ("data", "place"),
    [
        (b"\xff", "line 1, column 1"),
        (b"OFF\n3 1\n0 0 \xff\n", "line 3, column 5"),
        (b"\xef\xbb\xbfab\xff", "line 1, column 3"),
        ("\u00e9\u00e9\n\u00e9".encode() + b"\x80", "line 2, column 2"),
    ],
)
def test_invalid_utf8_is_reported_with_line_and_column(tmp_path: Path, data: bytes, place: str) -> None:
    path = tmp_path / "a"
    path.write_bytes(data)
    with pytest.raises(FileError) as caught:
        read_text(str(path))
    assert str(caught.value) == f"{path}: {place}: not a text file in UTF-8"


def test_byte_order_mark_is_removed(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"\xef\xbb\xbf1,2\r\n")
    assert read_text(str(tmp_path / "a")) == "1,2\r\n"


def test_write_text(tmp_path: Path, capsys) -> None:
    path = tmp_path / "out.cards"
    write_text(str(path), "A\n")
    write_text(str(path), "B\n")
    assert path.read_bytes() == b"B\n"
    assert os.listdir(tmp_path) == ["out.cards"]
    assert path.stat().st_mode & 0o111 == 0
    write_text("-", "C\n")
    assert capsys.readouterr().out == "C\n"
    write_text(os.devnull, "D\n")


def test_unwritable_file_gives_an_error_and_leaves_nothing(tmp_path: Path) -> None:
    for name in (tmp_path / "no" / "out", tmp_path):
        with pytest.raises(FileError, match=str(name)):
            write_text(str(name), "A\n")
    with pytest.raises(FileError, match="without a name"):
        write_text("", "A\n")
    assert os.listdir(tmp_path) == []


def test_writing_follows_links_and_keeps_the_mode(tmp_path: Path) -> None:
    target, link = tmp_path / "target", tmp_path / "link"
    target.write_text("old")
    target.chmod(0o640)
    link.symlink_to(target)
    write_text(str(link), "new")
    assert link.is_symlink()
    assert target.read_text() == "new"
    assert target.stat().st_mode & 0o777 == 0o640


def test_failed_write_leaves_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"old")
    with pytest.raises(KeyError):
        _interrupt(writing(str(path)), "new")
    with pytest.raises(KeyError):
        _interrupt(writing_bytes(str(path)), b"new")
    assert path.read_bytes() == b"old"
    assert os.listdir(tmp_path) == ["a"]


def _interrupt(writer: AbstractContextManager[IO[Any]], part: str | bytes) -> None:
    with writer as file:
        file.write(part)
        raise KeyError
