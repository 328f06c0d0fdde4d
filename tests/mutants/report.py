"""The table of an area in ``build/mutants``: what an interrupted run goes on from, and what is said in the end."""

from __future__ import annotations

import csv
import hashlib
import re
import shutil
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from emulator.files import writing
from tests.mutants.sample import Mutant, difference, mutated
from tests.mutants.trial import EQUIVALENT, KILLED, SURVIVED, TIMEOUT, Verdict

FIELDS = ("run", "area", "file", "line", "column", "operator", "occurrence", "outcome", "seconds")


def fingerprint(copy: Path) -> str:
    """A short name for the state of the tree, without its documents and without this package."""
    found = hashlib.sha256()
    for path in sorted(copy.rglob("*")):
        name = path.relative_to(copy).as_posix()
        if path.is_file() and not name.startswith("tests/mutants/") and path.suffix not in (".md", ".pyc"):
            found.update(f"\0{name}\0".encode() + path.read_bytes())
    return found.hexdigest()[:12]


def earlier(table: Path, run: str, drawn: Iterable[Mutant]) -> list[Verdict]:
    """The verdicts that an earlier run of the same name has given on these mutants."""
    by_row = {(mutant.file, mutant.operator, str(mutant.occurrence)): mutant for mutant in drawn}
    if not table.exists():
        return []
    with table.open(encoding="utf-8", newline="") as file:
        return [
            Verdict(by_row[key], row["outcome"], float(row["seconds"]))
            for row in csv.DictReader(file)
            if row["run"] == run and (key := (row["file"], row["operator"], row["occurrence"])) in by_row
        ]


def write_table(table: Path, run: str, area: str, verdicts: Sequence[Verdict]) -> None:
    """All verdicts so far, by file and line, written atomically."""
    table.parent.mkdir(parents=True, exist_ok=True)
    with writing(str(table)) as file:
        writer = csv.writer(file)
        writer.writerow(FIELDS)
        for verdict in sorted(verdicts, key=lambda verdict: (verdict.mutant.place, verdict.mutant.operator)):
            m = verdict.mutant
            place = (m.file, m.line, m.column, m.operator, m.occurrence)
            writer.writerow((run, area, *place, verdict.outcome, f"{verdict.seconds:.1f}"))


def write_survivors(folder: Path, verdicts: Iterable[Verdict], sources: Mapping[str, str]) -> list[Path]:
    """A diff for each mutant that survived; whatever was in the folder is deleted."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    written = []
    for mutant in (verdict.mutant for verdict in verdicts if verdict.outcome == SURVIVED):
        source = sources[mutant.file]
        name = re.sub(r"\W+", "-", f"{mutant.file.removesuffix('.py')} {mutant.line} {mutant.column}")
        path = folder / f"{name}-{mutant.operator.rpartition('/')[2]}-{mutant.occurrence}.diff"
        path.write_text(difference(mutant.file, source, mutated(source, mutant)), encoding="utf-8")
        written.append(path)
    return written


def summary(area: str, verdicts: Iterable[Verdict]) -> str:
    """One line: how many were killed of those that are not equivalent."""
    count = Counter(verdict.outcome for verdict in verdicts)
    noticed = count[KILLED] + count[TIMEOUT]
    of = noticed + count[SURVIVED]
    share = f" ({noticed / of:.0%})" if of else ""
    words = f"{area}: {noticed} of {of} mutants killed{share}, {count[TIMEOUT]} of them by time"
    return f"{words}; {count[SURVIVED]} survived, {count[EQUIVALENT]} equivalent"
