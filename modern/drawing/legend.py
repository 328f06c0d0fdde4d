"""Draw the legend below a picture: its caption, the meaning of its marks, and the directions of the axes."""

from collections.abc import Iterator
from fractions import Fraction

from modern.drawing import svg
from modern.drawing.layout import MARGIN, Pixel
from modern.drawing.scene import Scene
from modern.drawing.svg import BOUNDARY, BOUNDARY_HIDDEN, HIDDEN, INSIDE, VERTEX_HIDDEN, VISIBLE, Style, sample
from modern.drawing.view import root
from modern.geometry.vectors import dot

_KINDS = ("Point", "Segment", "Polygon", "Polyhedron")
_STEP, _LETTER, _AXES = 19, 8, 60
_WIDEST = 6.8
_ARM, _SHORTEST, _BEYOND = 2200, 300, 800
_LARGEST = 10**9
_UNITS = tuple(tuple(Fraction(row == column) for column in range(3)) for row in range(3))


def band_height(picture: Scene, width: int, title: str, numbered: bool = True) -> int:
    rows = len(_rows(picture, width)) + sum(map(len, _text_lines(picture, width, title, numbered)))
    return max(_STEP * rows + 20, 76 if picture.dimension else 0)


def band(picture: Scene, width: int, top: int, title: str, numbered: bool) -> Iterator[str]:
    base = top + 12
    for lines, weight in zip(_text_lines(picture, width, title, numbered), ('font-weight="bold"', ""), strict=True):
        for line in lines:
            yield svg.text(Pixel(MARGIN * 100, base * 100), line, weight)
            base += _STEP
    for number, row in enumerate(_rows(picture, width)):
        base += _STEP * (number > 0)
        for x, style in row:
            yield sample(style, Pixel((x + 9) * 100, base * 100 - 450))
            yield svg.text(Pixel((x + 26) * 100, base * 100), style.name)
    if picture.dimension:
        yield from _axes(picture, Pixel((width - MARGIN - 16) * 100, (top + 34) * 100))


def wrapped(text: str, room: int) -> list[str]:
    """Break a text into lines of at most ``room`` pixels. Widths are estimated from the number of characters."""
    lines: list[str] = []
    for word in text.split():
        if lines and (len(lines[-1]) + 1 + len(word)) * _WIDEST <= room:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return lines


def _text_lines(picture: Scene, width: int, title: str, numbered: bool) -> tuple[list[str], list[str]]:
    room = width - 2 * MARGIN - (_AXES if picture.dimension else 0)
    return wrapped(title, room), wrapped(caption(picture) + ("" if numbered else "; vertices not numbered"), room)


def caption(picture: Scene) -> str:
    what = _KINDS[picture.dimension]
    if picture.dimension > 1:
        what += ": " + _count_of(len(picture.images), "vertex", "vertices")
    if picture.dimension > 2:
        what += f", {_count_of(len(picture.edges), 'edge', 'edges')}, {_count_of(picture.faces, 'face', 'faces')}"
    if picture.dimension == 0:
        return what
    if picture.chosen and picture.dimension < 3:
        return f"{what}; seen at right angles"
    eye = picture.view.eye
    return f"{what}; seen from {','.join(map(str, eye))}" if max(map(abs, eye)) < _LARGEST else what


def _count_of(count: int, singular: str, plural: str) -> str:
    return f"{count} {singular if count == 1 else plural}"


def _styles(picture: Scene) -> list[Style]:
    hidden = picture.behind and any(edge.hidden for edge in picture.edges)
    behind = [mark.hidden for mark in picture.boundary]
    present = (
        (VISIBLE, hidden),
        (HIDDEN, hidden),
        (VERTEX_HIDDEN, picture.behind and any(picture.hidden)),
        (BOUNDARY, not all(behind)),
        (BOUNDARY_HIDDEN, any(behind)),
        (INSIDE, bool(picture.inside)),
    )
    return [style for style, there in present if there]


def _rows(picture: Scene, width: int) -> list[list[tuple[int, Style]]]:
    """Return the marks of the legend with their horizontal positions, in rows that leave space for the axes."""
    rows: list[list[tuple[int, Style]]] = []
    x = width
    for style in _styles(picture):
        wide = 26 + _LETTER * len(style.name) + 16
        if x + wide > width - MARGIN - _AXES:
            rows.append([])
            x = MARGIN
        rows[-1].append((x, style))
        x += wide
    return rows


def _axes(picture: Scene, centre: Pixel) -> Iterator[str]:
    """Yield lines for the directions of x, y and z, with their names. Omit an axis that points nearly at the eye."""
    view = picture.view
    length = view.stretch * root(Fraction(dot(view.right, view.right)))
    for unit, name in zip(_UNITS, "xyz", strict=True):
        x, y = view.project((unit[0], unit[1], unit[2]))
        dx, dy = round(_ARM * x / length), -round(_ARM * y / length)
        size = max(abs(dx), abs(dy))
        if size < _SHORTEST:
            continue
        yield svg.line(centre, Pixel(centre.x + dx, centre.y + dy), 'stroke="#555"')
        end = Pixel(centre.x + dx + _BEYOND * dx // size, centre.y + dy + _BEYOND * dy // size + 400)
        yield svg.text(end, name, 'text-anchor="middle" font-style="italic" fill="#555"')
