"""The situation of a flight at its newest sample, read from its documents."""

from collections.abc import Sequence

from relguide.flying.aircraft_documents import AircraftSample, LinkCard, find_by_ident
from relguide.flying.documents import FlightStarted, LeaderRoute, Sample
from relguide.flying.plan_documents import StraightSegment, TurnSegment
from relguide.kernels.base.angles import wrap
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.intent import FlyStraight, IntentPiece, TurnTo
from relguide.planning.situation import Situation
from relguide.planning.trajectory import LEFT, RIGHT
from relguide.planning.wind import wind_from
from relguide.units import DEG, Radian, Second

LATE: Second = 10.0
"""A turn may end this much later than its exact arc: rolling in and out takes time."""
OVER: Radian = 5.0 * DEG
"""A turn with less than this still to turn is over: the last degrees are the roll-out."""


def situation_now(
    started: FlightStarted, link: LinkCard, routes: Sequence[LeaderRoute], now: Sample
) -> Situation:
    """The situation that a pursuer plans for at this instant, by what it expects of its leader.

    Args:
        started: gives the wind and the bank of the plans.
        link: who joins whom, with D and d_min.
        routes: the last one of this link counts; if there is none, the leader keeps straight.
        now: gives both aircraft, at their present airspeeds.

    Raises:
        ValueError: if no plan can be made at such an instant, e.g. outside accepted speeds.
    """
    pursuer, leader = (
        find_by_ident(now.aircraft, link.pursuer),
        find_by_ident(now.aircraft, link.leader),
    )
    expected = [r for r in routes if (r.expected_by, r.ident) == (link.pursuer, link.leader)]
    return Situation(
        pursuer=Pursuer(
            x=pursuer.x,
            y=pursuer.y,
            heading=pursuer.heading,
            tas=pursuer.tas,
            max_bank=find_by_ident(started.aircraft, link.pursuer).max_bank,
        ),
        leader=Leader(
            x=leader.x,
            y=leader.y,
            heading=leader.heading,
            tas=leader.tas,
            intent=_remaining_intent(expected[-1], leader, now.t) if expected else (),
        ),
        slot_distance=link.slot_distance,
        min_separation=link.min_separation,
        wind=wind_from(started.wind.from_, started.wind.speed),
    )


def _remaining_intent(
    route: LeaderRoute, leader: AircraftSample, t: Second
) -> tuple[IntentPiece, ...]:
    """The part of a route still to be flown, without its last straight, which has no end."""
    pieces: list[IntentPiece] = []
    for segment in route.segments:
        match segment:
            case StraightSegment() if segment.end.t > t:
                left = segment.end.t - max(segment.start.t, t)
                pieces.append(FlyStraight(duration=left))
            case TurnSegment() if segment.end.t + LATE > t:
                turn = LEFT if segment.direction == "left" else RIGHT
                to_go = wrap(-turn * (segment.end.heading - leader.heading))
                if segment.start.t >= t or OVER < to_go <= segment.angle + OVER:
                    pieces.append(TurnTo(heading=segment.end.heading, turn=turn, bank=segment.bank))
    while pieces and isinstance(pieces[-1], FlyStraight):
        pieces.pop()
    return tuple(pieces)
