"""Situations behind a leader that turns in which numbers coincide to the last digit.

Drawn by a random generator, since most are found by planning: a switch of the leader's is
put where the plan touches d_min, the slot is released as a root arrives, a flight goes on from its
contact. `tests/situations.py` has the coincidences that need no plan.
"""

from collections.abc import Callable
from dataclasses import replace
from math import cos, hypot, pi, sin

import numpy as np

from benchmarks import draws
from relguide import CALM, FlyStraight, Leader, Plan, Situation, plan
from relguide.kernels.base.records import Pose
from relguide.kernels.contact.contact import contact_heading
from relguide.kernels.words.extremals import MAX_ROWS, solve
from relguide.planning.limits import DISTANCE
from relguide.planning.slot import slot_frame

_ROUNDS = 8
"""A switch is moved this often to where the plan then touches d_min."""
_HALVINGS = 60


def _near(rng: np.random.Generator) -> Situation:
    situation = draws.near(rng, tight=bool(rng.random() < 0.5), intent=True)
    return replace(situation, wind=CALM) if rng.random() < 0.5 else situation


def _planned(rng: np.random.Generator) -> Plan | None:
    tight, calm = bool(rng.random() < 0.5), bool(rng.random() < 0.5)
    answer = plan(draws.active(rng, tight=tight, intent=True, calm=calm))
    return answer if isinstance(answer, Plan) else None


def switching_after(situation: Situation, duration: float) -> Situation:
    """The same, with another duration of the leader's first straight [s]."""
    first, *others = situation.leader.intent
    intent = (replace(first, duration=duration), *others)
    return replace(situation, leader=replace(situation.leader, intent=intent))


def _switch_at_contact(rng: np.random.Generator, *, turned: bool) -> Plan | None:
    """A plan whose contact is where the leader's first turn begins, or ends."""
    answer = _planned(rng)
    for _ in range(_ROUNDS):
        if answer is None:
            return None
        situation = answer.situation
        durations = situation.leader.trajectory.durations()
        wanted = answer.certificate.at_time - (durations[1] if turned else 0.0)
        if wanted < 0.0 or abs(wanted - durations[0]) < 1e-9:
            return answer if wanted >= 0.0 else None
        again = plan(switching_after(situation, wanted))
        answer = again if isinstance(again, Plan) else None
    return answer


def contact_at_switch(rng: np.random.Generator) -> Situation | None:
    """The contact is where the leader begins to turn."""
    answer = _switch_at_contact(rng, turned=False)
    return None if answer is None else answer.situation


def contact_at_end_of_turn(rng: np.random.Generator) -> Situation | None:
    """The contact is where the leader ends its first turn."""
    answer = _switch_at_contact(rng, turned=True)
    return None if answer is None else answer.situation


def from_contact(planned: Plan) -> Situation:
    """What is left of a plan when it is nearest to the leader, whose intent goes on from there."""
    situation, t = planned.situation, planned.certificate.at_time
    path = situation.leader.trajectory
    ours, theirs = planned.trajectory.pose_at(t), path.pose_at(t)
    left, passed = [], t
    for piece, duration in zip(situation.leader.intent, path.durations(), strict=True):
        if passed >= duration:
            passed -= duration
            continue
        left.append(
            replace(piece, duration=duration - passed) if isinstance(piece, FlyStraight) else piece
        )
        passed = 0.0
    away = hypot(ours.x - theirs.x, ours.y - theirs.y)
    return replace(
        situation,
        pursuer=replace(situation.pursuer, x=ours.x, y=ours.y, heading=ours.heading % (2.0 * pi)),
        leader=Leader(
            x=theirs.x, y=theirs.y, heading=theirs.heading % (2.0 * pi),
            tas=situation.leader.tas, intent=tuple(left),
        ),
        min_separation=min(situation.min_separation, away),
    )  # fmt: skip


def start_at_contact(rng: np.random.Generator) -> Situation | None:
    """A plan's contact is where it begins."""
    answer = _planned(rng)
    return None if answer is None else from_contact(answer)


def start_at_switch(rng: np.random.Generator) -> Situation | None:
    """The same, and the leader begins to turn there."""
    answer = _switch_at_contact(rng, turned=False)
    return None if answer is None else from_contact(answer)


