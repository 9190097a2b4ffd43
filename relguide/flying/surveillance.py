"""How others are seen: exactly, or by ADS-B reports that are noisy, late and sometimes lost.

    truth → Receiver (noise, latency, loss) → Report → LeaderTrack → what guidance may know

Sizes of errors are those of the categories that an aircraft broadcasts with its reports, NACp and
NACv (RTCA DO-260B, tables 2-70 and 2-16; 14 CFR 91.227 asks for NACp 8, NACv 1, a total latency of
2 s and 0.6 s of it uncompensated). A bound of 95 % in the plane is √(−2 ln 0.05) = 2.448 σ of each
axis.
"""

from dataclasses import dataclass
from itertools import pairwise
from math import exp, inf, log, sqrt
from typing import Literal, NamedTuple

import numpy as np

from relguide.planning.inputs import Range, expect_whole, expect_within, truth
from relguide.planning.reprs import as_code
from relguide.units import NM, Metre, MetrePerSecond, Second

PER_AXIS = sqrt(-2.0 * log(0.05))
"""How many σ of an axis hold 95 % of errors in the plane."""
POSITION_BOUNDS: dict[int, Metre] = {
    1: 10.0 * NM, 2: 4.0 * NM, 3: 2.0 * NM, 4: 1.0 * NM, 5: 0.5 * NM, 6: 0.3 * NM, 7: 0.1 * NM,
    8: 0.05 * NM, 9: 30.0, 10: 10.0, 11: 3.0,
}  # fmt: skip
"""Estimated position uncertainty (EPU, 95 %) of each NACp [m]."""
VELOCITY_BOUNDS: dict[int, MetrePerSecond] = {1: 10.0, 2: 3.0, 3: 1.0, 4: 0.3}
"""Error of the horizontal velocity (95 %) of each NACv [m/s]."""
UNCOMPENSATED = 1.0 / 3.0
"""Share of the latency that a compensated position still lags: 0.4 of 1.2 s; an estimate."""
DRIFTING = 0.9
"""Share of the variance of a position that drifts with its source's errors (ionosphere, orbits,
inertial drift); the rest is new each time. An estimate."""
DRIFT_TIME: Second = 100.0
"""Time constant of that drift; an estimate between a receiver's smoothing and its satellites'
passing."""
LONG_LOSS = 0.1
"""Share of losses that last longer than one report: a receiver near Toulouse had 0.1 % of gaps
above 2.3 s, the longest 6.3 s."""
LATENCY = Range(0.0, 5.0, "s")
"""Accepted latencies."""
INTERVAL = Range(1.0, 30.0, "s")
"""Accepted intervals between reports."""
LOSS_SHARE = Range(0.0, 0.5, "")
"""Accepted shares of lost reports."""
BURST = Range(0.0, 60.0, "s")
"""Accepted longest times without a report."""
"""Accepted steps of altitudes."""
HISTORY = 6
"""So many seconds of the truth are kept, for the longest latency."""


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Surveillance:
    """How well others are seen.

    Examples:
        >>> round(rg.Surveillance(kind="adsb", nacp=8).position_sigma)  # [m]
        38
    """

    kind: Literal["exact", "adsb"] = "exact"
    """`exact`: as they are, and the rest has no meaning."""
    nacp: int = 9
    """Category of the position, 1–11."""
    nacv: int = 2
    """Category of the velocity, 1–4."""
    latency: Second = 0.6
    """Between a measurement and its report's arrival [s]."""
    compensated: bool = True
    """Whether positions are advanced by the latency before they are sent, but for a share."""
    interval: Second = 1.0
    """Between reports [s], a second or more: guidance looks once a second."""
    loss_share: float = 0.05
    """Share of reports that never arrive."""
    burst: Second = 6.0
    """Longest time without a report [s]; reports are lost one by one where it is no longer than two
    intervals."""

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what no receiver would call surveillance."""
        if self.kind not in ("exact", "adsb"):
            raise ValueError(f"kind must be 'exact' or 'adsb', not {self.kind!r}.")
        for name, bounds in (("nacp", POSITION_BOUNDS), ("nacv", VELOCITY_BOUNDS)):
            value = expect_whole(name, getattr(self, name), 1)
            if value not in bounds:
                raise ValueError(f"{name} must lie in 1 … {len(bounds)}, not {value}.")
            object.__setattr__(self, name, value)
        truth("compensated", self.compensated)
        for name, accepted in {
            "latency": LATENCY,
            "interval": INTERVAL,
            "loss_share": LOSS_SHARE,
            "burst": BURST,
        }.items():
            number = expect_within(name, getattr(self, name), *accepted)
            object.__setattr__(self, name, number)

    @property
    def position_sigma(self) -> Metre:
        """σ of x and of y [m]: the bound of the NACp, as if it were just kept."""
        return 0.0 if self.kind == "exact" else POSITION_BOUNDS[self.nacp] / PER_AXIS

    @property
    def velocity_sigma(self) -> MetrePerSecond:
        """σ of the velocity's east and north [m/s]: the bound of the NACv, as if just kept."""
        return 0.0 if self.kind == "exact" else VELOCITY_BOUNDS[self.nacv] / PER_AXIS

    @property
    def lag(self) -> Second:
        """How old a reported position is when it arrives [s]."""
        if self.kind == "exact":
            return 0.0
        return self.latency * (UNCOMPENSATED if self.compensated else 1.0)


