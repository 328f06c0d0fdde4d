"""Every code block of README, CONTRIBUTING and docs runs, but for those a comment leaves out, which are counted."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support import documents
from tests.support.paths import ROOT

LEFT_OUT = {
    "README.md": 1,
    "CONTRIBUTING.md": 1,
    "docs/article.md": 1,
    "docs/tutorial/first-hull.md": 1,
    "docs/how-to/cluster.md": 3,
    "docs/how-to/emendation.md": 1,
    "docs/how-to/own-study.md": 1,
    "docs/explanation/doubts.md": 1,
}
"""How many blocks of a document are not run; each says why."""

BY_HAND = [
    page
    for page in documents.PAGES
    if page.stem not in ("index", "glossary") and (page.parent.name != "docs" or page.stem == "article")
]
"""The pages that are prose; the others of docs/ itself are made when the site is built."""


def name(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


@pytest.mark.parametrize("path", documents.DOCUMENTS, ids=name)
def test_the_blocks_of_a_document_run(path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    documents.lay_out(tmp_path)
    monkeypatch.chdir(tmp_path)
    ran, skipped = documents.run(path, tmp_path)
    languages = documents.languages(path)
    assert ran + skipped == sum(language in documents.RUN for language in languages)
    assert skipped == LEFT_OUT.get(name(path), 0)


@pytest.mark.parametrize("path", documents.DOCUMENTS, ids=name)
def test_every_block_names_its_language_and_what_is_left_out_a_reason(path: Path) -> None:
    assert [language for language in documents.languages(path) if language not in documents.LANGUAGES] == []
    assert len(documents.reasons(path)) == LEFT_OUT.get(name(path), 0)


@pytest.mark.parametrize("path", documents.DOCUMENTS, ids=name)
def test_every_file_that_is_named_is_there(path: Path) -> None:
    rooms = ("emulator", "modern", "tests")
    there = ["/" + found.relative_to(ROOT).as_posix() for room in rooms for found in (ROOT / room).rglob("*.*")]
    named = documents.files_named(path)
    assert sorted(word for word in named if not any(one.endswith("/" + word) for one in there)) == []
    assert sorted(link for link in documents.links(path) if not (path.parent / link).exists()) == []


@pytest.mark.parametrize("path", documents.DOCUMENTS, ids=name)
def test_every_heading_that_is_linked_to_is_there(path: Path) -> None:
    lost = [f"{name(page)}#{head}" for page, head in documents.places(path) if head not in documents.anchors(page)]
    assert lost == []


@pytest.mark.parametrize("folder", [folder for folder in documents.PROSE if folder])
def test_every_page_of_a_folder_is_in_its_order(folder: str) -> None:
    """Of what ``index.md`` lists, and nothing twice."""
    pages = {path.stem for path in documents.PAGES if path.parent.name == folder} - {"index"}
    listed = documents.listed(documents.ROOT / "docs" / folder / "index.md")
    assert sorted(name for name in listed if "/" not in name) == sorted(pages)


@pytest.mark.parametrize("path", BY_HAND, ids=name)
def test_every_page_links_to_the_glossary(path: Path) -> None:
    assert any(link.endswith("glossary.md") for link in documents.links(path))


def test_the_glossary_is_in_order_and_has_no_term_twice() -> None:
    heads = documents.headings(documents.ROOT / "docs" / "reference" / "glossary.md", 2)
    assert heads == sorted(set(heads), key=str.lower)


@pytest.mark.parametrize(
    ("block", "told"),
    [
        ("```sh\nhull1620 hull absent.deck\n```", "absent.deck"),
        ("```sh\nhull1620 hull absent.deck  # exit 1\n```", "absent.deck"),
        ("```console\n$ echo right\nwrong\n```", "right"),
        ("```toml\n[a]\n```", "first line"),
        ("```fortranfixed\n      END\n```", "first card"),
        ("```python\nassert False, 'here'\n```", "here"),
    ],
)
def test_a_block_that_does_not_run_is_found(
    block: str, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    documents.lay_out(tmp_path)
    monkeypatch.chdir(tmp_path)
    page = tmp_path / "page.md"
    page.write_text(block + "\n", encoding="utf-8")
    with pytest.raises(AssertionError, match=told):
        documents.run(page, tmp_path)


def test_a_name_without_a_file_and_a_link_are_found(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("`attic/a.py`, `NAME.py`, [x](docs/b.md#part), [y](https://c.org/d.md)\n", encoding="utf-8")
    assert documents.files_named(page) == {"attic/a.py"}
    assert documents.links(page) == {"docs/b.md"}


def test_a_heading_is_named_as_forge_and_site_name_it(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("# Nobody's `A*B`, twice\n```sh\n# none\n```\n[a](#here) [b](x.md#one-two)\n", encoding="utf-8")
    assert documents.anchors(page) == {"nobodys-ab-twice"}
    assert documents.places(page) == [(page, "here"), (tmp_path / "x.md", "one-two")]


def test_blocks_share_a_folder_and_one_is_left_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    documents.lay_out(tmp_path)
    monkeypatch.chdir(tmp_path)
    page = tmp_path / "page.md"
    page.write_text(
        "```toml\n# a.toml\nx = 1\n```\n```console\n$ tail -n 1 a.toml\nx = 1\n```\n"
        '<!-- skip: next "long" -->\n```sh\nfalse\n```\n```sh\nhull1620 check absent.f  # exit 2\n```\n'
        "```fortranfixed\nC     B.F\n      END\n```\n```console\n$ tail -n 1 b.f\n      END\n```\n"
        "```python\nx = 2\n```\n```python\nassert x == 2\n```\n```text\nfigure\n```\n",
        encoding="utf-8",
    )
    assert documents.run(page, tmp_path) == (7, 1)
    assert documents.reasons(page) == ["long"]
