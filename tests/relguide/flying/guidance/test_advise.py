"""Where the leader is not as expected, another path is flown only if it joins sooner."""

import pytest

from relguide.flying.documents import ModeChanged
from relguide.flying.orders import LeaderSpeed
from relguide.flying.scenarios import own_scenario
from relguide.units import DEG
from tests.flights import fly_whole, random_start


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 1, 20, 23, 57])
def test_near_the_slot_a_little_less_speed_is_flown_and_no_circle(seed: int) -> None:
    """A minute before capture the leader slows down by 4 m/s: the slot is then some 200 m nearer.

    A path that ends there would go all the way round: it turns by 100° to 220° more, and joins up
    to 220 s later.
    """
    flight = own_scenario(random_start(seed))
    undisturbed = fly_whole(flight)
    captured = next(d.t for d in undisturbed.of(ModeChanged) if d.mode == "capture")
    slower = LeaderSpeed(tas=flight.situation.leader.tas - 4.0)
    result = fly_whole(flight, (captured - 60.0, slower)).result
    assert result.joined
    assert result.join_time <= undisturbed.result.join_time + 5.0
    assert result.heading_swing <= undisturbed.result.heading_swing + 5.0 * DEG
