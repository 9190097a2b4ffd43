"""A clearance as ASTERIX: what is expected of both aircraft, as tracks of category 062.

They are marked as simulated (I062/080, SIM), since nobody has seen them yet. ASTERIX has no place
for the id of the clearance and the version of relguide, and tells the time of day alone.
"""

from math import ceil

import numpy as np

from relguide.atc.documents import ClearanceCard, TrackCard
from relguide.contract.clearance_exports import wall_clock
from relguide.planning.extras import need
from relguide.planning.frames import LocalPlane
from relguide.units import FT, Second

PERIOD: Second = 4.0
"""Between two records of an aircraft, as of a radar."""
DAY: Second = 86_400.0


def as_asterix(card: ClearanceCard, plane: LocalPlane) -> bytes:
    """Data blocks of one record each, in order of time.

    Args:
        card: the clearance.
        plane: how its sky lies on the earth.

    Raises:
        MissingExtra: if libasterix is not installed.
    """
    need("asterix")
    from asterix.generated import Cat_062_1_21 as Category

    found: list[tuple[Second, bytes]] = []
    aircraft = ((card.aircraft, card.route), (card.traffic_id, card.leader_route))
    for number, (ident, track) in enumerate(aircraft, 1):
        for t, items in _records(card, plane, ident, track):
            record = Category.cv_record.create({"040": number, **items})  # type: ignore[typeddict-item]
            found.append((t, Category.create([record]).unparse().to_bytes()))
    return b"".join(block for _, block in sorted(found, key=lambda one: one[0]))


def _records(
    card: ClearanceCard, plane: LocalPlane, ident: str, track: TrackCard
) -> list[tuple[Second, dict[str, object]]]:
    """When each record is, and its items."""
    begin, end = track.t[0], track.t[-1]
    t = np.minimum(begin + PERIOD * np.arange(ceil((end - begin) / PERIOD) + 1), end)
    x, y = np.interp(t, track.t, track.x), np.interp(t, track.t, track.y)
    # velocities of the line that is flown from there on, along true north and east
    k = np.clip(np.searchsorted(track.t, t, side="right") - 1, 0, len(track.t) - 2)
    span = np.diff(track.t)
    u, v = (np.diff(track.x) / span)[k], (np.diff(track.y) / span)[k]
    lat, lon = plane.to_geodetic_each(x, y)
    north = plane.meridian_each(lat, lon)
    east_mps = u * np.cos(north) - v * np.sin(north)
    north_mps = u * np.sin(north) + v * np.cos(north)
    records = []
    for row, moment in enumerate(t.tolist()):
        utc = wall_clock(card, moment)
        items: dict[str, object] = {
            "010": (("SAC", 0), ("SIC", 0)),
            "070": (utc % DAY, "s"),
            "105": (("LAT", (float(lat[row]), "°")), ("LON", (float(lon[row]), "°"))),
            "185": (
                ("VX", (float(east_mps[row]), "m/s")),
                ("VY", (float(north_mps[row]), "m/s")),
            ),
            "245": (("STI", 0), 0, ("CHR", f"{ident.upper()[:8]:8}")),
            # MON SPI MRH SRC CNF, SIM TSE TSB FPC AFF STP KOS
            "080": ((0, 0, 0, 0, 0, None), (1, 0, 0, 0, 0, 0, 0, None)),
        }
        if track.altitude:
            level = float(np.interp(moment, track.t, track.altitude)) / (100.0 * FT)
            items["135"] = (0, ("CTB", (level, "FL")))
        records.append((utc, items))
    return records
