"""The files of the site: links, ids, decks, rows and HTML; and the functions that generate pages."""

import hashlib
import json
import re
import subprocess
import time
import zipfile
from itertools import pairwise
from pathlib import Path
from shutil import which

import pytest

from emulator.errors import explanations
from modern.edition import programs
from modern.publication import essay
from modern.publication.site import build as site_build
from modern.publication.site.made import make, names
from modern.publication.site.markup import code, element, escape, inline, lowered, relative, stacked
from tests.support import editions
from tests.support.editions import page_of_each_kind, pages, words
from tests.support.paths import ROOT


def test_every_link_and_every_id_resolves(site: Path) -> None:
    assert list(editions.dead(site)) == []
    for page in pages(site).values():
        assert len(set(page.ids)) == len(page.ids), [id for id in page.ids if page.ids.count(id) > 1][:5]


def test_a_dead_link_is_reported(tmp_path: Path) -> None:
    (tmp_path / "a.html").write_text('<p id="x"><a href="b.html">b</a><a href="#y">y</a><a href="#x">x</a></p>')
    assert list(editions.dead(tmp_path)) == ["a.html: b.html: there is no such file", "a.html: #y: there is no such id"]


@pytest.mark.parametrize("name", programs.NAMES)
def test_the_cards_on_a_page_are_those_of_the_committed_deck(site: Path, name: str) -> None:
    cards = pages(site)[f"{name}.html"].root.xpath('//li[contains(@class, "card ")]//div[@class="deck"]/code')
    text = "".join(words(card) + "\n" for card in cards)
    committed = programs.sources().joinpath(f"{name}.f").read_bytes()
    assert hashlib.sha256(text.encode()).hexdigest() == hashlib.sha256(committed).hexdigest()


def test_every_row_is_shown_with_reason_evidence_and_rejected_readings(site: Path) -> None:
    entries = {}
    for name in programs.NAMES:
        for entry in pages(site)[f"{name}.html"].root.xpath('//article[contains(@class, "row ")]'):
            entries.setdefault(entry.get("id"), words(entry))
    for name in programs.TEXTS:
        for row in programs.text(name).rows:
            text = entries[row.id]
            for field in (row.certainty, row.reason, row.evidence):
                assert field in text
            assert all(rejected.reading in text and rejected.reason in text for rejected in row.rejected)


def test_published_addresses_still_exist(site: Path) -> None:
    known = pages(site)
    for page, id in (
        ("program3", "147+2"),
        ("program3", "P3-025"),
        ("program1", "P1-039"),
        ("program3", "name-KELEQ"),
        ("program1", "title"),
        ("program2", "before-106"),
        ("program3", "page-97"),
        ("errors", "error-5"),
    ):
        assert id in known[f"{page}.html"].ids, id


def test_the_index_lists_every_card_and_error(site: Path) -> None:
    listed = {str(href) for href in pages(site)["addresses.html"].root.xpath('//ul[@class="addresses"]//a/@href')}
    cards = sum(len(programs.deck(name).cards) for name in programs.NAMES)
    assert len([href for href in listed if re.search(r"program\w+\.html#(title|before-|\d)", href)]) == cards
    assert {f"errors.html#error-{number}" for number in explanations()} <= listed


def test_the_home_page_leads_to_the_machine_the_author_the_faults_and_the_downloads(site: Path) -> None:
    home = {str(href) for href in pages(site)["index.html"].root.xpath("//article//a/@href")}
    assert {"console.html", "parting.html", "explanation/context.html", "known-faults.html", "get.html"} <= home
    assert "ERROR IN PROGRAM" in pages(site)["index.html"].root.xpath("string(//article)")


def test_downloads_are_files_of_the_site_and_open(site: Path) -> None:
    links = [str(href) for href in pages(site)["get.html"].root.xpath("//article//a[@download]/@href")]
    assert {"get/source.zip", "get/decks.zip", "get/tei.zip", "get/program3.f"} <= set(links)
    for link in links:
        if link.endswith(".zip"):
            with zipfile.ZipFile(site / link) as archive:
                assert archive.testzip() is None
                assert archive.namelist()
    with zipfile.ZipFile(site / "get/source.zip") as archive:
        assert archive.read("fortran_src/program3.f").decode() == programs.deck("program3").text()


