"""`relguide fly` and `replay`: their figures, and what is told of a damaged recording."""

import gzip
import json
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from re import sub
from typing import Any

import pytest

from relguide.cli.flight_tables import print_flight
from relguide.cli.situation_file import read_flight
from relguide.contract.flight_summary import figures, summarize
from relguide.contract.recorder import replay
from relguide.flying.dispersion import disperse_pilot
from relguide.flying.documents import (
    AssignmentChanged,
    EngagementChanged,
    FlightEnded,
    FlightStarted,
    LeaderChanged,
    Sample,
)
from relguide.flying.flight import fly
from relguide.flying.pilot_model import PilotModel
from relguide.flying.scenarios import SCENARIOS
from relguide.planning.plan import plan
from relguide.units import DEG
from tests.command_line import NEAR, UNREACHABLE, Run, process, write
from tests.server.flown import ideal_flight

CREW = str(Path(__file__).parents[3] / "examples" / "crew.jsonl")
FIGURES = {
    "joined",
    "join_time_s",
    "planned_time_s",
    "promised_s",
    "least_separation_m",
    "heading_swing_deg",
    "bank_reversals",
    "replans",
    "replans_announced",
    "fallbacks",
    "plans_by",
    "track_nm",
    "simulated_s",
    "losses",
    "alerts",
    "unables",
    "over_optimum_s",
    "along_error_m",
    "across_error_m",
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


@pytest.mark.slow
@pytest.mark.parametrize("planner", ["regular_dp", "network", "exact"])
def test_each_plan_is_counted_under_its_planner(run: Run, planner: str) -> None:
    """Behind a leader that turns, exact plans keep the branch that is flown."""
    code, out, _ = run("fly", "fig_6a", "--planner", planner, "--json")
    figures = json.loads(out)
    assert code == 0
    assert sum(figures["plans_by"].values()) == 1 + figures["replans"]
    assert set(figures["plans_by"]) <= {planner, "exact"}
    assert figures["plans_by"][planner] > 0
    by_exact = 0 if planner == "exact" else figures["plans_by"].get("exact", 0)
    assert figures["fallbacks"] >= by_exact
    assert (by_exact > 0) == (planner == "regular_dp")


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
    assert told["losses"] == figures["losses"]
    assert told["plans_by"] == figures["plans_by"]
    for name in FIGURES - {"wall_s", "losses", "plans_by"}:
        assert told[name] == pytest.approx(figures[name], rel=1e-9)
    code, out, _ = run("replay", str(file), "--table")
    assert code == 0
    for word in ("plan by exact: engaged", "least separation", "planned by", "fallbacks"):
        assert word in out


def test_what_the_crew_engages_is_a_row_of_the_table(capsys: pytest.CaptureFixture[str]) -> None:
    said = EngagementChanged(
        t=65.0,
        ident="OWN",
        engagement="designated",
        previous="off",
        message="LDR is designated.",
    )
    print_flight(summarize([said]), {"simulated_s": 65.0})
    (row,) = [line for line in capsys.readouterr().out.splitlines() if "designated" in line]
    assert row.split() == ["1:05.0", "designated", "LDR", "is", "designated."]


@pytest.mark.parametrize(
    ("result", "said"),
    [
        ({"joined": False, "join_time": 65.0}, "not joined"),
        (
            {"joined": True, "optimum": 0.0},
            "not known: no plan from the start, or a recorded leader",
        ),
        ({"joined": True, "optimum": 50.0, "join_time": 57.0}, "7 s later"),
    ],
)
def test_a_flight_is_over_the_optimum_only_where_it_joined(
    result: dict[str, Any], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Of a flight that had a plan and did not join, it said that no plan reaches the slot."""
    *_, ended = ideal_flight()
    assert isinstance(ended, FlightEnded)
    first = replace(ended.results[0], **result)
    flight = summarize([replace(ended, results=(first,))])
    print_flight(flight, figures(flight) | {"plans_by": flight.plans_by})
    (row,) = [line for line in capsys.readouterr().out.splitlines() if "over the optimum" in line]
    assert row.removeprefix("over the optimum").strip() == said


@pytest.mark.slow
def test_the_good_part_of_a_damaged_recording_is_printed(
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
    code, out, err = run("replay", "near.jsonl", "--table")
    assert code == 1
    assert "engaged" in out
    assert "ends before its flight does" in err


@pytest.mark.slow
def test_a_baseline_joins_without_a_plan(run: Run) -> None:
    code, out, _ = run("fly", write(NEAR), "--guidance", "trail", "--json")
    figures = json.loads(out)
    assert (code, figures["joined"], figures["plans_by"]) == (0, True, {})


@pytest.mark.slow
def test_fly_without_a_plan_fails(run: Run) -> None:
    code, out, err = run("fly", write(UNREACHABLE), "--json")
    assert code == 1
    assert err == ("relguide: It did not join. The flight ends at its time limit of 3600 s.\n")
    assert json.loads(out)["joined"] is False


@pytest.mark.slow
def test_the_leader_does_as_ordered_and_is_followed_as_long_as_asked(run: Run) -> None:
    orders = [{"t_s": 20, "leader_tas_mps": 190}, {"t_s": 9_000, "intent_known": False}]
    lines = "".join(json.dumps(order) + "\n" for order in orders)
    options = ("--orders", write(lines, "orders.jsonl"), "--after-joining", "30")
    code, out, err = run("fly", write(NEAR), *options, "--record", "a.jsonl", "--json")
    figures = json.loads(out)
    assert (code, figures["joined"], figures["losses"]) == (0, True, [])
    assert figures["simulated_s"] == pytest.approx(figures["join_time_s"] + 30.0, abs=1.0)
    assert figures["replans_announced"] <= figures["replans"]
    assert "before 1 of 2 orders" in err
    changes = [d for d in replay("a.jsonl") if isinstance(d, LeaderChanged)]
    assert [(change.t, change.change) for change in changes] == [(20.0, "speed")]


@pytest.mark.slow
def test_orders_of_a_recording_of_another_scenario_are_given_with_a_word(
    run: Run, flown: tuple[Path, dict[str, Any]]
) -> None:
    file, _ = flown
    recorded = next(d for d in replay(file) if isinstance(d, FlightStarted))
    _, _, err = run("fly", "lesson_bar", "--orders", str(file), "--json")
    assert f"is a flight of {recorded.scenario}, not of lesson_bar" in err
    code, _, err = run("fly", write(NEAR), "--orders", str(file), "--json")
    assert (code, err) == (0, "")


@pytest.mark.slow
def test_a_time_is_kept_and_guidance_flies_by_the_settings_given(run: Run) -> None:
    settings = write("[guidance]\njoined_along_nm = 0.1\nalways_ask = true\n", "own.toml")
    options = ("--spacing", "60", "--settings", settings, "--record", "s.jsonl.gz", "--json")
    code, out, _ = run("fly", write(NEAR), *options)
    assert (code, json.loads(out)["joined"]) == (0, True)
    documents = list(replay("s.jsonl.gz"))
    (started,) = [d for d in documents if isinstance(d, FlightStarted)]
    (link,) = started.links
    assert (link.spacing, link.spacing_time) == ("time", 60.0)
    last = [d for d in documents if isinstance(d, Sample)][-1]
    (guidance,), leader = last.guidance, last.aircraft[1]
    assert guidance.separation == pytest.approx(60.0 * leader.ground_speed, abs=200.0)
    _, out, _ = run("replay", "s.jsonl.gz", "--table")
    assert "once joined 60 s behind" in out
    assert "Joined, and followed for 120 s." in out


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (("--spacing", "0"), "must be a number of seconds from 1 to 600, not 0"),
        (("--spacing", "soon"), "must be a number of seconds from 1 to 600, not soon"),
        (("--settings", "none.toml"), "none.toml"),
    ],
)
def test_a_spacing_that_cannot_be_kept_and_settings_that_are_not_there_are_refused(
    run: Run, options: tuple[str, ...], sentence: str
) -> None:
    code, _, err = run("fly", "fig_6b", *options)
    assert code == 2
    assert sentence in err
    assert "Traceback" not in err


def test_the_air_and_what_is_seen_are_read_from_the_situation_of_a_flight(run: Run) -> None:
    rough = {
        "air": {"gusts_mps": 1.5},
        "believed_air": {"wind": {"from_deg": 270, "speed_mps": 5}},
        "surveillance": {"kind": "adsb", "nacp": 8, "latency_s": 1.0},
    }
    file = write(NEAR | rough)
    code, out, _ = run("fly", file, "--json", "--record", "rough.jsonl")
    figures = json.loads(out)
    assert (code, figures["joined"]) == (0, True)
    samples = [d for d in replay("rough.jsonl") if isinstance(d, Sample)]
    assert samples[1].guidance[0].margin > 0.0
    assert all({"t_s", "reason", "message"} <= set(said) for said in figures["alerts"])
    code, out, err = run("plan", file)
    assert (code, out) == (2, "")
    assert "air: belongs in the situation of a flight (relguide fly FILE" in err


def test_gusts_are_asked_for_on_the_command_line(run: Run) -> None:
    calm, rough = (
        json.loads(run("fly", write(NEAR), "--json", *more)[1]) for more in ((), ("--gusts", "1.5"))
    )
    assert rough["joined"]
    assert rough["across_error_m"] > calm["across_error_m"]
    code, _, err = run("fly", write(NEAR), "--gusts", "11")
    assert code == 2
    assert "must lie in 0 … 10 m/s, not 11" in err


def test_winds_by_altitude_come_from_a_file(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "winds.csv"
    file.write_text("altitude_m,u_mps,v_mps\n3000,0,0\n9449,0,-30\n")
    calm, windy = (
        json.loads(run("fly", write(NEAR), "--json", *more)[1])
        for more in ((), ("--winds", str(file)))
    )
    assert windy["joined"]
    assert windy["track_nm"] != pytest.approx(calm["track_nm"], rel=1e-3)
    file.write_text("altitude_m,u_mps\n3000,0\n")
    code, out, err = run("fly", write(NEAR), "--winds", str(file))
    assert (code, out) == (2, "")
    assert "winds.csv, line 1" in err


@pytest.mark.slow
def test_an_hour_of_following_makes_the_flight_longer_than_an_hour(run: Run) -> None:
    code, out, _ = run("fly", write(NEAR), "--after-joining", "3600", "--json")
    figures = json.loads(out)
    assert code == 0
    assert figures["simulated_s"] == pytest.approx(figures["join_time_s"] + 3600.0, abs=1.0)


@pytest.mark.slow
def test_a_recording_has_the_samples_asked_for(run: Run) -> None:
    for options, period in (((), 1.0), (("--sample-rate", "5"), 0.2)):
        assert run("fly", write(NEAR), "--record", "a.jsonl", *options)[0] == 0
        times = [d.t for d in replay("a.jsonl") if isinstance(d, Sample)]
        steps = {round(later - t, 6) for t, later in pairwise(times)}
        assert (times[0], steps) == (0.0, {period})


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (("--sample-rate", "3", "--record", "a.jsonl"), "must be 20 or a whole part of it, as 1, "),
        (("--sample-rate", "0", "--record", "a.jsonl"), "must be 20 or a whole part of it, as 1, "),
        (("--sample-rate", "x", "--record", "a.jsonl"), "must be 20 or a whole part of it, as 1, "),
        (("--sample-rate", "5"), "--sample-rate is for a recording: add --record FILE."),
    ],
)
def test_a_rate_without_whole_steps_or_a_recording_is_misuse(
    run: Run, options: tuple[str, ...], sentence: str
) -> None:
    code, out, err = run("fly", "fig_6b", *options)
    assert (code, out) == (2, "")
    assert sentence in err


@pytest.mark.parametrize(
    ("name", "said"), [("fig6b", "fig_6b"), ("fig-6a", "fig_6a"), ("randon", "random")]
)
def test_a_mistyped_scenario_is_guessed_and_all_are_listed(run: Run, name: str, said: str) -> None:
    code, out, err = run("fly", name)
    assert (code, out) == (2, "")
    listed = ", ".join([*SCENARIOS, "random"])
    assert f"(did you mean {said}?); there are {listed}." in err


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (("--orders", "none.jsonl"), "none.jsonl: No such file or directory."),
        (("--orders", "bad.jsonl"), "bad.jsonl, line 2: t_s: must be at least 5"),
        (("--after-joining", "nan"), "must be a number of seconds from 0 to 36000, not nan"),
        (("--after-joining", "-1"), "must be a number of seconds from 0 to 36000, not -1"),
        (("--after-joining", "soon"), "must be a number of seconds from 0 to 36000, not soon"),
    ],
)
def test_wrong_orders_and_times_are_misuse(
    run: Run, options: tuple[str, str], sentence: str
) -> None:
    write('{"t_s": 5, "intent_known": true}\n{"t_s": 4, "intent_known": true}\n', "bad.jsonl")
    code, out, err = run("fly", "fig_6b", *options)
    assert (code, out) == (2, "")
    assert sentence in err


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (("-", "--orders", "-"), "the situation or the orders, not both"),
        (("-", "--crew", "-"), "the situation or the crew, not both"),
        (("fig_6b", "--orders", "-", "--crew", "-"), "the orders or the crew, not both"),
    ],
)
def test_standard_input_is_one_thing(run: Run, options: tuple[str, ...], sentence: str) -> None:
    code, _, err = run("fly", *options)
    assert code == 2
    assert sentence in err


@pytest.mark.slow
def test_a_crew_flies_all_steps_and_its_recording_is_flown_again_alike(run: Run) -> None:
    """By the example's crew: designates, accepts, engages, overrides, disconnects, engages."""
    code, out, _ = run("fly", "fig_6b", "--crew", CREW, "--seed", "7", "--record", "a.jsonl")
    assert (code, json.loads(out)["joined"]) == (0, True)
    said = [d for d in replay("a.jsonl") if isinstance(d, EngagementChanged | AssignmentChanged)]
    steps = [one.engagement for one in said if isinstance(one, EngagementChanged)]
    assert steps == ["designated", "armed", "engaged", "off", "designated", "armed", "engaged"]
    assigned = [one for one in said if isinstance(one, AssignmentChanged)]
    assert [round(one.max_bank / DEG) for one in assigned] == [20] * 5
    assert [one.selected_tas for one in assigned][1:3] == [(230.0,), ()]
    assert assigned[-1].slot_distance == 12_000.0
    assert run("fly", "fig_6b", "--orders", "a.jsonl", "--record", "b.jsonl")[0] == 0
    assert timeless("a.jsonl") == timeless("b.jsonl")
    code, _, err = run("fly", "fig_6b", "--crew", "a.jsonl")
    assert (code, "a.jsonl, line 1: This must have one of engagement" in err) == (2, True)


@pytest.mark.slow
def test_a_recording_by_a_pilot_model_is_flown_again_by_one_or_another_is_said(run: Run) -> None:
    own = write(NEAR)
    assert run("fly", own, "--director", "--record", "a.jsonl")[0] == 0
    _, _, err = run("fly", own, "--orders", "a.jsonl", "--record", "b.jsonl")
    said = "a.jsonl was flown by a pilot model: without --director this is another.\n"
    assert err == f"relguide: {said}"
    _, _, err = run("fly", own, "--orders", "a.jsonl", "--director", "--record", "c.jsonl")
    assert (err, timeless("c.jsonl")) == ("", timeless("a.jsonl"))
    _, _, err = run("fly", own, "--orders", "b.jsonl", "--director")
    said = "b.jsonl was not flown by a pilot model: with --director this is another.\n"
    assert err == f"relguide: {said}"


def timeless(file: str) -> list[str]:
    """The lines of a recording without what plans took to compute."""
    return [sub(r'"compute_ms":[^,}]*', "", line) for line in Path(file).read_text().splitlines()]


def _within_bar(seed: int) -> float:
    """Of a flight by the pilot that a seed draws [s]."""
    flown = replace(read_flight(write(NEAR)), by_hand=disperse_pilot(PilotModel(), seed))
    flight = summarize(fly(flown, plan, seed=seed, sample_period=1.0))
    (result,) = flight.ended[0].results
    return result.by_hand[0].within_bar


@pytest.mark.slow
def test_a_pilot_model_flies_along_the_bars(run: Run) -> None:
    code, out, _ = run("fly", write(NEAR), "--director", "--json")
    figures = json.loads(out)
    assert (code, set(figures)) == (0, FIGURES | {"by_hand"})
    by_hand = figures["by_hand"]
    assert set(by_hand) == {"time_s", "with_bars_s", "within_bar_s", "tube_m"}
    assert by_hand["time_s"] == by_hand["with_bars_s"] == figures["simulated_s"]
    assert 0.5 < by_hand["within_bar_s"] / by_hand["time_s"] < 1.0
    code, out, _ = run("fly", write(NEAR), "--director", "--seed", "7", "--json")
    assert json.loads(out)["by_hand"]["within_bar_s"] == _within_bar(7) != by_hand["within_bar_s"]
    code, out, _ = run("fly", write(NEAR), "--director", "--table")
    assert "the bar within 2° for" in out
