"""The documents that a late joiner needs to draw the same picture as all other watchers."""

from collections import deque
from dataclasses import dataclass, field
from operator import itemgetter
from typing import TypeVar, assert_never

from relguide.flying.documents import (
    Alert,
    AssignmentChanged,
    ClearanceNews,
    CommandGiven,
    ControlChanged,
    Document,
    EngagementChanged,
    FanChanged,
    FlightEnded,
    FlightStarted,
    ForecastChanged,
    LeaderChanged,
    LeaderRoute,
    ModeChanged,
    PlanChanged,
    PlanProposed,
    PlanRefused,
    PlanUnavailable,
    PromiseChanged,
    Sample,
    SeparationLost,
    Unable,
)

TRAIL_PERIOD = 10.0
"""Flight time between two samples that are kept [s]."""
TRAIL_SAMPLES = 720
"""Most samples kept: two hours."""
HAPPENINGS = 200
"""Most changes of leaders and losses of separation kept."""

Happening = LeaderChanged | SeparationLost
D = TypeVar("D", AssignmentChanged, ForecastChanged, PlanChanged, PlanProposed)


@dataclass(slots=True)
class History:
    """The past of one flight, thinned, each document with its number in the flight."""

    started: tuple[FlightStarted, ...] = ()
    newest: tuple[Sample, ...] = ()
    ended: tuple[FlightEnded, ...] = ()
    _states: dict[tuple[str, ...], tuple[int, Document]] = field(default_factory=dict)
    """The last document of each kind and aircraft."""
    _happenings: deque[tuple[int, Happening]] = field(
        default_factory=lambda: deque(maxlen=HAPPENINGS)
    )
    _trail: deque[tuple[int, Sample]] = field(default_factory=lambda: deque(maxlen=TRAIL_SAMPLES))
    _count: int = 0

    def add(self, document: Document) -> None:
        """Remember a document, which is newer than all before."""
        self._count += 1
        match document:
            case FlightStarted():
                self.started = (document,)
            case LeaderChanged() | SeparationLost():
                self._happenings.append((self._count, document))
            case LeaderRoute():
                self._hold(document, "route", document.expected_by, document.ident)
            case PlanChanged() | PlanUnavailable():
                self._hold(document, "plan", document.ident)
            case (
                PlanProposed()
                | EngagementChanged()
                | ControlChanged()
                | AssignmentChanged()
                | ClearanceNews()
                | PlanRefused()
                | ModeChanged()
                | PromiseChanged()
                | Unable()
                | ForecastChanged()
                | FanChanged()
            ):
                self._hold(document, document.kind, document.ident)
            case Alert():
                self._hold(document, "alert", document.ident, document.other, document.subject)
            case Sample():
                self.newest = (document,)
                if not self._trail or document.t >= self._trail[-1][1].t + TRAIL_PERIOD:
                    self._trail.append((self._count, document))
            case CommandGiven():
                pass  # what it changes is said by others
            case FlightEnded():
                self.ended = (document,)
            case _:
                assert_never(document)

    def routes(self) -> list[LeaderRoute]:
        """What each pursuer expects of its leader now."""
        return [d for _, d in self._states.values() if isinstance(d, LeaderRoute)]

    def find(self, kind: type[D], ident: str) -> D | None:
        """The last document of a kind, of an aircraft; `None` if there is none that stands."""
        found = (d for _, d in self._states.values() if isinstance(d, kind) and d.ident == ident)
        return next(found, None)

    def documents(self) -> list[Document]:
        """The snapshot, in the order of the flight: what holds now, the trail, this instant."""
        past = [s for s in self._trail if not any(s[1] is newest for newest in self.newest)]
        numbered = [*self._states.values(), *self._happenings, *past]
        in_order = sorted(numbered, key=itemgetter(0))
        return [*self.started, *(d for _, d in in_order), *self.newest, *self.ended]

    def _hold(self, document: Document, *place: str) -> None:
        self._states[place] = (self._count, document)
