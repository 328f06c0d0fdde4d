"""The Python interface: convex hulls, exact or in the arithmetic of 1963, and the emulated IBM 1620.

``import hull1620`` is fast, because each name is loaded on first use.

- ``convex_hull`` computes a hull by Butler's procedure in any arithmetic; ``exact_hull`` computes an exact hull and
  proves it.
- ``Hull`` is the result of both functions, with numpy arrays, exact volume and area, drawings and files.
- ``digital_hull`` finds all voxels in the hull of given voxels; ``voxel_hull`` computes the exact hull of voxels in
  physical coordinates.
- ``read_volume`` reads voxels from a file, such as NRRD, NPY, NIfTI or DICOM.
- ``read_points`` reads points from a file of any supported format; ``data_deck`` writes points on cards.
- ``read_deck`` reads cards from a file; ``compile_deck`` compiles a FORTRAN program.
- ``load_program`` returns program 1, 2 or 3 of the thesis, compiled.
- ``EmulatorError`` is the base class of the errors that invalid input raises.
- ``Machine`` runs a program on the 1620.  Its ``Options`` include the arithmetic, which ``numbers`` returns by name.
- ``run_hull`` applies the programs of 1963 to a data deck; ``read_hull`` reads the hull from the punched cards.
- ``diverge`` runs a program in two arithmetics, and finds the first values and decisions that differ between the runs.
- ``Plan``, ``Cell`` and ``run_study`` compare thousands of computed hulls with the exact hull.
- ``reproduce`` computes the results that the thesis and the papers print, and compares them with the print.
"""

import os
from contextlib import suppress
from importlib import import_module
from importlib.util import find_spec

# The module of each public name.  ``__init__.pyi`` declares the same names for type checkers.
_HOMES = {
    "emulator.compiled.batch": ("run_batch",),
    "emulator.errors": (
        "ArgumentError",
        "CardError",
        "CompileError",
        "DeckError",
        "Diagnostic",
        "EmulatorError",
        "FileError",
    ),
    "emulator.language.cards": ("Card", "Deck", "deck_from_lines", "deck_from_text", "read_deck"),
    "emulator.language.compiler": ("compile_deck", "translate"),
    "emulator.language.objectcode": ("Program",),
    "emulator.machine.divergence": ("Divergence", "diverge"),
    "emulator.machine.endings": ("Ending",),
    "emulator.machine.machine": ("Machine",),
    "emulator.machine.result": ("Options", "Result"),
    "emulator.machine.timing": ("Timing", "measure"),
    "emulator.numbers": ("Numbers", "numbers"),
    "emulator.numbers.arithmetic": ("Profile", "profile"),
    "hull1620.hull": ("Hull",),
    "hull1620.hulls": (
        "convex_hull",
        "data_deck",
        "draw",
        "exact_hull",
        "load_program",
        "read_points",
        "reproduce",
        "run_hull",
        "save",
    ),
    "hull1620.voxels": ("voxel_hull",),
    "modern.digital.hull": ("DigitalHull", "digital_hull"),
    "modern.digital.solids": ("NoVoxels", "Volume", "VolumeError"),
    "modern.digital.volumes": ("read_volume",),
    "modern.exact_hull.result": ("Certificate", "CertificateError"),
    "modern.geometry.hull": ("Face", "HullRefused", "Stage"),
    "modern.geometry.mesh": ("ExportError",),
    "modern.geometry.numbers": ("PointsError",),
    "modern.port.arithmetic": ("RangeError",),
    "modern.study.plan": ("Cell", "Plan", "PlanError", "Port", "Programs"),
    "modern.study.run": ("run_study",),
    "modern.thesis.cards": ("CardHull", "read_hull"),
    "modern.thesis.job": ("HullRun",),
}

__all__ = sorted(name for names in _HOMES.values() for name in names)


def _check_packages() -> None:
    """Raise ImportError if Python would import another package instead of one that belongs to hull1620."""
    folder = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    for name in ("emulator", "modern", "fortran_src", "transcripts"):
        spec = find_spec(name)
        found = "" if spec is None else str(next(iter(spec.submodule_search_locations or ()), spec.origin))
        own = os.path.join(folder, name)
        if found and os.path.realpath(found) != os.path.realpath(own):
            message = f"{found} hides the package {name!r} of hull1620; rename it, or work in another folder"
            raise ImportError(message, name=__name__, path=found)
        # Another distribution with a package of this name would have overwritten its first file.
        file = os.path.join(own, "__init__.py")
        with suppress(OSError), open(file, encoding="utf-8", errors="replace") as source:
            if _MARK not in source.read():
                message = f"another distribution has overwritten {file}; install hull1620 in a separate environment"
                raise ImportError(message, name=__name__, path=file)


# This comment is in the first file of each package that is installed with hull1620.
_MARK = "# Part of the distribution hull1620."
_check_packages()


def __getattr__(name: str) -> object:
    """Import a public name from its module when it is first used, and store it in this module."""
    for module, names in _HOMES.items():
        if name in names:
            globals()[name] = getattr(import_module(module), name)
            return globals()[name]
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*(name for name in globals() if name.startswith("__")), *__all__})
