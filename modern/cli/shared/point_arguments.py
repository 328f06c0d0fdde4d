"""Define the arguments of the commands that read points or faces.

Like ``modern/cli/arguments.py``, this module imports nothing that is needed only to run a command.
"""

from argparse import ArgumentParser

from modern.cli.shared import arguments as shared
from modern.cli.shared.arguments import add, listed
from modern.cli.shared.console import InputFile
from modern.formats import HULLS


def cards(parser: ArgumentParser) -> None:
    shared.points_argument(parser)
    shared.output_argument(parser, "DECK")
    add(parser, {"--truncate": "truncate numbers with more digits than a card holds instead of failing"})
    shared.epsilon_argument(
        parser, "punch", "on the first card, after the number of points N; the layer epsilon reads it"
    )


def diff(parser: ArgumentParser) -> None:
    shared.points_argument(parser)
    shared.epsilon_argument(
        parser,
        "use",
        "in the layer epsilon and in the port; with rel:E, which only the port accepts, e is E times the largest "
        "coefficient A, B or C of an equation",
    )
    shared.json_argument(parser, "comparison")
    add(parser, {"--explain": "if a program gives no hull, explain the reason"})
    shared.layers_argument(parser)


def export(parser: ArgumentParser) -> None:
    shared.points_argument(parser)
    endings = listed(f".{name}" for name in HULLS)
    shared.output_argument(parser, formats=f" in the format of its ending, {endings}, or in the format of --format")
    add(parser, {"--format": "write this format (default: the format of the ending)"}, choices=tuple(HULLS))
    shared.coplanar_argument(parser)


def draw(parser: ArgumentParser) -> None:
    shared.points_argument(parser)
    shared.output_argument(parser, formats=" as SVG (.svg), or if hull1620[plot] is installed as PDF or PNG")
    parser.set_defaults(endings=(".svg", ".pdf", ".png"))
    shared.eye_argument(parser)
    shared.title_argument(parser, "the name of the file")
    _width_argument(parser)
    labels = (
        "label the vertices with the numbers that the 1963 programs give them, with their positions in the input, or "
        "not at all (default: programs)"
    )
    add(parser, {"--labels": labels}, choices=("programs", "input", "none"), default="programs")
    omitted = {
        "--no-hidden": "omit the hidden edges and vertices",
        "--no-points": "omit the points that are not vertices",
    }
    add(parser, omitted)
    shared.coplanar_argument(parser)
    which = parser.add_mutually_exclusive_group()
    against = "highlight differences from the hull on CARDS, punched by hull1620 hull"
    add(which, {"--against CARDS": against}, type=InputFile)
    stages = {
        "--stages": "draw the successive hulls H1 to Hf of the thesis's procedure in a row",
        "--animate": "animate the successive hulls H1 to Hf of the thesis's procedure",
    }
    add(which, stages)


def appel_will(parser: ArgumentParser) -> None:
    shared.points_argument(parser, "FILE", " (the surfaces of an OFF file are read too)")
    shared.printed_arguments(parser, "rule", "star, step3, step5, step7, step9, step10")
    inside_corners = (
        "before the search, delete points on inside corners (concave edges): all of them with the rule any, which is "
        "valid if no point is on more than three planes, or fewer with the rules two and concave, which are always "
        "valid"
    )
    add(parser, {"--inside-corners RULE": inside_corners}, choices=("any", "two", "concave"))
    tables = {
        "--trace": "after each loop of edges, print how often each edge has been used",
        "--all": "print all tables (default: only a summary for more than 50 points)",
    }
    add(parser, tables)
    shared.result_file_argument(parser, "the hull (.off), or a drawing with its convex edges (.svg)")
    parser.set_defaults(endings=(".off", ".svg"))
    pictures = {
        "--map": "with -o FILE.svg: draw the planar topological map instead",
        "--star-of I-J": "with -o FILE.svg: draw the star polygon of the line between points I and J instead",
    }
    add(parser.add_mutually_exclusive_group(), pictures)
    shared.eye_argument(parser)
    _width_argument(parser)
    shared.coplanar_argument(parser)


def hidden_line(parser: ArgumentParser) -> None:
    scene = (
        "a scene file .toml, a file of faces (OFF, OBJ, PLY, STL), a file of points whose hull is drawn, or one of the "
        "scenes cuboids, columns and house"
    )
    add(parser, {"scene SCENE": scene}, type=InputFile)
    shared.result_file_argument(parser, "SVG (.svg) or HPGL (.hpgl, .plt) (default: SVG to standard output)")
    parser.set_defaults(endings=(".svg", ".hpgl", ".plt"))
    shared.eye_argument(parser)
    views = {
        "--perspective": "draw in perspective, with --eye as the eye point",
        "--towards X,Y,Z": "in perspective: look at this point (default: the middle of the scene)",
        "--near DISTANCE": "in perspective: clip everything nearer than DISTANCE (default: clip nothing, and reject a "
        "scene that is not entirely in front of the eye)",
        "--hull": "for a file of faces: draw the hull of each connected component (default: each component must be "
        "convex)",
    }
    add(parser, views)
    shared.coplanar_argument(parser)
    tables = {
        "--hidden": "draw hidden lines too, dashed",
        "--tables": "print the contours, the paper's tables PL, LP and d for each pair of overlapping contours, and "
        "for each hidden segment the crossings at which it becomes hidden or visible",
    }
    add(parser, tables)
    without = (
        "omit these corrections of the paper's method (enclosed, touching, ends), or the step of the paper that "
        "removes lines within one object (ghosts) (default: omit nothing)"
    )
    add(parser, {"--without CORRECTION,...": without}, default="")
    shared.title_argument(parser, "the scene's title")
    add(parser, {"--width PIXELS": "draw the SVG this many pixels wide (default: 640)"}, type=int, default=640)


def _width_argument(parser: ArgumentParser) -> None:
    text = "draw the picture 320 to 4000 pixels wide (default: 640, or 1000 for many points)"
    add(parser, {"--width PIXELS": text}, type=int)
