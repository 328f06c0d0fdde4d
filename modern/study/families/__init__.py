"""Families of point sets, from which the samples of a study are drawn.

A family is a function ``family(draw, **parameters) -> Drawn``.  The function returns distinct points as decimal text of
at most eight significant digits, which a card holds exactly.  The function draws integers only, so that a seed gives
the same points on every machine.  :data:`FAMILIES` names the built-in families.  ``module:function`` names a
user-defined family.

To add a family:

1. Write the function in ``scattered.py`` (points drawn one by one, prisms, pyramids, nearly flat sets), ``thesis.py``
   (sets like those of the thesis) or ``given.py`` (sets that are not drawn).  ``draws.py`` provides the random numbers.
   ``hull1620 study --families`` prints the function's docstring.
2. Enter it in :data:`FAMILIES`.
3. Describe its parameters in a row of ``docs/how-to/own-study.md``, and add parameters for the tests to ``DRAWN`` in
   ``tests/modern/study/test_study_families.py``.
"""

import inspect
from collections.abc import Callable, Mapping
from contextlib import nullcontext
from random import Random

from modern.formats.deck import coordinate_field
from modern.study.families import given, scattered, thesis
from modern.study.families.draws import Draw, Drawn, FamilyError
from modern.study.plan import Cell, PlanError, named, user_code

Family = Callable[..., Drawn]

FAMILIES: Mapping[str, Family] = {
    "thesis": thesis.thesis,
    "integers": scattered.integers,
    "box": scattered.box,
    "decimals": scattered.decimals,
    "ball": scattered.ball,
    "sphere": scattered.sphere,
    "cube": scattered.cube,
    "prism": scattered.prism,
    "pyramid": scattered.pyramid,
    "near-coplanar": scattered.near_coplanar,
    "published": given.published,
    "points": given.points,
}


def family_of(name: str) -> Family:
    """Return the built-in family called ``name``, or the user's function if the name is ``module:function``.

    Raise PlanError if there is no such function.
    """
    return named("family", name, FAMILIES)


def check_keywords(name: str, parameters: Mapping[str, object]) -> None:
    """Raise PlanError if a family does not accept these parameters.

    The message names the parameters that the family accepts.
    """
    signature = inspect.signature(family_of(name))
    try:
        signature.bind(None, **_keywords(parameters))
    except TypeError as error:
        raise PlanError(
            f"family {name}: {error}; its parameters are {', '.join(list(signature.parameters)[1:])}"
        ) from None


def draw_sample(cell: Cell, study: int, index: int) -> Drawn:
    """Draw a sample of a cell; ``study`` is the seed of the study.

    Raise PlanError for wrong parameters, and FamilyError if the family cannot draw such points.
    """
    family = family_of(cell.family)
    draw = Draw(Random(int(cell.seed(study, index), 16)), index)
    where = f"cell {cell.name}: family {cell.family}"
    in_module = user_code(where, cell.family.partition(":")[0])
    try:
        with nullcontext() if cell.family in FAMILIES else in_module:
            drawn = family(draw, **_keywords(cell.parameters))
    except (TypeError, ValueError) as error:
        raise PlanError(f"{where}: {error}") from None
    except FamilyError as error:
        raise FamilyError(f"{where}: {error}") from None
    if not isinstance(drawn, Drawn):
        raise PlanError(
            f"{where}: expected Drawn, found {type(drawn).__name__}; "
            "modern.study.drawn(points) makes it from integers, modern.study.Drawn(points) from decimals as text"
        )
    check_points(drawn, f"{where}: sample {index}")
    return drawn


def check_points(drawn: Drawn, where: str) -> None:
    """Raise FamilyError if there are no points, two points are equal, or a point does not fit a card (FORMAT E14.8)."""
    cards = set()
    for number, point in enumerate(drawn.points, 1):
        try:
            cards.add(tuple(coordinate_field(x).replace("-.00000000", "+.00000000") for x in point))
        except ValueError as error:
            raise FamilyError(f"{where}: point {number}: {error}") from None
    if not cards:
        raise FamilyError(f"{where}: there are no points")
    if len(cards) < len(drawn.points):
        raise FamilyError(f"{where}: two points are equal; the programs of the thesis require distinct points")


def _keywords(parameters: Mapping[str, object]) -> dict[str, object]:
    return {name.replace("-", "_"): value for name, value in parameters.items()}
