"""Translation of a program to C, to Fortran for a modern compiler, or to FPCore.

``steps.py`` reads the object code as assignments, decisions and lists, and ``writers.py`` writes them in a language.
"""
