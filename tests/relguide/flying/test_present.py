"""The situation of a flight: at its start the one it began with, later what remains of it."""

from dataclasses import replace
from itertools import pairwise

import pytest

from relguide.flying.documents import FlightStarted, LeaderRoute, Sample
from relguide.flying.present import OVER, situation_now
from relguide.planning.intent import FlyStraight, TurnTo
from relguide.planning.outcome import Plan
from relguide.planning.plan import plan
from relguide.units import DEG
from tests.server.flown import SITUATION, ideal_flight


def test_it_is_the_one_it_began_with() -> None:
    documents = list(ideal_flight(duration=0.1))
    (started,) = (d for d in documents if isinstance(d, FlightStarted))
    routes = [d for d in documents if isinstance(d, LeaderRoute)]
    first = next(d for d in documents if isinstance(d, Sample))
    now = situation_now(started, started.links[0], routes, first)
    planned, expected = plan(now), plan(SITUATION)
    assert isinstance(planned, Plan)
    assert isinstance(expected, Plan)
    assert planned.time_to_converge == pytest.approx(expected.time_to_converge, abs=1e-3)
    assert situation_now(started, started.links[0], [], first).leader.intent == ()


def test_what_remains_of_the_intent_shrinks() -> None:
    documents = list(ideal_flight(duration=200.0, step=2.0))
    (started,) = (d for d in documents if isinstance(d, FlightStarted))
    routes = [d for d in documents if isinstance(d, LeaderRoute)]
    samples = [d for d in documents if isinstance(d, Sample)]
    leaders = [
        situation_now(started, started.links[0], routes, sample).leader for sample in samples
    ]
    kinds = [tuple(type(piece) for piece in leader.intent) for leader in leaders]
    changes = [kind for kind, after in pairwise(kinds) if kind != after]
    assert changes == [(FlyStraight, TurnTo), (TurnTo,)]
    assert kinds[-1] == ()
    # the last degrees of a turn are its roll-out
    finals = [leader.final_heading for leader in leaders]
    assert max(finals) - min(finals) < OVER + 1e-6
    assert min(finals) == pytest.approx(SITUATION.leader.final_heading - OVER, abs=0.1)


def test_a_turn_that_rolls_out_late_is_not_begun_anew() -> None:
    documents = list(ideal_flight(duration=160.0, step=2.0))
    (started,) = (d for d in documents if isinstance(d, FlightStarted))
    (route,) = (d for d in documents if isinstance(d, LeaderRoute))
    last = [d for d in documents if isinstance(d, Sample)][-1]
    over = route.segments[1].end.t
    for t, degrees, pieces in (
        (over + 1.0, -12.0, 1),
        (over + 1.0, 2.0, 0),
        (over + 11.0, -12.0, 0),
    ):
        heading = SITUATION.leader.final_heading + degrees * DEG
        pursuer, leader = last.aircraft
        late = replace(last, t=t, aircraft=(pursuer, replace(leader, heading=heading)))
        assert len(situation_now(started, started.links[0], [route], late).leader.intent) == pieces


def test_what_cannot_be_planned_for_is_a_sentence() -> None:
    documents = list(ideal_flight(duration=0.1))
    started = next(d for d in documents if isinstance(d, FlightStarted))
    first = next(d for d in documents if isinstance(d, Sample))
    pursuer, leader = first.aircraft
    slow = replace(first, aircraft=(replace(pursuer, tas=20.0), leader))
    with pytest.raises(ValueError, match=r"pursuer\.tas must lie in"):
        situation_now(started, started.links[0], [], slow)
