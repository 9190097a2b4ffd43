"""What a pursuer knows is what it can know: the leader's flown path, and its intent if declared."""

from math import cos, pi, sin

import numpy as np
import pytest

from relguide.flying.air import Air
from relguide.flying.airframe_files import airframe
from relguide.flying.belief import ROOM, SPARE, Belief, FlownTrack, intent_after
from relguide.flying.fleet import Fleet
from relguide.flying.knowledge import belief_of
from relguide.flying.perception import CERTAIN, Perceived, Spread
from relguide.flying.pursuit import begin_pursuit
from relguide.flying.world import Aircraft, Declared, Guided, Link, Pilot, World
from relguide.kernels.flight.flight_records import Drift
from relguide.kernels.flight.laws import ground_track
from relguide.kernels.flight.program import roll_lead
from relguide.planning.aircraft import Leader
from relguide.planning.intent import FlyStraight, IntentPiece, TurnTo
from relguide.planning.trajectory import LEFT, RIGHT
from relguide.planning.wind import Wind
from relguide.units import DEG, NM
from tests.aloft import level

D = 12_000.0
WIND = Wind(east=25.0, north=-10.0)
STRAIGHT, TURN = (
    FlyStraight(duration=60.0),
    TurnTo(heading=150.0 * DEG, turn=RIGHT, bank=20.0 * DEG),
)


def world(*, pilot: Pilot | None = None) -> World:
    def one(ident: str, x: float, flown_by: Pilot) -> Aircraft:
        return Aircraft(
            ident=ident, airframe=airframe("A306"), aircraft_type="A306", x=x, y=0.0,
            heading=90.0 * DEG, tas=200.0, altitude=9449.0, max_bank=25.0 * DEG, pilot=flown_by,
        )  # fmt: skip

    return World(
        aircraft=(
            one("P", -30e3, Guided()),
            one("L", 0.0, pilot or Declared(intent=(STRAIGHT, TURN))),
        ),
        links=(Link(pursuer="P", leader="L", slot_distance=D, min_separation=5.0 * NM),),
        air=Air(wind=WIND),
    )


def leader_after(seconds: int, *, known: bool = True, pilot: Pilot | None = None) -> Belief:
    """What is known after some seconds."""
    fleet = Fleet(world(pilot=pilot), 0.05)
    track = begin_pursuit(fleet.world, fleet, fleet.world.links[0]).track
    for second in range(seconds):
        fleet.fly_second(float(second))
        track.add(fleet.body(1), fleet.drift(1), float(second + 1))
    return belief_of(fleet, 0, 1, track, float(seconds), known)


def test_a_known_intent_is_what_is_left_of_it() -> None:
    assert leader_after(0).intent == (STRAIGHT, TURN)
    straight, turn = leader_after(20).intent
    assert isinstance(straight, FlyStraight)
    assert (straight.duration, turn) == (pytest.approx(40.0), TURN)
    assert leader_after(90).intent == (TURN,)
    assert leader_after(200).intent == ()


def test_the_turns_to_come_are_those_of_the_intent() -> None:
    for seconds, to_come in ((0, True), (90, True), (200, False)):
        belief = leader_after(seconds)
        assert belief.turn_to_come == to_come
        assert belief.last_turn == 1
        assert (belief.cursor <= belief.last_turn) == to_come
    assert leader_after(0, pilot=Declared()).last_turn == -1


def test_nothing_is_known_of_an_intent_that_was_not_declared() -> None:
    belief = leader_after(20, known=False)
    assert (belief.intent, belief.intent_known, belief.last_turn) == ((), False, -1)
    assert len(belief.program) == 0
    assert belief.final_heading == pytest.approx(90.0 * DEG)
    assert belief.leader_after(0.0).intent == ()


def test_the_final_heading_is_that_of_the_last_turn() -> None:
    assert leader_after(0).final_heading == TURN.heading
    assert leader_after(200).final_heading == pytest.approx(150.0 * DEG, abs=1.0 * DEG)


def test_a_leader_that_turns_unannounced_is_expected_to_roll_out_at_once() -> None:
    belief = leader_after(80, known=False)
    lead = roll_lead(belief.leader_limits, belief.leader.bank, 0.0)
    assert belief.leader_turn_rate > 0.01
    wanted = belief.leader.heading + belief.leader_turn_rate * lead
    assert belief.leader_rolled_out == pytest.approx(wanted)
    expected = belief.leader_after(0.0)
    assert expected.heading == pytest.approx(wanted)
    assert (expected.x, expected.y) == (belief.leader.x, belief.leader.y)


def test_the_slot_is_open_where_d_was_flown_since_the_last_turn() -> None:
    assert not leader_after(20).slot_open(D)
    assert leader_after(20, known=False).slot_open(D)
    assert not leader_after(130).slot_open(D)
    assert leader_after(220).slot_open(D)


def test_the_leader_later_is_where_it_will_be_over_the_ground() -> None:
    """The whole flight against what was expected at its beginning: the roll costs metres."""
    expected, then = leader_after(0).leader_after(150.0), leader_after(150).leader
    assert (expected.x, expected.y) == pytest.approx((then.x, then.y), abs=40.0)
    assert expected.heading == pytest.approx(then.heading, abs=1.0 * DEG)
    assert expected.intent == ()
    assert leader_after(0).leader_after(70.0).intent == (TURN,)


