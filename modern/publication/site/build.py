"""Build the site: ``python -m modern.publication.site.build dist/edition``.

Sphinx reads ``docs/`` and writes into a temporary folder next to the output folder.  The output folder is replaced only
by a complete site that was built without a warning.  The same sources always give the same bytes: no page contains the
time, the machine or the user of the build.
"""

import os
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from modern.publication.building import DIST, ROOT, BuildError, check_replaceable, newest_wheel, run
from modern.publication.console import install_machine
from modern.publication.site import downloads

MISSING_SPHINX = "Sphinx builds the site: pip install 'hull1620[edition]'"
_MARKER = ".hull1620-edition"  # a file in every site; a folder without it is not replaced
_NOT_PUBLISHED = (".buildinfo", "objects.inv")


def build(out: Path, docs: Path = ROOT / "docs", quiet: bool = False, wheel: Path | None = None) -> None:
    """Build the site into a folder, and replace an earlier site there. With ``wheel``, the site includes the emulator.

    Raise BuildError if the folder holds files that are not a site, if Sphinx is missing, or if Sphinx reports a
    warning.
    """
    check_replaceable(out, _MARKER, "a site built by hull1620")
    out.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".edition-", dir=out.parent) as folder:
        new_site = Path(folder) / "site"
        _run_sphinx(docs, new_site, Path(folder) / "trees", quiet)
        for name in _NOT_PUBLISHED:
            (new_site / name).unlink(missing_ok=True)
        install_machine(new_site / "console", wheel)
        downloads.write(new_site / downloads.FOLDER)
        (new_site / _MARKER).write_text("built by hull1620; `make edition` replaces this folder\n", encoding="utf-8")
        if out.exists():
            out.rename(Path(folder) / "before")
        new_site.rename(out)


def _run_sphinx(docs: Path, out: Path, trees: Path, quiet: bool) -> None:
    try:
        from sphinx.application import Sphinx
        from sphinx.errors import SphinxError
        from sphinx.util.console import nocolor
        from sphinx.util.docutils import docutils_namespace, patch_docutils
    except ImportError:
        raise BuildError(MISSING_SPHINX) from None
    if quiet:
        nocolor()
    os.environ.setdefault("SOURCE_DATE_EPOCH", "0")
    try:
        with patch_docutils(str(docs)), docutils_namespace():
            folders = (str(docs), str(docs), str(out), str(trees))
            status = None if quiet else sys.stdout
            app = Sphinx(*folders, "html", status=status, warning=sys.stderr, warningiserror=True)
            app.build(force_all=True)
    except SphinxError as error:
        raise BuildError(f"the site was not built: {error}") from None
    if app.statuscode:
        raise BuildError("the site was not built because of the warnings above")


def main(arguments: Sequence[str]) -> int:
    """Build the site in the named folder, by default dist/edition. Return exit code 0, or 2 after an error."""
    out = Path(arguments[0]) if arguments else DIST / "edition"

    def summary() -> str:
        build(out, quiet=not sys.stdout.isatty(), wheel=newest_wheel())
        size = sum(file.stat().st_size for file in out.rglob("*") if file.is_file())
        summary = f"{out / 'index.html'}: {len(list(out.rglob('*.html')))} pages, {size / 1e6:.1f} MB"
        if not (out / "console" / "machine.gzip").exists():
            summary += "\nwithout the emulator in the browser, which needs make wheel and npm ci --prefix docs/console"
        return summary

    return run("edition", summary)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