EXACT = Surveillance()
"""Others are seen as they are."""


class Report(NamedTuple):
    """What arrives of another aircraft."""

    t: Second
    """When it arrives; its position is meant for then [s]."""
    x: Metre
    """East over the ground [m]."""
    y: Metre
    """North over the ground [m]."""
    east: MetrePerSecond
    """Ground velocity [m/s]."""
    north: MetrePerSecond
    """The same [m/s]."""
    position_sigma: Metre
    """σ of x and of y, by the NACp [m]."""
    velocity_sigma: MetrePerSecond
    """σ of east and of north, by the NACv [m/s]."""


class Receiver:
    """Receives the reports of one aircraft: one of the few things here that change.

    The first report always arrives: whoever is to be joined has been seen.
    """

    def __init__(self, surveillance: Surveillance, rng: np.random.Generator) -> None:
        """Nothing is received yet.

        Args:
            surveillance: how well.
            rng: of noise and losses.
        """
        self.surveillance, self._rng = surveillance, rng
        self._truth: list[tuple[float, ...]] = []
        self._due: Second | None = None
        self._to_lose, self._has_lost = 0, False
        self._drift = np.zeros(2)
        self._drawn: Second = -inf
        self._longest = max(round(surveillance.burst / surveillance.interval) - 1, 1)
        mean = 1.0 + LONG_LOSS * 0.5 * self._longest if self._longest > 1 else 1.0
        share = surveillance.loss_share
        self._begins = share / (mean * (1.0 - share))

    def hear(
        self, t: Second, x: Metre, y: Metre, east: MetrePerSecond, north: MetrePerSecond
    ) -> Report | None:
        """What has arrived by now; `None` where nothing has.

        Args:
            t: now; no earlier than the last time [s].
            x: where the aircraft is now, east over the ground [m].
            y: the same, north [m].
            east: its ground velocity now [m/s].
            north: the same [m/s].
        """
        seen = self.surveillance
        if seen.kind == "exact":
            return Report(t, x, y, east, north, 0.0, 0.0)
        self._truth = [*self._truth[-HISTORY:], (t, x, y, east, north)]
        if self._due is None:
            self._due, lost = t, False
        elif t < self._due - 1e-6:
            return None
        else:
            lost = self._is_lost()
        self._due += seen.interval
        return None if lost else self._report(t)

    def _is_lost(self) -> bool:
        """Whether the report that is due now gets lost; after each loss one arrives."""
        if self._to_lose == 0 and not self._has_lost and self._rng.random() < self._begins:
            self._to_lose = 1
            if self._longest > 1 and self._rng.random() < LONG_LOSS:
                self._to_lose = int(self._rng.integers(2, self._longest, endpoint=True))
        self._has_lost = self._to_lose > 0
        self._to_lose = max(self._to_lose - 1, 0)
        return self._has_lost

    def _report(self, t: Second) -> Report:
        """The report that arrives now: what was measured a latency ago, with its errors."""
        seen, rng = self.surveillance, self._rng
        kept = exp(-(t - self._drawn) / DRIFT_TIME)
        self._drift = kept * self._drift + sqrt(1.0 - kept * kept) * rng.standard_normal(2)
        self._drawn = t
        white = sqrt(1.0 - DRIFTING) * rng.standard_normal(2)
        off = seen.position_sigma * (sqrt(DRIFTING) * self._drift + white)
        x, y, east, north = _interpolated(self._truth, t - seen.latency)
        # by the true velocity: the noise of the sent one is worth less than a metre
        advanced = seen.latency - seen.lag
        x, y = x + east * advanced, y + north * advanced
        noise = seen.velocity_sigma * rng.standard_normal(2)
        return Report(
            t, x + float(off[0]), y + float(off[1]),
            east + float(noise[0]), north + float(noise[1]),
            seen.position_sigma, seen.velocity_sigma,
        )  # fmt: skip


def _interpolated(rows: list[tuple[float, ...]], t: Second) -> tuple[float, float, float, float]:
    """Position and velocity at a time, between rows of t, x, y, east, north; before them straight.

    Between two rows the acceleration is constant.
    """
    for after, before in pairwise(reversed(rows)):
        if before[0] <= t:
            dt = after[0] - before[0]
            u = (t - before[0]) / dt
            x, y, east, north = (before[i] + u * (after[i] - before[i]) for i in range(1, 5))
            # of a parabola through the two rows, what it bulges beyond the chord
            bulge = 0.5 * u * (1.0 - u) * dt
            return (
                x - bulge * (after[3] - before[3]), y - bulge * (after[4] - before[4]), east, north
            )  # fmt: skip
    t0, x, y, east, north = rows[0]
    return x - east * (t0 - t), y - north * (t0 - t), east, north
