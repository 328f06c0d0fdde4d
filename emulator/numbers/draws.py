"""Random rounding: the random numbers of stochastic arithmetic, and the rounding of an integer with one of them.

Each operation that may round its result uses one random number of the run, even if the result is exact.  Operation n
(from 1 on) of a run with seed s uses ``draw(key_of(s), n)``.  The numbers are therefore the same on every machine and
in every engine, and any operation can be recomputed separately.

Three rules of rounding are defined.  f is the part of a result beyond its last digit, in units of that digit, and
0 <= f < 1.  A result with f = 0 is exact and is not rounded.

- ``CESTAC``: round away from zero with probability 1/2, otherwise toward zero (J. Vignes, A stochastic arithmetic for
  reliable scientific computation, Math. Comput. Simulation 35 (1993) 233-261; the rule of CADNA).
- ``OPPOSITE``: round in the direction opposite to that of ``CESTAC`` with the same random number.  CADNA rounds each
  operation of its third run in the opposite direction to its second run, so that one inexact operation always makes two
  runs differ.
- ``PROPORTIONAL``: round away from zero with probability f, so that the expected error is zero.  This is the random
  rounding (RR) of Monte Carlo arithmetic (D. S. Parker, Monte Carlo arithmetic, UCLA CSD-970002, 1997) and the
  stochastic rounding (SR) of M. Croci et al., Stochastic rounding: implementation, error analysis and applications,
  R. Soc. Open Sci. 9 (2022) 211631.

The functions use only integers, so that numba can compile them.
"""

from __future__ import annotations

# The rules of rounding, as values of ``Rules.random``; 0 stands for arithmetic that is not random.
CESTAC, PROPORTIONAL, OPPOSITE = 1, 2, 3
# A draw is an integer from 0 to DRAWS - 1.
DRAWS = 10**8
MAX_SEED = 2**32 - 1


def mix(word: int) -> int:
    """Return a 32-bit integer with its bits mixed by the finalizer of MurmurHash3 (A. Appleby, public domain)."""
    # The products may exceed 64 bits, which compiled code drops; the mask keeps only the lowest 32 bits anyway.
    word ^= word >> 16
    word = word * 0x85EBCA6B & 0xFFFFFFFF
    word ^= word >> 13
    word = word * 0xC2B2AE35 & 0xFFFFFFFF
    return word ^ word >> 16


def key_of(seed: int) -> int:
    """Return the number derived from a seed that :func:`draw` expects as its first argument."""
    return mix(seed ^ 0x9E3779B9)


def draw(key: int, count: int) -> int:
    """Return the random number for operation ``count`` of a run, counted from 1.  ``key`` belongs to the run's seed."""
    return mix(mix(count & 0xFFFFFFFF) ^ key) * DRAWS >> 32


def randomly(size: int, unit: int, lost: int, rule: int, drawn: int) -> int:
    """Return ``size / unit``, rounded at random to one of the neighbouring integers.  ``size`` must not be negative.

    ``lost`` is 0 if ``size`` is exact.  It is 1 if the exact value exceeds ``size`` by less than ``unit / DRAWS``.
    """
    whole = size // unit
    rest = size - whole * unit
    if rest == 0 and lost == 0:
        return whole
    if rule != PROPORTIONAL:
        return whole + (1 if (2 * drawn >= DRAWS) == (rule == CESTAC) else 0)
    # Round away from zero if f > drawn / DRAWS.  If both are equal and digits were lost, f is larger.
    over = rest * DRAWS - drawn * unit
    return whole + (1 if over > 0 or (over == 0 and lost) else 0)
