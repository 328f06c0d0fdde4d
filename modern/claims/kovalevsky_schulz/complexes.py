"""Checks of Kovalevsky and Schulz on cell complexes: the definitions of the appendix, and topological coordinates.

A cell of a Cartesian complex is the tuple of its topological coordinates.  An even coordinate 2 k is the point k of its
axis (a 0-cell), and an odd one, 2 k + 1, is the interval from k to k + 1 (a 1-cell).  The voxel (x, y, z) is the cell
(2 x + 1, 2 y + 1, 2 z + 1).
"""

from collections.abc import Iterable, Iterator
from functools import cache
from itertools import combinations, combinations_with_replacement, product

from modern.claims.evidence import Check, claim, exhausted, proved, search
from modern.claims.hulls import exact_hull
from modern.claims.kovalevsky_schulz.voxels import KINDS, SOLIDS, STEPS, Voxels
from modern.claims.sampled_sets import Point
from modern.digital.solids import Volume, listed
from modern.geometry.vectors import minus
from modern.papers.kovalevsky_schulz import VERTICES
from modern.papers.kovalevsky_schulz.corners import Of, places

Cell = tuple[int, ...]
# The dimensions of the cells of a complex, and its bounding relation as pairs of cells; cells are numbered from 0.
Complex = tuple[tuple[int, ...], frozenset[tuple[int, int]]]


def dimension(cell: Cell) -> int:
    return sum(c % 2 for c in cell)


def sides(cell: Cell) -> set[Cell]:
    """Return the cells that bound a cell."""
    return {*product(*((c - 1, c, c + 1) if c % 2 else (c,) for c in cell))} - {cell}


def star(cell: Cell) -> set[Cell]:
    """Return the smallest neighbourhood of a cell: the cell and all cells that it bounds (Definition SON)."""
    return {*product(*((c,) if c % 2 else (c - 1, c, c + 1) for c in cell))}


def closure(cells: Iterable[Cell]) -> set[Cell]:
    """Return the smallest closed set that contains the given cells (Definition CL)."""
    return {side for cell in cells for side in (cell, *sides(cell))}


def interior(cells: set[Cell]) -> set[Cell]:
    """Return the greatest open subset of a set of cells (Definition IN)."""
    return {cell for cell in cells if star(cell) <= cells}


def farthest_ground_cell(cell: Cell) -> Cell:
    """Return the cell farthest from the origin among the cells of the highest dimension that the given cell bounds."""
    return max(product(*((c,) if c % 2 else (c - 1, c + 1) for c in cell)), key=sum)