def release_at_root(rng: np.random.Generator) -> Situation | None:
    """The slot opens as one of the three fastest ways without the limit and the release arrives."""
    situation, wanted = _near(rng), int(rng.integers(0, 3))
    low = situation.min_separation
    high = min(4.0 * low, DISTANCE.high)
    at_low, at_high = (_too_late(situation, distance, wanted) for distance in (low, high))
    if not at_low * at_high < 0.0:
        return None
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if _too_late(situation, middle, wanted) * at_low > 0.0:
            low = middle
        else:
            high = middle
    return replace(situation, slot_distance=low)


def _too_late(situation: Situation, distance: float, wanted: int) -> float:
    """How long after the release a root arrives, if the slot is so far behind [R/V_P]."""
    farther = replace(situation, slot_distance=distance)
    frame = slot_frame(farther, farther.leader.trajectory)
    rows = np.empty((MAX_ROWS, 5))
    count = solve(Pose(frame.x, frame.y, frame.h), frame.alpha, 0.0, rows)
    return float(rows[min(wanted, count - 1), 0]) - frame.t_release


def same_speed(rng: np.random.Generator) -> Situation:
    """V_L = V_P, calm."""
    situation = replace(_near(rng), wind=CALM)
    distance = situation.min_separation * float(rng.choice([1.0, 1.3, 2.0]))
    leader = replace(situation.leader, tas=situation.pursuer.tas)
    return replace(situation, leader=leader, slot_distance=distance)


def same_or_opposite_heading(rng: np.random.Generator) -> Situation:
    """The pursuer heads as the leader does, now or at last, or the opposite way."""
    situation = _near(rng)
    final = situation.leader.trajectory.breakpoints()[-1].heading
    heading = float(rng.choice([situation.leader.heading, final]) + rng.choice([0.0, pi]))
    return replace(situation, pursuer=replace(situation.pursuer, heading=heading % (2.0 * pi)))


def on_track(rng: np.random.Generator) -> Situation:
    """On the slot's track, one time in four just where the slot is, before it opens."""
    situation = _near(rng)
    frame = slot_frame(situation, situation.leader.trajectory)
    along = float(rng.choice([0.0, *rng.uniform(-6.0, 6.0, 3)])) * frame.radius
    x = frame.origin_x + along * sin(frame.heading)
    y = frame.origin_y + along * cos(frame.heading)
    heading = frame.heading + float(rng.choice([0.0, pi, 1.0]))
    away = hypot(x - situation.leader.x, y - situation.leader.y)
    return replace(
        situation,
        pursuer=replace(situation.pursuer, x=x, y=y, heading=heading % (2.0 * pi)),
        min_separation=min(situation.min_separation, away),
    )


def slot_at_limit(rng: np.random.Generator) -> Situation:
    """D = d_min: the last touch is at the arrival."""
    situation = _near(rng)
    return replace(situation, slot_distance=situation.min_separation)


def touch_at_start(rng: np.random.Generator) -> Situation:
    """The first touch is at t = 0; half of the leaders begin to turn then."""
    situation = _near(rng)
    leader, limit = situation.leader, situation.min_separation
    bearing = float(rng.choice([rng.uniform(-pi, pi), 0.0, pi, 0.5 * pi, -0.5 * pi]))
    side = float(rng.choice([1.0, -1.0]))
    turned = contact_heading(bearing, side, leader.tas / situation.pursuer.tas)
    x = leader.x + limit * sin(leader.heading - bearing)
    y = leader.y + limit * cos(leader.heading - bearing)
    heading = (leader.heading - turned) % (2.0 * pi)
    situation = replace(
        situation,
        pursuer=replace(situation.pursuer, x=x, y=y, heading=heading),
        min_separation=min(limit, hypot(x - leader.x, y - leader.y)),
    )
    return switching_after(situation, 0.0) if rng.random() < 0.5 else situation


TURNING: dict[str, Callable[[np.random.Generator], Situation | None]] = {
    "contact at a switch": contact_at_switch,
    "contact at the end of a turn": contact_at_end_of_turn,
    "start at a contact": start_at_contact,
    "start at a contact and a switch": start_at_switch,
    "release at a root": release_at_root,
    "same speed": same_speed,
    "same or opposite heading": same_or_opposite_heading,
    "on the track": on_track,
    "slot at the limit": slot_at_limit,
    "first touch at the start": touch_at_start,
}
"""By name; one that draws `None` is to be drawn again."""
