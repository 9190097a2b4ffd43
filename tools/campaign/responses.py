"""Step responses of the loops as they are flown: the autopilot, the laws and the aircraft.

Nothing is linear here: the roll rate and the bank have their limits, and turn rates go with tan φ.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, copysign

import numpy as np

from relguide.flying.airframe import Airframe
from relguide.flying.guidance.settings import DEFAULT
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.turn import bank_for_turn_rate, turn_rate
from relguide.kernels.flight.flight_records import HOLD_HEADING, TURN_RATE, Body, Control
from relguide.kernels.flight.path import lay_path, project
from relguide.units import Metre, MetrePerSecond, Radian, RadianPerSecond, Second
from tests.aloft import A306, GAINS, MAX_BANK, fly, limits_of, tracking
from tools.campaign.loops import PATH_GAINS, STEP, Floats, PathGains


@dataclass(frozen=True, slots=True, kw_only=True)
class Response:
    """An aircraft over time, each step of the autopilot."""

    t: Floats
    heading: Floats
    """From the start, not wrapped [rad]."""
    bank: Floats
    """[rad]."""
    across: Floats
    """To the right of the path, or east of where it began [m]."""

    def settled(self, values: Floats, within: float) -> Second:
        """When values have come within so much of their last for good."""
        off = np.flatnonzero(np.abs(values - values[-1]) > within)
        return float(self.t[off[-1] + 1]) if off.size else 0.0


def bank_step(before: Radian, after: Radian, *, model: Airframe = A306) -> Response:
    """From one bank to another, at 240 m/s."""
    asked = Control(TURN_RATE, turn_rate(240.0, after), 240.0)
    return _response(fly(asked, _begun(240.0, bank=before), 25.0, limits=limits_of(model)))


def heading_step(
    change: Radian, *, tas: MetrePerSecond, model: Airframe = A306, duration: Second = 180.0
) -> Response:
    """To another heading, from straight flight."""
    asked = Control(HOLD_HEADING, change, tas)
    return _response(fly(asked, _begun(tas), duration, limits=limits_of(model)))


def path_step(
    across: Metre,
    *,
    tas: MetrePerSecond,
    gains: PathGains = PATH_GAINS,
    in_hand: Radian = MAX_BANK,
    bend: RadianPerSecond = 0.0,
    model: Airframe = A306,
    duration: Second = 180.0,
) -> Response:
    """Back onto a path that leads north, from so far to its right.

    Args:
        across: where it begins [m].
        tas: true airspeed [m/s].
        gains: of the path loop.
        in_hand: bank that the path leaves [rad].
        bend: how fast the path turns, and the aircraft with it [rad/s].
        model: the aircraft.
        duration: how long it is flown [s].
    """
    limits = limits_of(model, max_bank=in_hand)
    pieces = np.array([[2.0 * tas * duration, bend / tas]])
    path = lay_path(0.0, 0.0, 0.0, pieces, tas, 0.0, limits.max_roll_rate)
    set_to = GAINS._replace(
        path_bandwidth=gains.omega, damping=gains.damping, look_ahead=gains.look_ahead
    )
    law = tracking(path, tas=tas, limits=limits, gains=set_to)
    begun = _begun(tas, bank=bank_for_turn_rate(tas, bend))._replace(x=across)
    flown = fly(law, begun, duration, limits=limits)
    beside, s = [], 0.0
    for row in flown:
        s, right = project(path, row[0], row[1], s + tas * STEP)
        beside.append(right)
    return _response(flown, np.array(beside))


def off_path(turns: Sequence[Radian], *, tas: MetrePerSecond, model: Airframe = A306) -> Metre:
    """How far an aircraft comes off the path of a plan, whose bank changes at once.

    Args:
        turns: at the bank of plans, one after the other, positive to the right [rad]; straights
            before and after.
        tas: true airspeed [m/s].
        model: the aircraft; guidance believes it to be an A300.
    """
    curvature = turn_rate(tas, DEFAULT.planned_bank(MAX_BANK)) / tas
    pieces = [[BEFORE * tas, 0.0]]
    pieces += [[abs(angle) / curvature, copysign(curvature, angle)] for angle in turns]
    path = lay_path(0.0, 0.0, 0.0, np.array(pieces), tas, 0.0, A306.max_roll_rate)
    duration = sum(length for length, _ in pieces) / tas + BEFORE
    law = tracking(path, tas=tas)
    largest, s = 0.0, 0.0
    for row in fly(law, _begun(tas), float(ceil(duration)), limits=limits_of(model)):
        s, right = project(path, row[0], row[1], s + tas * STEP)
        largest = max(largest, abs(right))
    return largest


BEFORE: Second = 20.0
"""Of the straights before and after the turns."""


def _begun(tas: MetrePerSecond, bank: Radian = 0.0) -> Body:
    return Body(0.0, 0.0, 0.0, bank, 0.0, tas, 0.0)


def _response(flown: FloatArray, across: Floats | None = None) -> Response:
    t = np.arange(len(flown)) * STEP
    x, _, heading, bank, *_ = flown.T
    return Response(t=t, heading=heading, bank=bank, across=x if across is None else across)


def overshoot(values: Floats, wanted: float) -> float:
    """How far values go beyond what is wanted, from their first on."""
    return max(0.0, float(np.max((values - wanted) * copysign(1.0, wanted - float(values[0])))))
