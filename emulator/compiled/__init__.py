"""The compiled engine, which runs one program on many decks: an interpreter on integers only, compiled by numba.

``batch.py`` is the interface.  ``runner.py`` converts programs and decks to arrays.  numba compiles ``deck.py``,
``devices.py`` and ``kernel.py``.  A deck that needs an unsupported operation runs on
:class:`emulator.machine.machine.Machine` instead.
"""
