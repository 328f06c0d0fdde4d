"""Typeset the book: ``python -m modern.publication.book.build dist/hull1620.pdf``.

The text is written as Typst markup into a temporary folder, and the package ``typst``, whose wheel contains the
compiler, makes PDF/A-2a from it.  The compiler reports an error if it recognises a violation of that standard.  System
fonts are ignored and the date is that of the release, so that the same sources always give the same bytes.
"""

import re
import sys
import tempfile
from collections.abc import Collection, Iterable, Mapping, Sequence
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import Final

from emulator.files import writing_bytes
from modern.publication.book import front, parts
from modern.publication.book.markup import Markdown, label, places, say
from modern.publication.building import DIST, ROOT, BuildError, run
from modern.publication.figures import figures, filled
from modern.publication.numbered import numbered

DOCS = ROOT / "docs"
STANDARD: Final = "a-2a"
# The chapters before which Typst's numbering of headings changes, and the new numbering.
_NUMBERING: Final = {
    "The story": '(..n) => if n.pos().len() == 1 { numbering("1", ..n) }',
    "Glossary": "none",
}
MISSING_TYPST = "Typst typesets the book: pip install 'hull1620[edition]'"
# Each chapter with its documents, as paths below ``docs``.  A name with ``@`` is a part that is generated from data.
CHAPTERS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("How to read this book", ("@reading",)),
    ("The story", ("index.md", "explanation/context.md")),
    ("The article", ("article.md",)),
    ("The algorithm", ("explanation/method.md", "explanation/eight-digits.md", "reference/concordance.md")),
    ("The text", ("explanation/doubts.md", "text.md", "transcripts.md")),
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
    ("Bibliography", ("@bibliography",)),
)
_GLOSSARY: Final = "reference/glossary.md"
_CONTEXT: Final = "explanation/context.md"
_LITERATURE: Final = "literature.md"
# The persons of the index by their surnames, which occur in the texts.
PERSONS: Final = {
    name.partition(",")[0]: name
    for name in (
        *("Appel, Arthur", "Balinski, M. L.", "Barber, C. B.", "Butler, Karen Jensen", "Bykat, A.", "Chand, D. R."),
        *("Dobkin, D. P.", "Eddy, W. F.", "Euler, Leonhard", "Graham, R. L.", "Hong, S. J.", "Huhdanpaa, H."),
        *("Kapur, S. S.", "Kovalevsky, Vladimir", "Motzkin, T. S.", "Nakamae, Eihachiro", "Nishita, Tomoyuki"),
        *("Preparata, F. P.", "Schulz, Henrik", "Srihari, S. N.", "Stalley, Robert D.", "Will, Peter M.", "Yau, M.-M."),
    )
}
# Subjects of the index that are not terms of the glossary, in the words in which the texts name them.
SUBJECTS: Final = (
    *("DATA NOT ACCEPTABLE", "ERROR IN PROGRAM", "POINTS ARE COPLANAR", "POINTS ARE NOT COPLANAR", "BOUNDARY POINTS"),
    *("quickhull", "Qhull", "SciPy", "gift wrapping", "outside set", "horizon", "tetrahedron", "cube", "truncation"),
    *("guard digit", "float64", "float32", "indirect addressing", "FORMAT", "PDQ FORTRAN", "Hollerith", "DO loop"),
    *("Clopper and Pearson", "convex polyhedron", "collinear", "Oregon State University"),
)
# The largest number of occurrences with which a term of the glossary is indexed at each occurrence.
_MOST_PLACES = 40
# Paragraphs of the home page that only lead to other pages of the site.
_NAVIGATION = re.compile(r"^\*\*(?:\[|Next:).*?(?:\n\n|\Z)", re.MULTILINE | re.DOTALL)
FONTS = [str(Path(__file__).parent / "fonts"), str(ROOT / "modern" / "study" / "fonts")]


def documents() -> dict[str, str]:
    """Return the Markdown of every document in the book by its path below ``docs``.  Quoted results are filled in."""
    values = figures(DOCS)
    names = [name for _, chapter in CHAPTERS for name in chapter if not name.startswith("@")]
    names += [f"studies/{folder.name}/report.md" for folder in sorted((DOCS / "studies").iterdir())]
    texts = {name: filled((DOCS / name).read_text(encoding="utf-8"), values) for name in names}
    for name, file in (("text.md", "fortran_src/README.md"), ("transcripts.md", "transcripts/README.md")):
        texts[name] = (ROOT / file).read_text(encoding="utf-8")
    texts["index.md"] = _NAVIGATION.sub("", texts["index.md"])
    # The literature of this page is the second part of the bibliography.
    texts[_CONTEXT], _, texts[_LITERATURE] = texts[_CONTEXT].partition("## Sources\n")
    return texts


def _subjects(texts: Mapping[str, str]) -> dict[str, str]:
    """Return the entries of the book's index.  The keys are labels of the glossary, and terms in lower case.

    Each link to such a label is indexed, and so is each occurrence of such a term.  A term of the glossary that occurs
    more than ``_MOST_PLACES`` times has only its label as a key.
    """
    terms = re.findall(r"^## (.+)$", texts[_GLOSSARY], re.MULTILINE)
    labels = [place for place in places(_GLOSSARY, texts[_GLOSSARY]) if place != label(_GLOSSARY)]
    entries = [term if not term[1:2].islower() or term in SUBJECTS else term[0].lower() + term[1:] for term in terms]
    whole = "\n".join(texts.values()).lower()
    rare = {entry.lower(): entry for entry in entries if 0 < whole.count(entry.lower()) <= _MOST_PLACES}
    named = {name.lower(): entry for name, entry in PERSONS.items()} | {name.lower(): name for name in SUBJECTS}
    return rare | named | dict(zip(labels[-len(terms) :], entries, strict=True))


