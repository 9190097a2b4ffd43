"""Flights in three dimensions: the pursuer goes to its leader's level, and joins there."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from relguide.flying.documents import (
    FlightEnded,
    LeaderChanged,
    ModeChanged,
    Sample,
    SeparationLost,
)
from relguide.flying.flight import Scenario, fly
from relguide.flying.orders import LeaderLevel
from relguide.flying.scenarios import leader_descends
from relguide.planning.heights import JOINED_HEIGHT, VERTICAL_MINIMUM, WHOLE_METRE
from relguide.planning.intent import ChangeLevel, FlyStraight
from relguide.planning.plan import plan
from relguide.units import FT, NM

FL = 100.0 * FT


def whole(scenario: Scenario, *orders: tuple[float, LeaderLevel]) -> Sequence[object]:
    def due(t: float) -> list[LeaderLevel]:
        return [order for at, order in orders if at == t]

    return list(fly(scenario, plan, commands=due, sample_period=1.0))


def heights(documents: Sequence[object]) -> np.ndarray:
    """t, own altitude, the leader's, and the separation of each sample."""
    return np.array(
        [
            (d.t, d.aircraft[0].altitude, d.aircraft[1].altitude, d.guidance[0].separation)
            for d in documents
            if isinstance(d, Sample) and d.guidance
        ]
    )


def at_levels(own: float, leader: float, to: float) -> Scenario:
    scenario = leader_descends()
    situation = scenario.situation
    intent = FlyStraight(duration=120.0), ChangeLevel(to_altitude=to * FL, rate=8.0)
    return replace(
        scenario,
        situation=replace(
            situation,
            pursuer=replace(situation.pursuer, altitude=own * FL),
            leader=replace(situation.leader, altitude=leader * FL, intent=intent),
        ),
    )


@pytest.mark.parametrize("known", [True, False])
@pytest.mark.parametrize(
    "levels", [(350.0, 310.0, 250.0), (310.0, 310.0, 270.0), (270.0, 310.0, 330.0)]
)
def test_it_joins_at_the_leaders_level_whether_that_was_declared_or_not(
    levels: tuple[float, float, float], known: bool
) -> None:
    documents = whole(replace(at_levels(*levels), intent_known=known))
    flown, end = heights(documents), documents[-1]
    assert isinstance(end, FlightEnded)
    (result,) = end.results
    assert result.joined
    assert not result.losses
    beside = flown[flown[:, 0] >= result.join_time]
    assert np.abs(beside[:, 1] - beside[:, 2]).max() <= JOINED_HEIGHT
    assert beside[-1, 1] == pytest.approx(levels[2] * FL, abs=JOINED_HEIGHT)
    assert np.abs(np.diff(flown[:, 1])).max() <= 21.0


def test_an_order_to_the_leader_to_change_level_is_said_and_followed() -> None:
    scenario = replace(at_levels(310.0, 310.0, 310.0), after_joining=600.0)
    documents = whole(scenario, (900.0, LeaderLevel(altitude=270 * FL, rate=8.0)))
    said = [d for d in documents if isinstance(d, LeaderChanged) and d.change == "level"]
    assert [(d.t, d.message) for d in said] == [
        (900.0, "The leader is instructed to descend to FL270.")
    ]
    flown = heights(documents)
    after = flown[flown[:, 0] > 900.0]
    assert np.abs(after[:, 1] - after[:, 2]).max() <= VERTICAL_MINIMUM
    modes = [d.mode for d in documents if isinstance(d, ModeChanged)]
    assert "escape" not in modes


def test_over_the_leader_no_separation_is_lost_that_height_keeps() -> None:
    """From right above the leader, which is no loss, it falls back and comes down behind it."""
    scenario = at_levels(350.0, 290.0, 290.0)
    situation = scenario.situation
    above = replace(situation.pursuer, x=4_000.0, y=2_000.0)
    documents = whole(replace(scenario, situation=replace(situation, pursuer=above)))
    flown = heights(documents)
    near = flown[:, 3] < 5.0 * NM - 1.0
    assert near.any()
    apart = np.abs(flown[:, 1] - flown[:, 2])
    assert (apart[near] >= VERTICAL_MINIMUM - WHOLE_METRE).all()
    assert not [d for d in documents if isinstance(d, SeparationLost)]


def test_the_same_levels_are_flown_as_if_they_were_not_known() -> None:
    scenario = at_levels(310.0, 310.0, 310.0)
    situation = scenario.situation
    unsaid = replace(
        scenario,
        altitude=310 * FL,
        situation=replace(
            situation,
            pursuer=replace(situation.pursuer, altitude=None),
            leader=replace(situation.leader, altitude=None, intent=(FlyStraight(duration=120.0),)),
        ),
    )
    one, other = heights(whole(scenario)), heights(whole(unsaid))
    assert np.array_equal(one, other)
