"""Set the book: ``python -m modern.publication.book.build dist/hull1620.pdf``.

Everything is written into a folder of its own, and Typst makes PDF/A of it (the ``typst`` package, whose wheel holds
the compiler).  No font of the machine is used; the date is that of the edition, so that the same sources give the same
bytes.
"""

from __future__ import annotations

import re
import sys
import tempfile
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Final

from emulator.files import writing_bytes
from modern.edition.sources import sources as table
from modern.publication.book import parts
from modern.publication.book.markup import Markdown, label, places, say, string
from modern.publication.figures import figures, filled
from modern.publication.numbered import numbered

ROOT = Path(__file__).parents[3]
DOCS = ROOT / "docs"
STANDARD: Final = "a-2a"
NEEDS = "the book is set by Typst: pip install 'hull1620[edition]'"
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
        (
            "papers/appel_will.md",
            "papers/nakamae_nishita.md",
            "papers/kovalevsky_schulz.md",
            "papers/yau_srihari.md",
        ),
    ),
    ("Studies", ("explanation/studies.md", "@studies", "weight/report.md")),
    ("Glossary", ("reference/glossary.md",)),
)
"""The chapters: documents below ``docs``, and what is made (``@``)."""


class BookError(Exception):
    """Why there is no book, in one line."""


def sources() -> dict[str, str]:
    """The Markdown of every document in the book, by its path below ``docs``, figures put in."""
    values = figures(DOCS)
    names = [name for _, chapter in CHAPTERS for name in chapter if not name.startswith("@")]
    names += [f"studies/{folder.name}/report.md" for folder in sorted((DOCS / "studies").iterdir())]
    found = {name: filled((DOCS / name).read_text(encoding="utf-8"), values) for name in names}
    for name, file in (("text.md", "fortran_src/README.md"), ("transcripts.md", "transcripts/README.md")):
        found[name] = (ROOT / file).read_text(encoding="utf-8")
    return found


def typst(folder: Path) -> str:
    """The whole book as Typst; its pictures are laid into ``folder``."""
    documents = sources()
    made = {kind: "".join(part) for kind, part in _made(folder)}
    known = {place for name, text in documents.items() for place in places(name, text)}
    known |= {place for text in made.values() for place in re.findall(r" <([\w.-]+)>", text)}
    words = [(Path(__file__).parent / "preamble.typ").read_text(encoding="utf-8"), *_front()]
    for title, chapter in CHAPTERS:
        words.append(f"= {say(title)} <{label('chapter', title)}>\n\n")
        for name in chapter:
            for each in _named(name, documents):
                if each.startswith("@"):
                    words.append(made[each[1:]])
                else:
                    words.append(Markdown(each, known, 2, lambda file: _picture(file, folder)).typst(documents[each]))
    return "".join(words)


def _named(name: str, documents: dict[str, str]) -> Sequence[str]:
    if name == "@studies":
        return [each for each in documents if each.startswith("studies/")]
    if name in ("@text", "@transcripts"):
        return [f"{name[1:]}.md"]
    return [name]


def _front() -> Iterator[str]:
    """Title page and contents."""
    fields = dict(re.findall(r'^(\S[\w-]*): "?([^"\n]+)"?$', (ROOT / "CITATION.cff").read_text("utf-8"), re.MULTILINE))
    thesis = next(each for each in table().documents if each.id == "butler-1963")
    year, month, day = fields["date-released"].split("-")
    yield f'#set document(title: {string(fields["title"])}, author: "The hull1620 developers", '
    yield f"date: datetime(year: {int(year)}, month: {int(month)}, day: {int(day)}))\n"
    yield '#v(24%)\n#align(center)[#text(size: 27pt, weight: "semibold")[#par(justify: false)['
    yield f"{say('The convex hull programs of 1963')}]]\n\n#v(1em)\n"
    yield f"#text(size: 13pt)[{say(f'{thesis.author}: {thesis.title}')}]\n\n"
    yield f"#v(2em)\n{say('Restored, run and judged by the hull1620 developers')}\n\n"
    yield f"{say('Edition ' + fields['version'] + ', ' + fields['date-released'])}]\n#pagebreak()\n"
    yield "#outline(title: [Contents], depth: 2)\n"


def _made(folder: Path) -> Iterator[tuple[str, Iterator[str]]]:
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
    """A file of numbered items, each with a heading."""
    opening, items, closing = numbered(file)
    text, under = f"# {title}\n\n{opening}\n\n", ""
    for item in items:
        if item.under != under:
            under = item.under
            text += f"## {under}\n\n{item.before}\n\n"
        text += f"### {item.number}. {item.title}\n\n{item.text}\n\n"
    if closing[0]:
        text += f"## {closing[0]}\n\n{closing[1]}\n"
    yield Markdown(name, (), 2, lambda file: "").typst(text)


def _picture(file: str, folder: Path) -> str:
    """A picture of the documents laid beside the book, by the name it has there."""
    source = DOCS / file
    if source.suffix != ".svg" or not source.is_file():
        return ""
    name = file.replace("/", "-")
    (folder / name).write_text(parts.fitted(source.read_text(encoding="utf-8")), encoding="utf-8")
    return name


def build(out: Path) -> int:
    """Set the book and write it; returns the number of its bytes.  Raises BookError."""
    try:
        import typst as compiler
    except ImportError:
        raise BookError(NEEDS) from None
    with tempfile.TemporaryDirectory(prefix="book-") as room:
        folder = Path(room)
        (folder / "book.typ").write_text(typst(folder), encoding="utf-8")
        try:
            made = compiler.compile(
                str(folder / "book.typ"),
                root=room,
                ignore_system_fonts=True,
                pdf_standards=[STANDARD],
                timestamp=datetime(2026, 1, 1, tzinfo=UTC),
            )
        except (RuntimeError, ValueError) as error:
            raise BookError(f"no book: {' '.join(str(error).split())[:600]}") from None
        out.parent.mkdir(parents=True, exist_ok=True)
        with writing_bytes(str(out)) as file:
            file.write(made)
    return len(made)


def main(words: Sequence[str]) -> int:
    """Set the book into the file named, or dist/hull1620.pdf.  0, or 2 with one line on standard error."""
    out = Path(words[0]) if words else ROOT / "dist" / "hull1620.pdf"
    try:
        size = build(out)
    except BookError as error:
        print(f"book: {error}", file=sys.stderr)
        return 2
    print(f"{out}: {size / 1e6:.1f} MB, PDF/A ({STANDARD.upper()})")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
