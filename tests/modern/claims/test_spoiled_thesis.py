"""Claims of the thesis on spoiled ground: what is found is another verdict."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

import modern.claims.thesis.chapter2 as chapter2
import modern.claims.thesis.chapter3_equations as chapter3
import modern.claims.thesis.chapter3_stages as stages
import modern.claims.thesis.chapter3_steps as steps
import modern.claims.thesis.chapter4_examples as examples
import modern.claims.thesis.chapter4_theorems as proofs
import modern.claims.thesis.chapter7 as limits
from modern.claims.register import DOCUMENTS, FAILS, HOLDS, Seen, statements_of
from modern.claims.sampled_sets import SampledSet
from modern.edition.chapter6 import input_deck
from modern.formats.deck import data_deck
from tests.support.caches import cleared

Right = Any
Spoil = Callable[[Right], object]


@pytest.fixture(autouse=True)
def nothing_kept() -> Iterator[None]:
    """What a claim keeps is made anew, before the spoiled run and after it."""
    with cleared(chapter2, chapter3, stages, steps, examples, proofs, limits):
        yield


def always(value: object) -> Spoil:
    return lambda _: lambda *arguments, **named: value


def it_holds(_: Right) -> object:
    return lambda *arguments: Seen(HOLDS, "")


def it_fails(_: Right) -> object:
    return lambda *arguments: Seen(FAILS, "")


def turned_over(right: Right) -> object:
    return lambda *arguments: -right(*arguments)


def of_amounts(right: Right) -> object:
    return lambda *arguments: abs(right(*arguments))


def all_are_vertices(right: Right) -> object:
    def changed(points: Right) -> object:
        return replace(right(points), vertices=tuple(range(len(points))), boundary=(), inside=())

    return changed


def first_three_only(right: Right) -> object:
    return lambda points: replace(right(points), vertices=(0, 1, 2))


def flattened(right: Right) -> object:
    return lambda points: right([(x, y, 0) for x, y, _ in points])


def of_three_dimensions(right: Right) -> object:
    return lambda points: replace(right(points), dimension=3)


def judges_lacking_a_face(right: Right) -> object:
    """The sets' hulls have one face too few."""

    def changed(*arguments: Right) -> object:
        return tuple(
            SampledSet(one.points, one.hull, replace(one.judge, facets=one.judge.facets[1:]))
            for one in right(*arguments)
        )

    return changed


def hulls(change: Callable[[Right], Right]) -> Spoil:
    """The port's hull is changed."""
    return lambda right: lambda points, *arguments, **named: change(right(points, *arguments, **named))


def without_boundary(hull: Right) -> object:
    return replace(hull, boundary=())


def without_a_face(hull: Right) -> object:
    return replace(hull, faces=hull.faces[:-1])


def three_equations(hull: Right) -> object:
    *before, last = hull.history
    return replace(hull, history=(*before, replace(last, equations=last.equations[:3])))


def two_equations(hull: Right) -> object:
    *before, last = hull.history
    return replace(hull, history=(*before, replace(last, equations=last.equations[2:])))


def one_line_twice(hull: Right) -> object:
    return replace(hull, lines=(hull.lines[0], hull.lines[0]))


def without_the_last(right: Right) -> object:
    return lambda points, *arguments, **named: right(points[:-1], *arguments, **named)


def theorems(change: Callable[[Right], Right]) -> Spoil:
    """The data of a worked example are changed."""
    return lambda right: lambda name: change(right(name))


def planes_turned_over(theorem: Right) -> object:
    planes = (replace(p, coefficients=tuple(-c for c in p.coefficients)) for p in theorem.planes)
    return replace(theorem, planes=tuple(planes))


def another_order(theorem: Right) -> object:
    return replace(theorem, points=theorem.points[::-1])


def an_open_surface(theorem: Right) -> object:
    return replace(theorem, planes=theorem.planes[:-1])


def points(*found: tuple[int, int, int]) -> Spoil:
    """Another counterexample, which is none."""
    return lambda _: lambda name: [*found]


