"""Plans as outsiders read them: over the ground, piece by piece."""

from itertools import pairwise
from math import hypot, pi

import pytest
from hypothesis import assume, given

from relguide import (
    CALM,
    LEFT,
    BoundaryArc,
    NoPlan,
    Plan,
    Reason,
    Situation,
    Straight,
    Trajectory,
    Wind,
    alternatives,
    plan,
    wind_from,
)
from relguide.flying.cards import no_plan_card, path_segments, plan_card, wind_card
from relguide.flying.plan_documents import (
    AlternativeCard,
    BoundarySegment,
    EarlyAlternativeCard,
    TurnSegment,
    UnsafeAlternativeCard,
)
from relguide.planning.slot import over_ground
from relguide.units import DEG
from tests.oracle import integrate, pieces_of
from tests.situations import golden, headings, numbers, situations


@given(situation=situations(reach=80_000.0))
def test_segments_join_up_over_the_ground(situation: Situation) -> None:
    answer = plan(situation)
    assume(isinstance(answer, Plan))
    assert isinstance(answer, Plan)
    card = plan_card(answer)
    wind = (situation.wind.east, situation.wind.north)
    pursuer = situation.pursuer
    track = integrate(
        (pursuer.x, pursuer.y, pursuer.heading), pursuer.tas, pieces_of(answer.trajectory), wind,
        answer.time_to_converge,
    )  # fmt: skip
    assert card.segments[0].start.t == 0.0
    for before, after in zip(card.segments[:-1], card.segments[1:], strict=True):
        assert before.end == after.start
    end = card.segments[-1].end
    assert end.t == pytest.approx(card.time_to_converge)
    assert hypot(end.x - track[-1][1], end.y - track[-1][2]) < 0.02
    for segment in card.segments:
        assert segment.duration == pytest.approx(segment.end.t - segment.start.t, abs=1e-9)
        if isinstance(segment, TurnSegment):
            assert segment.bank == pytest.approx(pursuer.max_bank)
            turned = segment.end.heading - segment.start.heading
            sign = 1.0 if segment.direction == "right" else -1.0
            off = (turned - sign * segment.angle) % (2.0 * pi)
            assert min(off, 2.0 * pi - off) < 1e-9


def test_a_horizon_appends_the_endless_straight_and_shifts_the_clock() -> None:
    flown = Trajectory(x=0.0, y=0.0, heading=0.0, tas=100.0, segments=(Straight(length=1_000.0),))
    segments = path_segments(flown, wind=Wind(east=5.0), start_time=50.0, horizon=30.0)
    assert [(s.start.t, s.end.t) for s in segments] == [(50.0, 60.0), (60.0, 80.0)]
    assert (segments[-1].end.x, segments[-1].end.y) == pytest.approx((150.0, 3_000.0))
    assert path_segments(flown, wind=CALM, horizon=5.0) == path_segments(flown, wind=CALM)


@given(direction=headings, speed=numbers(0.1, 90.0))
def test_wind_is_reported_as_it_was_given(direction: float, speed: float) -> None:
    card = wind_card(wind_from(direction, speed))
    off = (card.from_ - direction) % (2.0 * pi)
    assert min(off, 2.0 * pi - off) < 1e-9
    assert card.speed == pytest.approx(speed)
    assert wind_card(CALM).from_ == 0.0


def test_no_plan_keeps_its_reason_and_sentence() -> None:
    card = no_plan_card(NoPlan(reason=Reason.SLOT_UNREACHABLE, message="The leader is faster."))
    assert (card.status, card.reason, card.message) == (
        "no_plan",
        "slot_unreachable",
        "The leader is faster.",
    )


def test_alternatives_are_listed_with_what_they_lose() -> None:
    situation, _ = next(pair for pair in golden("reference") if pair[1]["id"] == "R061")
    answer = plan(situation)
    assert isinstance(answer, Plan)
    assert plan_card(answer).alternatives == ()
    cards = plan_card(answer, alternatives(answer)).alternatives
    assert [(card.word, card.rejected) for card in cards] == [
        ("RLR", "separation"),
        ("LRL", "slower"),
        ("RSL", "slower"),
        ("LSR", "slower"),
        ("RSR", "slower"),
        ("LSL", "no_root"),
    ]
    close, slower = cards[:2]
    assert isinstance(close, UnsafeAlternativeCard)
    assert close.why == "comes within 0.21 NM at 160 s"
    assert (close.passes, close.side) == ("behind", "left")
    assert isinstance(slower, AlternativeCard)
    assert slower.turning == pytest.approx(489.0 * DEG, abs=0.5 * DEG)


def test_a_slot_that_opens_later_names_what_comes_too_early() -> None:
    situation, _ = next(pair for pair in golden("reference") if pair[1]["id"] == "R104")
    answer = plan(situation)
    assert isinstance(answer, Plan)
    first = plan_card(answer, alternatives(answer)).alternatives[0]
    assert isinstance(first, EarlyAlternativeCard)
    assert first.release_time == pytest.approx(answer.time_to_converge)
    assert first.time_to_converge < first.release_time


@pytest.mark.parametrize(
    ("duration", "times"), [(4.9, []), (12.0, [4.0, 8.0]), (20.4, [4.08, 8.16, 12.24, 16.32])]
)
def test_a_boundary_arc_is_sent_with_a_point_every_five_seconds(
    duration: float, times: list[float]
) -> None:
    flown = Trajectory(
        x=100.0,
        y=200.0,
        heading=0.4,
        tas=200.0,
        segments=(
            Straight(length=1_000.0),
            BoundaryArc(side=LEFT, bends=((50.0, 1e-4), (200.0 * duration - 50.0, -5e-5))),
        ),
    )
    wind = Wind(east=10.0, north=-5.0)
    _, along = path_segments(flown, wind=wind, start_time=7.0)
    assert isinstance(along, BoundarySegment)
    assert [point.t for point in along.via] == pytest.approx([12.0 + time for time in times])
    for point, time in zip(along.via, times, strict=True):
        there = over_ground(flown.pose_at(5.0 + time), 5.0 + time, wind)
        expected = pytest.approx((there.x, there.y, there.heading), abs=1e-9)
        assert (point.x, point.y, point.heading) == expected


@pytest.mark.parametrize(("duration", "points"), [(4.9, 0), (5.1, 1), (12.0, 2), (100.0, 19)])
def test_a_boundary_arc_has_a_point_every_five_seconds_between_its_ends(
    duration: float, points: int
) -> None:
    arc = BoundaryArc(side=LEFT, bends=((200.0 * duration, -1e-5),))
    path = Trajectory(x=0.0, y=0.0, heading=0.0, tas=200.0, segments=(arc,))
    (segment,) = path_segments(path, wind=CALM, start_time=7.0)
    assert isinstance(segment, BoundarySegment)
    times = [segment.start.t, *(point.t for point in segment.via), segment.end.t]
    assert len(segment.via) == points
    steps = [after - before for before, after in pairwise(times)]
    assert steps == pytest.approx([duration / (points + 1)] * (points + 1))
