"""A campaign flown: the same by any number of workers, after a kill, and never of two versions."""

import json
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path
from time import monotonic, sleep
from typing import Any

import pyarrow as pa
import pytest

from relguide.campaign import campaign, parts, run
from relguide.campaign.parts import MANIFEST, PARTS, read_manifest, read_table, row_of_record

pytestmark = pytest.mark.slow
TABLES: dict[str, Any] = {
    "campaign": {"flights": 12, "family": "declared", "seed": 5, "limit_s": 300},
    "sweep": {"wind_error_mps": [0.0, 4.0]},
}
FILE = """
[campaign]
flights = 12
family = "declared"
seed = 5
limit_s = 300
[sweep]
wind_error_mps = [0.0, 4.0]
"""
FEW = """
import sys
from relguide.campaign import run
from relguide.__main__ import main
run.LEAST_ROWS = 2
sys.exit(main(["campaign", *sys.argv[1:]]))
"""
"""The command with parts of two flights, so that there is something to stop."""


@pytest.fixture(scope="module")
def flown(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A campaign, flown by two processes."""
    folder = tmp_path_factory.mktemp("flown") / "two"
    campaign(TABLES, folder, processes=2)
    return folder


def without_time(table: pa.Table) -> pa.Table:
    return table.drop_columns(["cpu_s"])


def test_any_number_of_workers_flies_the_same(flown: Path, tmp_path: Path) -> None:
    table = campaign(TABLES, tmp_path / "one", processes=1)
    assert without_time(table).equals(without_time(read_table(flown)))
    assert table["flight"].to_pylist() == list(range(24))
    assert table["number"].to_pylist() == [flight // 2 for flight in range(24)]
    assert table["wind_error_mps"].to_pylist() == [0.0, 4.0] * 12
    assert set(table["error"].to_pylist()) == {""}
    rows = [row_of_record(record) for record in table.to_pylist()]
    assert any(row.joined for row in rows)
    assert all(row.why_not_joined == "" for row in rows if row.joined)


def test_the_manifest_says_what_was_flown_and_by_what(flown: Path) -> None:
    content = json.loads((flown / MANIFEST).read_text())
    assert content["campaign"]["flights"] == 12
    assert content["sweep"] == {"wind_error_mps": [0.0, 4.0]}
    assert set(content["program"]) == {"relguide", "numpy", "numba", "its code"}
    assert sum(part["rows"] for part in content["parts"].values()) == 24
    assert sorted(content["parts"]) == sorted(file.name for file in (flown / PARTS).iterdir())


def test_a_killed_run_goes_on_and_gives_the_same(flown: Path, tmp_path: Path) -> None:
    (tmp_path / "run.toml").write_text(FILE)
    arguments = ["run.toml", "--out", "out", "--processes", "2"]
    folder = tmp_path / "out" / PARTS
    for stop in (signal.SIGKILL, signal.SIGINT):
        before = len(list(folder.glob("*.parquet"))) if folder.exists() else 0
        with subprocess.Popen(
            [sys.executable, "-c", FEW, *arguments],
            cwd=tmp_path, stderr=subprocess.PIPE, text=True, start_new_session=True,
        ) as running:  # fmt: skip
            end = monotonic() + 120.0
            while not folder.exists() or len(list(folder.glob("*.parquet"))) < before + 2:
                assert monotonic() < end
                sleep(0.02)
            if stop == signal.SIGKILL:
                running.kill()  # its processes follow it
            else:
                os.killpg(running.pid, stop)
            pressed = monotonic()
            assert running.wait(timeout=10.0) == (130 if stop == signal.SIGINT else -9)
            assert monotonic() - pressed < 1.0
            assert running.stderr is not None
            said = running.stderr.read()
            assert ("the same command goes on with it" in said) == (stop == signal.SIGINT)
    kept = {file.name: file.stat().st_mtime_ns for file in folder.glob("*.parquet")}
    assert 4 <= len(kept) < 12
    subprocess.run([sys.executable, "-c", FEW, *arguments], cwd=tmp_path, check=True, timeout=120)
    assert {name: (folder / name).stat().st_mtime_ns for name in kept} == kept  # none twice
    assert len(read_manifest(tmp_path / "out").parts) == 12
    assert without_time(read_table(tmp_path / "out")).equals(without_time(read_table(flown)))


def test_flights_of_two_versions_are_never_put_together(
    flown: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = Path(shutil.copytree(flown, tmp_path / "copy"))
    monkeypatch.setattr(parts, "program", lambda: (("relguide", "9"), ("its code", "0")))
    with pytest.raises(ValueError, match=r"was flown with relguide \S+, and here is 9: flights of"):
        campaign(TABLES, folder)


def test_a_folder_of_something_else_is_left_alone(flown: Path, tmp_path: Path) -> None:
    (tmp_path / "letter.txt").write_text("dear")
    with pytest.raises(ValueError, match="holds something else"):
        campaign(TABLES, tmp_path)
    other = {**TABLES, "campaign": {**TABLES["campaign"], "seed": 6}}
    with pytest.raises(ValueError, match=r"asks for something else in campaign\.seed"):
        campaign(other, flown)
    with pytest.raises(ValueError, match="is no folder of a campaign"):
        read_table(tmp_path)


def test_a_damaged_part_is_flown_again(flown: Path, tmp_path: Path) -> None:
    folder = Path(shutil.copytree(flown, tmp_path / "copy"))
    part = folder / PARTS / "000001.parquet"
    part.write_bytes(part.read_bytes()[:-7])
    assert without_time(campaign(TABLES, folder, processes=1)).equals(
        without_time(read_table(flown))
    )


def test_what_cannot_be_flown_is_a_row_that_says_so(tmp_path: Path) -> None:
    tables = {
        "campaign": {"flights": 1, "family": "declared", "limit_s": 60},
        "sweep": {"altitude_m": [7500.0, 15000.0]},
    }
    flyable, not_flyable = campaign(tables, tmp_path / "out", processes=1).to_pylist()
    assert flyable["error"] == ""
    assert not_flyable["error"].startswith("ValueError: ")
    assert not_flyable["altitude_m"] == 15_000.0


def test_parts_are_as_many_as_help_and_depend_on_nothing_else() -> None:
    from relguide.campaign.campaign_file import read_campaign

    for flights, size in ((3, 3), (1_000, 10), (40_000, 100), (1_000_000, 250)):
        asked = read_campaign({"campaign": {"flights": flights, "family": "declared"}})
        chunks = list(run.chunks_of(asked))
        assert chunks[0].last == size
        assert chunks[-1].last == flights
