"""A clearance as ASTERIX: its first record byte by byte, and all of them as the feed reads them."""

import struct
from math import hypot

import pytest
from relguide_server.atc.asterix_export import PERIOD, as_asterix
from relguide_server.atc.feeds.asterix_records import decode

from relguide.planning.frames import LocalPlane
from tests.relguide.contract.test_clearance_exports import BEGIN, clearance
from tests.server.atc.feeds.asterix_bytes import letters

PLANE = LocalPlane(50.0, 8.0)


def test_the_first_record_is_what_the_standard_says() -> None:
    data = as_asterix(clearance(), PLANE)
    category, length = struct.unpack(">BH", data[:3])
    assert category == 62
    record = data[3:length]
    # FRN 1, 4, 5, 7 | 10, 12, 13 | 19
    assert record[:3] == bytes([0b1001_1011, 0b0010_1101, 0b0000_0100 << 1])
    assert record[3:5] == bytes(2)
    assert int.from_bytes(record[5:8], "big") / 128 == BEGIN % 86_400.0
    lat, lon = (part * 180 / 2**25 for part in struct.unpack(">ii", record[8:16]))
    assert PLANE.to_local(lat, lon) == pytest.approx((0.0, 30e3), abs=0.5)
    assert record[20:27] == b"\x00" + letters("AIB01")
    assert record[27:29] == b"\x00\x01"
    assert record[29:31] == bytes([0b0000_0001, 0b1000_0000])  # simulated
    assert struct.unpack(">h", record[31:33])[0] / 4 == pytest.approx(9000.0 / 30.48, abs=0.2)


def test_the_feed_reads_both_tracks_at_their_times() -> None:
    found = decode(as_asterix(clearance(), PLANE), BEGIN).found
    assert len(found) == 2 * (240.0 / PERIOD + 1)
    assert [one.t for one in found] == sorted(one.t for one in found)
    leader = [one for one in found if one.ident == "AIB02"]
    for one in leader:
        x, y = PLANE.to_local(one.lat_deg, one.lon_deg)
        assert x == pytest.approx(40e3 + 50e3 * (one.t - BEGIN) / 240.0, abs=1.0)
        assert y == pytest.approx(0.0, abs=1.0)
        assert one.ground_speed == pytest.approx(50e3 / 240.0, abs=0.3)
        assert one.altitude is None
    # the velocity of the tracker is along true north and east
    first, second = (PLANE.to_local(one.lat_deg, one.lon_deg) for one in leader[:2])
    moved = hypot(second[0] - first[0], second[1] - first[1])
    assert moved == pytest.approx(leader[0].ground_speed * PERIOD, abs=1.5)
