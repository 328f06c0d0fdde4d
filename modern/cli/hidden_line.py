"""``hull1620 hidden-line``: draw convex polyhedra without their hidden lines."""

import argparse
import os
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from pathlib import PurePath

from emulator.errors import quoted
from emulator.files import source_name, write_text
from modern.cli.shared.console import OK, UsageError, counted, print_notes, print_report
from modern.cli.shared.inputs import read_input
from modern.drawing.scene import eye_of
from modern.geometry.coplanar import parse_distance
from modern.geometry.numbers import number
from modern.geometry.vectors import Vector
from modern.papers.nakamae_nishita import picture, scenes
from modern.papers.nakamae_nishita.bodies import Reading, read_bodies
from modern.papers.nakamae_nishita.hidden import Drawing, draw
from modern.papers.nakamae_nishita.polyhedron import SceneError
from modern.papers.nakamae_nishita.scenes import PERSPECTIVE, SceneFile, Sight

_PLOTS = (".hpgl", ".plt")
_MOST_NAMES = 5


def main(args: argparse.Namespace) -> int:
    output = args.output or (None if args.tables else "-")
    without = [name.strip() for name in args.without.split(",") if name.strip()]
    scene_file = _scene(args)
    _check_overwrites(output, scene_file.files)
    observer = _sight(args, scene_file.sight).observer(scene_file.make)
    drawing = draw(scene_file.make, observer, without, args.hidden)
    if output is not None:
        plot = output.lower().endswith(_PLOTS)
        title = scene_file.title if args.title is None else args.title
        write_text(output, picture.as_hpgl(drawing) if plot else picture.as_svg(drawing, title, args.width))
    if args.tables:
        print_report(args, picture.tables(drawing))
    print_notes(f"note: {note}" for note in (*scene_file.notes, *_near_plane_notes(drawing)))
    print_notes(picture.table1(drawing))
    return OK


def _scene(args: argparse.Namespace) -> SceneFile:
    """Read a scene of the project by name, a scene file, a file of faces, or a file of points whose hull is drawn."""
    path = args.scene
    if path in scenes.names() or PurePath(path).suffix.lower() == ".toml":
        if args.hull or args.coplanar_within is not None:
            raise UsageError(
                "--hull and --coplanar-within need a file of faces or points; "
                "in a scene file, set hull and coplanar_within"
            )
        return scenes.scene(path) if path in scenes.names() else scenes.read(path)
    within = None if args.coplanar_within is None else parse_distance(args.coplanar_within)
    reading = Reading(args.hull, within, True, as_hull="--hull", as_within="--coplanar-within E")
    bodies = read_bodies(read_input(path), source_name(path), reading)
    return scenes.of_polyhedra(bodies.polyhedra, PurePath(source_name(path)).name, bodies.notes)


def _check_overwrites(output: str | None, files: Sequence[str]) -> None:
    if output not in (None, "-") and os.path.realpath(str(output)) in {os.path.realpath(name) for name in files}:
        raise UsageError(
            f"{output}: this output is also a file of the scene, which would be overwritten; choose another name"
        )


def _near_plane_notes(drawing: Drawing) -> Iterator[str]:
    for effect, parts in (("cut by the near plane", drawing.cut), ("omitted behind the near plane", drawing.behind)):
        if parts:
            more = f" and {len(parts) - _MOST_NAMES} more" if len(parts) > _MOST_NAMES else ""
            yield f"{counted(len(parts), 'part')} {effect}: {', '.join(parts[:_MOST_NAMES])}{more}"


def _sight(args: argparse.Namespace, sight: Sight) -> Sight:
    """Return the view of the scene, changed by the options. Raise SceneError for options that do not fit together."""
    eye = None if args.eye is None else _vector(args.eye)
    towards = None if args.towards is None else _vector(args.towards)
    near = sight.near if args.near is None else _distance(args.near)
    if args.perspective:
        if eye is None:
            raise SceneError("--perspective needs the eye point: add --eye X,Y,Z")
        return Sight(eye, PERSPECTIVE, towards, near)
    for option, argument in (("--towards", towards), ("--near", args.near)):
        if argument is not None and sight.projection != PERSPECTIVE:
            raise SceneError(f"{option} needs --perspective; a parallel projection has only a direction")
    return replace(sight, eye=eye or sight.eye, towards=towards or sight.towards, near=near)


def _distance(text: str) -> Fraction:
    try:
        distance = number(text)
    except ValueError as error:
        raise SceneError(f"--near: {error}") from None
    if distance <= 0:
        raise SceneError(f"--near: expected a distance greater than 0, found {quoted(text)}")
    return distance


def _vector(text: str) -> Vector:
    x, y, z = eye_of(text.split(","))
    return x, y, z
