"""The loops of an aircraft in flight, linear, with their margins by python-control.

Roll: the ailerons ask for a roll rate, the roll mode follows with its lag, bank is its integral.

    τ ṗ = aileron − p,   φ̇ = p,   aileron = K_φ (φ_c − φ) − D_φ p        at 20 Hz

Heading: φ̇, ψ̇ = g φ / V, and the turn rate asked for is turned into bank at the same speed, so V
drops out of the loop.

    r_c = K_ψ e + I_ψ ∫ e dt − D_ψ r,   φ_c = V r_c / g                  at 20 Hz

Path: cross-track e and heading error η against a path, to each the bank that works against it.

    ė = V η,   η̇ = g φ / V,   φ_c = −ω²/g · e − 2ζωV/g · η               at 1 Hz

In the air mass ë = g φ, so with gains that go with V like these the loop is the same at any V.
e and η are those expected a look-ahead later, with the bank that the aircraft has now. On a
straight, next to the path, the heading loop does it: it is asked for η_c = −e ω / (2ζV).

Each loop is closed as it is flown: the state moves exactly from one sample to the next with the
controls held, nothing is approximated by a delay.
"""

from dataclasses import dataclass
from math import pi
from typing import NamedTuple

import control
import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm

from relguide.flying.airframe import Airframe
from relguide.flying.guidance.settings import DEFAULT
from relguide.kernels.flight import autopilot
from relguide.units import G0, MetrePerSecond, RadianPerSecond, Second
from tests.aloft import A306, STEP

Floats = NDArray[np.float64]
TICK: Second = 1.0
"""Of guidance."""
FREQUENCIES = 1_000
"""At which a loop's response is computed, up to half its sampling rate."""
SLOWEST: RadianPerSecond = 1e-3


class RollGains(NamedTuple):
    """Of the roll loop."""

    kp: float
    """K_φ [1/s]."""
    kd: float
    """D_φ."""


class HeadingGains(NamedTuple):
    """Of the heading loop."""

    kp: float
    """K_ψ [1/s]."""
    ki: float
    """I_ψ [1/s²]."""
    kd: float
    """D_ψ."""


ROLL_GAINS = RollGains(autopilot.ROLL_KP, autopilot.ROLL_KD)
HEADING_GAINS = HeadingGains(autopilot.HEADING_KP, autopilot.HEADING_KI, autopilot.HEADING_KD)


@dataclass(frozen=True, slots=True, kw_only=True)
class PathGains:
    """How bank answers to cross-track and heading error."""

    omega: RadianPerSecond
    """Natural frequency ω of the cross-track [rad/s]."""
    damping: float
    """ζ."""
    look_ahead: Second
    """For when the errors are expected."""


