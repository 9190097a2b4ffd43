"""A pilot that can be measured: follows the flight director's bar as pilots were found to do.

The form is that of McRuer and Krendel, Mathematical models of human pilot behavior, AGARD-AG-188
(1974): near the crossover, pilot and aircraft together are ω_c e^(−τ s)/s, and what the pilot does
beside it is noise whose variance goes with that of the errors. Levison (A model-based technique for
the design of flight directors, 1973) found that a pilot acts on a director's signal in proportion,
and Adams (Simulator study of a flight director display, 1983) that pilots with a director respond
much as the autopilot does.

The values are assumptions: of the first report we know the title and the form of the model, of the
other two the abstracts. They are gentle ones, as an airliner is rolled gently: ω_c of
0.8 … 1.2 rad/s and τ of 0.2 … 0.4 s are a quarter of the crossover, and the delay, of the tracking
tasks in a laboratory. With a roll mode of 0.5 s, which the pilot does not take back, 1 rad/s leaves
46° of phase. So campaigns draw each value within ± 50 %.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.flight import by_hand
from relguide.kernels.flight.autopilot import ROLL_KD, ROLL_KP
from relguide.planning.inputs import Range, expect_within, number
from relguide.planning.reprs import as_code
from relguide.units import DEG, Radian, RadianPerSecond, Second

BANDWIDTH = Range(0.1, 5.0, "rad/s")
DELAY = Range(0.0, 1.5, "s")
REMNANT = Range(0.0, 1.0, "of the errors' variance")
THRESHOLD = Range(0.0, 10.0, "°")
REACTION = Range(0.0, 30.0, "s")
LEAD = Range(0.0, 2.0, "s")


@dataclass(frozen=True, slots=True, kw_only=True)
class PilotModel:
    """The crossover model, Y_p Y_c = ω_c e^(−τ s)/s, with remnant and reaction.

    Examples:
        >>> slow = rg.PilotModel(bandwidth=0.6, reaction=2.5)
        >>> rg.Guided(by_hand=slow).by_hand.reaction  # [s]
        2.5
    """

    bandwidth: RadianPerSecond = 1.0
    """ω_c: how fast it answers an error of the bank, over the error [rad/s]."""
    delay: Second = 0.3
    """τ: how late it answers what it sees [s]."""
    remnant: float = 0.02
    """Variance of the noise that it adds, through 1/(1 s + 1), over that of the errors it saw in
    the last seconds."""
    threshold: Radian = 1.0 * DEG
    """An error of the bank that it lets stand [rad]."""
    reaction: Second = 1.5
    """How long after an announcement it begins to answer the bar; until then it holds the stick
    neutral [s]."""
    lead: Second = 0.0
    """It answers the error that the bank will have so much later, by the rate of roll [s]."""
    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what no pilot is."""
        for name, limits, unit in (
            ("bandwidth", BANDWIDTH, 1.0),
            ("delay", DELAY, 1.0),
            ("remnant", REMNANT, 1.0),
            ("threshold", THRESHOLD, DEG),
            ("reaction", REACTION, 1.0),
            ("lead", LEAD, 1.0),
        ):
            value = number(name, getattr(self, name))
            expect_within(name, value / unit, *limits)
            object.__setattr__(self, name, value)

    @classmethod
    def perfect(cls) -> Self:
        """The pilot that asks of the ailerons exactly what the autopilot asks of them.

        The autopilot's law K (φ_c − φ) − D p answers at once, ω_c = K, the error of D/K later.
        """
        lead = ROLL_KD / ROLL_KP
        return cls(
            bandwidth=ROLL_KP, delay=0.0, remnant=0.0, threshold=0.0, reaction=0.0, lead=lead
        )

    def row(self, step: Second) -> NDArray[np.float64]:
        """Its row of `hands` for a step of the integration [s], as it begins."""
        row = np.zeros(by_hand.columns(step))
        row[by_hand.BANDWIDTH], row[by_hand.LEAD] = self.bandwidth, self.lead
        row[by_hand.LAG] = self.delay / step
        row[by_hand.REMNANT], row[by_hand.THRESHOLD] = self.remnant, self.threshold
        return row
