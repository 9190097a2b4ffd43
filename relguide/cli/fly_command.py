"""`relguide fly`: a scenario, a situation or a recorded leader, flown in the closed loop."""

import argparse
from dataclasses import replace
from functools import partial
from itertools import islice
from math import nan
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

from relguide.cli.order_files import read_ordered
from relguide.cli.output import DONE, FAILED, add_form, for_people, say, write_json
from relguide.cli.shared_options import add_planner, seconds
from relguide.cli.situation_file import read_flight
from relguide.flying.guidances import GUIDANCES
from relguide.learn.planners import make_planner
from relguide.planning.inputs import expect_within
from relguide.planning.limits import SPACING

if TYPE_CHECKING:
    from relguide.flying.flight import Scenario
    from relguide.flying.tracks import RecordedTrack

PURPOSE = "fly a scenario, a situation or behind a recorded track"
EXAMPLES = """
    relguide fly fig_6b                          the paper's figure with intent
    relguide fly fig_6a --json                   without; the figures as JSON
    relguide fly situation.json --record a.jsonl your own situation, recorded each second
    relguide fly fig_6b --record a.jsonl --sample-rate 20
    relguide fly track.csv                       behind a recorded ADS-B track
    relguide fly day.csv.gz --callsign SVA127    behind one of several in a file
    relguide fly quickstart:SVA127               behind one of the package traffic's
    relguide fly random --seed 7                 a flight drawn from that number
    relguide fly fig_6b --spacing 60             once joined, a minute behind
    relguide fly fig_6b --gusts 1.5              in light turbulence
    relguide fly fig_6b --winds winds.csv        in a wind that changes with altitude
    relguide fly fig_6a --guidance trail         by a baseline, which does not plan
    relguide fly fig_6b --orders orders.jsonl    the leader does as it is ordered, a line an order:
        {"t_s": 60, "intent_known": false}
        {"t_s": 300, "leader_heading_deg": 180, "direction": "left"}
        {"t_s": 950, "leader_tas_mps": 100}
    with "ident": "NAME" in it, another than the leader does so
    relguide fly fig_6b --orders a.jsonl         flown again by the orders that a recording holds
    relguide fly fig_6b --crew examples/crew.jsonl   engaged by a crew that reacts
    relguide fly fig_6b --director               by hand: a pilot model follows the bars
    """
