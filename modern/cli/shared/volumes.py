"""Read the volume that the arguments name, and describe the selected voxels and the coordinates."""

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction

from emulator.errors import quoted
from modern.cli.shared.console import UsageError
from modern.digital.scans import Choice, Chosen, Scan, chosen, listed_labels
from modern.digital.solids import Volume
from modern.digital.volumes import Stated, read_scan
from modern.digital.world import ANATOMICAL, World, decimal_or_fraction
from modern.geometry.numbers import decimal

_SPACES = dict(zip(("lps", "ras"), ANATOMICAL, strict=False))


def scan_of(args: argparse.Namespace) -> Scan:
    """Read the scan that the argument ``VOLUME`` names.

    Raise FileError or VolumeError if the scan cannot be read, and UsageError for arguments that are not numbers.
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
    """Return the condition on the values of the voxels that belong to the solid: labels or a threshold.

    Raise UsageError if the threshold is not a number.
    """
    try:
        threshold = None if args.threshold is None else Fraction(decimal(args.threshold))
    except ValueError as error:
        raise UsageError(f"--threshold: {error}") from None
    return Choice(threshold, tuple(dict.fromkeys(args.label)))


def volume_of(args: argparse.Namespace) -> tuple[Volume, tuple[str, ...]]:
    """Return the selected voxels of ``VOLUME`` in the coordinates of ``--space``, and notes for the user.

    Raise FileError or VolumeError if the volume cannot be read, and UsageError for an invalid argument.
    """
    choice = choice_of(args)
    selection = chosen(scan_of(args), choice)
    volume = replace(selection.volume, world=in_space(selection.volume.world, getattr(args, "space", "file")))
    return volume, (*note_lines(volume.notes), *_selection_lines(selection))


def note_lines(notes: Sequence[str]) -> Iterator[str]:
    """Return notes on a volume as lines without control characters."""
    return (printable(f"note: {note}") for note in notes)


def in_space(world: World | None, space: str) -> World | None:
    """Return the physical coordinates with the axes that ``--space`` requests, or None for voxel indices.

    Raise UsageError if the file does not state where its voxels lie, or which way its axes point.
    """
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
    """Return the spacing of the voxels as text: ``spacing 0.5 0.5 2 mm``."""
    if world is None:
        return "no spacing stated"
    lengths = world.spacings()
    rounded = "" if all(exact for _, exact in lengths) else ", to six digits"
    unit = f" {world.unit}" if world.unit else " (unit not stated)"
    return f"spacing {' '.join(text for text, _ in lengths)}{unit}{rounded}"


def coordinate_words(world: World | None, corners: bool) -> str:
    """Return a line that explains the coordinates of a hull of voxel corners or of voxel centres."""
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


def array_note(path: str, volume: Volume) -> Iterator[str]:
    """Yield notes on the spacing and position of an array if the file is an NPY file, which cannot contain them."""
    if not path.lower().endswith(".npy"):
        return
    if volume.world is not None:
        yield f"note: {path} contains no spacing and no origin; an .nrrd file would contain them"
    if any(volume.origin):
        yield f"note: the first voxel of the array is ({','.join(map(str, volume.origin))})"


def printable(text: str) -> str:
    """Return the text with blanks instead of control characters, which a terminal would obey."""
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
    count = f"{volume.count:,} voxel{'s' * (volume.count != 1)}"
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