PATH_GAINS = PathGains(
    omega=DEFAULT.path_bandwidth, damping=DEFAULT.damping, look_ahead=DEFAULT.look_ahead
)
"""Along the plan. The look-ahead is the lag of the roll loop, (1 + D_φ)/K_φ."""
FOLLOW_GAINS = PathGains(
    omega=DEFAULT.follow_bandwidth, damping=DEFAULT.damping, look_ahead=DEFAULT.look_ahead
)
"""Along the leader's path: 30 m of its noise ask for 1.5° of bank."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Margins:
    """How much a loop bears."""

    gain: float
    """Factor of the loop gain until it is unstable; infinite if none makes it so."""
    phase: float
    """[°]."""
    crossover: RadianPerSecond
    """Where the loop gain is 1."""

    @property
    def delay(self) -> Second:
        """Delay that uses up the phase margin."""
        return self.phase / 180.0 * pi / self.crossover


def margins(loop: control.StateSpace) -> Margins:
    """Of an open loop in discrete time, from its frequency response."""
    omega = np.geomspace(SLOWEST, pi / loop.dt, FREQUENCIES)
    magnitude, angle, _ = control.frequency_response(loop, omega)
    found = control.stability_margins((magnitude, np.degrees(np.unwrap(angle)), omega))
    gain, phase, _, _, crossover, _ = found
    # at half the sampling rate the response is real: a phase of −180° there is an end, no crossing
    last = complex(loop(-1.0)).real
    if last < 0.0:
        gain = min(gain, -1.0 / last)
    return Margins(gain=float(gain), phase=float(phase), crossover=float(crossover))


def roll_loop(model: Airframe = A306, gains: RollGains = ROLL_GAINS) -> control.StateSpace:
    """From the bank asked for to bank, open at the ailerons."""
    a, b = _hold_input(*_roll_mode(model), STEP)
    return control.StateSpace(a, b, [[gains.kp, gains.kd]], 0.0, STEP)


def heading_loop(
    model: Airframe = A306,
    *,
    tas: MetrePerSecond,
    gains: HeadingGains = HEADING_GAINS,
    roll_gains: RollGains = ROLL_GAINS,
) -> control.StateSpace:
    """From heading error to heading, the roll loop closed."""
    a, b = _open_heading_loop(model, tas, gains, roll_gains)
    return control.StateSpace(a, b, [[1.0, 0.0, 0.0, 0.0]], 0.0, STEP)


def _open_heading_loop(
    model: Airframe, tas: MetrePerSecond, gains: HeadingGains, roll_gains: RollGains
) -> tuple[Floats, Floats]:
    """Heading, bank, roll rate and the integral of the error, driven by the error."""
    a = np.zeros((3, 3))
    a[0, 1] = G0 / tas
    a[1:, 1:], input_ = _roll_mode(model)
    a, b = _hold_input(a, np.vstack([[0.0], input_]), STEP)
    to_bank = tas / G0
    inner = np.array([[0.0, roll_gains.kp * (1.0 + gains.kd), roll_gains.kd]])
    moved = np.zeros((4, 4))
    moved[:3, :3] = a - b @ inner
    moved[:3, 3:] = b * roll_gains.kp * to_bank * gains.ki
    moved[3, 3] = 1.0
    return moved, np.vstack([b * roll_gains.kp * to_bank * gains.kp, [[STEP]]])


def _closed_heading_loop(
    model: Airframe, tas: MetrePerSecond, gains: HeadingGains, roll_gains: RollGains
) -> tuple[Floats, Floats]:
    """The same, driven by the heading asked for."""
    a, b = _open_heading_loop(model, tas, gains, roll_gains)
    return a - b @ np.array([[1.0, 0.0, 0.0, 0.0]]), b


def path_loop(
    model: Airframe = A306,
    *,
    tas: MetrePerSecond,
    gains: PathGains = PATH_GAINS,
    roll_gains: RollGains = ROLL_GAINS,
) -> control.StateSpace:
    """From the bank asked for back to the bank asked for, held for a second each."""
    a = np.zeros((4, 4))  # cross-track, heading error, bank, roll rate
    a[0, 1], a[1, 2] = tas, G0 / tas
    a[2:, 2:], input_ = _roll_mode(model)
    a, b = _hold_input(a, np.vstack([[0.0], [0.0], input_]), STEP)
    closed = a - b @ np.array([[0.0, 0.0, roll_gains.kp, roll_gains.kd]])
    over_tick, drive = np.eye(4), np.zeros((4, 1))
    for _ in range(round(TICK / STEP)):
        drive = closed @ drive + b * roll_gains.kp
        over_tick = closed @ over_tick
    return control.StateSpace(over_tick, drive, path_feedback(tas, gains), 0.0, TICK)


def straight_loop(
    model: Airframe = A306, *, tas: MetrePerSecond, gains: PathGains = PATH_GAINS
) -> control.StateSpace:
    """From the heading asked for back to it, held for a second each, the heading loop closed."""
    closed, drive = _closed_heading_loop(model, tas, HEADING_GAINS, ROLL_GAINS)
    a = np.zeros((5, 5))  # and the cross-track, by the heading at both ends of a step
    a[:4, :4], a[4, 4] = closed, 1.0
    a[4, :4] = 0.5 * tas * STEP * (np.eye(4)[0] + closed[0])
    b = np.vstack([drive, 0.5 * tas * STEP * drive[:1]])
    over_tick, held = np.eye(5), np.zeros((5, 1))
    for _ in range(round(TICK / STEP)):
        held = a @ held + b
        over_tick = a @ over_tick
    back = np.array([[0.0, 0.0, 0.0, 0.0, gains.omega / (2.0 * gains.damping * tas)]])
    return control.StateSpace(over_tick, held, back, 0.0, TICK)


def path_feedback(tas: MetrePerSecond, gains: PathGains) -> Floats:
    """Bank against cross-track, heading error, bank and roll rate. shape (1, 4)"""
    across = gains.omega**2 / G0
    along = 2.0 * gains.damping * gains.omega * tas / G0
    ahead = gains.look_ahead
    return np.array(
        [
            [
                across,
                along + across * tas * ahead,
                across * G0 * 0.5 * ahead**2 + along * G0 / tas * ahead,
                0.0,
            ]
        ]
    )


def _roll_mode(model: Airframe) -> tuple[Floats, Floats]:
    """Bank and roll rate, driven by the ailerons."""
    rate = 1.0 / model.roll_time_constant
    return np.array([[0.0, 1.0], [0.0, -rate]]), np.array([[0.0], [rate]])


def _hold_input(a: Floats, b: Floats, duration: Second) -> tuple[Floats, Floats]:
    """The same over a while in which the input is held."""
    n = len(a)
    whole = np.zeros((n + 1, n + 1))
    whole[:n, :n], whole[:n, n:] = a, b
    moved = expm(whole * duration)
    return moved[:n, :n], moved[:n, n:]
