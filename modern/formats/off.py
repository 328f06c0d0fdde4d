"""Write and read OFF, the Object File Format of Geomview (manual, section "OFF Files"): polygons and decimal text.

A polyhedron is written with its faces, a polygon with one face, a segment as two vertices and a point as one vertex,
both without faces.  The reader accepts the plain ASCII form: one vertex or face in a line, comments after ``#``.
"""

from emulator.errors import FileError, quoted
from modern.formats.tokens import FileMesh, Token, count, decimal, error, last_line, take, vertex
from modern.formats.tokens import lines as token_lines
from modern.geometry.mesh import Mesh
from modern.geometry.numbers import Point


def write(mesh: Mesh, digits: int | None = None) -> str:
    lines = ["OFF", f"{len(mesh.points)} {len(mesh.faces)} {len(mesh.edges())}", *mesh.decimals(digits)]
    lines += [" ".join(map(str, (len(face), *face))) for face in mesh.faces]
    return "".join(line + "\n" for line in lines)


def parse_off(text: str, source: str) -> FileMesh:
    """Return the points and faces of an OFF file from its text.

    The heading OFF and the number of edges are optional, and colours after a face are ignored.  Raise FileError, with
    line and column, for other kinds of OFF (``COFF``, ``OFF BINARY``), for a vertex that is not three decimal numbers,
    for a face that names a vertex not in the file, and for too few or too many lines.
    """
    lines = token_lines(text)
    last = last_line(text)
    head = next(lines, None)
    if head is not None and head[1][0][0][:1].isalpha():
        line, tokens = head
        if tokens[0][0] != "OFF":
            raise error(
                source, line, tokens[0], f"{quoted(tokens[0][0])} is not supported; write the points as plain ASCII OFF"
            )
        # The numbers of vertices and faces may stand in the same line as the heading OFF.
        head = (line, tokens[1:]) if len(tokens) > 1 else next(lines, None)
    if head is None:
        raise FileError(f"{source}: line {last}, column 1: the numbers of vertices and faces are missing")
    line, tokens = head
    if not 2 <= len(tokens) <= 3:
        raise error(source, line, tokens[0], "expected the numbers of vertices, faces and edges")
    vertices, faces = [count(source, line, token) for token in tokens][:2]
    points: list[Point] = []
    point_lines: list[int] = []
    for line, tokens in take(lines, vertices, source, last, "vertices"):
        points.append(vertex(source, line, tokens))
        point_lines.append(line)
    polygons = [_face(source, line, tokens, vertices) for line, tokens in take(lines, faces, source, last, "faces")]
    extra = next(lines, None)
    if extra is not None:
        raise error(source, extra[0], extra[1][0], "expected the end of the file after the last face")
    return FileMesh(source, tuple(points), tuple(point_lines), tuple(polygons))


def _face(source: str, line: int, tokens: list[Token], vertices: int) -> tuple[int, ...]:
    size = count(source, line, tokens[0])
    if size < 1:
        raise error(source, line, tokens[0], "a face needs at least one vertex")
    if len(tokens) <= size:
        raise error(source, line, tokens[-1], f"the face ends after {len(tokens) - 1} of {size} vertices")
    face = tuple(count(source, line, token) for token in tokens[1 : size + 1])
    for index, token in zip(face, tokens[1:], strict=False):
        if index >= vertices:
            raise error(source, line, token, f"there is no vertex {index}; they are numbered from 0 to {vertices - 1}")
    for token in tokens[size + 1 :]:
        decimal(source, line, token)  # a colour
    return face
