"""ASTERIX: reports from the datagrams of trackers (category 062) and ADS-B stations (021).

Of a track of 062 are taken: its time (I062/070), place (105), velocity (185), level (measured, 136,
else the tracked barometric one, 135), rate of climb (220), callsign (245, else the aircraft's own
or its address, 380) and the end of its service (080, TSE). Of a report of 021: time (073, else 071,
075), place (131, else 130), velocity (160), level (145), rates (155, else 157), callsign (170),
address (080), and whether it is on the ground (040).

The velocity of 062 is along the axes of the tracker's own plane; its north is taken for true north,
which is right at the tracker and off by 1° some 80 km east or west of it at 50° of latitude.
"""

from dataclasses import dataclass, field
from functools import cache
from math import atan2, hypot
from typing import Any

from relguide.atc.reported import Reported
from relguide.planning.extras import need
from relguide.units import DEG, FT, NM, Second

DAY: Second = 86_400.0
FEET_OF_LEVEL = 100.0 * FT
PER_MINUTE = FT / 60.0


@dataclass(slots=True)
class Decoded:
    """What a datagram says."""

    found: list[Reported] = field(default_factory=list)
    gone: list[str] = field(default_factory=list)
    """Idents of tracks that their tracker has ended."""
    malformed: int = 0
    """Blocks that could not be read, and the whole if it is none."""
    unusable: int = 0
    """Reports without a place, a time, a velocity, or a name."""


@cache
def _categories() -> tuple[Any, dict[int, tuple[Any, Any]]]:
    """What reads blocks, and by category what reads its records: its loading takes seconds."""
    need("asterix")
    from asterix import base, generated

    return base, {
        62: (generated.Cat_062_1_21, _of_tracker),
        21: (generated.Cat_021_2_7, _of_station),
    }


def load() -> None:
    """Load what reads ASTERIX.

    Raises:
        MissingExtra: if it is not installed.
    """
    _categories()


def decode(datagram: bytes, now: Second) -> Decoded:
    """The reports of a datagram; blocks of other categories are passed over.

    Args:
        datagram: one or more ASTERIX data blocks.
        now: UTC [s]; records say the time of day alone.
    """
    base, categories = _categories()
    said = Decoded()
    blocks = base.RawDatablock.parse(base.Bits.from_bytes(datagram))
    if isinstance(blocks, ValueError):
        said.malformed = 1
        return said
    for block in blocks:
        if block.get_category() not in categories:
            continue
        category, read = categories[block.get_category()]
        records = category.cv_uap.parse(block.get_raw_records())
        if isinstance(records, ValueError):
            said.malformed += 1
            continue
        for record in records:
            read(record, now, said)
    return said


def _of_tracker(record: Any, now: Second, said: Decoded) -> None:
    ident = (
        _text(record, "245", "CHR")
        or _text(record, "380", "ID")
        or _address(_value(record, "380", "ADR"))
        or _track_name(record)
    )
    if _value(record, "080", "TSE"):
        said.gone.append(ident)
        return
    day = _quantity(record, "s", "070")
    lat, lon = _quantity(record, "°", "105", "LAT"), _quantity(record, "°", "105", "LON")
    east, north = _quantity(record, "m/s", "185", "VX"), _quantity(record, "m/s", "185", "VY")
    level = _quantity(record, "FL", "136")
    if level is None and not _value(record, "135", "QNH"):
        level = _quantity(record, "FL", "135", "CTB")
    climb = _quantity(record, "ft/min", "220")
    if not ident or day is None or lat is None or lon is None or east is None or north is None:
        said.unusable += 1
        return
    said.found.append(
        Reported(
            ident=ident,
            t=of_day(day, now),
            lat_deg=lat,
            lon_deg=lon,
            track=atan2(east, north) % (360.0 * DEG),
            ground_speed=hypot(east, north),
            altitude=None if level is None else level * FEET_OF_LEVEL,
            climb=0.0 if climb is None else climb * PER_MINUTE,
        )
    )


def _of_station(record: Any, now: Second, said: Decoded) -> None:
    if _value(record, "040", "GBS"):
        return
    ident = _text(record, "170") or _address(_value(record, "080"))
    days = (_quantity(record, "s", name) for name in ("073", "071", "075"))
    day = next((day for day in days if day is not None), None)
    places = (
        (_quantity(record, "°", name, "LAT"), _quantity(record, "°", name, "LON"))
        for name in ("131", "130")
    )
    lat, lon = next((place for place in places if place[0] is not None), (None, None))
    speed, track = _quantity(record, "NM/s", "160", "GS"), _quantity(record, "°", "160", "TA")
    level = _quantity(record, "FL", "145")
    rates = (_quantity(record, "ft/min", *of) for of in (("155", "BVR"), ("157", "GVR")))
    climb = next((rate for rate in rates if rate is not None), 0.0)
    if not ident or day is None or lat is None or lon is None or speed is None or track is None:
        said.unusable += 1
        return
    said.found.append(
        Reported(
            ident=ident,
            t=of_day(day, now),
            lat_deg=lat,
            lon_deg=lon,
            track=track * DEG,
            ground_speed=speed * NM,
            altitude=None if level is None else level * FEET_OF_LEVEL,
            climb=climb * PER_MINUTE,
        )
    )


def of_day(seconds: Second, now: Second) -> Second:
    """A time of day as UTC: that of yesterday, today or tomorrow which is nearest to now [s]."""
    return now + (seconds - now + 0.5 * DAY) % DAY - 0.5 * DAY


def _item(record: Any, path: tuple[str, ...]) -> Any:
    """The content of an item, or of a part of it; `None` where it is not sent."""
    found = record.get_item(path[0])
    for name in path[1:]:
        if found is None:
            return None
        found = found.variation.get_item(name)
    return None if found is None else found.variation.content


def _quantity(record: Any, unit: str, *path: str) -> float | None:
    content = _item(record, path)
    return None if content is None else float(content.as_quantity(unit))


def _text(record: Any, *path: str) -> str:
    content = _item(record, path)
    return "" if content is None else str(content.as_string()).strip()


def _value(record: Any, *path: str) -> int:
    """A number without a unit; 0 where it is not sent."""
    content = _item(record, path)
    return 0 if content is None else int(content.as_uint())


def _address(number: int) -> str:
    """A 24-bit address as it is written."""
    return f"{number:06x}" if number else ""


def _track_name(record: Any) -> str:
    """A track as its tracker numbers it, where nobody has said what it is called."""
    number = _value(record, "040")
    sac, sic = _value(record, "010", "SAC"), _value(record, "010", "SIC")
    return f"{sac:03d}/{sic:03d}/{number}" if number else ""
