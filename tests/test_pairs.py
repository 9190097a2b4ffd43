"""Consecutive arrivals of the Paris data, and ours in the place of a follower."""

from dataclasses import replace

import numpy as np
import pytest

from benchmarks.arrivals import Pair, centrelines, pairs
from benchmarks.pairs import established, fly_pair
from benchmarks.unable import unable_at_the_end
from relguide.flying.documents import PlanChanged, Unable
from relguide.units import NM
from tests.flights import fly_whole
from tests.relguide.flying.guidance.beliefs import FIG_6B

KNOWN = {
    ("EJU875P", "EJU948D"): 96.0,
    ("DAH1000", "AFR91QD"): 99.0,
    ("TVF78YY", "VLG9497"): 102.0,
    ("TVF4151", "AFR51LU"): 106.0,
}
"""Pairs and their intervals [s] as another program found them, its gates some seconds away."""


@pytest.fixture(scope="module")
def found() -> dict[tuple[str, str], Pair]:
    return {(pair.leader.ident, pair.follower.ident): pair for pair in pairs()}


@pytest.mark.slow
def test_pairs_are_those_that_another_program_found(found: dict[tuple[str, str], Pair]) -> None:
    for names, interval in KNOWN.items():
        pair = found[names]
        assert pair.interval == pytest.approx(interval, abs=8.0)
        leader, follower = pair.leader, pair.follower
        assert (leader.origin, leader.start) == (follower.origin, follower.start)
        assert leader.duration == follower.duration >= 180.0


@pytest.mark.slow
def test_followers_are_established_as_another_program_found(
    found: dict[tuple[str, str], Pair],
) -> None:
    """It found medians of 609 s, 47 NM and 7.3 NM over its pairs, and 4.3 NM for the first one."""
    real = [established(pair) for pair in found.values()]
    assert np.median([one.t for one in real]) == pytest.approx(609.0, abs=30.0)
    assert np.median([one.track for one in real]) / NM == pytest.approx(47.0, abs=2.0)
    assert np.median([one.distance for one in real]) / NM == pytest.approx(7.3, abs=0.3)
    first = found["EJU875P", "EJU948D"]
    assert established(first).distance / NM == pytest.approx(5.3, abs=0.1)


@pytest.mark.slow
def test_a_centreline_is_where_its_arrivals_end() -> None:
    for line in centrelines():
        assert len(line.tracks) > 1
        for track in line.tracks:
            assert abs(line.across(track)[-1]) < 0.3 * NM


@pytest.mark.slow
def test_ours_takes_the_followers_place(found: dict[tuple[str, str], Pair]) -> None:
    outcome = fly_pair(found["AFR93XT", "AFR73VJ"])
    assert outcome.joined == (not outcome.why)
    assert outcome.least >= 3.0 * NM - 1.0
    assert not outcome.lost
    assert outcome.joined == (not outcome.reason)


def test_why_a_flight_flies_no_plan_is_what_was_said_last_since_its_last_one() -> None:
    """Not what is said of the heading that is held meanwhile, nor what a new plan ended."""
    near, slow, turns = (
        Unable(t=t, ident="PURSUER", reason="separation", message=message)
        for t, message in (
            (10.0, "Unable: What is flown would come within 4.70 NM of the leader."),
            (30.0, "Unable to follow: the leader flies 146 kt."),
            (50.0, "Turning to 192°, to keep clear of the leader."),
        )
    )
    (planned,) = fly_whole(replace(FIG_6B, duration_limit=1.0)).of(PlanChanged)
    assert unable_at_the_end([planned]) is None
    assert unable_at_the_end([planned, near, planned]) is None
    assert unable_at_the_end([planned, near, planned, near, slow, turns]) is slow
