"""Check the length of data, and verify the checksum of compressed data without keeping the decompressed data."""

import gzip
import math
import os
import zlib
from collections.abc import Iterator, Sequence
from typing import BinaryIO

from modern.digital.solids import MAX_CELLS, VolumeError

CHUNK = 1 << 20
# With this ``wbits`` zlib recognises both headers, zlib and gzip. Each of the formats ends with a checksum.
_ZLIB_OR_GZIP = 47


def check_length(source: str, expected: int, available: int) -> None:
    """Raise VolumeError unless the data have the expected number of bytes."""
    if available < expected:
        raise VolumeError(f"{source}: expected {expected} bytes of data, found {available}")
    if available > expected:
        raise VolumeError(f"{source}: expected {expected} bytes of data, found more")


def check_sizes(source: str, sizes: Sequence[int]) -> None:
    """Raise VolumeError if a size is not positive, or if an array of these sizes has more than ``MAX_CELLS`` voxels."""
    text = " x ".join(map(str, sizes))[:80]
    if not sizes or min(sizes) < 1:
        raise VolumeError(f"{source}: expected positive sizes, found {text or 'none'}")
    if math.prod(sizes) > MAX_CELLS:
        raise VolumeError(f"{source}: expected at most {MAX_CELLS} voxels, found {text}")


def outside_note(header: str, name: str) -> str:
    """Return a note if a header names a data file outside its own folder, otherwise an empty string."""
    folder = os.path.abspath(os.path.dirname(header))
    data = os.path.normpath(os.path.join(folder, name))
    outside = os.path.commonpath((folder, data)) != folder
    return f"{header}: the data are read from {data}, which is not in the folder of the header" if outside else ""


def chunks_of(file: BinaryIO, count: int) -> Iterator[bytes]:
    """Yield the next ``count`` bytes of a file in pieces, or fewer bytes if the file ends earlier."""
    while count > 0 and (chunk := file.read(min(CHUNK, count))):
        count -= len(chunk)
        yield chunk


def check_compressed(source: str, file: BinaryIO, stored: int, expected: int) -> None:
    """Check that the next ``stored`` bytes of a file are one undamaged zlib or gzip stream.

    Raise VolumeError if the stream is damaged, if other data follow it, or if it does not decompress to ``expected``
    bytes.
    """
    decompressor = zlib.decompressobj(_ZLIB_OR_GZIP)
    size, remaining = 0, stored
    try:
        for chunk in chunks_of(file, stored):
            remaining -= len(chunk)
            # The output is limited too, because a small damaged stream may decompress to any size.
            pending = chunk
            while pending and not decompressor.eof and size <= expected:
                size += len(decompressor.decompress(pending, CHUNK))
                pending = decompressor.unconsumed_tail
            if decompressor.eof or size > expected:
                break
        while not decompressor.eof and size <= expected and (piece := decompressor.decompress(b"", CHUNK)):
            size += len(piece)
    except zlib.error as error:
        raise VolumeError(f"{source}: the data cannot be decompressed: {str(error).lower()}") from None
    if size > expected:
        check_length(source, expected, size)
    if not decompressor.eof:
        raise VolumeError(f"{source}: the data cannot be decompressed: they end before their checksum")
    check_length(source, expected, size)
    if remaining or decompressor.unused_data:
        raise VolumeError(f"{source}: the compressed data are followed by other bytes")


def read_gzip(source: str, stored: str | BinaryIO, most: int, keep: int) -> tuple[bytes, int]:
    """Return the first ``keep`` decompressed bytes of a gzip stream, and the number of all decompressed bytes.

    Counting stops at ``most`` + 1 bytes. The checksum is verified only if the stream has at most ``most`` bytes. Raise
    VolumeError if the stream is damaged.
    """
    try:
        with gzip.open(stored) as file:
            head = file.read(keep)
            size = len(head)
            while size <= most and (chunk := file.read(min(CHUNK, most + 1 - size))):
                size += len(chunk)
            return head, size
    except (OSError, EOFError, zlib.error) as error:
        raise VolumeError(f"{source}: the data cannot be decompressed: {str(error).lower()}") from None
