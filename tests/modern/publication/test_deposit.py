"""The deposit is valid for the packages of each standard, reproducible, and detects changes."""

import json
import re
import subprocess
import tarfile
import tomllib
from pathlib import Path

import pytest

from modern.publication import deposit
from modern.publication.building import BuildError, citation
from modern.publication.deposit import Parts, described, gather, source_files, swhid, write
from modern.publication.metadata import data_package, work
from tests.support.paths import ROOT

bagit = pytest.importorskip("bagit", reason="a bag is checked by bagit")
TABLES = {
    "source/docs/studies/x/table.csv": b"kind,count,share\na,1,0.5\nb,2,1e-3\n",
    "source/docs/studies/x/cards.csv": b"card,words\n1,IF\n",
}
REAL = {f"source/{name}": (ROOT / name).read_bytes() for name in source_files() if re.match(r"docs/.*\.csv$", name)}
"""The tables that a deposit of the project holds."""


def parts() -> Parts:
    files = {
        "source/README.md": b"# x\n",
        "source/.ci/run": b"#!/bin/sh\n",
        "wheel/hull1620-0.1.0-py3-none-any.whl": b"wheel",
        "book/hull1620.pdf": b"%PDF",
        "site/index.html": b"<p>",
        "tei/program1.xml": b"<TEI/>",
        **REAL,
        **TABLES,
    }
    return Parts(files, frozenset({"source/.ci/run"}))


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    return write(tmp_path_factory.mktemp("deposit"), parts())


def test_bagit_accepts_the_bag_and_detects_a_changed_byte(tmp_path: Path) -> None:
    bag, _ = write(tmp_path, parts())
    assert bagit.Bag(str(bag)).validate()
    (bag / "data" / "book" / "hull1620.pdf").write_bytes(b"%PDG")
    with pytest.raises(bagit.BagValidationError, match=r"hull1620\.pdf"):
        bagit.Bag(str(bag)).validate()


def test_the_crate_loads_and_names_existing_files(made: tuple[Path, Path]) -> None:
    from rocrate.rocrate import ROCrate

    data = made[0] / "data"
    crate = ROCrate(str(data))
    assert crate.root_dataset["version"] == described().version
    named = {part.id for part in crate.root_dataset["hasPart"]}
    assert named >= {"source/", "site/", "book/hull1620.pdf", "README.txt", "codemeta.json", "datapackage.json"}
    assert all((data / name).exists() for name in named)


def test_frictionless_accepts_the_tables_and_detects_a_wrong_type(made: tuple[Path, Path]) -> None:
    frictionless = pytest.importorskip("frictionless", reason="tables are checked by frictionless")
    data = made[0] / "data"
    report = frictionless.Package(str(data / "datapackage.json")).validate()
    assert report.valid, report.flatten(["type", "note"])
    assert len(report.tasks) == len(REAL) + 2 > 20
    table = data / "source" / "docs" / "studies" / "x" / "table.csv"
    before = table.read_text()
    table.write_text(before.replace("b,2", "b,two"))
    try:
        assert not frictionless.Package(str(data / "datapackage.json")).validate().valid
    finally:
        table.write_text(before)


def test_duplicate_column_names_are_rejected() -> None:
    with pytest.raises(ValueError, match=r"^a/b\.csv: two columns are called found$"):
        data_package(described(), {"a/b.csv": "n,found,found\n1,2,3\n"})


def test_the_type_of_a_column_fits_all_its_cells() -> None:
    about = described()
    made = json.loads(data_package(about, {name: data.decode() for name, data in TABLES.items()}))
    fields = {field["name"]: field["type"] for table in made["resources"] for field in table["schema"]["fields"]}
    assert fields == {"kind": "string", "count": "integer", "share": "number", "card": "integer", "words": "string"}


