"""The worked examples of theorems 4.1, 4.2 (Table 1) and 4.8, checked by exact arithmetic."""

import dataclasses
from dataclasses import replace
from fractions import Fraction

import pytest

from modern.claims.apparatus_checks import chapter4_faults
from modern.edition.apparatus import Row, build
from modern.edition.chapter4 import Theorem, load_text, load_theorems, printed_plane, printed_point, theorem_faults

TEXT = load_text()
THEOREMS = {theorem.id: theorem for theorem in load_theorems()}


@pytest.mark.parametrize("theorem", THEOREMS.values(), ids=lambda t: t.id)
def test_theorem_is_tied_to_the_print_and_true(theorem: Theorem) -> None:
    assert theorem_faults(theorem, TEXT) == ()


def test_lost_and_outside_points_of_theorems_are_those_of_the_print() -> None:
    theorem = THEOREMS["4.1"]
    assert theorem.point("P3") is None
    assert "P3" in theorem.lost
    assert theorem.extremes["ly"] == "P3"
    assert not any("P_3=" in "".join(line.text.split()) for line in build(TEXT) if int(line.id) < 30)
    theorem = THEOREMS["4.8"]
    point = theorem.point("Q9")
    assert point is not None
    assert point.at == (Fraction(-2, 135), Fraction(1, 9), Fraction(-1, 10))
    assert [p.number for p in theorem.planes if p.at(point) > 0] == [3, 4, 5, 6, 7, 8]
    faults = theorem_faults(THEOREMS["4.8"], replace(TEXT, default=("ocr",)))
    assert faults == (
        "theorem 4.8: line 88 does not print (-4, 4, 2)",
        "theorem 4.8: the table does not list Q6 for plane 2",
    )
    theorem = THEOREMS["4.8"]
    first = theorem.points[0]
    slip = dataclasses.replace(first, at=printed_point("(-4, -4, 2)"))
    mine = [p for p in theorem.planes if first.name in p.vertices]
    assert [p.number for p in mine] == [1, 2, 7]
    assert all(p.at(first) == 0 != p.at(slip) for p in mine)


def test_table_1_faces_use_every_vertex_and_close_up() -> None:
    """Eight triangles on six points: each edge is on two faces (Table 1)."""
    edges: dict[frozenset[str], int] = {}
    for plane in THEOREMS["4.2"].planes:
        for vertex in plane.vertices:
            edge = frozenset(set(plane.vertices) - {vertex})
            edges[edge] = edges.get(edge, 0) + 1
    assert len(edges) == 12
    assert set(edges.values()) == {2}


@pytest.mark.parametrize("row", [r for r in TEXT.rows if r.ground["kind"] == "sibling"], ids=lambda r: r.id)
def test_row_is_needed(row: Row) -> None:
    """The words stand in the sibling line and, only with the row, in its own."""
    assert chapter4_faults(TEXT, row) == ()
    wrong = replace(row, ground={**row.ground, "words": ["no such words"]})
    assert chapter4_faults(TEXT, wrong) == (f"row {row.id}: the ground that it gives does not hold",)


def test_two_term_conditions_of_theorem_4_2_are_a_slip() -> None:
    """As printed A7 x + B7 y + C7 is positive at P6 though stated negative; with z and D it is negative."""
    (row,) = [r for r in TEXT.rows if r.ground["kind"] == "arithmetic"]
    theorem = THEOREMS[row.ground["theorem"]]
    plane, point = theorem.plane(row.ground["equation"]), theorem.point(row.ground["point"])
    assert point is not None
    a, b, c, _ = plane.coefficients
    assert a * point.at[0] + b * point.at[1] + c > 0 > plane.at(point)
    for line in build(TEXT):
        if line.id in row.ground["lines"]:
            assert "D_" in line.text
            assert "z_" in line.text
    for line in build(TEXT, without=(row.id,)):
        if line.id in row.ground["lines"]:
            assert "D_" not in line.text
            assert "z_" not in line.text


@pytest.mark.parametrize("theorem", THEOREMS.values(), ids=lambda t: t.id)
def test_guard_an_altered_coefficient_is_caught(theorem: Theorem) -> None:
    plane = theorem.planes[0]
    wrong = dataclasses.replace(plane, coefficients=(plane.coefficients[0] + 1, *plane.coefficients[1:]))
    faults = theorem_faults(dataclasses.replace(theorem, planes=(wrong, *theorem.planes[1:])), TEXT)
    assert f"theorem {theorem.id}: plane 1 differs from {plane.printed}" in faults
    assert any("does not contain" in fault for fault in faults)


@pytest.mark.parametrize("theorem", THEOREMS.values(), ids=lambda t: t.id)
def test_guard_an_altered_point_is_caught(theorem: Theorem) -> None:
    point = theorem.points[-1]
    wrong = dataclasses.replace(point, at=(point.at[0] + 30, *point.at[1:]))
    faults = theorem_faults(dataclasses.replace(theorem, points=(*theorem.points[:-1], wrong)), TEXT)
    assert f"theorem {theorem.id}: {point.name} differs from {point.printed}" in faults


def test_guard_a_wrong_sign_and_extreme_are_caught() -> None:
    theorem = THEOREMS["4.2"]
    wrong = dataclasses.replace(theorem, signs=((7, "P4", "-"),), extremes={"lx": "P2"}, points_stated=7)
    assert theorem_faults(wrong, TEXT) == (
        "theorem 4.2: the text states 7 points, the data have 6",
        "theorem 4.2: P2 is not the extreme lx",
        "theorem 4.2: plane 7 has the value 30 at P4, the text states -",
    )


@pytest.mark.parametrize(
    ("words", "plane"),
    [
        ("2x - 5y + 14z = 0", (2, -5, 14, 0)),
        ("y - 4 = 0", (0, 1, 0, -4)),
        ("-28x - 19y - 18z = 0", (-28, -19, -18, 0)),
        ("80x - 3y + 100z - 400 = 0", (80, -3, 100, -400)),
    ],
)
def test_printed_plane(words: str, plane: tuple[int, ...]) -> None:
    assert printed_plane(words) == tuple(Fraction(n) for n in plane)
