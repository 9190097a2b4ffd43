"""A flight as Flightradar24's playback writes it in JSON; its CSV is read by `columns.py`."""

from typing import Any

from relguide.flying.recordings.reports import Report, Reports, reports_of
from relguide.units import FT, KT


def is_playback(content: object) -> bool:
    """Whether JSON looks like it."""
    match content:
        case {"result": {"response": {"data": {"flight": {"track": list()}}}}}:
            return True
    return False


def read_playback(content: Any, source: str) -> Reports:
    """The reports of a playback.

    Raises:
        ValueError: naming the point that is none.
    """
    flight = content["result"]["response"]["data"]["flight"]
    aircraft = flight.get("aircraft") or {}
    address = str((aircraft.get("identification") or {}).get("modes") or "").lower()
    aircraft_type = str((aircraft.get("model") or {}).get("code") or "")
    callsign = str((flight.get("identification") or {}).get("callsign") or "")
    rows = []
    for count, point in enumerate(flight["track"]):
        try:
            feet = float(point["altitude"]["feet"])
            rows.append(
                Report(
                    address=address,
                    callsign=callsign,
                    aircraft_type=aircraft_type,
                    t=float(point["timestamp"]),
                    lat_deg=float(point["latitude"]),
                    lon_deg=float(point["longitude"]),
                    altitude=feet * FT,
                    ground_speed=float(point["speed"]["kts"]) * KT,
                    track_deg=float(point["heading"]),
                    on_ground=1.0 if feet == 0.0 else 0.0,
                )
            )
        except (KeyError, TypeError, ValueError):
            raise ValueError(
                f"{source}, track[{count}]: a point has timestamp, latitude, longitude, "
                "altitude.feet, speed.kts and heading."
            ) from None
    return reports_of(rows)
