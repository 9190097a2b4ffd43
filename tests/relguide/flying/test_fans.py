"""Fans of joins: what is said is what would be flown, and it is said to viewers only."""

from itertools import pairwise

import pytest

from relguide.flying.documents import Document, FanChanged, ModeChanged, Sample
from relguide.flying.fans import FAN_EVERY, all_fans, no_fans
from relguide.flying.flight import IntentKnown, SetEngagement, fly
from relguide.flying.guidance.fan import KNOWN_BEFORE, TURNS
from relguide.flying.scenarios import fig_6
from relguide.planning.plan import plan
from relguide.units import DEG
from tests.flights import Flown, fly_whole, saying

UNKNOWN = fig_6(intent_known=False)
"""Fig. 6a: the leader turns at 820 s without a word."""


def with_fans(until: float = 2_000.0, *said: tuple[float, object]) -> Flown:
    documents = list[Document]()
    flight = fly(UNKNOWN, plan, commands=saying(*said), sample_period=1.0, wants_fan=all_fans)  # type: ignore[arg-type]
    for document in flight:
        documents.append(document)
        if document.t >= until:
            break
    return Flown(tuple(documents))


@pytest.fixture(scope="module")
def fig_6a() -> Flown:
    return with_fans()


@pytest.mark.slow
def test_a_fan_has_seven_joins_of_which_the_middle_is_the_one_that_is_promised(
    fig_6a: Flown,
) -> None:
    first = fig_6a.of(FanChanged)[0]
    assert [join.turn for join in first.joins] == list(TURNS)
    straight = first.joins[3]
    promised = next(s for s in fig_6a.of(Sample) if s.t == 1.0).guidance[0].time_to_go
    assert straight.joins == pytest.approx(1.0 + promised, abs=1.0)
    times = [join.joins for join in first.joins]
    assert times == sorted(times)  # the leader comes toward it by a turn to the left
    assert all(join.least >= 9_260.0 for join in first.joins)


@pytest.mark.slow
def test_the_leader_s_turn_moves_the_join_to_where_the_fan_had_it(fig_6a: Flown) -> None:
    """It turns 45° to the right at 820 s, beyond the fan's last join to the right."""
    before = [fan for fan in fig_6a.of(FanChanged) if fan.t <= 820.0][-1]
    joined = fig_6a.result.join_time
    assert min(abs(join.joins - joined) for join in before.joins if join.turn > 0.0) < 40.0
    assert before.joins[3].joins < joined - 100.0


@pytest.mark.slow
def test_what_knowing_saves_is_what_figure_6_shows(fig_6a: Flown) -> None:
    """6a joins 100 s after 6b, whose leader's turn is known: the fan says so before the turn."""
    fans = [fan for fan in fig_6a.of(FanChanged) if 740.0 <= fan.t <= 800.0]
    assert all(80.0 < fan.most_saved < 200.0 for fan in fans)
    assert all(0.0 <= fan.mean_saved <= fan.most_saved for fan in fig_6a.of(FanChanged))
    soon = [fan for fan in fig_6a.of(FanChanged) if fan.t > 870.0 - KNOWN_BEFORE and fan.t < 820.0]
    assert [fan.most_saved for fan in soon] == [0.0] * len(soon)  # it joins before such a turn


@pytest.mark.slow
def test_it_is_made_every_five_seconds_at_most_and_closed_once_the_route_is_captured(
    fig_6a: Flown,
) -> None:
    *fans, last = fig_6a.of(FanChanged)
    assert all(fan.joins for fan in fans)
    assert last.joins == ()
    assert all(later.t - before.t >= FAN_EVERY for before, later in pairwise(fans))
    (captured,) = [d.t for d in fig_6a.of(ModeChanged) if d.mode == "capture"]
    assert last.t == captured
    assert 40 < len(fans) < 120


def test_a_fan_is_closed_when_the_intent_is_known_and_opened_again_when_it_is_not() -> None:
    flight = with_fans(20.0, (5.0, IntentKnown(known=True)), (12.0, IntentKnown(known=False)))
    assert [(fan.t, bool(fan.joins)) for fan in flight.of(FanChanged)][:3] == [
        (0.0, True), (5.0, False), (12.0, True),
    ]  # fmt: skip


def test_a_proposal_has_a_fan_as_well() -> None:
    """Nothing is flown, and the join after each turn is of a path that could be."""
    said = [(0.0, SetEngagement(engagement="off")), (2.0, SetEngagement(engagement="designated"))]
    flight = with_fans(4.0, *said)
    *_, fan = flight.of(FanChanged)
    assert [join.turn for join in fan.joins] == list(TURNS)


@pytest.mark.slow
def test_flights_are_the_same_with_fans_and_without(fig_6a: Flown) -> None:
    plain = fly_whole(UNKNOWN)
    assert plain.of(FanChanged) == []
    assert plain.samples == fig_6a.samples
    assert plain.result == fig_6a.result
    assert fig_6(intent_known=True).intent_known  # and where all is known there is none
    known = fly(fig_6(intent_known=True), plan, sample_period=1.0, wants_fan=all_fans)
    assert not any(isinstance(document, FanChanged) for document in known)


def test_nobody_is_asked_more_often_than_a_fan_is_due() -> None:
    asked = list[float]()

    def wants(t: float) -> bool:
        asked.append(t)
        return no_fans(t)

    for document in fly(UNKNOWN, plan, sample_period=1.0, wants_fan=wants):
        assert not isinstance(document, FanChanged)
        if document.t >= 3.0:
            break
    assert asked == [0.0, 1.0, 2.0, 3.0]


def test_the_turns_are_thirty_degrees_to_either_side() -> None:
    assert [round(turn / DEG) for turn in TURNS] == [-30, -20, -10, 0, 10, 20, 30]
