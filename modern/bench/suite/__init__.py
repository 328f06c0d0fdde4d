"""Benchmarks of the project that no command needs. The wheel does not contain this package.

Run ``python -m modern.bench.suite`` for every group, or name groups: ``python -m modern.bench.suite digital papers``.
"""
