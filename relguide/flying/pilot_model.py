"""A pilot that can be measured: follows the flight director's bar as pilots were found to do."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.flight import by_hand
from relguide.planning.inputs import Range, expect_within
from relguide.planning.reprs import as_code
from relguide.units import DEG, Radian, RadianPerSecond, Second

BANDWIDTH = Range(0.1, 5.0, "rad/s")
DELAY = Range(0.0, 1.5, "s")
REMNANT = Range(0.0, 1.0, "of the errors' variance")
THRESHOLD = Range(0.0, 10.0, "°")
REACTION = Range(0.0, 30.0, "s")


@dataclass(frozen=True, slots=True, kw_only=True)
class PilotModel:
    """The crossover model, Y_p Y_c = ω_c e^(−τ s)/s, with remnant and reaction."""

    bandwidth: RadianPerSecond = 1.0
    """ω_c [rad/s]."""
    delay: Second = 0.3
    """τ [s]."""
    remnant: float = 0.02
    """Variance of the noise that it adds over that of the errors that it sees."""
    threshold: Radian = 1.0 * DEG
    """An error of the bank that it lets stand [rad]."""
    reaction: Second = 1.5
    """How long after an announcement it begins to answer the bar [s]."""
    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what no pilot is."""
        for name, limits, unit in (
            ("bandwidth", BANDWIDTH, 1.0),
            ("delay", DELAY, 1.0),
            ("remnant", REMNANT, 1.0),
            ("threshold", THRESHOLD, DEG),
            ("reaction", REACTION, 1.0),
        ):
            expect_within(name, getattr(self, name) / unit, *limits)

    def row(self, step: Second) -> NDArray[np.float64]:
        """Its row of `hands`, as it begins."""
        row = np.zeros(by_hand.COLUMNS)
        row[by_hand.BANDWIDTH], row[by_hand.LAG] = self.bandwidth, round(self.delay / step)
        row[by_hand.REMNANT], row[by_hand.THRESHOLD] = self.remnant, self.threshold
        return row
