"""What lies ahead if a crew that flies by hand goes on as it does, whatever the bars say.

Guidance looks ahead as if what it asks were flown. By hand that may not be so: a crew that does not
turn where it should hears of it, while a turn away still keeps d_min.
"""

from dataclasses import replace
from math import copysign, pi

from relguide.flying.belief import Belief
from relguide.flying.guidance.amid import nearings
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.escape import escape
from relguide.flying.guidance.forecast import NO_COURSE, Forecast, forecast
from relguide.flying.guidance.monitor import Outlook
from relguide.kernels.flight.guide import HOLD, Progress
from relguide.units import DEG, Radian, Second

STRAIGHT: Radian = 2.0 * DEG
"""With less bank than this a crew flies straight on [rad]."""
ALMOST_BACK: Radian = 0.95 * pi
"""A bank is held for as much of a turn as this: more than a minute of it [rad]."""
REACTS_IN: Second = 10.0
"""A crew hears, looks and has begun to roll so long after a caution [s]."""
NEAR: Second = 20.0
"""What would be lost to others so soon is announced [s]."""


def look_out_by_hand(outlook: Outlook, belief: Belief, assignment: Assignment) -> Outlook:
    """What lies ahead, with what the crew's own hands would lose.

    Args:
        outlook: as guidance looks ahead.
        belief: what is known now.
        assignment: what was asked.
    """
    if not belief.by_hand:
        return outlook
    ahead, limit = _as_flown(belief, assignment), assignment.min_separation
    least, at = ahead.least(belief.t)
    if least < min(limit, outlook.least):
        late = escape(belief, assignment, limit, delay=REACTS_IN)
        if late.least_separation < limit:
            breaks = min(outlook.breaks, ahead.breaks(belief.t, limit))
            outlook = outlook._replace(least=least, at=at, breaks=breaks)
    near = {
        other.ident: other
        for other in nearings(ahead, belief, assignment)
        if other.breaks - belief.t <= NEAR
    }
    others = (near.get(other.ident, other) for other in outlook.others)
    return outlook._replace(others=tuple(others)) if near else outlook


def _as_flown(belief: Belief, assignment: Assignment) -> Forecast:
    """The flight ahead with the present bank and speed, for as long as an alert looks ahead."""
    own, limits, heading = belief.own, belief.limits, belief.own.heading
    if abs(own.bank) > STRAIGHT:
        heading += copysign(ALMOST_BACK, own.bank)
        limits = limits._replace(max_bank=abs(own.bank))
    until = belief.t + assignment.settings.caution
    holding = Progress(HOLD, 0.0, heading, own.tas)
    return forecast(replace(belief, limits=limits), assignment, holding, NO_COURSE, until=until)
