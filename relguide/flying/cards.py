"""Plans and trajectories as outsiders read them: over the ground, piece by piece.

What a plan alone has nothing of is imported where it is shown: the start of a command is short.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from math import atan2, ceil, pi
from typing import TYPE_CHECKING, assert_never

import numpy as np

from relguide.flying.plan_documents import (
    AlternativeCard,
    AnyAlternativeCard,
    ArrivalCard,
    BoundarySegment,
    ConflictCard,
    Direction,
    EarlyAlternativeCard,
    LevelChangeCard,
    LevelRemedy,
    MissingAlternativeCard,
    NoPlanCard,
    OptimalityCard,
    OtherPathCard,
    OtherSeparationCard,
    PathPoint,
    PathSegment,
    PlanCard,
    RemedyCard,
    Separation,
    SlotDistanceRemedy,
    StraightSegment,
    TurnSegment,
    UnsafeAlternativeCard,
    VerticalCard,
)
from relguide.kernels.base.angles import wrap
from relguide.kernels.base.turn import bank_for_turn_radius
from relguide.planning.arrival import Arrival
from relguide.planning.certificate import Certificate
from relguide.planning.heights import KeptByHeight
from relguide.planning.outcome import Conflict, NoPlan, Plan, Remedy
from relguide.planning.trajectory import (
    LEFT,
    Arc,
    BoundaryArc,
    Pose,
    Straight,
    Trajectory,
    heading_change,
)
from relguide.planning.wind import Wind
from relguide.units import Second

if TYPE_CHECKING:
    from relguide.flying.aircraft_documents import WindCard
    from relguide.flying.verdicts import OptimalityCheck
    from relguide.planning.alternatives import AnyAlternative
    from relguide.planning.optimality import OptimalityReport

VIA: Second = 5.0
"""Time between the points that draw a boundary arc [s]: their chords stray from it by metres."""


def plan_card(
    plan: Plan, others: "Sequence[AnyAlternative]" = (), *, later: Second = 0.0
) -> PlanCard:
    """A plan with its segments over the ground.

    Args:
        plan: what is shown.
        others: its `alternatives`, if they are to be shown too.
        later: added to their times, where they begin after a lead-in that the plan includes [s].
    """
    certificate, optimality = plan.certificate, plan.optimality
    return PlanCard(
        planner=plan.planner,
        word=plan.word,
        time_to_converge=plan.time_to_converge,
        length=plan.trajectory.length,
        segments=path_segments(plan.trajectory, wind=plan.situation.wind),
        levels=tuple(
            LevelChangeCard(at=change.at, to_altitude=change.to_altitude, rate=change.rate)
            for change in plan.levels
        ),
        separation=separation_card(certificate),
        arrival=arrival_card(plan.arrival),
        optimality=OptimalityCard(proof=optimality.proof, lower_bound=optimality.lower_bound),
        alternatives=tuple(_alternative_card(other, later) for other in others),
        compute=plan.compute_time,
    )


def other_path_cards(
    others: "Iterable[AnyAlternative]", wind: Wind, *, later: Second, most: int
) -> tuple[OtherPathCard, ...]:
    """The fastest of the other paths, over the ground.

    Args:
        others: the `alternatives` of a plan.
        wind: moves them.
        later: when they begin, after a lead-in [s].
        most: how many at most.
    """
    from relguide.planning.alternatives import Alternative

    paths = [other for other in others if isinstance(other, Alternative)]
    return tuple(
        OtherPathCard(
            word=path.word,
            time_to_converge=path.time_to_converge + later,
            segments=path_segments(path.candidate.trajectory, wind=wind, start_time=later),
            why=path.why,
        )
        for path in paths[:most]
    )


def arrival_card(arrival: Arrival) -> ArrivalCard:
    """How a trajectory's end meets eq. (7)."""
    return ArrivalCard(
        slot_error=arrival.slot_error, heading_error=arrival.heading_error, early=arrival.early
    )


