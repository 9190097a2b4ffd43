"""Tables as text: which columns are read, and what is said of a table that cannot be."""

import gzip
import math
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from relguide.flying.recordings.columns import read_table
from relguide.flying.recordings.files import load_track
from tests.written_flights import rows, write_csv


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "track.csv"


@pytest.mark.parametrize(
    ("column", "text", "sentence"),
    [
        ("latitude", "north", r"line 4, column latitude: 'north' is not a number\."),
        ("latitude", "91", r"line 4, column latitude: must lie in -90 … 90, not 91\."),
        ("longitude", "inf", r"line 4, column longitude: must lie in -180 … 360, not inf\."),
        ("vertical_rate", "up", r"line 4, column vertical_rate: 'up' is not a number\."),
        ("groundspeed", "-1", r"line 4, column groundspeed: must lie in 0 … 10000, not -1\."),
        ("timestamp", "noon", r"line 4, column timestamp: 'noon' is neither a time"),
        ("timestamp", "", r"line 4, column timestamp: '' is neither a time"),
        ("timestamp", "inf", r"line 4, column timestamp: 'inf' is not a time\."),
    ],
)
def test_a_bad_cell_is_named(file: Path, column: str, text: str, sentence: str) -> None:
    bad = rows(100)
    bad[2][column] = text
    with pytest.raises(ValueError, match=sentence):
        load_track(write_csv(file, bad))


@pytest.mark.parametrize(
    "form", ["{}", "{}.5", "2021-10-07T12:00:00Z", "2021-10-07 14:00:00+02:00"]
)
def test_times_may_be_written_in_several_ways(file: Path, form: str) -> None:
    good = rows(100)
    if "{}" in form:
        for n, r in enumerate(good):
            r["timestamp"] = form.format(1633608000 + n)
    else:
        good[0]["timestamp"] = form
    assert load_track(write_csv(file, good)).duration == 99.0


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"", "line 1: column timestamp is missing."),
        (b"timestamp,latitude,longitude\n", "line 1: column altitude is missing."),
        (b"timestamp,latitude,longitude,altitude\n", "has no rows below its header."),
        (b"timestamp,latitude,longitude,altitude\n1,2\n", "line 2: it has not as many columns"),
        (b"timestamp,latitude,longitude,altitude\n1,2,3,4,5\n", "line 2: it has not as many"),
        (b"timestamp,latitude,longitude,altitude\n1,2,3,4\n", "has no stretch of 30 positions"),
        (b"timestamp,latitude,longitude,altitude\n1,,,4\n", "has no positions."),
        (b"\x7fELF\xff\xfe\x00", "is not UTF-8 text."),
    ],
)
def test_a_file_that_is_no_track_is_refused(file: Path, content: bytes, sentence: str) -> None:
    file.write_bytes(content)
    with pytest.raises(ValueError, match=str(file)) as caught:
        load_track(file)
    assert sentence in str(caught.value)


@given(noise=st.text(max_size=200))
@settings(max_examples=60)
def test_noise_is_refused_in_a_sentence(
    tmp_path_factory: pytest.TempPathFactory, noise: str
) -> None:
    file = tmp_path_factory.mktemp("noise") / "a.csv"
    header = "timestamp,latitude,longitude,altitude\n"
    file.write_bytes((header + noise).encode("utf-8", "surrogatepass"))
    with pytest.raises(ValueError, match=r"a\.csv"):
        load_track(file)


HEADER = "timestamp,icao24,callsign,latitude,longitude,altitude,groundspeed,track"
LINE = "1633608000,abc123,TST42,48.5,2.25,31000,400,70.5"
NUMBERS = (1633608000.0, 48.5, 2.25, 31000 * 0.3048, 400 * 1852 / 3600, 70.5)


