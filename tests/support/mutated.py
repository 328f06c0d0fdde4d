"""Files damaged at random, each in one of fifty ways that the seed chooses: bytes, words, lines, numbers, ends."""

from __future__ import annotations

import random
import re

WAYS = 50

_WORDS = (
    *(b"nan", b"inf", b"-inf", b"-0", b"1e999", b"1e-999", b"1e99999", b"9" * 400, b"0x10", b"1/3", b"1/0", b"", b"-1"),
    *(b"0", b"99999999999", b"2147483648", b"18446744073709551616", b".", b"-", b"+", b"1.5", b"true", b"null"),
    *(b"\xff\xfe", "é".encode(), "٣".encode(), b"\0", b"#", b'"', b"{", b"[" * 3000, b"'", b"\\", b"a" * 5000),
    *(b"OFF", b"v", b"solid"),
)
_PIECES = (b"\0", b"\r", b"\n", b"\r\n", b"\xff", b"\xef\xbb\xbf", b" ", b"\t", b",", b";", b'"', b"\x1a", b"\x93NUMPY")


def damaged(data: bytes, way: int, seed: str) -> bytes:
    """The file with one to three mutations; ``way`` is below ``WAYS``, and the same seed gives the same bytes."""
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
    found = list(re.finditer(rb"[^\s,;]+", data))
    if not found:
        return draw.choice(_WORDS)
    match = draw.choice(found)
    return data[: match.start()] + draw.choice(_WORDS) + data[match.end() :]


def _number(data: bytes, draw: random.Random) -> bytes:
    found = list(re.finditer(rb"\d+", data))
    if not found:
        return data + b"7"
    match = draw.choice(found)
    value = draw.choice((int(match[0][:50]) + 1, max(0, int(match[0][:50]) - 1), 10**9, 2**31, 2**63, 0, 7))
    return data[: match.start()] + str(value).encode() + data[match.end() :]


def _line(data: bytes, draw: random.Random) -> bytes:
    lines = data.split(b"\n")
    at, other = draw.randrange(len(lines)), draw.randrange(len(lines))
    what = draw.randrange(3)
    if what == 0:
        del lines[at]
    elif what == 1:
        lines.insert(at, lines[other])
    else:
        lines[at], lines[other] = lines[other], lines[at]
    return b"\n".join(lines)


_MUTATIONS = (_flip, _byte, _cut, _beheaded, _without, _twice, _piece, _word, _number, _line)
