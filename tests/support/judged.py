"""Sets of points, runs of the programs, and their comparison with the exact hull, for the tests of the later layers."""

import math
import random
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction

from emulator.errors import EmulatorError
from emulator.language.cards import Deck
from emulator.machine.result import Options
from modern.edition import programs
from modern.exact_hull import ExactHull, exact_hull
from modern.formats.deck import data_deck, with_epsilon
from modern.thesis.batch import run_hulls
from modern.thesis.cards import CardHull, read_hull
from modern.thesis.job import HullRun, run_hull

Point = tuple[int, int, int]
OPTIONS = Options(core=60_000, limit=5_000_000)


def deck_of(points: Sequence[Sequence[int | str]], e: str = "") -> Deck:
    """Return a data deck: the card with N (and e), and a card for each point."""
    deck = data_deck([list(map(str, point)) for point in points], "points")
    return with_epsilon(deck, e) if e else deck


def run(points: Sequence[Sequence[int | str]], *layers: str, e: str = "", options: Options = OPTIONS) -> HullRun:
    return run_hull(deck_of(points, e), programs.loader(layers), options)


def run_all(
    point_sets: Sequence[Sequence[Sequence[int | str]]], *layers: str, e: str = "", options: Options = OPTIONS
) -> list[HullRun | EmulatorError]:
    """Return what ``run`` returns for each set, or the error it raises, by the compiled engine if it is installed."""
    return run_hulls([deck_of(points, e) for points in point_sets], programs.loader(layers), options)


