"""What a pursuer learns of its own braking: that it is weaker than its data say.

An aircraft that slows down less than guidance believes comes too near its leader each time it
joins. So the speed that is lost in a second is compared with what was asked, and a deceleration
that is short of it for some seconds is believed from then on: by the laws, by the forecast, and so
by the next plan. One that is stronger than believed does no harm.
"""

from dataclasses import replace
from math import exp

from relguide.flying.fleet import Fleet
from relguide.flying.pursuit import Pursuit
from relguide.kernels.flight.energy import full_deceleration, load_square

SECONDS = 3
"""So long in a row it must be short of what was asked."""
LAG_ALONE = 0.6
"""A slower autothrust explains a loss of speed down to this share of what its lag gives."""
SHORT = 0.95
"""Nearer than this to the deceleration believed, nothing is learnt."""


def learn_braking(one: Pursuit, fleet: Fleet) -> None:
    """Compare the second just flown with what was asked, and believe what was seen."""
    before, now = one.tas, fleet.body(one.pursuer).tas
    one.tas = now
    if one.advice is None:
        return
    limits = fleet.believed_limits[one.pursuer]
    asked = max(one.advice.control.tas, limits.min_tas)
    lost = before - now
    by_lag = (before - asked) * (1.0 - exp(-1.0 / limits.speed_time))
    believed = full_deceleration(limits, now, load_square(fleet.body(one.pursuer).bank))
    if lost >= LAG_ALONE * by_lag or lost >= SHORT * believed:
        one.braked = ()
        return
    one.braked = (*one.braked, lost)
    if len(one.braked) < SECONDS or max(one.braked) <= 0.0:
        return
    seen, one.braked = max(one.braked), ()
    believed_share = limits.braking * seen / believed
    fleet.believed_limits[one.pursuer] = limits._replace(braking=believed_share)
    idle = min(one.assignment.idle_deceleration, seen)
    one.assignment = replace(one.assignment, idle_deceleration=idle)
    one.memory = one.memory._replace(forecast=None)  # it braked harder than that
