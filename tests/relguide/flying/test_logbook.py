"""The documents of a flight, and the figures of its summary."""

from dataclasses import replace
from math import hypot, inf

import numpy as np
import pytest

from relguide.flying.aircraft_documents import Loss
from relguide.flying.documents import (
    Alert,
    Document,
    ForecastChanged,
    ModeChanged,
    PlanChanged,
    SeparationLost,
    Unable,
)
from relguide.flying.guidance.forecast import NEVER, Forecast
from relguide.flying.logbook import BENT, STRAIGHT_FOR, Names, forecast_document
from relguide.flying.tally import Milestones, Tally, count_event, count_loss, link_result
from relguide.units import DEG
from tests.server.flown import ideal_flight

NAMES = Names("A", "B")


def count_milestones(*documents: Document) -> Milestones:
    milestones = Milestones()
    for document in documents:
        milestones = count_event(milestones, document)
    return milestones


def alert(t: float, *, level: str = "caution", cleared: bool = False) -> Alert:
    return Alert(
        t=t,
        ident="A",
        other="B",
        level=level,  # type: ignore[arg-type]
        subject="separation",
        message="",
        predicted_least=9_000.0,
        predicted_at=t + 30.0,
        cleared=cleared,
    )


def loss(t: float, separation: float) -> SeparationLost:
    return SeparationLost(
        t=t, ident="A", other="B", separation=separation, x=0.0, y=0.0, cause="why", announced=()
    )


def forecast_of(headings: list[float], *, t: float = 100.0) -> Forecast:
    """A flight ahead with these headings, a second apart, at 200 m/s."""
    own = np.zeros((len(headings), 7))
    own[:, 2], own[:, 5] = headings, 200.0
    own[1:, 0] = np.cumsum(200.0 * np.sin(headings[:-1]))
    own[1:, 1] = np.cumsum(200.0 * np.cos(headings[:-1]))
    leader = own.copy()
    leader[:, 0] += 9_000.0
    account = np.full((len(headings) - 1, 6), 9_000.0)
    account[:, 1] = t + np.arange(len(account)) + 0.5
    return Forecast(t, own, leader, account, account[:, 0], NEVER)


def test_new_plans_are_counted_whether_announced_or_not() -> None:
    engaged = next(d for d in ideal_flight() if isinstance(d, PlanChanged))
    news = replace(engaged, t=1.0, reason="better_plan")
    milestones = count_milestones(engaged, news, replace(news, t=2.0, announced=False))
    assert (milestones.replans, milestones.replans_announced) == (2, 1)
    assert milestones.promised == engaged.promised
    assert milestones.planned_time == engaged.plan.time_to_converge


def test_only_the_plan_at_engagement_promises() -> None:
    engaged = next(d for d in ideal_flight() if isinstance(d, PlanChanged))
    late = count_milestones(replace(engaged, t=5.0))
    assert (late.planned_time, late.promised, late.replans) == (0.0, 0.0, 0)


def test_an_alert_counts_from_its_first_word_until_it_is_cleared() -> None:
    assert count_milestones(alert(10.0), alert(13.0, level="warning")).alerted == (10.0,)
    assert count_milestones(alert(10.0), alert(20.0, cleared=True)).alerted == ()
    assert count_milestones(alert(10.0, level="advisory")).alerted == ()


def test_unable_counts_from_its_first_word_until_there_is_a_plan() -> None:
    engaged = next(d for d in ideal_flight() if isinstance(d, PlanChanged))
    unable = Unable(t=12.0, ident="A", reason="separation", message="")
    assert count_milestones(unable, replace(unable, t=14.0)).unable == (12.0,)
    assert count_milestones(unable, alert(20.0, cleared=True)).unable == (12.0,)
    for reason in ("engaged", "better_plan"):
        assert count_milestones(unable, replace(engaged, t=15.0, reason=reason)).unable == ()


def test_following_counts_from_when_it_last_began() -> None:
    mode = ModeChanged(t=50.0, ident="A", mode="follow", previous="capture", message="")
    away = replace(mode, t=60.0, mode="converge", previous="follow")
    assert count_milestones(mode, away, replace(mode, t=90.0)).following_since == 90.0


def test_a_loss_keeps_its_least_separation() -> None:
    milestones = count_milestones(loss(10.0, 9_250.0))
    milestones = count_loss(count_loss(milestones, 9_100.0), 9_200.0)
    assert milestones.losses == (Loss(t=10.0, separation=9_100.0, cause="why", announced=()),)
    again = count_loss(count_event(milestones, loss(50.0, 9_255.0)), 9_000.0)
    assert [one.separation for one in again.losses] == [9_100.0, 9_000.0]


def test_a_straight_forecast_is_a_point_every_half_minute() -> None:
    document = forecast_document(100.0, "A", forecast_of([0.5] * 121))
    assert isinstance(document, ForecastChanged)
    assert document.times == (100.0, 130.0, 160.0, 190.0, 220.0)
    assert len(document.x) == len(document.y) == len(document.heading) == 5
    assert hypot(document.x[-1], document.y[-1]) == pytest.approx(120 * 200.0)


def test_a_turning_forecast_strays_little_from_its_chords() -> None:
    headings = list(np.radians(np.linspace(0.0, 150.0, 101)))
    document = forecast_document(100.0, "A", forecast_of(headings))
    steps = np.diff(document.heading)
    assert steps.max() <= BENT + 1.5 * DEG  # and what it turns in the second after
    assert len(document.times) > 30
    assert max(np.diff(document.times)) <= STRAIGHT_FOR


def test_a_forecast_that_began_before_is_told_from_now_on() -> None:
    document = forecast_document(130.0, "A", forecast_of([0.0] * 61))
    assert (document.times[0], document.times[-1]) == (130.0, 160.0)
    assert document.y[0] == pytest.approx(30 * 200.0)


def test_a_forecast_says_where_both_will_be_when_they_are_closest() -> None:
    flown = forecast_of([0.0] * 61)
    flown.account[40, 0] = 8_000.0
    document = forecast_document(110.0, "A", flown)
    assert document.least_separation == 8_000.0
    own, leader = document.pursuer_at_closest, document.leader_at_closest
    assert (own.t, leader.t) == (140.5, 140.5)
    assert own.y == pytest.approx(40.5 * 200.0)
    assert (leader.x, leader.y) == (9_000.0, own.y)


def test_a_forecast_at_its_end_is_closest_there() -> None:
    document = forecast_document(160.0, "A", forecast_of([0.0] * 61))
    assert document.least_separation == pytest.approx(9_000.0)
    assert document.pursuer_at_closest.y == pytest.approx(60 * 200.0)


def test_the_result_of_a_pursuer_that_has_not_joined_ends_with_the_flight() -> None:
    result = link_result(77.0, NAMES, Milestones(), Tally(inf), fallbacks=2)
    assert (result.joined, result.join_time, result.fallbacks) == (False, 77.0, 2)
    joined = Milestones(joined=True, join_time=55.0)
    assert link_result(77.0, NAMES, joined, Tally(inf), 0).join_time == 55.0


def test_headings_of_a_forecast_are_those_of_a_compass() -> None:
    document = forecast_document(100.0, "A", forecast_of([7.0] * 31))
    assert document.heading[0] == pytest.approx(7.0 - 2.0 * np.pi)
