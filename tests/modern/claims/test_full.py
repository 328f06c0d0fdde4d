"""The full searches: every check with a full size has a committed result, and an interrupted run continues."""

from dataclasses import replace

import numpy as np
import pytest

from modern.claims import full
from modern.claims.hulls import octree_hull
from modern.claims.register import CONDITION, DOCUMENTS, HOLDS, statements_of

ROWS = {row.id: row for document in DOCUMENTS for row in statements_of(document)}


def test_every_search_has_a_result_that_is_the_verdict_of_its_rows() -> None:
    results = {result.check: result for result in full.recorded()}
    assert results.keys() == full.searches().keys()
    for name, (decision, ids) in full.searches().items():
        assert int(results[name].cases) >= decision.full
        assert results[name].result in (HOLDS, CONDITION)
        assert all(ROWS[row].verdict == CONDITION for row in ids if results[name].result == CONDITION)


def test_searches_are_outstanding_only_without_a_current_result() -> None:
    results = {result.check: result for result in full.recorded()}
    assert list(full.outstanding(results)) == []
    name = next(iter(results))
    assert name in full.outstanding({**results, name: replace(results[name], sources="")})
    assert name in full.outstanding({})
    used = full._used("modern.claims.thesis.chapter5", "procedure_in_exact_arithmetic")
    assert ("modern.claims.thesis.chapter7", "vertices_of") in used
    # A definition that is reached through its module: algebra.combination_satisfies.
    used = full._used("modern.claims.appel_will.proofs", "points_of_hull")
    assert ("modern.claims.algebra", "combination_satisfies") in used


def test_a_shared_octree_hull_cannot_be_altered() -> None:
    hull = octree_hull(np.ones((2, 2, 2), np.bool_))
    with pytest.raises(ValueError, match="read-only"):
        hull.filled[:] = False


def test_run_records_a_refuted_check(monkeypatch) -> None:
    name, (decision, ids) = next(iter(full.searches().items()))
    monkeypatch.setattr(full, "searches", lambda: {name: (replace(decision, full=1), ids)})
    result = full.run(name)
    assert (result.check, result.statements) == (name, " ".join(ids))
    assert full.read_results(full._table({name: result})) == (result,)
