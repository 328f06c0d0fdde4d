"""Build the site: ``python -m modern.publication.site.build dist/edition``.

Sphinx reads ``docs/`` and writes beside the folder asked for; only a whole site without a warning takes its place.
Built twice it is the same bytes: nothing in it tells when, where or by whose hands it was made.
"""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from modern.publication.console import lay

ROOT = Path(__file__).parents[3]
NEEDS = "the site is built by Sphinx: pip install 'hull1620[edition]'"
_OURS = ".hull1620-edition"
"""A file in every site built, so that a folder of something else is never replaced."""
_LEFT_OUT = (".buildinfo", ".doctrees", "objects.inv", "_sources")


class BuildError(Exception):
    """Why no site was built, in one line."""


def build(out: Path, docs: Path = ROOT / "docs", quiet: bool = False, wheel: Path | None = None) -> None:
    """Build the site into a folder, which it replaces; with ``wheel`` the machine in the page too.

    Raises BuildError.
    """
    if out.exists() and not (out / _OURS).exists() and (not out.is_dir() or any(out.iterdir())):
        raise BuildError(f"{out}: is there and is no site of ours; nothing is replaced")
    try:
        from sphinx.application import Sphinx
        from sphinx.errors import SphinxError
        from sphinx.util.console import nocolor
        from sphinx.util.docutils import docutils_namespace, patch_docutils
    except ImportError:
        raise BuildError(NEEDS) from None
    if quiet:
        nocolor()
    out.parent.mkdir(parents=True, exist_ok=True)
    os.environ.setdefault("SOURCE_DATE_EPOCH", "0")
    with tempfile.TemporaryDirectory(prefix=".edition-", dir=out.parent) as folder:
        made, trees = Path(folder) / "site", Path(folder) / "trees"
        try:
            with patch_docutils(str(docs)), docutils_namespace():
                app = Sphinx(
                    str(docs),
                    str(docs),
                    str(made),
                    str(trees),
                    "html",
                    status=None if quiet else sys.stdout,
                    warning=sys.stderr,
                    warningiserror=True,
                )
                app.build(force_all=True)
        except SphinxError as error:
            raise BuildError(f"no site: {error}") from None
        if app.statuscode:
            raise BuildError("no site: Sphinx warned, as told above")
        for name in _LEFT_OUT:
            found = made / name
            if found.is_dir():
                shutil.rmtree(found)
            else:
                found.unlink(missing_ok=True)
        lay(made / "console", wheel)
        (made / _OURS).write_text("built by hull1620; `make edition` replaces this folder\n", encoding="utf-8")
        if out.exists():
            out.rename(Path(folder) / "before")
        made.rename(out)


def _newest(folder: Path) -> Path | None:
    """The wheel built last, if there is one."""
    return max(folder.glob("hull1620-*.whl"), key=lambda path: path.stat().st_mtime, default=None)


def main(words: Sequence[str]) -> int:
    """Build into the folder named, or dist/edition.  0, or 2 with one line on standard error."""
    out = Path(words[0]) if words else ROOT / "dist" / "edition"
    try:
        build(out, quiet=not sys.stdout.isatty(), wheel=_newest(ROOT / "dist"))
    except BuildError as error:
        print(f"edition: {error}", file=sys.stderr)
        return 2
    size = sum(file.stat().st_size for file in out.rglob("*") if file.is_file())
    if not (out / "console" / "worker.mjs").exists():
        print("edition: without the machine in the page: it needs make wheel, and npm ci --prefix docs/console")
    print(f"{out / 'index.html'}: {len(list(out.rglob('*.html')))} pages, {size / 1e6:.1f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
