"""How deviations are found: `python -m benchmarks.conformance --flights 1000 --deviations 1000`.

Flights drawn at random are flown, and watched against their forecast at engagement: what the
monitor says of them is false. Deviations are put into them then; each is to be found within 10 s of
leaving its threshold. The table goes to benchmarks/results/conformance.csv.
"""

import argparse
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from itertools import count
from statistics import median
from time import monotonic

import numpy as np
from rich.console import Console

from benchmarks.deviations import INJECTIONS, Deviating, Watched
from benchmarks.options import positive
from benchmarks.tables import Cells, markdown, write_table
from relguide.atc.conformance import Memory, still_covers, watch
from relguide.atc.picture import Seen
from relguide.atc.request import Manoeuvre
from relguide.atc.track import Track
from relguide.atc.tracks import intent_track, points_track
from relguide.flying.aircraft_documents import AircraftSample, find_by_ident
from relguide.flying.dispersion import random_situation
from relguide.flying.documents import FlightStarted, ForecastChanged, PlanChanged, Sample
from relguide.flying.flight import Scenario, world_of
from relguide.flying.scenarios import own_scenario
from relguide.flying.simulation import simulate
from relguide.kernels.base.angles import wrap
from relguide.planning.heights import Heights
from relguide.planning.outcome import Plan
from relguide.planning.plan import plan
from relguide.units import DEG, Metre, Radian, Second

LONGEST: Second = 1_800.0
"""Flights that are planned to take longer are not drawn."""
FOUND_WITHIN: Second = 10.0
NOISE: Metre = 25.0
"""σ of reported places, to each side [m] …"""
TRACK_NOISE: Radian = 0.5 * DEG
"""… and of reported directions."""
BATCH = 20
NAME = "conformance.csv"
EXACT, REPORTED = "calm, seen exactly", "calm, as reported"


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """What the monitor said of one flight."""

    kind: str
    number: int
    seconds: int
    """How long it was watched."""
    cautions: int
    """Deviations that began while the flight did not deviate."""
    alerts: int
    """Those of them that became alerts."""
    found: Second | None
    """How long after it left its threshold; `None` of a calm flight, or never."""

    @property
    def failed(self) -> bool:
        """Whether it was not found in time, or what was said was false."""
        late = self.kind in INJECTIONS and (self.found is None or self.found > FOUND_WITHIN)
        return late or self.cautions > 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Fly, put deviations in, and show what was found; 1 if one was not, or a calm flight was."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.conformance", description=__doc__)
    parser.add_argument("--flights", type=positive, default=1_000)
    parser.add_argument("--deviations", type=positive, default=1_000)
    parser.add_argument("--processes", type=positive, default=1)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--minutes", type=positive, default=600, help="no flight begins later")
    parser.add_argument("--keep", action="store_true", help="write the table")
    asked = parser.parse_args(arguments)
    console = Console(stderr=True, soft_wrap=True, highlight=False, markup=False)
    until = monotonic() + 60.0 * asked.minutes
    measured = measure_all(asked.flights, asked.deviations, asked.processes, asked.seed, until)
    outcomes = list(measured)
    cells = table(outcomes)
    shown = markdown(HEADINGS, cells)
    if asked.keep:
        write_table(NAME, HEADINGS, cells)
    Console(soft_wrap=True, highlight=False, markup=False).print(shown)
    failed = [one for one in outcomes if one.failed]
    for one in failed:
        console.print(one)
    return 1 if failed else 0


def measure_all(
    flights: int, deviations: int, processes: int, seed: int, until: Second
) -> Iterator[Outcome]:
    """So many flights, the first of them with deviations put in until there are enough."""
    flown, put_in = 0, 0
    with ProcessPoolExecutor(processes) as pool:
        for first in count(seed, BATCH):
            kinds = tuple(INJECTIONS) if put_in < deviations else ()
            drawn = pool.map(partial(measure, kinds=kinds), range(first, first + BATCH))
            for found in filter(None, drawn):
                calm, deviating = found[:2], found[2:][: deviations - put_in]
                yield from (*calm, *deviating)
                flown, put_in = flown + 1, put_in + len(deviating)
                if flown == flights or monotonic() >= until:
                    return


def measure(number: int, kinds: Sequence[str]) -> list[Outcome]:
    """What the monitor says of a flight, calm and deviating; nothing if it is not flown."""
    flight = fly_one(number)
    if flight is None:
        return []
    rng = np.random.default_rng([number, 56])
    found = [_calm(EXACT, flight, flight.own), _calm(REPORTED, flight, _reported(flight.own, rng))]
    for kind in kinds:
        deviating = INJECTIONS[kind](flight, rng)
        if deviating is not None:
            found.append(_find(flight, deviating))
    return found


