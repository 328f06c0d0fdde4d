"""``hull1620 hidden-line``: convex polyhedra drawn without their hidden lines."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from pathlib import PurePath

from emulator.files import check_writable, write_text
from modern.cli.export import exact_hull_of
from modern.cli.shared.console import OK, say
from modern.drawing.scene import eye_of
from modern.formats.off import read_off
from modern.geometry.vectors import Vector
from modern.papers.nakamae_nishita import picture, report
from modern.papers.nakamae_nishita.hidden import draw
from modern.papers.nakamae_nishita.polyhedron import SceneError, polyhedron_of_hull, polyhedron_of_off
from modern.papers.nakamae_nishita.scenes import (
    PERSPECTIVE,
    SceneFile,
    Sight,
    names,
    of_polyhedron,
    read,
    scene,
)

_PLOTS = (".hpgl", ".plt")


def arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of the command."""
    parser.add_argument(
        "scene",
        metavar="SCENE",
        help="a scene file .toml, a convex polyhedron .off, points to take the hull of, or cuboids, columns, house",
    )
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="SVG, or HPGL with a name ending .hpgl or .plt (default: SVG to '-')"
    )
    parser.add_argument("--eye", metavar="X,Y,Z", help="the direction to the eye; write --eye=-1,2,3 before a minus")
    parser.add_argument("--perspective", action="store_true", help="--eye is the observation point itself")
    parser.add_argument("--towards", metavar="X,Y,Z", help="in perspective: the point looked at (default: the middle)")
    parser.add_argument("--hidden", action="store_true", help="draw hidden lines too, dashed")
    parser.add_argument("--tables", action="store_true", help="print contours, PL and LP tables with d, and indices")
    parser.add_argument(
        "--without",
        metavar="MEND,...",
        default="",
        help="leave out mends of the paper's gaps: enclosed, touching, ends; or its own ghosts",
    )
    parser.add_argument("--title", metavar="TEXT", help="the line below the picture (default: the scene's)")
    parser.add_argument("--width", metavar="PIXELS", type=int, default=640, help="of the SVG (default: 640)")


def main(args: argparse.Namespace) -> int:
    """Read the scene, find what is hidden, print what is asked for, write the picture."""
    output = args.output or (None if args.tables else "-")
    check_writable(output)
    without = [name.strip() for name in args.without.split(",") if name.strip()]
    found = _scene(args.scene)
    observer = _sight(args, found.sight).observer(found.make)
    drawing = draw(found.make, observer, without, args.hidden)
    if output is not None:
        plot = output.lower().endswith(_PLOTS)
        title = found.title if args.title is None else args.title
        write_text(output, picture.as_hpgl(drawing) if plot else picture.as_svg(drawing, title, args.width))
    if args.tables:
        sys.stdout.writelines(line + "\n" for line in report.tables(drawing))
    say(report.table1(drawing))
    return OK


def _scene(path: str) -> SceneFile:
    """A scene of the project by name, a scene file, an OFF file with its faces, or the hull of points."""
    if path in names():
        return scene(path)
    ending = PurePath(path).suffix.lower()
    if ending == ".toml":
        return read(path)
    if ending == ".off":
        return of_polyhedron(polyhedron_of_off(read_off(path)))
    return of_polyhedron(polyhedron_of_hull(exact_hull_of(path), path))


def _sight(args: argparse.Namespace, sight: Sight) -> Sight:
    """The scene's own view, but for what the options say."""
    eye = None if args.eye is None else _vector(args.eye)
    towards = None if args.towards is None else _vector(args.towards)
    if args.perspective:
        if eye is None:
            raise SceneError("--perspective needs the observation point, --eye X,Y,Z")
        return Sight(eye, PERSPECTIVE, towards)
    if towards is not None and sight.projection != PERSPECTIVE:
        raise SceneError("--towards is for a perspective; a parallel projection has a direction only")
    return replace(sight, eye=eye or sight.eye, towards=towards or sight.towards)


def _vector(text: str) -> Vector:
    x, y, z = eye_of(text.split(","))
    return x, y, z
