"""Read the volume that the arguments name, and describe the selected voxels and the coordinates."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction

from emulator.errors import quoted
from modern.cli.shared.console import UsageError, counted
from modern.digital.scans import Choice, Chosen, Scan, chosen, listed_labels
from modern.digital.solids import Volume
from modern.digital.volumes import ARRAYS, Stated, read_scan
from modern.digital.world import ANATOMICAL, World, decimal_or_fraction
from modern.geometry.numbers import decimal

_SPACES = dict(zip(("lps", "ras"), ANATOMICAL, strict=False))


def scan_of(args: argparse.Namespace) -> Scan:
    """Read the scan that the argument ``VOLUME`` names.

    Raise FileError, VolumeError, or UsageError for arguments that are not numbers.
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
    """Return which voxels belong to the solid, by their values, as the arguments request. Raise UsageError."""
    if args.threshold is None:
        return Choice(labels=tuple(dict.fromkeys(args.label)))
    try:
        return Choice(Fraction(decimal(args.threshold)), tuple(dict.fromkeys(args.label)))
    except ValueError as error:
        raise UsageError(f"--threshold: {error}") from None


def volume_of(args: argparse.Namespace) -> tuple[Volume, tuple[str, ...]]:
    """Return the selected voxels of ``VOLUME`` in the coordinates of ``--space``, and the notes to print at the end.

    Raise the errors of ``scan_of``.
    """
    choice = choice_of(args)
    selection = chosen(scan_of(args), choice)
    volume = replace(selection.volume, world=in_space(selection.volume.world, getattr(args, "space", "file")))
    return volume, (*note_lines(volume.notes), *_selection_lines(selection))


def note_lines(notes: Sequence[str]) -> Iterator[str]:
    """Return notes on a volume as lines without control characters."""
    return (printable(f"note: {note}") for note in notes)


def in_space(world: World | None, space: str) -> World | None:
    """Return physical coordinates in the orientation that ``--space`` requests, or None for voxel indices."""
    if space == "index" or world is None:
        if space in _SPACES:
            raise UsageError(
                f"--space {space}: the file does not state where its voxels lie; use --spacing, or --space index"
            )
        return None
    if space not in _SPACES:
        return world
    if world.space not in ANATOMICAL:
        named = repr(world.space) if world.space else "not named"
        raise UsageError(
            f"--space {space}: the file's space is {named}, so left and right are unknown; use --space file or index"
        )
    return world.turned(_SPACES[space])


def spacing_words(world: World | None) -> str:
    """Return the spacing as text: ``spacing 0.5 0.5 2 mm``."""
    if world is None:
        return "no spacing stated"
    lengths = world.spacings()
    rounded = "" if all(exact for _, exact in lengths) else ", to six digits"
    unit = f" {world.unit}" if world.unit else " (unit not stated)"
    return f"spacing {' '.join(text for text, _ in lengths)}{unit}{rounded}"


def coordinate_words(world: World | None, corners: bool) -> str:
    """Describe the coordinates of a hull of voxel corners, or of voxel centres, on one line."""
    if world is None:
        meaning = "voxel (x, y, z) extends from (x, y, z) to (x+1, y+1, z+1)" if corners else "vertices are centres"
        return f"coordinates: voxel indices; {meaning}"
    space = world.space or "space not named"
    start = " ".join(map(decimal_or_fraction, world.origin))
    sides = world.bearings()
    axes = ""
    if sides:
        about = "" if all(exact for _, exact in sides) else "about "
        axes = f"; the array's axes run {about}{', '.join(side for side, _ in sides)}"
    vertices = "vertices are corners, half a voxel from centres" if corners else "vertices are centres"
    return f"coordinates: {space}; centre of voxel (0, 0, 0) at {start}{axes}; {vertices}"


def check_array(path: str | None) -> None:
    """Raise UsageError if the name of an output does not end with .npy or .nrrd."""
    if path is not None and not path.lower().endswith(ARRAYS):
        raise UsageError(
            f"{path}: a filled hull is written as an array; expected a name that ends with {' or '.join(ARRAYS)}"
        )


def array_note(path: str, volume: Volume) -> Iterator[str]:
    """Yield notes on the position of the array if the file is an NPY file, which cannot contain it."""

    if not path.lower().endswith(".npy"):
        return
    if volume.world is not None:
        yield f"note: {path} contains no spacing and no origin; an .nrrd file would contain them"
    if any(volume.origin):
        yield f"note: the first voxel of the array is ({','.join(map(str, volume.origin))})"


def printable(text: str) -> str:
    """Return text on one line without control characters, which a terminal would obey."""
    return "".join(c if c.isprintable() else " " for c in text)


def _selection_lines(selection: Chosen) -> Iterator[str]:
    volume, choice = selection.volume, selection.choice
    low, high = ("infinite" if n is None else f"{float(n):.6g}" for n in (selection.lowest, selection.highest))
    if choice.labels:
        labels = f"label{'s' * (len(choice.labels) > 1)} {', '.join(map(str, choice.labels))}"
        values = f"{labels} of {listed_labels(selection.present)}"
    elif choice.threshold is not None:
        values = f"values of at least {decimal_or_fraction(choice.threshold)}, of {low} to {high}"
    elif selection.truth and volume.world is None:
        return
    else:
        values = f"values other than 0, of {low} to {high}"
    count = counted(volume.count, "voxel").replace(str(volume.count), f"{volume.count:,}")
    yield printable(f"{volume.source}: {values}; {count}; {spacing_words(volume.world)}")


def _numbers(option: str, text: str | None) -> tuple[Fraction, ...] | None:
    if text is None:
        return None
    try:
        return tuple(Fraction(decimal(part)) for part in text.split(","))
    except ValueError as error:
        raise UsageError(f"{option}: {error}") from None


def _shape(text: str | None) -> tuple[int, ...] | None:
    if text is None:
        return None
    lengths = text.replace("x", ",").split(",")
    if not all(length.isascii() and length.isdigit() and len(length) < 10 for length in lengths):
        raise UsageError(f"--shape: expected NX,NY,NZ, found {quoted(text)}")
    return tuple(int(length) for length in lengths)