def lowest(coefficients: Sequence[Fraction | int]) -> tuple[int, ...]:
    """Return an equation as integers without a common divisor."""
    numbers = [Fraction(c) for c in coefficients]
    scale = math.lcm(*(c.denominator for c in numbers))
    integers = [int(c * scale) for c in numbers]
    return tuple(c // (math.gcd(*integers) or 1) for c in integers)


def unsigned(coefficients: Sequence[int]) -> tuple[int, ...]:
    """Return an equation with its first nonzero coefficient positive."""
    lead = next((c for c in coefficients if c), 1)
    return tuple(c if lead > 0 else -c for c in coefficients)


def faults(points: Sequence[Point], *layers: str) -> list[str]:
    """Return how a run differs from the exact hull; empty if it is right."""
    try:
        return differences(points, run(points, *layers))
    except EmulatorError as error:
        return [str(error)]


def faulty_sets(named_sets: Iterable[tuple[str, list[Point]]], *layers: str) -> dict[str, list[str]]:
    """Return the differences from the exact hull by the name of the set, for sets that have any."""
    names, point_sets = zip(*named_sets, strict=True)
    faulty = {}
    for name, points, hull_run in zip(names, point_sets, run_all(point_sets, *layers), strict=True):
        faults_of_run = [str(hull_run)] if isinstance(hull_run, EmulatorError) else differences(points, hull_run)
        if faults_of_run:
            faulty[name] = faults_of_run
    return faulty


def differences(points: Sequence[Point], hull_run: HullRun) -> list[str]:
    """Return how the punched hull differs from the exact one, one text for each kind of difference."""
    if not hull_run.complete:
        return [hull_run.refusal or hull_run.final.result.ending.message]
    judge, cards = exact_hull(points), read_hull(hull_run.final.result.punched)

    def coordinates(indices: Sequence[int]) -> Counter[tuple[Fraction, ...]]:
        return Counter(tuple(Fraction(c) for c in points[i]) for i in indices)

    messages = []
    if Counter(cards.vertices) != coordinates(judge.vertices):
        messages.append(f"vertices: {len(cards.vertices)}, not {len(judge.vertices)}")
    if judge.dimension > 1 and Counter(cards.boundary) != coordinates(judge.boundary):
        messages.append(f"boundary points: {len(cards.boundary)}, not {len(judge.boundary)}")
    if judge.dimension > 1 and Counter(cards.inside) != coordinates(judge.inside):
        messages.append(f"inside points: {len(cards.inside)}, not {len(judge.inside)}")
    exact_equations = equations(points, judge)
    expected = Counter(list(exact_equations))
    punched = Counter(lowest(c) if judge.dimension > 1 else unsigned(lowest(c)) for c in cards.equations)
    if judge.dimension > 1 and punched != expected:
        messages.append(f"equations: {sum(punched.values())}, not {sum(expected.values())}, or different ones")
    if judge.dimension > 1 and not messages and satisfied(cards) != exact_equations:
        messages.append("which vertices satisfy which equation")
    if judge.dimension == 2 and [unsigned(lowest(p)) for p in cards.plane] != [judge.plane]:
        messages.append("the plane")
    if judge.dimension == 1 and any(
        sum(a * b for a, b in zip(q, (*p, 1), strict=True)) for q in cards.equations for p in cards.vertices
    ):
        messages.append("the equations of the line")
    return messages


def satisfied(cards: CardHull) -> dict[tuple[int, ...], frozenset[tuple[Fraction, ...]]]:
    vertices: dict[tuple[int, ...], set[tuple[Fraction, ...]]] = {}
    for numbers, equation in cards.satisfied:
        key = lowest(cards.equations[equation - 1])
        vertices.setdefault(key, set()).update(cards.vertices[v - 1] for v in numbers)
    return {key: frozenset(members) for key, members in vertices.items()}


def equations(points: Sequence[Point], judge: ExactHull) -> dict[tuple[int, ...], frozenset[tuple[Fraction, ...]]]:
    """Return the planes with their vertices, or the lines of a polygon projected as in program 2."""
    if judge.dimension == 3:
        return {
            judge.plane_of(f): frozenset(tuple(Fraction(c) for c in points[i]) for i in f.polygon) for f in judge.facets
        }
    if judge.dimension != 2 or judge.plane is None:
        return {}
    dropped = next(k for k in range(3) if judge.plane[k])
    u, v = [k for k in range(3) if k != dropped]
    lines = {}
    for i, j in judge.edges():
        p, q = points[i], points[j]
        a, b = p[v] - q[v], q[u] - p[u]
        c = -a * p[u] - b * p[v]
        values = [a * points[k][u] + b * points[k][v] + c for k in judge.vertices]
        sign = -1 if max(values) > 0 else 1
        line = [0, 0, 0, sign * c]
        line[u], line[v] = sign * a, sign * b
        lines[lowest(line)] = frozenset(tuple(Fraction(c) for c in points[k]) for k in (i, j))
    return lines


# --- families of sets of distinct points with coordinates of at most two digits


def distinct(draw: Callable[[], Point], n: int) -> list[Point]:
    """Draw up to n distinct points of at most two digits, in the order drawn."""
    points: dict[Point, None] = {}
    for _ in range(40 * n):
        point = draw()
        if max(map(abs, point)) <= 99:
            points[point] = None
        if len(points) == n:
            break
    return list(points)


def integers(r: random.Random, n: int) -> list[Point]:
    a = r.choice((2, 3, 5, 9, 20, 50, 99))
    return distinct(lambda: (r.randint(-a, a), r.randint(-a, a), r.randint(-a, a)), n)


def grid(r: random.Random, n: int) -> list[Point]:
    sides = [r.randint(1, 3) for _ in range(3)]
    return distinct(lambda: (r.randint(0, sides[0]), r.randint(0, sides[1]), r.randint(0, sides[2])), n)


def sphere(r: random.Random, n: int) -> list[Point]:
    radius = r.choice((5, 20, 60, 99))

    def draw() -> Point:
        v = [r.gauss(0, 1) for _ in range(3)]
        length = math.hypot(*v) or 1.0
        x, y, z = (round(radius * c / length) for c in v)
        return x, y, z

    return distinct(draw, n)


def coplanar(r: random.Random, n: int) -> list[Point]:
    a = r.choice((1, 2, 4, 9))
    o, u, v = ([r.randint(-5, 5) for _ in range(3)] for _ in range(3))

    def draw() -> Point:
        s, t = r.randint(-a, a), r.randint(-a, a)
        x, y, z = (o[k] + s * u[k] + t * v[k] for k in range(3))
        return x, y, z

    return distinct(draw, n)


def collinear(r: random.Random, n: int) -> list[Point]:
    u = [r.randint(-3, 3) for _ in range(3)]

    def draw() -> Point:
        t = r.randint(-30, 30)
        return t * u[0], t * u[1], t * u[2]

    return distinct(draw, n)


def on_edges(r: random.Random, n: int) -> list[Point]:
    """Draw corners, and points on the lines through pairs of them: midpoints and points beyond."""
    corners = [(r.randint(-8, 8) * 2, r.randint(-8, 8) * 2, r.randint(-8, 8) * 2) for _ in range(max(4, n // 3))]

    def draw() -> Point:
        (p, q), t = r.sample(corners, 2), r.choice((0, 1, 2, 3, 4, 6, -2))
        x, y, z = (p[k] + (q[k] - p[k]) * t // 2 for k in range(3))
        return x, y, z

    return distinct(draw, n)


def prism(r: random.Random, n: int) -> list[Point]:
    base = coplanar(r, max(3, n // 2))
    u = [r.randint(-9, 9) for _ in range(3)]
    points = [*base, *((p[0] + u[0], p[1] + u[1], p[2] + u[2]) for p in base)]
    return list(dict.fromkeys(p for p in points if max(map(abs, p)) <= 99))[:n]


def symmetric(r: random.Random, n: int) -> list[Point]:
    """Draw points with all changes of sign and cyclic changes of axes: cubes, octahedra and the like."""
    points: dict[Point, None] = {}
    while len(points) < n:
        a, b, c = (r.choice((0, 0, 1, 2, 3, 7, 40)) for _ in range(3))
        for p in ((a, b, c), (b, c, a), (c, a, b)):
            for k in range(8):
                x, y, z = ((-1) ** (k >> i & 1) * p[i] for i in range(3))
                points[x, y, z] = None
    chosen = list(points)[:51]
    r.shuffle(chosen)
    return chosen


def flat(r: random.Random, n: int) -> list[Point]:
    """Draw points in two or three layers, nearly coplanar."""
    return distinct(lambda: (r.randint(-99, 99), r.randint(-99, 99), r.randint(-1, 1)), n)


def sheared(r: random.Random, n: int) -> list[Point]:
    """Draw points close to an inclined plane, so that planes are close to the point C."""
    a, b = r.uniform(-1, 1), r.uniform(-1, 1)

    def draw() -> Point:
        x, y = r.randint(-99, 99), r.randint(-99, 99)
        return x, y, round(a * x + b * y) + r.choice((0, 0, 0, 1, -1))

    return distinct(draw, n)


FAMILIES = (integers, grid, sphere, coplanar, collinear, on_edges, prism, symmetric, flat, sheared)


def sets(count: int, seed: int) -> Iterator[tuple[str, list[Point]]]:
    """Yield ``count`` sets of 4 to 51 distinct points from the families in turn, the same sets for the same seed."""
    made = 0
    for k in range(20 * count):
        if made == count:
            return
        r = random.Random(seed * 1_000_003 + k)
        family = FAMILIES[k % len(FAMILIES)]
        points = family(r, r.choice((4, 5, 6, 7, 8, 10, 13, 17, 22, 30, 40, 51)))
        if 4 <= len(points) <= 51:
            made += 1
            yield f"{family.__name__} {seed}/{k}", points
