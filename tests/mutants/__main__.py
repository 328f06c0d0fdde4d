"""``python -m tests.mutants``: the command behind ``make mutants``."""

from __future__ import annotations

import argparse
import hashlib
import shutil
import sys
import tempfile
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from tests.mutants import report
from tests.mutants.areas import HERE, ROOT, Area, Equivalent, TableError, read_areas, read_equivalents
from tests.mutants.sample import Mutant, mutants, mutated, sample
from tests.mutants.trial import EQUIVALENT, KILLED, SURVIVED, TIMEOUT, TrialError, Verdict, copy_tree, judged, unmutated


@dataclass(frozen=True, slots=True)
class Bench:
    """What all areas share: the tree, its copies, the name of its state, the tables, the sample's size and seed."""

    root: Path
    copies: tuple[Path, ...]
    state: str
    left_out: tuple[str, ...]
    known: tuple[Equivalent, ...]
    count: int
    seed: int

    @property
    def results(self) -> Path:
        return self.root / "build" / "mutants"


def main(arguments: Sequence[str] | None = None, root: Path = ROOT, tables: Path = HERE) -> int:
    """Exit code 0: each mutant of the sample has a verdict; 2: tests or tables are at fault; 130: interrupted."""
    options = _options(arguments)
    try:
        areas, left_out = read_areas(tables / "areas.toml", root)
        known = read_equivalents(tables / "equivalent.toml")
        chosen = [area for area in areas if options.area in (None, area.name)]
        if not chosen:
            raise TableError(f"no area is called {options.area}; there are {', '.join(area.name for area in areas)}")
        with tempfile.TemporaryDirectory(prefix="mutants-") as folder:
            room = Path(folder).resolve()
            first = copy_tree(root, room / "1")
            state = report.fingerprint(first)
            more = (Path(shutil.copytree(first, room / str(k))) for k in range(2, options.jobs + 1))
            bench = Bench(root, (first, *more), state, left_out, known, options.sample, options.seed)
            lines = [_one_area(area, bench) for area in chosen]
    except (TableError, TrialError) as error:
        print(error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("\ninterrupted; the same command goes on from here", file=sys.stderr)
        return 130
    print(*lines, sep="\n")
    return 0


def _options(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        "python -m tests.mutants", description="Do the tests notice small changes to the code?"
    )
    parser.add_argument("--area", help="one area of areas.toml (default: all)")
    parser.add_argument("--sample", type=int, default=60, metavar="N", help="mutants of each area (default: 60)")
    parser.add_argument("--seed", type=int, default=1963, metavar="N", help="seed of the sample (default: 1963)")
    parser.add_argument("--jobs", type=int, default=2, metavar="N", help="how many run at a time (default: 2)")
    options = parser.parse_args(arguments)
    if options.jobs < 1 or options.sample < 1:
        parser.error("--jobs and --sample are 1 or more")
    return options


def _one_area(area: Area, bench: Bench) -> str:
    """Judge the sample of one area, write its table and diffs; the line of the summary."""
    sources = {file: (bench.copies[0] / file).read_text(encoding="utf-8") for file in area.files}
    for entry in _stale(bench, sources):
        print(f"equivalent.toml: {entry.file} has no such mutant: {entry.line}", file=sys.stderr)
    drawn = sample(sources, bench.count, bench.seed, bench.left_out)
    table = bench.results / f"{area.name}.csv"
    run = hashlib.sha256(f"{bench.state} {area}".encode()).hexdigest()[:12]
    found = {mutant: Verdict(mutant, EQUIVALENT, 0.0) for mutant in drawn if _is_known(mutant, sources, bench.known)}
    for verdict in report.earlier(table, run, [mutant for mutant in drawn if mutant not in found]):
        found[verdict.mutant] = verdict
    to_run = [mutant for mutant in drawn if mutant not in found]
    if to_run:
        usual = unmutated(bench.copies[0], area)
        print(f"{area.name}: {usual.tests} tests, {usual.processor:.1f} s without a mutant", file=sys.stderr)
        for verdict in judged(bench.copies, area, to_run, usual):
            found[verdict.mutant] = verdict
            report.write_table(table, run, area.name, list(found.values()))
            _progress(area, found, len(drawn))
    report.write_table(table, run, area.name, list(found.values()))
    for path in report.write_survivors(bench.results / area.name, [found[mutant] for mutant in drawn], sources):
        print(f"survived: {path.relative_to(bench.root)}", file=sys.stderr)
    return report.summary(area.name, found.values())


def _stale(bench: Bench, sources: Mapping[str, str]) -> list[Equivalent]:
    """Entries for these files that no mutant fits any more."""
    entries = [entry for entry in bench.known if entry.file in sources]
    found = [mutant for file in {entry.file for entry in entries} for mutant in mutants(file, sources[file])]
    return [entry for entry in entries if not any(entry.fits(m.file, m.text, m.operator) for m in found)]


def _is_known(mutant: Mutant, sources: Mapping[str, str], known: Sequence[Equivalent]) -> bool:
    entries = [entry for entry in known if entry.fits(mutant.file, mutant.text, mutant.operator)]
    return any(not entry.becomes or entry.becomes == _becomes(mutant, sources[mutant.file]) for entry in entries)


def _becomes(mutant: Mutant, source: str) -> str:
    """The line as the mutant has it, without its indent; empty where the change took lines away."""
    lines = mutated(source, mutant).splitlines()
    return lines[mutant.line - 1].strip() if len(lines) == len(source.splitlines()) else ""


def _progress(area: Area, found: Mapping[Mutant, Verdict], of: int) -> None:
    if sys.stderr.isatty():
        count = Counter(verdict.outcome for verdict in found.values())
        counts = ", ".join(f"{count[kind]} {kind}" for kind in (KILLED, TIMEOUT, SURVIVED))
        print(f"\r{area.name}: {len(found)} of {of}: {counts} ", end="" if len(found) < of else "\n", file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main())
