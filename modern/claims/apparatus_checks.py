"""All checks of ``hull1620 apparatus --check``, each reported as a :class:`Proof`.

An emendation (a correction of a transcribed text) is checked twice: its kind must permit the change
(:mod:`modern.edition.readings`), and the ground that it gives must fail if the emendation is undone. This module checks
the three kinds of ground of chapter 4 and of the papers. ``sibling`` says that another line has the same words.
``arithmetic`` says that the four conditions of theorem 4.2 must be printed in full. ``result`` says that a
published result is reproduced only with the emendation.
"""

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from importlib.util import find_spec
from itertools import repeat
from multiprocessing import get_context
from signal import SIG_IGN, SIGINT, signal

from modern.claims import published
from modern.edition import chapter4, programs, sources
from modern.edition.apparatus import Line, Row, Text, build
from modern.edition.chapter6_cards import load_chapter
from modern.edition.chapter6_checks import check_chapter
from modern.edition.grounds import Proof, check_decks, check_layers, check_row
from modern.edition.readings import attested, reading_faults, solid, steps, without_step
from modern.papers import Lines


def texts() -> dict[str, Text]:
    """Return the texts that have an apparatus, as a mapping from id to text."""
    loaded_texts = [programs.text(name) for name in programs.TEXTS]
    loaded_texts += [chapter4.load_text(), load_chapter().text]
    loaded_texts += [published.text_of(paper) for paper in published.PAPERS]
    return {text.id: text for text in loaded_texts}


def count_pair_uses(all_texts: Mapping[str, Text]) -> Counter[tuple[str, str]]:
    """Count how often all texts together use each pair of the table of confusable characters."""
    return attested(row for text in all_texts.values() for row in text.rows)


def check_sources(whole: tuple[str, str] | None = None) -> Iterator[Proof]:
    """Check the hashes of the source files. Compare the excerpts with ``whole``, a file's name and text, if given."""
    for file, holds, message in (*sources.check_files(), *(sources.check_against(*whole) if whole else ())):
        yield Proof(file.removeprefix("fortran_src/").removeprefix("transcripts/"), holds, message)


def check_listing(row: Row, pair_uses: Mapping[tuple[str, str], int]) -> Proof:
    """Check an emendation of a program listing: its kind must permit the change, and its ground must hold."""
    fault = next(reading_faults(row, pair_uses), "")
    return Proof(row.id, False, fault) if fault else check_row(row)


def check_transcripts(pair_uses: Mapping[tuple[str, str], int]) -> Iterator[Proof]:
    """Yield one proof each for chapter 6, chapter 4 and every paper; a failing proof reports the first fault.

    The results of the papers need numpy. If numpy is not installed, the papers are left out.
    """
    chapter = load_chapter()
    faults = [*_kinds(chapter.text, pair_uses), *check_chapter(chapter)]
    files = len({(d.example, d.program, d.device) for d in chapter.layout.devices})
    message = f"{files} device files follow from witness, {len(chapter.text.rows)} rows and layout; each row is needed"
    yield _proof("chapter6", faults, message)
    text = chapter4.load_text()
    faults = [*_kinds(text, pair_uses), *(fault for row in text.rows for fault in chapter4_faults(text, row))]
    for theorem in chapter4.load_theorems():
        faults += chapter4.theorem_faults(theorem, text)
    yield _proof("chapter4", faults, f"the data of three theorems agree, and each of {len(text.rows)} rows is needed")
    for paper in published.PAPERS if find_spec("numpy") else ():
        text = published.text_of(paper)
        faults = [*_kinds(text, pair_uses), *(fault for row in text.rows for fault in paper_faults(paper, text, row))]
        yield _proof(text.id, faults, f"each of {len(text.rows)} rows is needed for a computed result")


def _proof(subject: str, faults: list[str], message: str) -> Proof:
    return Proof(subject, not faults, faults[0] if faults else message)


def _kinds(text: Text, pair_uses: Mapping[tuple[str, str], int]) -> Iterator[str]:
    for row in text.rows:
        for fault in reading_faults(row, pair_uses):
            yield f"row {row.id}: {fault}"


def chapter4_faults(text: Text, row: Row) -> tuple[str, ...]:
    """Return the first fault of a row in the apparatus of chapter 4, if any.

    The ground of the row must hold, and it must fail without the row and without each single step of the row.
    """
    holds = {"sibling": _sibling, "arithmetic": _arithmetic}[str(row.ground["kind"])]
    if not holds(row, build(text)):
        return (f"row {row.id}: the ground that it gives does not hold",)
    # Each step of a reading must be needed, and so must the row as a whole.
    for step in steps(row) or ():
        if holds(row, build(text, instead=without_step(row, step))):
            return (f"row {row.id}: {step.pair.lemma!r} for {step.pair.witness!r} is not needed for its ground",)
    if holds(row, build(text, None, {row.id})):
        return (f"row {row.id}: its ground holds even without this row",)
    return ()


