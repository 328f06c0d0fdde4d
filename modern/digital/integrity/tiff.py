"""Check the directories of a TIFF file (TIFF 6.0, BigTIFF), and the length of each strip or tile of its images.

SimpleITK stops at a missing directory and fills truncated strips. Thus it would read a damaged stack with missing or
empty slices. Strips and tiles must be uncompressed, or compressed with Deflate, which has a checksum.
"""

import os
import struct
from collections.abc import Mapping
from typing import Any, BinaryIO

from modern.digital.integrity.streams import check_compressed, check_sizes
from modern.digital.solids import MAX_CELLS, VolumeError

# The ``struct`` code of a value by the TIFF code of its type. The types of fractions are omitted, as no check needs
# them.
_FORMATS = {1: "B", 2: "B", 3: "H", 4: "I", 6: "b", 7: "B", 8: "h", 9: "i", 11: "f", 12: "d", 13: "I", 16: "Q", 17: "q"}
_WIDTH, _HEIGHT, _BITS, _COMPRESSION, _DESCRIPTION, _SAMPLES, _ROWS, _PLANAR = 256, 257, 258, 259, 270, 277, 278, 284
_STRIPS, _TILES = (273, 279), (324, 325)
_TILE_WIDTH, _TILE_HEIGHT = 322, 323
# The tags that must be equal in all pages: width, height, bits, samples and sample format.
_ALIKE = (_WIDTH, _HEIGHT, _BITS, _SAMPLES, 339)
_NONE, _DEFLATE = 1, (8, 32946)
_WITHOUT_CHECKSUM = {2: "CCITT", 3: "CCITT", 4: "CCITT", 5: "LZW", 6: "JPEG", 7: "JPEG", 32773: "PackBits"}
_MOST_VALUES = 1 << 22

Tags = Mapping[int, tuple[int, ...] | bytes]


def check_tiff(path: str) -> tuple[int, ...]:
    """Check a TIFF file. Return its width, height and number of pages.

    Raise VolumeError if the file is damaged, is compressed without a checksum, or has pages of different sizes or
    types.
    """
    with open(path, "rb") as file:
        reader = _Reader(file, path)
        pages = reader.pages()
        first = pages[0]
        for number, page in enumerate(pages, 1):
            for tag in _ALIKE:
                if page.get(tag) != first.get(tag):
                    raise VolumeError(f"{path}: pages 1 and {number} have different sizes or types")
        for number, page in enumerate(pages, 1):
            reader.check_page(page, f"{path}: page {number}")
        images = _images(first)
        if images not in (0, 1, len(pages)):
            raise VolumeError(f"{path}: expected {images} pages, as its description states, found {len(pages)}")
    sizes = (_one(first, _WIDTH, path), _one(first, _HEIGHT, path), len(pages))
    check_sizes(path, sizes)
    return sizes


