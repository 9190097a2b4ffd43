"""`relguide fly`: a scenario, a situation or a recorded leader, flown in the closed loop."""

import argparse
from dataclasses import replace
from itertools import islice
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

from relguide.cli.output import DONE, FAILED, say, write_json
from relguide.cli.shared_options import add_planner
from relguide.cli.situation_file import read_situation
from relguide.learn.planners import make_planner
from relguide.planning.extras import need

if TYPE_CHECKING:
    from relguide.flying.flight import Scenario

PURPOSE = "fly a scenario, a situation or behind a recorded track"
EXAMPLES = """
    relguide fly fig_6b                          the paper's figure with intent
    relguide fly fig_6a --json                   without; the figures as JSON
    relguide fly situation.json --record a.jsonl your own situation, recorded
    relguide fly track.csv                       behind a recorded ADS-B track
    """
LOADING = 40
"""Documents of a flight flown beforehand, so that the compiled kernels are loaded: that takes
seconds and is no part of what is measured."""


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of `relguide fly`."""
    parser.add_argument(
        "scenario", metavar="SCENARIO|FILE", help="a scenario's name, a .json or a .csv file"
    )
    parser.add_argument(
        "--record", metavar="FILE", type=_recording, help="write a .jsonl or .jsonl.gz recording"
    )
    parser.add_argument(
        "--seed", metavar="N", type=_seed, default=0, help="of the random numbers; default: 0"
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    add_planner(parser)


def run(chosen: argparse.Namespace) -> int:
    """Fly, and print how it went: did it join, and keep d_min?"""
    need("pydantic", "orjson", "rich")
    from relguide.contract.recorder import record
    from relguide.contract.story import failures, figures, story_of
    from relguide.flying.flight import fly
    from relguide.planning.progress import watched

    scenario = _scenario(chosen.scenario)
    planner = make_planner(chosen.planner)
    for _ in islice(fly(scenario, planner, sample_period=1.0), LOADING):
        pass
    started = perf_counter()
    if chosen.record is None:
        # nobody looks at the samples: one a second is enough for the progress bar
        documents = fly(scenario, planner, seed=chosen.seed, sample_period=1.0)
    else:
        documents = record(fly(scenario, planner, seed=chosen.seed), chosen.record)
    flight = story_of(
        watched(
            documents,
            title=f"flying {scenario.name}",
            total=scenario.duration_limit,
            done=lambda document: document.t,
        )
    )
    if flight.broken:
        raise ValueError(flight.broken)
    result = figures(flight.ended[0]) | {"wall_s": perf_counter() - started}
    if chosen.json:
        write_json(result)
    else:
        from relguide.cli.flight_tables import print_flight

        print_flight(flight, result)
    failed = failures(flight)
    for sentence in failed:
        say(sentence)
    return FAILED if failed else DONE


def _scenario(name: str) -> "Scenario":
    from relguide.flying.scenarios import own_scenario, scenario, scenario_behind

    path = Path(name)
    if path.suffix == ".csv":
        from relguide.flying.tracks import load_track

        return scenario_behind(load_track(path))
    if path.suffix == ".json" or name == "-" or path.is_file():
        situation, _, _ = read_situation(name)
        title = (
            "The situation of standard input" if name == "-" else f"The situation of {path.name}"
        )
        return replace(own_scenario(situation), title=title)
    return scenario(name)


def _seed(text: str) -> int:
    if not (text.isascii() and text.isdigit() and int(text[:12]) < 2**32):
        raise argparse.ArgumentTypeError(f"must be a whole number from 0 to 2³² − 1, not {text}")
    return int(text)


def _recording(text: str) -> str:
    from relguide.contract.recorder import check_name

    try:
        check_name(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None
    return text
