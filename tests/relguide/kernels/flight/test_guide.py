"""One act of guidance: which mode it is in, what it tracks, and when it has joined."""

from math import cos, hypot, inf, pi, sin, tan

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from relguide.flying.belief import FlownTrack
from relguide.flying.guidance.forecast import NO_COURSE
from relguide.flying.guidance.settings import DEFAULT
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight.flight_records import HOLD_HEADING, Body, Control, Drift
from relguide.kernels.flight.guide import (
    BEND_BANK,
    CAPTURE,
    CONVERGE,
    ESCAPE,
    FOLLOW,
    HOLD,
    Act,
    Course,
    Progress,
    Task,
    act,
)
from relguide.kernels.flight.path import lay_path
from relguide.units import DEG, G0
from tests.aloft import FAR_AWAY, GAINS, LIMITS, STILL, level

GATE = DEFAULT.gate
D = 10_000.0
V = 200.0


def leader_marks(seconds: int, *, turned: float = 0.0, at_second: int = 0) -> FloatArray:
    """North at 200 m/s to (0, 0), where the leader is now; until a second, so far to the left."""
    positions = [(0.0, 0.0, 0.0)]
    for k in range(seconds, 0, -1):
        heading = -turned * DEG if k <= at_second else 0.0
        x, y, _ = positions[0]
        positions.insert(0, (x - V * sin(heading), y - V * cos(heading), heading))
    first = positions[0]
    track = FlownTrack(level(first[0], first[1], first[2] / DEG, tas=V), STILL, 0.0, 30_000.0)
    for t, (x, y, heading) in enumerate(positions[1:], 1):
        track.add(level(x, y, heading / DEG, tas=V), STILL, float(t))
    return track.marks


STRAIGHT = leader_marks(120)
TASK = Task(240.0, D, D, 0.0, 8_000.0)


def act_on(
    body: Body, mode: int = FOLLOW, *, marks: FloatArray = STRAIGHT, course: Course = NO_COURSE,
    task: Task = TASK, turn_to_come: bool = False, wind: Drift = STILL, s: float | None = None,
    t: float = 120.0,
) -> Act:  # fmt: skip
    """What is asked of an aircraft near the slot, 10 km south of the leader at (0, 0)."""
    last = marks[-1, 0]
    about = last + body.y if s is None else s
    progress = Progress(mode, about - body.tas, 0.7, 231.0)
    return act(progress, body, LIMITS, course, marks, turn_to_come, task, GATE, GAINS, wind, t)


@given(
    st.floats(-600.0, 600.0), st.floats(-400.0, 400.0), st.floats(-5.0, 5.0), st.booleans(),
)  # fmt: skip
def test_joined_is_the_gate_at_this_second(
    ahead: float, right: float, heading: float, turn_to_come: bool
) -> None:
    """Within 0.2 NM along, 0.1 NM across and 2° of heading, with the slot open."""
    edges = (abs(ahead), GATE.along), (abs(right), GATE.across), (abs(heading) * DEG, GATE.heading)
    assume(all(abs(value - edge) > 1e-9 for value, edge in edges))  # there rounding decides
    done = act_on(level(right, -D + ahead, heading, tas=V), CAPTURE, turn_to_come=turn_to_come)
    inside = abs(ahead) <= GATE.along and abs(right) <= GATE.across
    joined = inside and abs(heading) * DEG <= GATE.heading and not turn_to_come
    assert done.joined == joined
    assert done.progress.mode == (FOLLOW if joined else CAPTURE)
    assert done.right == pytest.approx(right, abs=1e-6)
    assert done.to_slot == pytest.approx(-ahead, abs=1e-6)


def test_the_slot_is_closed_until_the_leader_has_flown_d_on_its_heading() -> None:
    for since, joined in ((49, False), (51, True)):
        marks = leader_marks(120, turned=90.0, at_second=120 - since)
        assert act_on(level(0.0, -D, tas=V), marks=marks).joined == joined


def test_follow_stays_follow_out_of_the_gate_and_then_has_not_joined() -> None:
    done = act_on(level(900.0, -D, tas=V), FOLLOW)
    assert (done.progress.mode, done.joined) == (FOLLOW, False)


