"""Butler's three programs as one modern procedure that runs in any arithmetic.

:mod:`modern.port.procedure` is the entry point and calls the other modules. :mod:`~modern.port.points` reads the input,
and :mod:`~modern.port.outcome` converts the result to the data of a hull. :mod:`~modern.port.opening` is program 1,
:mod:`~modern.port.polygon` is program 2, :mod:`~modern.port.polyhedron` is program 3, and :mod:`~modern.port.growth` is
the loop that programs 2 and 3 share.

To add an arithmetic for the port:

1. Write a subclass of :class:`modern.port.arithmetic.Arithmetic` in ``binary.py`` or ``exact.py``. If the emulator
   already provides the arithmetic, ``hosted.py`` adapts it, and at most the conversion of a coordinate needs another
   branch in ``hosted.py``.
2. Name it in ``NAMES`` and construct it in ``fixed_arithmetic``, both in ``points.py``.
3. Test it in ``tests/modern/port/test_port_floats.py``, or in ``test_port_cards.py`` if the emulator can run the
   programs in it too.

A decimal arithmetic that differs from the existing ones only in its digits or its rounding needs no change here. Add
its ``Profile`` in ``emulator/numbers/arithmetic.py``. The programs and the port then both provide it.
"""

from modern.geometry.hull import HullRefused
from modern.geometry.numbers import PointsError
from modern.port.arithmetic import RangeError
from modern.port.procedure import convex_hull

__all__ = ["HullRefused", "PointsError", "RangeError", "convex_hull"]