def another_deck(_: Right) -> object:
    return lambda name: limits.run_hull(input_deck(4), limits.programs.program)


def of_program_3(change: Callable[[str], str]) -> Spoil:
    """The listings are changed, card by card."""

    def spoil(right: Right) -> object:
        def deck(name: str) -> object:
            cards = [SimpleNamespace(text=change(card.text)) for card in right.deck(name).cards]
            return SimpleNamespace(cards=cards, text=lambda: "\n".join(card.text for card in cards))

        return SimpleNamespace(deck=deck, program=right.program)

    return spoil


def that_do_not_compile(right: Right) -> object:
    return SimpleNamespace(deck=right.deck, program=lambda name: SimpleNamespace(code=()))


def exactly(right: Right) -> object:
    return lambda rows, name: right(rows, "exact")


def full_cards(_: Right) -> object:
    return lambda rows, name: SimpleNamespace(cards=[SimpleNamespace(text="1" * 80)])


def a_z_that_is_right(_: Right) -> object:
    return lambda name: data_deck([["1", "1", "1"]] * 3, "right")


def with_two_lines_exchanged(right: Right) -> object:
    """y1 and y2 change places."""
    return lambda x1, y1, y2: right(x1, y2, y1)


def a_constant_more(right: Right) -> object:
    return lambda *arguments: (*right(*arguments)[:-1], right(*arguments)[-1] + 1)


def with_its_constant_turned(right: Right) -> object:
    return lambda *arguments: (*right(*arguments)[:-1], -right(*arguments)[-1])


def a_sum_for_a_product(_: Right) -> object:
    return lambda u, v: tuple(a + b for a, b in zip(u, v, strict=True))


SAME = ({0, 1}, {0, 1})


