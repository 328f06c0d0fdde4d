"""Check every element of a DICOM file for damage, and check the length of the pixel data (PS3.5 and PS3.10).

If a file is truncated near its beginning, SimpleITK silently omits it from the series. Pixel data in a compressed
transfer syntax have no checksum and are rejected.
"""

import os
import struct
from dataclasses import dataclass, field
from typing import BinaryIO

from emulator.errors import quoted
from modern.digital.integrity.streams import check_length, check_sizes
from modern.digital.solids import VolumeError

# A DICOM file has these bytes, its signature, at this position.
SIGNATURE = (128, b"DICM")
# Types of values, first those with two reserved bytes and a four-byte length, then those with a two-byte length.
_LONG = frozenset({b"OB", b"OD", b"OF", b"OL", b"OV", b"OW", b"SQ", b"SV", b"UC", b"UN", b"UR", b"UT", b"UV"})
_SHORT = frozenset(
    {b"AE", b"AS", b"AT", b"CS", b"DA", b"DS", b"DT", b"FD", b"FL", b"IS", b"LO", b"LT", b"PN", b"SH", b"SL", b"SS"}
    | {b"ST", b"TM", b"UI", b"UL", b"US"}
)
_IMPLICIT, _EXPLICIT, _BIG_ENDIAN = "1.2.840.10008.1.2", "1.2.840.10008.1.2.1", "1.2.840.10008.1.2.2"
_CLASS, _SYNTAX = (0x0002, 0x0002), (0x0002, 0x0010)
_SAMPLES, _FRAMES, _ROWS, _COLUMNS, _BITS = ((0x0028, number) for number in (0x02, 0x08, 0x10, 0x11, 0x100))
_PIXELS = (0x7FE0, 0x0010)
_ITEM, _ITEM_END, _SEQUENCE_END = ((0xFFFE, number) for number in (0xE000, 0xE00D, 0xE0DD))
_KEPT = {_CLASS, _SYNTAX, _SAMPLES, _FRAMES, _ROWS, _COLUMNS, _BITS}
_UNDEFINED = 0xFFFFFFFF
_DEEPEST = 32


class Unverifiable(VolumeError):
    """Raised for pixel data that are compressed without a checksum, because damage to them could not be noticed."""


@dataclass(slots=True)
class _Elements:
    file: BinaryIO
    path: str
    size: int
    order: str = "<"
    is_implicit: bool = False
    values: dict[tuple[int, int], bytes] = field(default_factory=dict)
    pixels: int | None = None

    def read(self, count: int) -> bytes:
        self._check(count)
        return self.file.read(count)

    def skip(self, count: int) -> None:
        self._check(count)
        self.file.seek(count, os.SEEK_CUR)

    def _check(self, count: int) -> None:
        position = self.file.tell()
        available = self.size - position
        if count > available:
            message = f"expected {count} bytes at byte {position}, found {available}"
            raise VolumeError(f"{self.path}: damaged or truncated: {message}")

    def tag(self) -> tuple[int, int]:
        group, element = struct.unpack(f"{self.order}2H", self.read(4))
        return group, element

    def length(self, tag: tuple[int, int]) -> tuple[bytes, int]:
        """Read the type and the length of the next value."""
        if self.is_implicit or tag[0] == 0xFFFE:
            return b"", struct.unpack(f"{self.order}I", self.read(4))[0]
        kind = self.read(2)
        if kind in _SHORT:
            return kind, struct.unpack(f"{self.order}H", self.read(2))[0]
        if kind not in _LONG:
            raise VolumeError(f"{self.path}: damaged: invalid element at byte {self.file.tell() - 6}")
        return kind, struct.unpack(f"{self.order}2xI", self.read(6))[0]

    def read_set(self, end: int | None, depth: int = 0) -> None:
        """Read the elements up to position ``end``, or up to the end of the current item if ``end`` is None."""
        if depth > _DEEPEST:
            raise VolumeError(f"{self.path}: damaged: sequences are nested more than {_DEEPEST} times")
        while end is None or self.file.tell() < end:
            tag = self.tag()
            if tag == _ITEM_END and end is None:
                self.skip(4)
                return
            kind, length = self.length(tag)
            if depth == 0 and tag == _PIXELS:
                self.pixels = length
            if length == _UNDEFINED or kind == b"SQ":
                self.read_items(length, depth, tag, kind)
            elif depth == 0 and tag in _KEPT:
                self.values[tag] = self.read(length)
            else:
                self.skip(length)
            if end is not None and self.file.tell() > end:
                raise VolumeError(f"{self.path}: damaged: an element is longer than its item")

    def read_items(self, length: int, depth: int, parent: tuple[int, int], kind: bytes) -> None:
        end = None if length == _UNDEFINED else self.file.tell() + length
        was_implicit, self.is_implicit = self.is_implicit, self.is_implicit or kind == b"UN"
        while end is None or self.file.tell() < end:
            tag = self.tag()
            item = self.length(tag)[1]
            if tag == _SEQUENCE_END and end is None:
                break
            if tag != _ITEM:
                raise VolumeError(f"{self.path}: damaged: expected an item at byte {self.file.tell() - 8}")
            if parent == _PIXELS:
                self.skip(item)
            else:
                self.read_set(None if item == _UNDEFINED else self.file.tell() + item, depth + 1)
        self.is_implicit = was_implicit

    def integer(self, tag: tuple[int, int], default: int | None = None) -> int:
        data = self.values.get(tag)
        if data is None and default is not None:
            return default
        if data is None or len(data) != 2:
            raise VolumeError(f"{self.path}: expected one integer in element ({tag[0]:04x},{tag[1]:04x})")
        return int(struct.unpack(f"{self.order}H", data)[0])


