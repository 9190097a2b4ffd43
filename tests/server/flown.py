"""A short flight without a closed loop: both aircraft on their exact trajectories."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from math import hypot

from relguide.flying.aircraft_documents import (
    AircraftSample,
    GuidanceSample,
    HeadingReference,
    LinkResult,
)
from relguide.flying.cards import path_point
from relguide.flying.documents import (
    Document,
    FlightEnded,
    LeaderChanged,
    ModeChanged,
    Sample,
)
from relguide.flying.plan_documents import PathPoint
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.intent import FlyStraight, TurnTo
from relguide.planning.outcome import Plan
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.planning.trajectory import RIGHT, Trajectory
from relguide.planning.wind import Wind, wind_from
from relguide.units import DEG, FT
from tests.openings import opening_of

SITUATION = Situation(
    pursuer=Pursuer(x=-40_000.0, y=40_000.0, heading=90 * DEG, tas=240.0, max_bank=25 * DEG),
    leader=Leader(
        x=0.0,
        y=0.0,
        heading=90 * DEG,
        tas=200.0,
        intent=(
            FlyStraight(duration=100.0),
            TurnTo(heading=135 * DEG, turn=RIGHT, bank=20 * DEG),
        ),
    ),
    slot_distance=10_000.0,
    min_separation=9_260.0,
    wind=wind_from(270 * DEG, 15.0),
)


OWN, LEADER = "RG 06", "LDR 01"


def ideal_flight(
    commands: Callable[[float], Iterable[object]] = lambda t: (),
    *,
    situation: Situation = SITUATION,
    duration: float = 30.0,
    step: float = 0.05,
) -> Iterator[Document]:
    """Documents of a flight that follows its first plan exactly; a command is only reported."""
    answer = plan(situation)
    assert isinstance(answer, Plan)
    opening = opening_of(
        answer,
        own=OWN,
        leader=LEADER,
        name="ideal",
        title="Two aircraft on their exact trajectories",
        shown_for=900.0,
    )
    yield replace(opening.started, step=step)
    yield opening.route
    yield opening.plan
    wind, route = situation.wind, situation.leader.trajectory
    yield ModeChanged(t=0.0, ident=OWN, mode="converge", previous="heading", message="Converging.")
    for k in range(round(duration / step) + 1):
        t = k * step
        for command in commands(t):
            yield LeaderChanged(t=t, ident=LEADER, change="heading", message=f"Told {command!r}.")
        yield _sample(t, answer, route, wind)
    result = LinkResult(
        ident=OWN,
        leader=LEADER,
        joined=False,
        join_time=duration,
        planned_time=answer.time_to_converge,
        promised=answer.time_to_converge,
        least_separation=40_000.0,
        heading_swing=0.0,
        bank_reversals=0,
        replans=1,
        replans_announced=1,
        fallbacks=0,
        track=240.0 * duration,
        losses=(),
    )
    yield FlightEnded(t=duration, reason="joined", message="Joined.", results=(result,))


def _sample(t: float, answer: Plan, route: Trajectory, wind: Wind) -> Sample:
    pursuer = _aircraft(OWN, answer.trajectory, t, wind)
    leader = _aircraft(LEADER, route, t, wind)
    separation = hypot(pursuer.x - leader.x, pursuer.y - leader.y)
    slot = route.pose_at(max(t - answer.situation.slot_distance / route.tas, 0.0))
    ground = path_point(slot, t, wind)
    guidance = GuidanceSample(
        ident=OWN,
        leader=LEADER,
        mode="converge",
        reference=HeadingReference(heading=pursuer.heading),
        commanded_tas=pursuer.tas,
        separation=separation,
        closure=0.0,
        least_separation=separation,
        slot=PathPoint(t=t, x=ground.x, y=ground.y, heading=ground.heading),
        slot_open=t > 200.0,
        spacing_error=separation - answer.situation.slot_distance,
        cross_track=0.0,
        time_to_go=max(answer.time_to_converge - t, 0.0),
        joined=t > answer.time_to_converge,
        alert="none",
    )
    return Sample(t=t, aircraft=(pursuer, leader), guidance=(guidance,))


def _aircraft(ident: str, trajectory: Trajectory, t: float, wind: Wind) -> AircraftSample:
    pose, after = trajectory.pose_at(t), trajectory.pose_at(t + 0.1)
    here, there = path_point(pose, t, wind), path_point(after, t + 0.1, wind)
    turning = pose.heading != after.heading
    return AircraftSample(
        ident=ident,
        x=here.x,
        y=here.y,
        heading=pose.heading,
        track=pose.heading,
        bank=(
            25 * DEG if turning and after.heading > pose.heading else -25 * DEG if turning else 0
        ),
        turn_rate=0.0,
        tas=trajectory.tas,
        ground_speed=hypot(there.x - here.x, there.y - here.y) / 0.1,
        altitude=33_000 * FT,
    )
