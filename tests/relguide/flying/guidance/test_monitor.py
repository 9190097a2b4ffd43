"""Separation is watched: an alert before it is lost, and one end of it."""

from dataclasses import replace
from math import inf

import pytest

from relguide.flying.guidance.announcements import Alerted
from relguide.flying.guidance.forecast import NO_COURSE, Forecast
from relguide.flying.guidance.memory import StandingAlert
from relguide.flying.guidance.monitor import (
    Outlook,
    is_as_forecast,
    judge_separation,
    leader_is_as_forecast,
    look_out,
)
from relguide.flying.guidance.settings import DEFAULT
from relguide.kernels.flight.guide import HOLD, Progress
from relguide.units import DEG, NM
from tests.relguide.flying.guidance.beliefs import Watched, behind, observe
from tests.relguide.flying.guidance.test_forecast import make_forecast

LIMIT = 5.0 * NM
BELIEF, ASSIGNMENT = observe(behind(along=30_000.0))
NOTHING_AHEAD = make_forecast([])


def judge_seconds(*seconds: tuple[float, float, float]) -> list[tuple[float, Alerted]]:
    """What is said, second by second: separation now, least separation ahead, and in what time
    the limit is lost; the least comes after twice that."""
    alert, said = StandingAlert(), list[tuple[float, Alerted]]()
    for t, (apart, least, in_seconds) in enumerate(seconds):
        own = BELIEF.leader._replace(y=BELIEF.leader.y - apart)
        belief = replace(BELIEF, t=float(t), own=own)
        breaks = t + in_seconds if least < LIMIT else inf
        outlook = Outlook(NOTHING_AHEAD, least, t + 2.0 * in_seconds, breaks)
        alert, events = judge_separation(alert, outlook, belief, ASSIGNMENT)
        for event in events:
            assert isinstance(event, Alerted)
            said.append((float(t), event))
    return said


CLEAR = (12_000.0, 11_000.0, 40.0)
SOON = (12_000.0, 9_000.0, 40.0)
LOST = (9_200.0, 9_000.0, 5.0)


def levels(said: list[tuple[float, Alerted]]) -> list[tuple[float, str, bool]]:
    return [(t, event.level, event.cleared) for t, event in said]


def test_nothing_is_said_while_separation_is_kept() -> None:
    assert judge_seconds(*[CLEAR] * 10) == []
    assert judge_seconds((LIMIT, LIMIT, 0.0)) == []


def test_a_caution_comes_before_the_loss_and_a_warning_with_it() -> None:
    said = judge_seconds(CLEAR, *[SOON] * 5, *[LOST] * 5)
    assert levels(said) == [(1.0, "caution", False), (6.0, "warning", False)]
    caution, warning = (event for _, event in said)
    assert caution.message == "Separation in 40 s: below 5.00 NM, down to 4.86 NM."
    assert (caution.predicted_least, caution.predicted_at) == (9_000.0, 41.0)
    assert warning.message == "Separation: 4.97 NM, less than 5.00 NM."


def test_what_is_farther_ahead_than_a_minute_is_not_yet_said() -> None:
    late = (12_000.0, 9_000.0, DEFAULT.caution + 1.0)
    assert judge_seconds(*[late] * 5) == []
    assert levels(judge_seconds(late, (12_000.0, 9_000.0, DEFAULT.caution))) == [
        (1.0, "caution", False)
    ]


def test_it_is_cleared_once_some_seconds_after_its_cause() -> None:
    said = judge_seconds(SOON, *[CLEAR] * 10)
    assert levels(said) == [(0.0, "caution", False), (DEFAULT.clears_after, "caution", True)]
    assert said[-1][1].message == "Separation is kept again."
    assert levels(judge_seconds(LOST, *[CLEAR] * 10))[-1] == (DEFAULT.clears_after, "warning", True)


def test_a_forecast_that_wavers_says_nothing_twice() -> None:
    said = judge_seconds(*[SOON, CLEAR, CLEAR] * 6, *[CLEAR] * 5)
    assert levels(said) == [(0.0, "caution", False), (18.0, "caution", True)]


def test_a_warning_falls_back_to_a_caution_only_after_a_while() -> None:
    assert levels(judge_seconds(LOST, SOON, LOST, SOON)) == [(0.0, "warning", False)]
    said = judge_seconds(LOST, *[SOON] * 6, *[CLEAR] * 6)
    assert levels(said) == [
        (0.0, "warning", False), (DEFAULT.clears_after, "caution", False), (9.0, "caution", True),
    ]  # fmt: skip


def outlook(watched: Watched, trusted: Forecast | None = None, **more: float | bool) -> Outlook:
    belief = watched.belief
    progress = Progress(HOLD, 0.0, belief.own.heading, belief.own.tas)
    options: dict[str, float | bool] = {"turns_on": False, "trend": 0.0} | more
    return look_out(
        belief, watched.assignment, progress, NO_COURSE, trusted, until=belief.t + 150.0, **options
    )  # type: ignore[arg-type]


def test_flying_on_into_the_leader_is_seen_ahead() -> None:
    """30 m/s faster from 20 km behind: at d_min after 358 s, and after 90 s from 12 km."""
    assert outlook(Watched(behind(along=20_000.0))).least > LIMIT
    near = outlook(Watched(behind(along=12_000.0)))
    assert near.least < LIMIT
    assert near.least == pytest.approx(12_000.0 - 30.0 * DEFAULT.watch, abs=20.0)


def test_a_leader_that_slows_down_is_expected_to_go_on() -> None:
    """For half a minute, of which the next is looked at; speeding up ahead does no harm."""
    watched = Watched(behind(along=10_300.0, tas=205.0))
    steady = outlook(watched)
    slowing = outlook(watched, trend=-1.0)
    assert steady.least > LIMIT
    assert slowing.least < LIMIT
    assert slowing.least < steady.least - 300.0
    assert slowing.forecast.own.tolist() == steady.forecast.own.tolist()
    assert outlook(watched, trend=1.0).least >= min(steady.least, 10_299.0)


def test_a_forecast_that_holds_is_not_flown_again() -> None:
    trusted = make_forecast([11_000.0] * 200, t=0.0)
    seen_ahead = outlook(Watched(behind(along=12_000.0)), trusted)
    assert seen_ahead.forecast is trusted
    assert seen_ahead.least == 11_000.0


def test_a_forecast_holds_while_both_are_where_it_has_them() -> None:
    ahead = make_forecast([9_500.0] * 200, t=0.0)
    own = BELIEF.own._replace(x=0.0, y=2_000.0)
    leader = BELIEF.leader._replace(x=9_000.0, y=2_000.0, heading=0.0, tas=200.0)
    there = replace(BELIEF, t=10.0, own=own, leader=leader)
    assert is_as_forecast(ahead, there, ASSIGNMENT)
    for own_off, as_forecast in ((59.0, True), (61.0, False)):
        elsewhere = replace(there, own=own._replace(x=own_off))
        assert is_as_forecast(ahead, elsewhere, ASSIGNMENT) == as_forecast
    for change in (
        {"x": 9_031.0},
        {"heading": 1.1 * DEG},
        {"tas": 202.0},
    ):
        other = replace(there, leader=leader._replace(**change))
        assert not leader_is_as_forecast(ahead, other, ASSIGNMENT)
        assert not is_as_forecast(ahead, other, ASSIGNMENT)
    # near its end it says too little of what comes
    assert not is_as_forecast(make_forecast([9_500.0] * 60, t=0.0), there, ASSIGNMENT)
