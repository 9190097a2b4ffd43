"""Files of kinds that people have, made for the purpose, and the right answers to them."""

from pathlib import Path

import numpy as np
import pytest

from relguide.flying.recordings.files import is_recording, load_track
from relguide.units import DEG, KT

FIELD = Path(__file__).parents[3] / "golden" / "field"


@pytest.mark.parametrize(
    ("file", "ident", "seconds", "start"),
    [
        ("02-over-pole.csv", "TST42", 239.0, 0.0),
        ("05-milliseconds.csv", "TST42", 39.0, 0.0),
        ("06-opensky-state-vectors.csv", "FLD12", 59.0, 0.0),
        ("10-semicolon-decimal-comma.csv", "TST42", 59.0, 0.0),
        ("11-null-and-ground.csv", "TST42", 56.0, 3.0),
        ("12-readsb-trace.json", "abc123", 59.0, 0.0),
    ],
)
def test_a_straight_flight_at_400_kt_is_read_as_one(
    file: str, ident: str, seconds: float, start: float
) -> None:
    assert is_recording(FIELD / file)
    track = load_track(FIELD / file)
    assert (track.ident, track.duration) == (ident, seconds)
    assert track.start == 1633608000.0 + start
    assert track.ground_speed / KT == pytest.approx(401.0, abs=1.0)
    assert np.ptp(track.track) < 0.01 * DEG
    assert track.altitude == pytest.approx(9448.8)


def test_positions_in_one_cell_each_15_s_are_read() -> None:
    track = load_track(FIELD / "07-position-in-one-cell.csv")
    assert (track.ident, track.duration) == ("FLD12", 585.0)
    assert track.ground_speed / KT == pytest.approx(401.0, abs=1.5)
    # from 70° to 111° by the file's own Direction, and north's turn by 2.6° of longitude
    assert (track.track[-1] - track.track[0]) / DEG == pytest.approx(41.0, abs=2.0)


def test_of_two_flights_each_can_be_named() -> None:
    file = FIELD / "04-two-flights.csv"
    with pytest.raises(ValueError, match=r"choose one\. It has 2, for example FLD13, TST42\."):
        load_track(file)
    assert [load_track(file, name).ident for name in ("TST42", "fld13")] == ["TST42", "FLD13"]


def test_situations_are_no_recordings() -> None:
    for file in ("13-flight-over-antimeridian.json", "14-bom.json", "15-float32-heading.json"):
        assert not is_recording(FIELD / file)
        with pytest.raises(ValueError, match=r"holds no recorded flight\. Read are tables of"):
            load_track(FIELD / file)
