"""The results in ``build/mutants``: the table of an area, from which a run continues, the diffs, and the summary."""

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
    """Return a short hash of the tree without its documents and without this package."""
    total = hashlib.sha256()
    for path in sorted(copy.rglob("*")):
        name = path.relative_to(copy).as_posix()
        if path.is_file() and not name.startswith("tests/mutants/") and path.suffix not in (".md", ".pyc"):
            total.update(f"\0{name}\0".encode() + path.read_bytes())
    return total.hexdigest()[:12]


def earlier(table: Path, run: str, drawn: Iterable[Mutant]) -> list[Verdict]:
    """Return the verdicts of an earlier run of the same name on these mutants."""
    by_row = {(mutant.file, mutant.operator, str(mutant.occurrence)): mutant for mutant in drawn}
    if not table.exists():
        return []
    with table.open(encoding="utf-8", newline="") as file:
        return [
            Verdict(by_row[key], row["outcome"], float(row["seconds"]))
            for row in csv.DictReader(file)
            if row["run"] == run and (key := (row["file"], row["operator"], row["occurrence"])) in by_row
        ]


def write_table(table: Path, run: str, area: str, verdicts: Iterable[Verdict]) -> None:
    """Write the verdicts by file and line, atomically."""
    table.parent.mkdir(parents=True, exist_ok=True)
    with writing(str(table)) as file:
        writer = csv.writer(file)
        writer.writerow(FIELDS)
        for verdict in sorted(verdicts, key=lambda verdict: (verdict.mutant.place, verdict.mutant.operator)):
            m = verdict.mutant
            place = (m.file, m.line, m.column, m.operator, m.occurrence)
            writer.writerow((run, area, *place, verdict.outcome, f"{verdict.seconds:.1f}"))


def write_survivors(folder: Path, verdicts: Sequence[Verdict], sources: Mapping[str, str]) -> list[Path]:
    """Replace the content of the folder by a diff for each mutant that survived. Return the files."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    paths = []
    for mutant in (verdict.mutant for verdict in verdicts if verdict.outcome == SURVIVED):
        source = sources[mutant.file]
        name = re.sub(r"\W+", "-", f"{mutant.file.removesuffix('.py')} {mutant.line} {mutant.column}")
        paths.append(folder / f"{name}-{mutant.operator.rpartition('/')[2]}-{mutant.occurrence}.diff")
        paths[-1].write_text(difference(mutant.file, source, mutated(source, mutant)), encoding="utf-8")
    return paths


def summary(area: str, verdicts: Iterable[Verdict]) -> str:
    """Return one line: the number of mutants killed, of those that are not equivalent."""
    count = Counter(verdict.outcome for verdict in verdicts)
    killed = count[KILLED] + count[TIMEOUT]
    total = killed + count[SURVIVED]
    share = f" ({killed / total:.0%})" if total else ""
    return (
        f"{area}: {killed} of {total} mutants killed{share}, {count[TIMEOUT]} of them by time; "
        f"{count[SURVIVED]} survived, {count[EQUIVALENT]} equivalent"
    )
