"""What a pursuer learns of its own braking: that it is weaker, or stronger, than its data say.

An aircraft that slows down less than guidance believes comes too near its leader each time it
joins. So while much less speed is asked for than is flown, and the thrust has come down, a line is
fitted to the airspeed of the last seconds. Its slope is believed in place of the data where both
differ by more than the slope's own error: a wobble of the airspeed, a gust or a slow engine is no
weak brake. The next line is held against the data again, so what was learnt is forgotten.
"""

from dataclasses import replace

import numpy as np

from relguide.flying.fleet import Fleet
from relguide.flying.pursuit import Pursuit
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight.energy import full_deceleration
from relguide.units import MetrePerSecond

ASKED_LESS: MetrePerSecond = 5.0
"""Braking is asked for in earnest where this much less speed is asked for than is flown [m/s]:
thrust is idle, and all brakes that the autothrust has are out."""
SPOOLED = 5
"""So many seconds of it pass before the thrust has come down."""
WINDOW = 15
"""The line is fitted to so many seconds at most …"""
LEAST = 8
"""… and to so many at least."""
SURE = 3.0
"""A slope differs from the data beyond doubt by so many times its standard error."""
NOISE: MetrePerSecond = 0.1
"""What an airspeed is read to [m/s]: so a line through few points is not believed too much."""
SHORT = 0.95
"""Nearer than this to the deceleration of the data, nothing is learnt."""
FLOOR = 0.5
"""Never less than this share of the type's deceleration at idle thrust is believed: no engine and
no brake fails so far, and an aircraft that believed it would slow down for ever."""


def learn_braking(one: Pursuit, fleet: Fleet) -> None:
    """Fit a line to the airspeed while braking is asked for, and believe what is beyond doubt."""
    limits, tas = fleet.believed_limits[one.pursuer], fleet.body(one.pursuer).tas
    asked = tas if one.advice is None else max(one.advice.control.tas, limits.min_tas)
    if asked > tas - ASKED_LESS or fleet.changes_level(one.pursuer):  # what goes down is faster
        one.braked = ()
        return
    one.braked = (*one.braked[-(SPOOLED + WINDOW) :], tas)
    points = np.array(one.braked[SPOOLED:])[-WINDOW:]
    if len(points) < LEAST:
        return
    slope, error = _line(points)
    by_data = limits._replace(braking=1.0)
    full = full_deceleration(by_data, float(points.mean()), 1.0)
    share, least = 1.0, FLOOR * one.idle_deceleration / full
    if -slope + SURE * error < SHORT * full:
        share = max(-slope / full, least)
    if abs(share - limits.braking) <= max(error / full, 1.0 - SHORT):
        return
    fleet.believed_limits[one.pursuer] = limits._replace(braking=share)
    idle = min(one.idle_deceleration, share * full)
    one.assignment = replace(one.assignment, idle_deceleration=idle)
    committed = one.memory.committed is not None
    pending = "braking" if committed else one.memory.pending
    one.memory = one.memory._replace(forecast=None, pending=pending)


def _line(tas: FloatArray) -> tuple[float, float]:
    """Slope of a line through airspeeds a second apart, and its standard error [m/s²]."""
    t = np.arange(len(tas)) - 0.5 * (len(tas) - 1)
    square = float(np.sum(t * t))
    slope = float(np.sum(t * tas)) / square
    rest = tas - tas.mean() - slope * t
    variance = max(float(np.sum(rest * rest)) / (len(tas) - 2), NOISE * NOISE)
    return slope, float(np.sqrt(variance / square))
