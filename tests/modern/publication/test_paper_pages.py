"""The pictures of the papers: their counts and lengths compared with the results of the papers."""

import math
from fractions import Fraction
from itertools import combinations

import pytest
from lxml import etree

from modern.digital.solids import ball
from modern.papers.appel_will import appel_will
from modern.papers.appel_will.results import found_solid
from modern.papers.nakamae_nishita.hidden import draw
from modern.papers.nakamae_nishita.scenes import scene
from modern.publication import steps
from modern.publication.site.made import make
from modern.publication.site.pages import papers
from modern.publication.steps import EDGE_OF_CONTOUR, REMOVED, SEEN, Plate

SVG = "{http://www.w3.org/2000/svg}"
NAMES = ("appel-will", "kovalevsky-schulz", "yau-srihari", "nakamae-nishita")


@pytest.fixture(scope="module", params=NAMES)
def html(request: pytest.FixtureRequest) -> etree._Element:
    """Parse the HTML of a paper as XML, which fails if its elements are not nested correctly."""
    made = make("papers", request.param)
    return etree.fromstring(f"<div>{''.join(part.html for part in made)}</div>")


def test_pictures_have_descriptions_and_unique_ids(html: etree._Element) -> None:
    ids = [str(id) for id in html.xpath("//@id")]
    assert len(set(ids)) == len(ids)
    pictures = html.findall(f".//{SVG}svg")
    assert len(pictures) >= 4
    for picture in pictures:
        assert picture.findtext(f"{SVG}title")
        assert picture.findtext(f"{SVG}desc")
        assert {picture.get("aria-labelledby"), picture.get("aria-describedby")} <= set(ids)
        assert int(picture.get("width", "")) <= 340


def test_line_widths_of_a_loop_show_the_uses() -> None:
    """Fig. 22 prints the uses (IUC) after each loop; at the end all are 2."""
    hull = appel_will(found_solid("fig14").points)
    for number, loop in enumerate(hull.table.loops, 1):
        picture = etree.fromstring(papers.loop_svg(hull, number))
        drawn = [int(line.get("data-uses", "")) for line in picture.iter(f"{SVG}line")]
        assert sorted(drawn) == sorted(loop.uses)
        numbers = [int(text.text or "") for text in picture.findall(f".//{SVG}g[@class='counts']/{SVG}text")]
        assert numbers == list(loop.uses)
    assert set(drawn) == {2}


def _length(plate: Plate, *kinds: str) -> float:
    """Return the length in space of all strokes of the given kinds."""
    return sum(math.dist(s.start, s.end) for s in plate.strokes if s.kind in kinds)


def test_steps_lack_what_is_removed_and_end_with_the_drawing() -> None:
    _, (everything, facing, nearer, result) = steps.hidden_lines()
    assert _length(everything, SEEN) == pytest.approx(_length(facing, SEEN, EDGE_OF_CONTOUR, REMOVED))
    assert _length(facing, SEEN, EDGE_OF_CONTOUR) == pytest.approx(_length(nearer, SEEN, REMOVED))
    assert _length(nearer, SEEN) == pytest.approx(_length(result, SEEN, REMOVED))
    assert all(plate.count(REMOVED) for plate in (facing, nearer, result))
    house = scene("house")
    drawing = draw(house.make, house.sight.observer(house.make))
    _, plates = steps.hidden_lines()
    assert plates[-1].count(SEEN) == len(drawing.pieces)


def test_the_cells_of_the_ball_satisfy_euler() -> None:
    """Count the voxels by their distance from the centre, and apply Euler's formula to the closed surfaces."""
    complexes = steps.cells()
    counts = dict(complexes.counts)
    radius = Fraction(steps.DIAMETER, 2)
    reach = range(-steps.DIAMETER, steps.DIAMETER + 1)
    inside = {(x, y, z) for x in reach for y in reach for z in reach if x * x + y * y + z * z <= radius**2}
    corners, edges, squares, voxels = counts["the ball's voxels and their boundary"]
    assert voxels == len(inside) == ball(steps.DIAMETER).count
    pairs = sum(sum(abs(p - q) for p, q in zip(a, b, strict=True)) == 1 for a, b in combinations(inside, 2))
    assert squares == 6 * voxels - 2 * pairs
    assert (corners - edges + squares, 4 * squares) == (2, 2 * edges)
    v, e, f, _ = counts["its hull, as triangles"]
    assert (e, f) == (3 * v - 6, 2 * v - 4)
    v, e, f, _ = counts["its hull, coplanar triangles merged"]
    assert v - e + f == 2
    _, vertices, lines, faces = complexes.plates
    assert (len(vertices.points), len(lines.strokes)) == (v, e)
    assert 0 < len(faces.panes) < f


def test_the_hull_of_three_rods_is_a_corner_of_the_grid() -> None:
    """The hull has the 120 voxels with x + y + z <= 7, a tetrahedral number."""
    hull, levels = steps.rods()
    n = steps.RODS
    assert (hull.solid_voxels, hull.voxels) == (3 * n - 2, n * (n + 1) * (n + 2) // 6)
    assert sum(level.full * (hull.side >> level.number) ** 3 for level in levels) == hull.voxels
    for level, above in zip(levels[1:], levels[:-1], strict=True):
        assert level.full + level.divided + level.empty == 8 * above.divided
        assert sum(quadrant.side**2 for quadrant in level.quadrants) == hull.side**2
        for quadrant in level.quadrants:
            height = n - 1 - quadrant.x - quadrant.y
            assert quadrant.height == (height if height >= 0 else None)