@pytest.mark.parametrize("mode", [HOLD, ESCAPE])
def test_where_a_heading_is_held_nothing_else_is_looked_at(mode: int) -> None:
    done = act_on(level(1e5, 1e5), mode)
    assert done.control == Control(HOLD_HEADING, 0.7, 231.0)
    assert done.progress.mode == mode
    assert not done.joined


def test_on_the_slot_nothing_is_asked_for() -> None:
    control = act_on(level(0.0, -D, tas=V)).control
    assert control == (HOLD_HEADING, pytest.approx(0.0, abs=1e-9), pytest.approx(V))


@pytest.mark.parametrize("right", [-300.0, 300.0])
def test_off_the_leaders_path_it_is_turned_back_to(right: float) -> None:
    control = act_on(level(right, -D, tas=V)).control
    assert control.value * right < 0.0


def test_speed_closes_what_is_left_to_the_slot() -> None:
    far, near, past = (
        act_on(level(0.0, -D - error, tas=V)).control.tas for error in (9_000.0, 500.0, -500.0)
    )
    assert far == TASK.tas
    assert V < near < far
    assert V - GAINS.falling_back <= past < V


@given(st.floats(0.0, 40.0), st.floats(-pi, pi))
def test_in_wind_the_ground_speed_is_matched(speed: float, toward: float) -> None:
    wind = Drift(speed * sin(toward), speed * cos(toward))
    body = level(0.0, -D, tas=V)
    track = FlownTrack(level(tas=V), wind, 0.0, 30_000.0)
    direction = track.marks[-1, 4]
    body = level(-D * sin(direction), -D * cos(direction), tas=V)
    control = act_on(body, marks=track.marks, wind=wind, s=-D).control
    assert control.tas == pytest.approx(V, abs=1e-6)
    assert control.value == pytest.approx(0.0, abs=1e-6)


def test_a_time_is_kept_as_well_as_a_distance() -> None:
    """45 s behind a leader of 200 m/s is 9 km; the speed of the leader then does not matter."""
    behind = TASK._replace(spacing=45.0)
    assert act_on(level(0.0, -9_000.0, tas=V), task=behind).to_slot == pytest.approx(0.0, abs=1e-6)
    assert act_on(level(0.0, -9_000.0, tas=V), task=behind).joined
    assert act_on(level(0.0, -D, tas=V), task=behind).to_slot == pytest.approx(1_000.0)
    assert not act_on(level(0.0, -D, tas=V), task=behind).joined


def test_too_near_the_leader_the_shorter_distance_sets_the_speed() -> None:
    """Across a bend: along the path there is room, through the air there is not."""
    marks = leader_marks(120, turned=150.0, at_second=100)
    leader = marks[-1]
    body = level(leader[1], leader[2] - 6_000.0, tas=V)
    done = act_on(body, marks=marks, s=float(marks[-1, 0]) - D)
    assert hypot(body.x - leader[1], body.y - leader[2]) < TASK.min_separation
    assert done.control.tas < V


def course(
    *pieces: tuple[float, float], slot_tas: float = V, wind: Drift = STILL
) -> tuple[Course, FloatArray]:
    """A path from (0, −40 km) north, in pieces of length [m] and curvature [rad/m]."""
    bends = np.array(pieces).reshape(-1, 2)
    path = lay_path(0.0, -40_000.0, 0.0, bends, 240.0, 0.0, LIMITS.max_roll_rate)
    return Course(path, 0.0, float(path[-1, 0]) + 5_000.0, slot_tas, wind, inf), path


TURNING = ((5_000.0, 0.0), (8_000.0, 1.0 / 14_000.0))


def test_a_path_that_still_turns_is_tracked_in_the_air_mass() -> None:
    wind, t = Drift(20.0, -5.0), 10.0
    flown, _ = course(*TURNING, wind=wind)
    body = level(wind.east * t + 70.0, -40_000.0 + 2_400.0 + wind.north * t)
    done = act_on(body, CONVERGE, marks=FAR_AWAY, course=flown, wind=wind, s=2_400.0, t=t)
    assert (done.progress.mode, done.joined) == (CONVERGE, False)
    assert done.progress.s == pytest.approx(2_400.0)
    assert done.right == pytest.approx(70.0)
    assert done.to_slot == pytest.approx(flown.slot + V * t - 2_400.0)


