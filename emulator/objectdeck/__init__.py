"""Object decks for a real 1620: programs translated to the code that IBM's compiler of 1962 punched.

``digits.py`` writes digits with flags and defines the entry points of the library's arithmetic routines,
``addresses.py`` translates operands and subscripts, ``generator.py`` translates a program, ``extent.py`` measures the
program, and ``cards.py`` punches the object deck.  ``job.py`` writes jobs for two compilers of the 1960s, and
``check_job.py`` is the script that compares the cards of such a job with the expected cards.  ``square_root.py``
contains this project's routine for SQRT, because no known copy of the library contains IBM's routine.  The rules come
from the only known object deck of IBM's compiler (docs/reference/object-decks.md).

To add a library function: write its routine as ``square_root.py`` does, and add it to ``ROUTINES`` in ``generator.py``.
"""
