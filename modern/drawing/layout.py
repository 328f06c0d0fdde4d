"""Convert the exact positions of points in a picture to integers, in hundredths of a pixel."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from modern.drawing.scene import Scene
from modern.drawing.view import Flat

MARGIN = 44
_HIGHEST, _LOWEST = 460, 40
_TOGETHER = 250


@dataclass(frozen=True, slots=True)
class Pixel:
    """A position in the picture, in hundredths of a pixel, y downward."""

    x: int
    y: int

    @property
    def place(self) -> tuple[float, float]:
        return self.x / 100, self.y / 100


@dataclass(frozen=True, slots=True)
class Layout:
    """The size of a picture in pixels, including its margins, and the positions of its points.

    ``vertices``, ``boundary`` and ``inside`` are the positions of the three kinds of points.
    """

    width: int
    height: int
    vertices: tuple[Pixel, ...]
    boundary: tuple[Pixel, ...]
    inside: tuple[Pixel, ...]
    # Groups of vertices that lie within 2.5 pixels and share a label.
    groups: tuple[tuple[int, ...], ...]


def lay_out(picture: Scene, width: int) -> Layout:
    """Return the positions of a scene's points in a picture of ``width`` pixels, with one scale for both axes.

    The height without the margins is at most 460 pixels or 0.72 times the width, whichever is larger.
    """
    marks = (*picture.boundary, *picture.inside)
    pixel, height = fit(
        [*picture.images, *(mark.image for mark in marks)], width, max(_HIGHEST, width * _HIGHEST // 640)
    )
    vertices = tuple(pixel(image) for image in picture.images)
    return Layout(
        width,
        height,
        vertices,
        tuple(pixel(mark.image) for mark in picture.boundary),
        tuple(pixel(mark.image) for mark in picture.inside),
        _groups(vertices),
    )


def fit(images: Sequence[Flat], width: int, highest: int, margin: int = MARGIN) -> tuple[Callable[[Flat], Pixel], int]:
    """Return a function that converts positions to pixels, and the height of the picture.

    The scale is the largest one at which all positions fit into a picture with a margin of ``margin`` pixels on each
    side. The width of the picture, including both margins, is ``width`` pixels. Its height without margins is at most
    ``highest`` pixels.
    """
    x_min, x_max = _ends(image[0] for image in images)
    y_min, y_max = _ends(image[1] for image in images)
    available = width - 2 * margin
    scales = [
        Fraction(size) / extent for size, extent in ((available, x_max - x_min), (highest, y_max - y_min)) if extent
    ]
    scale = min(scales, default=Fraction(0))
    tall = max(_LOWEST, -int(-(y_max - y_min) * scale // 1))

    def pixel(image: Flat) -> Pixel:
        x = (image[0] - (x_min + x_max) / 2) * scale + Fraction(width, 2)
        y = ((y_min + y_max) / 2 - image[1]) * scale + Fraction(tall, 2) + margin
        return Pixel(round(100 * x), round(100 * y))

    return pixel, tall + 2 * margin


def _ends(numbers: Iterable[Fraction]) -> tuple[Fraction, Fraction]:
    values = list(numbers)
    return min(values), max(values)


def _groups(vertices: Sequence[Pixel]) -> tuple[tuple[int, ...], ...]:
    groups: list[list[int]] = []
    for place, vertex in enumerate(vertices):
        # A vertex belongs to the first group whose first vertex is near enough.
        for group in groups:
            first = vertices[group[0]]
            if (first.x - vertex.x) ** 2 + (first.y - vertex.y) ** 2 <= _TOGETHER**2:
                group.append(place)
                break
        else:
            groups.append([place])
    return tuple(tuple(group) for group in groups)
