"""The machine that runs compiled programs: interpreter, devices, operator, traces, timing, and comparison of two runs.

``machine.py`` runs a program with an operator (``operator.py``).  It uses ``session.py``, which runs a program in
slices and drives ``interpreter.py`` and ``devices.py``.  ``divergence.py`` compares two runs.

To add a kind of ending: add its name to ``Kind`` and its message to ``_trouble_in`` in ``endings.py``, and raise
``Ended`` in ``session.py`` or ``devices.py``.  If both engines return a reason for the ending, add the reason to
``ended_by``.

To add an action of the operator: add it to ``Action`` and ``Session.act`` in ``session.py``, its syntax to
``words.py``, and its line to ``docs/reference/operator.md``.  A command that only shows something belongs in
``console.py``.

To add an operation of the object code, see ``interpreter.py``.
"""
