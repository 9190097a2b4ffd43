"""ASTERIX is read as the standard writes it: from bytes that no library made."""

from math import atan2, hypot, pi

import pytest
from hypothesis import given
from hypothesis import strategies as st
from relguide_server.atc.feeds.asterix_records import DAY, Decoded, decode, of_day

from relguide.units import FT, KT
from tests.server.atc.feeds.asterix_bytes import block, report_021, track_062

NOW = 20_000.0 * DAY + 30_000.0


def test_a_track_of_062() -> None:
    track = track_062(tod=29_998.5, lat=50.25, lon=-8.5, east=200.25, north=-10.5, climb=-1_000.0)
    (one,) = decode(block(62, track), NOW).found
    assert one.ident == "BAW12"
    assert one.t == NOW - 1.5
    assert (one.lat_deg, one.lon_deg) == pytest.approx((50.25, -8.5), abs=1e-5)
    assert one.ground_speed == pytest.approx(hypot(200.25, 10.5))
    assert one.track == pytest.approx(atan2(200.25, -10.5))
    assert one.altitude == pytest.approx(31_000.0 * FT)
    assert one.climb == pytest.approx(-1_000.0 * FT / 60.0)


def test_a_report_of_021() -> None:
    report = report_021(tod=29_999.0, lat=50.25, lon=-8.5, speed_kt=450.0, track=271.5, climb=500.0)
    (one,) = decode(block(21, report), NOW).found
    assert one.ident == "EIN5LJ"
    assert one.t == NOW - 1.0
    assert (one.lat_deg, one.lon_deg) == pytest.approx((50.25, -8.5), abs=2e-7)
    assert one.ground_speed == pytest.approx(450.0 * KT, abs=0.06)  # 2⁻¹⁴ NM/s
    assert one.track == pytest.approx(271.5 * pi / 180.0, abs=1e-4)
    assert one.altitude == pytest.approx(37_000.0 * FT)
    assert one.climb == pytest.approx(500.0 * FT / 60.0)


def test_without_a_callsign_it_is_called_by_its_address_or_number() -> None:
    report = report_021(tod=0.0, lat=1.0, lon=1.0, speed_kt=450.0, track=1.0, callsign="")
    track = track_062(tod=0.0, lat=1.0, lon=1.0, east=1.0, north=1.0, callsign="")
    (adsb, tracked) = decode(block(21, report) + block(62, track), NOW).found
    assert (adsb.ident, tracked.ident) == ("4ca1fe", "025/007/77")


def test_several_records_and_blocks_and_other_categories() -> None:
    tracks = [track_062(tod=1.0, lat=1.0, lon=1.0, east=1.0, north=1.0, callsign=name)
              for name in ("AFR1", "AFR2")]  # fmt: skip
    radar = bytes([48, 0, 4, 0])
    said = decode(block(62, *tracks) + radar + block(62, tracks[0]), NOW)
    assert [one.ident for one in said.found] == ["AFR1", "AFR2", "AFR1"]
    assert said.malformed == said.unusable == 0


def test_what_has_ended_or_is_on_the_ground_does_not_fly() -> None:
    ended = track_062(tod=1.0, lat=1.0, lon=1.0, east=1.0, north=1.0, ended=True)
    parked = report_021(tod=1.0, lat=1.0, lon=1.0, speed_kt=5.0, track=1.0, ground=True)
    assert decode(block(62, ended) + block(21, parked), NOW) == Decoded(gone=["BAW12"])


def test_a_record_without_a_place_is_counted() -> None:
    # only 010 and 070: field reference numbers 1 and 4
    assert decode(block(62, bytes([0b1001_0000, 25, 7, 0, 0, 1])), NOW) == Decoded(unusable=1)


@given(st.floats(-0.49 * DAY, 0.49 * DAY), st.floats(0.0, 3e9))
def test_a_time_of_day_is_that_which_is_nearest(ahead: float, now: float) -> None:
    t = now + ahead
    assert of_day(t % DAY, now) == pytest.approx(t, abs=1e-5)


WHOLE = block(62, track_062(tod=1.0, lat=1.0, lon=1.0, east=1.0, north=1.0)) + block(
    21, report_021(tod=1.0, lat=1.0, lon=1.0, speed_kt=450.0, track=1.0)
)


@given(st.data())
def test_damaged_bytes_break_nothing(data: st.DataObject) -> None:
    bytes_ = bytearray(WHOLE[: data.draw(st.integers(0, len(WHOLE)))])
    for _ in range(data.draw(st.integers(0, 5))):
        if bytes_:
            place = data.draw(st.integers(0, len(bytes_) - 1))
            bytes_[place] = data.draw(st.integers(0, 255))
    decode(bytes(bytes_), NOW)


@given(st.binary(max_size=60), st.sampled_from([21, 62]))
def test_noise_breaks_nothing(noise: bytes, category: int) -> None:
    decode(noise, NOW)
    decode(block(category, noise), NOW)
