"""The documents that report what happens in flight."""

from collections.abc import Sequence
from math import cos, hypot, inf, sin
from typing import NamedTuple, assert_never

import numpy as np

from relguide.flying.aircraft import AircraftState, ground_velocity
from relguide.flying.aircraft_documents import (
    AircraftSample,
    Bars,
    CellCard,
    GuidanceSample,
    HeadingReference,
    ReferenceCard,
    TurnRateReference,
    find_by_ident,
)
from relguide.flying.cards import (
    no_plan_card,
    other_path_cards,
    path_point,
    path_segments,
    plan_card,
)
from relguide.flying.documents import (
    Alert,
    Document,
    EngagementChanged,
    FanChanged,
    FanJoin,
    ForecastChanged,
    LeaderRoute,
    ModeChanged,
    PlanChanged,
    PlanProposed,
    PlanRefused,
    PlanUnavailable,
    PromiseChanged,
    Sample,
    Unable,
)
from relguide.flying.guidance.announcements import (
    Alerted,
    EngagementChange,
    Event,
    ModeChange,
    NewPlan,
    NewPromise,
    PlanMissing,
    PlannerRefused,
    ProposedPlan,
    UnableTo,
)
from relguide.flying.guidance.fan import Fan
from relguide.flying.guidance.forecast import Forecast, rows_to_draw
from relguide.flying.guidance.memory import Advice
from relguide.flying.perception import CERTAIN, SURE, Spread
from relguide.flying.plan_documents import PathAhead, PathPoint
from relguide.kernels.base.angles import wrap
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight.flight_records import HOLD_HEADING, Control
from relguide.planning.aircraft import Leader
from relguide.planning.alternatives import alternatives
from relguide.planning.cells import Cell, Disc, Polygon
from relguide.planning.heights import VERTICAL_MINIMUM, WHOLE_METRE
from relguide.planning.outcome import Plan
from relguide.planning.wind import Wind
from relguide.units import Metre, MetrePerSecond, Second

FINAL_LEG: Second = 1200.0
"""How much of the leader's endless final leg is shown [s]: as much as a pursuer needs at 100 km."""
KEPT = VERTICAL_MINIMUM - WHOLE_METRE
"""So far apart in height, the distance does not count [m]."""
GHOSTS = 3
"""So many other paths are drawn beside a proposal."""


class PairNames(NamedTuple):
    """Who flies, by ident."""

    pursuer: str
    leader: str


class LinkState(NamedTuple):
    """How a link stands."""

    names: PairNames
    advice: Advice
    """The last one that guidance gave."""
    least: Metre
    """Least separation so far."""
    autopilot: bool = True
    director: bool = False
    bars: tuple[Bars, ...] = ()
    least_tas: MetrePerSecond = 0.0
    """The slowest that the pursuer can fly at its level."""


def sample(
    t: Second,
    aircraft: Sequence[tuple[str, AircraftState, Wind]],
    links: Sequence[LinkState],
    since: Second,
) -> Sample:
    """The flight at one instant.

    Args:
        t: flight time [s].
        aircraft: ident and state of each, and the wind that moves it.
        links: how each stands.
        since: how long ago guidance gave its advice [s]; the slots have moved since.
    """
    samples = tuple(_aircraft_sample(ident, state, wind) for ident, state, wind in aircraft)
    return Sample(
        t=t,
        aircraft=samples,
        guidance=tuple(_guidance_sample(t, samples, link, since) for link in links),
    )


