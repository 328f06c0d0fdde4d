"""A changed character of any layer of any text is noticed by a check of ``apparatus --check``."""

import pytest

from tests.modern.edition import alterations
from tests.modern.edition.alterations import Alteration, noticed_by

ALTERATIONS = [*alterations.alterations(60)]


def test_every_layer_of_every_text_is_altered() -> None:
    layers = {(text.id, row.layer) for text in alterations.texts().values() for row in text.rows}
    assert layers == {(alteration.text.id, alteration.row.layer) for alteration in ALTERATIONS}


@pytest.mark.parametrize("alteration", ALTERATIONS, ids=lambda a: f"{a.row.id} {a.row.layer}")
def test_altered_character_is_noticed(alteration: Alteration) -> None:
    assert noticed_by(alteration)


def test_command_counts_the_alterations(capsys) -> None:
    assert alterations.main(["3", "5"]) == 0
    assert "noticed by" in capsys.readouterr().out


def test_an_unnoticed_alteration_fails(capsys, monkeypatch) -> None:
    monkeypatch.setattr(alterations, "noticed_by", lambda _: "")
    assert alterations.main(["4"]) == 1
    assert "4 noticed by no check" in capsys.readouterr().out