def fly_one(number: int) -> Watched | None:
    """A flight drawn at random, as long as what it flies is covered by its forecast at engagement.

    `None` if there is no plan for it, or no level at which it can be flown.
    """
    situation = random_situation(number)
    planned = plan(situation)
    if not isinstance(planned, Plan) or planned.time_to_converge > LONGEST:
        return None
    try:
        scenario = own_scenario(situation)
    except ValueError:
        return None
    manoeuvre, pursuer, leader = None, "", ""
    own: list[Seen] = []
    ahead: list[Seen] = []
    joins: Second = 0.0
    for document in simulate(world_of(scenario), plan, until=2.0 * LONGEST, sample_period=1.0):
        match document:
            case FlightStarted(links=(link,)):
                pursuer, leader = link.pursuer, link.leader
            case PlanChanged():
                joins = document.t + document.promised
            case ForecastChanged() if manoeuvre is None:
                manoeuvre = _manoeuvre(scenario, document, leader, joins)
            case ForecastChanged() if not still_covers(manoeuvre, _track(scenario, document)):
                break
            case Sample() if manoeuvre is not None:
                own.append(_seen(find_by_ident(document.aircraft, pursuer), document.t))
                ahead.append(_seen(find_by_ident(document.aircraft, leader), document.t))
            case _:
                pass
    if manoeuvre is None:
        return None
    return Watched(number=number, manoeuvre=manoeuvre, own=tuple(own), leader=tuple(ahead))


def _manoeuvre(
    scenario: Scenario, forecast: ForecastChanged, leader: str, joins: Second
) -> Manoeuvre:
    situation = scenario.situation
    until = forecast.times[-1] + 300.0
    return Manoeuvre(
        ident=forecast.ident,
        leader=leader,
        spacing_type="distance",
        spacing=situation.slot_distance,
        min_separation=situation.min_separation,
        path=_track(scenario, forecast),
        joins=joins,
        leader_path=intent_track(situation.leader, start=0.0, until=until, wind=situation.wind),
    )


def _track(scenario: Scenario, forecast: ForecastChanged) -> Track:
    return points_track(
        forecast.times,
        forecast.x,
        forecast.y,
        forecast.heading,
        heights=Heights(altitude=scenario.altitude),
        wind=scenario.situation.wind,
    )


def _seen(aircraft: AircraftSample, t: Second) -> Seen:
    return Seen(
        ident=aircraft.ident,
        t=t,
        x=aircraft.x,
        y=aircraft.y,
        track=aircraft.track,
        ground_speed=aircraft.ground_speed,
        altitude=aircraft.altitude,
    )


def _reported(own: Sequence[Seen], rng: np.random.Generator) -> list[Seen]:
    """As a feed reports it."""
    east, north = rng.normal(0.0, NOISE, (2, len(own))).tolist()
    turned = rng.normal(0.0, TRACK_NOISE, len(own)).tolist()
    return [
        replace(seen, x=seen.x + x, y=seen.y + y, track=wrap(seen.track + angle))
        for seen, x, y, angle in zip(own, east, north, turned, strict=True)
    ]


def _calm(kind: str, flight: Watched, own: Sequence[Seen]) -> Outcome:
    memory, cautions, alerts = Memory(), 0, 0
    stood: set[tuple[str, str]] = set()
    for seen, leader in zip(own, flight.leader, strict=True):
        memory, deviations = watch(memory, seen, flight.manoeuvre, leader, seen.t)
        stand = {(one.subject, one.level) for one in deviations}
        cautions += len({subject for subject, _ in stand} - {subject for subject, _ in stood})
        alerts += len({one for one in stand - stood if one[1] == "alert"})
        stood = stand
    return Outcome(
        kind=kind,
        number=flight.number,
        seconds=len(own),
        cautions=cautions,
        alerts=alerts,
        found=None,
    )


def _find(flight: Watched, deviating: Deviating) -> Outcome:
    """Watch it from the beginning until its deviation is found, or should have been."""
    memory, last, found = Memory(), deviating.leaves + 60, None
    pairs = list(zip(deviating.own, flight.leader, strict=False))[: last + 1]
    for k, (seen, leader) in enumerate(pairs):
        memory, deviations = watch(memory, seen, flight.manoeuvre, leader, seen.t)
        if k >= deviating.begins and any(one.subject == deviating.subject for one in deviations):
            found = float(k - deviating.leaves)
            break
    return Outcome(
        kind=deviating.kind,
        number=flight.number,
        seconds=len(pairs),
        cautions=0,
        alerts=0,
        found=found,
    )


HEADINGS = ("", "flights", "watched", "false", "found within 10 s", "after: median", "at most")


def table(outcomes: Sequence[Outcome]) -> Cells:
    """A line a kind."""
    kinds = (EXACT, REPORTED, *INJECTIONS)
    return [_line(kind, [one for one in outcomes if one.kind == kind]) for kind in kinds]


def _line(kind: str, outcomes: Sequence[Outcome]) -> list[str]:
    hours = sum(one.seconds for one in outcomes) / 3600.0
    if kind not in INJECTIONS:
        false = sum(one.cautions for one in outcomes)
        return [kind, f"{len(outcomes):,}", f"{hours:.0f} h", f"{false}", "–", "–", "–"]
    after = [max(one.found, 0.0) for one in outcomes if one.found is not None]
    in_time = sum(not one.failed for one in outcomes)
    return [
        kind,
        f"{len(outcomes):,}",
        "–",
        "–",
        f"{in_time:,}",
        f"{median(after):.0f} s" if after else "–",
        f"{max(after):.0f} s" if after else "–",
    ]


if __name__ == "__main__":
    sys.exit(main())
