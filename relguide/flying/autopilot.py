"""The autopilot: a slow heading loop over a fast roll loop, superposed PIDs as in section 5.

    heading error → heading PID → turn rate → bank, eq. (8) → roll PID → ailerons

A turn rate asked for enters after the heading PID.
"""

from dataclasses import dataclass, field
from typing import Literal, assert_never

from relguide.flying.aircraft import AircraftModel, AircraftState
from relguide.flying.pid import Gains, Pid
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.turn import bank_for_turn_rate, turn_rate
from relguide.units import DEG, Radian, RadianPerSecond, Second


@dataclass(frozen=True, slots=True)
class HoldHeading:
    """Turn the shorter way to a heading and keep it."""

    heading: Radian
    """Clockwise from north [rad]."""
    kind: Literal["hold_heading"] = "hold_heading"


@dataclass(frozen=True, slots=True)
class TurnRate:
    """Keep a turn rate."""

    turn_rate: RadianPerSecond
    """r [rad/s], positive to the right."""
    kind: Literal["turn_rate"] = "turn_rate"


Reference = HoldHeading | TurnRate
"""What guidance asks of the autopilot."""

ROLL_GAINS = Gains(
    kp=0.8,  # closes bank in 1/kp = 1.3 s: slow enough not to excite the 0.5 s roll mode
    ki=0.0,  # bank is already the integral of the ailerons: no steady error to remove
    kd=0.4,  # damping (1 + kd)/(2√(kp·0.5 s)) = 1.1: the bank limit is approached from below
)
HEADING_GAINS = Gains(
    kp=0.125,  # 1/8 s: from 25° of bank at 240 m/s it asks for 3.4°/s of roll, within 3.75°/s
    ki=0.0005,  # removes a bank bias of 1° in a minute; faster would overshoot the capture
    kd=0.1,  # a lead of 0.8 s (kd/kp) on the rate: makes good half the roll loop's lag
)
INTEGRATE_WITHIN = 2.0 * DEG
"""The heading PID integrates only this close: a capture from afar is not a steady error [rad]."""


@dataclass(slots=True, kw_only=True)
class Autopilot:
    """The two loops of one aircraft. Changes with every command: its PIDs remember."""

    model: AircraftModel
    heading_loop: Pid = field(default_factory=lambda: Pid(gains=HEADING_GAINS))
    roll_loop: Pid = field(default_factory=lambda: Pid(gains=ROLL_GAINS))

    def aileron(
        self, reference: Reference, state: AircraftState, duration: Second
    ) -> RadianPerSecond:
        """What to ask of the ailerons now [rad/s of roll, positive to the right].

        Args:
            reference: what guidance wants.
            state: of the aircraft.
            duration: since the last call [s].
        """
        limit = self.model.max_bank
        match reference:
            case HoldHeading(heading=wanted):
                rate_limit = turn_rate(state.tas, limit)
                rate = turn_rate(state.tas, state.bank)
                error = wrap_signed(wanted - state.heading)
                if abs(error) > INTEGRATE_WITHIN:
                    self.heading_loop.reset()
                wanted_rate = self.heading_loop.update(error, -rate, rate_limit, duration)
            case TurnRate(turn_rate=wanted_rate):
                self.heading_loop.reset()
            case _:
                assert_never(reference)
        bank = bank_for_turn_rate(state.tas, wanted_rate)
        bank = min(max(bank, -limit), limit)
        return self.roll_loop.update(
            bank - state.bank, -state.roll_rate, self.model.max_roll_rate, duration
        )
