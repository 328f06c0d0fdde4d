"""The deposit is valid for the packages of each standard, reproducible, and detects changes."""

import csv
import json
import re
import subprocess
import tarfile
import tomllib
import zipfile
from dataclasses import replace
from datetime import UTC, datetime
from importlib.util import find_spec
from pathlib import Path

import pytest

from modern.publication import deposit, vendored
from modern.publication.building import BuildError, citation
from modern.publication.deposit import Parts, described, gather, readme, source_files, swhid, write
from modern.publication.metadata import codemeta, work
from modern.publication.tables import UNDESCRIBED, columns, csv_text
from tests.support.paths import ROOT

bagit = pytest.importorskip("bagit", reason="a bag is checked by bagit")
TABLES = {
    "source/docs/studies/x/table.csv": b"kind,failed,of all sets\na,1,0.5 (0.1 to 0.9) %\nb,2,-\n",
    "source/docs/studies/x/cards.csv": b"card,statement\n1,IF\n",
}
REAL = {f"source/{name}": (ROOT / name).read_bytes() for name in source_files() if re.match(r"docs/.*\.csv$", name)}
"""The tables that a deposit of the project holds."""
STUDIES = "capacity|digits|divergence|epsilon|machine-time|rounding|seventy|translation"
DESCRIBED = {
    name for name in REAL if re.match(rf"source/docs/(figures|subjects|weight|ibm1962|studies/({STUDIES}))", name)
}


def parts() -> Parts:
    files = {
        "source/README.md": b"# x\n",
        "source/.ci/run": b"#!/bin/sh\n",
        "hull1620.pyz": b"#!",
        "wheel/hull1620-0.1.0-py3-none-any.whl": b"wheel",
        "source/docs/studies/seventy/manifest.json": (ROOT / "docs/studies/seventy/manifest.json").read_bytes(),
        "book/hull1620.pdf": b"%PDF",
        "site/index.html": b"<p>",
        "tei/program1.xml": b"<TEI/>",
        **REAL,
        **TABLES,
    }
    return Parts(files, frozenset({"source/.ci/run"}))


@pytest.fixture(scope="module")
def made(tmp_path_factory) -> tuple[Path, Path]:
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
    table = data / "tables" / "studies" / "x" / "table.csv"
    before = table.read_text()
    assert before.splitlines()[0] == 'kind,failed,of all sets,"of all sets, low","of all sets, high"'
    table.write_text(before.replace("b,2", "b,two"))
    try:
        assert not frictionless.Package(str(data / "datapackage.json")).validate().valid
    finally:
        table.write_text(before)


def test_descriptions_are_generated_and_citations_checked() -> None:
    with pytest.raises(ValueError, match=r"^a/b\.csv: two columns are called found$"):
        columns("a/b.csv", "n,found,found\n1,2,3\n")
    assert (ROOT / "codemeta.json").read_text(encoding="utf-8") == codemeta(described())
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    with pytest.raises(ValueError, match=r"CITATION\.cff has version 0\.1\.0, pyproject\.toml 9"):
        work(citation(), project | {"version": "9"}, ())


def test_numbers_are_numbers_with_bounds_in_columns_of_their_own() -> None:
    text = "sets,failed,of all sets,no failure at e\nball,3,0.5 (0.1 to 0.9) %,10^-3 to 10^1\ncube,4,-,10^0\n"
    table = {column.name: column for column in columns("a.csv", text)}
    assert {name: (column.kind, column.cells) for name, column in table.items()} == {
        "sets": ("string", ("ball", "cube")),
        "failed": ("integer", ("3", "4")),
        "of all sets": ("number", ("0.5", "")),
        "of all sets, low": ("number", ("0.1", "")),
        "of all sets, high": ("number", ("0.9", "")),
        "no failure at e, from": ("number", ("1e-3", "1e0")),
        "no failure at e, to": ("number", ("1e1", "1e0")),
    }
    assert table["of all sets, low"].description.startswith("lower bound of the 95 % interval: ")
    _, low, high = columns("b.csv", "longest\n2.5 (2.1 to 3.0)\n")
    assert [bound.description for bound in (low, high)] == [
        f"{bound} bound of the interval: longest time in minutes, by the systematic error of the timing model"
        for bound in ("lower", "upper")
    ]
    assert table["of all sets"].description == "share of all sets, in percent"
    assert next(csv.reader([csv_text(tuple(table.values())).splitlines()[1]])) == [
        *("ball", "3", "0.5", "0.1", "0.9", "1e-3", "1e1")
    ]


def test_every_column_of_every_table_is_described_and_no_interval_remains_in_a_cell() -> None:
    described_columns = 0
    for name, data in REAL.items():
        for column in columns(name, data.decode()):
            assert name not in DESCRIBED or not column.description.startswith(UNDESCRIBED), (name, column.name)
            assert not any(re.search(r"\d \(|\d %$", cell) for cell in column.cells), (name, column.name)
            described_columns += 1
    assert described_columns > 200
    (column,) = columns("docs/studies/x/table.csv", "unheard of\n1\n")
    assert column.description == f"{UNDESCRIBED} docs/studies/x"


