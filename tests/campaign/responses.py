"""Step responses of the loops as they are flown: the autopilot and the aircraft of the library.

Nothing is linear here: the roll rate and the bank have their limits, and turn rates go with tan φ.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import asin, copysign, sin, sqrt

import numpy as np

from relguide.flying.aircraft import A300, AircraftModel, AircraftState, step
from relguide.flying.autopilot import Autopilot, HoldHeading, Reference, TurnRate
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.turn import turn_rate
from relguide.units import DEG, G0, Metre, MetrePerSecond, Radian, Second
from tests.campaign.loops import PATH_GAINS, STEP, TICK, Floats, PathGains

INTERCEPT: Radian = 30.0 * DEG
"""Steepest angle at which a path is closed on."""
BRAKING_SHARE = 0.5
"""Of the bank in hand, used to brake the closing of a path: the other half corrects."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Response:
    """An aircraft over time, each step of the autopilot."""

    t: Floats
    heading: Floats
    """From the start, not wrapped [rad]."""
    bank: Floats
    """[rad]."""
    across: Floats
    """East of where it began [m]."""

    def settled(self, values: Floats, within: float) -> Second:
        """When values have come within so much of their last for good."""
        off = np.flatnonzero(np.abs(values - values[-1]) > within)
        return float(self.t[off[-1] + 1]) if off.size else 0.0


def bank_step(before: Radian, after: Radian, *, model: AircraftModel = A300) -> Response:
    """From one bank to another, at 240 m/s."""
    tas = 240.0
    wanted = TurnRate(turn_rate(tas, after))
    begun = AircraftState(0.0, 0.0, 0.0, before, 0.0, tas, 9449.0)
    return fly(lambda t, state: wanted, begun, duration=25.0, model=model)


def heading_step(
    change: Radian, *, tas: MetrePerSecond, model: AircraftModel = A300, duration: Second = 180.0
) -> Response:
    """To another heading, from straight flight."""
    begun = AircraftState(0.0, 0.0, 0.0, 0.0, 0.0, tas, 9449.0)
    return fly(lambda t, state: HoldHeading(change), begun, duration=duration, model=model)


def path_step(
    across: Metre,
    *,
    tas: MetrePerSecond,
    gains: PathGains = PATH_GAINS,
    in_hand: Radian = 25.0 * DEG,
    model: AircraftModel = A300,
    duration: Second = 180.0,
) -> Response:
    """Back onto a path that leads north, from so far to its right.

    Args:
        across: where it begins [m].
        tas: true airspeed [m/s].
        gains: of the path loop.
        in_hand: bank that the path leaves [rad].
        model: the aircraft.
        duration: how long it is flown [s].
    """
    begun = AircraftState(across, 0.0, 0.0, 0.0, 0.0, tas, 9449.0)

    def law(t: Second, state: AircraftState) -> Reference:
        bank = path_bank(state.x, wrap_signed(state.heading), state.bank, tas, gains, in_hand)
        return TurnRate(turn_rate(tas, bank))

    return fly(law, begun, duration=duration, model=model)


def path_bank(
    across: Metre,
    heading: Radian,
    bank: Radian,
    tas: MetrePerSecond,
    gains: PathGains,
    in_hand: Radian,
) -> Radian:
    """Bank that leads back onto a path, within what is in hand.

        v_e = √((aτ)² + 2a|e|) − aτ,  τ = 2ζ/ω          no faster than it can be braked at a
        η_c = −sign(e) asin(v_e/V),   φ = −2ζωV/g (η − η_c)

    For small e this is −ω²/g e − 2ζωV/g η, the linear law; without the root a far start would
    overshoot by hundreds of metres, as the bank for it is not there.
    """
    ahead = gains.look_ahead
    rate = turn_rate(tas, bank)
    across += tas * ahead * sin(heading) + 0.5 * tas * rate * ahead**2
    heading += rate * ahead
    slow = 2.0 * gains.damping / gains.omega
    brake = BRAKING_SHARE * G0 * in_hand
    closing = sqrt((brake * slow) ** 2 + 2.0 * brake * abs(across)) - brake * slow
    course = -copysign(asin(min(closing / tas, sin(INTERCEPT))), across)
    asked = -2.0 * gains.damping * gains.omega * tas / G0 * (heading - course)
    return min(max(asked, -in_hand), in_hand)


def fly(
    law: Callable[[Second, AircraftState], Reference],
    begun: AircraftState,
    *,
    duration: Second,
    model: AircraftModel,
) -> Response:
    """Fly in still air by a law that is asked once a second."""
    pilot, state = Autopilot(model=model), begun
    rows, turned, a_tick = [], 0.0, round(TICK / STEP)
    for n in range(round(duration / STEP) + 1):
        if n % a_tick == 0:
            reference = law(n * STEP, state)
        rows.append((n * STEP, turned, state.bank, state.x))
        moved = step(
            model,
            state,
            aileron=pilot.aileron(reference, state, STEP),
            commanded_tas=begun.tas,
            wind_east=0.0,
            wind_north=0.0,
            duration=STEP,
        )
        turned += wrap_signed(moved.heading - state.heading)
        state = moved
    t, heading, bank, across = np.array(rows).T
    return Response(t=t, heading=heading, bank=bank, across=across)


def overshoot(values: Floats, wanted: float) -> float:
    """How far values go beyond what is wanted, from their first on."""
    return max(0.0, float(np.max((values - wanted) * copysign(1.0, wanted - float(values[0])))))
