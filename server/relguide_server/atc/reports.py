"""The picture that others give: each source's aircraft and airspaces, the newest report of each.

A source is who puts `/traffic`, or a feed. Where several report an aircraft of one ident, the
newest report counts. What nobody reports for a minute is gone.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from threading import Lock
from typing import Annotated, NamedTuple

from fastapi import Depends
from starlette.requests import HTTPConnection

from relguide.atc.picture import Airspace, Seen
from relguide.atc.reported import Reported, ReportedAirspace, airspace_on, seen_on
from relguide.contract.traffic_bodies import MAX_AIRCRAFT, OLDEST
from relguide.planning.frames import LocalPlane
from relguide.units import Second

MOST_SOURCES = 32
"""Sources that may report at once, feeds aside."""


class Source(NamedTuple):
    """Who reports."""

    owner: str
    """As access knows who asks; empty for who may command all flights, and for feeds."""
    name: str
    """What it calls itself; of a feed its address."""
    feed: bool = False


class Heard(NamedTuple):
    """The newest report of an aircraft."""

    report: Reported
    source: Source
    also: tuple[Source, ...] = ()
    """Who reported it as well, not as lately."""


@dataclass(slots=True)
class _Said:
    """What a source said."""

    aircraft: dict[str, Reported] = field(default_factory=dict)
    airspaces: tuple[ReportedAirspace, ...] = ()


class Reports:
    """What all sources said. May be asked from any thread."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._placing = Lock()
        """Beside the other, as it is held for longer: thousands are placed in 0.2 s."""
        self._said: dict[Source, _Said] = {}
        self._plane: LocalPlane | None = None
        self._seen: dict[str, tuple[Reported, Seen | None]] = {}
        self._closed: dict[ReportedAirspace, Airspace | None] = {}

    def has_room(self, source: Source) -> bool:
        """Whether that source reports already, or one more may."""
        with self._lock:
            others = sum(not known.feed for known in self._said)
            return source in self._said or others < MOST_SOURCES

    def replace_aircraft(self, source: Source, reports: Sequence[Reported]) -> None:
        """Take all aircraft that a source reports now in place of those before."""
        with self._lock:
            self._of(source).aircraft = {one.ident: one for one in reports}
            self._tidy(source)

    def replace_airspaces(self, source: Source, airspaces: Sequence[ReportedAirspace]) -> None:
        """Take all airspaces that a source reports now in place of those before."""
        with self._lock:
            self._of(source).airspaces = tuple(airspaces)
            self._tidy(source)

    def hear(self, source: Source, report: Reported) -> bool:
        """Take what a source reports of one aircraft; `False` if it said later things of it."""
        with self._lock:
            aircraft = self._of(source).aircraft
            known = aircraft.get(report.ident)
            if known is not None and known.t > report.t:
                return False
            if known is None and len(aircraft) >= MAX_AIRCRAFT:
                return False
            aircraft[report.ident] = report
            return True

    def drop(self, source: Source, ident: str) -> None:
        """Forget an aircraft that a source says has gone."""
        with self._lock:
            self._of(source).aircraft.pop(ident, None)

    def forget_aircraft(self, source: Source) -> bool:
        """Forget all aircraft of a source; `False` if it reported none."""
        with self._lock:
            said = self._said.get(source)
            if said is None or not said.aircraft:
                return False
            said.aircraft = {}
            self._tidy(source)
            return True

    def forget_airspaces(self, source: Source) -> bool:
        """Forget all airspaces of a source; `False` if it reported none."""
        with self._lock:
            said = self._said.get(source)
            if said is None or not said.airspaces:
                return False
            said.airspaces = ()
            self._tidy(source)
            return True

    def heard(self, now: Second) -> dict[str, Heard]:
        """The newest report of each aircraft that is not forgotten, by its ident.

        Args:
            now: UTC [s].
        """
        newest: dict[str, Heard] = {}
        with self._lock:
            for source, said in list(self._said.items()):
                gone = [one.ident for one in said.aircraft.values() if one.t < now - OLDEST]
                for ident in gone:
                    del said.aircraft[ident]
                self._tidy(source)
                for ident, one in said.aircraft.items():
                    known = newest.get(ident)
                    if known is None:
                        newest[ident] = Heard(one, source)
                    elif one.t > known.report.t:
                        newest[ident] = Heard(one, source, (known.source, *known.also))
                    else:
                        newest[ident] = known._replace(also=(*known.also, source))
        return newest

    def aircraft(self, plane: LocalPlane, now: Second) -> tuple[Seen, ...]:
        """All aircraft of the picture on the plane of a sky, each where it was last seen.

        Args:
            plane: of the sky.
            now: UTC [s].
        """
        wanted = [heard.report for heard in self.heard(now).values()]
        with self._placing:
            self._turn_to(plane)
            known = self._seen
            new = [one for one in wanted if known.get(one.ident, (None,))[0] is not one]
            if new:
                placed = zip(new, seen_on(plane, new), strict=True)
                known |= {one.ident: (one, seen) for one, seen in placed}
            self._seen = {one.ident: known[one.ident] for one in wanted}
            return tuple(seen for _, seen in self._seen.values() if seen is not None)

    def airspaces(self, plane: LocalPlane) -> tuple[Airspace, ...]:
        """All airspaces on the plane of a sky; those whose time has not come, or is over, too."""
        wanted = [one for _, one in self.airspaces_reported()]
        with self._placing:
            self._turn_to(plane)
            self._closed = {
                one: self._closed[one] if one in self._closed else airspace_on(plane, one)
                for one in wanted
            }
            return tuple(one for one in self._closed.values() if one is not None)

    def airspaces_reported(self) -> list[tuple[Source, ReportedAirspace]]:
        """All airspaces as they are reported, and by whom."""
        with self._lock:
            return [(source, one) for source, said in self._said.items() for one in said.airspaces]

    def _of(self, source: Source) -> _Said:
        return self._said.setdefault(source, _Said())

    def _tidy(self, source: Source) -> None:
        """A source that says nothing takes no room."""
        if self._said[source] == _Said():
            del self._said[source]

    def _turn_to(self, plane: LocalPlane) -> None:
        """What was placed on another plane is of no use."""
        if plane != self._plane:
            self._plane, self._seen, self._closed = plane, {}, {}


async def reports_of(connection: HTTPConnection) -> Reports:
    """The reports of the app that serves this connection."""
    reports: Reports = connection.app.state.reports
    return reports


ReportsOf = Annotated[Reports, Depends(reports_of)]
"""How a route asks for them."""