def test_the_crate_states_rights_identifiers_and_the_runs_of_studies(made: tuple[Path, Path]) -> None:
    graph = json.loads((made[0] / "data" / "ro-crate-metadata.json").read_text(encoding="utf-8"))["@graph"]
    entities = {entity["@id"]: entity for entity in graph}
    named = {part["@id"] for part in entities["./"]["hasPart"]}
    assert all(
        entities[entities[name]["license"]["@id"]]["name"] if entities[name]["license"]["@id"][0] == "#" else 1
        for name in named
    )
    assert "MIT" in entities["hull1620.pyz"]["license"]["@id"]
    assert "publicdomain" in entities["tables/studies/seventy/table.csv"]["license"]["@id"]
    values = {e["name"]: e["value"] for e in graph if e["@type"] == "PropertyValue"}
    assert values == dict.fromkeys(("doi", "swhid", "repository", "person"), "not known yet")
    (run,) = (entity for entity in graph if entity["@type"] == "CreateAction")
    assert run["instrument"] == {"@id": "#software"}
    assert {"@id": "tables/studies/seventy/table.csv"} in run["result"]
    assert all(result["@id"] in entities for result in run["result"])
    assert run["description"].startswith("hull1620 study seventy: 174000 sets, seed ")
    assert entities["./"]["conformsTo"]["@id"] in entities


def test_known_identifiers_are_stated_everywhere() -> None:
    about = replace(described(), doi="10.1/x", repository="https://example.org/r", person="A. Person")
    code = json.loads(codemeta(about))
    assert (code["sameAs"], code["codeRepository"]) == ("https://doi.org/10.1/x", "https://example.org/r")
    assert about.identifiers() == {
        "doi": "10.1/x",
        "swhid": "not known yet",
        "repository": "https://example.org/r",
        "person": "A. Person",
    }


def test_missing_packages_of_others_are_named_and_present_ones_keep_their_licences(tmp_path: Path) -> None:
    nothing = vendored.files(tmp_path / "wheels", tmp_path / "pyodide")
    assert nothing == {}
    assert "LEFT OUT" in vendored.left_out(nothing)
    assert all(
        pin in vendored.left_out(nothing) for pin in ("lark==", "numpy==", "sphinx==", "setuptools==", "Pyodide")
    )
    (tmp_path / "wheels").mkdir()
    (tmp_path / "pyodide").mkdir()
    (tmp_path / "pyodide" / "package.json").write_text("{}")
    for pin in vendored.collected():
        name = "-".join((pin.split("==")[0].replace("-", "_"), pin.split("==")[1]))
        with zipfile.ZipFile(tmp_path / "wheels" / f"{name}-py3-none-any.whl", "w") as wheel:
            wheel.writestr(f"{name}.dist-info/licenses/LICENSE.txt", "a licence")
    found = vendored.files(tmp_path / "wheels", tmp_path / "pyodide")
    assert vendored.left_out(found) == ""
    assert [name for name in found if "licences" in name and "lark" in name and found[name] == b"a licence"]
    assert not any(name.startswith("setuptools") for name in vendored.locked())
    (tmp_path / "wheels" / f"{name}-py3-none-any.whl").unlink()
    assert f"the wheels of {pin}." in vendored.left_out(vendored.files(tmp_path / "wheels", tmp_path / "pyodide"))


def test_the_collected_packages_suffice_to_build_and_have_wheels() -> None:
    packages = vendored.collected()
    names = {pin.split("==")[0] for pin in packages}
    assert names >= {"setuptools", "build", "sphinx", "furo", "myst-parser", "typst", "docutils", "numpy", "lark"}
    assert not names & {"pytest", "mypy", "numba", "colorama", "bagit"}
    # A package that is published as source only has the hash of one file.
    blocks = vendored.pins("dev")
    assert {pin.split("==")[0] for pin in blocks if "bagit" in pin} == set(vendored.SOURCE_ONLY)
    assert all(block.count("sha256:") > 1 for block in packages.values())


def test_wheels_of_other_versions_are_removed_and_missing_ones_downloaded(tmp_path: Path, monkeypatch) -> None:
    lark = next(pin for pin in vendored.locked() if pin.startswith("lark=="))
    (tmp_path / "lark-0.1-py3-none-any.whl").touch()
    for pin in vendored.collected().keys() - {lark}:
        (tmp_path / f"{pin.split('==')[0].replace('-', '_')}-{pin.split('==')[1]}-py3-none-any.whl").touch()
    downloaded: list[str] = []

    def pip(command: list[str], **_: object) -> subprocess.CompletedProcess[str]:
        downloaded.append(Path(command[-1]).read_text(encoding="utf-8"))
        return subprocess.CompletedProcess(command, 1, "", "no network\n")

    monkeypatch.setattr(vendored.subprocess, "run", pip)
    assert "the deposit will lack 1 wheels, because pip failed: no network" in vendored.download(tmp_path)
    assert downloaded == [vendored.locked()[lark] + "\n"]
    assert not list(tmp_path.glob("lark-*"))


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


