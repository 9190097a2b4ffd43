"""The closed loop flown ahead is what will be flown: its promise, its path and its separation."""

from dataclasses import replace
from math import hypot, inf, pi

import numpy as np
import pytest

from relguide.flying.documents import ForecastChanged, PlanChanged
from relguide.flying.flight import Scenario
from relguide.flying.guidance.commit.proposal import Proposal
from relguide.flying.guidance.commit.propose import propose
from relguide.flying.guidance.forecast import NO_COURSE, Forecast, forecast
from relguide.flying.scenarios import own_scenario
from relguide.kernels.flight.ahead import AT, LEAST, NEVER, RIGHT
from relguide.kernels.flight.flight_records import TURN_RATE, Control
from relguide.kernels.flight.guide import HOLD, Progress
from relguide.planning.outcome import NoPlan
from relguide.planning.plan import plan
from relguide.units import DEG
from tests.flights import fly_whole, random_start
from tests.relguide.flying.guidance.beliefs import FIG_6B, Watched, behind, observe

SEEDS = [seed for seed in range(50, 62) if not isinstance(plan(random_start(seed)), NoPlan)]


@pytest.mark.parametrize("seed", SEEDS)
def test_a_leader_that_keeps_his_word_is_joined_when_promised(seed: int) -> None:
    """To a second, braking included, from the last plan that was made; and as drawn, to 80 m."""
    flight = fly_whole(replace(own_scenario(random_start(seed)), after_joining=0.0))
    last = flight.of(PlanChanged)[-1]
    assert flight.result.join_time == pytest.approx(last.t + last.promised, abs=1.0)
    drawn = flight.of(ForecastChanged)[-1]
    places = {sample.t: sample.pursuer for sample in flight.samples}
    compared = [
        hypot(x - places[t].x, y - places[t].y)
        for t, x, y in zip(drawn.times, drawn.x, drawn.y, strict=True)
        if t in places
    ]
    assert len(compared) > 3
    assert max(compared) < 80.0  # own_off, 60 m, within which it is not drawn anew, and a step


def test_the_tube_is_how_far_the_flight_comes_off_its_path() -> None:
    found = propose(*observe(FIG_6B), None, plan)
    assert isinstance(found, Proposal)
    ahead = found.committed.forecast
    assert 0.0 < ahead.tube < 60.0
    assert ahead.tube == np.abs(ahead.account[:, RIGHT]).max()


def make_forecast(separations: list[float], *, t: float = 100.0) -> Forecast:
    """A flight ahead with these separations, the pursuer going north at 200 m/s."""
    n = len(separations)
    own = np.zeros((n + 1, 7))
    own[:, 1], own[:, 5] = 200.0 * np.arange(n + 1), 200.0
    leader = own.copy()
    leader[:, 0] = 9_000.0
    account = np.zeros((n, 6))
    account[:, LEAST], account[:, AT] = separations, t + np.arange(n) + 0.25
    suffix = np.minimum.accumulate(account[::-1, LEAST])[::-1]
    return Forecast(t, own, leader, account, suffix, NEVER)


def test_it_says_how_close_it_comes_from_any_second_on() -> None:
    ahead = make_forecast([9_000.0, 8_000.0, 8_500.0, 9_500.0])
    assert ahead.until == 104.0
    assert ahead.least(100.0) == (8_000.0, 101.25)
    assert ahead.least(102.0) == (8_500.0, 102.25)
    assert ahead.least(100.0, 1.0) == (9_000.0, 100.25)
    assert ahead.least(104.0) == (inf, 104.0)
    assert [ahead.rest(t) for t in (100.0, 101.0, 102.0, 103.0, 104.0)] == [
        8_000.0, 8_000.0, 8_500.0, 9_500.0, inf,
    ]  # fmt: skip
    assert not ahead.joins


def test_it_says_how_far_both_are_from_where_it_has_them() -> None:
    ahead = make_forecast([9_000.0] * 4)
    own, leader = observe(FIG_6B)[0].own, observe(FIG_6B)[0].leader
    beside = own._replace(x=30.0, y=440.0)
    assert ahead.own_off(102.0, beside) == pytest.approx(50.0)
    assert ahead.own_off(105.0, beside) == ahead.own_off(99.0, beside) == inf
    other = leader._replace(x=9_000.0, y=420.0, heading=2.0 * pi - 0.1, tas=203.0)
    assert ahead.leader_off(102.0, other) == pytest.approx((20.0, 0.1, 3.0))
    assert ahead.leader_off(105.0, other) == (inf, inf, inf)


def hold_heading(scenario: Scenario, *, seconds: int = 0, rate: float = 0.0) -> Watched:
    """A flight in which nothing is planned, and the leader has turned for a while."""
    watched = Watched(replace(scenario, intent_known=False))
    for _ in range(seconds):
        watched.fly(Control(TURN_RATE, rate, 230.0))
    return watched


def ahead_of(
    watched: Watched, *, turns_on: bool = False, leader_tas: float | None = None
) -> Forecast:
    belief = watched.belief
    return forecast(
        belief,
        watched.assignment,
        Progress(HOLD, 0.0, belief.own.heading, belief.own.tas),
        NO_COURSE,
        until=watched.t + 120.0,
        turns_on=turns_on,
        leader_tas=leader_tas,
    )


def test_a_leader_that_turns_unannounced_stops_or_goes_on_for_half_a_turn() -> None:
    """Both are reckoned with: it rolls out now, or turns back."""
    turning = replace(FIG_6B, situation=random_start(4))
    watched = hold_heading(turning)
    watched.fleet.turn(1, watched.belief.leader.heading + 2.0, "right", 25.0 * DEG)
    for _ in range(12):
        watched.fly(Control(TURN_RATE, 0.0, 230.0))
    belief = watched.belief
    assert not belief.intent_known
    assert belief.leader.bank > 20.0 * DEG
    stops, goes_on = ahead_of(watched), ahead_of(watched, turns_on=True)
    assert stops.leader[-1, 2] == pytest.approx(belief.leader_rolled_out, abs=0.5 * DEG)
    assert goes_on.leader[-1, 2] == pytest.approx(belief.leader.heading + pi, abs=1.0 * DEG)


def test_a_leader_that_slows_down_goes_for_the_speed_it_is_given() -> None:
    watched = hold_heading(behind(along=30_000.0))
    slower = ahead_of(watched, leader_tas=150.0)
    assert slower.leader[-1, 5] == pytest.approx(150.0, abs=0.5)
    assert ahead_of(watched).leader[-1, 5] == pytest.approx(200.0)


def test_an_intent_that_is_known_is_flown_in_it() -> None:
    known, unknown = Watched(FIG_6B), hold_heading(FIG_6B)
    for watched, heading in ((known, 135.0 * DEG), (unknown, 90.0 * DEG)):
        belief = watched.belief
        progress = Progress(HOLD, 0.0, belief.own.heading, belief.own.tas)
        ahead = forecast(belief, watched.assignment, progress, NO_COURSE, until=900.0)
        assert ahead.leader[-1, 2] == pytest.approx(heading, abs=1.0 * DEG)