def separation_card(certificate: Certificate) -> Separation:
    """The least separation of a trajectory, and what is proved of it."""
    return Separation(
        least=certificate.least_separation,
        at=certificate.at_time,
        proved_above=certificate.lower_bound,
        vertical=_vertical_cards(certificate.vertical),
        others=tuple(
            OtherSeparationCard(
                ident=other.ident,
                least=other.least_separation,
                at=other.at_time,
                proved_above=other.lower_bound,
                min_separation=other.min_separation,
                vertical=_vertical_cards(other.vertical),
            )
            for other in certificate.others
        ),
    )


def _vertical_cards(kept: Iterable[KeptByHeight]) -> tuple[VerticalCard, ...]:
    return tuple(
        VerticalCard(from_=part.from_time, to=part.to_time, least=part.least_height)
        for part in kept
    )


def optimality_check(report: "OptimalityReport") -> "OptimalityCheck":
    """What Pontryagin's conditions say of a plan."""
    from relguide.flying.verdicts import (
        BoundaryArcCard,
        ContactCard,
        CostatesCard,
        OptimalityCheck,
    )

    along = report.history
    return OptimalityCheck(
        arrival=report.arrival,
        hamiltonian_residual=report.hamiltonian_residual,
        switching_residual=report.switching_residual,
        stationary=report.holds,
        contacts=tuple(
            ContactCard(
                t=contact.time, bearing=contact.bearing, jump=contact.jump, ident=contact.ident
            )
            for contact in report.contacts
        ),
        boundary_arcs=tuple(
            BoundaryArcCard(
                start=boundary_arc.start,
                end=boundary_arc.end,
                least_multiplier=boundary_arc.least_multiplier,
            )
            for boundary_arc in report.boundary_arcs
        ),
        costates=CostatesCard(
            t=along.times,
            hamiltonian=along.hamiltonian,
            switching=along.switching,
            separation_costate=along.separation,
            bearing_costate=along.bearing,
        ),
    )


def no_plan_card(answer: NoPlan) -> NoPlanCard:
    """Why there is no plan."""
    return NoPlanCard(
        reason=answer.reason,
        message=answer.message,
        lower_bound=answer.lower_bound,
        conflict=None if answer.conflict is None else _conflict_card(answer.conflict),
        remedies=tuple(map(_remedy_card, answer.remedies)),
    )


def _conflict_card(conflict: Conflict) -> ConflictCard:
    return ConflictCard(
        ident=conflict.ident,
        at=conflict.at_time,
        least=conflict.least_separation,
        min_separation=conflict.min_separation,
    )


def _remedy_card(remedy: Remedy) -> RemedyCard:
    time, message = remedy.time_to_converge, remedy.message
    match remedy.kind:
        case "slot_distance":
            return SlotDistanceRemedy(
                slot_distance=remedy.value, time_to_converge=time, message=message
            )
        case "level":
            return LevelRemedy(altitude=remedy.value, time_to_converge=time, message=message)
        case _:
            assert_never(remedy.kind)


def path_point(pose: Pose, t: float, wind: Wind, start_time: float = 0.0) -> PathPoint:
    """A pose of the air mass, over the ground.

    Args:
        pose: in the air mass, which is the world frame at t = 0.
        t: when [s].
        wind: moves the air mass over the ground.
        start_time: added to t for the reader [s].
    """
    x, y = pose.x + wind.east * t, pose.y + wind.north * t
    return PathPoint(t=start_time + t, x=x, y=y, heading=pose.heading)


