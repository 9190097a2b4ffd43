"""`relguide fly` and `replay`: their figures, and what is told of a damaged recording."""

import gzip
import json
from pathlib import Path
from typing import Any

import pytest

from relguide.contract.recorder import replay
from relguide.flying.documents import FlightStarted
from tests.command_line import NEAR, UNREACHABLE, Run, process, written

FIGURES = {
    "joined",
    "join_time_s",
    "planned_time_s",
    "least_separation_m",
    "heading_swing_deg",
    "bank_reversals",
    "replans",
    "fallbacks",
    "track_nm",
    "simulated_s",
    "wall_s",
}


@pytest.mark.slow
def test_fly_prints_the_contracts_figures(run: Run) -> None:
    code, out, _ = run("fly", "fig_6b", "--json")
    figures = json.loads(out)
    assert set(figures) == FIGURES
    assert (code, figures["joined"]) == (0, True)
    assert figures["simulated_s"] >= figures["join_time_s"] > 0.0
    assert figures["track_nm"] * 1852.0 == pytest.approx(figures["join_time_s"] * 240.0, rel=0.05)


@pytest.fixture(scope="module")
def flown(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, Any]]:
    """A short flight: its recording, and its figures."""
    folder = tmp_path_factory.mktemp("flown")
    (folder / "near.json").write_text(json.dumps(NEAR))
    file = folder / "near.jsonl.gz"
    done = process("fly", str(folder / "near.json"), "--json", "--record", str(file), "--seed", "7")
    assert done.returncode == 0
    return file, json.loads(done.stdout)


@pytest.mark.slow
def test_a_recording_replays_to_the_same_figures(
    run: Run, flown: tuple[Path, dict[str, Any]]
) -> None:
    file, figures = flown
    code, out, _ = run("replay", str(file), "--json")
    told = json.loads(out)
    assert (code, told["complete"]) == (0, True)
    assert told["title"] == "The situation of near.json"
    documents = list(replay(file))
    assert told["documents"] == len(documents)
    assert isinstance(documents[0], FlightStarted)
    assert documents[0].seed == 7
    for name in FIGURES - {"wall_s"}:
        assert told[name] == pytest.approx(figures[name], rel=1e-9)
    code, out, _ = run("replay", str(file))
    assert code == 0
    for word in ("engaged", "least separation", "fallbacks"):
        assert word in out


@pytest.mark.slow
def test_of_a_damaged_recording_the_good_part_is_told(
    run: Run, flown: tuple[Path, dict[str, Any]]
) -> None:
    whole = gzip.decompress(flown[0].read_bytes())
    Path("near.jsonl").write_bytes(whole[: len(whole) // 2])
    code, out, err = run("replay", "near.jsonl", "--json")
    told = json.loads(out)
    assert code == 1
    assert told["complete"] is False
    assert told["documents"] > 10
    assert err.startswith("relguide: near.jsonl, line")
    assert err.endswith("the file is cut short here; what comes before is good.\n")
    Path("near.jsonl").write_bytes(b"".join(whole.splitlines(keepends=True)[:-1]))
    code, out, err = run("replay", "near.jsonl")
    assert code == 1
    assert "engaged" in out
    assert "ends before its flight does" in err


@pytest.mark.slow
def test_fly_without_a_plan_fails(run: Run) -> None:
    code, out, err = run("fly", written(UNREACHABLE), "--json")
    assert code == 1
    assert err == "relguide: It did not join within 3600 s.\n"
    assert json.loads(out)["joined"] is False
