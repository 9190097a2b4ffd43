"""What a turn begun at once keeps of d_min."""

from dataclasses import replace
from math import pi

import pytest

from relguide.campaign.evasion import best_turn
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.situation import Situation
from relguide.units import DEG, NM


@pytest.mark.slow
def test_a_turn_begun_at_once_is_judged_by_what_it_keeps() -> None:
    leader = Leader(x=0.0, y=0.0, heading=0.0, tas=200.0)
    beside = Pursuer(x=6.0 * NM, y=0.0, heading=0.0, tas=200.0, max_bank=25.0 * DEG)
    situation = Situation(
        pursuer=beside, leader=leader, slot_distance=8.0 * NM, min_separation=5.0 * NM
    )
    assert best_turn(situation) == pytest.approx(6.0 * NM)  # straight on, or away
    # head-on and 2 km away nothing keeps more than the few hundred metres of a turn aside
    head_on = replace(beside, x=0.0, y=2_000.0, heading=pi)
    assert best_turn(replace(situation, pursuer=head_on)) < 100.0
