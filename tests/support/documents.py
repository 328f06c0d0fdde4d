"""Run the code blocks of the documents, and read their links, headings and file names.

The language of a block decides how it is run:

``sh``       one command per line, which must exit with 0 or with the code its comment names (``# ... exit 1``)
``console``  commands after ``$ ``, each followed by its output
``python``   the blocks of a document share one namespace
``toml``     saved under the name in the first line, ``# scene.toml``
``py``       saved in the same way
``fortranfixed``  a source deck, saved under the name on its first card: ``C     SUM.F`` becomes ``sum.f``
``deck``  the same, with the record marks of a paper tape
``text``     not run, like the directives of Sphinx (``{toctree}``, ``{argparse}``, ``{eval-rst}``)

``<!-- skip: next "reason" -->`` before a block skips it.  The blocks of a document run in one folder, which contains
the files of ``INPUTS`` at the start.
"""

import gzip
import io
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from unittest import SkipTest, mock

import numpy as np
from sybil import Document, Example
from sybil.parsers.markdown import CodeBlockParser, PythonCodeBlockParser, SkipParser

from modern.cli.main import main
from tests.support.paths import PROGRAMS, ROOT
from tests.support.volumefiles import PLACE, nifti, nrrd

PROSE = ("", "tutorial", "how-to", "reference", "explanation", "papers")
"""The folders of ``docs`` with pages written by hand; the other folders hold results."""
PAGES = tuple(path for folder in PROSE for path in sorted((ROOT / "docs" / folder).glob("*.md")))
DOCUMENTS = (ROOT / "README.md", ROOT / "CONTRIBUTING.md", *PAGES)
RUN = ("sh", "console", "python", "py", "toml", "fortranfixed", "deck")
LANGUAGES = (*RUN, "text", "{toctree}", "{argparse}", "{eval-rst}")

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
    """Return a scan with a hollow ball of label 3 next to a block of label 1."""
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
"""Input files that blocks may use without making them, from the name to the function that writes the file."""


def prepare_folder(folder: Path) -> None:
    """Write the inputs into an empty folder, and the commands ``hull1620`` and ``python`` into ``folder/.bin``."""
    for name, write in INPUTS.items():
        write(folder / name)
    (folder / ".bin").mkdir()
    for name, options in (("hull1620", "-m modern.cli.main"), ("python", "")):
        command = folder / ".bin" / name
        command.write_text(f'#!/bin/sh\nexec "{sys.executable}" {options} "$@"\n', encoding="utf-8")
        command.chmod(0o755)


def run(path: Path) -> tuple[int, int]:
    """Run the blocks of a document in the current folder, and return the numbers of blocks run and skipped.

    Simple ``hull1620`` commands run in this process, which is faster.  Raise AssertionError, or the exception of a
    block, which names its line.
    """
    ran = skipped = 0
    for example in parsed(path).examples():
        try:
            example.evaluate()
        except SkipTest:
            skipped += 1
            continue
        ran += "source" in example.region.lexemes
    return ran, skipped


def parsed(path: Path) -> Document:
    """Return the document with its blocks as examples."""

    def check_exit_codes(example: Example) -> None:
        for line in filter(str.strip, example.parsed.splitlines()):
            code, output = _run_command(line)
            expected = int((re.search(r"#.*\bexit (\d)\b", line) or ["", "0"])[1])
            assert code == expected, f"{example.path}: {line}\nexit {code}\n{output}"
            assert "Traceback" not in output, f"{example.path}: {line}\n{output}"

    def check_output(example: Example) -> None:
        for part in re.split(r"^\$ ", example.parsed, flags=re.MULTILINE)[1:]:
            command, _, expected = part.partition("\n")
            output = _run_command(command)[1]
            assert output == expected, f"{example.path}: {command}\n{output}"

    runners = {
        "sh": check_exit_codes,
        "console": check_output,
        "py": _save,
        "toml": _save,
        "fortranfixed": _save_deck,
        "deck": _save_deck,
    }
    blocks = (CodeBlockParser(language, run_block) for language, run_block in runners.items())
    return Document.parse(str(path), PythonCodeBlockParser(), *blocks, SkipParser())


