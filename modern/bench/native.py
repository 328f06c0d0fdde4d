"""Find an installed Fortran compiler, compile translated programs with it, and run them as native programs."""

import os
import shlex
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

from emulator.errors import EmulatorError
from emulator.language.cards import Deck
from emulator.translation.writers import translated

# The compilers that are tried in this order if the environment variable FC names none.
COMPILERS = ("gfortran", "flang", "flang-new", "ifx", "f95")

# Options against fused multiplications and additions, which would change results.
_EXTRA = {"gfortran": ("-std=f2018", "-ffp-contract=off"), "ifx": ("-no-fma",)}
_PATIENCE = 120


class NoCompiler(EmulatorError):
    """Raised if no Fortran compiler is found, or if it fails.  The message is one line."""


@dataclass(frozen=True, slots=True)
class Compiler:
    """The command that runs a Fortran compiler, and the first line of its version text."""

    command: tuple[str, ...]
    version: str


def compiler() -> Compiler:
    """Return the Fortran compiler that FC names, or else the first one found.  Raise NoCompiler if none is found."""
    try:
        command_of_fc = shlex.split(os.environ.get("FC", ""))
    except ValueError as error:
        raise NoCompiler(
            f"expected a command in the environment variable FC, found {os.environ['FC']}: {error}"
        ) from None
    commands = [tuple(command_of_fc)] if command_of_fc else [(name,) for name in COMPILERS]
    for command in commands:
        if shutil.which(command[0]):
            version = _run([*command, "--version"]).stdout.strip().splitlines()
            return Compiler(command, version[0] if version else command[0])
    if command_of_fc:
        raise NoCompiler(f"the Fortran compiler that FC names, {command_of_fc[0]}, is not installed")
    raise NoCompiler(
        f"expected a Fortran compiler ({', '.join(COMPILERS)}, or the value of FC), found none; no native program runs"
    )


def built(deck: Deck, fortran: Compiler, folder: Path) -> Path:
    """Translate a source deck, compile it with -O2 in ``folder`` and return the program.

    Raise NoCompiler if the compiler fails.
    """
    source, program = folder / "deck.f90", folder / "deck"
    source.write_text(translated(deck, "fortran"), encoding="ascii")
    extra = _EXTRA.get(Path(fortran.command[0]).name, ())
    name, *arguments = fortran.command
    path = str(Path(shutil.which(name) or name).absolute())  # the compiler runs in the folder, where it writes modules
    process = _run([path, *arguments, "-O2", *extra, "-o", program.name, source.name], folder)
    if process.returncode:
        errors = [line for line in process.stderr.splitlines() if "rror" in line] or ["no reason given"]
        raise NoCompiler(f"{fortran.version} cannot compile the translated program: {errors[0].strip()}")
    if not program.exists():
        raise NoCompiler(f"{fortran.command[0]} is not a Fortran compiler: it produced no program")
    return program


def run(program: Path, cards: Path, punched: Path) -> None:
    """Run a native program on a file of cards, and write its output to the file ``punched``.

    Raise NoCompiler if the program fails or does not end in two minutes.
    """
    with cards.open("rb") as source, punched.open("wb") as target:
        try:
            process = subprocess.run(
                [str(program)],
                stdin=source,
                stdout=target,
                stderr=subprocess.PIPE,
                cwd=program.parent,
                timeout=_PATIENCE,
                check=False,
            )
        except subprocess.TimeoutExpired:
            raise NoCompiler(f"the native program did not end within {_PATIENCE} s") from None
    if process.returncode:
        errors = process.stderr.decode(errors="replace").strip().splitlines() or ["no reason given"]
        raise NoCompiler(f"the native program failed: {errors[0]}")


def _run(command: list[str], folder: Path | None = None) -> subprocess.CompletedProcess[str]:
    try:
        return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=_PATIENCE, check=False)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise NoCompiler(f"{command[0]} cannot be run: {error}") from None
