"""Clearances as files, read back by other readers than those that wrote them."""

import csv
import io
import json
from dataclasses import replace
from math import cos, sin, tau
from xml.etree import ElementTree

import pytest
from czml3 import Document, Packet
from pyproj import Geod

from relguide.atc.documents import (
    ClearanceCard,
    PairCard,
    PlaceAt,
    StateChange,
    TrackCard,
    ValidationCard,
)
from relguide.contract.clearance_exports import COLUMNS, export_clearance, plane_of
from relguide.contract.document_models import card_from_wire
from relguide.contract.moments import moment, utc
from relguide.contract.wire import placed_to_wire
from relguide.planning.frames import LocalPlane

PLANE = LocalPlane(50.0, 8.0)
ASKED = "2026-11-23T06:30:00.000Z"
BEGIN = utc(ASKED)
NAMES = {"k": "http://www.opengis.net/kml/2.2", "gx": "http://www.google.com/kml/ext/2.2"}


def clearance(sky: str = "", *, begin: float = BEGIN, heights: bool = True) -> ClearanceCard:
    t = tuple(begin + 60.0 * k for k in range(5))
    turning = [tau * k / 16.0 for k in range(5)]
    own = TrackCard(
        t=t, x=tuple(30e3 * sin(a) for a in turning), y=tuple(30e3 * cos(a) for a in turning),
        altitude=(9000.0,) * 5 if heights else (),
    )  # fmt: skip
    leader = TrackCard(t=(begin, begin + 240.0), x=(40e3, 90e3), y=(0.0, 0.0))
    pair = PairCard(
        ident="BAW12", at=begin + 60.0, least=9000.0, proved_above=8990.0, bound=500.0,
        minimum=9260.0, certainty="certain", own=PlaceAt(t=begin + 60.0, x=0.0, y=0.0),
        other=PlaceAt(t=begin + 60.0, x=9000.0, y=0.0), since=begin + 50.0, until=begin + 70.0,
    )  # fmt: skip
    found = ValidationCard(
        verdict="unable", findings=(), pairs=(pair,), alternatives=(), valid_until=begin,
        computed=begin, picture_as_of=begin, aircraft=1,
    )  # fmt: skip
    asked = StateChange(state="validating", t=begin, at=ASKED, by="crew", message="")
    return ClearanceCard(
        id="3f2a9c0d71be", sky=sky, aircraft="AIB01", traffic_id="AIB02", spacing_type="distance",
        slot_distance=12e3, min_separation=9260.0, word="LSR", text='REQUEST "BEHIND" <AIB02>',
        state="unable", due=0.0, joins=begin + 240.0, route=own, leader_route=leader,
        validation=(found,), deviations=(), history=(asked,), auto_answer=False,
    )  # fmt: skip


def far(lon: float, lat: float, x: float, y: float) -> float:
    """How far a place on the earth is from one of the plane [m]."""
    other_lat, other_lon = PLANE.to_geodetic(x, y)
    return float(Geod(ellps="WGS84").inv(lon, lat, other_lon, other_lat)[2])


def test_geojson() -> None:
    said = json.loads(export_clearance(clearance(), PLANE, "geojson", version="0.2.0"))
    assert (said["clearance_id"], said["relguide_version"]) == ("3f2a9c0d71be", "0.2.0")
    assert (said["asked_at"], said["state"]) == (ASKED, "unable")
    own, leader, closest = said["features"]
    assert own["properties"]["ident"] == "AIB01"
    assert own["properties"]["at"][0] == ASKED
    assert own["properties"]["at"][-1] == moment(BEGIN + 240.0)
    points = own["geometry"]["coordinates"]
    assert len(points) == len(own["properties"]["t_s"])
    assert far(*points[0][:2], 0.0, 30e3) < 0.05
    assert far(*points[-1][:2], 30e3, 0.0) < 0.05
    assert {point[2] for point in points} == {9000.0}
    assert len(leader["geometry"]["coordinates"][0]) == 2  # its height is not known
    assert closest["properties"]["least_m"] == 9000.0
    assert far(*closest["geometry"]["coordinates"][1], 9000.0, 0.0) < 0.05


