"""The documents that report what happens in flight, and the figures of its summary."""

from math import cos, hypot, sin
from typing import NamedTuple, assert_never

from relguide.flying.aircraft import AircraftState, ground_velocity
from relguide.flying.aircraft_documents import (
    AircraftSample,
    GuidanceSample,
    HeadingReference,
    LinkResult,
    ReferenceCard,
    TurnRateReference,
)
from relguide.flying.announcements import Event, ModeChange, NewPlan, PlanMissing, Refused
from relguide.flying.autopilot import HoldHeading, Reference, TurnRate
from relguide.flying.cards import no_plan_card, path_point, path_segments, plan_card
from relguide.flying.documents import (
    Document,
    FlightEnded,
    LeaderRoute,
    ModeChanged,
    PlanChanged,
    PlanRefused,
    PlanUnavailable,
    Sample,
)
from relguide.flying.memory import Advice
from relguide.flying.plan_documents import PathPoint
from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.base.turn import turn_rate
from relguide.planning.alternatives import alternatives
from relguide.planning.situation import IntentPiece, Leader, Wind
from relguide.units import DEG, Metre, Radian, Second

FINAL_LEG: Second = 1200.0
"""How much of the leader's endless final leg is shown [s]: as much as a pursuer needs at 100 km."""
BANKED: Radian = 3.0 * DEG  # less is a correction, not a turn


class Names(NamedTuple):
    """Who flies, by ident."""

    pursuer: str
    leader: str


class Tally(NamedTuple):
    """Figures of a flight so far."""

    least_separation: Metre
    heading_swing: Radian
    """Total variation of the pursuer's heading until joined."""
    track: Metre
    """Flown over the ground until joined."""
    banked: int
    """The last side banked to: +1 right, −1 left, 0 before the first."""
    bank_reversals: int
    """From one side to the other, until joined."""


class Milestones(NamedTuple):
    """What guidance has reached so far."""

    planned_time: Second = 0.0
    """Time to converge of the plan at engagement; 0 if there was none [s]."""
    promised: Second = 0.0
    """Time until joined that it promised; 0 if there was none [s]."""
    replans: int = 0
    replans_announced: int = 0
    joined: bool = False
    join_time: Second = 0.0
    """When it first joined, if it has [s]."""
    following_since: Second = 0.0
    """When it last began to follow, if it has [s]."""


def count_event(milestones: Milestones, document: Document) -> Milestones:
    """The milestones after what guidance announced."""
    match document:
        case PlanChanged(t=0.0, reason="engaged", plan=card, promised=promised):
            return milestones._replace(planned_time=card.time_to_converge, promised=promised)
        case PlanChanged(reason="engaged"):
            return milestones
        case PlanChanged(announced=announced):
            return milestones._replace(
                replans=milestones.replans + 1,
                replans_announced=milestones.replans_announced + announced,
            )
        case ModeChanged(t=t, mode="follow"):
            first = milestones.join_time if milestones.joined else t
            return milestones._replace(joined=True, join_time=first, following_since=t)
        case _:
            return milestones


def count_step(
    tally: Tally, before: AircraftState, now: AircraftState, leader: AircraftState, joined: bool
) -> Tally:
    """The figures a step later."""
    separation = hypot(now.x - leader.x, now.y - leader.y)
    least = min(tally.least_separation, separation)
    if joined:
        return tally._replace(least_separation=least)
    turned = abs(wrap_signed(now.heading - before.heading))
    side = tally.banked
    if abs(now.bank) > BANKED:
        side = 1 if now.bank > 0.0 else -1
    return Tally(
        least,
        tally.heading_swing + turned,
        tally.track + hypot(now.x - before.x, now.y - before.y),
        side,
        tally.bank_reversals + (side * tally.banked < 0),
    )


