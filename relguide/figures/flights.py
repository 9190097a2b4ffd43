"""Flights in columns, to be drawn: one row a second for each aircraft, and what was said."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relguide.flying.aircraft_documents import LinkResult
from relguide.flying.documents import (
    Document,
    FlightEnded,
    Sample,
)
from relguide.flying.flight import Scenario, fly
from relguide.flying.guidances import Guidance
from relguide.planning.plan import plan

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Course:
    """Where an aircraft was, in columns of equal length."""

    x: Floats
    """East [m]."""
    y: Floats
    """North [m]."""
    heading: Floats
    """Clockwise from north, without jumps [rad]."""
    bank: Floats
    """Positive right wing down [rad]."""


@dataclass(frozen=True, slots=True)
class Flown:
    """A flight that is over."""

    t: Floats
    """Of the rows [s]."""
    courses: dict[str, Course]
    """By ident."""
    separation: dict[str, Floats]
    """Of each pursuer from its leader [m]."""
    results: tuple[LinkResult, ...]

    @property
    def result(self) -> LinkResult:
        """Of the first pursuer."""
        return self.results[0]


def flown(scenario: Scenario, *, guidance: Guidance = "relguide") -> Flown:
    """Fly a scenario to its end, by exact plans."""
    return in_columns(fly(scenario, plan, sample_period=1.0, guidance=guidance))


def in_columns(documents: Iterable[Document]) -> Flown:
    """The documents of a flight, in columns."""
    told = list(documents)
    samples = [one for one in told if isinstance(one, Sample)]
    *_, ended = told
    assert isinstance(ended, FlightEnded)
    return Flown(
        t=np.array([sample.t for sample in samples]),
        courses={
            first.ident: Course(
                x=np.array([sample.aircraft[i].x for sample in samples]),
                y=np.array([sample.aircraft[i].y for sample in samples]),
                heading=np.unwrap([sample.aircraft[i].heading for sample in samples]),
                bank=np.array([sample.aircraft[i].bank for sample in samples]),
            )
            for i, first in enumerate(samples[0].aircraft)
        },
        separation={
            first.ident: np.array([sample.guidance[i].separation for sample in samples])
            for i, first in enumerate(samples[0].guidance)
        },
        results=ended.results,
    )
