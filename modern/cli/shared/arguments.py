"""Arguments that several commands share: inputs, the machine a program runs on, where results go.

As in ``modern/cli/arguments.py`` nothing is imported that only a run needs.
"""

from __future__ import annotations

from argparse import ArgumentParser, ArgumentTypeError
from collections.abc import Iterable

from modern.formats import POINTS


def result_arguments(parser: ArgumentParser) -> None:
    """Where the results of a run go, and those of ``machine_arguments``."""
    parser.add_argument(
        "--punch", metavar="FILE", default="-", help="where punched cards go (default: standard output)"
    )
    parser.add_argument("--typewriter", metavar="FILE", help="where typed lines go (default: standard error)")
    parser.add_argument(
        "--profile",
        action="store_true",
        help="count statements and operations, and give the time on the 1620",
    )
    parser.add_argument("--trace", metavar="FILE", help="write every statement with its card and values")
    parser.add_argument(
        "--operator",
        metavar="=FILE",
        help="--operator alone: the terminal is the console; --operator=FILE: a file, or a log, answers; "
        "--operator=none: nobody (default: the terminal, where all is one and the program has ACCEPT or PAUSE)",
    )
    parser.add_argument(
        "--log", metavar="FILE", help="write down what the operator does; --operator=FILE reads it again"
    )
    parser.add_argument("--slow", action="store_true", help="at the terminal lines are typed ten characters a second")
    machine_arguments(parser)


def machine_arguments(parser: ArgumentParser) -> None:
    """The machine a program runs on, and ``--layers``."""
    parser.add_argument(
        "--switch",
        metavar="N",
        type=int,
        action="append",
        choices=(1, 2, 3, 4),
        default=[],
        help="sense switch N on (default: all off)",
    )
    parser.add_argument(
        "--arithmetic",
        metavar="NAME",
        default="truncating",
        help="the numbers (default: %(default)s, the thesis's eight digits): truncating, ibm1962, truncating:P, "
        "guarded:P, rounding:P, float64, float32, mp:BITS or exact",
    )
    core_argument(parser)
    parser.add_argument(
        "--bounds",
        choices=("strict", "core"),
        default="strict",
        help="a subscript out of bounds: stop, or use the neighbour's place as the machine did (default: %(default)s)",
    )
    parser.add_argument(
        "--limit",
        metavar="N",
        type=int,
        default=5_000_000,
        help="stop after N statements, or costly operations that take their time (default: %(default)s)",
    )
    layers_argument(parser)


def compared_machine(parser: ArgumentParser) -> None:
    """``machine_arguments`` and ``--upcase`` where every statement is compared, which takes longer."""
    machine_arguments(parser)
    upcase_argument(parser)
    parser.set_defaults(limit=1_000_000)


def output_argument(parser: ArgumentParser, metavar: str = "FILE") -> None:
    """``-o``, else standard output."""
    parser.add_argument("-o", "--output", metavar=metavar, default="-", help="where it goes (default: '-')")


def core_argument(parser: ArgumentParser) -> None:
    """``--core``."""
    words = "positions of core storage (default: %(default)s)"
    parser.add_argument("--core", type=int, choices=(20000, 40000, 60000), default=40000, help=words)


def eye_argument(parser: ArgumentParser) -> None:
    """``--eye``."""
    words = "the direction to the eye; write --eye=-1,2,3 before a minus (default: chosen)"
    parser.add_argument("--eye", metavar="X,Y,Z", help=words)


def coplanar_argument(parser: ArgumentParser) -> None:
    """``--coplanar-within``."""
    words = "read neighbouring faces as one whose vertices lie within this distance of a plane (default: exactly in it)"
    parser.add_argument("--coplanar-within", metavar="E", help=words)


def layers_argument(parser: ArgumentParser) -> None:
    """``--layers``."""
    parser.add_argument(
        "--layers",
        metavar="LAYER,...",
        default="",
        help="layers of the apparatus added to a built-in program: corrected, epsilon, translation; of "
        "program 1 examples too (default: none; of diff: corrected)",
    )


def upcase_argument(parser: ArgumentParser) -> None:
    """``--upcase``."""
    parser.add_argument("--upcase", action="store_true", help="read small letters of the program as capitals")


def points_argument(parser: ArgumentParser, metavar: str = "POINTS", more: str = "") -> None:
    """A file of points, of any format that is read."""
    parser.add_argument(
        "points",
        metavar=metavar,
        help=f"{listed(POINTS.values())}{more}; or an example by name: example5, seventy/17, appel-will/fig18",
    )


def volume_arguments(parser: ArgumentParser) -> None:
    """VOLUME, what it does not say of itself, and which of its voxels are taken."""
    parser.add_argument(
        "volume",
        metavar="VOLUME",
        help="NRRD, NPY, NPZ or a raw array; NIfTI (.nii, .nii.gz), MetaImage (.mha, .mhd), TIFF, DICOM (.dcm, or a "
        "folder with a series) by SimpleITK (extra volumes); CSV voxels x,y,z; or ball:32, ball:32:vertex, "
        "half-ball:18",
    )
    parser.add_argument(
        "--label",
        metavar="N",
        type=int,
        action="append",
        default=[],
        help="take the voxels whose value is N; again for more labels (default: every value other than 0)",
    )
    parser.add_argument("--threshold", metavar="T", help="take the voxels whose value is T or more (>=)")
    parser.add_argument("--spacing", metavar="DX,DY,DZ", help="of a file that does not say where its voxels lie")
    parser.add_argument(
        "--origin", metavar="X,Y,Z", help="the centre of its voxel (0, 0, 0) (default: 0,0,0, with --spacing)"
    )
    parser.add_argument("--shape", metavar="NX,NY,NZ", help="of a raw array, x fastest; it is needed for one")
    parser.add_argument("--dtype", metavar="TYPE", help="of a raw array's numbers (default: uint8)")
    parser.add_argument("--array", metavar="NAME", help="of an NPZ file with several arrays")
    parser.add_argument("--series", metavar="UID", help="of a folder with several DICOM series")


def listed(names: Iterable[str]) -> str:
    """``a, b or c``."""
    *others, last = names
    return f"{', '.join(others)} or {last}"


def epsilon_text(text: str) -> str:
    """Return the text of a valid e of chapter 7, also ``rel:E``."""
    from modern.geometry.numbers import read_epsilon  # imported here because few command lines have an e

    try:
        read_epsilon(text)
    except ValueError as error:
        raise ArgumentTypeError(str(error).removeprefix("epsilon: ")) from None
    return text
