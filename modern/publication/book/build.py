"""Typeset the book: ``python -m modern.publication.book.build dist/hull1620.pdf``.

The text is written as Typst markup into a temporary folder, and the package ``typst``, whose wheel contains the
compiler, makes PDF/A from it.  System fonts are ignored and the date is that of the release, so that the same sources
always give the same bytes.
"""

import re
import sys
import tempfile
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Final

from emulator.files import writing_bytes
from modern.edition.sources import sources
from modern.publication.book import parts
from modern.publication.book.markup import Markdown, label, places, say, string
from modern.publication.building import DIST, ROOT, BuildError, citation, run
from modern.publication.figures import figures, filled
from modern.publication.numbered import numbered

DOCS = ROOT / "docs"
STANDARD: Final = "a-2a"
MISSING_TYPST = "Typst typesets the book: pip install 'hull1620[edition]'"
# The chapters with their documents below ``docs``; a name that begins with ``@`` is a part generated from data.
CHAPTERS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("Introduction", ("article.md",)),
    ("The algorithm", ("explanation/method.md", "explanation/eight-digits.md", "reference/concordance.md")),
    ("The text", ("explanation/doubts.md", "@text", "@transcripts")),
    ("The listings", ("@listings",)),
    ("The flow charts", ("charts.md", "@charts")),
    ("The examples", ("@examples",)),
    ("Faults and open questions", ("@faults", "@questions")),
    ("Statements and verdicts", ("explanation/verdicts.md", "@statements")),
    ("The machine", ("reference/machine.md", "reference/fortran.md", "reference/operator.md")),
    ("Hulls", ("explanation/judge.md", "explanation/digital.md")),
    (
        "Four later papers",
        ("papers/appel_will.md", "papers/nakamae_nishita.md", "papers/kovalevsky_schulz.md", "papers/yau_srihari.md"),
    ),
    ("Studies", ("explanation/studies.md", "@studies", "weight/report.md")),
    ("Glossary", ("reference/glossary.md",)),
)


def documents() -> dict[str, str]:
    """Return the Markdown of every document in the book by its path below ``docs``, with the figures filled in."""
    values = figures(DOCS)
    names = [name for _, chapter in CHAPTERS for name in chapter if not name.startswith("@")]
    names += [f"studies/{folder.name}/report.md" for folder in sorted((DOCS / "studies").iterdir())]
    texts = {name: filled((DOCS / name).read_text(encoding="utf-8"), values) for name in names}
    for name, file in (("text.md", "fortran_src/README.md"), ("transcripts.md", "transcripts/README.md")):
        texts[name] = (ROOT / file).read_text(encoding="utf-8")
    return texts


def typst(folder: Path) -> str:
    """Return the whole book as Typst markup; its pictures are written into ``folder``."""
    texts = documents()
    generated = {kind: "".join(part) for kind, part in _generated(folder)}
    # A reference is a link only if the book has its label.
    labels = {place for name, text in texts.items() for place in places(name, text)}
    labels |= {place for text in generated.values() for place in re.findall(r" <([\w.-]+)>", text)}
    book = [(Path(__file__).parent / "preamble.typ").read_text(encoding="utf-8"), *_front()]
    for title, chapter in CHAPTERS:
        book.append(f"= {say(title)} <{label('chapter', title)}>\n\n")
        for name in chapter:
            for part in _parts(name, texts):
                if part.startswith("@"):
                    book.append(generated[part[1:]])
                else:
                    book.append(Markdown(part, labels, 2, lambda file: _picture(file, folder)).typst(texts[part]))
    return "".join(book)


def _parts(name: str, texts: dict[str, str]) -> Sequence[str]:
    if name == "@studies":
        return [document for document in texts if document.startswith("studies/")]
    if name in ("@text", "@transcripts"):
        return [f"{name[1:]}.md"]
    return [name]


