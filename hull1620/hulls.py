"""Convex hulls for Python programs: compute, draw and save them, and run the programs of 1963."""

import os
import warnings
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from emulator.errors import ArgumentError, EmulatorError, expect, quoted
from emulator.language.cards import Deck
from emulator.language.objectcode import Program
from emulator.machine.result import Options
from emulator.numbers.arithmetic import TRUNCATING
from emulator.numbers.decimal import DecimalNumbers
from hull1620.hull import Hull, Path
from modern import exact_hull as judge
from modern import port
from modern.comparison.outcome import as_hull
from modern.drawing.draw import Labels
from modern.edition import programs
from modern.exact_hull.coordinates import read_exact
from modern.formats import deck as decks
from modern.formats.points import read_input
from modern.geometry.hull import NOT_CLOSED, HullRefused
from modern.geometry.numbers import exact_text
from modern.geometry.points import Points
from modern.port.procedure import Epsilon, OnRefusal
from modern.thesis import job
from modern.thesis.job import HullRun


def convex_hull(
    points: Points,
    arithmetic: str = "exact",
    epsilon: Epsilon = None,
    translate: bool = False,
    history: bool = False,
    fast: bool | None = None,
    on_refusal: OnRefusal = "raise",
    text: bool = False,
) -> Hull:
    """Compute the convex hull of points by Butler's procedure of 1963, in any arithmetic.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        Real numbers of any type, decimal strings or fractions ``"p/q"``.  A float stands for its binary value.
    arithmetic : str, optional
        ``exact``, ``float64``, ``float32``, ``mp:BITS``, ``truncating`` (the eight digits of the thesis), ``ibm1962``,
        ``truncating1962``, ``truncating:P``, ``guarded:P``, ``rounding:P``, ``stochastic:P:SEED`` or
        ``stochastic:BITSb:SEED``.
    epsilon : number or str, optional
        The tolerance e of the thesis's chapter 7: the value of a plane's equation at a point counts as zero if it is
        from -e to e.  ``"rel:1e-9"`` is relative to the coefficients of the equation.  If e is so large that the faces
        do not form a closed surface, there is no hull.
    translate : bool, optional
        Move the origin to a point C inside the hull first, as chapter 7 of the thesis proposes.
    history : bool, optional
        Keep the growing hulls H1, H2, ... of the procedure in ``Hull.history``.
    fast : bool, optional
        Use (True) or do not use (False) compiled kernels for ``float64`` and ``float32``, which need the extra
        ``fast``.  The default uses them for many points.
    on_refusal : {"raise", "return"}, optional
        Raise HullRefused, or return the incomplete result, if the procedure finds no hull in this arithmetic.  In
        ``float64`` the procedure finds no hull for most point sets whose coordinates are doubles.
    text : bool, optional
        Follow the text of chapter 3 of the thesis, not the listing, in the two steps in which they differ.

    Returns
    -------
    Hull

    Raises
    ------
    PointsError
        There are no points, or a point is invalid (a subclass of ValueError).
    HullRefused
        The procedure found no hull; ``result`` of the exception has the reason.
    RangeError
        A number is beyond the range of the arithmetic (a subclass of ValueError).
    ArgumentError
        Another argument is invalid, or ``fast`` is true and numba is not installed (a subclass of ValueError).

    See Also
    --------
    modern.port.procedure.convex_hull

    Examples
    --------
    >>> convex_hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    <hull: polyhedron, 4 vertices, 4 faces; 4 points, exact>
    """
    try:
        record = port.convex_hull(points, arithmetic, epsilon, translate, history, fast, on_refusal, text)
    except HullRefused as error:
        raise HullRefused(Hull(error.result)) from None
    hull = Hull(record)
    # If epsilon is large, the procedure may end normally although it has merged different faces.
    if epsilon is None or not hull.determined or hull.closes:
        return hull
    hull = Hull(replace(record, status=NOT_CLOSED))
    if on_refusal == "raise":
        raise HullRefused(hull)
    return hull


def exact_hull(points: Points, fast: bool | None = None) -> Hull:
    """Compute the exact convex hull of points by an algorithm that is independent of Butler's, and prove the result.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        As in ``convex_hull``.
    fast : bool, optional
        Use (True) or do not use (False) a compiled kernel, which needs the extra ``fast``, to find the hull that is
        then proved.  By default the kernel is used if it is already loaded or there are very many points.

    Returns
    -------
    Hull
        Its ``certificate`` has the number of checks of each kind that proved it.

    Raises
    ------
    PointsError
        There are no points, or a point is invalid (a subclass of ValueError).
    ArgumentError
        ``fast`` is true and numba is not installed.

    Examples
    --------
    >>> hull = exact_hull([(0, 0, 0), ("0.1", 0, 0), (0, 1, 0), (0, 0, "1/3")])
    >>> hull.volume
    Fraction(1, 180)
    """
    judged = judge.exact_hull(points, fast)
    return Hull(as_hull(judged), judged.certificate)


