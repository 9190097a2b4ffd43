"""One PID controller, with limits and an integrator that does not wind up."""

from dataclasses import dataclass
from typing import NamedTuple

from relguide.units import Second


class Gains(NamedTuple):
    """u = kp·e + ki·∫e dt + kd·ė."""

    kp: float
    """Proportional."""
    ki: float
    """Integral [1/s]."""
    kd: float
    """Derivative [s]."""


@dataclass(slots=True, kw_only=True)
class Pid:
    """A controller and its integrator: one of the few things here that change."""

    gains: Gains
    integral: float = 0.0
    """∫e dt so far."""

    def update(self, error: float, error_rate: float, limit: float, duration: Second) -> float:
        """The next output, within ±limit.

        The integrator stands still while the output is at its limit and the error would push it
        further (conditional integration), so that nothing has to be unwound afterwards.

        Args:
            error: wanted minus measured.
            error_rate: its rate. Gyros measure rates; differencing would only add noise.
            limit: of the output, ≥ 0.
            duration: since the last update [s].
        """
        kp, ki, kd = self.gains
        wanted = kp * error + ki * self.integral + kd * error_rate
        if abs(wanted) < limit or wanted * error < 0.0:
            self.integral += error * duration
        if wanted > limit:  # plain comparisons: this runs 80 times a simulated second
            return limit
        return wanted if wanted > -limit else -limit

    def reset(self) -> None:
        """Forget the past, e.g. when another loop takes over."""
        self.integral = 0.0
