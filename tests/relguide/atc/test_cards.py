"""A clearance is restored from its JSON as it was."""

from dataclasses import replace

import numpy as np
import pytest

from relguide.atc.cards import card_of, of_card, track_card, track_of
from relguide.atc.clearances import State
from relguide.atc.documents import ClearanceCard
from relguide.atc.life import note_validation
from relguide.contract.document_models import card_from_wire
from relguide.contract.refusal import ContractError
from relguide.contract.wire import dumps, to_wire
from tests.relguide.atc.lives import STATES, in_state, manoeuvre, straight_track, validation


@pytest.mark.parametrize("state", STATES)
def test_a_record_of_json_restores_a_clearance(state: State) -> None:
    one = in_state(state)
    if not one.over:
        one = note_validation(one, validation("unable"))
    card = card_from_wire(ClearanceCard, dumps(card_of(one)))
    again = of_card(card)
    assert card_of(again) == card
    for name in ("id", "sky", "flight_id", "text", "auto_answer", "state", "history", "due"):
        assert getattr(again, name) == getattr(one, name)
    assert (again.validation, again.deviations) == (one.validation, one.deviations)
    assert again.request.path.error == one.request.path.error
    for name in ("t", "x", "y", "low", "high"):
        given, read = getattr(one.request.path, name), getattr(again.request.path, name)
        assert np.array_equal(given, read)
    assert again.request.bank == pytest.approx(one.request.bank)  # its unit in JSON is the degree
    same = replace(
        again.request,
        path=one.request.path,
        leader_path=one.request.leader_path,
        bank=one.request.bank,
        max_bank=one.request.max_bank,
    )
    assert same == one.request


def test_spacing_by_time_is_restored() -> None:
    one = replace(
        in_state("flying"), request=replace(manoeuvre(), spacing_type="time", spacing=90.0)
    )
    written = to_wire(card_of(one))
    assert (written["spacing_time_s"], written["slot_distance_m"]) == (90.0, 0.0)
    assert of_card(card_of(one)).request.spacing == 90.0


def test_unknown_heights_stay_unknown() -> None:
    unknown = replace(
        straight_track(), low=np.full(3, -np.inf), high=np.array([np.inf, 9000.0, 9000.0])
    )
    card = track_card(unknown)
    assert (card.altitude, card.low, card.high) == ((), (), ())
    again = track_of(card)
    assert np.all(np.isneginf(again.low))
    assert np.all(np.isposinf(again.high))


def test_a_card_that_is_none_is_refused_with_its_field() -> None:
    written = to_wire(card_of(in_state("accepted")))
    with pytest.raises(ContractError, match="due_s"):
        card_from_wire(ClearanceCard, {**written, "due_s": "soon"})
