"""The stretch of a flight that can be flown behind, and what is said of the rest.

Reports on the ground are left out, the longest believable chain of the others is made smooth, and
of that the longest run is taken in which the aircraft is faster than `AIRBORNE`.
"""

from datetime import UTC, datetime

import numpy as np
from numpy.typing import NDArray

from relguide.flying.recordings.exchanged import refuse_exchanged
from relguide.flying.smoothing import MAX_GAP, MIN_POINTS, SmoothMotion, smooth_motion
from relguide.flying.spline import Array
from relguide.flying.tracks import RecordedTrack
from relguide.planning.frames import middle_of
from relguide.planning.limits import ALTITUDE
from relguide.units import DEG, FT, KT, Second

STEP: Second = 1.0
"""Grid of a `RecordedTrack` [s]."""
AIRBORNE = 55.0
"""Slower than this over the ground it is taking off, landing or taxiing [m/s], 107 kt."""
A_DAY: Second = 86_400.0


def track_of(numbers: Array, ident: str, aircraft_type: str, source: str) -> RecordedTrack:
    """The stretch of a flight's reports that can be flown behind.

    Args:
        numbers: as in `Reports`, of one aircraft.
        ident: of the aircraft.
        aircraft_type: its designator, or empty.
        source: whose reports they are, for people.

    Raises:
        ValueError: if there is no such stretch, saying why.
    """
    heard = numbers[np.argsort(numbers[:, 0], kind="stable")]
    flown = heard[heard[:, 6] != 1.0]
    located = np.all(np.isfinite(flown[:, 1:3]), axis=1)
    if not np.any(located):
        where = "in the air" if len(flown) < len(heard) else ""
        raise ValueError(f"{source} has no positions{' ' if where else ''}{where}.")
    refuse_exchanged(flown, source)
    t, lat, lon, altitude, speed, track, _ = flown.T
    plane = middle_of(lat[located], lon[located])
    place, turned = np.full((len(t), 2), np.nan), np.full(len(t), np.nan)
    place[located] = np.column_stack(plane.to_local_each(lat[located], lon[located]))
    turned[located] = plane.meridian_each(lat[located], lon[located])
    # the plane's north where the aircraft was last seen, where a report has no position
    direction = track * DEG + _held(turned)
    velocity = speed[:, None] * np.column_stack([np.sin(direction), np.cos(direction)])
    try:
        motion = smooth_motion(t, place, velocity, altitude, step=STEP)
    except ValueError as error:
        raise ValueError(f"{source} {error}") from None
    airborne = _longest_run(np.hypot(motion.east, motion.north) >= AIRBORNE)
    if airborne.stop - airborne.start < MIN_POINTS:
        raise ValueError(f"{source} never flies {MIN_POINTS} s faster than {AIRBORNE:g} m/s.")
    highest = float(np.max(motion.altitude[airborne]))
    if not ALTITUDE.admits(highest):
        raise ValueError(
            f"{source} flies at {highest:.0f} m, and aircraft fly at {ALTITUDE.high:g} m at most. "
            "If its altitudes are in feet, call their column altitude_ft."
        )
    east, north = motion.east[airborne], motion.north[airborne]
    return RecordedTrack(
        ident=ident,
        aircraft_type=aircraft_type,
        origin=plane,
        t=motion.t[airborne] - motion.t[airborne.start],
        x=motion.x[airborne],
        y=motion.y[airborne],
        track=np.unwrap(np.arctan2(east, north)),
        ground_speed=np.hypot(east, north),
        altitude=motion.altitude[airborne],
        start=float(motion.t[airborne.start]),
        taken=_said(heard, motion, airborne),
    )


def clock(t: Second, *, day: bool = False) -> str:
    """A time since 1970 as people read it, `12:03:10`, with the day if asked for."""
    form = "%Y-%m-%d %H:%M:%S" if day else "%H:%M:%S"
    # years beyond 9999 are none; the clock of their day is
    return datetime.fromtimestamp(round(t) % (2932896 * A_DAY), UTC).strftime(form)


def _said(heard: Array, motion: SmoothMotion, airborne: slice) -> str:
    """What was taken of a flight, and what was left out, with figures."""
    t = motion.t[airborne]
    low, high = np.min(motion.altitude[airborne]), np.max(motion.altitude[airborne])
    flown = (
        f"Flown: {clock(t[0], day=True)} to {clock(t[-1])} UTC, {t[-1] - t[0]:.0f} s "
        f"{_levels(low, high)}"
    )
    speed = np.hypot(motion.east, motion.north)
    slow = int(np.sum(speed < AIRBORNE))
    parted = len(speed) - slow - len(t)
    ground, gaps = heard[heard[:, 6] == 1.0, 0], _silences(heard)
    # what a silence cuts off is heard, but lies outside the smooth motion
    air = heard[(heard[:, 6] != 1.0) & np.all(np.isfinite(heard[:, 1:3]), axis=1), 0]
    before, after = air[air < motion.t[0] - STEP], air[air > motion.t[-1] + STEP]
    silence = f"of more than {MAX_GAP:.0f} s, {np.sum(gaps):.0f} s in all"
    left = [
        said
        for holds, said in (
            (len(ground), f"{_spent(ground):.0f} s on the ground"),
            (slow, f"{slow * STEP:.0f} s slower than {AIRBORNE / KT:.0f} kt"),
            (parted, f"{parted * STEP:.0f} s of flight parted from it by those"),
            (len(before), f"{_many(len(before), 'position')} before it"),
            (len(after), f"{_many(len(after), 'position')} after it"),
            (len(gaps), f"{_many(len(gaps), 'silence')} {silence}"),
            (motion.unbelieved, f"{_many(motion.unbelieved, 'position')} that cannot be right"),
        )
        if holds
    ]
    return f"{flown}; left out: {', '.join(left)}." if left else f"{flown}; all that was heard."


def _many(count: int, thing: str) -> str:
    return f"{count} {thing}" if count == 1 else f"{count} {thing}s"


def _levels(low: float, high: float) -> str:
    names = [f"FL{max(altitude, 0.0) / (100.0 * FT):03.0f}" for altitude in (low, high)]
    return f"at {names[0]}" if names[0] == names[1] else f"from {names[0]} to {names[1]}"


def _silences(heard: Array) -> Array:
    """How long nothing was heard, each time that was longer than can be bridged [s]."""
    t = heard[np.all(np.isfinite(heard[:, 1:3]), axis=1), 0]
    steps: Array = np.diff(t)
    return steps[steps > MAX_GAP]


def _spent(t: Array) -> Second:
    """The time that reports cover, silences not counted [s]."""
    steps = np.diff(t)
    return float(np.sum(steps[steps <= MAX_GAP])) if len(t) else 0.0


def _held(values: Array) -> Array:
    """Each value, or the last one before it that is known; the first from what follows."""
    known = np.isfinite(values)
    last = np.maximum.accumulate(np.where(known, np.arange(len(values)), -1))
    return values[np.where(last < 0, int(np.argmax(known)), last)]


def _longest_run(holds: NDArray[np.bool_]) -> slice:
    """Where a condition holds longest without a break."""
    edges = np.diff(holds.astype(np.int8), prepend=0, append=0)
    starts, stops = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    if not starts.size:
        return slice(0, 0)
    longest = int(np.argmax(stops - starts))
    return slice(int(starts[longest]), int(stops[longest]))
