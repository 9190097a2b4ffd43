"""In JSBSim's own moderate turbulence the A320 joins, and no later than gusts make ours.

Our own aircraft joins this flight up to a third later in one seed of gusts than in another, so no
single flight is held against another: the middle of the A320's is, against all of ours.
"""

from statistics import median

import pytest

from relguide.flying.fleet import Fleet
from tests.independent.a320 import MODERATE_GUSTS, A320Fleet
from tests.independent.outcome import TOO_LATE, TOO_NEAR, outcome

SEEDS = range(5)


@pytest.mark.slow
@pytest.mark.parametrize("number", range(3))
def test_the_a320_joins_in_turbulence(number: int) -> None:
    flown = {
        fleet: [
            outcome("near_limit", number, fleet, gusts=MODERATE_GUSTS, seed=seed, until=1_000.0)
            for seed in SEEDS
        ]
        for fleet in (Fleet, A320Fleet)
    }
    own, a320 = flown.values()
    assert all(one.joined and one.lost == 0 for one in a320)
    latest = max(one.join_time for one in own)
    assert median(one.join_time for one in a320) <= (1.0 + TOO_LATE) * latest
    nearest = min(one.least for one in own)
    assert median(one.least for one in a320) >= nearest - TOO_NEAR
