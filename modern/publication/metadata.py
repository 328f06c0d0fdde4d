"""What archives ask of a work, made from one place: CITATION.cff says it, this module says it in their words.

``codemeta.json`` (CodeMeta 3.0), the RO-Crate's root (RO-Crate 1.1, by the package ``rocrate``), and a Frictionless
data package with a schema for every CSV table.  Only what a standard asks for by name is here; nothing is typed twice.
"""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from io import StringIO
from typing import Any

SPDX = "https://spdx.org/licenses/"
_FIELD = re.compile(r'^([a-z-]+): "?([^"\n]+)"?$', re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Work:
    """The edition, as CITATION.cff and pyproject.toml have it.  ``references`` are the documents it is about."""

    name: str
    title: str
    description: str
    version: str
    date: str
    license: str
    author: str
    keywords: tuple[str, ...]
    python: str
    needs: tuple[str, ...]
    references: tuple[str, ...]


def work(citation: str, project: Mapping[str, Any], references: Iterable[str]) -> Work:
    """The work from the text of CITATION.cff and the table ``project`` of pyproject.toml.

    Raises ValueError where the two do not say the same of version or licence.
    """
    fields = dict(_FIELD.findall(citation.split("references:")[0]))
    for key, name in (("version", "version"), ("license", "license")):
        if fields[key] != project[name]:
            raise ValueError(f"CITATION.cff has {key} {fields[key]}, pyproject.toml {project[name]}")
    authors = re.search(r'^authors:\n  - name: "([^"]+)"', citation, re.MULTILINE)
    keywords = re.search(r"^keywords:\n((?:  - .+\n)+)", citation, re.MULTILINE)
    return Work(
        project["name"],
        fields["title"],
        project["description"],
        fields["version"],
        fields["date-released"],
        fields["license"],
        authors[1] if authors else "",
        tuple(re.findall(r"- (.+)", keywords[1])) if keywords else (),
        project["requires-python"],
        tuple(project["dependencies"]),
        tuple(references),
    )


def codemeta(found: Work) -> str:
    """codemeta.json."""
    return _json(
        {
            "@context": "https://w3id.org/codemeta/3.0",
            "type": "SoftwareSourceCode",
            "name": found.title,
            "identifier": found.name,
            "description": found.description,
            "version": found.version,
            "dateModified": found.date,
            "license": SPDX + found.license,
            "author": [{"type": "Organization", "name": found.author}],
            "keywords": list(found.keywords),
            "programmingLanguage": "Python",
            "runtimePlatform": f"Python {found.python}",
            "softwareRequirements": list(found.needs),
        }
    )


def crate(found: Work, folders: Mapping[str, str], files: Mapping[str, tuple[str, str]]) -> str:
    """ro-crate-metadata.json.

    ``folders`` are the paths of datasets and what they are, ``files`` those of files, what they are and their media
    type.
    """
    from rocrate.model.data_entity import DataEntity
    from rocrate.model.person import Person
    from rocrate.rocrate import ROCrate

    made = ROCrate()
    made.name, made.description = found.title, found.description
    made.datePublished = found.date
    made.license = SPDX + found.license
    made.keywords = ", ".join(found.keywords)
    author = made.add(Person(made, "#author", {"@type": "Organization", "name": found.author}))
    made.root_dataset["author"] = author
    made.root_dataset["version"] = found.version
    made.root_dataset["citation"] = list(found.references)
    for path, words in folders.items():
        made.add(DataEntity(made, f"{path}/", {"@type": "Dataset", "name": path, "description": words}))
    for path, (words, kind) in files.items():
        about = {"@type": "File", "name": path, "description": words, "encodingFormat": kind}
        made.add(DataEntity(made, path, about))
    held = made.metadata.generate()
    held["@graph"].sort(key=lambda entity: entity["@id"])
    for entity in held["@graph"]:
        if isinstance(entity.get("hasPart"), list):
            entity["hasPart"].sort(key=lambda part: part["@id"])
    return _json(held)


def data_package(found: Work, tables: Mapping[str, str]) -> str:
    """datapackage.json: a Frictionless resource for each CSV table, by its path and text.

    Raises ValueError for a table with two columns of one name, by which no cell could be named.
    """
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
            "name": found.name,
            "title": f"Tables of {found.title}",
            "version": found.version,
            "created": f"{found.date}T00:00:00Z",
            "licenses": [{"name": "CC0-1.0", "path": "https://creativecommons.org/publicdomain/zero/1.0/"}],
            "resources": resources,
        }
    )


def _fields(path: str, text: str) -> list[dict[str, str]]:
    """A table's columns: whole numbers, numbers or words, as all of their cells are."""
    head, *rows = list(csv.reader(StringIO(text)))
    if twice := [name for name in head if head.count(name) > 1]:
        raise ValueError(f"{path}: two columns are called {twice[0]}")
    return [{"name": name, "type": _kind([row[k] for row in rows])} for k, name in enumerate(head)]


def _kind(cells: list[str]) -> str:
    if cells and all(re.fullmatch(r"-?\d+", cell) for cell in cells):
        return "integer"
    if cells and all(re.fullmatch(r"-?\d+(\.\d+)?([eE][+-]?\d+)?", cell) for cell in cells):
        return "number"
    return "string"


def _json(value: object) -> str:
    return json.dumps(value, indent=2, ensure_ascii=False) + "\n"
