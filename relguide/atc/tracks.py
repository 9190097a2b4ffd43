"""Tracks made of what is known: points of a forecast, pieces of a plan or an intent, a state alone.

All are over the ground. What is flown strays from a track's straight lines by no more than its
`error`. Between two knots T apart, of velocity v and mean u, the stray is |∫(v − u)|, and so

    T² A / 8      where |dv/dt| ≤ A: an arc of turn rate r has A = V r,
    T V Δψ / 4    where the heading turns one way only, by Δψ,
    T Δu / 2      where the speed changes one way only, by Δu at most.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from math import ceil, cos, inf, sin, sqrt

import numpy as np
from numpy.typing import ArrayLike

from relguide.atc.picture import Seen
from relguide.atc.settings import AtcSettings
from relguide.atc.track import Track
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.roots import FloatArray
from relguide.planning.aircraft import Leader, Traffic
from relguide.planning.heights import RATE_TOLERANCE, UNKNOWN, Heights, heights_of
from relguide.planning.outcome import Plan
from relguide.planning.trajectory import Trajectory
from relguide.planning.wind import CALM, Wind
from relguide.units import FT, NM, Metre, MetrePerSecond, Second

CHORD: Metre = 2.0
"""An arc's chords stray from it by no more than this [m]."""
COARSE: Metre = 10.0
"""The same of other traffic: a tenth of a percent of its minimum [m]."""
BRAKING: MetrePerSecond = 0.6
"""No aircraft brakes, or gathers speed, faster than this [m/s²]."""
STEADY: MetrePerSecond = 0.05
"""Two mean speeds this near are one: positions are told to a metre or so [m/s]."""
ROLLING: Metre = 0.1 * NM
"""What is flown strays from an ideal plan by no more, as aircraft take time to roll: the buffer
that guidance keeps for it [m]."""
CLIMBS: MetrePerSecond = 300.0 * FT / 60.0
"""An aircraft that climbs or descends faster than this changes its level [m/s]."""
THOUSAND: Metre = 1_000.0 * FT
"""Levels are whole ones of these [m]."""
_JUMP: Second = 0.01
"""Bounds on the altitude that jump are the wider ones so long before and behind it [s]."""


def points_track(
    t: ArrayLike,
    x: ArrayLike,
    y: ArrayLike,
    heading: ArrayLike,
    *,
    heights: Heights = UNKNOWN,
    heights_at: Second | None = None,
    wind: Wind = CALM,
) -> Track:
    """The track of a flight ahead, from its points: those of `ForecastChanged`.

    Between two points the aircraft is taken to turn one way only, and to change its speed one way
    only over three of them, by `BRAKING` at most.

    Args:
        t: times in the clock of the sky, ascending [s]. shape (n,), n ≥ 2
        x: east, over the ground [m]. shape (n,)
        y: north [m]. shape (n,)
        heading: where the nose points, clockwise from north [rad]. shape (n,)
        heights: the altitude and its changes to come.
        heights_at: the time from which those count [s]; the first point's if left out.
        wind: that the points were forecast in.
    """
    times, east, north, noses = (np.asarray(column, dtype=float) for column in (t, x, y, heading))
    spans = np.diff(times)
    if len(times) < 2 or not np.all(spans > 0.0):
        raise ValueError("A track needs two points or more, at ascending times.")
    turned = np.abs([wrap_signed(angle) for angle in np.diff(noses).tolist()])
    speeds = np.hypot(np.diff(east) / spans - wind.east, np.diff(north) / spans - wind.north)
    # the arc is longer than its chord by Δψ²/24
    speeds = speeds * (1.0 + turned * turned / 24.0)
    strays = spans * (speeds * turned / 4.0 + _braked(spans, speeds))
    start = float(times[0]) if heights_at is None else heights_at
    return _at_heights(times, east, north, float(np.max(strays)), heights, start)


def _braked(spans: FloatArray, speeds: FloatArray) -> FloatArray:
    """How far each piece's points stray for a change of its speed, by its duration [m/s]."""
    steps = np.abs(np.diff(speeds))
    before, behind = np.append(steps[:1], steps), np.append(steps, steps[-1:])
    by_steps = 0.5 * np.maximum(before, behind) if len(steps) else np.full(len(speeds), inf)
    by_braking = BRAKING * spans / 8.0
    ends = np.zeros(len(speeds), dtype=bool)
    ends[[0, -1]] = True  # there the change goes on beyond what is known
    by_steps[ends & (by_steps > 0.5 * STEADY)] = inf
    least: FloatArray = np.minimum(by_steps, by_braking)
    return least