def languages(path: Path) -> list[str]:
    """Return the language of every block of a document, empty if a block names none."""
    fences = re.findall(r"^```(.*)$", path.read_text(encoding="utf-8"), re.MULTILINE)
    return [language.strip() for language in fences[::2]]


def reasons(path: Path) -> list[str]:
    """Return the reasons for skipping blocks of a document."""
    return re.findall(r'^<!--+ *skip: next "([^"]+)" *--+>$', path.read_text(encoding="utf-8"), re.MULTILINE)


def files_named(path: Path) -> set[str]:
    """Return the modules and grammars that the text names between backquotes."""
    text = path.read_text(encoding="utf-8")
    return {name for name in re.findall(r"`([\w./-]+\.(?:py|lark))`", text) if "NAME" not in name}


def links(path: Path) -> set[str]:
    """Return the files that the text links to, relative to its folder."""
    targets = re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", path.read_text(encoding="utf-8"))
    return {target for target in targets if "://" not in target}


def listed(path: Path) -> list[str]:
    """Return the pages that the ``{toctree}`` blocks of an index name, in their order."""
    blocks = re.findall(r"^:::{toctree}\n(.*?)^:::", path.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    lines = [line.strip() for block in blocks for line in block.splitlines()]
    return [line for line in lines if line and not line.startswith((":", "<"))]


def headings(path: Path, level: int) -> list[str]:
    """Return the headings of one level."""
    return re.findall(rf"^#{{{level}}} (.*?) *$", path.read_text(encoding="utf-8"), re.MULTILINE)


def anchors(path: Path) -> set[str]:
    """Return the anchors of the headings: lower case, hyphens for spaces, no punctuation."""
    outside = re.sub(r"^```.*?^```", "", path.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    titles = re.findall(r"^#+ (.*?) *$", outside, re.MULTILINE)
    plain = [re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", title) for title in titles]
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in plain}


def linked_headings(path: Path) -> list[tuple[Path, str]]:
    """Return the links to headings, as document and anchor."""
    targets = re.findall(r"\]\(([^)#]*)#([^)]+)\)", path.read_text(encoding="utf-8"))
    return [((path.parent / link).resolve() if link else path, anchor) for link, anchor in targets if "://" not in link]


def _save(example: Example) -> None:
    first_line = re.match(r"# (\S+\.(?:toml|py))\n", example.parsed)
    assert first_line, f"{example.path}: the first line of a toml or py block must name its file, as # scene.toml"
    Path(first_line[1]).write_text(example.parsed, encoding="utf-8")


def _save_deck(example: Example) -> None:
    first_card = re.match(r"C +(\S+\.F)\n", example.parsed)
    assert first_card, f"{example.path}: the first card of a deck must name its file, as C     SUM.F"
    Path(first_card[1].lower()).write_text(example.parsed, encoding="utf-8")


def _run_command(command: str) -> tuple[int, str]:
    """Run a command in this process if it is ``hull1620`` with plain arguments, otherwise in a shell."""
    text = re.sub(r"\s# .*", "", command)
    if not text.startswith("hull1620 ") or re.search(r"[|<>&;$`*?~{}()\\]", text):
        return _run_in_shell(command)
    arguments = shlex.split(text)
    output = io.TextIOWrapper(io.BytesIO(), encoding="utf-8", write_through=True)
    with (
        open(os.devnull, encoding="utf-8") as empty,
        redirect_stdout(output),
        redirect_stderr(output),
        mock.patch.multiple(sys, argv=arguments, stdin=empty),
        mock.patch("os.get_terminal_size", side_effect=OSError),
        mock.patch.dict(os.environ),
    ):
        os.environ.pop("COLUMNS", None)
        try:
            code = main(arguments[1:])
        except SystemExit as error:
            code = int(error.code or 0)
    return code, output.buffer.getvalue().decode()


def _run_in_shell(command: str) -> tuple[int, str]:
    # Without COLUMNS the output is as wide as it is when nothing states the width of the terminal.
    inherited = {name: value for name, value in os.environ.items() if name != "COLUMNS"}
    path = {"PATH": f"{Path('.bin').resolve()}:{os.environ['PATH']}", "PYTHONPATH": str(ROOT)}
    process = subprocess.run(
        ["bash", "-o", "pipefail", "-c", command],
        env={**inherited, **path},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        encoding="utf-8",
        check=False,
    )
    return process.returncode, process.stdout
