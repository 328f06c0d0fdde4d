"""The formulas of chapter 3, in the listing's order of operations, for numbers and vectors of any arithmetic.

In ``a op b`` the left operand is the accumulator. The compiler computes a product into the accumulator and then adds
the pending sum to it, so ``t + a*b`` of the listing is written ``a*b + t`` here. It computes ``t - a*b`` as the
product less t with the sign reversed (:func:`less`). Therefore such a difference gives minus zero when the operands
cancel (emulator/language/expressions.py).
"""

from typing import Any

# A number or a vector of an arithmetic.
Number = Any
Point = tuple[Number, Number, Number]


def less(total: Number, product: Number) -> Number:
    """Return total - product as the compiler's reverse subtraction computes it."""
    return -(product - total)


def plane(p: Point, q: Point, r: Point) -> tuple[Number, Number, Number, Number]:
    """Return the coefficients A, B, C, D of the plane through three points: equations (3.4), thesis p. 16."""
    (xi, yi, zi), (xj, yj, zj), (xk, yk, zk) = p, q, r
    # Each coefficient is a sum of six products. The listing adds the three positive products first (AA, BB, CC and DD
    # after statement 130 of program 3) and then subtracts the three negative ones one by one.
    a = less(less(less(zi * yk + (yj * zk + yi * zj), yk * zj), yi * zk), yj * zi)
    b = less(less(less(xj * zi + (xi * zk + xk * zj), xi * zj), xj * zk), xk * zi)
    c = less(less(less(yi * xk + (xj * yk + xi * yj), yj * xk), xi * yk), xj * yi)
    d = xj * yi * zk + (yk * zj * xi + xk * yj * zi)
    d = less(less(less(d, xi * yj * zk), xj * yk * zi), yi * zj * xk)
    return a, b, c, d


def line(u1: Number, v1: Number, u2: Number, v2: Number, cu: Number, cv: Number) -> tuple[Number, Number, Number]:
    """Return the line A u + B v + C = 0 through two points, by (3.1) to (3.3) and (3.5).

    (cu, cv) is the one of the two points from which C is computed.
    """
    return v2 - v1, u1 - u2, (v1 - v2) * cu + (u2 - u1) * cv


def at(equation: tuple[Number, ...], point: tuple[Number, ...]) -> Number:
    """Return the value of an equation at a point: A x + B y + C z + D, or A x + B y + C."""
    # The listing adds from left to right, the constant term last.
    total = equation[0] * point[0]
    for k in range(1, len(point)):
        total = equation[k] * point[k] + total
    return total + equation[-1]


def moments(points: Point, p: Point, q: Point) -> tuple[Number, Number, Number]:
    """Return O1, O2, O3, whose squares add up to V, a measure of the distance from the line P1 P2 (thesis p. 15)."""
    (x, y, z), (x1, y1, z1), (x2, y2, z2) = points, p, q
    # Statements 125 to 226 of program 1: the components of the cross product of P2 - P and P2 - P1.
    o1 = less((y2 - y) * (z2 - z1), (z2 - z) * (y2 - y1))
    o2 = less((z2 - z) * (x2 - x1), (x2 - x) * (z2 - z1))
    o3 = less((x2 - x) * (y2 - y1), (y2 - y) * (x2 - x1))
    return o1, o2, o3


def distance_squared(u1: Number, v1: Number, u2: Number, v2: Number) -> Number:
    """Return (u1 - u2)**2 + (v1 - v2)**2 (thesis p. 27)."""
    u, v = u1 - u2, v1 - v2
    return v * v + u * u
