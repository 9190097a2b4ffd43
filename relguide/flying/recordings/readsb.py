"""Traces of readsb, as tar1090 and ADS-B exchanges serve them: `trace_full_*.json`.

Each point is [seconds since the trace's timestamp, latitude, longitude, altitude [ft] or "ground",
ground speed [kt], track [°], flags, …], and now and then an object with the callsign in place 8.
"""

from math import nan
from typing import Any

from relguide.flying.recordings.cells import GROUND
from relguide.flying.recordings.reports import Report, Reports, reports_of
from relguide.units import FT, KT

DETAILS = 8
"""The place of the object with the callsign."""


def is_trace(content: object) -> bool:
    """Whether JSON looks like it."""
    return isinstance(content, dict) and "trace" in content


def read_trace(content: Any, source: str) -> Reports:
    """The reports of a trace.

    Raises:
        ValueError: naming the point that is none.
    """
    address = str(content.get("icao", "")).strip().lower()
    aircraft_type = str(content.get("t") or "").strip()
    begun, points = content.get("timestamp"), content["trace"]
    if not _is_number(begun) or not isinstance(points, list):
        raise ValueError(f"{source} is no trace: it needs a timestamp and a list of points.")
    rows, callsign = [], ""
    for count, point in enumerate(points):
        match point:
            case [t, lat, lon, altitude, speed, track, *_] if _is_number(t):
                pass
            case _:
                raise ValueError(
                    f"{source}, trace[{count}]: a point is [seconds, latitude, longitude, altitude,"
                    " ground speed, track, …]."
                )
        details = point[DETAILS] if len(point) > DETAILS else None
        if isinstance(details, dict) and details.get("flight"):
            callsign = str(details["flight"]).strip()
        rows.append(
            Report(
                address=address,
                callsign=callsign,
                aircraft_type=aircraft_type,
                t=begun + t,
                lat_deg=_number(lat),
                lon_deg=_number(lon),
                altitude=_number(altitude) * FT,
                ground_speed=_number(speed) * KT,
                track_deg=_number(track),
                on_ground=1.0 if altitude == GROUND else 0.0,
            )
        )
    return reports_of(rows)


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _number(value: Any) -> float:
    return float(value) if _is_number(value) else nan