def path_track(
    trajectory: Trajectory,
    *,
    start: Second,
    until: Second,
    wind: Wind = CALM,
    heights: Heights = UNKNOWN,
    chord: Metre = CHORD,
) -> Track:
    """The track of a path that is flown from a time on; past its end it goes on straight.

    Args:
        trajectory: in the air mass.
        start: its t = 0, in the clock of the sky [s].
        until: where the track ends, after `start` [s].
        wind: moves the air mass.
        heights: the altitude, from `start` on.
        chord: how far the chords of its arcs may stray from them [m].
    """
    times, error, begins = [0.0], 0.0, 0.0
    for duration, rate in trajectory.bends():
        bend = trajectory.tas * abs(rate)
        parts = max(ceil(duration * sqrt(bend / (8.0 * chord))), 1)
        if duration / parts > 1e-6:  # a shorter one is a rounding
            times += [begins + duration * (k + 1) / parts for k in range(parts)]
            error = max(error, bend * (duration / parts) ** 2 / 8.0)
        begins += duration
    span = until - start
    times = [time for time in times if time < span - 1e-6]
    flown = trajectory.sample([*times, span]).over_ground(wind)
    return _at_heights(start + flown.t, flown.x, flown.y, error, heights, start)


def intent_track(
    aircraft: Leader | Traffic, *, start: Second, until: Second, wind: Wind = CALM
) -> Track:
    """What an aircraft declares that it will fly.

    Args:
        aircraft: where it is at `start`, with its intent.
        start: in the clock of the sky [s].
        until: where the track ends, after `start` [s].
        wind: moves the air mass.
    """
    return path_track(
        aircraft.trajectory,
        start=start,
        until=until,
        wind=wind,
        heights=heights_of(aircraft),
        chord=COARSE if isinstance(aircraft, Traffic) else CHORD,
    )


def plan_track(plan: Plan, *, start: Second, settings: AtcSettings | None = None) -> Track:
    """A plan flown from a time on, and then its place behind the leader.

    A plan turns and brakes at once; what that may be off when flown is part of the track's error.
    Where there is a forecast, take `points_track`.

    Args:
        plan: to be flown.
        start: its t = 0, in the clock of the sky [s].
        settings: how long the place behind the leader is followed.
    """
    settings = settings or AtcSettings()
    own, leader, joins = plan.situation.pursuer, plan.situation.leader, plan.time_to_converge
    wind, until = plan.situation.wind, start + joins + settings.followed
    heights = heights_of(own)
    path = path_track(plan.trajectory, start=start, until=start + joins, wind=wind, heights=heights)
    course, after = leader.final_heading, settings.followed
    x = path.x[-1] + (leader.tas * sin(course) + wind.east) * after
    y = path.y[-1] + (leader.tas * cos(course) + wind.north) * after
    whole = replace(path, t=np.append(path.t, until), x=np.append(path.x, x),
                    y=np.append(path.y, y))  # fmt: skip
    slower = abs(own.tas - leader.tas)
    error = path.error + ROLLING + slower * slower / (8.0 * BRAKING)
    return _at_heights(whole.t, whole.x, whole.y, error, heights, start)


def straight_track(seen: Seen, *, until: Second, settings: AtcSettings | None = None) -> Track:
    """An aircraft that has not said what it intends, straight on from where it was seen.

    One that changes its level may stop at any time, or be faster by `RATE_TOLERANCE` and the buffer
    for climbs. One near a whole level flies on it.

    Args:
        seen: the aircraft.
        until: where the track ends [s].
        settings: the buffers.
    """
    settings = settings or AtcSettings()
    t, x, y = seen.t, seen.x, seen.y
    span = max(until - t, 1.0)
    way = seen.ground_speed * span
    (low, low_then), (high, high_then) = _straight_heights(seen, span, settings)
    return Track(
        t=np.array((t, t + span)),
        x=np.array((x, x + way * sin(seen.track))),
        y=np.array((y, y + way * cos(seen.track))),
        low=np.array((low, low_then)),
        high=np.array((high, high_then)),
        error=0.0,
    )


