"""Feeds as an operator names them, e.g. `asterix://0.0.0.0:8600,readsb:http://host/aircraft.json`.

- `asterix://HOST:PORT`: ASTERIX categories 062 and 021 over UDP, at an address of this machine or
  of a multicast group.
- `readsb:ADDRESS` or `readsb:FILE`: the aircraft.json of readsb, read once a second.
- `replay:FILE`: a file of recorded flights, played from the start of the service at rate 1; one
  that relguide recorded is placed on the earth, `replay:FILE@LATITUDE,LONGITUDE`.
"""

import re
from dataclasses import dataclass
from ipaddress import ip_address

KINDS = "asterix://HOST:PORT, readsb:ADDRESS, readsb:FILE, replay:FILE or replay:FILE@LAT,LON"
_PLACED = re.compile(r"(.+)@(-?[\d.]+),(-?[\d.]+)")
_NEXT = re.compile(r",(?=\s*(?:asterix|readsb|replay):)")
"""A comma before the next feed: addresses may have others."""


@dataclass(frozen=True, slots=True, kw_only=True)
class AsterixFeed:
    """Datagrams of ASTERIX."""

    address: str
    """As it was given."""
    host: str
    port: int


@dataclass(frozen=True, slots=True, kw_only=True)
class ReadsbFeed:
    """What a receiver of ADS-B sees."""

    address: str
    """As it was given."""
    where: str
    """An address of HTTP, or the name of a file."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReplayFeed:
    """A recording."""

    address: str
    """As it was given."""
    file: str
    place: tuple[float, float] | None
    """Latitude and longitude of x = y = 0 [°]; `None` for a file that has places of its own."""


FeedSetting = AsterixFeed | ReadsbFeed | ReplayFeed


def feeds_of(text: str) -> tuple[FeedSetting, ...]:
    """The feeds of a setting.

    Raises:
        ValueError: saying what would be right.
    """
    given = [part.strip() for part in _NEXT.split(text) if part.strip()]
    if len(set(given)) < len(given):
        raise ValueError("must name each feed once")
    return tuple(_feed(part) for part in given)


def _feed(address: str) -> FeedSetting:
    kind, _, rest = address.partition(":")
    match kind:
        case "asterix" if rest.startswith("//"):
            host, _, port = rest[2:].rpartition(":")
            host = host.removeprefix("[").removesuffix("]")
            if not (port.isdecimal() and 0 < int(port) < 65536 and _is_address(host)):
                raise ValueError("must be asterix://ADDRESS:PORT, as asterix://0.0.0.0:8600")
            return AsterixFeed(address=address, host=host, port=int(port))
        case "readsb" if rest:
            return ReadsbFeed(address=address, where=rest)
        case "replay" if rest:
            placed = _PLACED.fullmatch(rest)
            if placed is None:
                return ReplayFeed(address=address, file=rest, place=None)
            try:
                lat, lon = float(placed[2]), float(placed[3])
            except ValueError:
                lat = lon = 999.0
            if abs(lat) > 90.0 or abs(lon) > 180.0:
                raise ValueError("must be placed by degrees, as replay:FILE@50.03,8.57")
            return ReplayFeed(address=address, file=placed[1], place=(lat, lon))
        case _:
            raise ValueError(f"must be feeds with commas between, each {KINDS}")


def _is_address(host: str) -> bool:
    try:
        ip_address(host)
    except ValueError:
        return False
    return True