def test_czml_is_read_by_another_reader() -> None:
    said = export_clearance(clearance(), PLANE, "czml", version="0.2.0")
    document = Document(packets=[Packet(**packet) for packet in json.loads(said)])
    about, own, leader = document.packets
    assert about.clock.interval.start == ASKED
    assert (own.id, leader.id) == ("AIB01", "AIB02")
    assert own.properties["clearance_id"] == "3f2a9c0d71be"
    values = own.position.cartographicDegrees.values
    assert values[0] == 0.0
    assert values[-4] == 240.0
    assert far(*values[-3:-1], 30e3, 0.0) < 0.05


def test_kml() -> None:
    root = ElementTree.fromstring(export_clearance(clearance(), PLANE, "kml", version="0.2.0"))
    assert root.findtext("k:Document/k:name", namespaces=NAMES) == 'REQUEST "BEHIND" <AIB02>'
    data = {
        one.get("name"): one.findtext("k:value", namespaces=NAMES)
        for one in root.findall("k:Document/k:ExtendedData/k:Data", NAMES)
    }
    assert data["clearance_id"] == "3f2a9c0d71be"
    assert data["asked_at"] == ASKED
    own, leader = root.findall("k:Document/k:Placemark", NAMES)
    assert own.findtext("k:name", namespaces=NAMES) == "AIB01"
    whens = [one.text for one in own.findall("gx:Track/k:when", NAMES)]
    places = [one.text for one in own.findall("gx:Track/gx:coord", NAMES)]
    assert len(whens) == len(places) > 5
    assert (whens[0], whens[-1]) == (ASKED, moment(BEGIN + 240.0))
    lon, lat, height = (float(part) for part in str(places[-1]).split())
    assert far(lon, lat, 30e3, 0.0) < 0.05
    assert height == 9000.0
    assert leader.findtext("gx:Track/k:altitudeMode", namespaces=NAMES) == "clampToGround"


@pytest.mark.parametrize("plane", [PLANE, None])
def test_csv(plane: LocalPlane | None) -> None:
    said = export_clearance(clearance(), plane, "csv", version="0.2.0").decode()
    rows = list(csv.DictReader(io.StringIO(said)))
    assert tuple(rows[0]) == COLUMNS
    assert {row["ident"] for row in rows} == {"AIB01", "AIB02"}
    assert rows[0]["at"] == ASKED
    assert float(rows[0]["y_m"]) == 30e3
    assert (rows[0]["lat_deg"] == "") == (plane is None)
    assert {row["clearance_id"] for row in rows} == {"3f2a9c0d71be"}


def test_a_clearance_of_a_flight_has_the_wall_clock_of_its_request() -> None:
    card = clearance("0123456789ab", begin=500.0)
    said = json.loads(export_clearance(card, PLANE, "geojson", version="0.2.0"))
    own = said["features"][0]["properties"]
    assert own["t_s"][0] == 500.0
    assert own["at"][0] == ASKED
    assert said["features"][2]["properties"]["at"] == moment(BEGIN + 60.0)


def test_chords_on_the_earth_stray_by_metres() -> None:
    said = json.loads(export_clearance(clearance(), PLANE, "geojson", version="0.2.0"))
    (first, second, *_) = said["features"][1]["geometry"]["coordinates"]
    x, y = PLANE.to_local(0.5 * (first[1] + second[1]), 0.5 * (first[0] + second[0]))
    assert abs(y) < 3.0
    assert x > 40e3


def test_what_lies_nowhere_has_no_place() -> None:
    for form in ("geojson", "czml", "kml"):
        with pytest.raises(ValueError, match="lies nowhere on the earth"):
            export_clearance(clearance(), None, form, version="0.2.0")  # type: ignore[arg-type]


@pytest.mark.parametrize("plane", [PLANE, LocalPlane(-70.0, 179.9), LocalPlane(0.0, 0.0)])
def test_how_it_lies_on_the_earth_is_found_again(plane: LocalPlane) -> None:
    far_away = replace(
        clearance(),
        route=TrackCard(t=(BEGIN, BEGIN + 60.0), x=(-400e3, -390e3), y=(300e3, 300e3)),
    )
    card = card_from_wire(ClearanceCard, placed_to_wire(far_away, plane.to_geodetic))
    found = plane_of(card)
    assert found is not None
    assert (found.lat_deg, found.lon_deg) == pytest.approx((plane.lat_deg, plane.lon_deg), abs=1e-7)
    assert plane_of(clearance()) is None
