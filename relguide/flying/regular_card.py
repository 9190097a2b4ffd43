"""regular_check(regular, situation): one of the paper's trajectories against its conditions."""

from relguide.flying.cards import optimality_check, path_point, path_segments, separation_card
from relguide.flying.verdicts import (
    EndErrorCard,
    NotChecked,
    OptimalityCheck,
    PairCard,
    RegularCheck,
    TripletCard,
)
from relguide.planning.certificate import certify
from relguide.planning.optimality import check
from relguide.planning.regular import RegularTrajectory, trajectory_from_regular
from relguide.planning.regular_evaluation import EndError, evaluate
from relguide.planning.situation import Situation
from relguide.units import DEG, Metre, Radian

REACHES: Metre = 100.0
"""A regular trajectory reaches the slot if it ends this near to it [m]: rounding θ to a hundredth
of a degree moves it by some tens of metres."""
REACHES_HEADING: Radian = 0.5 * DEG
"""And if it ends this near to the leader's heading [rad]."""
MOVED = 0.05
"""The two in R and in rad are at most this: R is 2 km or more at any bank that airliners fly."""


def regular_check(regular: RegularTrajectory, situation: Situation) -> RegularCheck:
    """Length, end conditions, separation and stationarity of a regular trajectory.

    Raises:
        ValueError: if the leader's intent turns; the paper's form has no such leader.
    """
    found = evaluate(regular, situation)
    trajectory = trajectory_from_regular(regular, situation)
    certificate = certify(trajectory, situation)
    reaches = _reaches(found.initial) and _reaches(found.final)
    stationarity: OptimalityCheck | NotChecked
    if reaches:
        scale = max(MOVED, REACHES / situation.pursuer.turn_radius)
        stationarity = optimality_check(check(trajectory, situation, arrives=scale))
        stationary = stationarity.stationary
    else:
        stationarity, stationary = NotChecked(not_checked="It does not reach the slot."), False
    times = [found.duration]
    for triplet in regular.triplets:
        length = triplet.length + situation.pursuer.turn_radius * triplet.turn_angle
        times.append(times[-1] - length / situation.pursuer.tas)
    times[-1] = 0.0  # node n is now, not a rounding of it
    return RegularCheck(
        passed=reaches and found.keeps_separation and stationary,
        order=found.order,
        length=found.length,
        duration=found.duration,
        reaches_slot=reaches,
        initial_error=_end_error(found.initial),
        final_error=_end_error(found.final),
        keeps_separation=found.keeps_separation,
        separation=separation_card(certificate),
        stationarity=stationarity,
        triplets=tuple(
            TripletCard(epsilon=t.turn, theta=t.turn_angle, l=t.length) for t in regular.triplets
        ),
        pairs=tuple(
            PairCard(
                turn_least=pair.turn_least,
                turn_proved_above=pair.turn_bound,
                t_star=pair.t_star,
                straight_least=pair.straight_least,
                keeps_separation=pair.holds,
            )
            for pair in found.separations
        ),
        nodes=tuple(
            path_point(node, t, situation.wind) for node, t in zip(found.nodes, times, strict=True)
        ),
        segments=path_segments(trajectory, wind=situation.wind),
    )


def _reaches(error: EndError) -> bool:
    off = max(abs(error.along), abs(error.left))
    return off <= REACHES and abs(error.heading) <= REACHES_HEADING


def _end_error(error: EndError) -> EndErrorCard:
    return EndErrorCard(along=error.along, left=error.left, heading_error=error.heading)
