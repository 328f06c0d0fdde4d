"""The compiler of 1620 FORTRAN, from a deck of cards to object code.  Nothing in this package runs a program.

A deck passes through ``cards.py`` (card code), ``statements.py`` (statements and their kinds), ``parser.py`` with
``dialect.lark`` and ``formats.py`` (syntax tree of ``tree.py``), and ``compiler.py`` with ``expressions.py`` and
``storage.py`` (the object code of ``objectcode.py``).  ``control_flow.py`` warns about doubtful branches.

To add a kind of statement, make these additions and changes:

1. ``tree.py``: a frozen dataclass with the manual's page, and its name in ``Body``.
2. ``dialect.lark``: a rule for the text of the statement without its number and blanks.
3. ``statements.py``: a row of ``_PREFIXES`` that names the rule.  The first prefix with which the text begins selects
   the rule.
4. ``parser.py``: the rule in ``_FORMS``, with the statement's form for messages and its error type, and a method of
   ``_Builder`` that makes the dataclass.  A rule named like a keyword of Python needs an alias (``-> if_``).
5. ``foreign.py``: remove the statement if this module lists it as a statement of another FORTRAN.
6. ``compiler.py``: a case of ``_Translation._body`` that emits operations, an entry of ``_NO_DO_END`` if no DO may end
   with the statement, and an entry of ``_EFFECTS`` if a trace should show its effect.  mypy reports an error until the
   case exists.
7. ``emulator/translation/steps.py`` and ``writers.py``: a step, if the statement needs a new operation.
8. Only if no existing operation fits, add one.  The name and the meaning of the operation belong in ``objectcode.py``
   (``MEANINGS``, and the names below it in the same order).  Its action belongs in ``emulator/machine/interpreter.py``,
   or in ``session.py`` or ``devices.py`` if it concerns the operator or a device.  Repeat the action in
   ``emulator/compiled/kernel.py``, or let ``emulator/compiled/deck.py`` return ``NOT_HERE``.  Its time belongs in
   ``emulator/machine/timing.py``.  If the operation branches, it also needs cases in ``flatten`` and in ``successors``
   of ``control_flow.py``.  If it has several targets, it also needs an entry in ``_DECISIONS`` of
   ``emulator/machine/comparison.py``.
9. Tests: ``tests/emulator/language/`` (``test_statements.py``, ``test_parser.py``, ``test_compiler_code.py``,
   ``test_compiler_messages.py``), ``tests/emulator/test_period.py``, which runs programs on both engines, and
   ``tests/support/decks_at_random.py``.

To add a FORMAT code that transfers a number, make these additions and changes:

1. ``emulator/numbers/fields.py``: its letter in ``FieldKind``, and functions that read and write the field, with the
   column arithmetic in ``emulator/numbers/columns.py``, and for IBM's library of 1962 in
   ``emulator/numbers/columns1962.py``.
2. ``formats.py``: the letter in ``_KINDS`` and its widths in ``_Reader.one``.  Remove it from ``FOREIGN_FIELDS`` in
   ``foreign.py``.  In ``_Reader.one``, also add the letter to the message that lists the codes and to the test for
   decimals.
3. ``emulator/machine/devices.py`` and ``emulator/compiled/devices.py``: call the new functions in the action of the
   operation ITEM.  The constants at the top of ``compiled/devices.py``, and ``_KINDS`` and ``WAYS`` in
   ``compiled/runner.py``, number the kinds.  ``_check_mode`` and its callers in ``machine/devices.py``, and the same
   tests in ``compiled/devices.py`` and in the runtimes, assume that every code except I transfers a floating-point
   number.  If the new code transfers a fixed-point number, add it to these tests.
4. ``emulator/translation/runtime.c`` and ``runtime.f90``: read and write the field.
5. ``ibm1962.py``: the digit of the letter in ``KINDS``, for object decks.
6. ``emulator/machine/timing.py``: the times of reading and writing the field.
7. ``docs/reference/fortran.md``: a row of the table of FORMAT codes.
8. Tests: ``tests/emulator/language/test_formats.py`` and ``tests/emulator/numbers/test_fields.py``.

A code that transfers no number, like X and H, is a class next to ``Literal`` in ``formats.py`` and a member of
``Spec``.  Such a code needs a case in ``_pass_spec`` of ``emulator/machine/forms.py``, ``_forms`` of
``emulator/compiled/runner.py``, both ``devices.py``, ``layout`` of ``emulator/translation/writers.py`` and its
runtimes, and in ``FormatSpec.widths`` and ``positions``.
"""
