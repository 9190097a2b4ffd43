"""numpy, numba and pydantic are enough to plan, fly and record; what needs more says so."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from relguide.planning.extras import EXTRAS
from tests.bodies import BODY
from tests.command_line import NEAR

BLOCK = f"""
import sys
class Blocker:
    def find_spec(name, path=None, target=None):
        if name.partition(".")[0] in {set(EXTRAS) | {"starlette", "dask"}}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)
sys.meta_path.insert(0, Blocker)
"""
"""Python in which numpy, numba and pydantic are all there is."""
FLOWN = """
from math import radians
import relguide
from relguide import Leader, Pursuer, Situation, alternatives, check, plan, prove
pursuer = Pursuer(x=-40e3, y=40e3, heading=radians(90), tas=240.0, max_bank=radians(25))
leader = Leader(x=0.0, y=0.0, heading=radians(90), tas=200.0)
found = plan(Situation(
    pursuer=pursuer, leader=leader, slot_distance=10e3, min_separation=9260.0,
))
alternatives(found), check(found, found.situation), prove(found, seconds=0.01)
from relguide.flying.flight import fly
from relguide.flying.scenarios import scenario
*_, ended = fly(scenario("fig_6b"), plan, sample_period=1.0)
print(found.word, ended.results[0].joined)
"""


def core(program: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", BLOCK + program], capture_output=True, text=True, timeout=300
    )


@pytest.mark.slow
def test_the_library_plans_and_flies() -> None:
    done = core(FLOWN)
    assert (done.stderr, done.stdout) == ("", "RSL True\n")


@pytest.mark.slow
def test_all_public_names_can_be_imported() -> None:
    done = core("from relguide import *\nprint(plan.__name__, record.__name__, replay.__name__)")
    assert (done.stderr, done.stdout) == ("", "plan record replay\n")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arguments", "package", "extra"),
    [
        (["plan", "situation.json", "--table"], "rich", "serve"),
        (["plan", "--batch", "situation.json"], "orjson", "serve"),
        (["check", "situation.json", "--table"], "rich", "serve"),
        (["fly", "fig_6b", "--table"], "rich", "serve"),
        (["replay", "a.jsonl", "--table"], "rich", "serve"),
        (["serve"], "fastapi", "serve"),
        (["train", "labels.npz", "weights.safetensors"], "torch", "learn"),
        (["audit"], "torch", "learn"),
        (["audit", "--method", "templates"], "torch", "learn"),
        (["area", "--figure", "area.svg"], "matplotlib", "figures"),
    ],
)
def test_a_command_says_what_brings_what_it_needs(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    arguments: list[str],
    package: str,
    extra: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("situation.json").write_text(json.dumps(BODY))
    done = core(f"import relguide.__main__ as m; sys.exit(m.main({arguments}))")
    sentence = (
        f"This needs the package {package}, which is not installed: "
        f"pip install 'relguide[{extra}]' brings it."
    )
    assert (done.returncode, done.stdout, done.stderr) == (2, "", f"relguide: {sentence}\n")
    assert [path.name for path in tmp_path.iterdir()] == ["situation.json"]


@pytest.mark.slow
def test_a_file_is_planned_flown_recorded_replayed_and_checked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("near.json").write_text(json.dumps(NEAR))
    for arguments, field, expected in (
        (["plan", "near.json", "--include", "alternatives,optimality"], "status", "planned"),
        (["check", "near.json", "--figure", "a.svg"], "passed", True),
        (["fly", "near.json", "--record", "a.jsonl.gz"], "joined", True),
        (["replay", "a.jsonl.gz"], "complete", True),
    ):
        done = core(f"import relguide.__main__ as m; sys.exit(m.main({arguments}))")
        assert (done.returncode, done.stderr) == (0, "")
        assert json.loads(done.stdout)[field] == expected


@pytest.mark.slow
def test_a_data_set_needs_no_more(tmp_path: Path) -> None:
    arguments = ["dataset", "--method", "exact", "--count", "1000", "--out", f"{tmp_path}/a.npz"]
    done = core(f"import relguide.__main__ as m; sys.exit(m.main({arguments}))")
    assert (done.returncode, done.stderr) == (0, "")
    assert json.loads(done.stdout)["labels"] == 1000


@pytest.mark.slow
@pytest.mark.parametrize(
    ("program", "extra"),
    [
        ("from relguide.maps.isochrones import Grid, isochrones\n"
         "isochrones(found.situation, Grid(x=0.0, y=0.0, columns=9, rows=9))", "serve"),
        ("from relguide.planning.frames import LocalPlane\n"
         "LocalPlane(lat_deg=50.0, lon_deg=8.0).to_local(50.0, 8.0)", "serve"),
        ("from relguide.client import Client", "client"),
    ],
)  # fmt: skip
def test_so_does_the_library(program: str, extra: str) -> None:
    done = core(FLOWN.partition("alternatives(found)")[0] + program)
    last = done.stderr.splitlines()[-1]
    assert last.startswith("relguide.planning.extras.MissingExtra: This needs the package ")
    assert f"pip install 'relguide[{extra}]'" in last


def test_help_is_there_whatever_is_installed() -> None:
    program = "import relguide.__main__ as m; m.main([{}])"
    for command in ("", "'plan', ", "'train', ", "'audit', "):
        done = core(program.format(f"{command}'--help'"))
        assert (done.returncode, done.stderr) == (0, "")
