"""`relguide campaign`: flown, reported, shown and recorded again from the command line."""

import json
from pathlib import Path

import pytest

from relguide.campaign.keys import KEYS
from relguide.contract.recorder import replay
from relguide.flying.documents import FlightEnded
from tests.command_line import Run

FILE = """
[campaign]
flights = 3
family = ["declared", "follow"]
limit_s = 400
[vary]
wind_error_mps = { normal = [0, 2] }
"""


@pytest.mark.slow
def test_a_campaign_is_flown_reported_shown_and_recorded(run: Run) -> None:
    Path("run.toml").write_text(FILE)
    code, out, err = run("campaign", "run.toml", "--dry-run")
    assert (code, err) == (0, "")
    asked = json.loads(out)
    assert asked["points"] == ["declared", "follow"]
    assert (asked["total"], asked["parts"]) == (6, 1)
    assert not Path("out").exists()

    assert run("campaign", "run.toml", "--out", "out", "--processes", "1") == (
        0, "out: 6 flights, 6 of them flown now.\n", "",
    )  # fmt: skip
    assert run("campaign", "run.toml", "--out", "out")[1] == (
        "out: 6 flights, 0 of them flown now.\n"
    )

    code, out, err = run("campaign", "report", "out", "--json", "--figure", "run.svg")
    assert (code, err) == (0, "")
    found = json.loads(out)
    declared, follow = found["points"]
    assert (declared["family"], follow["flights"]) == ("declared", 3)
    assert set(declared["shares"]["joined"]) == {"hits", "of", "interval_95"}
    least = declared["figures"]["least separation, d_min"]
    assert least["quantiles"]["0.95"]["value"] >= 1.0
    worst = found["worst"]["least separation, d_min"]
    assert worst[0]["value"] <= worst[-1]["value"]
    assert worst[0]["command"] == f"relguide campaign show out {worst[0]['flight']}"
    assert "<svg" in Path("run.svg").read_text()

    code, out, _ = run("campaign", "report", "out", "--table")
    assert code == 0
    for words in ("share of flights, %", "its 95 % interval", "worst flights", "show out N"):
        assert words in out

    number = worst[0]["flight"]
    code, out, err = run("campaign", "show", "out", str(number), "--json")
    assert (code, err) == (0, "")
    shown = json.loads(out)
    assert shown["flight"] == number
    situation = next(line for line in shown["code"] if line.startswith("situation = "))
    d_min = float(situation.rpartition("min_separation=")[2].partition(",")[0])
    assert shown["least_separation_m"] / d_min == pytest.approx(worst[0]["value"], rel=1e-12)

    code, _, err = run("campaign", "replay", "out", str(number), "--table")
    assert code == 0
    assert f"out/flight-{number}.jsonl" in err
    *_, end = replay(f"out/flight-{number}.jsonl")
    assert isinstance(end, FlightEnded)
    assert end.results[0].least_separation == pytest.approx(shown["least_separation_m"])


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("run.toml",), "Name the folder that keeps the flights: --out DIR."),
        (("run.toml", "more"), "run.toml is followed by more: give one FILE.toml, or report DIR"),
        (("show", "out"), "relguide campaign show takes DIR N."),
        (("report",), "relguide campaign report takes DIR."),
        (("report", "nowhere"), "nowhere is no folder of a campaign"),
        (("nothing.toml", "--out", "out"), "nothing.toml: No such file or directory."),
    ],
)
def test_misuse_is_said(run: Run, arguments: tuple[str, ...], sentence: str) -> None:
    Path("run.toml").write_text(FILE)
    code, out, err = run("campaign", *arguments)
    assert (code, out) == (2, "")
    assert sentence in err


def test_without_pyarrow_a_sentence_names_the_extra(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    from relguide.planning import extras

    monkeypatch.setattr(extras, "is_installed", lambda package: package != "pyarrow")
    Path("run.toml").write_text(FILE)
    code, _, err = run("campaign", "run.toml", "--out", "out")
    assert code == 2
    assert "pip install 'relguide[parquet]' brings it." in err
    assert not Path("out").exists()


def test_what_may_be_varied_is_listed(run: Run) -> None:
    code, out, err = run("campaign", "keys", "--json")
    assert (code, err) == (0, "")
    listed = json.loads(out)
    assert list(listed) == list(KEYS)
    assert listed["wind_mps"] == {"least": 0.0, "most": 150.0, "says": "wind speed"}
    code, out, _ = run("campaign", "keys", "--table")
    assert code == 0
    for words in ("key of vary, sweep", "start_distance_m", "1,000,000", "where it comes from"):
        assert words in out
    assert run("campaign", "keys", "wind_mps") == (
        2, "", "relguide: relguide campaign keys takes nothing after it.\n",
    )  # fmt: skip
