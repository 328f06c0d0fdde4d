"""The volume that a command's arguments name."""

from __future__ import annotations

import argparse

from modern.cli.shared.console import UsageError, say
from modern.digital.volumes import Volume, read_volume


def volume_of(args: argparse.Namespace) -> Volume:
    """The volume ``VOLUME``, read as ``--shape`` and ``--dtype`` say; its notes go to standard error.

    Raises FileError, VolumeError, and UsageError for an invalid shape.
    """
    volume = read_volume(args.volume, _shape(args.shape), args.dtype)
    say(f"note: {note}" for note in volume.notes)
    return volume


def _shape(text: str | None) -> tuple[int, ...] | None:
    if text is None:
        return None
    words = text.replace("x", ",").split(",")
    if not all(word.isascii() and word.isdigit() and len(word) < 10 for word in words):
        raise UsageError(f"--shape: {text!r} is not NX,NY,NZ")
    return tuple(int(word) for word in words)