def path_segments(
    trajectory: Trajectory, *, wind: Wind, start_time: float = 0.0, horizon: float | None = None
) -> tuple[PathSegment, ...]:
    """A trajectory's segments with their ends over the ground.

    Args:
        trajectory: in the air mass, which is the world frame at the trajectory's own t = 0.
        wind: moves the air mass over the ground.
        start_time: added to every t [s].
        horizon: if given, the endless straight that follows is appended, to end at this time [s]
            after the start (nothing is appended if the trajectory is longer).
    """
    flown = trajectory
    if horizon is not None and horizon > trajectory.duration:
        rest = Straight(length=(horizon - trajectory.duration) * trajectory.tas)
        flown = replace(trajectory, segments=(*trajectory.segments, rest))
    segments: list[PathSegment] = []
    first, *others = flown.breakpoints()
    start, t = path_point(first, 0.0, wind, start_time), 0.0
    for piece, pose in zip(flown.segments, others, strict=True):
        duration = piece.length / flown.tas
        end = path_point(pose, t + duration, wind, start_time)
        match piece:
            case Arc():
                segments.append(
                    TurnSegment(
                        direction="left" if piece.turn == LEFT else "right",
                        angle=piece.turn_angle,
                        bank=bank_for_turn_radius(flown.tas, piece.radius),
                        radius=piece.radius,
                        duration=duration,
                        start=start,
                        end=end,
                    )
                )
            case Straight():
                segments.append(
                    StraightSegment(length=piece.length, duration=duration, start=start, end=end)
                )
            case BoundaryArc():
                segments.append(
                    BoundarySegment(
                        side="left" if piece.side == LEFT else "right",
                        duration=duration,
                        start=start,
                        end=end,
                        via=_points_between(flown, t, duration, wind, start_time),
                    )
                )
            case _:
                assert_never(piece)
        start, t = end, t + duration
    return tuple(segments)


def _points_between(
    flown: Trajectory, begin: Second, duration: Second, wind: Wind, start_time: Second
) -> tuple[PathPoint, ...]:
    """Points of a segment between its ends, over the ground: at once, there may be thousands."""
    count = ceil(duration / VIA)
    times = [begin + duration * k / count for k in range(1, count)]
    found = flown.over_ground(wind, np.array(times))
    columns = zip(times, found.x.tolist(), found.y.tolist(), found.heading.tolist(), strict=True)
    return tuple(PathPoint(t=start_time + t, x=x, y=y, heading=h) for t, x, y, h in columns)


def wind_card(wind: Wind) -> "WindCard":
    """A wind as reports give it: where it comes from, and how strong."""
    from relguide.flying.aircraft_documents import WindCard

    direction = wrap(atan2(wind.east, wind.north) + pi) if wind.speed > 0.0 else 0.0
    return WindCard(from_=direction, speed=wind.speed)


def _alternative_card(other: "AnyAlternative", later: Second) -> AnyAlternativeCard:
    from relguide.planning.alternatives import (
        Alternative,
        AsFast,
        Faster,
        LosesSeparation,
        NoRoot,
        Slower,
        TooEarly,
    )

    match other:
        case NoRoot(word=word, why=why):
            return MissingAlternativeCard(word=word, why=why)
        case TooEarly(word=word, time_to_converge=time, release_time=release_time, why=why):
            return EarlyAlternativeCard(
                word=word,
                time_to_converge=time + later,
                release_time=release_time + later,
                why=why,
            )
        case Alternative(candidate=candidate, passing=passing):
            turning = sum(abs(heading_change(s)) for s in candidate.trajectory.segments)
            side: Direction = "left" if passing.side == LEFT else "right"
        case _:
            assert_never(other)
    match other.rejected:
        case LosesSeparation(least_separation=least, at_time=at, ident=ident):
            return UnsafeAlternativeCard(
                word=candidate.word,
                time_to_converge=candidate.time_to_converge + later,
                turning=turning,
                passes=passing.where,
                side=side,
                least_separation=least,
                at=at + later,
                ident=ident,
                why=other.why,
            )
        case Slower() | AsFast() | Faster():
            return AlternativeCard(
                word=candidate.word,
                time_to_converge=candidate.time_to_converge + later,
                turning=turning,
                passes=passing.where,
                side=side,
                why=other.why,
                rejected=other.rejected.kind,
            )
        case _:
            assert_never(other.rejected)
