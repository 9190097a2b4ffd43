"""Skies: who flies in each, on one plane and by one clock.

The one on the earth is called "". Its clock is UTC, and there are all flights that have a place on
the earth and are flown at rate 1, and all that is reported. Each other flight has a sky of its own,
called as the flight is, with its flight time.
"""

import asyncio
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from relguide.atc.of_flight import (
    LinkNews,
    Placing,
    forecast_track,
    leader_track,
    manoeuvre_of,
    seen_in_flight,
    situation_of,
)
from relguide.atc.picture import Picture, Seen
from relguide.atc.request import Manoeuvre
from relguide.atc.track import Track
from relguide.contract.places import place_near
from relguide.contract.refusal import ContractError
from relguide.flying.aircraft_documents import AircraftSample, LinkCard
from relguide.flying.documents import AssignmentChanged, ForecastChanged, PlanChanged, PlanProposed
from relguide.planning.frames import LocalPlane, middle_of
from relguide.planning.situation import Situation
from relguide.units import MetrePerSecond, Second
from relguide_server.atc.reports import Reports
from relguide_server.flights.live_fleet import LiveFleet
from relguide_server.flights.live_flight import LiveFlight
from relguide_server.http.errors import Refusal

EARTH = ""
"""The sky on the earth."""
LATE: Second = 1.0
"""A flight whose time runs behind by more than this is taken to be so late from then on [s]."""
CLIMBS: MetrePerSecond = 0.5
"""An aircraft that climbs or descends faster changes its level."""
FRESH: Second = 0.2
"""A picture of the same instant is not made twice [s]."""


class Place(NamedTuple):
    """An aircraft of a flight in its sky."""

    flight: LiveFlight
    aircraft: AircraftSample
    name: str


