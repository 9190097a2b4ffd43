"""The documents that a late joiner needs to draw the same picture as all other watchers."""

from collections import deque
from dataclasses import dataclass, field
from typing import assert_never

from relguide.flying.documents import (
    Document,
    FlightEnded,
    FlightStarted,
    LeaderChanged,
    LeaderRoute,
    ModeChanged,
    PlanChanged,
    PlanRefused,
    PlanUnavailable,
    Sample,
)

TRAIL_PERIOD = 10.0
"""Flight time between two samples that are kept [s]."""
TRAIL_SAMPLES = 720
"""Most samples kept: two hours."""
LEADER_CHANGES = 100
"""Most changes of the leader kept."""


@dataclass(slots=True)
class History:
    """The past of one flight, thinned. Each slot holds the last document of its kind."""

    started: tuple[FlightStarted, ...] = ()
    route: tuple[LeaderRoute, ...] = ()
    changes: deque[LeaderChanged] = field(default_factory=lambda: deque(maxlen=LEADER_CHANGES))
    plan: tuple[PlanChanged | PlanUnavailable, ...] = ()
    refused: tuple[PlanRefused, ...] = ()
    mode: tuple[ModeChanged, ...] = ()
    trail: deque[Sample] = field(default_factory=lambda: deque(maxlen=TRAIL_SAMPLES))
    newest: tuple[Sample, ...] = ()
    ended: tuple[FlightEnded, ...] = ()

    def add(self, document: Document) -> None:
        """Remember a document, which is newer than all before."""
        match document:
            case FlightStarted():
                self.started = (document,)
            case LeaderRoute():
                self.route = (document,)
            case LeaderChanged():
                self.changes.append(document)
            case PlanChanged() | PlanUnavailable():
                self.plan = (document,)
            case PlanRefused():
                self.refused = (document,)
            case ModeChanged():
                self.mode = (document,)
            case Sample():
                self.newest = (document,)
                if not self.trail or document.t >= self.trail[-1].t + TRAIL_PERIOD:
                    self.trail.append(document)
            case FlightEnded():
                self.ended = (document,)
            case _:
                assert_never(document)

    def documents(self) -> list[Document]:
        """The snapshot: what the flight is, what holds now, the trail, this instant."""
        past = [s for s in self.trail if not any(s is newest for newest in self.newest)]
        return [
            *self.started,
            *self.route,
            *self.changes,
            *self.plan,
            *self.refused,
            *self.mode,
            *past,
            *self.newest,
            *self.ended,
        ]
