"""OFF, the Object File Format of Geomview (manual, section "OFF Files"): polygons and decimal text, both kept.

A polyhedron is written with its faces, a polygon with one, a segment as two vertices and a point as one vertex,
without a face.  Read is the plain ASCII form: one vertex a line, one face a line, comments from ``#`` on.
"""

from __future__ import annotations

from emulator.errors import FileError
from emulator.files import read_text, source_name
from modern.formats.tokens import FileMesh, Word, count, decimal, error, last_line, point, take
from modern.formats.tokens import lines as worded
from modern.geometry.mesh import Mesh
from modern.geometry.numbers import Point, quoted


def write(mesh: Mesh, digits: int | None = None) -> str:
    """The text of an OFF file; faces keep all of their vertices.  Raises ExportError."""
    lines = ["OFF", f"{len(mesh.points)} {len(mesh.faces)} {len(mesh.edges())}", *mesh.decimals(digits)]
    lines += [" ".join(map(str, (len(face), *face))) for face in mesh.faces]
    return "".join(line + "\n" for line in lines)


def read_off(path: str) -> FileMesh:
    """The points and faces of an OFF file; see ``parse_off``.  Raises FileError with file, line and column."""
    return parse_off(read_text(path), source_name(path))


def parse_off(text: str, source: str) -> FileMesh:
    """An OFF file from its text.  The heading OFF may be missing, and so may the count of edges.

    Colours after a face are passed over.  Raises FileError with line and column for everything else: other
    kinds of OFF (``COFF``, ``OFF BINARY``), a vertex that is not three decimals, a face of vertices that are not
    there, too few lines or too many.
    """
    lines = worded(text)
    last = last_line(text)
    head = next(lines, None)
    if head is not None and head[1][0][0][:1].isalpha():
        line, words = head
        if words[0][0] != "OFF":
            raise error(source, line, words[0], f"{quoted(words[0][0])} is not read, only plain OFF")
        head = (line, words[1:]) if len(words) > 1 else next(lines, None)
    if head is None:
        raise FileError(f"{source}: line {last}, column 1: there are no counts of vertices and faces")
    line, words = head
    if not 2 <= len(words) <= 3:
        raise error(source, line, words[0], "the counts of vertices, faces and edges are due here")
    vertices, faces = [count(source, line, word) for word in words][:2]
    points: list[Point] = []
    places: list[int] = []
    for line, words in take(lines, vertices, source, last, "vertices"):
        if len(words) != 3:
            wrong = words[min(3, len(words) - 1)]
            raise error(source, line, wrong, f"a vertex is three numbers, x y z; here are {len(words)}")
        points.append(point(source, line, words))
        places.append(line)
    polygons = [_face(source, line, words, vertices) for line, words in take(lines, faces, source, last, "faces")]
    more = next(lines, None)
    if more is not None:
        raise error(source, more[0], more[1][0], "the last face has been read, and nothing is due after it")
    return FileMesh(source, tuple(points), tuple(places), tuple(polygons))


def _face(source: str, line: int, words: list[Word], vertices: int) -> tuple[int, ...]:
    size = count(source, line, words[0])
    if size < 1:
        raise error(source, line, words[0], "a face has at least one vertex")
    if len(words) <= size:
        raise error(source, line, words[-1], f"the face ends after {len(words) - 1} of {size} vertices")
    face = tuple(count(source, line, word) for word in words[1 : size + 1])
    for index, word in zip(face, words[1:], strict=False):
        if index >= vertices:
            raise error(source, line, word, f"there is no vertex {index}; they count from 0 to {vertices - 1}")
    for word in words[size + 1 :]:
        decimal(source, line, word)
    return face