@pytest.mark.parametrize(
    ("module", "claim", "name", "spoil"),
    [
        (chapter2, "all_pairs", "sampled_sets", judges_lacking_a_face),
        (chapter2, "all_triples", "sampled_sets", judges_lacking_a_face),
        (chapter2, "all_triples_cost", "math", lambda _: SimpleNamespace(comb=lambda n, k: 1)),
        (chapter2, "hull_is_the_combinations", "_area", of_amounts),
        (chapter2, "rotations lines", "sampled_sets", judges_lacking_a_face),
        (chapter2, "rotations planes", "sampled_sets", judges_lacking_a_face),
        (chapter2, "supporting_lines", "value", turned_over),
        (chapter2, "vertex_in_space", "value", turned_over),
        (chapter2, "vertex_of_the_hull", "exact_hull", all_are_vertices),
        (chapter2, "weights_not_negative", "exact_hull", all_are_vertices),
        (chapter3, "collinear_ends", "convex_hull", lambda right: lambda given: right(given[:3])),
        (chapter3, "equation 3.1", "line_as_printed", a_constant_more),
        (chapter3, "equation 3.2", "line_as_printed", a_constant_more),
        (chapter3, "equation 3.3", "line_as_printed", a_constant_more),
        (chapter3, "equation 3.4", "plane_as_printed", a_constant_more),
        (chapter3, "equation 3.5", "line_of_page_19", a_constant_more),
        (chapter3, "procedure_is_right", "both", judges_lacking_a_face),
        (chapter3, "same_hull_in_any_order", "exact_hull", first_three_only),
        (stages, "eliminated", "convex_hull", hulls(without_boundary)),
        (steps, "between_by_distances", "_between", lambda right: lambda a, b, c, *far: right(b, a, c, *far)),
        (steps, "between_the_ends", "exact_hull", all_are_vertices),
        (steps, "choice_of_projection", "_image_area", always(0)),
        (steps, "coplanar_iff", "plane_as_printed", always((0, 0, 0, 0))),
        (steps, "doubled_lines", "convex_hull", hulls(two_equations)),
        (steps, "left_over 2", "exact_hull", all_are_vertices),
        (steps, "left_over 3", "exact_hull", all_are_vertices),
        (steps, "line_pairs 1", "convex_hull", hulls(one_line_twice)),
        (steps, "line_pairs 2", "convex_hull", hulls(one_line_twice)),
        (steps, "line_pairs 3", "convex_hull", hulls(one_line_twice)),
        (steps, "mean_is_inside", "dot", turned_over),
        (steps, "outside_below_zero", "points_of", points((1, 0, 0))),
        (steps, "perpendicular_projection", "_image_area", always(1)),
        (steps, "planes_of_a_vertex", "value", always(1)),
        (steps, "planes_of_a_vertex condition", "value", always(1)),
        (steps, "projection_leaves_one_coordinate_out", "cross", a_sum_for_a_product),
        (steps, "repeats_by_points", "convex_hull", hulls(without_a_face)),
        (steps, "taken_out", "convex_hull", hulls(three_equations)),
        (steps, "third_point", "_square", lambda right: lambda u: -right(u)),
        (steps, "three_parts", "value", turned_over),
        (steps, "used_but_no_vertex", "convex_hull", hulls(without_boundary)),
        (steps, "used_in_two_planes", "exact_hull", all_are_vertices),
        (steps, "value_v", "moments", always((1, 0, 0))),
        (steps, "visible_planes counts", "_shared", always(())),
        (steps, "visible_planes letter", "_separated", always(False)),
        (steps, "visible_planes names", "_same_places", always(True)),
        (steps, "visible_planes order", "convex_hull", without_the_last),
        (steps, "visible_planes pairs", "value", always(1)),
        (steps, "without_constant_term", "value", always(1)),
        (examples, "procedure_of_4_8", "convex_hull", without_the_last),
        (examples, "procedure_of_4_8 theorem", "convex_hull", without_the_last),
        (examples, "worked_example 4.1 equations condition", "theorem_of", theorems(planes_turned_over)),
        (examples, "worked_example 4.1 programs", "exact_hull", without_the_last),
        (examples, "worked_example 4.1 six_extremes", "exact_hull", flattened),
        (examples, "worked_example 4.2 equations", "theorem_of", theorems(planes_turned_over)),
        (examples, "worked_example 4.2 not_supporting", "_faces", always(set())),
        (examples, "worked_example 4.2 programs", "exact_hull", without_the_last),
        (examples, "worked_example 4.2 signs", "theorem_of", theorems(planes_turned_over)),
        (examples, "worked_example 4.8 equations", "theorem_of", theorems(planes_turned_over)),
        (examples, "worked_example 4.8 growing", "exact_hull", first_three_only),
        (examples, "worked_example 4.8 last_outside", "theorem_of", theorems(planes_turned_over)),
        (examples, "worked_example 4.8 programs", "NOT_ACCEPTABLE", lambda _: "error"),
        (examples, "worked_example 4.8 signs", "theorem_of", theorems(planes_turned_over)),
        (examples, "worked_example 4.8 supporting", "_faces", always(set())),
        (proofs, "choice_matters_for_4_7", "value", turned_over),
        (proofs, "combination_is_inside", "value", turned_over),
        (proofs, "constant_term_of_4_4", "through", a_constant_more),
        (proofs, "distance_by_cosines", "cross", a_sum_for_a_product),
        (proofs, "distance_by_cosines display", "cross", a_sum_for_a_product),
        (proofs, "distance_by_cosines substituted", "cross", a_sum_for_a_product),
        (proofs, "e_is_minus_one", "points_of", points((0, 0, 0), (0, 0, 1))),
        (proofs, "extremes_4_2", "theorem_of", theorems(another_order)),
        (proofs, "figure 1", "theorem_of", theorems(an_open_surface)),
        (proofs, "figure 2", "approximations", it_fails),
        (proofs, "figure 3", "lines_of_figure_3", it_fails),
        (proofs, "figure 4", "approximations", it_fails),
        (proofs, "inequalities_without_z", "points_of", points((0, 0, 0))),
        (proofs, "line_stays", "points_of", points((0, 0, 0), (4, 0, 0), (0, 4, 0), (5, 5, 0))),
        (proofs, "lines_of_figure_3", "_printed_lines", with_two_lines_exchanged),
        (proofs, "lines_of_figure_3 condition", "_printed_lines", with_two_lines_exchanged),
        (proofs, "proof_of_4_4 coefficient", "_c_0", lambda right: lambda a, b, k: right(a, b, k) + 1),
        (proofs, "proof_of_4_4 sum", "_c_0", lambda right: lambda a, b, k: right(a, b, k) + 1),
        (proofs, "none_below_the_origin", "value", turned_over),
        (proofs, "theorem_4_3", "value_v", it_fails),
        (proofs, "theorem_4_4", "exact_hull", all_are_vertices),
        (proofs, "theorem_4_5", "value", turned_over),
        (proofs, "theorem_4_7", "value", always(1)),
        (proofs, "three_are_coplanar", "exact_hull", of_three_dimensions),
        (limits, "constant_term_is_enough", "plane_through_c", it_holds),
        (limits, "constant_term_is_enough", "through", with_its_constant_turned),
        (limits, "data_sheet blank", "data_deck", full_cards),
        (limits, "data_sheet columns", "deck_of", a_z_that_is_right),
        (limits, "data_sheet digits", "coordinate_field", always("+.3000000E+01")),
        (limits, "data_sheet values", "coordinate_field", always("+.3000000E+01")),
        (limits, "each_program_fits", "CORE", lambda _: limits.SMALLER_CORE),
        (limits, "eight_digits", "coordinate_field", always("+.12345678E+01")),
        (limits, "fifty_one", "PLACES", lambda _: 200),
        (limits, "fifty_one", "_most_planes", always(98)),
        (limits, "fourth_point_missed", "_misses", always([])),
        (limits, "inside_heading", "programs", of_program_3(lambda text: text.replace("INSID=2", "INSID=1"))),
        (limits, "no_rounding", "take", exactly),
        (limits, "normalizing_an_equation", "at", always(0)),
        (limits, "notation", "programs", of_program_3(lambda text: text.replace("NETC", "NTC"))),
        (limits, "own_plane_missed", "_misses", always([])),
        (limits, "plane_through_c", "run_of", another_deck),
        (limits, "programs_compile", "programs", that_do_not_compile),
        (limits, "programs_compile condition", "programs", that_do_not_compile),
        (limits, "roots_that_do_not_add_up", "vertices_of", always(SAME)),
        (limits, "silent_loss", "vertices_of", always(SAME)),
        (limits, "three_programs_needed", "CORE", lambda _: 200_000),
        (limits, "translation_depends", "_equations_made", always(0)),
        (limits, "turned_by_c", "dot", turned_over),
        (limits, "turned_by_c", "plane_through_c", it_holds),
        (limits, "two_kinds_of_errors", "take", exactly),
        (limits, "two_kinds_of_errors device", "take", exactly),
        (limits, "value_is_no_distance", "at", always(1)),
        (limits, "where_data_are_refused", "THREE", lambda right: right[:2]),
    ],
)
def test_a_claim_on_spoiled_ground_has_another_verdict(
    module: ModuleType, claim: str, name: str, spoil: Spoil, monkeypatch: pytest.MonkeyPatch
) -> None:
    function, *arguments = claim.split()
    right = getattr(module, function)(*arguments).verdict
    with cleared(module), monkeypatch.context() as patch:
        patch.setattr(module, name, spoil(getattr(module, name)))
        spoiled = getattr(module, function)(*arguments).verdict
    assert spoiled != right


def test_every_claim_of_the_five_documents_is_spoiled_somewhere() -> None:
    """Each claim's function is named in a test beside this one."""
    texts = "".join(path.read_text(encoding="utf-8") for path in Path(__file__).parent.glob("test_*.py"))
    rows = (row for document in DOCUMENTS for row in statements_of(document))
    functions = {row.claim.split()[0].rpartition(".")[2] for row in rows if row.claim}
    assert sorted(name for name in functions if not re.search(rf'[".]{name}\b', texts)) == []
