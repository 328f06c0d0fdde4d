"""Code blocks of the documents, run: what a block's language means, and the input files that blocks may name.

``sh``       a command a line; it must end with exit code 0, or with the code its comment names (``# ... exit 1``)
``console``  commands after ``$ ``, each followed by what it prints
``python``   one namespace for the blocks of a document
``toml``     saved under the name in its first line, ``# scene.toml``
``fortranfixed``  a source deck, saved under the name in its first card, ``C     SUM.F`` as ``sum.f``
``text``     not run, as is ``{toctree}``, the order of a folder's pages

``<!-- skip: next "why" -->`` before a block leaves it out.  Blocks run in one folder a document, which holds
``INPUTS`` at first.
"""

from __future__ import annotations

import gzip
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from unittest import SkipTest

import numpy as np
from sybil import Document, Example
from sybil.parsers.markdown import CodeBlockParser, PythonCodeBlockParser, SkipParser

from tests.support.paths import PROGRAMS, ROOT
from tests.support.volumefiles import PLACE, nifti, nrrd

PROSE = ("", "tutorial", "how-to", "reference", "explanation", "papers")
"""The folders of ``docs`` whose pages are written by hand; the others hold results."""
PAGES = tuple(path for folder in PROSE for path in sorted((ROOT / "docs" / folder).glob("*.md")))
DOCUMENTS = (ROOT / "README.md", ROOT / "CONTRIBUTING.md", *PAGES)
RUN = ("sh", "console", "python", "py", "toml", "fortranfixed")
LANGUAGES = (*RUN, "text", "{toctree}")

_POINTS = ((0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4), (4, 4, 0), (1, 1, 1), (2, 2, 0))
_OWN = (
    *((".012", "-1.734", "2.291"), ("1.118", ".477", "-.905"), ("-2.013", "1.266", ".731"), (".55", "2.803", "1.407")),
    *(("-.719", "-.318", "-2.64"), ("1.902", "-1.087", "-.144")),
)
_SOLID = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"


def _ball() -> np.ndarray:
    x, y, z = np.ogrid[:6, :6, :6]
    return ((2 * x - 5) ** 2 + (2 * y - 5) ** 2 + (2 * z - 5) ** 2 <= 30).astype(np.uint8)


def _nrrd() -> bytes:
    return b"NRRD0004\ntype: uint8\ndimension: 3\nsizes: 6 6 6\nencoding: raw\n\n" + _ball().tobytes("F")


def _labels() -> np.ndarray:
    """A ball of label 3 with a hole, a block of label 1 beside it."""
    labels = np.zeros((12, 10, 8), np.uint8)
    labels[1:7, 1:7, 1:7] = 3 * _ball()
    labels[4, 4, 4] = 0
    labels[8:11, 2:4, 2:5] = 1
    return labels


def _array(path: Path) -> None:
    np.save(path, _ball())


def _raw(path: Path) -> None:
    scan = np.zeros((128, 256, 256), np.int16)
    scan[60:70, 100:130, 120:140] = 7
    scan.tofile(path)


def _bytes(make: Callable[[], bytes]) -> Callable[[Path], object]:
    return lambda path: path.write_bytes(make())


def _text(text: str) -> Callable[[Path], object]:
    return lambda path: path.write_text(text, encoding="utf-8")


INPUTS: dict[str, Callable[[Path], object]] = {
    "points.csv": _text("".join(f"{x},{y},{z}\n" for x, y, z in _POINTS)),
    "points.deck": _text(f"{len(_POINTS):2d}\n" + "".join(f"{x:10d}.{y:10d}.{z:10d}.\n" for x, y, z in _POINTS)),
    "own.deck": _text(" 6\n" + "".join(f"{x:14}{y:14}{z:14}\n" for x, y, z in _OWN)),
    "my.f": _text((PROGRAMS / "desk.f").read_text(encoding="utf-8")),
    "my.deck": _text("1\n2     2.5\n4     4.\n6\n8\n"),
    "solid.off": _text(_SOLID),
    "solid.csv": _text("".join(f"{x},{y},{z}\n" for x, y, z in np.argwhere(_ball()))),
    "solid.npy": _array,
    "solid.nrrd": _bytes(_nrrd),
    "scan.nrrd": _bytes(lambda: nrrd(_labels(), *PLACE)),
    "scan.nii.gz": _bytes(lambda: gzip.compress(nifti(_labels(), (0.5, 0.5, 2), (10, 20, 30)))),
    "scan.raw": _raw,
}
"""The name of every input a block may use without making it, and what makes it."""


def lay_out(folder: Path) -> None:
    """Put the inputs and the commands ``hull1620`` and ``python`` (in ``folder/.bin``) into an empty folder."""
    for name, make in INPUTS.items():
        make(folder / name)
    (folder / ".bin").mkdir()
    for name, words in (("hull1620", "-m modern.cli.main"), ("python", "")):
        command = folder / ".bin" / name
        command.write_text(f'#!/bin/sh\nexec "{sys.executable}" {words} "$@"\n', encoding="utf-8")
        command.chmod(0o755)


