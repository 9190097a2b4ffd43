"""A clearance is read back from its JSON as it was."""

from dataclasses import replace

import numpy as np
import pytest

from relguide.atc.cards import card_of, track_card
from relguide.atc.clearances import State
from relguide.atc.documents import ClearanceCard
from relguide.atc.life import note_validation
from relguide.contract.document_models import card_from_wire
from relguide.contract.refusal import ContractError
from relguide.contract.wire import dumps, to_wire
from tests.relguide.atc.lives import STATES, in_state, manoeuvre, straight_track, validation


@pytest.mark.parametrize("state", STATES)
def test_a_record_of_json_holds_all_of_a_clearance(state: State) -> None:
    one = in_state(state)
    if not one.over:
        one = note_validation(one, validation("unable"))
    card = card_from_wire(ClearanceCard, dumps(card_of(one)))
    again = replace(card, bank=one.request.bank, max_bank=one.request.max_bank)
    assert again == card_of(one)
    assert card.bank == pytest.approx(one.request.bank)  # its unit in JSON is the degree


def test_spacing_by_time_is_said_as_such() -> None:
    one = replace(
        in_state("flying"), request=replace(manoeuvre(), spacing_type="time", spacing=90.0)
    )
    written = to_wire(card_of(one))
    assert (written["spacing_time_s"], written["slot_distance_m"]) == (90.0, 0.0)


def test_unknown_heights_stay_unknown() -> None:
    unknown = replace(
        straight_track(), low=np.full(3, -np.inf), high=np.array([np.inf, 9000.0, 9000.0])
    )
    card = track_card(unknown)
    assert (card.altitude, card.low, card.high) == ((), (), ())


def test_a_card_that_is_none_is_refused_with_its_field() -> None:
    written = to_wire(card_of(in_state("accepted")))
    with pytest.raises(ContractError, match="due_s"):
        card_from_wire(ClearanceCard, {**written, "due_s": "soon"})
