"""A clearance in forms that others read: GeoJSON (RFC 7946), CZML, KML 2.2, CSV.

Each says which clearance it is, in which state, of which relguide, and when by the wall clock. In
the sky of a flight that is so as if it went on at rate 1 from when the clearance was asked for.
"""

import csv
import io
from dataclasses import dataclass
from datetime import datetime
from math import ceil, hypot
from typing import Any, Literal
from xml.etree import ElementTree

import numpy as np
from pydantic_core import to_json

from relguide.atc.documents import ClearanceCard, PairCard, TrackCard
from relguide.contract.document_models import Placed
from relguide.contract.geojson import DECIMALS, STRIDE, line_geometry
from relguide.contract.moments import moment
from relguide.planning.frames import LocalPlane
from relguide.units import Second

ClearanceForm = Literal["geojson", "czml", "kml", "csv"]
KML, GX = "http://www.opengis.net/kml/2.2", "http://www.google.com/kml/ext/2.2"
SHIFTS = 20
"""Each leaves a share of what the last one was off by: a tenth or so, 600 km away at 60° N."""
COLOURS = {"aircraft": (100, 190, 255), "traffic": (255, 255, 255)}
"""Of who asks, and of who is followed: red, green, blue."""
COLUMNS = (
    "ident", "role", "t_s", "at", "x_m", "y_m", "lat_deg", "lon_deg", "altitude_m",
    "clearance_id", "state", "relguide_version",
)  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class Route:
    """Where an aircraft is expected, point by point."""

    ident: str
    role: Literal["aircraft", "traffic"]
    """`aircraft`: who asks; `traffic`: behind whom."""
    t: list[float]
    """In the time of its sky [s]."""
    at: list[str]
    """By the wall clock."""
    x: list[float]
    """East [m]."""
    y: list[float]
    """North [m]."""
    altitude: list[float]
    """[m]; empty where it is not known."""

    def places(self, plane: LocalPlane) -> list[list[float]]:
        """Longitude, latitude [°], and altitude [m] where it is known, of each point."""
        lat, lon = plane.to_geodetic_each(np.array(self.x), np.array(self.y))
        columns = [np.round(lon, DECIMALS).tolist(), np.round(lat, DECIMALS).tolist()]
        if self.altitude:
            columns.append([round(height, 1) for height in self.altitude])
        return [list(point) for point in zip(*columns, strict=True)]


def export_clearance(
    card: ClearanceCard, plane: LocalPlane | None, form: ClearanceForm, *, version: str
) -> bytes:
    """A clearance as a file.

    Args:
        card: the clearance.
        plane: how its sky lies on the earth; `None` if it lies nowhere.
        form: what to write.
        version: of relguide.

    Raises:
        ValueError: if the form needs a place on the earth, and there is none.
    """
    about = {
        "clearance_id": card.id,
        "relguide_version": version,
        "state": card.state,
        "asked_at": card.history[0].at,
        "text": card.text,
    }
    routes = routes_of(card)
    if form == "csv":
        return _csv(card, routes, plane, version)
    if plane is None:
        raise ValueError(f"This clearance lies nowhere on the earth: {form} needs latitudes.")
    match form:
        case "geojson":
            return _geojson(card, routes, plane, about)
        case "czml":
            return _czml(card, routes, plane, about)
        case "kml":
            return _kml(card, routes, plane, about)


def plane_of(card: ClearanceCard) -> LocalPlane | None:
    """How the sky of a clearance that was read back lies on the earth, by its own first place.

    `None` if it came without latitudes.
    """
    if not isinstance(card.route, Placed):
        return None
    x, y = card.route.x[0], card.route.y[0]
    lat, lon = card.route.lat_deg[0], card.route.lon_deg[0]
    middle = LocalPlane(*LocalPlane(lat, lon).to_geodetic(-x, -y))
    for _ in range(SHIFTS):
        # how far the place is off moves the middle
        off = middle.to_local(lat, lon)
        middle = LocalPlane(*middle.to_geodetic(off[0] - x, off[1] - y))
    return middle


def routes_of(card: ClearanceCard) -> tuple[Route, Route]:
    """Of who asks, and of who is followed."""
    return (
        _route(card, card.route, card.aircraft, "aircraft"),
        _route(card, card.leader_route, card.traffic_id, "traffic"),
    )


def wall_clock(card: ClearanceCard, t: Second) -> Second:
    """A time of a clearance's sky as UTC [s]."""
    first = card.history[0]
    return t - first.t + datetime.fromisoformat(first.at).timestamp() if card.sky else t


def _route(
    card: ClearanceCard, track: TrackCard, ident: str, role: Literal["aircraft", "traffic"]
) -> Route:
    """The lines of a track by points so close that chords on the earth stray by metres at most."""
    t = [track.t[0]]
    for k in range(len(track.t) - 1):
        apart = hypot(track.x[k + 1] - track.x[k], track.y[k + 1] - track.y[k])
        steps = max(ceil(apart / STRIDE), 1)
        span = track.t[k + 1] - track.t[k]
        t += [track.t[k] + span * (step + 1) / steps for step in range(steps)]
    return Route(
        ident=ident,
        role=role,
        t=[round(value, 3) for value in t],
        at=[moment(wall_clock(card, value)) for value in t],
        x=np.interp(t, track.t, track.x).tolist(),
        y=np.interp(t, track.t, track.y).tolist(),
        altitude=np.interp(t, track.t, track.altitude).tolist() if track.altitude else [],
    )


