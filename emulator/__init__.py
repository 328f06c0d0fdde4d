"""An emulator of the IBM 1620 as a FORTRAN programmer used it.

It covers cards, compiler, interpreter, arithmetic, FORMAT, devices and timing.  :mod:`hull1620` lists its public names.
"""

# Part of the distribution hull1620.
