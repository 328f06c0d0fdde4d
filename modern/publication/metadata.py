"""Descriptions of the project for archives, made from CITATION.cff and pyproject.toml.

The module writes ``codemeta.json`` (CodeMeta 3.0), ``ro-crate-metadata.json`` (RO-Crate 1.1, with the package
``rocrate``) and ``datapackage.json`` (a Frictionless data package with a schema for every CSV table).
"""

import json
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from modern.publication.tables import MISSING, Column

SPDX = "https://spdx.org/licenses/"
PROCESS = "https://w3id.org/ro/wfrun/process/0.5"
UNKNOWN = "not known yet"
_IDENTIFIERS = ("doi", "swhid", "repository", "person")


@dataclass(frozen=True, slots=True)
class Work:
    """The project as CITATION.cff and pyproject.toml describe it.

    ``references`` are the thesis and the papers.  ``doi``, ``swhid``, ``repository`` and ``person`` are empty until
    they are known.
    """

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
    doi: str = ""
    swhid: str = ""
    repository: str = ""
    person: str = ""

    def identifiers(self) -> dict[str, str]:
        """Return DOI, SWHID, repository and responsible person by name, with ``UNKNOWN`` for each that is empty."""
        return {name: getattr(self, name) or UNKNOWN for name in _IDENTIFIERS}


@dataclass(frozen=True, slots=True)
class Part:
    """A file or folder of the deposit. ``licence`` is an address or a sentence about the rights."""

    description: str
    licence: str
    media_type: str = ""


@dataclass(frozen=True, slots=True)
class Process:
    """A run of the software that produced files of the deposit.

    ``versions`` are those of the packages that the run used, and ``results`` are the paths of the files that it
    produced.
    """

    name: str
    title: str
    command: str
    versions: Mapping[str, str]
    results: tuple[str, ...]
    description: str


def work(
    citation: Mapping[str, Any],
    project: Mapping[str, Any],
    references: Iterable[str],
    identifiers: Mapping[str, str] | None = None,
) -> Work:
    """Combine the fields of CITATION.cff with those of pyproject.toml.

    ``identifiers`` may have a DOI, a SWHID, a repository and a responsible person.  Raise ValueError if the two files
    contradict each other.
    """
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
        **(identifiers or {}),
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
            **({"codeRepository": about.repository} if about.repository else {}),
            **({"sameAs": f"https://doi.org/{about.doi}"} if about.doi else {}),
            **({"maintainer": {"type": "Person", "name": about.person}} if about.person else {}),
        }
    )


def crate(about: Work, parts: Mapping[str, Part], processes: Sequence[Process]) -> str:
    """Return the text of ro-crate-metadata.json.

    ``parts`` maps a path to its description.  The path of a folder ends with a slash.  ``processes`` are the runs that
    produced files of the deposit, described as a Process Run Crate.
    """
    from rocrate.model.contextentity import ContextEntity
    from rocrate.model.data_entity import DataEntity
    from rocrate.model.person import Person
    from rocrate.rocrate import ROCrate

    rocrate = ROCrate()
    rocrate.name, rocrate.description = about.title, about.description
    rocrate.datePublished = about.date
    rocrate.license = SPDX + about.license
    rocrate.keywords = ", ".join(about.keywords)
    author = rocrate.add(Person(rocrate, "#author", {"@type": "Organization", "name": about.author}))
    root = rocrate.root_dataset
    root["author"] = author
    root["version"] = about.version
    root["citation"] = list(about.references)
    root["identifier"] = [
        rocrate.add(ContextEntity(rocrate, f"#{name}", {"@type": "PropertyValue", "name": name, "value": value}))
        for name, value in about.identifiers().items()
    ]
    root["conformsTo"] = rocrate.add(
        ContextEntity(rocrate, PROCESS, {"@type": "CreativeWork", "name": "Process Run Crate", "version": "0.5"})
    )
    for licence in sorted({part.licence for part in parts.values()}):
        if not licence.startswith("https:"):
            rocrate.add(ContextEntity(rocrate, _rights(licence), {"@type": "CreativeWork", "name": licence}))
    for path, part in parts.items():
        kind = {"@type": "Dataset"} if path.endswith("/") else {"@type": "File", "encodingFormat": part.media_type}
        rights = {"@id": _rights(part.licence)}
        properties = {**kind, "name": path.rstrip("/"), "description": part.description, "license": rights}
        rocrate.add(DataEntity(rocrate, path, properties))
    software = {"@type": "SoftwareApplication", "name": about.name, "version": about.version}
    instrument = rocrate.add(ContextEntity(rocrate, "#software", software))
    root["mentions"] = [
        rocrate.add(
            ContextEntity(
                rocrate,
                f"#run-{process.name}",
                {
                    "@type": "CreateAction",
                    "name": process.title,
                    "description": f"{process.command}: {process.description}",
                    "instrument": {"@id": instrument.id},
                    "agent": {"@id": "#author"},
                    "result": [{"@id": path} for path in process.results],
                    "softwareRequirements": [f"{name} {version}" for name, version in process.versions.items()],
                    "actionStatus": "http://schema.org/CompletedActionStatus",
                },
            )
        )
        for process in processes
    ]
    document = rocrate.metadata.generate()
    # The package writes entities in the order of a set; sorting makes the file the same every time.
    document["@graph"].sort(key=lambda entity: entity["@id"])
    for entity in document["@graph"]:
        if isinstance(entity.get("hasPart"), list):
            entity["hasPart"].sort(key=lambda part: part["@id"])
    return _json(document)


def _rights(licence: str) -> str:
    """Return the id of a licence in the crate: its address, or an id made from its text if it has no address."""
    return licence if licence.startswith("https:") else "#" + re.sub(r"\W+", "-", licence.lower()).strip("-")[:60]


def data_package(about: Work, tables: Mapping[str, Sequence[Column]]) -> str:
    """Return the text of datapackage.json, which lists the tables by their paths and describes their columns."""
    resources = [
        {
            "name": re.sub(r"[^a-z0-9]+", "-", path.lower().removesuffix(".csv")).strip("-"),
            "path": path,
            "profile": "tabular-data-resource",
            "format": "csv",
            "mediatype": "text/csv",
            "encoding": "utf-8",
            "schema": {
                "fields": [{"name": c.name, "type": c.kind, "description": c.description} for c in table],
                "missingValues": list(MISSING),
            },
        }
        for path, table in sorted(tables.items())
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


def _json(value: object) -> str:
    return json.dumps(value, indent=2, ensure_ascii=False) + "\n"
