"""Skies: who flies where, under which name, by which clock, and what they intend."""

import asyncio
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from relguide_server.atc.reports import Reports, Source
from relguide_server.atc.skies import EARTH, Skies
from relguide_server.flights.live_fleet import LiveFleet
from relguide_server.flights.live_flight import LiveFlight
from relguide_server.http.metrics import Metrics
from relguide_server.records.recorder import Recorder
from relguide_server.settings import ServiceSettings

from relguide.atc.reported import Reported
from relguide.atc.track import Track
from relguide.contract.places import UNANCHORED, Anchor
from relguide.contract.refusal import ContractError
from relguide.planning.frames import LocalPlane
from tests.server.flown import LEADER, OWN, ideal_flight

NOW = 1_800_000_000.0
HERE = LocalPlane(50.0, 8.0)


class Aloft:
    """A fleet, what is reported, and their skies."""

    def __init__(self) -> None:
        self.fleet = LiveFleet(ServiceSettings(), Metrics())
        self.reports = Reports()
        self.now = NOW
        self.skies = Skies(self.fleet, self.reports, lambda: self.now)

    async def launch(self, anchor: Anchor = UNANCHORED, rate: float = 1.0) -> LiveFlight:
        def source(commands: Any) -> Iterator[Any]:
            return ideal_flight(commands, duration=60.0)

        return await self.fleet.launch(
            "ideal", "Ideal", source, rate=rate, paused=False,
            record=lambda name: Recorder(NOW), anchor=anchor,
        )  # fmt: skip

    def report(self, ident: str, lat: float, lon: float) -> None:
        one = Reported(
            ident=ident, t=self.now, lat_deg=lat, lon_deg=lon, track=0.0, ground_speed=200.0
        )
        self.reports.replace_aircraft(Source("", ident), [one])


def fly(check: Callable[[Aloft], Any]) -> None:
    async def run() -> None:
        aloft = Aloft()
        try:
            await check(aloft)
        finally:
            await aloft.fleet.stop()

    asyncio.run(run())


def test_a_flight_without_a_place_has_its_own_sky_and_time() -> None:
    async def check(aloft: Aloft) -> None:
        flight = await aloft.launch()
        name = flight.label.id
        assert aloft.skies.of(flight) == name
        assert list(aloft.skies.each()) == [EARTH, name]
        assert aloft.skies.now(name) == flight.t < 10.0
        picture = aloft.skies.picture(name, {})
        assert {one.ident for one in picture.aircraft} == {OWN, LEADER}
        assert aloft.skies.picture(EARTH, {}).aircraft == ()
        assert aloft.skies.plane(name) is None

    fly(check)


@pytest.mark.parametrize(
    ("anchor", "rate", "shares"),
    [
        (HERE, 1.0, True),
        (HERE, 2.0, False),
        (UNANCHORED, 1.0, False),
        (LocalPlane(50.0, 40.0), 1.0, False),  # 2,300 km from where the sky lies
    ],
)
def test_who_shares_the_sky_on_the_earth(anchor: Anchor, rate: float, shares: bool) -> None:
    async def check(aloft: Aloft) -> None:
        await aloft.launch(HERE)
        assert aloft.skies.plane(EARTH) == HERE
        flight = await aloft.launch(anchor, rate)
        assert (aloft.skies.of(flight) == EARTH) is shares
        flight.pace.pause()
        assert aloft.skies.of(flight) == flight.label.id

    fly(check)


def test_each_aircraft_has_a_name_of_its_own_and_keeps_it() -> None:
    async def check(aloft: Aloft) -> None:
        first, second = [await aloft.launch(HERE) for _ in range(2)]
        assert aloft.skies.name(first, OWN) == OWN
        other = aloft.skies.name(second, OWN)
        assert other == f"{OWN} {second.label.id[:5]}"
        idents = [one.ident for one in aloft.skies.picture(EARTH, {}).aircraft]
        assert len(idents) == len(set(idents)) == 4
        aloft.skies.look(keep_earth=False)
        assert aloft.skies.name(second, OWN) == other

    fly(check)


def test_reports_fly_among_flights_and_a_flight_knows_itself_better() -> None:
    async def check(aloft: Aloft) -> None:
        await aloft.launch(HERE)
        aloft.report("BAW12", 50.1, 8.1)
        aloft.report(OWN, 50.1, 8.1)
        seen = {one.ident: one for one in aloft.skies.picture(EARTH, {}).aircraft}
        assert set(seen) == {OWN, LEADER, "BAW12"}
        x, y = HERE.to_local(50.1, 8.1)
        assert (seen["BAW12"].x, seen["BAW12"].y) == pytest.approx((x, y), abs=0.1)
        assert abs(seen[OWN].x - x) > 1_000.0
        assert seen[OWN].t == pytest.approx(NOW, abs=0.5)

    fly(check)


def test_what_is_cleared_is_what_it_intends() -> None:
    async def check(aloft: Aloft) -> None:
        aloft.report("BAW12", 50.0, 8.0)
        path = Track(
            t=np.array([NOW, NOW + 100.0]), x=np.array([0.0, 1e4]), y=np.zeros(2),
            low=np.zeros(2), high=np.zeros(2), error=0.0,
        )  # fmt: skip
        cleared = aloft.skies.picture(EARTH, {"BAW12": path, "UNSEEN": path})
        seen = {one.ident: one for one in cleared.aircraft}
        assert seen["BAW12"].path is path
        assert seen["BAW12"].cleared
        assert (seen["UNSEEN"].x, seen["UNSEEN"].ground_speed) == pytest.approx((0.0, 100.0))
        assert aloft.skies.picture(EARTH, {}) is cleared  # of the same instant
        aloft.skies.forget_pictures()
        assert {one.ident for one in aloft.skies.picture(EARTH, {}).aircraft} == {"BAW12"}

    fly(check)


def test_the_sky_lies_where_it_is_flown_in_and_stays_while_it_is() -> None:
    async def check(aloft: Aloft) -> None:
        assert aloft.skies.plane(EARTH) is None
        x, y, _ = aloft.skies.place(10.0, 20.0, "aircraft")
        assert (x, y) == pytest.approx((0.0, 0.0), abs=1e-6)
        with pytest.raises(ContractError, match=r"aircraft\.lat_deg"):
            aloft.skies.place(50.0, 8.0, "aircraft")
        aloft.skies.look(keep_earth=True)
        assert aloft.skies.plane(EARTH) == LocalPlane(10.0, 20.0)
        aloft.skies.look(keep_earth=False)
        aloft.report("BAW12", 50.0, 8.0)
        plane = aloft.skies.plane(EARTH)
        assert plane is not None
        assert (plane.lat_deg, plane.lon_deg) == pytest.approx((50.0, 8.0))

    fly(check)
