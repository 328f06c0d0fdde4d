"""Arguments of the commands that read points or faces.

Like ``modern/cli/arguments.py``, this module imports nothing that is needed only to run a command.
"""

from __future__ import annotations

from argparse import ArgumentParser

from modern.cli.shared.arguments import (
    coplanar_argument,
    epsilon_argument,
    eye_argument,
    json_argument,
    layers_argument,
    listed,
    output_argument,
    points_argument,
    printed_arguments,
    result_file_argument,
    title_argument,
)
from modern.formats import HULLS


def cards(parser: ArgumentParser) -> None:
    points_argument(parser)
    output_argument(parser, "DECK")
    parser.add_argument(
        "--truncate", action="store_true", help="truncate numbers with more digits than a card holds instead of failing"
    )
    epsilon_argument(parser, "punch", "on the first card, after N, for the layer epsilon")


def diff(parser: ArgumentParser) -> None:
    points_argument(parser)
    epsilon_argument(parser, "use", "in the layer epsilon and in the port, or rel:E in the port only")
    json_argument(parser, "comparison")
    parser.add_argument("--explain", action="store_true", help="if a program gives no hull, explain the reason")
    layers_argument(parser)


def export(parser: ArgumentParser) -> None:
    points_argument(parser)
    output_argument(parser, formats=f", whose name ends with {listed(f'.{name}' for name in HULLS)}, or with --format")
    parser.add_argument("--format", choices=tuple(HULLS), help="the format (default: the one that the name ends with)")
    coplanar_argument(parser)


def draw(parser: ArgumentParser) -> None:
    points_argument(parser)
    output_argument(parser, formats=" as SVG (.svg), or with the extra plot as PDF or PNG")
    parser.set_defaults(endings=(".svg", ".pdf", ".png"))
    eye_argument(parser)
    title_argument(parser, "the name of the file")
    _width_argument(parser)
    parser.add_argument(
        "--labels",
        choices=("programs", "input", "none"),
        default="programs",
        help="label the vertices with the numbers that the 1963 programs give them, with their positions in the "
        "input, or not at all (default: programs)",
    )
    parser.add_argument("--no-hidden", action="store_true", help="omit the hidden edges and vertices")
    parser.add_argument("--no-points", action="store_true", help="omit the points that are not vertices")
    coplanar_argument(parser)
    which = parser.add_mutually_exclusive_group()
    which.add_argument(
        "--against", metavar="CARDS", help="highlight differences from the hull on CARDS, punched by hull1620 hull"
    )
    which.add_argument("--stages", action="store_true", help="draw the stages H1 to Hf of the construction in a row")
    which.add_argument("--animate", action="store_true", help="animate the stages H1 to Hf of the construction")


def appel_will(parser: ArgumentParser) -> None:
    points_argument(parser, "FILE", " (points and surfaces)")
    printed_arguments(parser, "rule", "star, step3, step5, step7, step9, step10")
    parser.add_argument(
        "--star",
        choices=("printed", "corrected"),
        help="choose the star polygon test independently of the other rules (default: corrected; with --literal: "
        "printed)",
    )
    parser.add_argument(
        "--inside-corners",
        metavar="RULE",
        choices=("any", "two", "concave"),
        help="delete points on inside corners first, by the rule any (valid if no point is on more than three planes), "
        "two or concave (always valid)",
    )
    parser.add_argument("--trace", action="store_true", help="print how often each edge has been used after each loop")
    parser.add_argument(
        "--all", action="store_true", help="print all tables (default: only a summary for more than 50 points)"
    )
    result_file_argument(parser, "the hull (.off), or a drawing with its convex edges (.svg)")
    parser.set_defaults(endings=(".off", ".svg"))
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--map", action="store_true", help="with -o FILE.svg: draw the planar topological map instead")
    which.add_argument(
        "--star-of", metavar="I-J", help="with -o FILE.svg: draw the star polygon of the line of points I and J instead"
    )
    eye_argument(parser)
    _width_argument(parser)
    coplanar_argument(parser)


def hidden_line(parser: ArgumentParser) -> None:
    parser.add_argument(
        "scene",
        metavar="SCENE",
        help="a scene file .toml, a file of faces (OFF, OBJ, STL), a file of points whose hull is drawn, or one of the "
        "scenes cuboids, columns and house",
    )
    result_file_argument(parser, "SVG (.svg) or HPGL (.hpgl, .plt) (default: SVG to standard output)")
    parser.set_defaults(endings=(".svg", ".hpgl", ".plt"))
    eye_argument(parser)
    parser.add_argument("--perspective", action="store_true", help="draw in perspective, with --eye as the eye point")
    parser.add_argument(
        "--towards", metavar="X,Y,Z", help="in perspective: look at this point (default: the middle of the scene)"
    )
    parser.add_argument(
        "--near",
        metavar="DISTANCE",
        help="in perspective: clip everything nearer than DISTANCE (default: clip nothing, and reject a scene that is "
        "not entirely in front of the eye)",
    )
    parser.add_argument(
        "--hull",
        action="store_true",
        help="for a file of faces: draw the hull of each connected component (default: each component must be convex)",
    )
    coplanar_argument(parser)
    parser.add_argument("--hidden", action="store_true", help="draw hidden lines too, dashed")
    parser.add_argument(
        "--tables",
        action="store_true",
        help="print the contours, the paper's tables PL, LP and d for each pair of overlapping contours, and the "
        "indices of hidden segments",
    )
    parser.add_argument(
        "--without",
        metavar="CORRECTION,...",
        default="",
        help="omit these corrections of the paper's method: enclosed, touching, ends; or the paper's step ghosts "
        "(default: omit none)",
    )
    title_argument(parser, "the scene's title")
    parser.add_argument("--width", metavar="PIXELS", type=int, default=640, help="width of the SVG (default: 640)")


def _width_argument(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--width",
        metavar="PIXELS",
        type=int,
        help="draw the picture 320 to 4000 pixels wide (default: 640, or 1000 for many points)",
    )
