"""An emulator of the IBM 1620 as a FORTRAN programmer used it.

It consists of the compiler, the interpreter with its devices, the arithmetics, and a model of the machine's time.
:mod:`hull1620` lists the public names.
"""

# Part of the distribution hull1620.
