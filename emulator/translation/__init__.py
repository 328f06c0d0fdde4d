"""Translate a program to C, to modern Fortran, or to FPCore.

``steps.py`` converts object code to assignments, decisions and lists, and ``writers.py`` writes these as C or Fortran.
"""
