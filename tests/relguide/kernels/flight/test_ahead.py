"""What is flown ahead is what the world then flies, and turns are followed where they were led."""

from dataclasses import replace
from math import copysign, cos, sin

import numpy as np
import pytest

from relguide.flying.belief import FlownTrack
from relguide.flying.fleet import Fleet
from relguide.flying.flight import Scenario, world_of
from relguide.flying.guidance.commit.proposal import Proposal
from relguide.flying.guidance.commit.propose import propose
from relguide.flying.guidance.forecast import NO_COURSE
from relguide.flying.guidance.settings import DEFAULT
from relguide.flying.knowledge import belief_of
from relguide.flying.pursuit import assignment_of, begin_pursuit
from relguide.flying.scenarios import scenario
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight import marks as at
from relguide.kernels.flight.ahead import AT, LEAST, MODE, NEVER, TO_SLOT, add_mark, fly_ahead
from relguide.kernels.flight.flight_records import Body, Drift
from relguide.kernels.flight.guide import (
    CAPTURE,
    CONVERGE,
    FOLLOW,
    HOLD,
    Course,
    Progress,
    Task,
    act,
)
from relguide.kernels.flight.laws import ground_track
from relguide.kernels.flight.marks import beside_marks
from relguide.planning.intent import FlyStraight, TurnTo
from relguide.planning.plan import plan
from relguide.planning.trajectory import RIGHT
from relguide.planning.wind import wind_from
from relguide.units import DEG, NM
from tests.aloft import GAINS, LIMITS, level, limits_of

STEPS = 20
SECONDS = 1_200


def turning_leader(*, turns_at: float = 300.0) -> Scenario:
    """Fig. 6b in a wind, its leader turning while the pursuer is still far out."""
    known = scenario("fig_6b")
    leader = replace(
        known.situation.leader,
        intent=(
            FlyStraight(duration=turns_at),
            TurnTo(heading=160.0 * DEG, turn=RIGHT, bank=20.0 * DEG),
        ),
    )
    situation = replace(known.situation, leader=leader, wind=wind_from(200.0 * DEG, 18.0))
    return replace(known, situation=situation)


def engage(flight: Scenario) -> tuple[Fleet, FlownTrack, Proposal]:
    """A world as it begins, and the path that its pursuer commits to."""
    world = world_of(flight)
    fleet, link = Fleet(world, 1.0 / STEPS), world.links[0]
    track = begin_pursuit(world, fleet, link).track
    belief = belief_of(fleet, 0, 1, track, 0.0, True)
    found = propose(belief, assignment_of(world, link), None, plan)
    assert isinstance(found, Proposal)
    return fleet, track, found


def flown_by_seconds(
    fleet: Fleet, track: FlownTrack, progress: Progress, course: Course, seconds: int
) -> tuple[FloatArray, FloatArray, list[float], list[float]]:
    """A world flown without planning: both aircraft each second, least separations, and when
    joined.
    """
    link = fleet.world.links[0]
    asked = assignment_of(fleet.world, link)
    states, least, joined = [fleet.states.copy()], [], []
    for second in range(seconds):
        t = float(second)
        track.add(fleet.body(1), fleet.drift(1), t)
        belief = belief_of(fleet, 0, 1, track, t, True)
        done = act(
            progress, belief.own, belief.limits, course, track.marks, belief.turn_to_come,
            asked.task, asked.gate, asked.gains, belief.drift, t,
        )  # fmt: skip
        progress = done.progress
        if done.joined:
            joined.append(t)
        fleet.control(0, done.control)
        fleet.fly_second(t)
        states.append(fleet.states.copy())
        least.append(fleet.least_apart(0, 1))
    own, leader = np.array(states).transpose(1, 0, 2)
    return own, leader, least, joined


def fly_compiled(
    fleet: Fleet, track: FlownTrack, progress: Progress, course: Course, *, steps: int = STEPS,
    seconds: int = SECONDS, after_joining: int = 200,
) -> tuple[FloatArray, FloatArray, FloatArray, float]:  # fmt: skip
    asked = assignment_of(fleet.world, fleet.world.links[0])
    belief = belief_of(fleet, 0, 1, track, 0.0, True)
    return fly_ahead(
        progress, belief.own, belief.limits, course, track.marks, belief.leader,
        belief.leader_limits, belief.program, belief.cursor, belief.held, belief.leader_tas,
        belief.last_turn, asked.task, asked.gate, asked.gains, belief.drift, 0.0, seconds,
        after_joining, steps,
    )  # fmt: skip


@pytest.mark.parametrize("turns_at", [300.0, 820.0])
def test_what_is_flown_ahead_is_what_the_world_flies(turns_at: float) -> None:
    fleet, track, found = engage(turning_leader(turns_at=turns_at))
    progress, course = Progress(CONVERGE, 0.0, 0.0, 0.0), found.committed.course
    own, leader, account, join_time = fly_compiled(fleet, track, progress, course)
    known = len(track.marks)
    flown, led, least, joined = flown_by_seconds(fleet, track, progress, course, len(account))
    assert own == pytest.approx(flown, abs=1e-9)
    assert leader == pytest.approx(led, abs=1e-9)
    assert account[:, LEAST] == pytest.approx(least, abs=1e-9)
    assert join_time == joined[0]
    assert len(account) == join_time + 200
    # it joins once, and stays so
    assert joined == list(np.arange(joined[0], len(account)))
    modes = account[:, MODE].tolist()
    assert modes == sorted(modes)
    assert set(modes) == {CONVERGE, CAPTURE, FOLLOW}
    # a mark a second is added to the leader's flown path; the first is where it begins
    marks = track.marks
    assert len(marks) == known + len(account) - 1
    assert np.all(np.diff(marks[:, at.S]) > 0.0)
    assert marks[known:, [at.X, at.Y]] == pytest.approx(leader[1:-1, :2])


