"""Descriptions of the project for archives, made from CITATION.cff and pyproject.toml.

The module writes ``codemeta.json`` (CodeMeta 3.0), ``ro-crate-metadata.json`` (RO-Crate 1.1, with the package
``rocrate``) and ``datapackage.json`` (a Frictionless data package with a schema for every CSV table).
"""

import csv
import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from io import StringIO
from typing import Any

SPDX = "https://spdx.org/licenses/"


@dataclass(frozen=True, slots=True)
class Work:
    """The project as CITATION.cff and pyproject.toml describe it; ``references`` are the documents that it restores."""

    name: str
    title: str
    description: str
    version: str
    date: str
    license: str
    author: str
    keywords: tuple[str, ...]
    python: str
    requirements: tuple[str, ...]
    references: tuple[str, ...]


def work(citation: Mapping[str, Any], project: Mapping[str, Any], references: Iterable[str]) -> Work:
    """Combine the fields of CITATION.cff with those of pyproject.toml.  Raise ValueError if they contradict."""
    for key in ("version", "license"):
        if citation[key] != project[key]:
            raise ValueError(f"CITATION.cff has {key} {citation[key]}, pyproject.toml {project[key]}")
    return Work(
        project["name"],
        citation["title"],
        project["description"],
        citation["version"],
        str(citation["date-released"]),
        citation["license"],
        citation["authors"][0]["name"],
        tuple(citation["keywords"]),
        project["requires-python"],
        tuple(project["dependencies"]),
        tuple(references),
    )


def codemeta(about: Work) -> str:
    """Return the text of codemeta.json."""
    return _json(
        {
            "@context": "https://w3id.org/codemeta/3.0",
            "type": "SoftwareSourceCode",
            "name": about.title,
            "identifier": about.name,
            "description": about.description,
            "version": about.version,
            "dateModified": about.date,
            "license": SPDX + about.license,
            "author": [{"type": "Organization", "name": about.author}],
            "keywords": list(about.keywords),
            "programmingLanguage": "Python",
            "runtimePlatform": f"Python {about.python}",
            "softwareRequirements": list(about.requirements),
        }
    )


def crate(about: Work, folders: Mapping[str, str], files: Mapping[str, tuple[str, str]]) -> str:
    """Return ro-crate-metadata.json.

    ``folders`` maps a path to its description, and ``files`` a path to its description and media type.
    """
    from rocrate.model.data_entity import DataEntity
    from rocrate.model.person import Person
    from rocrate.rocrate import ROCrate

    rocrate = ROCrate()
    rocrate.name, rocrate.description = about.title, about.description
    rocrate.datePublished = about.date
    rocrate.license = SPDX + about.license
    rocrate.keywords = ", ".join(about.keywords)
    author = rocrate.add(Person(rocrate, "#author", {"@type": "Organization", "name": about.author}))
    rocrate.root_dataset["author"] = author
    rocrate.root_dataset["version"] = about.version
    rocrate.root_dataset["citation"] = list(about.references)
    for path, description in folders.items():
        rocrate.add(DataEntity(rocrate, f"{path}/", {"@type": "Dataset", "name": path, "description": description}))
    for path, (description, media_type) in files.items():
        properties = {"@type": "File", "name": path, "description": description, "encodingFormat": media_type}
        rocrate.add(DataEntity(rocrate, path, properties))
    document = rocrate.metadata.generate()
    # The package writes entities in the order of a set; sorting makes the file the same every time.
    document["@graph"].sort(key=lambda entity: entity["@id"])
    for entity in document["@graph"]:
        if isinstance(entity.get("hasPart"), list):
            entity["hasPart"].sort(key=lambda part: part["@id"])
    return _json(document)


def data_package(about: Work, tables: Mapping[str, str]) -> str:
    """Return datapackage.json with a resource for each CSV table. Raise ValueError for equal names of columns."""
    resources = [
        {
            "name": re.sub(r"[^a-z0-9]+", "-", path.lower().removesuffix(".csv")).strip("-"),
            "path": path,
            "profile": "tabular-data-resource",
            "format": "csv",
            "mediatype": "text/csv",
            "encoding": "utf-8",
            "schema": {"fields": _fields(path, text)},
        }
        for path, text in sorted(tables.items())
    ]
    return _json(
        {
            "profile": "tabular-data-package",
            "name": about.name,
            "title": f"Tables of {about.title}",
            "version": about.version,
            "created": f"{about.date}T00:00:00Z",
            "licenses": [{"name": "CC0-1.0", "path": "https://creativecommons.org/publicdomain/zero/1.0/"}],
            "resources": resources,
        }
    )


def _fields(path: str, text: str) -> list[dict[str, str]]:
    """Return the columns of a table with their types: the narrowest type that all cells of the column have."""
    head, *rows = list(csv.reader(StringIO(text)))
    if duplicates := [name for name in head if head.count(name) > 1]:
        raise ValueError(f"{path}: two columns are called {duplicates[0]}")
    return [{"name": name, "type": _kind([row[k] for row in rows])} for k, name in enumerate(head)]


def _kind(cells: list[str]) -> str:
    if cells and all(re.fullmatch(r"-?\d+", cell) for cell in cells):
        return "integer"
    if cells and all(re.fullmatch(r"-?\d+(\.\d+)?([eE][+-]?\d+)?", cell) for cell in cells):
        return "number"
    return "string"


def _json(value: object) -> str:
    return json.dumps(value, indent=2, ensure_ascii=False) + "\n"