def _guidance_sample(
    t: Second,
    samples: tuple[AircraftSample, ...],
    link: LinkState,
    since: Second,
) -> GuidanceSample:
    names, advice = link.names, link.advice
    own, other = find_by_ident(samples, names.pursuer), find_by_ident(samples, names.leader)
    east, north = other.x - own.x, other.y - own.y
    separation = hypot(east, north)
    closure = 0.0
    if separation > 0.0:
        relative_east = own.ground_speed * sin(own.track) - other.ground_speed * sin(other.track)
        relative_north = own.ground_speed * cos(own.track) - other.ground_speed * cos(other.track)
        closure = (relative_east * east + relative_north * north) / separation
    slot = advice.slot
    half_turn = 0.5 * slot.turn_rate * since
    wind = advice.wind
    slot_east = slot.tas * sin(slot.heading + half_turn) + wind.east
    slot_north = slot.tas * cos(slot.heading + half_turn) + wind.north
    slot_x, slot_y = slot.x + slot_east * since, slot.y + slot_north * since
    slot_speed = hypot(slot_east, slot_north)
    dx, dy = own.x - slot_x, own.y - slot_y
    by_height = abs(other.altitude - own.altitude) >= KEPT
    return GuidanceSample(
        ident=names.pursuer,
        leader=names.leader,
        mode=advice.mode,
        reference=_reference_card(advice.control),
        commanded_tas=advice.control.tas,
        separation=separation,
        closure=closure,
        least_separation=link.least if by_height else min(link.least, separation),
        slot=PathPoint(t=t, x=slot_x, y=slot_y, heading=wrap(slot.heading + 2.0 * half_turn)),
        slot_open=advice.slot_open,
        spacing_error=-(dx * slot_east + dy * slot_north) / slot_speed,
        cross_track=(dx * slot_north - dy * slot_east) / slot_speed,
        time_to_go=max(advice.time_to_go - since, 0.0),
        joined=advice.joined,
        alert=advice.alert,
        leader_age=advice.leader_age + since if advice.leader_age > 0.0 else 0.0,
        margin=advice.margin,
        engagement=advice.engagement,
        autopilot=link.autopilot,
        director=link.director,
        least_tas=link.least_tas,
        bars=link.bars,
    )


def cell_card(cell: Cell) -> CellCard:
    """A weather cell as it is at the start."""
    match cell.shape:
        case Disc(x=x, y=y, radius=radius):
            corners: tuple[tuple[Metre, Metre], ...] = ((x, y),)
        case Polygon(corners=corners, radius=radius):
            pass
        case _:
            assert_never(cell.shape)
    return CellCard(
        ident=cell.ident,
        x=tuple(x for x, _ in corners),
        y=tuple(y for _, y in corners),
        radius=radius,
        east=cell.east,
        north=cell.north,
        growth=cell.growth,
    )


def leader_route(
    t: Second, names: PairNames, expected: Leader, *, intent_known: bool, wind: Wind
) -> LeaderRoute:
    """What the pursuer expects the leader to fly."""
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


def event_document(t: Second, names: PairNames, event: Event) -> Document:
    """What the guidance of a pursuer announces, as a document."""
    ident = names.pursuer
    match event:
        case NewPlan(shown=plan, committed=committed):
            ahead, (leader_at, own_at) = committed.forecast, _closest_points(plan)
            least = ahead.nearest(t)
            others = alternatives(committed.plan) if event.announced else ()
            return PlanChanged(
                t=t,
                ident=ident,
                reason=event.reason,
                message=event.message,
                plan=plan_card(plan, others, later=committed.begins - t),
                leader_at_closest=leader_at,
                pursuer_at_closest=own_at,
                announced=event.announced,
                promised=committed.joins_at(ahead) - t,
                tube=ahead.tube,
                flown_least=least,
            )
        case ProposedPlan(shown=plan, committed=committed):
            ahead, (leader_at, own_at) = committed.forecast, _closest_points(plan)
            least = ahead.nearest(t)
            others, later = alternatives(committed.plan), committed.begins - t
            wind = plan.situation.wind
            return PlanProposed(
                t=t,
                ident=ident,
                message=event.message,
                plan=plan_card(plan, others, later=later),
                leader_at_closest=leader_at,
                pursuer_at_closest=own_at,
                promised=committed.joins_at(ahead) - t,
                flown_least=least,
                others=other_path_cards(others, wind, later=later, most=GHOSTS),
                ahead=(_path_ahead(t, ahead),),
            )
        case EngagementChange():
            return EngagementChanged(
                t=t,
                ident=ident,
                engagement=event.engagement,
                previous=event.previous,
                message=event.message,
            )
        case PlanMissing(answer=answer):
            return PlanUnavailable(t=t, ident=ident, answer=no_plan_card(answer))
        case PlannerRefused(refusal=refusal):
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
        case NewPromise(joins=joins, was=was):
            return PromiseChanged(
                t=t, ident=ident, promised=joins - t, was=was - t, message=event.message
            )
        case Alerted():
            return Alert(
                t=t,
                ident=ident,
                other=event.ident or names.leader,
                level=event.level,
                subject=event.subject,
                message=event.message,
                predicted_least=event.predicted_least,
                predicted_at=event.predicted_at,
                cleared=event.cleared,
            )
        case UnableTo():
            return Unable(t=t, ident=ident, reason=event.reason, message=event.message)
        case _:
            assert_never(event)


