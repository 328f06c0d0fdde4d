"""Speed, measured: each figure is the median of five runs beside what it is measured against.

``python -m benchmarks`` runs all of them.  Nothing here is a test.
"""