def has_signature(path: str) -> bool:
    """Return True if a file has the signature of DICOM. Raise OSError if the file cannot be read."""
    position, mark = SIGNATURE
    with open(path, "rb") as file:
        return file.read(position + len(mark))[position:] == mark


def check_dicom(path: str) -> tuple[tuple[int, ...] | None, bytes]:
    """Check a DICOM file. Return the numbers of its columns, rows and frames, and its SOP class UID.

    The SOP class UID identifies the kind of object, such as a CT image. The numbers are None if the file has no pixel
    data. Raise VolumeError if an element is damaged or truncated, and Unverifiable if the pixel data are compressed.
    """
    with open(path, "rb") as file:
        elements = _Elements(file, path, os.fstat(file.fileno()).st_size)
        position, mark = SIGNATURE
        if file.read(position + len(mark))[position:] != mark:
            raise VolumeError(f"{path}: not a DICOM file: expected the bytes DICM at position {position}")
        # The file meta information begins with its length. Its types are explicit, its byte order is little endian.
        tag = elements.tag()
        if tag != (0x0002, 0x0000) or elements.length(tag) != (b"UL", 4):
            raise VolumeError(f"{path}: damaged: the length of the file meta information is missing")
        elements.read_set(file.tell() + 4 + struct.unpack("<I", elements.read(4))[0])
        syntax = elements.values.get(_SYNTAX, b"").rstrip(b"\0 ").decode("latin-1")
        if syntax == "1.2.840.10008.1.2.1.99":
            raise Unverifiable(_without_checksum(path, syntax))
        elements.is_implicit = syntax == _IMPLICIT
        elements.order = ">" if syntax == _BIG_ENDIAN else "<"
        elements.read_set(elements.size)
    object_class = elements.values.get(_CLASS, b"")
    if elements.pixels is None:
        return None, object_class
    if elements.pixels == _UNDEFINED or syntax not in (_IMPLICIT, _EXPLICIT, _BIG_ENDIAN):
        raise Unverifiable(_without_checksum(path, syntax))
    frames = elements.values.get(_FRAMES, b"1").strip(b"\0 ") or b"1"
    if not (frames.isdigit() and len(frames) < 10):
        raise VolumeError(f"{path}: expected a number of frames, found {quoted(frames)}")
    sizes = (elements.integer(_COLUMNS), elements.integer(_ROWS), int(frames))
    check_sizes(path, sizes)
    bits = sizes[0] * sizes[1] * sizes[2] * elements.integer(_SAMPLES, 1) * elements.integer(_BITS)
    # Every value is padded to an even number of bytes.
    check_length(path, 2 * -(-bits // 16), elements.pixels + elements.pixels % 2)
    return sizes, object_class


def _without_checksum(path: str, syntax: str) -> str:
    return (
        f"{path}: the pixel data are compressed without a checksum (transfer syntax {syntax[:40]}), so damage would "
        "not be noticed; convert the file to uncompressed pixel data, for example with gdcmconv --raw"
    )