def test_capture_begins_where_nothing_turns_any_more_next_to_the_leaders_path() -> None:
    """50 m to the side: not while the path turns on, nor where the leader is or went elsewhere."""
    straight, turning = course((39_000.0, 0.0))[0], course((39_000.0, 0.0), (9e3, 1e-4))[0]
    for flown, marks, heading, mode in (
        (straight, STRAIGHT, 0.0, CAPTURE),
        (turning, STRAIGHT, 0.0, CONVERGE),
        (straight, FAR_AWAY, 0.0, CONVERGE),
        (straight, STRAIGHT, 0.09, CONVERGE),
    ):
        body = level(50.0, -15_000.0)._replace(heading=heading)
        done = act_on(body, CONVERGE, marks=marks, course=flown, s=25_000.0, t=0.0)
        assert done.progress.mode == mode
        assert not done.joined


def test_far_from_the_slot_a_path_beside_the_leaders_is_flown_on() -> None:
    """In wind it meets the leader's ground path only at the slot: 500 m before it, 250 m do."""
    straight = course((39_000.0, 0.0))[0]
    body = level(250.0, -15_000.0)
    for to_slot, mode in ((15_000.0, CONVERGE), (500.0, CAPTURE)):
        flown = straight._replace(slot=25_000.0 + to_slot)
        done = act_on(body, CONVERGE, marks=STRAIGHT, course=flown, s=25_000.0, t=0.0)
        assert done.progress.mode == mode


def test_a_faster_slot_is_not_braked_for() -> None:
    """Where the leader is faster than V_P, the pursuer goes for V_P all the way."""
    flown, _ = course(*TURNING, slot_tas=245.0)
    body = level(0.0, -30_000.0)
    done = act_on(body, CONVERGE, marks=FAR_AWAY, course=flown, s=10_000.0, t=0.0)
    assert done.control.tas == TASK.tas


def test_braking_begins_on_the_path() -> None:
    """While it turns, a kilometre from the slot, 40 m/s are too many."""
    flown, path = course(*TURNING)
    s = 9_000.0
    near = flown._replace(slot=s + 1_000.0)
    body = level()._replace(x=float(path[1, 1]) + 570.0, y=-40_000.0 + 8_970.0, heading=0.286)
    assert act_on(body, CONVERGE, marks=FAR_AWAY, course=near, s=s, t=0.0).control.tas < 239.0
    assert act_on(body, CONVERGE, marks=FAR_AWAY, course=flown, s=s, t=0.0).control.tas == 240.0


def test_a_bend_ahead_is_slowed_down_for_where_it_needs_more_than_the_bank() -> None:
    """The leader turned on 6 km; at 25° and 200 m/s a pursuer turns on 8.7 km."""
    radius, rate = 6_000.0, V / 6_000.0
    body, rows = level(tas=V), [level(tas=V)]
    for _ in range(40):
        angle = body.heading + rate
        body = body._replace(
            x=body.x + radius * (cos(body.heading) - cos(angle)),
            y=body.y + radius * (sin(angle) - sin(body.heading)),
            heading=angle,
        )
        rows.append(body)
    track = FlownTrack(rows[0], STILL, 0.0, 30_000.0)
    for t, row in enumerate(rows[1:], 1):
        track.add(row, STILL, float(t))
    behind = Task(240.0, 9_000.0, 9_000.0, 0.0, 500.0)
    done = act_on(level(0.0, -1_000.0, tas=V), marks=track.marks, task=behind, s=-1_000.0)
    assert done.control.tas == pytest.approx(
        (G0 * tan(BEND_BANK * LIMITS.max_bank) * radius) ** 0.5, rel=0.02
    )
    wide = leader_marks(120)
    done = act_on(level(0.0, -9_000.0, tas=V), marks=wide, task=behind)
    assert done.control.tas == pytest.approx(V)
