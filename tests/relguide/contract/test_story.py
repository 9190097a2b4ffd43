"""What a flight's documents tell in short."""

from dataclasses import replace

import pytest

from relguide.contract.story import failures, figures, story_of
from relguide.flying.documents import (
    AircraftCard,
    FlightEnded,
    FlightStarted,
    WindCard,
)
from relguide.units import DEG, NM
from tests.relguide.contract.test_wire import SAMPLE

CARD = AircraftCard(ident="A", aircraft_type="A300", max_bank=0.4)
STARTED = FlightStarted(
    t=0.0,
    scenario="s",
    title="t",
    planner="exact",
    pursuer=CARD,
    leader=CARD,
    slot_distance=10_000.0,
    min_separation=5.0 * NM,
    wind=WindCard(from_=0.0, speed=0.0),
    step=0.05,
    seed=0,
)
ENDED = FlightEnded(
    t=720.0,
    joined=True,
    join_time=600.0,
    planned_time=590.0,
    least_separation=5.0 * NM,
    heading_swing=400.0 * DEG,
    bank_reversals=1,
    replans=2,
    fallbacks=3,
    track=10.0 * NM,
)


def test_a_good_flight_has_no_failures() -> None:
    flight = story_of([STARTED, SAMPLE, ENDED])
    assert (flight.documents, flight.last_time, flight.broken) == (3, 720.0, "")
    assert failures(flight) == ()
    assert figures(ENDED)["heading_swing_deg"] == pytest.approx(400.0)
    assert figures(ENDED)["track_nm"] == pytest.approx(10.0)


def test_a_lost_separation_is_a_failure() -> None:
    lost = story_of([STARTED, replace(ENDED, least_separation=4.0 * NM)])
    assert failures(lost) == ("The separation fell below 5.00 NM: they came within 4.00 NM.",)


def test_not_joining_is_a_failure() -> None:
    missed = story_of([STARTED, replace(ENDED, joined=False)])
    assert failures(missed) == ("It did not join within 720 s.",)
