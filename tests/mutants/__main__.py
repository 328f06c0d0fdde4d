"""``python -m tests.mutants``: the command behind ``make mutants``."""

import argparse
import hashlib
import shutil
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from tests.mutants import report
from tests.mutants.areas import HERE, ROOT, Area, Equivalent, TableError, read_areas, read_equivalents
from tests.mutants.sample import Mutant, mutants, mutated, sample
from tests.mutants.trial import EQUIVALENT, TrialError, Verdict, copy_tree, judged, unmutated


@dataclass(frozen=True, slots=True)
class Bench:
    """What all areas share: the tree, its copies, the hash of its content, the tables, and the size and seed."""

    root: Path
    copies: tuple[Path, ...]
    state: str
    left_out: tuple[str, ...]
    known: tuple[Equivalent, ...]
    count: int
    seed: int


def main(arguments: Sequence[str] | None = None, root: Path = ROOT, tables: Path = HERE) -> int:
    """Return 0 if each mutant of the sample has a verdict, 2 if tests or tables are wrong, 130 if interrupted."""
    options = _options(arguments)
    try:
        areas, left_out = read_areas(tables / "areas.toml", root)
        known = read_equivalents(tables / "equivalent.toml")
        selected = [area for area in areas if options.area in (None, area.name)]
        if not selected:
            raise TableError(f"unknown area {options.area}; the areas are {', '.join(area.name for area in areas)}")
        with tempfile.TemporaryDirectory(prefix="mutants-") as name:
            folder = Path(name).resolve()
            first = copy_tree(root, folder / "1")
            state = report.fingerprint(first)
            others = (Path(shutil.copytree(first, folder / str(k))) for k in range(2, options.jobs + 1))
            bench = Bench(root, (first, *others), state, left_out, known, options.sample, options.seed)
            lines = [_one_area(area, bench) for area in selected]
    except (TableError, TrialError) as error:
        print(error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("\ninterrupted; the same command continues from here", file=sys.stderr)
        return 130
    print(*lines, sep="\n")
    return 0


def _options(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        "python -m tests.mutants", description="Measure whether the tests notice small changes to the code."
    )
    parser.add_argument("--area", help="one area of areas.toml (default: all)")
    parser.add_argument("--sample", type=int, default=60, metavar="N", help="mutants of each area (default: 60)")
    parser.add_argument("--seed", type=int, default=1963, metavar="N", help="seed of the sample (default: 1963)")
    parser.add_argument("--jobs", type=int, default=2, metavar="N", help="trials at the same time (default: 2)")
    options = parser.parse_args(arguments)
    if options.jobs < 1 or options.sample < 1:
        parser.error("--jobs and --sample must be at least 1")
    return options


def _one_area(area: Area, bench: Bench) -> str:
    """Judge the sample of one area, write its table and diffs, and return its line of the summary."""
    sources = {file: (bench.copies[0] / file).read_text(encoding="utf-8") for file in area.files}
    for entry in _stale(bench, sources):
        print(f"equivalent.toml: {entry.file} has no such mutant: {entry.line}", file=sys.stderr)
    drawn = sample(sources, bench.count, bench.seed, bench.left_out)
    results = bench.root / "build" / "mutants"
    table = results / f"{area.name}.csv"
    run = hashlib.sha256(f"{bench.state} {area}".encode()).hexdigest()[:12]
    verdicts = {mutant: Verdict(mutant, EQUIVALENT, 0.0) for mutant in drawn if _is_known(mutant, sources, bench.known)}
    for verdict in report.earlier(table, run, [mutant for mutant in drawn if mutant not in verdicts]):
        verdicts[verdict.mutant] = verdict
    to_run = [mutant for mutant in drawn if mutant not in verdicts]
    if to_run:
        usual = unmutated(bench.copies[0], area)
        print(f"{area.name}: {usual.tests} tests, {usual.processor:.1f} s without a mutant", file=sys.stderr)
        for verdict in judged(bench.copies, area, to_run, usual):
            verdicts[verdict.mutant] = verdict
            # The table is complete after every verdict, so an interrupted run loses nothing.
            report.write_table(table, run, area.name, verdicts.values())
            if sys.stderr.isatty():
                end = "" if len(verdicts) < len(drawn) else "\n"
                print(f"\r{report.summary(area.name, verdicts.values())} ", end=end, file=sys.stderr)
    report.write_table(table, run, area.name, verdicts.values())
    for path in report.write_survivors(results / area.name, [verdicts[mutant] for mutant in drawn], sources):
        print(f"survived: {path.relative_to(bench.root)}", file=sys.stderr)
    return report.summary(area.name, verdicts.values())


def _stale(bench: Bench, sources: Mapping[str, str]) -> list[Equivalent]:
    """Return the entries for these files that fit no mutant any more."""
    entries = [entry for entry in bench.known if entry.file in sources]
    all_mutants = [mutant for file in {entry.file for entry in entries} for mutant in mutants(file, sources[file])]
    return [entry for entry in entries if not any(entry.fits(m.file, m.text, m.operator) for m in all_mutants)]


def _is_known(mutant: Mutant, sources: Mapping[str, str], known: Sequence[Equivalent]) -> bool:
    entries = [entry for entry in known if entry.fits(mutant.file, mutant.text, mutant.operator)]
    return any(not entry.becomes or entry.becomes == _becomes(mutant, sources[mutant.file]) for entry in entries)


def _becomes(mutant: Mutant, source: str) -> str:
    """Return the line of the mutant without its indentation, or "" if the change removed lines."""
    lines = mutated(source, mutant).splitlines()
    return lines[mutant.line - 1].strip() if len(lines) == len(source.splitlines()) else ""


if __name__ == "__main__":
    sys.exit(main())
