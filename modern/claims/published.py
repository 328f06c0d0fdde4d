"""Published results of the later papers, and the verdict on each result.

For each paper, a folder below ``transcripts`` holds a witness (the values as printed, with page marks), an apparatus
(our emendations of the values), and ``results.toml``, which assigns the lines of the emended print to published
results. Each result is compared word by word with the output of our program; spacing is ignored.
"""

import tomllib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Final, Literal

from modern.edition.apparatus import ApparatusError, Line, Row, Text, build, load
from modern.edition.reproduce import DIFFERENT, EXACT
from modern.papers import Lines

CORRECTED: Final = "as corrected"
EXPLAINED: Final = "differs, explained"
CANNOT: Final = "not reproducible"
Kind = Literal["exact", "as corrected", "differs, explained", "not reproducible", "different"]


@dataclass(frozen=True, slots=True)
class Paper:
    """A paper with published results; ``module.produced`` computes them (see :data:`modern.papers.Lines`)."""

    name: str
    title: str
    folder: str
    module: str


PAPERS: tuple[Paper, ...] = (
    Paper(
        "appel-will",
        'Appel and Will, "Determining the Three-dimensional Convex Hull of a Polyhedron" (1976)',
        "appel_will_1976",
        "modern.papers.appel_will.results",
    ),
    Paper(
        "kovalevsky-schulz",
        'Kovalevsky and Schulz, "Convex Hulls in a 3-dimensional Space"',
        "kovalevsky_schulz",
        "modern.papers.kovalevsky_schulz.results",
    ),
    Paper(
        "nakamae-nishita",
        'Nakamae and Nishita, "An Algorithm for Hidden Line Elimination of Polyhedra" (1972)',
        "nakamae_nishita_1972",
        "modern.papers.nakamae_nishita.results",
    ),
)


@dataclass(frozen=True, slots=True)
class PublishedResult:
    """A published result.

    ``printed`` holds its lines as in the witness, ``corrected`` holds the lines after the emendations ``rows``, and
    ``span`` holds the ids of its first and last line. ``differs`` explains why the computed result differs from the
    printed one, and ``cannot`` explains why nothing can be computed.
    """

    id: str
    place: str
    says: str
    printed: tuple[str, ...]
    corrected: tuple[str, ...]
    rows: tuple[Row, ...]
    differs: str = ""
    cannot: str = ""
    span: tuple[str, str] = ("", "")


@dataclass(frozen=True, slots=True)
class Finding:
    """The verdict on one published result of a paper."""

    paper: str
    result: PublishedResult
    kind: Kind
    produced: tuple[str, ...] = ()

    @property
    def holds(self) -> bool:
        """Return True if the result is reproduced, or if ``results.toml`` explains why it is not."""
        return self.kind != DIFFERENT

    @property
    def excused(self) -> bool:
        """Return True if the result is not reproduced and ``results.toml`` explains why."""
        return self.kind in (EXPLAINED, CANNOT)


def text_of(paper: Paper, folder: Traversable | None = None) -> Text:
    """Load the witness and the apparatus of a paper's printed values."""
    return load(folder or files("transcripts").joinpath(paper.folder), "apparatus")


@cache
def results_of(paper: Paper) -> tuple[PublishedResult, ...]:
    """Return the published results of a paper in the order of ``results.toml``."""
    return read_results(paper, files("transcripts").joinpath(paper.folder))


def read_results(paper: Paper, folder: Traversable) -> tuple[PublishedResult, ...]:
    """Read the published results of a paper from a folder.

    Raise ApparatusError if a result names a line that does not exist, or if a line of the witness belongs to two
    results or to none.
    """
    text = text_of(paper, folder)
    witness = {line.id: line for line in text.witness}
    corrected = build(text)
    data = tomllib.loads(folder.joinpath("results.toml").read_text(encoding="utf-8"))
    results: list[PublishedResult] = []
    free = [line.id for line in corrected]
    for entry in data["result"]:
        # Every printed line belongs to exactly one result; each result takes its lines from those that are left.
        first, last = str(entry["lines"][0]), str(entry["lines"][-1])
        if first not in free or last not in free:
            raise ApparatusError(
                f"{text.id}: result {entry['id']}: lines {first} to {last} do not exist or are in another result"
            )
        span = free[free.index(first) : free.index(last) + 1]
        free = [name for name in free if name not in span]
        lines = [line for line in corrected if line.id in span]
        results.append(
            PublishedResult(
                entry["id"],
                entry["place"],
                entry["says"],
                tuple(witness[line.id].text for line in lines if line.id in witness),
                tuple(line.text for line in lines),
                _rows(text, lines),
                entry.get("differs", ""),
                entry.get("cannot", ""),
                (first, last),
            )
        )
    if free:
        raise ApparatusError(f"{text.id}: lines {', '.join(free)} belong to no result; name them in results.toml")
    return tuple(results)


def judge(paper: Paper, result: PublishedResult, produced: Sequence[str]) -> Finding:
    """Compare produced lines with the emended print.  If ``results.toml`` says that they differ, they must differ."""
    same = [line.split() for line in produced] == [line.split() for line in result.corrected]
    kind: Kind
    if result.cannot:
        kind = DIFFERENT if produced else CANNOT
    elif result.differs:
        kind = DIFFERENT if same or not produced else EXPLAINED
    elif not same:
        kind = DIFFERENT
    else:
        kind = CORRECTED if result.rows else EXACT
    return Finding(paper.name, result, kind, tuple(produced))


def printed_lines(paper: Paper) -> Lines:
    """Return the printed lines of a paper, after our emendations, by the id of their result."""
    return {result.id: result.corrected for result in results_of(paper)}


@cache
def produced_by(paper: Paper) -> Lines:
    """Compute the results of a paper from its printed data; return the produced lines by the id of their result."""
    produced: Lines = import_module(paper.module).produced(printed_lines(paper))
    return produced


def findings(paper: Paper) -> Iterator[Finding]:
    """Yield the verdict on every published result of a paper."""
    produced = produced_by(paper)
    for result in results_of(paper):
        yield judge(paper, result, produced.get(result.id, ()))


def _rows(text: Text, lines: Sequence[Line]) -> tuple[Row, ...]:
    names = list(dict.fromkeys(name for line in lines for name in line.rows))
    return tuple(text.row(name) for name in names)