def _sibling(row: Row, lines: tuple[Line, ...]) -> bool:
    own_lines, sibling_lines = (
        solid("".join(line.text for line in lines if line.id in row.ground[k])) for k in ("own", "lines")
    )
    return all(solid(phrase) in own_lines and solid(phrase) in sibling_lines for phrase in row.ground["words"])


# A condition of theorem 4.2, without blanks and braces: one plane and one point in all four terms.
_CONDITION = re.compile(r"A_(\d)x_(\w)\+B_\1y_\2\+C_\1z_\2\+D_\1[<>]0")


def _arithmetic(row: Row, lines: tuple[Line, ...]) -> bool:
    """Return True if each condition in the given lines has the form A x + B y + C z + D, and A x + B y + C is wrong.

    The short form is wrong if, for the plane and the point that the ground names, its value is positive and that of the
    long form is negative.
    """
    theorem = next(t for t in chapter4.load_theorems() if t.id == row.ground["theorem"])
    plane, point = theorem.plane(row.ground["equation"]), theorem.point(row.ground["point"])
    assert point is not None
    a, b, c, _ = plane.coefficients
    needed = a * point.at[0] + b * point.at[1] + c > 0 > plane.at(point)
    conditions = [re.sub(r"[ {}]", "", line.text) for line in lines if line.id in row.ground["lines"]]
    return needed and all(map(_CONDITION.search, conditions))


@cache
def _produced(name: str) -> Lines:
    return published.produced_by(next(paper for paper in published.PAPERS if paper.name == name))


def paper_faults(paper: published.Paper, text: Text, row: Row) -> tuple[str, ...]:
    """Return the fault of a row of a paper, if any: the results that it changes must be reproduced only with it."""
    if row.ground.get("kind") != "result":
        return (f"row {row.id}: unknown ground {row.ground.get('kind')!r}",)
    has_computed_result = False
    for result in published.results_of(paper):
        span = _span(text, row, *result.span)
        if result.cannot or not any(change.line in span for change in row.changes):
            continue
        has_computed_result = True
        computed_words = [line.split() for line in _produced(paper.name).get(result.id, ())]
        # The lines of the result with all emendations, and with all except the row being checked.
        with_row, without = (
            [line.text.split() for line in build(text, None, left_out) if line.id in span]
            for left_out in ((), {row.id})
        )
        if with_row != computed_words and not result.differs:
            return (f"row {row.id}: result {result.id} is not reproduced with this row",)
        if without == computed_words:
            return (f"row {row.id}: result {result.id} is reproduced even without this row",)
    return () if has_computed_result else (f"row {row.id}: it changes no line of a computed result",)


def _span(text: Text, row: Row, first: str, last: str) -> list[str]:
    order = [line.id for line in text.witness]
    start, end = order.index(first), order.index(last) + 1
    for change in row.changes:
        if change.through and order.index(change.line) == end:
            end = order.index(change.through) + 1
    return order[start:end]


def check_everything(
    rows: list[Row], transcripts: bool, whole: tuple[str, str] | None = None, workers: int = 1
) -> Iterator[Proof]:
    """Run all checks and return the proofs in the order in which they are printed.

    ``rows`` are the rows of the listings. With ``transcripts``, the transcripts of the documents are checked too.
    ``whole``, if given, is the name and the content of a file with the whole text of a document. The excerpts in the
    transcript of that document are then compared with this text. Raise ApparatusError if the file is not the text of a
    document.
    """
    pair_uses = count_pair_uses(texts())
    if workers == 1 or len(rows) < _MANY:
        if transcripts:
            yield from check_sources(whole)
        yield from check_decks()
        yield from check_layers()
        yield from (check_listing(row, pair_uses) for row in rows)
        yield from check_transcripts(pair_uses) if transcripts else ()
        return
    pool = ProcessPoolExecutor(workers, get_context("spawn"), initializer=signal, initargs=(SIGINT, SIG_IGN))
    try:
        # Checking the transcripts takes longest and is submitted first; this process works while the others start.
        transcript_proofs = pool.submit(_listed_transcripts, pair_uses) if transcripts else None
        proofs = pool.map(check_listing, rows, repeat(pair_uses), chunksize=_CHUNK)
        if transcripts:
            yield from check_sources(whole)
        yield from check_decks()
        yield from check_layers()
        yield from proofs
        yield from transcript_proofs.result() if transcript_proofs else ()
    finally:
        pool.shutdown(cancel_futures=True)


# The number of rows submitted to a process at a time; neighbouring rows share a program.
_CHUNK = 8
# The smallest number of rows for which starting further processes saves time.
_MANY = 20


def _listed_transcripts(pair_uses: Mapping[tuple[str, str], int]) -> list[Proof]:
    return list(check_transcripts(pair_uses))
