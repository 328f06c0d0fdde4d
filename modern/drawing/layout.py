"""A scene on paper: exact images to pixels, in hundredths."""

from __future__ import annotations

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
    """A place in the picture, in hundredths of a pixel, y downward."""

    x: int
    y: int

    @property
    def place(self) -> tuple[float, float]:
        return self.x / 100, self.y / 100


@dataclass(frozen=True, slots=True)
class Layout:
    """Where everything of a scene lies; ``width`` and ``height`` of the picture in pixels, margins and all."""

    width: int
    height: int
    vertices: tuple[Pixel, ...]
    boundary: tuple[Pixel, ...]
    inside: tuple[Pixel, ...]
    groups: tuple[tuple[int, ...], ...]
    """Vertices by place, those together that lie within 2.5 pixels and share a label."""


def lay_out(picture: Scene, width: int) -> Layout:
    """Fit a scene into ``width`` pixels, and at most 460 high or some seven tenths of the width, true to scale."""
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
    """The map of images to pixels that fits them into ``width``, and ``highest`` without the margins, true to scale;
    and the height with the margins."""
    left, right = _ends(image[0] for image in images)
    low, high = _ends(image[1] for image in images)
    room = width - 2 * margin
    scales = [Fraction(size) / extent for size, extent in ((room, right - left), (highest, high - low)) if extent]
    scale = min(scales, default=Fraction(0))
    tall = max(_LOWEST, -int(-(high - low) * scale // 1))

    def pixel(image: Flat) -> Pixel:
        x = (image[0] - (left + right) / 2) * scale + Fraction(width, 2)
        y = ((low + high) / 2 - image[1]) * scale + Fraction(tall, 2) + margin
        return Pixel(round(100 * x), round(100 * y))

    return pixel, tall + 2 * margin


def _ends(numbers: Iterable[Fraction]) -> tuple[Fraction, Fraction]:
    found = list(numbers)
    return min(found), max(found)


def _groups(vertices: Sequence[Pixel]) -> tuple[tuple[int, ...], ...]:
    groups: list[list[int]] = []
    for place, vertex in enumerate(vertices):
        for group in groups:
            first = vertices[group[0]]
            if (first.x - vertex.x) ** 2 + (first.y - vertex.y) ** 2 <= _TOGETHER**2:
                group.append(place)
                break
        else:
            groups.append([place])
    return tuple(tuple(group) for group in groups)