@pytest.mark.parametrize(
    ("header", "line"),
    [
        (HEADER, LINE),
        (HEADER.upper(), LINE),
        (HEADER.replace(",", "\t"), LINE.replace(",", "\t")),
        (HEADER.replace(",", ";"), LINE.replace(",", ";").replace(".", ",")),
        (HEADER.replace(",", "|"), LINE.replace(",", "|")),
        (HEADER, LINE.replace("1633608000", "1633608000000")),
        (HEADER, LINE.replace("1633608000", "1633608000000000")),
        (HEADER, LINE.replace("1633608000", "1633608000000000000")),
        (HEADER, LINE.replace("1633608000", "2021-10-07 12:00:00 UTC")),
        (HEADER.replace("groundspeed", "Ground Speed"), LINE),
        (
            "time,icao24,lat,lon,velocity,heading,callsign,onground,baroaltitude",
            "1633608000,abc123,48.5,2.25,205.7777777777778,70.5,TST42   ,False,9448.8",
        ),
        (
            "Timestamp,UTC,Callsign,Position,Altitude,Speed,Direction",
            '1633608000,2021-10-07T12:00:00Z,TST42,"48.5,2.25",31000,400,70.5',
        ),
    ],
)
def test_people_name_and_write_the_same_in_many_ways(header: str, line: str) -> None:
    reports = read_table(f"{header}\n{line}\n", "a.csv")
    assert reports.callsign == ["TST42"]
    assert reports.address[0] in ("abc123", "")
    assert reports.numbers[0, :6] == pytest.approx(NUMBERS, rel=1e-12)


@pytest.mark.parametrize("cell", ["", "null", "None", "NaN", "n/a", " "])
def test_a_cell_without_a_number_is_none(cell: str) -> None:
    text = f"{HEADER}\n{LINE.replace('70.5', cell)}\n"
    assert math.isnan(read_table(text, "a.csv").numbers[0, 5])


@pytest.mark.parametrize(
    ("column", "cell", "on_ground"),
    [("altitude", "ground", 1.0), ("onground", "True", 1.0), ("onground", "0", 0.0)],
)
def test_reports_on_the_ground_are_known(column: str, cell: str, on_ground: float) -> None:
    header, line = (HEADER, LINE) if column in HEADER else (f"{HEADER},{column}", f"{LINE},x")
    cells = dict(zip(header.split(","), line.split(","), strict=True)) | {column: cell}
    text = f"{header}\n{','.join(cells.values())}\n"
    assert read_table(text, "a.csv").numbers[0, 6] == on_ground


@pytest.mark.parametrize(
    ("header", "sentence"),
    [
        (f"{HEADER},Track", r"line 1: column Track is given twice: keep one\."),
        ("a;b;c", r"column timestamp is missing\. Found: a;b;c\. Read are a time \(timestamp, "),
        ("time,Position,x", r"column altitude is missing\. Found: time, Position, x\."),
        ("time,lat,Position,altitude", r"column longitude is missing\."),
        (
            "1633608000,48.1,2.3,9449",
            r"line 1 must name the columns, and holds values: 1633608000,",
        ),
    ],
)
def test_a_header_is_refused_by_what_it_has(header: str, sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        read_table(f"{header}\n", "a.csv")


def test_a_position_that_is_none_is_named() -> None:
    with pytest.raises(ValueError, match=r"line 2, column Position: '48\.5' is not a latitude,"):
        read_table("time,Position,altitude\n0,48.5,1\n", "a.csv")


def test_files_may_be_packed_and_begin_with_a_mark(tmp_path: Path) -> None:
    text = write_csv(tmp_path / "plain.csv", rows(100)).read_bytes()
    for name, content in {
        "a.CSV": text,
        "b.csv.gz": gzip.compress(text),
        "c.csv": b"\xef\xbb\xbf" + text,
        "d.tsv": text.decode().encode("utf-16"),
    }.items():
        (tmp_path / name).write_bytes(content)
        assert load_track(tmp_path / name).duration == 99.0
    (tmp_path / "e.csv.gz").write_bytes(gzip.compress(text)[:-20])
    with pytest.raises(ValueError, match=r"e\.csv\.gz is damaged: it cannot be unpacked\."):
        load_track(tmp_path / "e.csv.gz")
