"""Studies of numerical error: many samples, each judged by the exact hull, each with one outcome.

A study is data (:class:`Plan`): families of point sets, and the routes each set is sent by.  :func:`run_study`
carries it out in a folder, where it can be interrupted at any moment and resumed.
"""

from modern.study.families.draws import Draw, Drawn, drawn
from modern.study.plan import Cell, Plan, PlanError, Port, Programs, Route
from modern.study.report import Report
from modern.study.run import run_study

__all__ = [
    "Cell",
    "Draw",
    "Drawn",
    "Plan",
    "PlanError",
    "Port",
    "Programs",
    "Report",
    "Route",
    "drawn",
    "run_study",
]
