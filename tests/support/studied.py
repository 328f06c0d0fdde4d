"""A small study for tests that run it, some of them in other processes."""

import json
from pathlib import Path

from modern.study import Cell, Plan, Port, Programs
from modern.study.index import NAME as INDEX

ROUTES = (Programs("listed", limit=20_000), Port("exact"))
PLAN = Plan(
    "small",
    "A small study",
    "Does it repeat?",
    (
        Cell({"n": 5}, "integers", {"digits": 1, "n": 5}, ROUTES, 24, chunk=5),
        Cell({"n": 9}, "thesis", {"kinds": {"slab": 1}, "n": 9}, ROUTES, 20, chunk=4),
    ),
    seed=5,
)


def contents(folder: Path) -> dict[str, bytes]:
    """Return all files except the index, whose bytes may differ, and the command in the manifest."""
    files = {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and not path.name.startswith(INDEX)
    }
    manifest = json.loads(files.pop("manifest.json"))
    manifest.pop("command")
    return {**files, "manifest.json": json.dumps(manifest).encode()}
