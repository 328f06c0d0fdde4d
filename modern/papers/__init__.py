"""Four later papers on hulls and hidden lines, one package each, implemented in exact arithmetic.

These steps add a fifth paper, ``NAME``. Commands and the registers of statements write ``-`` for ``_`` in the name:

1. ``modern/papers/NAME/``: the algorithm, over integers or fractions. ``__init__.py`` cites the paper and exports the
   entry point. If the print is wrong, implement the corrected step and keep the printed one as an option, as
   ``yau_srihari/printed.py`` does.
2. ``transcripts/FOLDER/``, where FOLDER is NAME and the year, such as ``appel_will_1976``. (Only the folder
   ``kovalevsky_schulz`` has no year.) The folder holds three files: ``witness.txt`` has the printed values exactly as
   the OCR text has them, ``apparatus.toml`` has the emendations, and ``results.toml`` lists, for each published result,
   the lines of the corrected print that form it. Add the source to ``fortran_src/SOURCES.toml``. A paper that prints no
   values, such as Yau and Srihari's, skips steps 2 and 3.
3. ``modern/papers/NAME/results.py``: the function ``produced``, which the comment at :data:`Lines` describes. Add a
   ``Paper`` to ``PAPERS`` in ``modern/claims/published.py``. ``hull1620 reproduce NAME`` then compares the results with
   the print.
4. ``transcripts/statements/NAME.toml``: a row for each statement of the paper with its verdict. Add NAME to
   ``DOCUMENTS`` in ``modern/claims/register.py``. The functions that compute the verdicts go into
   ``modern/claims/NAME/``.
5. ``modern/cli/NAME.py``: the command, with an entry in ``modern/cli/arguments.py``. For the completion in the shell,
   add NAME to ``DOCUMENTS`` and FOLDER to ``TEXTS`` in ``modern/cli/shared/arguments.py``.
6. The documentation: write ``docs/papers/NAME.md`` with its line in ``docs/papers/index.md``, and
   ``docs/statements/NAME.md`` with its line in ``docs/statements.md``. Add the pictures of the paper's page to
   ``modern/publication/site/pages/papers.py``. Add the chapter of the book to ``CHAPTERS`` and the authors to
   ``PERSONS``, both in ``modern/publication/book/build.py``. Add a section on the transcript to
   ``transcripts/README.md``.

Tests go into ``tests/modern/papers/``: ``test_NAME.py`` compares the algorithm with the exact hull or another
independent method on random input, ``test_NAME_cli.py`` runs the command, and ``test_NAME_published.py`` tests
``results.py``. You need not change ``tests/modern/papers/test_published.py`` and
``tests/modern/claims/test_register.py``, which check every paper in ``PAPERS`` and every row of the register.
"""

from collections.abc import Mapping, Sequence

# Printed or computed lines, by the id of the published result to which they belong. The module ``results`` of a paper
# defines ``produced(printed: Lines) -> Lines``. It receives the printed lines after our emendations and returns, for
# each result that can be computed, one line for each printed line. The lines are then compared word by word.
Lines = Mapping[str, Sequence[str]]
