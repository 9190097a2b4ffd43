"""readsb: `readsb:http://HOST/data/aircraft.json` or `readsb:FILE`, read once a second.

Of each aircraft are taken: `hex`, `flight`, `lat`, `lon`, `seen_pos`, `alt_baro` [ft], `gs` [kt],
`track` [°] and `baro_rate` [ft/min]; `now` is the time of the whole.
"""

import asyncio
from math import nan
from pathlib import Path
from typing import Any
from urllib.error import URLError
from urllib.request import Request, urlopen

import orjson

from relguide.atc.reported import Reported
from relguide.units import DEG, FT, KT, Second
from relguide_server.atc.feeds.feed_state import FeedState, clock

PERIOD: Second = 1.0
"""How often it is read."""
PATIENCE: Second = 5.0
"""How long an answer may take."""
LONGEST = 32 * 1024 * 1024
"""Of an answer [bytes]: ten thousand aircraft take 5 MB."""
GROUND = "ground"
"""What stands for the altitude of an aircraft on the ground."""


async def poll_readsb(where: str, state: FeedState) -> None:
    """Read it once a second until cancelled.

    Args:
        where: an address that begins with http:// or https://, or the name of a file.
        state: of the feed.
    """
    while True:
        await asyncio.to_thread(_read_once, where, state)
        await asyncio.sleep(PERIOD)


def _read_once(where: str, state: FeedState) -> None:
    try:
        body = _fetch(where)
    except (OSError, ValueError) as error:
        reason = error.reason if isinstance(error, URLError) else error
        state.fault = f"It cannot be read: {reason}."
        return
    state.messages += 1
    try:
        found, unusable = aircraft_in(orjson.loads(body))
    except ValueError as error:
        state.malformed += 1
        state.fault = f"What came is no aircraft.json of readsb: {error}."
        return
    state.unusable += unusable
    state.take(found, clock())


def _fetch(where: str) -> bytes:
    if not where.startswith(("http://", "https://")):
        return Path(where).read_bytes()
    asked = Request(where, headers={"Accept": "application/json"})
    with urlopen(asked, timeout=PATIENCE) as answer:
        body: bytes = answer.read(LONGEST + 1)
    if len(body) > LONGEST:
        raise ValueError(f"it has more than {LONGEST:,} bytes")
    return body


def aircraft_in(content: Any) -> tuple[list[Reported], int]:
    """The aircraft of an aircraft.json that fly somewhere, and how many others there are.

    Raises:
        ValueError: if it is none.
    """
    if not isinstance(content, dict) or not isinstance(content.get("aircraft"), list):
        raise ValueError("it has no list of aircraft")
    now = _number(content.get("now"))
    if not now > 0.0:
        raise ValueError("it has no time, now")
    found, unusable = list[Reported](), 0
    for row in content["aircraft"]:
        one = _reported(row, now) if isinstance(row, dict) else None
        if one is not None:
            found.append(one)
        elif not (isinstance(row, dict) and row.get("alt_baro") == GROUND):
            unusable += 1
    return found, unusable


def _reported(row: dict[str, Any], now: Second) -> Reported | None:
    if row.get("alt_baro") == GROUND:
        return None
    ident = str(row.get("flight") or "").strip() or str(row.get("hex") or "").strip()
    lat, lon, age = (_number(row.get(name)) for name in ("lat", "lon", "seen_pos"))
    speed, track = _number(row.get("gs")) * KT, _number(row.get("track")) * DEG
    altitude, rate = _number(row.get("alt_baro")) * FT, _number(row.get("baro_rate"))
    if not ident or lat + lon + age + speed + track != lat + lon + age + speed + track:
        return None
    return Reported(
        ident=ident,
        t=now - age,
        lat_deg=lat,
        lon_deg=lon,
        track=track % (360.0 * DEG),
        ground_speed=speed,
        altitude=altitude if altitude == altitude else None,
        climb=rate * FT / 60.0 if rate == rate else 0.0,
    )


def _number(value: object) -> float:
    """A number of JSON; NaN for anything else."""
    return float(value) if isinstance(value, int | float) and value is not True else nan
