# The public names for type checkers; ``__init__.py`` imports each of them when it is first used.

from emulator.compiled.batch import run_batch
from emulator.errors import ArgumentError, CardError, CompileError, DeckError, Diagnostic, EmulatorError, FileError
from emulator.language.cards import Card, Deck, deck_from_lines, deck_from_text, read_deck
from emulator.language.compiler import compile_deck, translate
from emulator.language.objectcode import Program
from emulator.machine.divergence import Divergence, diverge
from emulator.machine.endings import Ending
from emulator.machine.machine import Machine
from emulator.machine.result import Options, Result
from emulator.machine.timing import Timing, measure
from emulator.numbers import Numbers, numbers
from emulator.numbers.arithmetic import Profile, profile
from hull1620.hull import Hull
from hull1620.hulls import (
    convex_hull,
    data_deck,
    draw,
    exact_hull,
    load_program,
    read_points,
    reproduce,
    run_hull,
    save,
)
from hull1620.voxels import voxel_hull
from modern.digital.hull import DigitalHull, digital_hull
from modern.digital.solids import NoVoxels, Volume, VolumeError
from modern.digital.volumes import read_volume
from modern.exact_hull.result import Certificate, CertificateError
from modern.geometry.hull import Face, HullRefused, Stage
from modern.geometry.mesh import ExportError
from modern.geometry.numbers import PointsError
from modern.port.arithmetic import RangeError
from modern.study.plan import Cell, Plan, PlanError, Port, Programs
from modern.study.run import run_study
from modern.thesis.cards import CardHull, read_hull
from modern.thesis.job import HullRun

__all__ = [
    "ArgumentError",
    "Card",
    "CardError",
    "CardHull",
    "Cell",
    "Certificate",
    "CertificateError",
    "CompileError",
    "Deck",
    "DeckError",
    "Diagnostic",
    "DigitalHull",
    "Divergence",
    "EmulatorError",
    "Ending",
    "ExportError",
    "Face",
    "FileError",
    "Hull",
    "HullRefused",
    "HullRun",
    "Machine",
    "NoVoxels",
    "Numbers",
    "Options",
    "Plan",
    "PlanError",
    "PointsError",
    "Port",
    "Profile",
    "Program",
    "Programs",
    "RangeError",
    "Result",
    "Stage",
    "Timing",
    "Volume",
    "VolumeError",
    "compile_deck",
    "convex_hull",
    "data_deck",
    "deck_from_lines",
    "deck_from_text",
    "digital_hull",
    "diverge",
    "draw",
    "exact_hull",
    "load_program",
    "measure",
    "numbers",
    "profile",
    "read_deck",
    "read_hull",
    "read_points",
    "read_volume",
    "reproduce",
    "run_batch",
    "run_hull",
    "run_study",
    "save",
    "translate",
    "voxel_hull",
]