MAX_FOLLOWING = 36_000.0
"""Longest time to follow [s]."""
MOST_SAMPLES = 20.0
"""A second: one each step of the simulation [Hz]."""
LOADING = 40
"""Documents of a flight flown beforehand, so that the compiled kernels are loaded: that takes
seconds and is no part of what is measured."""


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of `relguide fly`."""
    parser.add_argument(
        "scenario",
        metavar="SCENARIO|FILE|COLLECTION:NAME",
        help="a scenario's name, a situation in .json, a file of recorded flights (.csv, .tsv, "
        ".scn, .json; also .gz), or a recorded flight of the package traffic",
    )
    parser.add_argument(
        "--callsign",
        metavar="NAME",
        default="",
        help="which of a file's flights leads: its callsign or address; NAME/2 is its second one",
    )
    parser.add_argument(
        "--record", metavar="FILE", type=_recording, help="write a .jsonl or .jsonl.gz recording"
    )
    parser.add_argument(
        "--sample-rate",
        metavar="HZ",
        type=_sample_rate,
        help="samples a second in the recording: 20 or a whole part of it; default: 1",
    )
    parser.add_argument(
        "--seed",
        metavar="N",
        type=_seed,
        help="0, the default, flies the type as its data say; others draw its constants by chance, "
        "and those of the pilot model; a flight that is flown again has the one of its recording",
    )
    parser.add_argument(
        "--orders",
        metavar="FILE",
        help="what the leader, the crew or the aircraft named is to do: JSON lines in order of "
        "time, -: standard input; or a recording, whose flight is flown again",
    )
    parser.add_argument(
        "--crew",
        metavar="FILE",
        help="what the crew orders, JSON lines that may wait for what is said of the flight; "
        "guidance is off at the start, unless the first line engages it at 0 s",
    )
    parser.add_argument(
        "--director",
        action="store_true",
        help="a pilot model flies the pursuer by hand, along the flight director's bars; what it "
        "adds by chance goes by --seed",
    )
    parser.add_argument(
        "--after-joining",
        metavar="SECONDS",
        type=_following,
        default=120.0,
        help="how long to go on once joined; default: 120",
    )
    parser.add_argument(
        "--spacing",
        metavar="SECONDS",
        type=_spacing,
        help="once joined, keep this time behind the leader; default: keep D",
    )
    parser.add_argument(
        "--gusts", metavar="MPS", type=_gusts, help="σ of gusts [m/s]; 1.5 is light turbulence"
    )
    parser.add_argument(
        "--winds",
        metavar="FILE",
        help="winds by altitude, a CSV file: altitude_m, altitude_ft or flight_level, and from_deg "
        "with speed_mps or speed_kt, or u_mps and v_mps",
    )
    parser.add_argument(
        "--settings", metavar="FILE", help="constants of guidance, a TOML table [guidance]"
    )
    parser.add_argument(
        "--guidance",
        choices=GUIDANCES,
        default="relguide",
        help="; ".join(f"{name}: {does}" for name, does in GUIDANCES.items())
        + "; default: relguide. All others neither plan nor look at d_min",
    )
    add_form(parser)
    add_planner(parser)


def run(chosen: argparse.Namespace) -> int:
    """Fly, and print how it went: did it join, and keep d_min?"""
    table = for_people(chosen, "rich")
    from relguide.contract.flight_summary import failures, figures, summarize
    from relguide.contract.orders import commands_of, expect_flying
    from relguide.contract.recorder import record
    from relguide.flying.dispersion import disperse_pilot
    from relguide.flying.fans import all_fans, no_fans
    from relguide.flying.flight import fly, world_of
    from relguide.flying.guidance.settings import DEFAULT, load_settings
    from relguide.flying.pilot_model import PilotModel
    from relguide.flying.scripted_crew import with_crew
    from relguide.planning.progress import show_progress

    if chosen.sample_rate is not None and chosen.record is None:
        raise ValueError("--sample-rate is for a recording: add --record FILE.")
    orders, script, engagement, seed, recorded, by_pilot = read_ordered(
        chosen.scenario, chosen.orders, chosen.crew, chosen.seed
    )
    scenario = _scenario(chosen.scenario, seed, chosen.callsign)
    scenario = _following_for(scenario, chosen.after_joining)
    if chosen.spacing is not None:
        scenario = replace(scenario, spacing=chosen.spacing)
    if chosen.gusts is not None:
        scenario = replace(scenario, gusts=chosen.gusts)
    if chosen.winds is not None:
        scenario = _in_winds(scenario, chosen.winds)
    if chosen.director:
        scenario = replace(scenario, by_hand=disperse_pilot(PilotModel(), seed))
    expect_flying(orders, script, world_of(scenario))
    if recorded not in ("", scenario.name):
        say(f"{chosen.orders} is a flight of {recorded}, not of {scenario.name}: this is another.")
    if recorded and by_pilot != (scenario.by_hand is not None):
        was, asked = ("was", "without") if by_pilot else ("was not", "with")
        say(f"{chosen.orders} {was} flown by a pilot model: {asked} --director this is another.")
    settings = DEFAULT if chosen.settings is None else load_settings(chosen.settings)
    planner = make_planner(chosen.planner)
    flown = partial(
        fly,
        scenario,
        planner,
        seed=seed,
        engagement=engagement,
        settings=settings,
        guidance=chosen.guidance,
        planner_name=chosen.planner,
        wants_fan=no_fans if chosen.record is None else all_fans,
    )
    for _ in islice(flown(sample_period=1.0), LOADING):
        pass
    started = perf_counter()
    # unrecorded, one a second is enough for the progress bar
    rate = chosen.sample_rate or 1.0
    documents = with_crew(script, partial(flown, sample_period=1.0 / rate), commands_of(orders))
    if chosen.record is not None:
        documents = record(documents, chosen.record, sample_rate=rate)
    flight = summarize(
        show_progress(
            documents,
            title=f"flying {scenario.name}",
            total=scenario.duration_limit,
            done=lambda document: document.t,
        )
    )
    if flight.broken:
        raise ValueError(flight.broken)
    result = figures(flight) | {
        "plans_by": flight.plans_by,
        "wall_s": perf_counter() - started,
    }
    if table:
        from relguide.cli.flight_tables import print_flight

        print_flight(flight, result)
    else:
        write_json(result)
    late = sum(order.t > flight.last_time for order in orders)
    if late:
        say(f"The flight ended at {flight.last_time:.0f} s, before {late} of {len(orders)} orders.")
    failed = failures(flight)
    for sentence in failed:
        say(sentence)
    return FAILED if failed else DONE


def _following_for(scenario: "Scenario", after_joining: float) -> "Scenario":
    """The scenario with this time to follow, and as much longer to fly as that is longer."""
    longer = max(after_joining - scenario.after_joining, 0.0)
    return replace(
        scenario, after_joining=after_joining, duration_limit=scenario.duration_limit + longer
    )


def _scenario(name: str, seed: int, callsign: str) -> "Scenario":
    from relguide.flying.scenarios import (
        SCENARIOS,
        no_scenario,
        random_scenario,
        scenario,
        scenario_behind,
    )

    track = _recorded(name, callsign)
    if track is not None:
        say(track.taken)
        return scenario_behind(track)
    if callsign:
        raise ValueError(f"--callsign is for a file of recorded flights, and {name} is none.")
    path = Path(name)
    if path.suffix.lower() == ".json" or name == "-" or path.is_file():
        own = _own(path if name != "-" else None)
        title = (
            "The situation of standard input" if name == "-" else f"The situation of {path.name}"
        )
        return replace(own, title=title)
    if name == "random":
        return random_scenario(seed)
    if name not in SCENARIOS:
        raise ValueError(no_scenario(name, [*SCENARIOS, "random"]))
    return scenario(name)


def _recorded(name: str, callsign: str) -> "RecordedTrack | None":
    """The recorded leader that is meant, if one is."""
    from relguide.flying.recordings.files import is_recording, load_track
    from relguide.flying.recordings.samples import load_sample

    path = Path(name)
    collection, _, flight = name.partition(":")
    if flight and not path.exists():
        return load_sample(flight, collection)
    if name != "-" and is_recording(path):
        return load_track(path, callsign)
    return None


def _own(path: Path | None) -> "Scenario":
    """The situation of a file, or of standard input, to be flown."""
    from relguide.contract.refusal import ContractError
    from relguide.flying.recordings.files import FORMS

    try:
        return read_flight("-" if path is None else str(path))
    except ContractError as refused:
        is_situation = {"pursuer", "leader"}.isdisjoint(field for field, _ in refused.problems)
        if path is None or (path.suffix.lower() == ".json" and is_situation):
            raise
        raise ValueError(f"{refused} Flown are situations (.json) and {FORMS}.") from None


def _seed(text: str) -> int:
    if not (text.isascii() and text.isdigit() and int(text[:12]) < 2**32):
        raise argparse.ArgumentTypeError(f"must be a whole number from 0 to 2³² − 1, not {text}")
    return int(text)


def _sample_rate(text: str) -> float:
    try:
        steps = MOST_SAMPLES / float(text)
    except (ValueError, ZeroDivisionError):
        steps = nan
    if not (1.0 <= steps <= 3600.0 and abs(steps - round(steps)) < 1e-9):
        raise argparse.ArgumentTypeError(
            f"must be {MOST_SAMPLES:g} or a whole part of it, as 1, 2 and 5 are, not {text}"
        )
    return float(text)


def _following(text: str) -> float:
    return seconds(text, 0.0, MAX_FOLLOWING)


def _spacing(text: str) -> float:
    return seconds(text, 1.0, SPACING.high)


def _in_winds(scenario: "Scenario", file: str) -> "Scenario":
    """A scenario in the winds of a file, in place of the one wind of its situation."""
    from relguide.flying.wind_profile import load_profile
    from relguide.planning.wind import CALM

    return replace(
        scenario, situation=replace(scenario.situation, wind=CALM), profile=load_profile(file)
    )


def _gusts(text: str) -> float:
    from relguide.flying.air import GUSTS

    try:
        return expect_within("gusts", float(text), *GUSTS)
    except ValueError:
        low, high, unit, _ = GUSTS
        said = f"must lie in {low:g} … {high:g} {unit}, not {text}"
        raise argparse.ArgumentTypeError(said) from None


def _recording(text: str) -> str:
    from relguide.contract.recorder import check_name

    try:
        check_name(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None
    return text
