"""``hull1620 hidden-line``: convex polyhedra drawn without their hidden lines."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from pathlib import PurePath

from emulator.files import check_writable, source_name, write_text
from modern.cli.shared.console import OK, UsageError, counted, say
from modern.cli.shared.inputs import read_given
from modern.drawing.scene import eye_of
from modern.geometry.coplanar import parse_distance
from modern.geometry.numbers import number, quoted
from modern.geometry.vectors import Vector
from modern.papers.nakamae_nishita import picture, report
from modern.papers.nakamae_nishita.bodies import Reading, read_bodies
from modern.papers.nakamae_nishita.hidden import Drawing, draw
from modern.papers.nakamae_nishita.polyhedron import SceneError
from modern.papers.nakamae_nishita.scenes import (
    PERSPECTIVE,
    SceneFile,
    Sight,
    names,
    of_polyhedra,
    read,
    scene,
)

_PLOTS = (".hpgl", ".plt")
_MOST_NAMES = 5


def main(args: argparse.Namespace) -> int:
    """Read the scene, find what is hidden, print what is asked for, write the picture."""
    output = args.output or (None if args.tables else "-")
    check_writable(output)
    without = [name.strip() for name in args.without.split(",") if name.strip()]
    found = _scene(args)
    _check_overwrites(output, found.files)
    observer = _sight(args, found.sight).observer(found.make)
    drawing = draw(found.make, observer, without, args.hidden)
    if output is not None:
        plot = output.lower().endswith(_PLOTS)
        title = found.title if args.title is None else args.title
        write_text(output, picture.as_hpgl(drawing) if plot else picture.as_svg(drawing, title, args.width))
    if args.tables:
        sys.stdout.writelines(line + "\n" for line in report.tables(drawing))
    say(f"note: {note}" for note in (*found.notes, *_near(drawing)))
    say(report.table1(drawing))
    return OK


def _scene(args: argparse.Namespace) -> SceneFile:
    """A scene of the project by name, a scene file, a file of faces, or the hull of points."""
    path = args.scene
    if path in names() or PurePath(path).suffix.lower() == ".toml":
        if args.hull or args.coplanar_within is not None:
            raise UsageError("--hull and --coplanar-within are for a file of faces or points; a scene file has fields")
        return scene(path) if path in names() else read(path)
    within = None if args.coplanar_within is None else parse_distance(args.coplanar_within)
    reading = Reading(args.hull, within, True, as_hull="--hull", as_within="--coplanar-within E")
    found = read_bodies(read_given(path), source_name(path), reading)
    return of_polyhedra(found.polyhedra, PurePath(source_name(path)).name, found.notes)


def _check_overwrites(output: str | None, files: Sequence[str]) -> None:
    """Refuse an output that is a file of the scene.  Raises UsageError."""
    if output not in (None, "-") and os.path.realpath(str(output)) in {os.path.realpath(name) for name in files}:
        raise UsageError(f"{output}: is a file of the scene too; an output never overwrites it")


def _near(drawing: Drawing) -> Iterator[str]:
    """What the near plane did."""
    for done, found in (("cut by the near plane", drawing.cut), ("behind the near plane, left out", drawing.behind)):
        if found:
            more = f" and {len(found) - _MOST_NAMES} more" if len(found) > _MOST_NAMES else ""
            yield f"{counted(len(found), 'part')} {done}: {', '.join(found[:_MOST_NAMES])}{more}"


def _sight(args: argparse.Namespace, sight: Sight) -> Sight:
    """The scene's own view, but for what the options say."""
    eye = None if args.eye is None else _vector(args.eye)
    towards = None if args.towards is None else _vector(args.towards)
    near = sight.near if args.near is None else _distance(args.near)
    if args.perspective:
        if eye is None:
            raise SceneError("--perspective needs the observation point, --eye X,Y,Z")
        return Sight(eye, PERSPECTIVE, towards, near)
    for option, given in (("--towards", towards), ("--near", args.near)):
        if given is not None and sight.projection != PERSPECTIVE:
            raise SceneError(f"{option} is for a perspective; a parallel projection has a direction only")
    return replace(sight, eye=eye or sight.eye, towards=towards or sight.towards, near=near)


def _distance(text: str) -> Fraction:
    """Raises SceneError."""
    try:
        found = number(text)
    except ValueError as error:
        raise SceneError(f"--near: {error}") from None
    if found <= 0:
        raise SceneError(f"--near: {quoted(text)} is not a distance greater than 0")
    return found


def _vector(text: str) -> Vector:
    x, y, z = eye_of(text.split(","))
    return x, y, z