def test_two_deposits_are_identical(tmp_path: Path, made: tuple[Path, Path]) -> None:
    again = write(tmp_path, parts())
    assert again[1].read_bytes() == made[1].read_bytes()
    first, second = (
        {p.relative_to(b): p.read_bytes() for p in b.rglob("*") if p.is_file()} for b in (made[0], again[0])
    )
    first.pop(Path("data/tables/studies/x/table.csv"))
    second.pop(Path("data/tables/studies/x/table.csv"))
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


def test_without_git_build_results_are_omitted(tmp_path: Path, monkeypatch) -> None:
    for name in ("README.md", "dist/x", "build/y", "emulator/__pycache__/z.pyc", "emulator/a.py", ".venv/b"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("x")
    monkeypatch.setattr(deposit, "ROOT", tmp_path)
    assert source_files() == ("README.md", "emulator/a.py")


def test_the_readme_names_the_required_packages(made: tuple[Path, Path]) -> None:
    text = (made[0] / "data" / "README.txt").read_text(encoding="utf-8")
    for phrase in (
        "lark==",
        "mpmath==",
        "numpy==",
        "wheel/hull1620-0.1.0-py3-none-any.whl",
        "hull1620 reproduce",
        "python3 hull1620.pyz run",
        "Nobody who worked on this edition has seen a page",
        "LEFT OUT of this deposit",
        "doi         not known yet",
        "swh:1:dir:",
        "  hull1620.pyz (",
        "  source/ (",
        "      rights: spdx.org/licenses/MIT",
    ):
        assert phrase in text
    assert not re.search(r"\brows/", text), "what is not in the bag is not spoken of"


def test_the_readme_builds_the_site_with_modules_and_files_of_the_deposit() -> None:
    files = dict.fromkeys((*parts().files, "wheels/numpy-2-cp311-cp311-linux.whl", "pyodide/package.json"), b"")
    text = readme(described(), Parts(files | {f"source/{name}": b"" for name in source_files()}))
    section = text.partition("TO BUILD THE SITE AGAIN")[2].partition("TO VERIFY")[0]
    commands = [line.strip() for line in section.splitlines() if line.startswith("  ")]
    assert "env/bin/python -m pip install --no-index wheels/*.whl" in commands
    modules = re.findall(r"-m (modern[\w.]+)", section)
    assert len(modules) == 3
    assert all(
        f"source/{module.replace('.', '/')}.py" in files | parts().files or find_spec(module) for module in modules
    )
    copied = re.findall(r"\.\./(pyodide|site)", section)
    assert copied == ["pyodide", "site"]
    assert "Python for cp311-cp311-linux,\nthe platform of the binary wheels (numpy)" in section
    assert "bagit==" in section
    day = datetime.fromtimestamp(int(re.findall(r"SOURCE_DATE_EPOCH=(\d+)", section)[0]), UTC)
    assert f"{day:%Y-%m-%d %H%M}" == f"{described().date} 0000"


def test_a_deposit_contains_the_benchmark(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr(
        "modern.bench.benchmark.benchmark", lambda: {"original/program1.f": "C\n", "verdicts.json": "[]"}
    )
    for name in ("hull1620-1-py3-none-any.whl", "hull1620.pyz", "hull1620.pdf", "edition/index.html"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_bytes(b"x")
    files = gather(tmp_path).files
    assert (files["benchmark/original/program1.f"], files["benchmark/verdicts.json"]) == (b"C\n", b"[]")
    assert deposit.CONTENTS["benchmark/"].licence.endswith("publicdomain/zero/1.0/")
    assert "not ours to license" in deposit.CONTENTS["benchmark/original/"].licence


def test_missing_parts_and_foreign_folders_are_reported_in_one_line(tmp_path: Path, capsys, monkeypatch) -> None:
    with pytest.raises(BuildError, match=r"hull1620\.whl: no such file; make wheel builds it"):
        gather(tmp_path)
    about = described()
    in_the_way = tmp_path / f"{about.name}-{about.version}-deposit"
    in_the_way.mkdir()
    (in_the_way / "notes.txt").write_text("x")
    with pytest.raises(BuildError, match="exists and is not a BagIt bag, so it is not replaced"):
        write(tmp_path, parts())
    monkeypatch.setattr(deposit, "DIST", tmp_path / "dist")
    assert deposit.main([str(tmp_path)]) == 2
    assert capsys.readouterr().err.count("\n") == 1