def test_a_forecast_in_quarters_of_a_second_is_the_flight_to_a_few_metres() -> None:
    fleet, track, found = engage(turning_leader())
    progress, course = Progress(CONVERGE, 0.0, 0.0, 0.0), found.committed.course
    fine = fly_compiled(fleet, track, progress, course, steps=20)
    rough = fly_compiled(fleet, track, progress, course, steps=4)
    n = min(len(fine[0]), len(rough[0]))
    for k in (0, 1):
        apart = np.hypot(*(fine[k][:n, :2] - rough[k][:n, :2]).T)
        assert np.max(apart) < 10.0
    assert abs(fine[3] - rough[3]) <= 1.0


def test_the_account_says_when_they_are_nearest() -> None:
    fleet, track, found = engage(turning_leader())
    own, leader, account, _ = fly_compiled(
        fleet, track, Progress(CONVERGE, 0.0, 0.0, 0.0), found.committed.course
    )
    k = int(np.argmin(account[:, LEAST]))
    assert k <= account[k, AT] <= k + 1
    dense = np.hypot(*(own[:, :2] - leader[:, :2]).T)
    assert account[k, LEAST] <= np.min(dense)
    assert account[k, LEAST] == pytest.approx(np.min(dense), abs=10.0)
    assert abs(account[-1, TO_SLOT]) < DEFAULT.joined_along


def test_what_does_not_join_is_flown_to_the_end() -> None:
    fleet, track, _ = engage(turning_leader())
    held = Progress(HOLD, 0.0, 0.5, 230.0)
    own, leader, account, join_time = fly_compiled(fleet, track, held, NO_COURSE, seconds=300)
    assert join_time == NEVER
    assert len(own) == len(leader) == len(account) + 1 == 301
    assert own[-1, 2] == pytest.approx(0.5, abs=0.1 * DEG)
    assert own[-1, 5] == pytest.approx(230.0)


def test_a_mark_is_where_the_leader_is_and_how_it_moves_over_the_ground() -> None:
    wind, body = Drift(30.0, -10.0), level(400.0, 300.0, 15.0, tas=200.0)
    marks = np.zeros((2, 7))
    add_mark(marks, 1, body, wind, 7.0)
    direction, speed = ground_track(body, wind)
    assert marks[1] == pytest.approx([500.0, 400.0, 300.0, body.heading, direction, speed, 7.0])


def follow(
    wind: Drift, turn: float, bank: float, *, spacing: float = 0.0
) -> tuple[FloatArray, FloatArray]:
    """Joined at 10 km or so many seconds behind a leader of 200 m/s that turns by 90° after a
    minute: how far beside its ground path the follower is each second, and its speeds.
    """
    leader = level(tas=200.0)
    chi, speed = ground_track(leader, wind)
    d = speed * spacing if spacing else 10_000.0
    track = FlownTrack(leader, wind, 0.0, d + 20_000.0)
    own = level(-d * sin(chi), -d * cos(chi), tas=200.0)
    program = np.array([[0.0, 60.0, 0.0], [1.0, turn * DEG, copysign(bank * DEG, turn)]])
    flown, led, _, _ = fly_ahead(
        Progress(FOLLOW, -d - 200.0, 0.0, 0.0), own, LIMITS, NO_COURSE, track.marks, leader,
        limits_of(max_bank=30.0 * DEG), program, 0, 0.0, 200.0, 1,
        Task(240.0, d, d, spacing, 8_000.0), DEFAULT.gate, GAINS, wind, 0.0, 600, 1_000, 4,
    )  # fmt: skip
    for t, row in enumerate(led[1:], 1):
        track.add(Body(*row), wind, float(t))
    beside, s = [], -d
    for row in flown:
        s, right = beside_marks(track.marks, row[0], row[1], s + speed)
        beside.append(right)
    return np.array(beside), flown[:, 5]


@pytest.mark.parametrize("toward", range(0, 360, 45))
@pytest.mark.parametrize("turn", [90.0, -90.0])
@pytest.mark.parametrize("spacing", [0.0, 50.0])
def test_a_turn_is_followed_over_the_ground_in_a_storm(
    toward: float, turn: float, spacing: float
) -> None:
    """40 m/s, across or from anywhere: within 0.1 NM of where the leader turned; measured 31 m."""
    wind = Drift(40.0 * sin(toward * DEG), 40.0 * cos(toward * DEG))
    for bank in (15.0, 25.0):
        beside, speeds = follow(wind, turn, bank, spacing=spacing)
        assert np.max(np.abs(beside)) < 50.0 < 0.1 * NM
        assert abs(beside[-1]) < 10.0
        assert speeds[-1] == pytest.approx(200.0, abs=5.0)
        assert np.min(speeds) > 150.0
