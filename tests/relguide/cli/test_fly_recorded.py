"""`relguide fly` behind recorded leaders: files, names, and what is said of the stretch."""

import json
from pathlib import Path

import pytest

from tests.command_line import NEAR, Run, write
from tests.written_flights import rows, write_csv

FIELD = Path(__file__).parents[2] / "golden" / "field"


@pytest.mark.slow
def test_a_recorded_leader_is_flown_by_collection_and_name(run: Run) -> None:
    code, out, err = run("fly", "quickstart:SVA127", "--json")
    assert err.startswith("relguide: Flown: 2021-10-07 14:31:03 to 14:53:41 UTC, 1358 s from FL000")
    assert code in (0, 1)
    assert json.loads(out)["simulated_s"] > 60.0


@pytest.mark.slow
def test_of_several_flights_in_a_file_one_is_named(run: Run) -> None:
    file = str(FIELD / "04-two-flights.csv")
    code, _, err = run("fly", file)
    assert code == 2
    assert "has several flights: choose one. It has 2, for example FLD13, TST42." in err
    assert "on the command line --callsign." in err
    code, out, err = run("fly", file, "--callsign", "FLD13", "--json")
    assert "Flown: 2021-10-07 12:00:00 to 12:00:39 UTC, 39 s at FL310; all that was heard." in err
    assert json.loads(out)["simulated_s"] == 39.0


@pytest.mark.slow
def test_positions_without_a_name_are_flown_behind(run: Run) -> None:
    bare = write_csv(Path("a.CSV"), rows(60), ("timestamp", "latitude", "longitude", "altitude"))
    _, out, err = run("fly", str(bare), "--json")
    assert "59 s from FL100 to FL112" in err
    assert json.loads(out)["simulated_s"] == 59.0


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("fig_6a", "--callsign", "A"), "--callsign is for a file of recorded flights, and fig_6a"),
        (("nowhere:A",), "traffic 2.13 has no samples 'nowhere'; it has "),
        (("notes.txt",), "column timestamp is missing. Found: no table."),
        (("notes.md",), "Flown are situations (.json) and tables of OpenSky, traffic or "),
        (("missing.csv",), "No such file"),
        (("states.json",), "leader: is missing: it must be an object with x_m, "),
        (("states.json",), "Flown are situations (.json) and tables of OpenSky, traffic or "),
    ],
)
def test_what_cannot_be_flown_is_refused_by_what_can(
    run: Run, arguments: tuple[str, ...], sentence: str
) -> None:
    write("no table", "notes.txt")
    write("no table", "notes.md")
    write({"time": 1633608000, "states": []}, "states.json")
    code, _, err = run("fly", *arguments)
    assert code == 2
    assert sentence in err


@pytest.mark.slow
def test_a_situation_may_begin_with_a_byte_order_mark(run: Run) -> None:
    write("\ufeff" + json.dumps(NEAR))
    assert run("fly", "situation.json", "--json")[0] == 0
    assert run("plan", "situation.json")[0] == 0