def _closest_points(plan: Plan) -> tuple[PathPoint, PathPoint]:
    """Where leader and pursuer are when a plan brings them closest."""
    at, wind = plan.certificate.at_time, plan.situation.wind
    both = plan.situation.leader.trajectory, plan.trajectory
    leader, own = (path_point(path.pose_at(at), at, wind) for path in both)
    return leader, own


def forecast_document(
    t: Second, ident: str, ahead: Forecast, spread: Spread = CERTAIN
) -> ForecastChanged:
    """The path that will be flown: its turns point by point, its straights by their ends.

    Args:
        t: flight time [s].
        ident: of the aircraft.
        ahead: the flight ahead.
        spread: how uncertain is what it begins with.
    """
    drawn = _path_ahead(t, ahead)
    since = np.array(drawn.times) - t
    least, at = ahead.least(t)
    own, leader = _point_at(ahead.own, ahead.t, at), _point_at(ahead.leader, ahead.t, at)
    return ForecastChanged(
        t=t,
        ident=ident,
        times=drawn.times,
        x=drawn.x,
        y=drawn.y,
        heading=drawn.heading,
        least_separation=least if least < inf else hypot(own.x - leader.x, own.y - leader.y),
        pursuer_at_closest=own,
        leader_at_closest=leader,
        aside=() if spread == CERTAIN else tuple(_aside(since, ahead.join_time - t, spread)),
    )


def _path_ahead(t: Second, ahead: Forecast) -> PathAhead:
    """A flight ahead from flight time t on: turns point by point, straights by their ends."""
    rows = ahead.own[max(round(t - ahead.t), 0) :]
    kept = rows_to_draw(rows)
    times, points = t + np.array(kept, dtype=float), rows[kept]
    return PathAhead(
        times=tuple(times.tolist()),
        x=tuple(points[:, 0].tolist()),
        y=tuple(points[:, 1].tolist()),
        heading=tuple(wrap(heading) for heading in points[:, 2].tolist()),
    )


def _aside(ahead: FloatArray, joins_in: Second, spread: Spread) -> list[float]:
    """How far beside its path an aircraft may come after some times [m].

    A wind that is otherwise carries it off all the while. A leader that is elsewhere, or flies
    otherwise, moves the end of the path, and with it the rest in proportion to how far on it is.
    """
    carried = spread.wind * ahead
    share = np.clip(ahead / max(joins_in, 1.0), 0.0, 1.0)
    moved = share * np.hypot(spread.place, spread.velocity * ahead)
    found: list[float] = (SURE * np.hypot(carried, moved)).tolist()
    return found


def fan_document(t: Second, names: PairNames, fan: Fan) -> FanChanged:
    """Where a pursuer would join after turns that its leader has not announced."""
    return FanChanged(
        t=t,
        ident=names.pursuer,
        joins=tuple(
            FanJoin(turn=join.turn, joins=join.joins, x=join.x, y=join.y, least=join.least)
            for join in fan.joins
        ),
        most_saved=fan.most_saved,
        mean_saved=fan.mean_saved,
    )


def _point_at(rows: FloatArray, begun: Second, t: Second) -> PathPoint:
    """Where a forecast that begins at `begun` has an aircraft at flight time t [s]."""
    k = min(int(t - begun), len(rows) - 2)
    x, y, heading = (rows[k] + (t - begun - k) * (rows[k + 1] - rows[k]))[:3].tolist()
    return PathPoint(t=t, x=x, y=y, heading=wrap(heading))


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


def _reference_card(control: Control) -> ReferenceCard:
    if control.kind == HOLD_HEADING:
        return HeadingReference(heading=wrap(control.value))
    return TurnRateReference(turn_rate=control.value)
