"""What a flight says of itself, as the controller needs it: manoeuvres, and aircraft that intend.

A flight has its own world and its own clock. `Placing` says how both lie in a sky.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import cos, inf, sin

import numpy as np
from numpy.typing import ArrayLike

from relguide.atc.picture import Seen
from relguide.atc.request import Manoeuvre
from relguide.atc.settings import AtcSettings
from relguide.atc.track import Track
from relguide.atc.tracks import followed_track, points_track
from relguide.flying.aircraft_documents import (
    AircraftSample,
    GuidanceSample,
    LinkCard,
    find_by_ident,
)
from relguide.flying.documents import (
    AssignmentChanged,
    FlightStarted,
    ForecastChanged,
    LeaderRoute,
    PlanChanged,
    PlanProposed,
    Sample,
)
from relguide.flying.plan_documents import (
    BoundarySegment,
    PathAhead,
    PathPoint,
    PathSegment,
    PlanCard,
    StraightSegment,
    TurnSegment,
)
from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.base.roots import FloatArray
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.frames import LocalPlane
from relguide.planning.intent import FlyStraight, IntentPiece, TurnTo
from relguide.planning.situation import Situation
from relguide.planning.trajectory import LEFT, RIGHT
from relguide.planning.wind import Wind, wind_from
from relguide.units import DEG, Metre, MetrePerSecond, Radian, Second

WAITS: Second = 30.0
"""Who is promised to join later than this behind the ideal plan waits for its level only [s]."""
ARC: Radian = 3.0 * DEG
"""Points along a turn are no farther apart in heading, as those of a forecast."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Placing:
    """How the world and the clock of a flight lie in a sky."""

    later: Second = 0.0
    """Time of the sky at flight time 0 [s]."""
    of: LocalPlane | None = None
    """The flight's plane; `None` where nobody has said where on the earth it is."""
    to: LocalPlane | None = None
    """The sky's."""

    def columns(
        self, x: ArrayLike, y: ArrayLike, heading: ArrayLike
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Places [m] and directions [rad] of the flight's world, in the sky."""
        east, north, noses = (np.asarray(column, dtype=float) for column in (x, y, heading))
        if self.of is None or self.to is None or self.of == self.to:
            return east, north, noses
        lat, lon = self.of.to_geodetic_each(east, north)
        turned = self.to.meridian_each(lat, lon) - self.of.meridian_each(lat, lon)
        east, north = self.to.to_local_each(lat, lon)
        return east, north, noses + turned

    def wind(self, wind: Wind) -> Wind:
        """The wind in the sky, at the middle of the flight's world."""
        if self.of is None or self.to is None or self.of == self.to:
            return wind
        turned = self.to.meridian(self.of.lat_deg, self.of.lon_deg)
        return Wind(
            east=wind.east * cos(turned) + wind.north * sin(turned),
            north=wind.north * cos(turned) - wind.east * sin(turned),
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkNews:
    """What a flight has said last of one pursuer behind its leader."""

    started: FlightStarted
    sample: Sample
    link: LinkCard
    route: LeaderRoute | None
    """What the pursuer expects its leader to fly."""
    plan: PlanChanged | None
    """The one that is flown."""
    proposal: PlanProposed | None
    forecast: ForecastChanged | None
    assignment: AssignmentChanged | None
    climbing: frozenset[str] = frozenset()
    """Who changes its level now: nobody knows how far."""

    @property
    def guidance(self) -> GuidanceSample:
        """What its guidance does now."""
        return find_by_ident(self.sample.guidance, self.link.pursuer)

    @property
    def pursuer(self) -> AircraftSample:
        """Where it is now."""
        return find_by_ident(self.sample.aircraft, self.link.pursuer)

    @property
    def leader(self) -> AircraftSample:
        """Where its leader is now."""
        return find_by_ident(self.sample.aircraft, self.link.leader)

    @property
    def engaged(self) -> bool:
        """Whether guidance flies it."""
        return self.guidance.engagement == "engaged"


def manoeuvre_of(
    news: LinkNews, placing: Placing, ident: str, leader: str, settings: AtcSettings | None = None
) -> Manoeuvre:
    """What a pursuer flies, or would if it accepted what is proposed.

    Args:
        news: of its link.
        placing: in the sky.
        ident: the pursuer's name there.
        leader: its leader's.
        settings: how long it is looked at once it has joined.

    Raises:
        ValueError: if it neither flies a plan nor is proposed one, in a sentence.
    """
    settings = settings or AtcSettings()
    plan, joins, path = _planned(news, placing)
    leader_path = leader_track(news, placing)
    until = placing.later + joins + settings.followed
    if path.end < until:
        path = followed_track(path, leader_path, until)
    link, assigned = news.link, news.assignment
    by_time = link.spacing == "time"
    distance = link.slot_distance if assigned is None else assigned.slot_distance
    card = find_by_ident(news.started.aircraft, link.pursuer)
    return Manoeuvre(
        ident=ident,
        leader=leader,
        spacing_type=link.spacing,
        spacing=link.spacing_time if by_time else distance,
        min_separation=link.min_separation if assigned is None else assigned.min_separation,
        path=path,
        joins=placing.later + joins,
        leader_path=leader_path,
        word=plan.word,
        bank=max((one.bank for one in plan.segments if isinstance(one, TurnSegment)), default=0.0),
        max_bank=card.max_bank if assigned is None else assigned.max_bank,
    )


def _planned(news: LinkNews, placing: Placing) -> tuple[PlanCard, Second, Track]:
    """The plan, when it joins [flight time, s], and what will be flown."""
    t, guidance, who = news.sample.t, news.guidance, news.link.pursuer
    if news.engaged:
        if news.plan is None or news.forecast is None:
            raise ValueError(f"{who} flies no plan: there is nothing to be cleared.")
        joins = t if guidance.joined else t + guidance.time_to_go
        return news.plan.plan, joins, forecast_track(news, placing)
    if guidance.engagement == "off" or news.proposal is None:
        raise ValueError(
            f"{who} is proposed no path: designate its leader first, and ask once there is one."
        )
    proposal, ideal = news.proposal, news.proposal.plan.time_to_converge
    later = min(max(proposal.promised - ideal, 0.0), WAITS)
    joins = proposal.t + ideal + later
    for ahead in proposal.ahead:
        return proposal.plan, joins, _ahead_track(news, placing, ahead, proposal.plan)
    raise ValueError(f"Nothing is forecast of what {who} is proposed.")


def forecast_track(news: LinkNews, placing: Placing) -> Track:
    """What an engaged pursuer will fly.

    Raises:
        ValueError: if nothing is forecast.
    """
    ahead = news.forecast
    if ahead is None:
        raise ValueError(f"Nothing is forecast of {news.link.pursuer}.")
    track = _ahead_track(news, placing, ahead, None if news.plan is None else news.plan.plan)
    return replace(track, error=track.error + max(ahead.aside, default=0.0))


def _ahead_track(
    news: LinkNews, placing: Placing, ahead: ForecastChanged | PathAhead, plan: PlanCard | None
) -> Track:
    x, y, heading = placing.columns(ahead.x, ahead.y, ahead.heading)
    times = placing.later + np.array(ahead.times)
    track = points_track(times, x, y, heading, wind=placing.wind(_wind(news)))
    return _between(track, *_levels(news.pursuer, plan))


def leader_track(news: LinkNews, placing: Placing) -> Track:
    """What a pursuer expects its leader to fly; straight on where nothing is known."""
    leader = news.leader
    level = (leader.altitude,) * 2 if leader.ident not in news.climbing else (-inf, inf)
    if news.route is not None and news.route.segments:
        return _between(segments_track(news.route.segments, placing, wind=_wind(news)), *level)
    x, y, track = placing.columns((leader.x,), (leader.y,), (leader.track,))
    begin = placing.later + news.sample.t
    east, north = sin(track[0]) * leader.ground_speed, cos(track[0]) * leader.ground_speed
    straight = Track(
        t=np.array([begin, begin + 1.0]),
        x=np.array([x[0], x[0] + east]),
        y=np.array([y[0], y[0] + north]),
        low=np.zeros(2),
        high=np.zeros(2),
        error=0.0,
    )
    return _between(straight, *level)


def segments_track(segments: Sequence[PathSegment], placing: Placing, *, wind: Wind) -> Track:
    """A path of a document as a track: its turns by points `ARC` apart.

    Args:
        segments: their times are of the flight if `placing` is, else from a plan's begin on.
        placing: in the sky.
        wind: the flight's.
    """
    points = [point for segment in segments for point in _points(segment)]
    last = segments[-1].end
    points.append((last.t, last.x, last.y, last.heading))
    kept = [points[0]]
    for point in points[1:]:
        if point[0] > kept[-1][0] + 1e-3:  # a shorter piece is a rounding
            kept.append(point)
    t, x, y, heading = map(np.array, zip(*kept, strict=True))
    spans = np.diff(t)
    # at a steady speed a turn one way strays from its chord by no more than T V Δψ / 4
    speeds = np.hypot(np.diff(x) / spans - wind.east, np.diff(y) / spans - wind.north)
    turned = np.abs([wrap_signed(angle) for angle in np.diff(heading).tolist()])
    strays = spans * speeds * (1.0 + turned * turned / 24.0) * turned / 4.0
    east, north, _ = placing.columns(x, y, heading)
    unknown = np.full(len(t), inf)
    return Track(
        t=placing.later + t, x=east, y=north, low=-unknown, high=unknown,
        error=float(np.max(strays)),
    )  # fmt: skip


def _points(segment: PathSegment) -> list[tuple[float, float, float, float]]:
    """Times, places and headings along a segment, without its end."""
    start = segment.start
    match segment:
        case StraightSegment():
            return [(start.t, start.x, start.y, start.heading)]
        case BoundarySegment(via=via):
            return [_tuple(point) for point in (start, *via)]
        case TurnSegment(end=end):
            side = 1.0 if segment.direction == "right" else -1.0
            parts = max(int(np.ceil(segment.angle / ARC)), 1)

            def arc(angle: Radian) -> tuple[float, float]:
                nose = start.heading + side * angle
                east = side * segment.radius * (cos(start.heading) - cos(nose))
                return east, side * segment.radius * (sin(nose) - sin(start.heading))

            east, north = arc(segment.angle)
            # what the wind does to it: in the whole of it, and so in each part
            drift_x, drift_y = end.x - start.x - east, end.y - start.y - north
            found = []
            for k in range(parts):
                share = k / parts
                east, north = arc(segment.angle * share)
                found.append(
                    (
                        start.t + segment.duration * share,
                        start.x + east + drift_x * share,
                        start.y + north + drift_y * share,
                        wrap(start.heading + side * segment.angle * share),
                    )
                )
            return found


def _tuple(point: PathPoint) -> tuple[float, float, float, float]:
    return point.t, point.x, point.y, point.heading


def situation_of(news: LinkNews, placing: Placing) -> Situation:
    """A pursuer behind its leader now, in the sky: to plan what else it could fly.

    Args:
        news: of its link.
        placing: in the sky.

    Raises:
        ValueError: if that cannot be planned from, in a sentence.
    """
    own, leader, link, assigned = news.pursuer, news.leader, news.link, news.assignment
    columns = placing.columns(*zip(_pose(own), _pose(leader), strict=True))
    (own_x, leader_x), (own_y, leader_y), noses = (column.tolist() for column in columns)
    turned = noses[1] - leader.heading
    known = news.route is not None and news.route.intent_known
    segments = news.route.segments if news.route is not None and known else ()
    card = find_by_ident(news.started.aircraft, link.pursuer)
    return Situation(
        pursuer=Pursuer(
            x=own_x,
            y=own_y,
            heading=wrap(noses[0]),
            tas=own.tas,
            max_bank=card.max_bank if assigned is None else assigned.max_bank,
            altitude=own.altitude,
        ),
        leader=Leader(
            x=leader_x,
            y=leader_y,
            heading=wrap(noses[1]),
            tas=leader.tas,
            intent=_pieces(segments, news.sample.t, turned),
            altitude=leader.altitude,
        ),
        slot_distance=link.slot_distance if assigned is None else assigned.slot_distance,
        min_separation=link.min_separation if assigned is None else assigned.min_separation,
        wind=placing.wind(_wind(news)),
    )


def _pose(one: AircraftSample) -> tuple[Metre, Metre, Radian]:
    return one.x, one.y, one.heading


def _pieces(
    segments: Sequence[PathSegment], now: Second, turned: Radian
) -> tuple[IntentPiece, ...]:
    """What is left of a route, without the straight leg at its end."""
    pieces: list[IntentPiece] = []
    for segment in segments[:-1]:
        if segment.end.t <= now:
            continue
        match segment:
            case StraightSegment():
                pieces.append(FlyStraight(duration=segment.end.t - max(segment.start.t, now)))
            case TurnSegment(direction=direction, bank=bank):
                side = RIGHT if direction == "right" else LEFT
                heading = wrap(segment.end.heading + turned)
                pieces.append(TurnTo(heading=heading, turn=side, bank=bank))
            case BoundarySegment():
                pass  # no leader declares one
    return tuple(pieces)


def _levels(own: AircraftSample, plan: PlanCard | None) -> tuple[Metre, Metre]:
    """Between which altitudes a pursuer stays: that of now, and those that its plan leads to."""
    levels = [own.altitude, *(() if plan is None else (one.to_altitude for one in plan.levels))]
    return min(levels), max(levels)


def _between(track: Track, low: Metre, high: Metre) -> Track:
    """A track between two altitudes all along."""
    knots = len(track.t)
    return replace(track, low=np.full(knots, low), high=np.full(knots, high))


def _wind(news: LinkNews) -> Wind:
    wind = news.started.wind
    return wind_from(wind.from_, wind.speed)


def seen_in_flight(
    aircraft: AircraftSample,
    t: Second,
    placing: Placing,
    ident: str,
    *,
    climb: MetrePerSecond = 0.0,
    path: Track | None = None,
) -> Seen:
    """An aircraft of a flight in the sky.

    Args:
        aircraft: as it flies.
        t: flight time of that [s].
        placing: in the sky.
        ident: its name there.
        climb: its vertical speed [m/s].
        path: what it intends, if that is known.
    """
    x, y, track = placing.columns((aircraft.x,), (aircraft.y,), (aircraft.track,))
    return Seen(
        ident=ident,
        t=placing.later + t,
        x=float(x[0]),
        y=float(y[0]),
        track=wrap(float(track[0])),
        ground_speed=aircraft.ground_speed,
        altitude=aircraft.altitude,
        climb=climb,
        path=path,
    )