def _front() -> Iterator[str]:
    fields = citation()
    thesis = next(document for document in sources().documents if document.id == "butler-1963")
    released = fields["date-released"]
    yield f'#set document(title: {string(fields["title"])}, author: "The hull1620 developers", '
    yield f"date: datetime(year: {released.year}, month: {released.month}, day: {released.day}))\n"
    yield '#v(24%)\n#align(center)[#text(size: 27pt, weight: "semibold")[#par(justify: false)['
    yield f"{say('The convex hull programs of 1963')}]]\n\n#v(1em)\n"
    yield f"#text(size: 13pt)[{say(f'{thesis.author}: {thesis.title}')}]\n\n"
    yield f"#v(2em)\n{say('Restored, run and judged by the hull1620 developers')}\n\n"
    yield f"{say('Edition {version}, {date-released}'.format_map(fields))}]\n#pagebreak()\n"
    yield "#outline(title: [Contents], depth: 2)\n"


def _generated(folder: Path) -> Iterator[tuple[str, Iterator[str]]]:
    def keep(name: str, svg: str) -> str:
        (folder / f"{name}.svg").write_text(parts.fitted(svg), encoding="utf-8")
        return f"{name}.svg"

    yield "listings", parts.listings()
    yield "charts", parts.charts(keep)
    yield "examples", parts.examples(keep)
    yield "statements", parts.statements()
    yield "faults", _numbered("fortran_src/KNOWN-FAULTS.md", "Faults of the originals", "known-faults.md")
    yield "questions", _numbered("fortran_src/OPEN-QUESTIONS.md", "Open questions", "open-questions.md")


def _numbered(file: str, title: str, name: str) -> Iterator[str]:
    opening, items, closing = numbered(file)
    text, section = f"# {title}\n\n{opening}\n\n", ""
    for item in items:
        if item.section != section:
            section = item.section
            text += f"## {section}\n\n{item.preamble}\n\n"
        text += f"### {item.number}. {item.title}\n\n{item.text}\n\n"
    if closing[0]:
        text += f"## {closing[0]}\n\n{closing[1]}\n"
    yield Markdown(name, (), 2, lambda file: "").typst(text)


def _picture(file: str, folder: Path) -> str:
    """Copy an SVG file of the documents into the folder of the book and return its name there, or an empty string."""
    source = DOCS / file
    if source.suffix != ".svg" or not source.is_file():
        return ""
    name = file.replace("/", "-")
    (folder / name).write_text(parts.fitted(source.read_text(encoding="utf-8")), encoding="utf-8")
    return name


def build(out: Path) -> int:
    """Typeset the book, write it, and return its size in bytes.  Raise BuildError if Typst is missing or fails."""
    try:
        import typst as compiler
    except ImportError:
        raise BuildError(MISSING_TYPST) from None
    with tempfile.TemporaryDirectory(prefix="book-") as folder:
        main_file = Path(folder) / "book.typ"
        main_file.write_text(typst(Path(folder)), encoding="utf-8")
        try:
            pdf = compiler.compile(
                str(main_file),
                root=folder,
                ignore_system_fonts=True,
                pdf_standards=[STANDARD],
                timestamp=datetime(2026, 1, 1, tzinfo=UTC),
            )
        except (RuntimeError, ValueError) as error:
            raise BuildError(f"the book was not built: {' '.join(str(error).split())[:600]}") from None
    out.parent.mkdir(parents=True, exist_ok=True)
    with writing_bytes(str(out)) as file:
        file.write(pdf)
    return len(pdf)


def main(arguments: Sequence[str]) -> int:
    """Build the named file, by default dist/hull1620.pdf.  Return 0, or 2 after one line on standard error."""
    out = Path(arguments[0]) if arguments else DIST / "hull1620.pdf"
    return run("book", lambda: f"{out}: {build(out) / 1e6:.1f} MB, PDF/A ({STANDARD.upper()})")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