class Skies:
    """All skies. Lives on the event loop."""

    def __init__(
        self, fleet: LiveFleet, reports: Reports, clock: Callable[[], float] = time.time
    ) -> None:
        """Make them.

        Args:
            fleet: all flights of the service.
            reports: what others report.
            clock: tells UTC.
        """
        self._fleet, self._reports, self._clock = fleet, reports, clock
        self._plane: LocalPlane | None = None
        self._begun: dict[str, Second] = {}
        """UTC at flight time 0."""
        self._names: dict[tuple[str, str], str] = {}
        self._levels: dict[tuple[str, str], tuple[Second, float, MetrePerSecond]] = {}
        """When an aircraft was at which altitude, and how fast it climbed till then."""
        self._tracks: dict[tuple[str, str, str], tuple[tuple[object, ...], Track]] = {}
        self._pictures: dict[str, tuple[float, Picture]] = {}

    # -- where and when ---------------------------------------------------------------------------

    def each(self) -> Iterator[str]:
        """All skies that somebody flies in, that on the earth first."""
        own = [flight.label.id for flight in self._flying() if self.of(flight) != EARTH]
        yield EARTH
        yield from own

    def of(self, flight: LiveFlight) -> str:
        """The sky of a flight."""
        plane, pace = flight.label.plane, flight.pace
        if plane is None or flight.label.replay or pace.paused or pace.rate != 1.0:
            return flight.label.id
        return EARTH if self._is_near(plane) else flight.label.id

    def now(self, sky: str) -> Second:
        """The time of a sky [s]; that of one which is gone stands still at 0."""
        if sky == EARTH:
            return self._clock()
        flight = self.flight(sky)
        return 0.0 if flight is None else flight.t

    def plane(self, sky: str) -> LocalPlane | None:
        """How a sky lies on the earth; `None` where nobody has said so."""
        if sky == EARTH:
            return self._earth()
        flight = self.flight(sky)
        return None if flight is None else flight.label.plane

    def title(self, sky: str) -> str:
        """Of a sky, for people."""
        flight = self.flight(sky)
        return "All traffic" if flight is None else flight.label.title

    def flight(self, flight_id: str) -> LiveFlight | None:
        """A flight that flies, by its id; it is not noted as seen."""
        return next((one for one in self._flying() if one.label.id == flight_id), None)

    def place(self, lat_deg: float, lon_deg: float, path: str) -> tuple[float, float, float]:
        """A place on the earth in its sky: x, y [m], and what turns a direction there [°].

        Raises:
            ContractError: if it is farther from the sky's middle than a situation reaches.
        """
        if self._earth() is None:
            self._plane = LocalPlane(lat_deg, lon_deg)
        plane = self._earth()
        assert plane is not None
        return place_near(plane, lat_deg, lon_deg, path)

    # -- who --------------------------------------------------------------------------------------

    def look(self, *, keep_earth: bool) -> None:
        """Note how all fly; once a second.

        Args:
            keep_earth: whether clearances live in the sky on the earth, so that it may not move.
        """
        flying = {flight.label.id: flight for flight in self._flying()}
        for flight in flying.values():
            for sample in flight.history.newest:
                for one in sample.aircraft:
                    self._note_level(flight.label.id, one, sample.t)
        for known in (self._names, self._levels, self._tracks):
            for key in [key for key in known if key[0] not in flying]:
                del known[key]  # type: ignore[arg-type]
        self._begun = {one: at for one, at in self._begun.items() if one in flying}
        anybody = keep_earth or any(self.of(flight) == EARTH for flight in flying.values())
        if not anybody and not self._reports.heard(self._clock()):
            self._plane = None

    def places(self, sky: str) -> Iterator[Place]:
        """All aircraft of this service's flights in a sky, each name once."""
        for flight in self._flying():
            if self.of(flight) == sky:
                for sample in flight.history.newest:
                    for one in sample.aircraft:
                        yield Place(flight, one, self.name(flight, one.ident))

    def name(self, flight: LiveFlight, ident: str) -> str:
        """What an aircraft of a flight is called in its sky: with its flight, if others are so."""
        if self.of(flight) != EARTH:
            return ident
        key = (flight.label.id, ident)
        if key not in self._names:
            taken = ident in self._names.values()
            self._names[key] = f"{ident[:18]} {flight.label.id[:5]}" if taken else ident
        return self._names[key]

    def climb(self, flight_id: str, ident: str) -> MetrePerSecond:
        """How fast an aircraft of a flight climbs."""
        _, _, climb = self._levels.get((flight_id, ident), (0.0, 0.0, 0.0))
        return climb

    def forget_pictures(self) -> None:
        """Something of a clearance is new: pictures made before do not hold."""
        self._pictures.clear()

    async def prepare(self, sky: str) -> None:
        """Place what is reported, on a thread: thousands take a tenth of a second."""
        plane = self._plane if sky == EARTH else None
        if plane is not None:
            await asyncio.to_thread(self._reports.aircraft, plane, self.now(sky))

    def picture(self, sky: str, cleared: Mapping[str, Track]) -> Picture:
        """All that fly in a sky now, and what is closed.

        Args:
            sky: which.
            cleared: what aircraft are cleared to fly, by ident: that is what they intend.
        """
        now, wall = self.now(sky), self._clock()
        made = self._pictures.get(sky)
        if made is not None and 0.0 <= wall - made[0] < FRESH:
            return made[1]
        seen = {one.ident: one for one in self._flown(sky)}
        plane = self.plane(sky) if sky == EARTH else None
        if plane is not None:
            seen = {one.ident: one for one in self._reports.aircraft(plane, now)} | seen
        for ident, path in cleared.items():
            known = seen.get(ident)
            if known is None:
                known = _on_path(ident, path, now)
            seen[ident] = replace(known, path=path, cleared=True)
        airspaces = () if plane is None else self._reports.airspaces(plane)
        picture = Picture(as_of=now, aircraft=tuple(seen.values()), airspaces=airspaces)
        self._pictures[sky] = wall, picture
        return picture

    def news(self, flight: LiveFlight, link: LinkCard) -> LinkNews | None:
        """What a flight has said last of one of its links; `None` before its first sample."""
        history, who = flight.history, link.pursuer
        for started, sample in zip(history.started, history.newest, strict=False):
            routes = (one for one in history.routes() if one.expected_by == who)
            ids = flight.label.id
            return LinkNews(
                started=started,
                sample=sample,
                link=link,
                route=next(routes, None),
                plan=history.find(PlanChanged, who),
                proposal=history.find(PlanProposed, who),
                forecast=history.find(ForecastChanged, who),
                assignment=history.find(AssignmentChanged, who),
                climbing=frozenset(
                    one.ident for one in sample.aircraft if abs(self.climb(ids, one.ident)) > CLIMBS
                ),
            )
        return None

    def link(self, flight: LiveFlight, ident: str) -> LinkCard:
        """The link of a pursuer.

        Args:
            flight: which.
            ident: the pursuer's, in its flight or its sky; empty: the first link's.

        Raises:
            ContractError: if nobody of that name pursues anybody.
        """
        links: Sequence[LinkCard] = [one for s in flight.history.started for one in s.links]
        for link in links:
            if ident in ("", link.pursuer, self.name(flight, link.pursuer)):
                return link
        named = " or ".join(link.pursuer for link in links)
        raise ContractError([("aircraft", f"must be a pursuer of this flight: {named}.")])

    def manoeuvre(self, flight: LiveFlight, link: LinkCard) -> Manoeuvre:
        """What a pursuer flies or is proposed, in its sky.

        Raises:
            Refusal: 409, if it is neither.
        """
        news = self.news(flight, link)
        assert news is not None  # no flight is found before its first sample
        pursuer, leader = (self.name(flight, one) for one in (link.pursuer, link.leader))
        try:
            return manoeuvre_of(news, self.placing(flight), pursuer, leader)
        except ValueError as error:
            raise Refusal(409, str(error)) from None

    def situation(self, flight_id: str, ident: str) -> Situation | None:
        """A pursuer behind its leader now, in its sky; `None` if nothing can be planned from it."""
        flight = self.flight(flight_id)
        news = None if flight is None else self.news(flight, self.link(flight, ident))
        if flight is None or news is None:
            return None
        try:
            return situation_of(news, self.placing(flight))
        except ValueError:
            return None

    def placing(self, flight: LiveFlight) -> Placing:
        """How a flight lies in its sky."""
        if self.of(flight) != EARTH:
            return Placing()
        return Placing(later=self.begun(flight), of=flight.label.plane, to=self._earth())

    def begun(self, flight: LiveFlight) -> Second:
        """UTC at flight time 0 of a flight at rate 1, steady from second to second [s]."""
        begun = self._clock() - flight.t
        known = self._begun.get(flight.label.id)
        if known is not None and known <= begun < known + LATE:
            begun = known
        self._begun[flight.label.id] = begun
        return begun

    # -- inside -----------------------------------------------------------------------------------

    def _flying(self) -> Iterator[LiveFlight]:
        return (flight for flight in self._fleet if flight.history.newest and not flight.over)

    def _earth(self) -> LocalPlane | None:
        if self._plane is None:
            self._plane = next((one.label.plane for one in self._flying() if one.label.plane), None)
        if self._plane is None:
            heard = [one.report for one in self._reports.heard(self._clock()).values()]
            if heard:
                lat, lon = zip(*((one.lat_deg, one.lon_deg) for one in heard), strict=True)
                self._plane = middle_of(np.array(lat), np.array(lon))
        return self._plane

    def _is_near(self, plane: LocalPlane) -> bool:
        """Whether a flight is near enough to where the sky on the earth lies."""
        earth = self._earth()
        if earth is None or earth == plane:
            return True
        try:
            place_near(earth, plane.lat_deg, plane.lon_deg, "")
        except ContractError:
            return False
        return True

    def _note_level(self, flight_id: str, one: AircraftSample, t: Second) -> None:
        at, altitude, climb = self._levels.get((flight_id, one.ident), (t, one.altitude, 0.0))
        if t > at:
            climb = (one.altitude - altitude) / (t - at)
        self._levels[flight_id, one.ident] = t, one.altitude, climb

    def _flown(self, sky: str) -> Iterator[Seen]:
        for flight, aircraft, name in self.places(sky):
            (sample,) = flight.history.newest
            yield seen_in_flight(
                aircraft,
                sample.t,
                self.placing(flight),
                name,
                climb=self.climb(flight.label.id, aircraft.ident),
                path=self._path(flight, aircraft.ident),
            )

    def _path(self, flight: LiveFlight, ident: str) -> Track | None:
        """What an aircraft of a flight intends, if it has said so."""
        links = [one for started in flight.history.started for one in started.links]
        for link in links:
            news = self.news(flight, link)
            if news is None:
                continue
            if link.pursuer == ident and news.engaged and news.forecast is not None:
                path = self._track(flight, ident, news, news.forecast, forecast_track)
                if path.end > self.placing(flight).later + flight.t:
                    return path
            if news.route is not None and news.route.ident == ident and news.route.intent_known:
                return self._track(flight, ident, news, news.route, leader_track)
        return None

    def _track(
        self,
        flight: LiveFlight,
        ident: str,
        news: LinkNews,
        source: object,
        make: Callable[[LinkNews, Placing], Track],
    ) -> Track:
        """A track, made once as long as nothing that it is made of changes."""
        placing = self.placing(flight)
        level = next(round(a.altitude) for a in news.sample.aircraft if a.ident == ident)
        made_of = (source, news.plan, placing, level, ident in news.climbing)
        key = (flight.label.id, ident, make.__name__)
        known = self._tracks.get(key)
        if known is not None and known[0] == made_of:
            return known[1]
        track = make(news, placing)
        self._tracks[key] = made_of, track
        return track


def _on_path(ident: str, path: Track, now: Second) -> Seen:
    """An aircraft that nobody reports, where it is cleared to be."""
    x, y = path.place(now)
    east, north = path.velocity(now)
    return Seen(
        ident=ident,
        t=now,
        x=x,
        y=y,
        track=float(np.arctan2(east, north)) % (2.0 * np.pi),
        ground_speed=float(np.hypot(east, north)),
    )