def sample(
    t: Second,
    names: Names,
    pursuer: AircraftState,
    leader: AircraftState,
    advice: Advice,
    since: Second,
    tally: Tally,
    wind: Wind,
) -> Sample:
    """The flight at one instant.

    Args:
        t: flight time [s].
        names: of both.
        pursuer: now.
        leader: now.
        advice: the last that guidance gave.
        since: how long ago it did [s]; the slot has moved since.
        tally: gives the least separation.
        wind: moves both aircraft and the slot.
    """
    east, north = leader.x - pursuer.x, leader.y - pursuer.y
    separation = hypot(east, north)
    own = _aircraft_sample(names.pursuer, pursuer, wind)
    other = _aircraft_sample(names.leader, leader, wind)
    closure = 0.0
    if separation > 0.0:
        relative_east = own.ground_speed * sin(own.track) - other.ground_speed * sin(other.track)
        relative_north = own.ground_speed * cos(own.track) - other.ground_speed * cos(other.track)
        closure = (relative_east * east + relative_north * north) / separation
    slot = advice.slot
    half_turn = 0.5 * slot.turn_rate * since
    slot_east = slot.tas * sin(slot.heading + half_turn) + wind.east
    slot_north = slot.tas * cos(slot.heading + half_turn) + wind.north
    slot_x, slot_y = slot.x + slot_east * since, slot.y + slot_north * since
    slot_speed = hypot(slot_east, slot_north)
    dx, dy = pursuer.x - slot_x, pursuer.y - slot_y
    guidance = GuidanceSample(
        ident=names.pursuer,
        leader=names.leader,
        mode=advice.mode,
        reference=_reference_card(advice.reference),
        commanded_tas=advice.commanded_tas,
        separation=separation,
        closure=closure,
        least_separation=tally.least_separation,
        slot=PathPoint(t=t, x=slot_x, y=slot_y, heading=wrap(slot.heading + 2.0 * half_turn)),
        slot_open=advice.slot_open,
        spacing_error=-(dx * slot_east + dy * slot_north) / slot_speed,
        cross_track=(dx * slot_north - dy * slot_east) / slot_speed,
        time_to_go=max(advice.time_to_go - since, 0.0),
        joined=advice.mode == "follow",
        alert="none",
    )
    return Sample(t=t, aircraft=(own, other), guidance=(guidance,))


def flight_ended(
    t: Second, names: Names, milestones: Milestones, tally: Tally, fallbacks: int
) -> FlightEnded:
    """How the flight went.

    Args:
        t: flight time at its end [s].
        names: of both.
        milestones: what it reached.
        tally: its figures.
        fallbacks: how often the exact plan took the place of a planner's.
    """
    result = LinkResult(
        ident=names.pursuer,
        leader=names.leader,
        joined=milestones.joined,
        join_time=milestones.join_time if milestones.joined else t,
        planned_time=milestones.planned_time,
        promised=milestones.promised,
        least_separation=tally.least_separation,
        heading_swing=tally.heading_swing,
        bank_reversals=tally.bank_reversals,
        replans=milestones.replans,
        replans_announced=milestones.replans_announced,
        fallbacks=fallbacks,
        track=tally.track,
        losses=(),
    )
    return FlightEnded(t=t, results=(result,))


def leader_route(
    t: Second,
    names: Names,
    leader: AircraftState,
    intent: tuple[IntentPiece, ...],
    *,
    intent_known: bool,
    wind: Wind,
) -> LeaderRoute:
    """What the pursuer expects the leader to fly."""
    expected = Leader(x=leader.x, y=leader.y, heading=leader.heading, tas=leader.tas, intent=intent)
    trajectory = expected.trajectory
    return LeaderRoute(
        t=t,
        ident=names.leader,
        expected_by=names.pursuer,
        intent_known=intent_known,
        segments=path_segments(
            trajectory, wind=wind, start_time=t, horizon=trajectory.duration + FINAL_LEG
        ),
    )


def event_document(t: Second, ident: str, event: Event) -> Document:
    """What the guidance of the aircraft `ident` announces, as a document."""
    match event:
        case NewPlan(commitment=commitment):
            plan = commitment.plan
            at, wind = plan.certificate.at_time, plan.situation.wind
            leader = plan.situation.leader.trajectory
            return PlanChanged(
                t=t,
                ident=ident,
                reason=event.reason,
                message=event.message,
                plan=plan_card(plan, alternatives(plan)),
                leader_at_closest=path_point(leader.pose_at(at), at, wind),
                pursuer_at_closest=path_point(plan.trajectory.pose_at(at), at, wind),
                announced=True,
                promised=plan.time_to_converge,
                tube=0.0,
                flown_least=plan.certificate.least_separation,
            )
        case PlanMissing(answer=answer):
            return PlanUnavailable(t=t, ident=ident, answer=no_plan_card(answer))
        case Refused(refusal=refusal):
            return PlanRefused(
                t=t,
                ident=ident,
                planner=refusal.planner,
                fault=refusal.fault,
                message=refusal.message,
            )
        case ModeChange():
            return ModeChanged(
                t=t,
                ident=ident,
                mode=event.mode,
                previous=event.previous,
                message=event.message,
            )
        case _:
            assert_never(event)


def _aircraft_sample(ident: str, state: AircraftState, wind: Wind) -> AircraftSample:
    velocity = ground_velocity(state, wind.east, wind.north)
    return AircraftSample(
        ident=ident,
        x=state.x,
        y=state.y,
        heading=state.heading,
        track=velocity.track,
        bank=state.bank,
        turn_rate=turn_rate(state.tas, state.bank),
        tas=state.tas,
        ground_speed=velocity.speed,
        altitude=state.altitude,
    )


def _reference_card(reference: Reference) -> ReferenceCard:
    match reference:
        case HoldHeading(heading=heading):
            return HeadingReference(heading=heading)
        case TurnRate(turn_rate=rate):
            return TurnRateReference(turn_rate=rate)
        case _:
            assert_never(reference)