def typst(folder: Path) -> str:
    """Return the whole book as Typst markup, and write its pictures into ``folder``."""
    texts = documents()
    subjects = _subjects(texts)
    words = sorted((re.escape(name) for name in subjects if "--" not in name), key=len, reverse=True)
    names = re.compile(rf"\b(?:{'|'.join(words)})\b", re.IGNORECASE)

    def keep(name: str, svg: str) -> str:
        (folder / f"{name}.svg").write_text(parts.fitted(svg), encoding="utf-8")
        return f"{name}.svg"

    def markdown(name: str, labels: Collection[str], title: str = "") -> str:
        made = partial(front.made, save=keep)
        document = Markdown(name, labels, lambda file: _picture(file, folder), made, subjects, names, title)
        return document.typst(texts[name])

    pieces: dict[str, Iterable[str]] = {
        "@reading": front.how_to_read(),
        "@listings": parts.listings(),
        "@charts": parts.charts(keep),
        "@examples": parts.examples(keep),
        "@statements": parts.statements(),
        "@faults": _numbered("fortran_src/KNOWN-FAULTS.md", "Faults of the originals", "known-faults.md"),
        "@questions": _numbered("fortran_src/OPEN-QUESTIONS.md", "Open questions", "open-questions.md"),
    }
    generated = {name: "".join(part) for name, part in pieces.items()}
    # A reference is a link only if the book has its label.
    labels = {place for name, text in texts.items() for place in places(name, text)}
    labels |= {place for text in generated.values() for place in re.findall(r" <([\w.-]+)>", text)}
    generated["@bibliography"] = "".join(front.bibliography(markdown(_LITERATURE, labels), PERSONS))
    book = [(Path(__file__).parent / "preamble.typ").read_text(encoding="utf-8"), front.title_and_imprint()]
    for title, chapter in CHAPTERS:
        if title in _NUMBERING:
            book.append(f"#set heading(numbering: {_NUMBERING[title]})\n")
        book.append(f"= {say(title)} <{label('chapter', title)}>\n\n")
        for name in chapter:
            if name == "@studies":
                book += [markdown(document, labels, title) for document in texts if document.startswith("studies/")]
            else:
                book.append(generated[name] if name in generated else markdown(name, labels, title))
    return "".join([*book, f"= {say('Index')} <{label('chapter', 'Index')}>\n\n#subject-index()\n"])


def _numbered(file: str, title: str, name: str) -> str:
    opening, items, closing = numbered(file)
    text, section = f"# {title}\n\n{opening}\n\n", ""
    for item in items:
        if item.section != section:
            section = item.section
            text += f"## {section}\n\n{item.preamble}\n\n"
        stop = "." if item.text[:1].isupper() else ""  # some titles begin their first sentence
        text += f"**{item.number}. {item.title}{stop}** {item.text}\n\n"
    if closing[0]:
        text += f"## {closing[0]}\n\n{closing[1]}\n"
    return Markdown(name, (), lambda file: "").typst(text)


def _picture(file: str, folder: Path) -> str:
    """Copy a picture into the folder of the book and return its name there, or "" if the file is not an SVG file."""
    source = DOCS / file
    if source.suffix != ".svg" or not source.is_file():
        return ""
    name = file.replace("/", "-")
    (folder / name).write_text(parts.fitted(source.read_text(encoding="utf-8")), encoding="utf-8")
    return name


def pdf(markup: str, folder: Path) -> bytes:
    """Typeset Typst markup as PDF/A.  ``folder`` has the pictures.  Raise BuildError if Typst is missing or fails."""
    try:
        import typst as compiler
    except ImportError:
        raise BuildError(MISSING_TYPST) from None
    main_file = folder / "main.typ"
    main_file.write_text(markup, encoding="utf-8")
    try:
        return compiler.compile(
            str(main_file),
            root=str(folder),
            font_paths=FONTS,
            ignore_system_fonts=True,
            pdf_standards=[STANDARD],
            timestamp=datetime(2026, 1, 1, tzinfo=UTC),
        )
    except (RuntimeError, ValueError) as error:
        raise BuildError(f"{main_file.name} was not typeset: {' '.join(str(error).split())[:600]}") from None


def build(out: Path) -> int:
    """Typeset the book, write it, and return its size in bytes.  Raise BuildError if Typst is missing or fails."""
    with tempfile.TemporaryDirectory(prefix="book-") as folder:
        data = pdf(typst(Path(folder)), Path(folder))
    out.parent.mkdir(parents=True, exist_ok=True)
    with writing_bytes(str(out)) as file:
        file.write(data)
    return len(data)


def main(arguments: Sequence[str]) -> int:
    """Build the named file, by default dist/hull1620.pdf.  Return the exit code: 0, or 2 after an error message."""
    out = Path(arguments[0]) if arguments else DIST / "hull1620.pdf"
    return run("book", lambda: f"{out}: {build(out) / 1e6:.1f} MB, PDF/A ({STANDARD.upper()})")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
