"""All mutants of a file by the operators of cosmic-ray, and a seeded sample of them."""

import ast
import difflib
import hashlib
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase

from cosmic_ray.ast import ast_nodes, get_ast
from cosmic_ray.mutating import mutate_code
from cosmic_ray.plugins import get_operator, operator_names

_PARAMETER_MARK = re.compile(r"[*/]\s*[,)]")


@dataclass(frozen=True, slots=True)
class Mutant:
    """One change, which the operator makes at its place number ``occurrence`` in the file, counted from 0.

    ``line`` counts from 1 and ``column`` from 0. ``text`` is the line before the change, and ``nth`` is the number of
    equal lines above it.
    """

    file: str
    line: int
    column: int
    operator: str
    occurrence: int
    text: str
    nth: int

    @property
    def place(self) -> tuple[str, int, int]:
        return self.file, self.line, self.column


def mutants(file: str, source: str, left_out: Iterable[str] = ()) -> Iterator[Mutant]:
    """Yield the mutants of a file, without the operators left out (patterns) and without those of annotations.

    The bare ``*`` and ``/`` in a list of parameters, which cosmic-ray takes for operators, are left out too.
    """
    lines = source.splitlines()
    before: Counter[str] = Counter()
    nth = []
    for text in lines:
        nth.append(before[text])
        before[text] += 1
    nodes = list(ast_nodes(get_ast(source)))
    annotations = _annotations(source)
    patterns = tuple(left_out)
    for name in operator_names():
        kind = get_operator(name)
        if kind.arguments() or any(fnmatchcase(name, pattern) for pattern in patterns):
            continue
        operator = kind()
        positions = [start for node in nodes for start, _ in operator.mutation_positions(node)]
        for occurrence, (line, column) in enumerate(positions):
            if any(first <= (line, column) < end for first, end in annotations):
                continue
            if _PARAMETER_MARK.match(lines[line - 1], column):
                continue
            yield Mutant(file, line, column, name, occurrence, lines[line - 1], nth[line - 1])


def mutated(source: str, mutant: Mutant) -> str:
    """Return the source with the change."""
    changed: str | None = mutate_code(source, get_operator(mutant.operator)(), mutant.occurrence)
    if changed is None:
        raise ValueError(f"{mutant.file}:{mutant.line}: {mutant.operator} does not apply")
    return changed


def sample(sources: Mapping[str, str], count: int, seed: int, left_out: Iterable[str] = ()) -> list[Mutant]:
    """Return ``count`` mutants of the files, at most one for each place, drawn by the seed.

    All places are equally likely, and so are the operators that apply at a place and give a valid program. The draw
    depends on the text of each line and not on its number, so the rest of the sample survives a change elsewhere.
    """
    places: dict[tuple[str, int, int], list[Mutant]] = {}
    patterns = tuple(left_out)
    for file, source in sources.items():
        for mutant in mutants(file, source, patterns):
            places.setdefault(mutant.place, []).append(mutant)
    drawn: list[Mutant] = []
    for at_place in sorted(places.values(), key=lambda group: _lot(seed, group[0], "")):
        if len(drawn) == count:
            break
        kinds: Counter[str] = Counter()
        lots = []
        for mutant in at_place:
            # An operator may apply twice at one place: a number is increased or decreased by one.
            lots.append((_lot(seed, mutant, f"{mutant.operator} {kinds[mutant.operator]}"), mutant))
            kinds[mutant.operator] += 1
        for _, mutant in sorted(lots, key=lambda pair: pair[0]):
            if _is_different_program(sources[mutant.file], mutant):
                drawn.append(mutant)
                break
    return sorted(drawn, key=lambda mutant: (mutant.place, mutant.operator))


def difference(file: str, source: str, changed: str) -> str:
    """Return the change as a unified diff for ``git apply``."""
    before, after = source.splitlines(keepends=True), changed.splitlines(keepends=True)
    return "".join(difflib.unified_diff(before, after, f"a/{file}", f"b/{file}"))


def _lot(seed: int, mutant: Mutant, operator: str) -> str:
    text = f"{seed}\0{mutant.file}\0{mutant.text}\0{mutant.nth}\0{mutant.column}\0{operator}"
    return hashlib.sha256(text.encode()).hexdigest()


def _is_different_program(source: str, mutant: Mutant) -> bool:
    try:
        return ast.dump(ast.parse(mutated(source, mutant))) != ast.dump(ast.parse(source))
    except (SyntaxError, AttributeError):  # cosmic-ray 8.7 cannot replace an exception with a dotted name
        return False


def _annotations(source: str) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    """Return where annotations begin and end."""
    tree = ast.parse(source)
    annotations: list[ast.expr | None] = []
    for node in ast.walk(tree):
        if isinstance(node, ast.AnnAssign | ast.arg):
            annotations.append(node.annotation)
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            annotations.append(node.returns)
    return [
        ((node.lineno, node.col_offset), (node.end_lineno or node.lineno, node.end_col_offset or 0))
        for node in annotations
        if node is not None
    ]