def run(path: Path, folder: Path) -> tuple[int, int]:
    """Run the blocks of a document in a folder, which is the current one.

    Returns how many were run and how many left out.  Raises AssertionError, or what a block raises, naming its line.
    """
    document = parsed(path)
    ran = skipped = 0
    for example in document.examples():
        try:
            example.evaluate()
        except SkipTest:
            skipped += 1
            continue
        ran += "source" in example.region.lexemes
    return ran, skipped


def parsed(path: Path) -> Document:
    """The document with its blocks as examples."""
    parsers = (
        PythonCodeBlockParser(),
        *(CodeBlockParser(language, run) for language, run in _RUNNERS),
        SkipParser(),
    )
    return Document.parse(str(path), *parsers)


def languages(path: Path) -> list[str]:
    """The language of every block of a document, empty where it names none."""
    fences = re.findall(r"^```(.*)$", path.read_text(encoding="utf-8"), re.MULTILINE)
    return [language.strip() for language in fences[::2]]


def reasons(path: Path) -> list[str]:
    """Why blocks of a document are left out."""
    return re.findall(r'^<!--+ *skip: next "([^"]+)" *--+>$', path.read_text(encoding="utf-8"), re.MULTILINE)


def files_named(path: Path) -> set[str]:
    """Modules and grammars that the text names between backquotes, as it writes them."""
    text = path.read_text(encoding="utf-8")
    return {word for word in re.findall(r"`([\w./-]+\.(?:py|lark))`", text) if "NAME" not in word}


def links(path: Path) -> set[str]:
    """Files that the text links to, from its own folder."""
    found = re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", path.read_text(encoding="utf-8"))
    return {link for link in found if "://" not in link}


def listed(path: Path) -> list[str]:
    """The pages that the ``{toctree}`` blocks of an index name, in their order."""
    blocks = re.findall(r"^```{toctree}\n(.*?)^```", path.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    lines = [line.strip() for block in blocks for line in block.splitlines()]
    return [line for line in lines if line and not line.startswith((":", "<"))]


def headings(path: Path, level: int) -> list[str]:
    """The headings of one level."""
    return re.findall(rf"^#{{{level}}} (.*?) *$", path.read_text(encoding="utf-8"), re.MULTILINE)


def anchors(path: Path) -> set[str]:
    """The headings of a text as links name them: small letters, ``-`` for blanks, no other signs."""
    outside = re.sub(r"^```.*?^```", "", path.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    heads = re.findall(r"^#+ (.*?) *$", outside, re.MULTILINE)
    plain = [re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", head) for head in heads]
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in plain}


def places(path: Path) -> list[tuple[Path, str]]:
    """What the text links to within documents: the document, and the heading there."""
    found = re.findall(r"\]\(([^)#]*)#([^)]+)\)", path.read_text(encoding="utf-8"))
    return [((path.parent / link).resolve() if link else path, anchor) for link, anchor in found if "://" not in link]


def _sh(example: Example) -> None:
    for line in example.parsed.splitlines():
        if line.strip():
            done = _bash(line)
            wanted = int((re.search(r"#.*\bexit (\d)\b", line) or ["", "0"])[1])
            assert done.returncode == wanted, f"{example.path}: {line}\nexit {done.returncode}\n{done.stdout}"
            assert "Traceback" not in done.stdout, f"{example.path}: {line}\n{done.stdout}"


def _console(example: Example) -> None:
    for part in re.split(r"^\$ ", example.parsed, flags=re.MULTILINE)[1:]:
        command, _, wanted = part.partition("\n")
        printed = _bash(command).stdout
        assert printed == wanted, f"{example.path}: {command}\n{printed}"


def _saved(example: Example) -> None:
    named = re.match(r"# (\S+\.(?:toml|py))\n", example.parsed)
    assert named, f"{example.path}: a toml or py block says its file's name in its first line"
    Path(named[1]).write_text(example.parsed, encoding="utf-8")


def _deck(example: Example) -> None:
    named = re.match(r"C +(\S+\.F)\n", example.parsed)
    assert named, f"{example.path}: a deck says its file's name in its first card"
    Path(named[1].lower()).write_text(example.parsed, encoding="utf-8")


_RUNNERS = (("sh", _sh), ("console", _console), ("py", _saved), ("toml", _saved), ("fortranfixed", _deck))


def _bash(command: str) -> subprocess.CompletedProcess[str]:
    # Samples are as wide as where there is no terminal and nothing says otherwise.
    place = {"PATH": f"{Path('.bin').resolve()}:{os.environ['PATH']}", "PYTHONPATH": str(ROOT)}
    environment = {**{name: value for name, value in os.environ.items() if name != "COLUMNS"}, **place}
    return subprocess.run(
        ["bash", "-o", "pipefail", "-c", command],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        encoding="utf-8",
        check=False,
    )