def _straight_heights(
    seen: Seen, span: Second, settings: AtcSettings
) -> tuple[tuple[Metre, Metre], tuple[Metre, Metre]]:
    """How low it may be when seen and some time on, and how high [m]."""
    altitude = seen.altitude
    if altitude is None:
        return (-inf, -inf), (inf, inf)
    if abs(seen.climb) <= CLIMBS:
        level = round(altitude / THOUSAND) * THOUSAND
        flown = level if abs(level - altitude) <= settings.level_buffer else altitude
        return (flown, flown), (flown, flown)
    then = altitude + seen.climb * (1.0 + RATE_TOLERANCE) * span
    below = settings.climb_buffer if seen.climb < 0.0 else settings.level_buffer
    above = settings.climb_buffer if seen.climb > 0.0 else settings.level_buffer
    return (
        (altitude - below, min(altitude, then) - below),
        (altitude + above, max(altitude, then) + above),
    )


def followed_track(track: Track, leader: Track, until: Second) -> Track:
    """A track that goes on until a time as its leader has flown before it; cut off behind it.

    Args:
        track: of an aircraft that has joined by the track's end.
        leader: the track of its leader.
        until: where it is to end [s].
    """
    if track.end >= until:
        return _cut(track, until)
    delay = _behind(track, leader)
    later = np.append(leader.t + delay, until)
    later = np.unique(later[(later > track.end + 1e-3) & (later <= until)])
    # where it is at the end beside where its leader was: kept
    here, there = track.place(track.end), leader.place(track.end - delay)
    places = np.array([leader.place(t - delay) for t in later.tolist()])
    east, north = here[0] - there[0], here[1] - there[1]
    level = np.ones(len(later))
    return Track(
        t=np.append(track.t, later),
        x=np.append(track.x, places[:, 0] + east),
        y=np.append(track.y, places[:, 1] + north),
        low=np.append(track.low, level * track.low[-1]),
        high=np.append(track.high, level * track.high[-1]),
        error=track.error + leader.error,
    )


def _behind(track: Track, leader: Track) -> Second:
    """How long after its leader a track's end passes the nearest place of the leader's way [s]."""
    times = np.append(leader.t, track.end)
    times = np.unique(times[times <= track.end])
    x, y = track.place(track.end)
    speed = max(float(np.hypot(*leader.velocity(track.end))), 1.0)
    first = float(times[0]) - leader.distance(track, track.end) / speed
    best, at = inf, track.end
    ends = [first, *times.tolist()]
    for begin, end in pairwise(ends):
        (ax, ay), (bx, by) = leader.place(begin), leader.place(end)
        way = (bx - ax) ** 2 + (by - ay) ** 2
        share = ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / way if way > 0.0 else 0.0
        share = min(max(share, 0.0), 1.0)
        aside = np.hypot(x - ax - share * (bx - ax), y - ay - share * (by - ay))
        if aside < best:
            best, at = float(aside), begin + share * (end - begin)
    return track.end - at


def _cut(track: Track, until: Second) -> Track:
    """A track without what lies behind a time, but for two knots at least."""
    n = max(int(np.searchsorted(track.t, until)), 1)
    if n + 1 >= len(track.t):
        return track
    kept = slice(0, n + 1)
    return replace(track, t=track.t[kept], x=track.x[kept], y=track.y[kept],
                   low=track.low[kept], high=track.high[kept])  # fmt: skip


def _at_heights(
    t: FloatArray, x: FloatArray, y: FloatArray, error: Metre, heights: Heights, start: Second
) -> Track:
    """A track with bounds on the altitude, with knots where these bend or jump."""
    knots = np.array([start + knot for knot in heights.bound_knots() if knot > 0.0])
    if not len(knots):
        low, high = heights.bounds(0.0)
        level = np.ones(len(t))
        return Track(t=t, x=x, y=y, low=level * low, high=level * high, error=error)
    about = [knots + k * _JUMP for k in (-2, -1, 0, 1, 2)]
    cuts = np.concatenate(([t[0]], *about, [t[-1]]))
    cuts = np.unique(cuts[(cuts >= t[0]) & (cuts <= t[-1])])
    times = np.union1d(t, cuts)
    bounds = np.array([_widest(heights, cut - start) for cut in cuts.tolist()])
    return Track(
        t=times,
        x=np.interp(times, t, x),
        y=np.interp(times, t, y),
        low=np.interp(times, cuts, bounds[:, 0]),
        high=np.interp(times, cuts, bounds[:, 1]),
        error=error,
    )


def _widest(heights: Heights, t: Second) -> Sequence[Metre]:
    """Bounds on the altitude about a time: within a jump of them, the wider ones [m]."""
    about = [heights.bounds(t + step) for step in (-_JUMP, 0.0, _JUMP)]
    return min(low for low, _ in about), max(high for _, high in about)
