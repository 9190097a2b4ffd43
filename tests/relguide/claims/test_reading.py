"""Numbers are found where a claim says they stand, and nowhere else."""

from pathlib import Path

import pytest

from relguide.claims.claim import Reading
from relguide.claims.reading import read_printed, read_table

JSON = '{"time_s": 1016.0, "losses": [1, 2], "named": {"hits": 9, "of": 12}, "joined": "no"}'
TEXT = "flown\n│    20 │   1,000 │ 99.8 │\n"
TABLE = 'kind,ms,share,told\na,2.0 ms,9,"13, 171"\nb,−4,11,"24, 7018"\nc,,80,none\n'


@pytest.mark.parametrize(
    ("reading", "printed", "number"),
    [
        (Reading(json="time_s"), JSON, 1016.0),
        (Reading(json="time_s", divide_by=1000.0), JSON, 1.016),
        (Reading(json="losses.#"), JSON, 2.0),
        (Reading(json="losses.1"), JSON, 2.0),
        (Reading(json="named.hits", over="named.of"), JSON, 75.0),
        (Reading(pattern=r"^│ +20 │ +([\d,]+)"), TEXT, 1000.0),
    ],
)
def test_what_is_printed(reading: Reading, printed: str, number: float) -> None:
    assert read_printed(reading, printed) == pytest.approx(number)


@pytest.mark.parametrize(
    ("reading", "printed", "why"),
    [
        (Reading(json="time"), JSON, "has no time"),
        (Reading(json="losses.2"), JSON, r"has no losses\.2"),
        (Reading(json="joined"), JSON, "joined is no number: no"),
        (Reading(json="time_s"), "joined", "did not print JSON"),
        (Reading(pattern=r"^│ +10 │ +(\d+)"), TEXT, "did not print what matches"),
        (Reading(pattern="(flown)"), TEXT, "begins with no number: flown"),
    ],
)
def test_what_is_not_printed_is_told(reading: Reading, printed: str, why: str) -> None:
    with pytest.raises(ValueError, match=why):
        read_printed(reading, printed)


def table(tmp_path: Path, **read: object) -> float:
    (tmp_path / "table.csv").write_text(TABLE, encoding="utf-8")
    return read_table(Reading(table="table.csv", **read), tmp_path)  # type: ignore[arg-type]


def test_a_cell_of_a_table(tmp_path: Path) -> None:
    assert table(tmp_path, where=(("kind", "a"),), column="ms") == 2.0
    assert table(tmp_path, where=(("kind", "b"),), column="ms") == -4.0
    assert table(tmp_path, where=(("kind", "b"),), column="told", pattern=r", (\d+)") == 7018.0


def test_what_is_made_of_several_rows(tmp_path: Path) -> None:
    assert table(tmp_path, column="share", take="sum") == 100.0
    assert table(tmp_path, column="ms", take="min") == -4.0
    assert table(tmp_path, column="ms", take="count") == 3.0
    assert table(tmp_path, where=(("kind", "[ab]"),), column="share", over="share") == 100.0


def test_a_row_or_column_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"table\.csv has 2 such rows, not one"):
        table(tmp_path, column="ms")
    with pytest.raises(ValueError, match=r"has 0 such rows"):
        table(tmp_path, where=(("kind", "d"),), column="ms")
    with pytest.raises(ValueError, match="has no column seconds: it has kind, ms, share, told"):
        table(tmp_path, column="seconds")
