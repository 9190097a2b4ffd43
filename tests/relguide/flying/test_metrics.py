"""The figures of a flight, counted as it is flown."""

from dataclasses import replace
from math import inf

from relguide.flying.aircraft_documents import Loss
from relguide.flying.documents import (
    Alert,
    Document,
    EngagementChanged,
    ModeChanged,
    PlanChanged,
    SeparationLost,
    Unable,
)
from relguide.flying.logbook import PairNames
from relguide.flying.metrics import count_event, count_loss, link_result
from relguide.flying.pursuit import FlightMetrics
from tests.server.flown import ideal_flight

NAMES = PairNames("A", "B")


def count(*documents: Document) -> FlightMetrics:
    metrics = FlightMetrics(inf)
    for document in documents:
        metrics = count_event(metrics, document, NAMES.leader)
    return metrics


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


def test_new_plans_are_counted_whether_announced_or_not() -> None:
    engaged = next(d for d in ideal_flight() if isinstance(d, PlanChanged))
    news = replace(engaged, t=1.0, reason="better_plan")
    metrics = count(engaged, news, replace(news, t=2.0, announced=False))
    assert (metrics.replans, metrics.replans_announced) == (2, 1)
    assert metrics.promised == engaged.promised
    assert metrics.planned_time == engaged.plan.time_to_converge


def test_only_the_plan_at_engagement_promises() -> None:
    engaged = next(d for d in ideal_flight() if isinstance(d, PlanChanged))
    late = count(replace(engaged, t=5.0))
    assert (late.planned_time, late.promised, late.replans) == (0.0, 0.0, 0)
    by_crew = EngagementChanged(
        t=5.0, ident="A", engagement="engaged", previous="armed", message=""
    )
    planned, promised = engaged.plan.time_to_converge, engaged.promised
    late = count(by_crew, replace(engaged, t=5.0), replace(engaged, t=9.0, promised=1.0))
    assert (late.planned_time, late.promised, late.replans) == (planned, promised, 0)
    off = replace(by_crew, t=7.0, engagement="off", previous="engaged")
    late = count(off, replace(by_crew, t=8.0), replace(engaged, t=9.0))
    assert (late.planned_time, late.promised) == (0.0, 0.0)


def test_an_alert_counts_from_its_first_word_until_it_is_cleared() -> None:
    assert count(alert(10.0), alert(13.0, level="warning")).alerted == (10.0,)
    assert count(alert(10.0), alert(20.0, cleared=True)).alerted == ()
    assert count(alert(10.0, level="advisory")).alerted == ()


def test_unable_counts_from_its_first_word_until_there_is_a_plan() -> None:
    engaged = next(d for d in ideal_flight() if isinstance(d, PlanChanged))
    unable = Unable(t=12.0, ident="A", reason="separation", message="")
    assert count(unable, replace(unable, t=14.0)).unable == (12.0,)
    assert count(unable, alert(20.0, cleared=True)).unable == (12.0,)
    for reason in ("engaged", "better_plan"):
        assert count(unable, replace(engaged, t=15.0, reason=reason)).unable == ()


def test_following_counts_from_when_it_last_began() -> None:
    mode = ModeChanged(t=50.0, ident="A", mode="follow", previous="capture", message="")
    away = replace(mode, t=60.0, mode="converge", previous="follow")
    assert count(mode, away, replace(mode, t=90.0)).following_since == 90.0


def test_a_loss_keeps_its_least_separation() -> None:
    metrics = count(loss(10.0, 9_250.0))
    metrics = count_loss(count_loss(metrics, 9_100.0), 9_200.0)
    assert metrics.losses == (Loss(t=10.0, separation=9_100.0, cause="why", announced=()),)
    again = count_loss(count_event(metrics, loss(50.0, 9_255.0), "B"), 9_000.0)
    assert [one.separation for one in again.losses] == [9_100.0, 9_000.0]


def test_the_result_of_a_pursuer_that_has_not_joined_ends_with_the_flight() -> None:
    result = link_result(77.0, NAMES, FlightMetrics(inf), fallbacks=2, optimum=0.0)
    assert (result.joined, result.join_time, result.fallbacks) == (False, 77.0, 2)
    joined = FlightMetrics(inf, joined=True, join_time=55.0)
    assert link_result(77.0, NAMES, joined, 0, 40.0).join_time == 55.0
