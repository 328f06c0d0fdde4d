"""Studies of numerical error: many point sets, computed in several ways and compared with their exact hulls.

A :class:`Plan` describes a study as data: families of point sets, and the routes (ways to compute a hull) that each set
goes through.  :func:`run_study` runs the study in a folder.  A run can be interrupted at any moment and resumed.
``plan.py`` explains the terms sample, route, cell and chunk.

To add a built-in study:

1. Write ``builtin/NAME.py`` with ``TITLE``, ``SAMPLES``, ``plan(samples, seed)`` and ``report(plan, store)``
   (:class:`modern.study.builtin.Study`).  The command line uses the name of the module, with hyphens for underscores.
2. Add the name to ``STUDIES`` in ``modern/cli/shared/arguments.py``, from which the shell completes it.
3. Test its report in ``tests/modern/study/test_study_reports.py`` on rows made for the test.
4. Run it at full size and commit its report, tables, charts and manifest in ``docs/studies/NAME/``. Describe the result
   in ``docs/explanation/studies.md``, and describe new columns in ``modern/publication/columns.toml``.
   ``test_docs_studies.py`` compares the figures that this page quotes with the tables.

To add a family of point sets, see ``families/__init__.py``.  To add a measure, a function that computes further figures
of a run:

1. Write the function in ``measures.py`` and enter it in ``MEASURES``.
2. Describe it in a row of ``docs/how-to/own-study.md``, and test it in ``tests/modern/study/test_measures.py``.

Plans, families and measures of users need no change in this package: see ``docs/how-to/own-study.md``.
"""

from modern.study.families.draws import Draw, Drawn, drawn
from modern.study.plan import Cell, Plan, PlanError, Port, Programs, Route
from modern.study.report import Report
from modern.study.run import run_study

__all__ = ["Cell", "Draw", "Drawn", "Plan", "PlanError", "Port", "Programs", "Report", "Route", "drawn", "run_study"]
