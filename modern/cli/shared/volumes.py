"""The volume that a command's arguments name, and what it says of it: what was chosen, and what coordinates mean."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction

from modern.cli.shared.console import UsageError, counted
from modern.digital.scans import Choice, Chosen, Scan, chosen, listed_labels
from modern.digital.solids import Volume
from modern.digital.volumes import ARRAYS, Stated, read_scan
from modern.digital.world import ANATOMICAL, World, decimal_or_fraction
from modern.geometry.numbers import decimal

_SPACES = dict(zip(("lps", "ras"), ANATOMICAL, strict=False))


def scan_of(args: argparse.Namespace) -> Scan:
    """The scan ``VOLUME``, read as the arguments say.

    Raises FileError, VolumeError, and UsageError for arguments that are no numbers.
    """
    stated = Stated(
        shape=_shape(args.shape),
        dtype=args.dtype,
        array=args.array,
        series=args.series,
        spacing=_numbers("--spacing", args.spacing),
        origin=_numbers("--origin", args.origin),
    )
    return read_scan(args.volume, stated)


def choice_of(args: argparse.Namespace) -> Choice:
    """The values asked for.  Raises UsageError."""
    if args.threshold is None:
        return Choice(labels=tuple(dict.fromkeys(args.label)))
    try:
        return Choice(Fraction(decimal(args.threshold)), tuple(dict.fromkeys(args.label)))
    except ValueError as error:
        raise UsageError(f"--threshold: {error}") from None


def volume_of(args: argparse.Namespace) -> tuple[Volume, tuple[str, ...]]:
    """The voxels asked for of ``VOLUME``, in the coordinates of ``--space``; and what is to be said of them once all
    has gone well: notes, and what was chosen.

    Raises as ``scan_of``.
    """
    choice = choice_of(args)
    found = chosen(scan_of(args), choice)
    volume = replace(found.volume, world=in_space(found.volume.world, getattr(args, "space", "file")))
    return volume, (*note_lines(volume.notes), *_chosen_lines(found))


def note_lines(notes: Sequence[str]) -> Iterator[str]:
    """Notes as the user reads them."""
    return (printable(f"note: {note}") for note in notes)


def in_space(world: World | None, space: str) -> World | None:
    """The world in the coordinates asked for by ``--space``, None for indices.  Raises UsageError."""
    if space == "index" or world is None:
        if space in _SPACES:
            raise UsageError(f"--space {space}: the file does not say where its voxels lie")
        return None
    if space not in _SPACES:
        return world
    if world.space not in ANATOMICAL:
        named = repr(world.space) if world.space else "not named"
        raise UsageError(f"--space {space}: the file's space is {named}, so that nobody knows its left and right")
    return world.turned(_SPACES[space])


def spacing_words(world: World | None) -> str:
    """``spacing 0.5 0.5 2 mm``."""
    if world is None:
        return "no spacing stated"
    lengths = world.spacings()
    rounded = "" if all(exact for _, exact in lengths) else ", to six digits"
    unit = f" {world.unit}" if world.unit else " (unit not stated)"
    return f"spacing {' '.join(text for text, _ in lengths)}{unit}{rounded}"


def coordinate_words(world: World | None, corners: bool) -> str:
    """What the coordinates of a hull mean, on one line; of voxels' corners, or of their centres."""
    if world is None:
        means = "voxel (x, y, z) from (x, y, z) to (x+1, y+1, z+1)" if corners else "of voxels' centres"
        return f"coordinates: indices, {means}"
    space = world.space or "space not named"
    start = " ".join(map(decimal_or_fraction, world.origin))
    sides = world.bearings()
    runs = ""
    if sides:
        about = "" if all(exact for _, exact in sides) else "about "
        runs = f"; the array's axes run {about}{', '.join(side for side, _ in sides)}"
    what = "vertices are corners, half a voxel from centres" if corners else "vertices are centres"
    return f"coordinates: {space}; the centre of voxel (0, 0, 0) at {start}{runs}; {what}"


def check_array(path: str | None) -> None:
    """Refuse a name that no array is written to.  Raises UsageError."""
    if path is not None and not path.lower().endswith(ARRAYS):
        raise UsageError(f"{path}: a filled hull is written as an array; the name must end with {' or '.join(ARRAYS)}")


def array_note(path: str, volume: Volume) -> Iterator[str]:
    """What an NPY file does not hold."""
    if not path.lower().endswith(".npy"):
        return
    if volume.world is not None:
        yield f"note: {path} holds no spacing and no origin; a name ending .nrrd keeps them"
    if any(volume.origin):
        yield f"note: the array's first voxel is ({','.join(map(str, volume.origin))})"


def printable(words: str) -> str:
    """Words on one line, without what a terminal would take for a command."""
    return "".join(c if c.isprintable() else " " for c in words)


def _chosen_lines(found: Chosen) -> Iterator[str]:
    volume, choice = found.volume, found.choice
    if choice.labels:
        named = f"label{'s' * (len(choice.labels) > 1)} {', '.join(map(str, choice.labels))}"
        what = f"{named} of {listed_labels(found.present)}"
    elif choice.threshold is not None:
        what = f"values from {decimal_or_fraction(choice.threshold)} up (>=) of {_span(found)}"
    elif found.truth and volume.world is None:
        return
    else:
        what = f"values other than 0 of {_span(found)}"
    yield printable(f"{volume.source}: {what}; {thousands(volume.count)}; {spacing_words(volume.world)}")


def _span(found: Chosen) -> str:
    low, high = ("infinite" if n is None else f"{float(n):.6g}" for n in (found.lowest, found.highest))
    return f"{low} to {high}"


def thousands(count: int) -> str:
    """``1 voxel``, ``10,234 voxels``."""
    return counted(count, "voxel").replace(str(count), f"{count:,}")


def _numbers(option: str, text: str | None) -> tuple[Fraction, ...] | None:
    if text is None:
        return None
    try:
        return tuple(Fraction(decimal(word)) for word in text.split(","))
    except ValueError as error:
        raise UsageError(f"{option}: {error}") from None


def _shape(text: str | None) -> tuple[int, ...] | None:
    if text is None:
        return None
    words: Sequence[str] = text.replace("x", ",").split(",")
    if not all(word.isascii() and word.isdigit() and len(word) < 10 for word in words):
        raise UsageError(f"--shape: {text!r} is not NX,NY,NZ")
    return tuple(int(word) for word in words)
