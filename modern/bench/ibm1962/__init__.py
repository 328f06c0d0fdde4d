"""Run IBM's own FORTRAN library of 1962 in a simulator of the 1620, and compare the emulator with it.

The object deck of 1962 is not part of the project.  Set the environment variable OBJECT_DECK to its file, and I1620 to
the command of the simulator (default: ``i1620`` of the package simh).  ``python -m modern.bench.ibm1962`` repeats the
comparisons of docs/reference/ibm-library.md.  The wheel does not contain this package.
"""