def _halved(cells: Iterable[Cell], dimension_: int) -> set[Cell]:
    """Return the coordinates of the cells of one dimension, divided by 2 and rounded down."""
    return {tuple(c // 2 for c in cell) for cell in cells if dimension(cell) == dimension_}


def _complex(solid: Iterable[Point]) -> set[Cell]:
    """Return all cells of the complex M of a solid: its voxels and the cells that bound them."""
    return closure((2 * x + 1, 2 * y + 1, 2 * z + 1) for x, y, z in solid)


def _placed(solid: Voxels, of: Of) -> set[Cell]:
    """Return the array elements at which the program marks a solid's voxels or their corners, as ``of`` selects."""
    volume = listed(solid)
    return {*map(tuple, Volume(places(volume, of), volume.origin).coordinates().tolist())}


@claim("kovalevsky-schulz.25", full=4_000)
def interior_and_closure(cases: int = 3) -> Check:
    def agrees(solid: Voxels) -> bool:
        cells = _complex(solid)
        parts = zip(KINDS, (sorted(interior(cells)), sorted(cells)), (3, 0), strict=True)
        return all(
            {dimension(part[k]) for k in exact_hull(part).vertices} == {kind}
            and _halved(part, kind) == _placed(solid, of)
            for of, part, kind in parts
        )

    check = search(SOLIDS, agrees, cases, "Int(M) has the hull of its voxels, and Cl(M) that of the voxels' vertices")
    space, voxel = _complex([(0, 0, 0), (1, 0, 0)]), _complex([(0, 0, 0)])
    corners = len(exact_hull(sorted(cell for cell in voxel if star(cell) & space <= voxel)).vertices)
    return check.unless(corners > 1, f"one voxel in a space of two, whose interior has a hull with {corners} vertices")


@claim("kovalevsky-schulz.174", full=4_000)
def additional_labels(cases: int = 3) -> Check:
    def agrees(solid: Voxels) -> bool:
        added = _halved((farthest_ground_cell(c) for c in _complex(solid) if dimension(c) == 0), 3) - {*solid}
        away = all(any(minus((x, y, z), step) in solid for step in STEPS) for x, y, z in added)
        return _placed(solid, VERTICES) - {*solid} == added and away and max(map(sum, added)) > max(map(sum, solid))

    return search(SOLIDS, agrees, cases, "each labelled element outside V is next to a voxel of V nearer to the origin")


@claim("kovalevsky-schulz.27")
def cells_of_a_block() -> Check:
    steps = []
    for x, y, z in product(range(1, 5), repeat=3):
        cells = _complex(product(range(x), range(y), range(z)))
        eight = sum(farthest_ground_cell(cell) in cells for cell in cells)
        steps += [eight == 8 * x * y * z, len(cells) == eight + 4 * (x * y + y * z + z * x) + 2 * (x + y + z) + 1]
    message = "a block of x y z voxels has 8 x y z + 4 (x y + y z + z x) + 2 (x + y + z) + 1 cells, of which 8 x y z "
    message += "have the coordinates of voxels; if x, y and z grow, the number of cells for each voxel tends to 8"
    argument = "Both numbers have degree 1 in x, y and z, because n voxels on an axis have n 1-cells and n + 1 0-cells."
    check, one = proved(argument, steps, message), len(_complex([(0, 0, 0)]))
    return check.unless(one > 16, f"a single voxel, whose complex has {one} cells")


@claim("kovalevsky-schulz.175")
def edges_at_a_0_cell() -> Check:
    plane = {*product(range(5), repeat=2)}
    numbers = [sum(dimension(f) == 1 for f in star(cell) & plane) for cell in plane if dimension(cell) == 0]
    space = sum(dimension(cell) == 1 for cell in star((2, 2, 2)))
    message = f"a 0-cell is incident to {min(numbers)} to {max(numbers)} 1-cells in a plane, and to {space} in space"
    return exhausted("0-cells of a block of four pixels", [2 <= number <= 4 for number in numbers], message)


@claim("kovalevsky-schulz.139", "kovalevsky-schulz.140", "kovalevsky-schulz.110")
def incidence_by_coordinates() -> Check:
    cells = [*product(range(5), repeat=3)]
    points = {cell: [(c // 2, (c + 1) // 2) for c in cell] for cell in cells}
    near = {cell: star(cell) | sides(cell) for cell in cells}
    intervals = [(k, k + length) for length in (0, 1) for k in range(3 - length)]
    outcomes = [sorted(points.values()) == sorted(map(list, product(intervals, repeat=3)))]
    outcomes += [dimension(cell) == sum(low < high for low, high in points[cell]) for cell in cells]
    # A cell bounds another one if its corners are corners of the other cell.
    pairs = [*product(cells, repeat=2)]
    corners = {cell: {*product(*points[cell])} for cell in cells}
    within = {(e, f) for e, f in pairs if corners[e] <= corners[f]}
    outcomes += [bool({(e, f), (f, e)} & within) == (f in near[e]) == (e in near[f]) for e, f in pairs]
    outcomes.append(any(near[f] - near[e] for e in cells for f in near[e] & {*cells}))
    message = f"each of {len(cells)} cells has one element, whose index tells the cell's dimension and incident cells; "
    message += "incidence is symmetric and reflexive, but not transitive"
    return exhausted("cells of a block of eight voxels, which a raster repeats, and pairs of these", outcomes, message)


@claim("kovalevsky-schulz.32", "kovalevsky-schulz.138")
def cells_with_common_coordinates() -> Check:
    dimensions: dict[Cell, list[int]] = {}
    # The cells beyond the last voxels belong to ground cells outside the block.
    for cell in product(range(8), repeat=3):
        dimensions.setdefault(farthest_ground_cell(cell), []).append(dimension(cell))
    outcomes = [sorted(of_voxel) == [0, 1, 1, 1, 2, 2, 2, 3] for of_voxel in dimensions.values()]
    message = "eight cells have the coordinates of each voxel, as many as a byte has bits; one of the eight is a 0-cell"
    return exhausted("the voxels of a block of 64, which a raster repeats", outcomes, message)


@cache
def is_complex(cells: Complex) -> bool:
    """Return True if the relation is transitive and cells bound only cells of higher dimension (Definition ACC)."""
    # Such a relation is antisymmetric and irreflexive, too.
    dimensions, relation = cells
    rises = all(dimensions[e] < dimensions[f] for e, f in relation)
    return rises and all((e, g) in relation for e, f in relation for f_, g in relation if f == f_)


def complexes(k: int) -> Iterator[Complex]:
    """Yield all k-complexes (Definition ACC: of cells of dimensions up to k) with up to four cells, by dimension."""
    for count in range(5):
        for dimensions in combinations_with_replacement(range(k + 1), count):
            rising = [(e, f) for e, f in combinations(range(count), 2) if dimensions[e] < dimensions[f]]
            relations = (frozenset(pairs) for size in range(len(rising) + 1) for pairs in combinations(rising, size))
            yield from (cells for relation in relations if is_complex(cells := (dimensions, relation)))


def subcomplex(cells: Complex, subset: set[int]) -> Complex:
    """Return the subcomplex with the given cells and the bounding relation between them (Definition SC)."""
    dimensions, relation = cells
    numbers = {cell: number for number, cell in enumerate(sorted(subset))}
    pairs = ((numbers[e], numbers[f]) for e, f in relation if {e, f} <= subset)
    return tuple(dimensions[cell] for cell in numbers), frozenset(pairs)


@claim("kovalevsky-schulz.136")
def subcomplexes() -> Check:
    outcomes, all_complexes = [], {*complexes(3)}
    for dimensions, relation in all_complexes:
        for size in range(len(dimensions) + 1):
            for chosen in combinations(range(len(dimensions)), size):
                restricted = {(i, j) for i, j in product(range(size), repeat=2) if (chosen[i], chosen[j]) in relation}
                part = tuple(dimensions[cell] for cell in chosen), frozenset(restricted)
                outcomes.append(part in all_complexes and subcomplex((dimensions, relation), {*chosen}) == part)
    message = f"each of {len(outcomes)} sets of cells determines one subcomplex: the restricted relation is transitive"
    return exhausted("sets of cells of the 3-complexes with up to 4 cells", outcomes, message)


def connected(cells: Complex) -> set[tuple[int, int]]:
    """Return the pairs of connected cells, which are incident or both connected to a third cell (Definition CN)."""
    numbers = range(len(cells[0]))
    pairs = {(e, f) for e, f in product(numbers, repeat=2) if e == f or {(e, f), (f, e)} & cells[1]}
    while new := {(e, f) for (e, c), (f, c_) in product(pairs, repeat=2) if c == c_} - pairs:
        pairs |= new
    return pairs


@claim("kovalevsky-schulz.141")
def connected_by_paths() -> Check:
    outcomes = []
    for cells in complexes(3):
        group = [*range(len(cells[0]))]
        for e, f in cells[1]:
            group = [group[f] if g == group[e] else g for g in group]
        expected = {(e, f) for e, f in product(range(len(group)), repeat=2) if group[e] == group[f]}
        outcomes.append(connected(cells) == expected)
    domain = "3-complexes with up to 4 cells"
    return exhausted(domain, outcomes, "two cells are connected if and only if a path of incident cells joins them")
