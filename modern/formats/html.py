"""Write a hull as HTML: a self-contained page on which the reader can rotate it.

The template ``hull.html`` contains the page.  The hull turns when the reader drags it or presses an arrow key; the
mouse wheel and the keys + and - change its size, and 0 restores the first view.  Without JavaScript the page shows a
notice and a table of the exact vertices.
"""

import json
from html import escape
from importlib.resources import files
from string import Template

from modern.geometry.mesh import ExportError, Mesh


def write(mesh: Mesh, digits: int | None = None) -> str:
    """Return the page as HTML.  Coordinates without a finite decimal expansion are rounded to ``digits`` digits."""
    try:
        points = [[float(number) for number in point] for point in mesh.numbers()]
    except OverflowError:
        raise ExportError("a coordinate is too large for a picture in binary floats") from None
    # The picture shows the hull centred at the origin and scaled to a largest extent of 1.
    low, high = ([bound(column) for column in zip(*points, strict=True)] for bound in (min, max))
    size = max((b - a for a, b in zip(low, high, strict=True)), default=0.0) or 1.0
    middle = [a / 2 + b / 2 for a, b in zip(low, high, strict=True)]
    scaled = [[round((x - m) / size, 9) for x, m in zip(point, middle, strict=True)] for point in points]
    rows = "".join(
        f"<tr><td>{number}</td>" + "".join(f"<td>{escape(text)}</td>" for text in line.split()) + "</tr>"
        for number, line in enumerate(mesh.decimals(digits), 1)
    )
    faces, edges = [list(face) for face in mesh.faces], [list(edge) for edge in mesh.edges()]
    page = files("modern.formats").joinpath("hull.html").read_text(encoding="utf-8")
    return Template(page).substitute(
        title=f"Convex hull: {len(points)} vertices, {len(edges)} edges, {len(faces)} faces",
        rows=rows,
        data=json.dumps(
            {"points": scaled, "faces": faces, "edges": edges, "solid": mesh.dimension == 3}, separators=(",", ":")
        ),
    )
