"""Families of point sets: a name, parameters and a generator give points a card can hold, exactly.

A family is a function ``family(draw, **parameters) -> Drawn``.  All of them draw by integers only, so that the same
seed gives the same points on every machine, and give distinct points as decimal text of at most eight significant
digits.  FAMILIES names those that come with hull1620; ``module:function`` names one of a user's own.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from modern.formats.deck import coordinate_field
from modern.study.families import given, scattered, solids, thesis
from modern.study.families.draws import Draw, Drawn, FamilyError
from modern.study.plan import Cell, PlanError, named, own_code, random_of

Family = Callable[..., Drawn]

FAMILIES: Mapping[str, Family] = {
    "thesis": thesis.thesis,
    "integers": scattered.integers,
    "box": scattered.box,
    "decimals": scattered.decimals,
    "ball": scattered.ball,
    "sphere": scattered.sphere,
    "cube": scattered.cube,
    "prism": solids.prism,
    "pyramid": solids.pyramid,
    "near-coplanar": solids.near_coplanar,
    "published": given.published,
    "points": given.points,
}


def family_of(name: str) -> Family:
    """The family of that name, or the function ``module:function``.  Raises PlanError."""
    return named("family", name, FAMILIES)


def draw_sample(cell: Cell, study: int, index: int) -> Drawn:
    """A cell's sample of that index.

    Raises PlanError for parameters the family does not take, FamilyError where they give no such points.
    """
    family = family_of(cell.family)
    draw = Draw(random_of(cell.seed(study, index)), index)
    try:
        if cell.family in FAMILIES:
            drawn = family(draw, **_keywords(cell.parameters))
        else:
            with own_code(f"cell {cell.name}: family {cell.family}", cell.family.partition(":")[0]):
                drawn = family(draw, **_keywords(cell.parameters))
    except (TypeError, ValueError) as error:
        raise PlanError(f"cell {cell.name}: family {cell.family}: {error}") from None
    except FamilyError as error:
        raise FamilyError(f"cell {cell.name}: family {cell.family}: {error}") from None
    if not isinstance(drawn, Drawn):
        raise PlanError(
            f"cell {cell.name}: family {cell.family}: it gives {type(drawn).__name__}, not Drawn; "
            "modern.study.drawn(points) makes it of whole numbers, modern.study.Drawn(points) of decimals as text"
        )
    check_points(drawn, f"cell {cell.name}: family {cell.family}: sample {index}")
    return drawn


def check_points(drawn: Drawn, where: str) -> None:
    """Raises FamilyError where points are none, are not distinct or do not fit a card (eight digits of E14.8)."""
    cards = set()
    for number, point in enumerate(drawn.points, 1):
        try:
            cards.add(tuple(coordinate_field(x).replace("-.00000000", "+.00000000") for x in point))
        except ValueError as error:
            raise FamilyError(f"{where}: point {number}: {error}") from None
    if not cards:
        raise FamilyError(f"{where}: there are no points")
    if len(cards) < len(drawn.points):
        raise FamilyError(f"{where}: two points are the same; the thesis takes distinct points")


def _keywords(parameters: Mapping[str, object]) -> dict[str, object]:
    return {name.replace("-", "_"): value for name, value in parameters.items()}
