"""A sample of a flight of two, its parts by name."""

from dataclasses import dataclass

from relguide.flying.aircraft_documents import AircraftSample, GuidanceSample
from relguide.flying.documents import Sample
from relguide.units import Second

EVERY: Second = 1.0
"""Between samples: guidance acts as often."""


@dataclass(frozen=True)
class Instant:
    """A sample of a flight of two."""

    t: float
    pursuer: AircraftSample
    leader: AircraftSample
    guidance: GuidanceSample


def instant(sample: Sample) -> Instant:
    """The pursuer, the leader and what guidance does, of one sample."""
    (pursuer, leader), (guidance,) = sample.aircraft, sample.guidance
    assert (guidance.ident, guidance.leader) == (pursuer.ident, leader.ident)
    return Instant(sample.t, pursuer, leader, guidance)
