"""The functions that the builds of the site, the book and the deposit share.

Each build is a function that raises :class:`BuildError` with a message of one line. :func:`run` calls the function and
turns the error into an exit code.
"""

import sys
import zipfile
from collections.abc import Callable, Mapping
from functools import cache
from io import BytesIO
from pathlib import Path
from typing import Any, Final

# The root of the checkout. The builds need a checkout; an installed wheel lacks their files.
ROOT: Final = Path(__file__).parents[2]
# The folder in which ``make wheel``, ``make edition``, ``make book`` and ``make archive`` put their results.
DIST: Final = ROOT / "dist"
# The pages that contain or replace files of the project.
PAGES_OF_FILES = {
    "fortran_src/README.md": "text",
    "fortran_src/KNOWN-FAULTS.md": "known-faults",
    "fortran_src/OPEN-QUESTIONS.md": "open-questions",
    "transcripts/README.md": "transcripts",
    "README.md": "index",
    "CHANGELOG.md": "changes",
}


class BuildError(Exception):
    """Raised if a build fails; the message gives the reason in one line."""


def run(name: str, build: Callable[[], str]) -> int:
    """Run a build and print the summary that it returns.

    Return the exit code: 0, or 2 after a one-line message on standard error if the build fails. ``name`` begins the
    message.
    """
    try:
        print(build())
    except (BuildError, ValueError, OSError) as error:
        print(f"{name}: {error}", file=sys.stderr)
        return 2
    return 0


def fill(frame: str, **texts: str) -> str:
    """Replace each placeholder ``__NAME__`` in a template by the text of that name."""
    for name, text in texts.items():
        frame = frame.replace(f"__{name}__", text)
    return frame


def zipped(files: Mapping[str, bytes], prefix: bytes = b"", compression: int = zipfile.ZIP_DEFLATED) -> bytes:
    """Return ``prefix`` followed by a zip archive of files, which are all dated 1980-01-01."""
    buffer = BytesIO()
    buffer.write(prefix)
    with zipfile.ZipFile(buffer, "w") as archive:
        for name, data in sorted(files.items()):
            archive.writestr(zipfile.ZipInfo(name), data, compression)
    return buffer.getvalue()


def check_replaceable(folder: Path, marker: str, kind: str) -> None:
    """Raise BuildError unless a build may replace a folder.

    A build may replace a folder that does not exist, is empty, or contains the file ``marker``, which earlier builds
    have written.  ``kind`` names such a folder in the message.
    """
    if folder.exists() and not (folder / marker).exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise BuildError(f"{folder}: exists and is not {kind}, so it is not replaced")


@cache
def citation() -> Mapping[str, Any]:
    """Return the fields of CITATION.cff; a date is a ``datetime.date``. Raise BuildError without PyYAML."""
    try:
        import yaml
    except ImportError:
        raise BuildError("PyYAML, which reads CITATION.cff, is missing: pip install 'hull1620[edition]'") from None
    fields: dict[str, Any] = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    return fields


def newest_wheel(folder: Path | None = None) -> Path | None:
    """Return the newest wheel in a folder (by default :data:`DIST`), or None if ``make wheel`` has not run."""
    return max((folder or DIST).glob("hull1620-*.whl"), key=lambda path: path.stat().st_mtime, default=None)
