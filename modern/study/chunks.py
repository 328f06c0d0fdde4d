"""One chunk of a study, from plan to rows: what a worker does."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from modern.study.families import draw_sample
from modern.study.filing import Filed, reordered
from modern.study.judged import Judged, judge
from modern.study.plan import Cell, Chunk
from modern.study.routes import carry_out
from modern.thesis.batch import Runs

Row = dict[str, Any]


def chunk_text(cell: Cell, seed: int, chunk: Chunk) -> str:
    """The chunk's rows as JSONL text, one line a sample; ``cell`` is the chunk's, ``seed`` the study's."""
    return "".join(json.dumps(row, separators=(",", ":")) + "\n" for row in chunk_rows(cell, seed, chunk))


def chunk_rows(cell: Cell, seed: int, chunk: Chunk) -> Iterator[Row]:
    """The chunk's rows: seed, deck, the judge's figures, and by route outcome, detail and figures.

    Raises EmulatorError where the plan cannot be carried out.
    """
    samples = [judge(draw_sample(cell, seed, index), f"sample {index}") for index in range(chunk.start, chunk.stop)]
    runs = Runs()
    filed = {route.name: carry_out(route, samples, runs) for route in cell.routes}
    reference = filed[cell.reference or cell.routes[0].name]
    for place, sample in enumerate(samples):
        index = chunk.start + place
        answers = {name: reordered(answer[place], reference[place]) for name, answer in filed.items()}
        yield _row(chunk.cell, index, cell.seed(seed, index), sample, answers)


def _row(cell: int, index: int, seed: str, sample: Judged, answers: dict[str, Filed]) -> Row:
    return {
        "cell": cell,
        "index": index,
        "seed": seed,
        **({"tags": dict(sample.drawn.tags)} if sample.drawn.tags else {}),
        "deck": [card.text for card in sample.deck.cards],
        "judge": sample.figures(),
        "runs": {
            name: {"outcome": one.outcome, "detail": one.detail, "figures": dict(one.figures)}
            for name, one in answers.items()
        },
    }