def test_all_descriptions_agree(made: tuple[Path, Path]) -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    data = made[0] / "data"
    code = json.loads((data / "codemeta.json").read_text(encoding="utf-8"))
    crate = json.loads((data / "ro-crate-metadata.json").read_text(encoding="utf-8"))
    root = next(entity for entity in crate["@graph"] if entity["@id"] == "./")
    fields = citation()
    assert {project["version"], code["version"], root["version"]} == {fields["version"]}
    assert {code["dateModified"], root["datePublished"]} == {str(fields["date-released"])}
    assert {code["name"], root["name"]} == {fields["title"]}
    assert code["license"] == root["license"] == f"https://spdx.org/licenses/{project['license']}"
    assert code["softwareRequirements"] == project["dependencies"]
    assert len(root["citation"]) == 5


def test_a_citation_of_another_version_is_rejected() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    with pytest.raises(ValueError, match=r"CITATION\.cff has version 0\.1\.0, pyproject\.toml 9"):
        work(citation(), project | {"version": "9"}, ())


def test_two_deposits_are_identical(tmp_path: Path, made: tuple[Path, Path]) -> None:
    again = write(tmp_path, parts())
    assert again[1].read_bytes() == made[1].read_bytes()
    first, second = (
        {p.relative_to(b): p.read_bytes() for p in b.rglob("*") if p.is_file()} for b in (made[0], again[0])
    )
    first.pop(Path("data/source/docs/studies/x/table.csv"))
    second.pop(Path("data/source/docs/studies/x/table.csv"))
    assert first == second
    with tarfile.open(made[1]) as archive:
        modes = {entry.name.rpartition("/data/")[2]: entry.mode for entry in archive}
    assert modes["source/.ci/run"] == 0o755
    assert modes["source/README.md"] == 0o644


def test_the_identifier_is_the_hash_of_the_git_tree(tmp_path: Path) -> None:
    files = {"b/x": b"1\n", "a": b"2\n", "b.c": b"3\n", "b/y/z": b"4\n"}
    for name, data in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_bytes(data)
    (tmp_path / "a").chmod(0o755)
    for arguments in (["init", "-q"], ["add", "-A"]):
        subprocess.run(["git", *arguments], cwd=tmp_path, check=True)
    tree = subprocess.run(
        ["git", "write-tree"], cwd=tmp_path, check=True, capture_output=True, text=True
    ).stdout.strip()
    assert swhid(files, {"a"}) == f"swh:1:dir:{tree}"
    assert swhid(files, set()) != f"swh:1:dir:{tree}"


def test_without_git_build_results_are_omitted(tmp_path: Path) -> None:
    for name in ("README.md", "dist/x", "build/y", "emulator/__pycache__/z.pyc", "emulator/a.py", ".venv/b"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("x")
    assert source_files(tmp_path) == ("README.md", "emulator/a.py")


def test_the_readme_names_the_required_packages(made: tuple[Path, Path]) -> None:
    text = (made[0] / "data" / "README.txt").read_text(encoding="utf-8")
    for phrase in (
        "lark==",
        "mpmath==",
        "numpy==",
        "wheel/hull1620-0.1.0-py3-none-any.whl",
        "hull1620 reproduce",
        "swh:1:dir:",
    ):
        assert phrase in text
    assert "setuptools" not in text, "the wheel does not need it"
    assert not re.search(r"\brows/", text), "what is not in the bag is not spoken of"


def test_missing_parts_and_foreign_folders_are_reported_in_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(BuildError, match=r"hull1620\.whl: no such file; make wheel builds it"):
        gather(tmp_path / "hull1620.whl", tmp_path, tmp_path / "x.pdf")
    about = described()
    in_the_way = tmp_path / f"{about.name}-{about.version}-deposit"
    in_the_way.mkdir()
    (in_the_way / "notes.txt").write_text("x")
    with pytest.raises(BuildError, match="exists and is not a BagIt bag, so it is not replaced"):
        write(tmp_path, parts())
    monkeypatch.setattr(deposit, "DIST", tmp_path / "dist")
    assert deposit.main([str(tmp_path)]) == 2
    assert capsys.readouterr().err.count("\n") == 1
