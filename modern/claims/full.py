"""The full searches of ``make claims``: checks that run once on many cases, and whose results are recorded.

The results are in ``transcripts/statements/full.csv`` with the generator, its seed and the number of cases.  A result
is kept as long as the code of its check does not change; therefore an interrupted run continues where it stopped.
"""

import ast
import csv
import hashlib
import io
import sys
from collections.abc import Iterator, Mapping, Set
from dataclasses import astuple, dataclass, fields
from functools import cache
from importlib import import_module
from importlib.resources import files
from inspect import getsource
from pathlib import Path
from types import ModuleType

from emulator.files import write_text
from modern.claims.evidence import Decision
from modern.claims.register import decisions, statements_folder

NAME = "full.csv"


@dataclass(frozen=True, slots=True)
class FullSearch:
    """The result of the full search of one check.

    ``statements`` are the ids that the check decides, separated by spaces, and ``sources`` is a digest of the code
    that computed the result.
    """

    check: str
    statements: str
    generator: str
    seed: str
    cases: str
    result: str
    sources: str


@cache
def recorded() -> tuple[FullSearch, ...]:
    """Return the committed results."""
    return read_results(statements_folder().joinpath(NAME).read_text(encoding="utf-8"))


def read_results(text: str) -> tuple[FullSearch, ...]:
    return tuple(FullSearch(**row) for row in csv.DictReader(io.StringIO(text)))


@cache
def recorded_for(statement: str) -> tuple[FullSearch, ...]:
    """Return the committed results of all checks that decide a statement."""
    return tuple(result for result in recorded() if statement in result.statements.split())


def searches() -> Mapping[str, tuple[Decision, tuple[str, ...]]]:
    """Return the checks that have a full search, each with the statements that it decides, by the name of the check."""
    grouped: dict[str, tuple[Decision, tuple[str, ...]]] = {}
    for statement, of_statement in decisions().items():
        for decision in of_statement:
            if decision.full:
                first, ids = grouped.get(_name(decision), (decision, ()))
                grouped[_name(decision)] = first, (*ids, statement)
    return grouped


def _name(decision: Decision) -> str:
    subject = "".join(f" {value}" for _, value in decision.subject)
    return f"{decision.function.__module__.removeprefix('modern.claims.')}.{decision.function.__name__}{subject}"


def sources_of(decision: Decision) -> str:
    """Return a digest of the code of a check and of all that it uses in the modules of this package."""
    start = decision.function.__module__, decision.function.__name__
    pending, reached, text = [start], {start}, ""
    while pending:
        module, name = pending.pop()
        text += ast.dump(definitions(module)[name])
        new = sorted(_used(module, name) - reached)
        reached |= {*new}
        pending += new
    return hashlib.sha256(f"{decision.full} {text}".encode()).hexdigest()[:12]


@cache
def _used(module: str, name: str) -> Set[tuple[str, str]]:
    """Return the definitions of this package that a definition uses directly, as pairs of a module and a name."""
    own = {key: (module, key) for key in definitions(module)} | imports(module)
    modules, used = imported_modules(module), set()
    for node in ast.walk(definitions(module)[name]):
        if isinstance(node, ast.Name) and node.id in own:
            used.add(own[node.id])
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            owner = modules.get(node.value.id, "")
            used |= {(owner, node.attr)} if owner and node.attr in definitions(owner) else set()
    return used


@cache
def imports(module: str) -> dict[str, tuple[str, str]]:
    """Return the names that a module imports from this package, each with the module and the name of its definition."""
    return {name: (source, own) for name, source, own in _imported(module) if own in definitions(source)}


@cache
def imported_modules(module: str) -> dict[str, str]:
    """Return the names by which a module imports other modules of this package, each with the module's full name."""
    imported = ((name, getattr(import_module(source), own, None)) for name, source, own in _imported(module))
    return {name: value.__name__ for name, value in imported if isinstance(value, ModuleType)}


def _imported(module: str) -> Iterator[tuple[str, str, str]]:
    """Yield each name that a module imports from this package, the module that it comes from, and its name there."""
    for node in ast.parse(getsource(import_module(module))).body:
        if isinstance(node, ast.ImportFrom) and f"{node.module}.".startswith("modern.claims."):
            yield from ((alias.asname or alias.name, node.module or "", alias.name) for alias in node.names)


@cache
def definitions(name: str) -> Mapping[str, ast.stmt]:
    """Return the functions, classes and constants of a module, without docstrings and decorators of functions."""
    tree = ast.parse(getsource(import_module(name)))
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and ast.get_docstring(node) is not None:
            del node.body[0]
        if isinstance(node, ast.FunctionDef):
            node.decorator_list = []
    definitions: dict[str, ast.stmt] = {}
    for statement in tree.body:
        stored = (n.id for n in ast.walk(statement) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store))
        own_name = getattr(statement, "name", "")
        definitions |= dict.fromkeys([own_name] if own_name else stored, statement)
    return definitions


def run(name: str) -> FullSearch:
    """Run the full search of one check and return its result."""
    decision, ids = searches()[name]
    check = decision.run_full()
    evidence = check.evidence
    result = ("holds with a condition" if evidence.violation else "holds") if check.holds else check.message
    seed = "" if evidence.seed is None else str(evidence.seed)
    return FullSearch(name, " ".join(ids), evidence.domain, seed, str(evidence.cases), result, sources_of(decision))


def _table(results: Mapping[str, FullSearch]) -> str:
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(field.name for field in fields(FullSearch))
    writer.writerows(astuple(results[name]) for name in sorted(results))
    return out.getvalue()


def outstanding(results: Mapping[str, FullSearch]) -> Iterator[str]:
    """Yield the names of searches that have no recorded result, or whose result was computed by other code."""
    for name, (decision, ids) in searches().items():
        done = results.get(name)
        if done is None or done.sources != sources_of(decision) or done.statements != " ".join(ids):
            yield name


def main(arguments: list[str] | None = None) -> int:
    # These are imported here because the modules that show recorded results need none of them.
    from argparse import ArgumentParser
    from concurrent.futures import ProcessPoolExecutor, as_completed
    from multiprocessing import get_context

    parser = ArgumentParser(prog="python -m modern.claims.full", description="Run the full searches of all claims.")
    parser.add_argument("--jobs", type=int, default=2, help="number of processes (default: 2)")
    jobs = parser.parse_args(arguments).jobs
    path = Path(str(files("transcripts").joinpath("statements", NAME)))
    results = (
        {result.check: result for result in read_results(path.read_text(encoding="utf-8"))} if path.exists() else {}
    )
    results = {name: result for name, result in results.items() if name in searches()}
    names = [*outstanding(results)]
    print(f"{len(searches())} searches, {len(names)} to run", flush=True)
    with ProcessPoolExecutor(jobs, get_context("spawn")) as pool:
        for done in as_completed(pool.submit(run, name) for name in names):
            result = done.result()
            results[result.check] = result
            # Every result is written at once, so that an interrupted run can be continued.
            write_text(str(path), _table(results))
            print(f"{result.check}: {result.cases} cases: {result.result}", flush=True)
    write_text(str(path), _table(results))
    refuted = [result.check for result in results.values() if not result.result.startswith("holds")]
    if refuted:
        print(f"refuted: {', '.join(refuted)}", file=sys.stderr)
    return int(bool(refuted))


if __name__ == "__main__":
    sys.exit(main())