@pytest.mark.parametrize(
    "intent", [(), (STRAIGHT,), (STRAIGHT, TURN), (STRAIGHT, STRAIGHT, TURN), (TURN, STRAIGHT)]
)
def test_the_leader_later_is_where_its_whole_trajectory_leads(
    intent: tuple[IntentPiece, ...],
) -> None:
    """On the piece being flown, which guidance asks for most, no trajectory is laid out."""
    belief = leader_after(0, pilot=Declared(intent=intent))
    now = belief.leader_after(0.0)
    for seconds in (1e-9, 1.0, 59.999, 60.0, 60.001, 100.0, 300.0):
        then, pose = belief.leader_after(seconds), now.trajectory.pose_at(seconds)
        drifted = pose.x + WIND.east * seconds, pose.y + WIND.north * seconds
        assert (then.x, then.y) == pytest.approx(drifted, abs=1e-6)
        assert cos(then.heading - pose.heading) == pytest.approx(1.0, abs=1e-15)
        left = intent_after(now, seconds)
        assert [piece.kind for piece in then.intent] == [piece.kind for piece in left]
        for has, had in zip(then.intent, left, strict=True):
            if isinstance(has, FlyStraight) and isinstance(had, FlyStraight):
                assert has.duration == pytest.approx(had.duration, abs=1e-9)
            else:
                assert has == had


def test_of_an_intent_so_much_is_left_after_a_while() -> None:
    leader = Leader(x=0.0, y=0.0, heading=90.0 * DEG, tas=200.0, intent=(STRAIGHT, TURN))
    assert intent_after(leader, 0.0) == (STRAIGHT, TURN)
    assert intent_after(leader, 25.0) == (FlyStraight(duration=35.0), TURN)
    assert intent_after(leader, 60.0) == intent_after(leader, 70.0) == (TURN,)
    assert intent_after(leader, 900.0) == ()
    back = TurnTo(heading=90.0 * DEG, turn=LEFT, bank=20.0 * DEG)
    two = Leader(x=0.0, y=0.0, heading=90.0 * DEG, tas=200.0, intent=(TURN, STRAIGHT, back))
    turned = two.trajectory.durations()[0]
    left, last = intent_after(two, turned + 10.0)
    assert isinstance(left, FlyStraight)
    assert (left.duration, last) == (pytest.approx(50.0), back)


def test_what_is_perceived_is_believed_of_the_leader_and_the_air() -> None:
    assert (leader_after(0).wind, leader_after(0).spread) == (WIND, CERTAIN)
    fleet = Fleet(world(), 0.05)
    track = begin_pursuit(fleet.world, fleet, fleet.world.links[0]).track
    seen = Perceived(level(300.0, 40.0, 88.0, tas=203.0), Drift(3.0, 4.0), Spread(60.0, 2.0), 1.5)
    belief = belief_of(fleet, 0, 1, track, 0.0, True, seen=seen)
    assert belief.own == fleet.body(0)  # where it is itself is known
    assert (belief.leader, belief.leader_tas) == (seen.leader, 203.0)
    assert (belief.wind, belief.drift) == (Wind(east=3.0, north=4.0), seen.wind)
    assert (belief.spread, belief.leader_age) == (seen.spread, 1.5)
    # 90° was declared: in a wind that is known no better, it heads as it seems to
    assert belief.holds == seen.leader.heading
    assert [belief.place_slack, belief.speed_slack, belief.heading_slack] == pytest.approx(
        [3.0 * 60.0, 3.0 * 2.0, 3.0 * 2.0 / 203.0]
    )


def test_at_first_sight_the_leader_has_come_straight() -> None:
    wind, leader = Drift(30.0, 0.0), level(1_000.0, 2_000.0, 20.0, tas=200.0)
    first, now = FlownTrack(leader, wind, 5.0, D + SPARE).marks
    direction, speed = ground_track(leader, wind)
    behind = D + SPARE
    assert now[:3] == pytest.approx([0.0, leader.x, leader.y])
    assert first[:3] == pytest.approx(
        [-behind, leader.x - behind * sin(direction), leader.y - behind * cos(direction)]
    )
    assert first[3:6] == pytest.approx([20.0 * DEG, direction, speed])
    assert np.array_equal(now[3:6], first[3:6])
    assert (now[6], first[6]) == (5.0, pytest.approx(5.0 - behind / speed))


def test_a_repeated_report_changes_nothing() -> None:
    still = Drift(0.0, 0.0)
    track = FlownTrack(level(tas=200.0), still, 0.0, D)
    track.add(level(0.0, 200.0, tas=200.0), still, 1.0)
    before = track.marks.copy()
    track.add(level(0.0, 250.0, tas=200.0), still, 1.0)
    assert np.array_equal(track.marks, before)


def test_a_track_grows_beyond_its_first_room_and_keeps_what_it_had() -> None:
    still = Drift(0.0, 0.0)
    track = FlownTrack(level(tas=200.0), still, 0.0, D)
    for t in range(1, 2 * ROOM):
        track.add(level(0.0, 200.0 * t, tas=200.0), still, float(t))
    marks = track.marks
    assert len(marks) == 2 * ROOM + 1
    assert marks[1:, 0] == pytest.approx(200.0 * np.arange(2 * ROOM))
    assert np.all(np.diff(marks[:, 6]) > 0.0)


def test_headings_of_the_leader_are_counted_on() -> None:
    round_ = TurnTo(heading=85.0 * DEG, turn=RIGHT, bank=25.0 * DEG)
    belief = leader_after(310, pilot=Declared(intent=(round_,)))
    assert belief.leader.heading == pytest.approx((90.0 + 355.0) * DEG, abs=1.0 * DEG)
    assert 0.0 <= belief.leader_after(0.0).heading < 2.0 * pi
