"""A Fortran compiler of today, if there is one, and programs made with it."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

from emulator.errors import EmulatorError
from emulator.language.cards import Deck
from modern.bench.translate import translated

COMPILERS = ("gfortran", "flang", "flang-new", "ifx", "f95")
"""Looked for in this order, after what the environment variable FC names."""

_EXTRA = {"gfortran": ("-std=legacy", "-w"), "ifx": ("-w",)}
_PATIENCE = 120


class NoCompiler(EmulatorError):
    """No Fortran compiler, or one that does not do; ``str`` is one line."""


@dataclass(frozen=True, slots=True)
class Compiler:
    """A command and the line it says of itself."""

    command: tuple[str, ...]
    version: str


def compiler() -> Compiler:
    """The compiler FC names, else the first one found.  Raises NoCompiler."""
    try:
        named = shlex.split(os.environ.get("FC", ""))
    except ValueError as error:
        raise NoCompiler(f"FC names no Fortran compiler, {os.environ['FC']}: {error}") from None
    commands = [tuple(named)] if named else [(name,) for name in COMPILERS]
    for command in commands:
        if shutil.which(command[0]):
            said = _run([*command, "--version"]).stdout.strip().splitlines()
            return Compiler(command, said[0] if said else command[0])
    if named:
        raise NoCompiler(f"the Fortran compiler named by FC, {named[0]}, is not found")
    raise NoCompiler(f"no Fortran compiler is found ({', '.join(COMPILERS)}, or FC); the native program is left out")


def built(deck: Deck, with_: Compiler, folder: Path) -> Path:
    """The program of a source deck, translated and compiled with -O2 in ``folder``.  Raises NoCompiler."""
    source, program = folder / "deck.f90", folder / "deck"
    source.write_text(translated(deck), encoding="ascii")
    extra = _EXTRA.get(Path(with_.command[0]).name, ())
    done = _run([*with_.command, "-O2", *extra, "-o", str(program), str(source)])
    if done.returncode:
        said = [line for line in done.stderr.splitlines() if "rror" in line] or ["no reason given"]
        raise NoCompiler(f"{with_.version} does not compile the translated program: {said[0].strip()}")
    if not program.exists():
        raise NoCompiler(f"{with_.command[0]} is no Fortran compiler: it makes no program")
    return program


def run(program: Path, cards: Path, punched: Path) -> None:
    """Run it over a file of cards in its own folder.  Raises NoCompiler where it fails or does not end."""
    with cards.open("rb") as given, punched.open("wb") as taken:
        try:
            done = subprocess.run(
                [str(program)],
                stdin=given,
                stdout=taken,
                stderr=subprocess.PIPE,
                cwd=program.parent,
                timeout=_PATIENCE,
                check=False,
            )
        except subprocess.TimeoutExpired:
            raise NoCompiler(f"the native program has not ended after {_PATIENCE} s") from None
    if done.returncode:
        said = done.stderr.decode(errors="replace").strip().splitlines() or ["no reason given"]
        raise NoCompiler(f"the native program failed: {said[0]}")


def _run(command: list[str]) -> subprocess.CompletedProcess[str]:
    try:
        return subprocess.run(command, capture_output=True, text=True, timeout=_PATIENCE, check=False)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise NoCompiler(f"{command[0]} cannot be run: {error}") from None
