"""The register of statements of the five documents, and the functions that compute the verdict of each statement.

Every statement is a row of ``transcripts/statements/DOCUMENT.toml``.  Its evidence is a *check*, a function of this
package that names the row, or a published *result* (:mod:`modern.claims.published`).  The fields are documented by
:class:`modern.claims.register.Statement` and in ``transcripts/README.md``.

To add a verdict on a statement:

1. Add a row to ``transcripts/statements/DOCUMENT.toml`` at its place in the order of the document, with the next unused
   number, under the name ``[NUMBER.PAGE]``.  ``words`` quotes at most eight words of the OCR text.  If the verdict is
   not "holds", the reason is in a field whose name tells the verdict (``condition``, ``fails``, ...).  A statement
   without such a field holds.
2. Write a check in the module of ``modern/claims/DOCUMENT/`` that deals with the subject: a function with the decorator
   ``claim`` that returns a :class:`~modern.claims.evidence.Check`.  Choose the constructor by what is computed:
   ``proved``, ``exhausted``, ``searched`` or ``search``, ``exhibited``, ``refuted``, ``slip``.  A function that returns
   a :class:`~modern.claims.algebra.Proof` has the decorator ``proves`` instead.  Sampled sets and counterexamples come
   from :mod:`modern.claims.sampled_sets`.  With ``full=N`` in ``claim``, the check also has a full search of N cases.
   Run ``make claims`` and commit its result in ``transcripts/statements/full.csv``.  The row says what the check
   computes.  The check needs a docstring only for what the row leaves out.
3. If the statement needs a condition, compute a case that violates the condition and refutes the statement, and add
   ``.unless(refutes, "the case")``.
4. If the verdict is "does not hold", put the smallest counterexample into ``transcripts/counterexamples/`` and name it
   in ``file``, or give the command that shows it in ``run``.
5. Run ``tests/modern/claims``.  The tests alter what each check relies on, and the verdict must then change.  If no
   automatic alteration changes it, add a spoiler to ``BY_HAND`` in ``test_spoiled_claims.py``.
6. Run ``hull1620 reproduce DOCUMENT.NUMBER``.

A row without a check has one of two verdicts.  If the verdict is "used", the field ``code`` names the code that follows
the statement.  If it is "not testable", the field ``untested`` gives the reason. A row that repeats another one names
its number in ``same`` and has no verdict.

To correct a verdict, change the field with its reason in the row, and the check.  The row records the verdict, and the
check computes it.  If the two differ, ``hull1620 reproduce`` and the tests fail.

To add a document (a paper needs more steps, see :mod:`modern.papers`):

1. Append its name to ``DOCUMENTS`` in :mod:`modern.claims.register` and in ``modern/cli/shared/arguments.py``, and
   write its register ``transcripts/statements/NAME.toml`` and its package of checks ``modern/claims/NAME/``.
2. If it prints results, add a witness, an apparatus and ``results.toml`` to the folder ``transcripts/NAME_YEAR/``.  Add
   the name of the folder to ``TEXTS`` in ``modern/cli/shared/arguments.py``, and describe it in
   ``transcripts/README.md``.  Add a module with
   a function ``produced`` to ``modern/papers/``, and a :class:`~modern.claims.published.Paper` to ``PAPERS``.
3. Describe the document and its text in ``fortran_src/SOURCES.toml``, which :mod:`modern.edition.sources` reads.
4. Add a page ``docs/statements/NAME.md`` and name it in ``docs/statements.md``.  Add the authors to ``PERSONS`` in
   ``modern/publication/book/build.py``.
"""