class _Reader:
    """An open TIFF file. ``order`` is its byte order, and ``size`` is its length."""

    def __init__(self, file: BinaryIO, path: str) -> None:
        self.file, self.path, self.size = file, path, os.fstat(file.fileno()).st_size
        head = file.read(16)
        self.order = {b"II": "<", b"MM": ">"}.get(head[:2], "")
        version = struct.unpack_from(f"{self.order}H", head, 2)[0] if self.order and len(head) == 16 else 0
        if version not in (42, 43):
            raise VolumeError(f"{path}: not a TIFF file, or its header is damaged")
        self.is_big = version == 43
        self.offset_format = f"{self.order}{'Q' if self.is_big else 'I'}"
        self.first = struct.unpack_from(self.offset_format, head, 8 if self.is_big else 4)[0]

    def unpack(self, form: str, position: int) -> tuple[Any, ...]:
        data = self.read(position, struct.calcsize(form))
        return struct.unpack(form, data)

    def read(self, position: int, count: int) -> bytes:
        if position + count > self.size:
            raise VolumeError(
                f"{self.path}: truncated: expected {count} bytes at position {position}; the file has {self.size} bytes"
            )
        self.file.seek(position)
        return self.file.read(count)

    def pages(self) -> list[Tags]:
        pages: list[Tags] = []
        position, visited = self.first, set()
        while position:
            if position in visited:
                raise VolumeError(f"{self.path}: damaged: the directories form a loop")
            visited.add(position)
            count_format, entry_size = (f"{self.order}Q", 20) if self.is_big else (f"{self.order}H", 12)
            count = self.unpack(count_format, position)[0]
            position += struct.calcsize(count_format)
            entries = self.read(position, count * entry_size)
            pages.append(
                dict(self._entry(entries[start : start + entry_size]) for start in range(0, len(entries), entry_size))
            )
            position = self.unpack(self.offset_format, position + len(entries))[0]
        if not pages:
            raise VolumeError(f"{self.path}: damaged: there is no directory")
        return pages

    def _entry(self, entry: bytes) -> tuple[int, tuple[int, ...] | bytes]:
        tag, kind = struct.unpack_from(f"{self.order}2H", entry)
        count = struct.unpack_from(self.offset_format, entry, 4)[0]
        inline = entry[12:] if self.is_big else entry[8:]
        code = _FORMATS.get(kind)
        if code is None:
            return tag, b""
        if count > _MOST_VALUES:
            raise VolumeError(
                f"{self.path}: damaged: expected at most {_MOST_VALUES} values of tag {tag}, found {count}"
            )
        form = f"{self.order}{count}{code}"
        length = struct.calcsize(form)
        if length > len(inline):
            inline = self.read(struct.unpack(self.offset_format, inline)[0], length)
        return tag, inline[:length] if kind in (2, 7) else struct.unpack(form, inline[:length])

    def check_page(self, page: Tags, source: str) -> None:
        """Raise VolumeError unless every strip or tile of a page's image is complete."""
        width, height = _one(page, _WIDTH, source), _one(page, _HEIGHT, source)
        samples = _one(page, _SAMPLES, source, 1)
        planes = samples if _one(page, _PLANAR, source, 1) == 2 else 1
        bits = _one(page, _BITS, source, 1) * (samples // planes)
        compression = _one(page, _COMPRESSION, source, _NONE)
        if compression not in (_NONE, *_DEFLATE):
            name = _WITHOUT_CHECKSUM.get(compression, f"scheme {compression}")
            raise VolumeError(
                f"{source}: compression {name} has no checksum, so damage would not be noticed; "
                "save the file uncompressed or with Deflate"
            )
        if min(width, height, samples, bits) < 1 or width * height > MAX_CELLS:
            raise VolumeError(f"{source}: invalid size {width} x {height}, {samples} samples of {bits} bits")
        if _TILES[0] in page:
            tile_width, rows = _one(page, _TILE_WIDTH, source), _one(page, _TILE_HEIGHT, source)
            if min(tile_width, rows) < 1:
                raise VolumeError(f"{source}: invalid tiles of {tile_width} x {rows} pixels")
            pieces, row_bytes = -(-width // tile_width) * -(-height // rows), -(-tile_width * bits // 8)
            lengths = [rows * row_bytes] * (pieces * planes)
        else:
            rows = min(_one(page, _ROWS, source, height), height)
            if rows < 1:
                raise VolumeError(f"{source}: invalid strips of {rows} rows")
            row_bytes = -(-width * bits // 8)
            lengths = [min(rows, height - start) * row_bytes for start in range(0, height, rows)] * planes
        tags = _TILES if _TILES[0] in page else _STRIPS
        offsets, counts = (page.get(tag, ()) for tag in tags)
        if not len(offsets) == len(counts) == len(lengths):
            raise VolumeError(f"{source}: expected {len(lengths)} strips or tiles, found {len(offsets)}")
        for offset, count, length in zip(offsets, counts, lengths, strict=True):
            if offset + count > self.size or (compression == _NONE and count < length):
                raise VolumeError(f"{source}: truncated: a strip or tile is incomplete")
            if compression != _NONE:
                self.file.seek(offset)
                check_compressed(source, self.file, count, length)


def _one(page: Tags, tag: int, source: str, default: int = 0) -> int:
    """Return the value of a TIFF tag, or ``default`` if it is missing. Several values of a tag must all be equal."""
    values = page.get(tag, (default,))
    if not values or isinstance(values, bytes) or len(set(values)) != 1 or not isinstance(values[0], int):
        raise VolumeError(f"{source}: damaged: tag {tag} has no valid value")
    return values[0]


def _images(page: Tags) -> int:
    """Return the number of images in ImageJ's description of a page, or 0 if the page has no such description.

    ImageJ writes a stack of more than 4 GB as a file with a single page.
    """
    description = page.get(_DESCRIPTION, b"")
    if isinstance(description, bytes) and description.startswith(b"ImageJ="):
        for line in description.splitlines():
            if line.startswith(b"images=") and line[7:].isdigit() and len(line) < 20:
                return int(line[7:])
    return 0
