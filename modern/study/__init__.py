"""Studies of numerical error: many point sets, computed in several ways and compared with their exact hulls.

A study is described by data, a :class:`Plan`: families of point sets, and the routes (ways to compute a hull) that
each set takes.
:func:`run_study` carries it out in a folder.  It can be interrupted at any moment and resumed.  ``plan.py``
explains the terms sample, route, cell and chunk.

To add a built-in study:

1. Write ``builtin/NAME.py`` with ``TITLE``, ``SAMPLES``, ``plan(samples, seed)`` and ``report(plan, store)``
   (:class:`modern.study.builtin.Study`).  Each module in that package is a study; its name has ``-`` for ``_``.
2. Test its report in ``tests/modern/study/test_study_reports.py`` on rows made for the test.
3. Run it at full size and commit its report, tables, charts and manifest in ``docs/studies/NAME/``; describe the result
   in ``docs/explanation/studies.md``, and new columns in ``modern/publication/columns.toml``.
   ``test_docs_studies.py`` compares the figures quoted there with the tables.

To add a family of point sets, see ``families/__init__.py``.  To add a measure (further figures of a run):

1. Write the function in ``measures.py`` and enter it in ``MEASURES``.
2. Describe it in a row of ``docs/how-to/own-study.md``, and test it in ``tests/modern/study/test_measures.py``.

A plan, family or measure of a user needs no change here: see ``docs/how-to/own-study.md``.
"""

from modern.study.families.draws import Draw, Drawn, drawn
from modern.study.plan import Cell, Plan, PlanError, Port, Programs, Route
from modern.study.report import Report
from modern.study.run import run_study

__all__ = ["Cell", "Draw", "Drawn", "Plan", "PlanError", "Port", "Programs", "Report", "Route", "drawn", "run_study"]