def test_the_plane_misses_its_own_points_exactly_if_eight_digits_are_too_few() -> None:
    for number in (95, 590, 635, 995):
        points = ((number, *essay.FIRST), *essay.CORNERS)
        exact, values = essay.plane_values("exact", points)
        machine, on_machine = essay.plane_values("truncating", points)
        assert values == ["0", "0", "0"]
        assert (machine == exact) == (on_machine == values) == (number < 600)


def test_pages_load_nothing_from_other_servers(site: Path) -> None:
    for page in pages(site).values():
        loaded = page.root.xpath('//link[@rel!="canonical"]/@href | //script/@src | //img/@src | //iframe/@src')
        assert [str(address) for address in loaded if "//" in str(address)] == []
    for sheet in (site / "_static").rglob("*.css"):
        assert not re.search(r"url\(\s*[\"']?(https?:)?//", sheet.read_text(encoding="utf-8")), sheet


def test_heading_levels_are_not_skipped(site: Path) -> None:
    for page in pages(site).values():
        levels = [
            int(heading.tag[1])
            for heading in page.root.xpath("//article//*[self::h1 or self::h2 or self::h3 or self::h4]")
        ]
        assert levels[:1] == [1], page.name
        assert levels.count(1) == 1, page.name
        assert all(after - before <= 1 for before, after in pairwise(levels)), page.name


def test_every_picture_has_a_text_alternative(site: Path) -> None:
    for page in pages(site).values():
        assert page.root.xpath("//article//img[not(@alt) or @alt='']/@src") == [], page.name
        for svg in page.root.xpath("//article//svg[@role]"):
            assert svg.xpath("./title | @aria-label | @aria-labelledby"), page.name


def test_generated_content_does_not_depend_on_process_locale_or_time(site: Path) -> None:
    """The site was built with another hash seed, locale and time zone; this process generates the same content."""
    for file in sorted((ROOT / "docs").rglob("*.md")):
        page = file.relative_to(ROOT / "docs").with_suffix(".html")
        if page.as_posix() not in page_of_each_kind(site):
            continue
        for name, argument in re.findall(r"^:::\{made\} (\S+) ?(\S*)$", file.read_text(encoding="utf-8"), re.MULTILINE):
            html = (site / page).read_text(encoding="utf-8")
            parts = make(name, argument)
            assert [part.id for part in parts if relative(stacked(part.html), len(page.parts) - 1) not in html] == [], (
                page
            )


def test_no_file_names_the_machine_or_the_time_of_the_build(site: Path) -> None:
    for file in site.rglob("*"):
        if file.suffix in (".html", ".js"):
            content = file.read_text(encoding="utf-8")
            assert str(ROOT) not in content, file
            assert time.strftime("%Y-%m-%dT") not in content, file


def test_a_folder_without_a_site_is_not_replaced(tmp_path: Path, capsys) -> None:
    (tmp_path / "thesis.txt").write_text("kept")
    assert site_build.main([str(tmp_path)]) == 2
    assert (
        capsys.readouterr().err
        == f"edition: {tmp_path}: exists and is not a site built by hull1620, so it is not replaced\n"
    )
    assert (tmp_path / "thesis.txt").read_text() == "kept"


def test_html_is_valid(site: Path, tmp_path: Path) -> None:
    validate = editions.MODULES / "html-validate" / "bin" / "html-validate.mjs"
    node = which("node")
    if node is None or not validate.exists():
        pytest.skip("html-validate is missing: npm ci --prefix docs/console")
    # Sphinx's search and the theme's style find the text by article[role=main].
    rules = {
        "root": True,
        "extends": ["html-validate:standard", "html-validate:a11y"],
        "rules": {"prefer-native-element": ["error", {"exclude": ["main"]}]},
    }
    (tmp_path / "rules.json").write_text(json.dumps(rules), encoding="utf-8")
    # By default, the pages that Sphinx alone generates from prose are not validated.
    every = len(page_of_each_kind(site)) == len(pages(site))
    prose = ("tutorial/", "how-to/", "explanation/", "studies/")
    files = [str(site / name) for name in page_of_each_kind(site) if every or not name.startswith(prose)]
    report = tmp_path / "report.json"
    subprocess.run(
        [node, str(validate), "--config", str(tmp_path / "rules.json"), "-f", f"json={report}", *files],
        check=False,
        capture_output=True,
    )
    messages = [
        f"{Path(file['filePath']).name}:{message['line']}: {message['ruleId']}: {message['message']}"
        for file in json.loads(report.read_text(encoding="utf-8"))
        for message in file["messages"]
    ]
    assert messages == []


