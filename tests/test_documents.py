"""Every code block of README, CONTRIBUTING and docs runs, except the counted ones that a comment skips."""

from pathlib import Path

import pytest

from tests.support import documents
from tests.support.paths import ROOT

SKIPPED = {
    "README.md": 1,
    "CONTRIBUTING.md": 1,
    "docs/article.md": 1,
    "docs/get.md": 1,
    "docs/how-to/numerical-tools.md": 2,
    "docs/tutorial/first-hull.md": 1,
    "docs/how-to/cluster.md": 4,
    "docs/how-to/emendation.md": 1,
    "docs/how-to/own-study.md": 1,
    "docs/how-to/proof-sheet.md": 1,
    "docs/explanation/doubts.md": 1,
}
"""The number of blocks of a document that are not run; a comment before each states the reason."""

BY_HAND = [
    page
    for page in documents.PAGES
    if page.stem not in ("index", "glossary") and (page.parent.name != "docs" or page.stem == "article")
]
"""The prose pages; the other pages directly in docs/ are made when the site is built."""


def name(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


@pytest.mark.parametrize("path", documents.DOCUMENTS, ids=name)
def test_the_blocks_of_a_document_run(path: Path, tmp_path: Path, monkeypatch) -> None:
    documents.prepare_folder(tmp_path)
    monkeypatch.chdir(tmp_path)
    ran, skipped = documents.run(path)
    languages = documents.languages(path)
    assert ran + skipped == sum(language in documents.RUN for language in languages)
    assert skipped == SKIPPED.get(name(path), 0)


def test_every_block_names_its_language_and_every_skip_its_reason() -> None:
    assert {language for path in documents.DOCUMENTS for language in documents.languages(path)} <= {
        *documents.LANGUAGES
    }
    counts = {name(path): len(documents.reasons(path)) for path in documents.DOCUMENTS}
    assert {path: count for path, count in counts.items() if count} == SKIPPED


def test_named_files_and_headings_exist() -> None:
    packages = ("emulator", "modern", "tests")
    existing = ["/" + name(file) for package in packages for file in (ROOT / package).rglob("*.*")]
    for path in documents.DOCUMENTS:
        named = documents.files_named(path)
        assert [file for file in named if not any(place.endswith("/" + file) for place in existing)] == [], path
        assert [link for link in documents.links(path) if not (path.parent / link).exists()] == [], path
    targets = {target for path in documents.DOCUMENTS for target in documents.linked_headings(path)}
    anchors = {page: documents.anchors(page) for page, _ in targets}
    assert [f"{name(page)}#{anchor}" for page, anchor in sorted(targets) if anchor not in anchors[page]] == []


@pytest.mark.parametrize("folder", [folder for folder in documents.PROSE if folder not in ("", "tutorial")])
def test_the_index_of_a_folder_lists_every_page_once(folder: str) -> None:
    pages = {path.stem for path in documents.PAGES if path.parent.name == folder} - {"index"}
    listed = documents.listed(documents.ROOT / "docs" / folder / "index.md")
    assert sorted(name for name in listed if "/" not in name) == sorted(pages)


@pytest.mark.parametrize("path", BY_HAND, ids=name)
def test_every_page_links_to_the_glossary(path: Path) -> None:
    assert any(link.endswith("glossary.md") for link in documents.links(path))


def test_the_glossary_is_sorted_and_defines_each_term_once() -> None:
    terms = documents.headings(documents.ROOT / "docs" / "reference" / "glossary.md", 2)
    assert terms == sorted(set(terms), key=str.lower)


@pytest.mark.parametrize(
    ("block", "message"),
    [
        ("```sh\nhull1620 hull absent.deck\n```", "absent.deck"),
        ("```sh\nhull1620 hull absent.deck  # exit 1\n```", "absent.deck"),
        ("```console\n$ echo right\nwrong\n```", "right"),
        ("```toml\n[a]\n```", "first line"),
        ("```fortranfixed\n      END\n```", "first card"),
        ("```python\nassert False, 'here'\n```", "here"),
    ],
)
def test_a_failing_block_is_reported(block: str, message: str, tmp_path: Path, monkeypatch) -> None:
    documents.prepare_folder(tmp_path)
    monkeypatch.chdir(tmp_path)
    page = tmp_path / "page.md"
    page.write_text(block + "\n", encoding="utf-8")
    with pytest.raises(AssertionError, match=message):
        documents.run(page)


def test_file_names_links_and_anchors_are_read(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("`attic/a.py`, `NAME.py`, [x](docs/b.md#part), [y](https://c.org/d.md)\n", encoding="utf-8")
    assert documents.files_named(page) == {"attic/a.py"}
    assert documents.links(page) == {"docs/b.md"}
    page = tmp_path / "page.md"
    page.write_text("# Nobody's `A*B`, twice\n```sh\n# none\n```\n[a](#here) [b](x.md#one-two)\n", encoding="utf-8")
    assert documents.anchors(page) == {"nobodys-ab-twice"}
    assert documents.linked_headings(page) == [(page, "here"), (tmp_path / "x.md", "one-two")]


def test_blocks_share_a_folder_and_a_skipped_block_does_not_run(tmp_path: Path, monkeypatch) -> None:
    documents.prepare_folder(tmp_path)
    monkeypatch.chdir(tmp_path)
    page = tmp_path / "page.md"
    page.write_text(
        "```toml\n# a.toml\nx = 1\n```\n```console\n$ tail -n 1 a.toml\nx = 1\n```\n"
        '<!-- skip: next "long" -->\n```sh\nfalse\n```\n```sh\nhull1620 check absent.f  # exit 2\n```\n'
        "```fortranfixed\nC     B.F\n      END\n```\n```console\n$ tail -n 1 b.f\n      END\n```\n"
        "```python\nx = 2\n```\n```python\nassert x == 2\n```\n```text\nfigure\n```\n",
        encoding="utf-8",
    )
    assert documents.run(page) == (7, 1)
    assert documents.reasons(page) == ["long"]
