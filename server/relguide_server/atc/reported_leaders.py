"""Leaders that are reported and not simulated: told to their flights each second."""

import time
from collections.abc import Callable
from math import ceil, cos, sin

from relguide.atc.reported import Reported, seen_on
from relguide.flying.orders import LeaderData, LeaderReport
from relguide.kernels.base.angles import wrap
from relguide.planning.frames import LocalPlane
from relguide.units import Second
from relguide_server.atc.reports import Reports
from relguide_server.atc.skies import Skies
from relguide_server.flights.live_fleet import LiveFleet
from relguide_server.flights.live_flight import LiveFlight
from relguide_server.flights.reported_leader import ReportedPlace

SILENT: Second = 10.0
"""After so long without a report nothing is heard of a leader: its flight is told so."""
USUAL_LEVEL = 9_449.0
"""Of a leader whose height nobody reports [m]: that of flights that give none."""


class ReportedLeaders:
    """Passes reports to the flights that follow them. Lives on the event loop."""

    def __init__(
        self,
        fleet: LiveFleet,
        reports: Reports,
        skies: Skies,
        clock: Callable[[], float] = time.time,
    ) -> None:
        """Make it.

        Args:
            fleet: all flights.
            reports: what others report.
            skies: say when a flight began by UTC.
            clock: tells UTC.
        """
        self._fleet, self._reports, self._skies, self._clock = fleet, reports, skies, clock
        self._silent: set[str] = set()
        """Flights that were told that nothing is heard."""

    def place(self, ident: str) -> ReportedPlace | None:
        """Where an aircraft is now; `None` if nothing is heard of it."""
        report = self._report(ident)
        if report is None:
            return None
        ahead = self._clock() - report.t
        plane = LocalPlane(report.lat_deg, report.lon_deg)
        way = report.ground_speed * ahead
        lat, lon = plane.to_geodetic(way * sin(report.track), way * cos(report.track))
        altitude = report.altitude
        return ReportedPlace(
            lat_deg=lat,
            lon_deg=lon,
            track=report.track,
            ground_speed=report.ground_speed,
            altitude=None if altitude is None else altitude + report.climb * ahead,
        )

    def pass_second(self) -> None:
        """Tell each flight behind a reported leader where that will be."""
        following = [one for one in self._fleet if one.label.reported_leader and not one.over]
        self._silent &= {one.label.id for one in following}
        for flight in following:
            self._tell(flight)

    def _tell(self, flight: LiveFlight) -> None:
        report, plane, ids = (
            self._report(flight.label.reported_leader),
            flight.label.plane,
            flight.label.id,
        )
        if report is None or plane is None:
            if ids not in self._silent:
                self._silent.add(ids)
                flight.command(LeaderData(received=False))
            return
        if ids in self._silent:
            self._silent.remove(ids)
            flight.command(LeaderData(received=True))
        (seen,) = seen_on(plane, [report])
        if seen is None:
            return  # too far away to lie on its plane: the flight ends at the edge of that
        begun = self._skies.begun(flight)

        def report_at(t: Second) -> LeaderReport:
            """What is heard at flight time t holds from the next full second, for its end."""
            ahead = begun + ceil(t) + 1.0 - seen.t
            return LeaderReport(
                x=seen.x + seen.ground_speed * ahead * sin(seen.track),
                y=seen.y + seen.ground_speed * ahead * cos(seen.track),
                track=wrap(seen.track),
                ground_speed=seen.ground_speed,
                altitude=USUAL_LEVEL
                if seen.altitude is None
                else seen.altitude + seen.climb * ahead,
            )

        flight.command_then(report_at)

    def _report(self, ident: str) -> Reported | None:
        """What is heard of an aircraft; `None` after silence."""
        now = self._clock()
        heard = self._reports.heard(now).get(ident)
        return None if heard is None or now - heard.report.t > SILENT else heard.report
