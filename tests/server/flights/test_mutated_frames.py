"""Whatever a client sends up a stream, its socket alone is closed, and with a sentence."""

import asyncio
import logging
from random import Random

import pytest
from relguide_server.flights.frames import NOT_UNDERSTOOD, FrameReader, UnwelcomeFrame

from tests.server.flights.mutated_frames import REASON, Mistakes, mutated, send_all


@pytest.mark.slow
def test_a_flight_flown_by_hand_goes_on_amid_mutated_frames() -> None:
    logging.getLogger().addHandler(mistakes := Mistakes())
    try:
        ends = asyncio.run(send_all(400))
    finally:
        logging.getLogger().removeHandler(mistakes)
    assert set(ends) <= {"left", f"{NOT_UNDERSTOOD}"}
    assert ends[f"{NOT_UNDERSTOOD}"] > 100
    assert mistakes.found == []


def test_each_frame_is_read_or_refused_with_a_sentence() -> None:
    rng, refused = Random(4), []
    for _ in range(3000):
        try:
            FrameReader().read(mutated(rng))
        except UnwelcomeFrame as unwelcome:
            refused.append(unwelcome)
    assert 500 < len(refused) < 2000
    assert {one.code for one in refused} == {NOT_UNDERSTOOD}
    assert all(0 < len(one.reason.encode()) <= REASON for one in refused)
