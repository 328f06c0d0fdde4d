"""Damage files at random in fifty ways that depend on the seed: bytes, tokens, lines, numbers, ends.

``codes_of`` runs a command on many such files and checks that it ends with a result or with one line and exit code 2.
"""

import io
import os
import random
import re
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from tests.support.commands import call

WAYS = 50
FILES = int(os.environ.get("HULL1620_FUZZ", "3"))
"""The number of files for each reader that are damaged."""
Make = Callable[[random.Random], bytes]

_WORDS = (
    *(b"nan", b"inf", b"-inf", b"-0", b"1e999", b"1e-999", b"1e99999", b"9" * 400, b"0x10", b"1/3", b"1/0", b"", b"-1"),
    *(b"0", b"99999999999", b"2147483648", b"18446744073709551616", b".", b"-", b"+", b"1.5", b"true", b"null"),
    *(b"\xff\xfe", "é".encode(), "٣".encode(), b"\0", b"#", b'"', b"{", b"[" * 3000, b"'", b"\\", b"a" * 5000),
    *(b"OFF", b"v", b"solid"),
)
_PIECES = (b"\0", b"\r", b"\n", b"\r\n", b"\xff", b"\xef\xbb\xbf", b" ", b"\t", b",", b";", b'"', b"\x1a", b"\x93NUMPY")


def damaged(data: bytes, way: int, seed: str) -> bytes:
    """Return the data with one to three mutations, which ``way`` (below ``WAYS``) and ``seed`` determine."""
    draw = random.Random(f"{seed}:{way}")
    for _ in range(1 + way % 3):
        data = _MUTATIONS[(way + draw.randrange(2)) % len(_MUTATIONS)](data, draw)
    return data


def _place(data: bytes, draw: random.Random) -> int:
    return draw.randrange(len(data) + 1)


def _flip(data: bytes, draw: random.Random) -> bytes:
    if not data:
        return data
    at = draw.randrange(len(data))
    return data[:at] + bytes([data[at] ^ 1 << draw.randrange(8)]) + data[at + 1 :]


def _byte(data: bytes, draw: random.Random) -> bytes:
    at = _place(data, draw)
    return data[:at] + bytes([draw.randrange(256)]) + data[at + 1 :]


def _cut(data: bytes, draw: random.Random) -> bytes:
    return data[: _place(data, draw)]


def _beheaded(data: bytes, draw: random.Random) -> bytes:
    return data[_place(data, draw) :]


def _without(data: bytes, draw: random.Random) -> bytes:
    first, last = sorted((_place(data, draw), _place(data, draw)))
    return data[:first] + data[last:]


def _twice(data: bytes, draw: random.Random) -> bytes:
    first, last = sorted((_place(data, draw), _place(data, draw)))
    return data[:last] + data[first:last][:2000] + data[last:]


def _piece(data: bytes, draw: random.Random) -> bytes:
    at = _place(data, draw)
    return data[:at] + draw.choice(_PIECES) + data[at:]


def _word(data: bytes, draw: random.Random) -> bytes:
    matches = list(re.finditer(rb"[^\s,;]+", data))
    if not matches:
        return draw.choice(_WORDS)
    match = draw.choice(matches)
    return data[: match.start()] + draw.choice(_WORDS) + data[match.end() :]


def _number(data: bytes, draw: random.Random) -> bytes:
    matches = list(re.finditer(rb"\d+", data))
    if not matches:
        return data + b"7"
    match = draw.choice(matches)
    value = draw.choice((int(match[0][:50]) + 1, max(0, int(match[0][:50]) - 1), 10**9, 2**31, 2**63, 0, 7))
    return data[: match.start()] + str(value).encode() + data[match.end() :]


def _line(data: bytes, draw: random.Random) -> bytes:
    lines = data.split(b"\n")
    at, other = draw.randrange(len(lines)), draw.randrange(len(lines))
    change = draw.randrange(3)
    if change == 0:
        del lines[at]
    elif change == 1:
        lines.insert(at, lines[other])
    else:
        lines[at], lines[other] = lines[other], lines[at]
    return b"\n".join(lines)


_MUTATIONS = (_flip, _byte, _cut, _beheaded, _without, _twice, _piece, _word, _number, _line)


def codes_of(
    name: str, path: str, make: Make, words: Sequence[str], folder: Path, capsys, files: int = FILES
) -> set[int]:
    """Return the exit codes of a command for damaged files, in ``folder``, which is the current one.

    Raise AssertionError if no intact file is accepted, for a traceback, for an exit code other than 0, 1 and 2, for an
    error of more than one line (except from ``check``, which lists its findings), and for any other file in the folder.
    """
    codes, intact_codes = set(), set()
    for number in range(files):
        whole = make(random.Random(f"{name}:{number}"))
        Path(path).write_bytes(whole)
        intact_codes.add(call(capsys, *words)[0])
        for way in range(WAYS):
            for remaining in folder.iterdir():
                remaining.unlink()
            data = damaged(whole, way, f"{name}:{number}")
            Path(path).write_bytes(data)
            try:
                code, _, err = call(capsys, *words)
            except BaseException as error:
                raise AssertionError(f"file {number}, way {way}: {type(error).__name__}: {data[:200]!r}") from error
            codes.add(code)
            other_files = {file.name for file in folder.iterdir()} - {path}
            assert code in (0, 1, 2), (number, way)
            assert "Traceback" not in err
            if code == 2 and words[0] != "check":
                assert (err.count("\n"), err.startswith("hull1620: "), other_files) == (1, True, set()), (
                    number,
                    way,
                    err,
                )
    assert intact_codes - {2}, "every intact file is rejected"
    return codes | intact_codes


def saved(array: np.ndarray) -> bytes:
    """Return an array as the bytes of an NPY file."""
    file = io.BytesIO()
    np.save(file, array)
    return file.getvalue()


def solid(draw: random.Random) -> np.ndarray:
    """Return a few voxels of one of three number types, the first one set."""
    shape = tuple(draw.randrange(2, 5) for _ in range(3))
    array = np.array([draw.random() < 0.6 for _ in range(shape[0] * shape[1] * shape[2])]).reshape(shape)
    array[0, 0, 0] = True
    return array.astype(draw.choice((np.uint8, np.int16, np.float32)))