@pytest.mark.parametrize("project", ["tsconfig.json", "tsconfig.worker.json"])
def test_the_types_of_the_emulator_s_scripts_are_right(project: str) -> None:
    compiler, node = editions.MODULES / "typescript" / "bin" / "tsc", which("node")
    if node is None or not compiler.exists():
        pytest.skip("typescript is missing, the types of the scripts are not checked: npm ci --prefix docs/console")
    command = [node, str(compiler), "--project", str(ROOT / "docs" / "console" / project)]
    process = subprocess.run(command, check=False, capture_output=True, text=True)
    assert process.returncode == 0, process.stdout


def test_unknown_names_and_arguments_are_rejected() -> None:
    assert {"facing", "charts", "addresses", "home"} <= set(names())
    with pytest.raises(ValueError, match="unknown page 'maps'"):
        make("maps", "")
    with pytest.raises(ValueError, match="'program4' is not one of program1"):
        make("facing", "program4")


def test_cells_escapes_and_ids_are_written_correctly() -> None:
    assert element("p", escape('a<b & "c"')) == "<p>a&lt;b &amp; &quot;c&quot;</p>"
    assert element("input", type="radio", checked=True, id="", value="") == '<input type="radio" checked value="">'
    assert code("  I=J+1", ((4, 5),), "ins") == '<code><span class="lead">  I</span>=<ins>J</ins>+1</code>'
    assert relative('<a href="@/a.html">', 2) == '<a href="../../a.html">'
    head = '<?xml version="1.0"?><svg aria-labelledby="t"><style>a{}</style>'
    svg = head + '<title id="t">x</title><use href="#f"/><g id="f"/></svg>'
    assert inline(svg, "k", "c") == (
        '<svg class="c" aria-labelledby="t-k"><title id="t-k">x</title><use href="#f-k"/><g id="f-k"/></svg>'
    )
    assert lowered("H_1 < P_NV+1, x_1, H_2^3") == "H<sub>1</sub> &lt; P<sub>NV+1</sub>, x_1, H_2^3"
    # A percent sign stays with its number.
    wide = "".join(f"<th>{'w' * 30}{n}</th>" for n in range(2))
    gap, cell = "\N{NO-BREAK SPACE}", "<td><a title='1{0}2'>3{0}4</a></td><td>5{0}%</td>"
    html = stacked(f"<table><tr>{wide}</tr><tr>{cell.format(gap)}</tr></table>")
    assert html.count('<wbr class="gap inner">') == 1
    assert f"title='1{gap}2'>3{gap}<wbr" in html


@pytest.mark.parametrize(
    ("page", "names"),
    [("errors", ["5", "13", "E8", "F1", "F9"]), ("statements/yau-srihari", ["Abstract", "3.2.1", "Fig. 1", "4.6.2"])],
)
def test_the_bar_of_a_long_page_has_short_names(site: Path, page: str, names: list[str]) -> None:
    links = pages(site)[f"{page}.html"].root.xpath("//nav[@class='jump']/a")
    assert set(names) <= {words(link) for link in links}
    assert max(len(words(link)) for link in links) < 9


def test_links_of_faults_and_questions_lead_to_pages(site: Path) -> None:
    targets = {str(href) for href in pages(site)["open-questions.html"].root.xpath("//article//a/@href")}
    assert {"known-faults.html", "reference/machine.html"} <= {target.partition("#")[0] for target in targets}