def draw(
    points: Points | Hull,
    eye: Sequence[Any] | None = None,
    title: str = "",
    width: int | None = None,
    labels: Labels = "programs",
    hidden: bool = True,
    others: bool = True,
) -> str:
    """Return a hull, or the exact hull of points, as the text of an SVG file; see ``Hull.draw``."""
    return _hull(points).draw(eye, title, width, labels, hidden, others)


def save(points: Points | Hull, path: Path, digits: int | None = None) -> None:
    """Write a hull, or the exact hull of points, to a file; see ``Hull.save``."""
    _hull(points).save(path, digits)


def read_points(path: Path) -> Sequence[tuple[str, str, str]]:
    """Return the points of a file in any format that the commands accept.

    Parameters
    ----------
    path : str or path-like
        A data deck, a list (CSV), OFF, OBJ, PLY, STL, JSON or NPY file.

    Returns
    -------
    sequence of (x, y, z)
        Each coordinate is the decimal text of the file, or the exact decimal of a binary float.  The numbers of an NPY
        file become texts only when they are accessed; ``exact_hull`` uses the array instead.

    Raises
    ------
    EmulatorError
        The file cannot be read or holds no points; the message names the line or card.
    """
    expect(path, (str, os.PathLike), "path")
    return read_input(os.fspath(path)).points


def data_deck(points: Points, truncate: bool = False, epsilon: Epsilon = None) -> Deck:
    """Return points as a deck of input cards for the programs of 1963: a card with N, then one for each point.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        As in ``convex_hull``.
    truncate : bool, optional
        Truncate numbers after the eighth digit, because a card holds only eight.
    epsilon : number or str, optional
        The tolerance e of chapter 7.  Only programs with the layer ``epsilon`` read it from the deck.

    Raises
    ------
    PointsError
        There are no points, or a point is invalid.
    ArgumentError
        There are more than 99 points, or a number has too many digits for a card or an exponent out of range.

    Examples
    --------
    >>> print(data_deck([(1, 2.5, -3)]).text(), end="")
     1
    +.10000000E+01+.25000000E+01-.30000000E+01
    """
    texts = [[exact_text(number) for number in point] for point in read_exact(points)]
    deck = decks.data_deck(texts, "points", truncate)
    return deck if epsilon is None else decks.with_epsilon(deck, epsilon)


def run_hull(deck: Deck, layers: Sequence[str] = (), options: Options | None = None) -> HullRun:
    """Run the programs of 1963: program 1 on a data deck, then the program that program 1 names on the typewriter.

    Parameters
    ----------
    deck : Deck
        One data set, for instance from ``data_deck`` or ``read_deck``.
    layers : sequence of str, optional
        Optional sets of changes to the listings, such as ``corrected``, which corrects faults of the originals.
    options : Options, optional
        The options of the machine: arithmetic, core memory, limit of work, and others.

    Returns
    -------
    HullRun
        ``result.final.result.punched`` are the punched cards, which ``read_hull`` reads.  ``result.refusal`` says why
        there is no hull, or is empty.

    Raises
    ------
    EmulatorError
        An argument is invalid, or a card holds something that is not a number.

    Warns
    -----
    UserWarning
        The command ``hull1620 hull`` would reject this deck or warn about it, for example because it has more than 51
        points.
    """
    expect(deck, Deck, "deck")
    expect(options, (Options, type(None)), "options")
    expect(layers, (tuple, list), "layers")
    rules = (
        options.numbers.profile.rules if options and isinstance(options.numbers, DecimalNumbers) else TRUNCATING.rules
    )
    try:
        messages = [warning.message for warning in decks.check(deck, rules, "epsilon" in layers).warnings]
    except EmulatorError as error:
        messages = [str(error)]
    for message in messages:
        warnings.warn(message, stacklevel=2)
    return job.run_hull(deck, programs.loader(tuple(map(str, layers))), options)


def load_program(name: str, layers: Sequence[str] = ()) -> Program:
    """Compile a built-in program of the thesis by its name.

    Parameters
    ----------
    name : str
        ``program1``, ``program2``, ``program3`` or ``program1_examples``.
    layers : sequence of str, optional
        Optional sets of changes to the listing; see ``run_hull``.

    Raises
    ------
    EmulatorError
        There is no program of this name, or it has no such layer.

    Examples
    --------
    >>> program = load_program("program3")
    """
    expect(name, str, "name")
    if name not in programs.NAMES:
        raise ArgumentError(f"no program is called {quoted(name)}; the names are {', '.join(programs.NAMES)}")
    expect(layers, (tuple, list), "layers")
    return programs.program(name, tuple(map(str, layers)))


def reproduce(*names: str) -> bool:
    """Compute the results that the thesis and the later papers print, and print a comparison with them.

    Parameters
    ----------
    *names : str
        The results, with the names that ``hull1620 reproduce`` accepts; all of them by default.

    Returns
    -------
    bool
        True if every computed result agrees with the published one.
    """
    from modern.cli.main import main  # not at the top, because only this function needs the commands

    return main(["reproduce", *names]) == 0


def _hull(points: Points | Hull) -> Hull:
    return points if isinstance(points, Hull) else exact_hull(points)
