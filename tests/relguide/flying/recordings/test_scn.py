"""Scenarios of BlueSky: what they tell an aircraft is flown, and what cannot be is refused."""

from pathlib import Path

import pytest

from relguide.flying.air import STANDARD_AIR
from relguide.flying.recordings.files import load_track
from relguide.units import DEG, FT, KT

SCENARIO = """\
# A leader that turns, climbs and speeds up
00:00:00.00>PAN 52,4
00:00:00.00>CRE KL204 B744 52.0,4.0 90 FL200 250
0:01:00.00>HDG KL204,180
0:05:00.00>KL204 ALT FL220 1000
0:08:00.00>SPD KL204 280
0:10:00.00>ASAS ON
0:20:00.00>DEL KL204
"""


def test_it_flies_as_it_is_told(tmp_path: Path) -> None:
    file = tmp_path / "a.scn"
    file.write_text(SCENARIO)
    track = load_track(file)
    assert (track.ident, track.aircraft_type, track.duration) == ("KL204", "B744", 1200.0)
    first = track.state_at(10.0)
    level = 20_000.0 * FT
    assert first.ground_speed == pytest.approx(
        STANDARD_AIR.tas_from_cas(250.0 * KT, level), rel=2e-3
    )
    assert first.track / DEG == pytest.approx(90.0, abs=0.5)
    assert track.state_at(250.0).track / DEG == pytest.approx(180.0, abs=1.0)
    # 90° at 25° of bank and this speed take 65 s
    assert 100.0 < track.state_at(80.0).track / DEG < 150.0
    assert track.state_at(360.0).altitude == pytest.approx(21_000.0 * FT, abs=30.0)
    assert track.state_at(450.0).altitude == pytest.approx(22_000.0 * FT, abs=10.0)
    last = track.state_at(1100.0)
    assert last.ground_speed == pytest.approx(
        STANDARD_AIR.tas_from_cas(280.0 * KT, 22_000.0 * FT), rel=5e-3
    )


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        ("0:01:00>ADDWPT KL204 SPY", r"line 9: KL204 is told ADDWPT: of recorded leaders only CRE"),
        ("0:01:00>HDG KL204", r"line 9: HDG KL204 lacks its number\."),
        ("0:01:00>SPD KL204 fast", r"line 9: 'FAST' is not a number\."),
        ("0:01:00>CRE KL204 B744 52 4 90 FL200 250", r"line 9: KL204 is made twice\."),
        ("0:01:00>CRE KL205 B744 EHAM 4 90 FL200 250", r"line 9: 'EHAM' is no latitude"),
        ("0:01:00>CRE KL205 B744 52", r"line 9: a new aircraft is CRE CALLSIGN TYPE LAT LON"),
        ("HDG KL204 180", r"line 9: a line begins with 00:00:00\.00>\."),
    ],
)
def test_what_cannot_be_flown_is_refused(tmp_path: Path, line: str, sentence: str) -> None:
    file = tmp_path / "a.SCN"
    file.write_text(f"{SCENARIO}{line}\n")
    with pytest.raises(ValueError, match=sentence):
        load_track(file)


def test_a_scenario_without_aircraft_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "a.scn"
    file.write_text("0:00:00>PAN 52,4\n")
    with pytest.raises(ValueError, match="makes no aircraft"):
        load_track(file)


def test_a_mach_number_is_kept_and_the_aircraft_flies_on(tmp_path: Path) -> None:
    file = tmp_path / "a.scn"
    file.write_text("0:00:00>CRE A1,B744,S10.5,W170,0,31000,.78\n")
    track = load_track(file)
    assert track.duration == 900.0
    expected = STANDARD_AIR.tas_from_mach(0.78, 31_000.0 * FT)
    assert track.ground_speed == pytest.approx(expected, rel=2e-3)
