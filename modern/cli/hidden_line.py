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
