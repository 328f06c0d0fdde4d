"""The list of the pages in a page's table of contents (toctree), with the first sentence of each."""

import re

from modern.publication.building import ROOT
from modern.publication.site.made import Part

_TREE = re.compile(r"^(?::::|```)\{toctree\}\n(.*?)^(?::::|```)$", re.DOTALL | re.MULTILINE)
_WHOLE = re.compile(r"^:::\{(?:whole\}|made\} texts) (\S+\.md)$", re.MULTILINE)
_SENTENCE = re.compile(r"(?<=[^A-Z]\.)\s")
_LINK = re.compile(r"\[([^\]]*)\]\([^)]*\)|\{\w+\}`([^`<]*)[^`]*`")


def make(argument: str) -> list[Part]:
    """Return the list of the pages that the toctree of a page names. Raise ValueError if the page has no toctree."""
    docs = ROOT / "docs"
    match = _TREE.search((docs / f"{argument}.md").read_text(encoding="utf-8"))
    if match is None:
        raise ValueError(f"{argument!r} has no list of pages (toctree)")
    folder = (docs / argument).parent
    items = []
    for entry in match[1].splitlines():
        if entry and not entry.startswith(":"):
            files = sorted(folder.glob(f"{entry}.md")) if "*" in entry else [(folder / f"{entry}.md").resolve()]
            for file in files:
                title, sentence = summary(file.read_text(encoding="utf-8"))
                page = file.relative_to(docs.resolve()).with_suffix("").as_posix()
                items.append(f"- {{doc}}`{title} </{page}>`: {sentence}\n")
    return [Part(text="".join(items))]


def summary(page: str) -> tuple[str, str]:
    """Return the title of a page and its first sentence, without links and without the words "This page"."""
    if included := _WHOLE.search(page):
        page = (ROOT / included[1]).read_text(encoding="utf-8")
    _, _, body = page.partition("\n# ") if not page.startswith("# ") else ("", "", page[2:])
    title, _, rest = body.partition("\n")
    paragraphs = (" ".join(part.split()) for part in rest.split("\n\n"))
    first = next((part for part in paragraphs if part and part[0].isalpha()), "")
    sentence = _SENTENCE.split(_LINK.sub(lambda match: (match[1] or match[2]).strip(), first))[0]
    sentence = re.sub(r"^This (page|guide|table) ", "", sentence)
    return title.strip(), sentence[:1].upper() + sentence[1:]
