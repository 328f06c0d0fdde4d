"""Mutants: copies of the code with one small change each, which the tests of its area must notice.

``make mutants`` draws a seeded sample of the mutants of each area of ``areas.toml`` and runs the area's tests on each
mutant in a copy of the tree. It writes to ``build/mutants`` a table ``AREA.csv`` and, in the folder ``AREA``, a diff of
each mutant that survived. A survivor needs a test, or an entry in ``equivalent.toml`` that states why no test can tell
it from the code. cosmic-ray makes the changes. ``python -m tests.mutants --help`` lists the options.
"""
