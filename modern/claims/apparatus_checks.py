"""Everything ``hull1620 apparatus --check`` proves, one :class:`Proof` a line: sources, decks, readings and grounds.

A reading is proved twice: its kind allows the change (:mod:`modern.edition.readings`), and its ground fails without it.
The grounds of the listings are in :mod:`modern.edition.grounds`, those of chapter 6 in
:mod:`modern.edition.chapter6_grounds`; those of chapter 4 and of the papers are here: ``sibling``, words that stand in
another line too; ``arithmetic``, the four conditions of theorem 4.2 in full; ``result``, a published result that is
computed and comes out with the row alone.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from itertools import repeat
from multiprocessing import get_context
from signal import SIG_IGN, SIGINT, signal

from modern.claims import published
from modern.edition import chapter4, programs, sources
from modern.edition.apparatus import Line, Row, Text, build
from modern.edition.chapter6_cards import load_chapter
from modern.edition.chapter6_checks import check_chapter
from modern.edition.grounds import Proof, check_decks, check_row
from modern.edition.readings import attested, reading_faults, solid, steps, without_step
from modern.papers import Lines


def texts() -> dict[str, Text]:
    """Every text with an apparatus, by its id."""
    loaded_texts = [programs.text(name) for name in programs.TEXTS]
    loaded_texts += [chapter4.load_text(), load_chapter().text]
    loaded_texts += [published.text_of(paper) for paper in published.PAPERS]
    return {text.id: text for text in loaded_texts}


def places_of_pairs(all_texts: Mapping[str, Text]) -> Counter[tuple[str, str]]:
    """How often each pair of the table of confusables is used in all texts."""
    return attested(row for text in all_texts.values() for row in text.rows)


def check_sources(whole: str = "") -> Iterator[Proof]:
    """Witnesses and ground decks have their hashes; with the ``whole`` text of a document, its excerpts are its lines.

    Raises ApparatusError for a text that is no document's.
    """
    for file, holds, message in (*sources.check_files(), *(sources.check_against(whole) if whole else ())):
        yield Proof(file.removeprefix("fortran_src/").removeprefix("transcripts/"), holds, message)


def check_listing(row: Row, places: Mapping[tuple[str, str], int]) -> Proof:
    """A row of a listing: what its kind allows, and its ground."""
    fault = next(reading_faults(row, places), "")
    return Proof(row.id, False, fault) if fault else check_row(row)


def check_transcripts(places: Mapping[tuple[str, str], int]) -> Iterator[Proof]:
    """Chapter 4, chapter 6 and the papers, a proof a text; the first fault where there is one."""
    chapter = load_chapter()
    faults = [*_kinds(chapter.text, places), *check_chapter(chapter)]
    files = len({(d.example, d.program, d.device) for d in chapter.layout.devices})
    message = f"{files} device files are witness, {len(chapter.text.rows)} rows and layout, each row needed"
    yield _proof("chapter6", faults, message)
    text = chapter4.load_text()
    faults = [*_kinds(text, places), *(fault for row in text.rows for fault in chapter4_faults(text, row))]
    for theorem in chapter4.load_theorems():
        faults += chapter4.theorem_faults(theorem, text)
    yield _proof("chapter4", faults, f"the data of three theorems, and {len(text.rows)} rows, each needed")
    for paper in published.PAPERS:
        text = published.text_of(paper)
        faults = [*_kinds(text, places), *(fault for row in text.rows for fault in paper_faults(paper, text, row))]
        yield _proof(text.id, faults, f"{len(text.rows)} rows, each needed for a result that is computed")


def _proof(subject: str, faults: list[str], words: str) -> Proof:
    return Proof(subject, not faults, faults[0] if faults else words)


def _kinds(text: Text, places: Mapping[tuple[str, str], int]) -> Iterator[str]:
    for row in text.rows:
        for fault in reading_faults(row, places):
            yield f"row {row.id}: {fault}"


def chapter4_faults(text: Text, row: Row) -> tuple[str, ...]:
    """Why a row of chapter 4 does not stand; each step of it is needed."""
    holds = {"sibling": _sibling, "arithmetic": _arithmetic}[str(row.ground["kind"])]
    if not holds(row, build(text)):
        return (f"row {row.id}: its ground does not hold",)
    for step in steps(row) or ():
        if holds(row, build(text, instead=without_step(row, step))):
            return (f"row {row.id}: {step.pair.lemma!r} for {step.pair.witness!r} is not needed",)
    if holds(row, build(text, None, {row.id})):
        return (f"row {row.id}: its ground holds without it",)
    return ()


def _sibling(row: Row, lines: tuple[Line, ...]) -> bool:
    own_lines, sibling_lines = (
        solid("".join(line.text for line in lines if line.id in row.ground[k])) for k in ("own", "lines")
    )
    return all(solid(phrase) in own_lines and solid(phrase) in sibling_lines for phrase in row.ground["words"])


def _arithmetic(row: Row, lines: tuple[Line, ...]) -> bool:
    """The conditions have z and D, and so hold at the point where without them one does not."""
    theorem = next(t for t in chapter4.load_theorems() if t.id == row.ground["theorem"])
    plane, point = theorem.plane(row.ground["equation"]), theorem.point(row.ground["point"])
    assert point is not None
    a, b, c, _ = plane.coefficients
    needed = a * point.at[0] + b * point.at[1] + c > 0 > plane.at(point)
    return needed and all(
        mark in line.text for line in lines if line.id in row.ground["lines"] for mark in ("z_", "D_")
    )


@cache
def _produced(name: str) -> Lines:
    return published.produced_by(next(paper for paper in published.PAPERS if paper.name == name))


def paper_faults(paper: published.Paper, text: Text, row: Row) -> tuple[str, ...]:
    """Why a row of a paper does not stand: a result of its lines comes out with it, and without it does not."""
    if row.ground.get("kind") != "result":
        return (f"row {row.id}: there is no ground {row.ground.get('kind')!r}",)
    has_computed_result = False
    for first, last, result in spans(paper):
        span = _span(text, row, first, last)
        if result.cannot or not any(change.line in span for change in row.changes):
            continue
        has_computed_result = True
        computed_words = [line.split() for line in _produced(paper.name).get(result.id, ())]
        with_row, without = (
            [line.text.split() for line in build(text, None, left_out) if line.id in span]
            for left_out in ((), {row.id})
        )
        if with_row != computed_words and not result.differs:
            return (f"row {row.id}: result {result.id} does not come out with it",)
        if without == computed_words:
            return (f"row {row.id}: result {result.id} comes out without it",)
    return () if has_computed_result else (f"row {row.id}: no result that is computed has its lines",)


def _span(text: Text, row: Row, first: str, last: str) -> list[str]:
    """The lines of a result, and those after its last that the row drops."""
    order = [line.id for line in text.witness]
    start, end = order.index(first), order.index(last) + 1
    for change in row.changes:
        if change.through and order.index(change.line) == end:
            end = order.index(change.through) + 1
    return order[start:end]


@cache
def spans(paper: published.Paper) -> tuple[tuple[str, str, published.Published], ...]:
    """Each published result with its first and its last line."""
    return tuple((*result.span, result) for result in published.results_of(paper))


def check_everything(rows: list[Row], transcripts: bool, whole: str = "", workers: int = 1) -> Iterator[Proof]:
    """All of it, in the order it is printed: ``rows`` of the listings, and the ``transcripts`` too.

    workers: processes; with 1 nothing but this process works.  Raises ApparatusError for a ``whole`` text that is no
    document's.
    """
    places = places_of_pairs(texts())
    if workers == 1 or len(rows) < _MANY:
        if transcripts:
            yield from check_sources(whole)
        yield from check_decks()
        yield from (check_listing(row, places) for row in rows)
        yield from check_transcripts(places) if transcripts else ()
        return
    pool = ProcessPoolExecutor(workers, get_context("spawn"), initializer=signal, initargs=(SIGINT, SIG_IGN))
    try:
        # The transcripts take longest, and are begun first; this process does its part while the others begin.
        others = pool.submit(_listed_transcripts, places) if transcripts else None
        proofs = pool.map(check_listing, rows, repeat(places), chunksize=_CHUNK)
        if transcripts:
            yield from check_sources(whole)
        yield from check_decks()
        yield from proofs
        yield from others.result() if others else ()
    finally:
        pool.shutdown(cancel_futures=True)


_CHUNK = 8
"""Rows a process takes at a time: neighbours have a program in common."""
_MANY = 20
"""Rows from which on further processes save time."""


def _listed_transcripts(places: Mapping[tuple[str, str], int]) -> list[Proof]:
    return list(check_transcripts(places))