def _csv(
    card: ClearanceCard, routes: tuple[Route, Route], plane: LocalPlane | None, version: str
) -> bytes:
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(COLUMNS)
    for route in routes:
        places = route.places(plane) if plane else [["", ""]] * len(route.t)
        for k, (t, at) in enumerate(zip(route.t, route.at, strict=True)):
            lon, lat = places[k][:2]
            x, y = round(route.x[k], 3), round(route.y[k], 3)
            height = round(route.altitude[k], 1) if route.altitude else ""
            rows.writerow([route.ident, route.role, t, at, x, y, lat, lon, height,
                           card.id, card.state, version])  # fmt: skip
    return text.getvalue().encode()


def _geojson(
    card: ClearanceCard, routes: tuple[Route, Route], plane: LocalPlane, about: dict[str, str]
) -> bytes:
    features = [
        {
            "type": "Feature",
            "id": route.role,
            "properties": {
                "ident": route.ident, "role": route.role, "t_s": route.t, "at": route.at
            },
            "geometry": line_geometry(route.places(plane)),
        }
        for route in routes
    ]  # fmt: skip
    features += [_closest(card, pair, plane) for one in card.validation for pair in one.pairs]
    return to_json({"type": "FeatureCollection", **about, "features": features})


def _closest(card: ClearanceCard, pair: PairCard, plane: LocalPlane) -> dict[str, Any]:
    """Where the manoeuvre comes closest to another aircraft: a line from the one to the other."""
    ends = []
    for place in (pair.own, pair.other):
        lat, lon = plane.to_geodetic(place.x, place.y)
        ends.append([round(lon, DECIMALS), round(lat, DECIMALS)])
    return {
        "type": "Feature",
        "id": f"closest-{pair.ident}",
        "properties": {
            "ident": pair.ident,
            "role": "closest",
            "least_m": round(pair.least, 1),
            "minimum_m": round(pair.minimum, 1),
            "certainty": pair.certainty,
            "t_s": round(pair.at, 3),
            "at": moment(wall_clock(card, pair.at)),
        },
        "geometry": line_geometry(ends),
    }


def _czml(
    card: ClearanceCard, routes: tuple[Route, Route], plane: LocalPlane, about: dict[str, str]
) -> bytes:
    begin = min(route.at[0] for route in routes)
    span = f"{begin}/{max(route.at[-1] for route in routes)}"
    document = {
        "id": "document",
        "name": card.text,
        "version": "1.0",
        "clock": {"interval": span, "currentTime": begin, "multiplier": 10},
    }
    moving = [
        {
            "id": route.ident,
            "name": route.ident,
            "availability": f"{route.at[0]}/{route.at[-1]}",
            "properties": about,  # the document itself may have none
            "position": {
                "epoch": route.at[0],
                "cartographicDegrees": [
                    value
                    for t, (lon, lat, *height) in zip(route.t, route.places(plane), strict=True)
                    for value in (round(t - route.t[0], 3), lon, lat, *(height or [0.0]))
                ],
            },
            "point": {"pixelSize": 8, "color": {"rgba": [*COLOURS[route.role], 255]}},
            "label": {"text": route.ident, "pixelOffset": {"cartesian2": [12, -12]}},
            "path": {
                "width": 2,
                "material": {"solidColor": {"color": {"rgba": [*COLOURS[route.role], 255]}}},
            },
        }
        for route in routes
    ]
    return to_json([document, *moving])


def _kml(
    card: ClearanceCard, routes: tuple[Route, Route], plane: LocalPlane, about: dict[str, str]
) -> bytes:
    root = ElementTree.Element("kml", {"xmlns": KML, "xmlns:gx": GX})
    document = ElementTree.SubElement(root, "Document")
    _texts(document, name=card.text)
    extended = ElementTree.SubElement(document, "ExtendedData")
    for name, value in about.items():
        _texts(ElementTree.SubElement(extended, "Data", {"name": name}), value=value)
    for route in routes:
        placemark = ElementTree.SubElement(document, "Placemark", {"id": route.role})
        _texts(placemark, name=route.ident)
        _texts(ElementTree.SubElement(placemark, "TimeSpan"), begin=route.at[0], end=route.at[-1])
        line = ElementTree.SubElement(ElementTree.SubElement(placemark, "Style"), "LineStyle")
        red, green, blue = COLOURS[route.role]
        _texts(line, color=f"ff{blue:02x}{green:02x}{red:02x}", width="2")
        track = ElementTree.SubElement(placemark, "gx:Track")
        _texts(track, altitudeMode="absolute" if route.altitude else "clampToGround")
        for at in route.at:
            _texts(track, when=at)
        for lon, lat, *height in route.places(plane):
            _texts(track, **{"gx:coord": f"{lon} {lat} {height[0] if height else 0}"})
    ElementTree.indent(root)
    said: bytes = ElementTree.tostring(root, "utf-8", xml_declaration=True)
    return said


def _texts(parent: ElementTree.Element, **texts: str) -> None:
    """Give an element children that hold texts."""
    for name, text in texts.items():
        ElementTree.SubElement(parent, name).text = text
