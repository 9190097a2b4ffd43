"""What several sources say of the sky: the newest counts, what is old is forgotten."""

from math import inf

import pytest
from relguide_server.atc.reports import MOST_SOURCES, Reports, Source

from relguide.atc.reported import Reported, ReportedAirspace
from relguide.contract.traffic_bodies import MAX_AIRCRAFT, OLDEST
from relguide.planning.frames import LocalPlane

PLANE = LocalPlane(50.0, 8.0)
ONE, OTHER = Source("", "traffic"), Source("", "radar", feed=True)


def aircraft(ident: str = "BAW12", *, t: float = 100.0, lat: float = 50.0) -> Reported:
    return Reported(ident=ident, t=t, lat_deg=lat, lon_deg=8.0, track=0.0, ground_speed=200.0)


def airspace(ident: str) -> ReportedAirspace:
    return ReportedAirspace(
        ident=ident, lat_deg=(50.0, 50.1, 50.1), lon_deg=(8.0, 8.0, 8.1), low=-inf, high=inf,
        since=-inf, until=inf,
    )  # fmt: skip


def test_a_source_replaces_what_it_said() -> None:
    reports = Reports()
    reports.replace_aircraft(ONE, [aircraft("A"), aircraft("B")])
    reports.replace_aircraft(ONE, [aircraft("B", lat=50.1)])
    (seen,) = reports.aircraft(PLANE, 101.0)
    assert (seen.ident, seen.t) == ("B", 100.0)
    assert (seen.x, seen.y) == pytest.approx(PLANE.to_local(50.1, 8.0))


@pytest.mark.parametrize("first", [ONE, OTHER])
def test_the_newest_report_of_an_aircraft_counts(first: Source) -> None:
    reports, second = Reports(), OTHER if first == ONE else ONE
    reports.hear(first, aircraft(t=103.0, lat=50.3))
    reports.hear(second, aircraft(t=104.0, lat=50.4))
    heard = reports.heard(105.0)["BAW12"]
    assert (heard.source, heard.also, heard.report.lat_deg) == (second, (first,), 50.4)
    # of two at the same time, the one that was heard first
    reports.hear(first, aircraft(t=104.0, lat=50.35))
    assert reports.heard(105.0)["BAW12"].source == first


def test_a_source_does_not_go_back_in_time() -> None:
    reports = Reports()
    assert reports.hear(ONE, aircraft(t=104.0))
    assert not reports.hear(ONE, aircraft(t=103.0))
    assert reports.heard(105.0)["BAW12"].report.t == 104.0


def test_what_is_old_is_forgotten() -> None:
    reports = Reports()
    reports.hear(ONE, aircraft(t=100.0))
    assert reports.aircraft(PLANE, 100.0 + OLDEST)
    assert not reports.aircraft(PLANE, 100.1 + OLDEST)


def test_what_is_placed_follows_each_report_and_each_plane() -> None:
    reports = Reports()
    for lat in (50.0, 50.1):
        reports.replace_aircraft(ONE, [aircraft(lat=lat)])
        for plane in (PLANE, LocalPlane(50.5, 8.0)):
            (seen,) = reports.aircraft(plane, 101.0)
            assert seen.y == pytest.approx(plane.to_local(lat, 8.0)[1])


def test_airspaces_of_all_sources() -> None:
    reports = Reports()
    reports.replace_airspaces(ONE, [airspace("D1"), airspace("D2")])
    reports.replace_airspaces(OTHER, [airspace("D3")])
    assert [one.ident for one in reports.airspaces(PLANE)] == ["D1", "D2", "D3"]
    reports.forget_airspaces(ONE)
    assert [one.ident for one in reports.airspaces(PLANE)] == ["D3"]


def test_sources_are_bounded_and_feeds_are_not_counted() -> None:
    reports = Reports()
    for k in range(MOST_SOURCES):
        source = Source("someone", f"{k}")
        assert reports.has_room(source)
        reports.replace_aircraft(source, [aircraft()])
    assert not reports.has_room(ONE)
    assert reports.has_room(Source("someone", "3"))
    reports.forget_aircraft(Source("someone", "3"))
    assert reports.has_room(ONE)


def test_a_source_whose_aircraft_are_old_takes_no_room() -> None:
    reports = Reports()
    for k in range(MOST_SOURCES):
        reports.replace_aircraft(Source("someone", f"{k}"), [aircraft()])
    assert not reports.heard(101.0 + OLDEST)
    assert reports.has_room(ONE)


def test_a_feed_is_bounded() -> None:
    reports = Reports()
    for k in range(MAX_AIRCRAFT):
        assert reports.hear(OTHER, aircraft(f"A{k}"))
    assert not reports.hear(OTHER, aircraft("B"))
    assert reports.hear(OTHER, aircraft("A1", t=101.0))
