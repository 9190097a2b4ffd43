"""What workers do: functions of what can be sent to another process, which give JSON text back."""

import gzip
import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from importlib.metadata import version
from time import monotonic, perf_counter, thread_time
from typing import Any, Literal

import orjson
from pydantic import TypeAdapter

from relguide.contract.answers import Form, Include, answer, answer_plan
from relguide.contract.area_bodies import area_to_wire
from relguide.contract.bodies import (
    NamedSituationBody,
    SituationBody,
    path_to_wire,
    situation_from_body,
)
from relguide.contract.bulk import answer_line
from relguide.contract.flight_summary import figures, summarize
from relguide.contract.messages import FlightRequest
from relguide.contract.orders import commands_of
from relguide.contract.places import Anchor, Unanchored
from relguide.contract.recorder import recording_of
from relguide.contract.refusal import ContractError, parse
from relguide.flying.fans import all_fans
from relguide.flying.flight import fly
from relguide.flying.scripted_crew import with_crew
from relguide.flying.verdicts import ComparedPlanner
from relguide.learn.planners import make_planner
from relguide.learn.words.area_words import area_words
from relguide.learn.words.branch_network import BranchNetwork, load_network
from relguide.maps.isochrones import Grid, isochrones, times_around
from relguide.planning.deadline import LOADING, TO_LOOK_ROUND, load_kernels
from relguide.planning.outcome import Planner, Reason
from relguide.planning.plan import plan_at_once as exact_plan_at_once
from relguide.planning.situation import Situation
from relguide.units import Second
from relguide_server.flights.flight_requests import ordered_in, scenario_of
from relguide_server.http.bodies import parse_json
from relguide_server.http.errors import Refusal, refusal_of

_REQUEST: TypeAdapter[FlightRequest] = TypeAdapter(FlightRequest)
MAX_BATCH = 1000
"""Most situations in one request."""
MAX_LINE = 64 * 1024
"""Longest situation [bytes]."""


LEAST: Second = 1e-3
"""Each situation is planned for so long at least, however late it is [s]."""
LEAST_WITH_MORE: Second = 0.02
"""The same where alternatives are asked for."""
PACKING = 6
"""Level of gzip of a recording: it takes some hundredths of a second."""
LEAST_WITH_FLIGHT: Second = 0.04
"""The same where the flight is: it is flown ahead in 4 ms, or in more on a busy machine."""
CUT = 0.9
"""What took this much of its time is taken to have been cut short."""


@dataclass(frozen=True, slots=True)
class PlanReply:
    """The answer to a situation, and what is counted of it."""

    text: bytes
    status: str
    reason: str
    """Why there is no plan; empty if there is one."""
    seconds: float
    """How long it took."""
    final: bool
    """Whether more time would not change it: it is proved, or a network is sure of it."""
    processor: Second = 0.0
    """How much of it a worker was at work; the rest it waited for a processor."""
    cut: bool = False
    """Whether its time was up before planning came to its end."""


def load(planner: str | Planner) -> None:
    """Get ready to plan: in a process of its own that takes a second."""
    load_kernels()
    for situation in LOADING:
        plan_situation(situation, Unanchored(), planner, ("alternatives", "flown"), None)


def planner_of(planner: str | Planner) -> Planner:
    """A planner by its name; one that is given is taken."""
    return _named(planner) if isinstance(planner, str) else planner


def read_situation(body: bytes) -> tuple[Situation, Anchor]:
    """A situation from the body of a request.

    Raises:
        Refusal: naming each field that is wrong.
    """
    return _read(parse_json(body), SituationBody)


def plan_body(
    body: bytes,
    planner: str | Planner,
    include: tuple[Include, ...],
    end: float,
    most: Second,
    form: Form = "json",
) -> PlanReply:
    """Plan the situation in the body of a request.

    Args:
        body: the situation in JSON.
        planner: who plans.
        include: as in `answer`.
        end: when planning is to end, by `time.monotonic`, which is one for all processes [s].
        most: how long it may take from now on [s].
        form: as in `answer`.

    Raises:
        Refusal: if it is no situation, or cannot be written so.
    """
    began = thread_time()
    situation, anchor = read_situation(body)
    least = LEAST_WITH_MORE if include else LEAST
    if "flown" in include:
        least = LEAST_WITH_FLIGHT
    deadline = max(min(end - monotonic(), most), least)
    answered = plan_situation(situation, anchor, planner, include, deadline, form)
    cut = answered.reason == Reason.DEADLINE.value or answered.seconds > CUT * deadline
    # the soonest way out is left out where there is no time to look for it
    if answered.reason == Reason.SEPARATION_ALREADY_LOST.value:
        cut = cut or deadline <= TO_LOOK_ROUND
    return replace(answered, processor=thread_time() - began, cut=cut)


def plan_at_once(situation: Situation, anchor: Anchor) -> PlanReply | None:
    """The exact plan where the limit costs nothing; `None` where a search is needed.

    No clock is read: a busy machine changes nothing. Of 4,000 extreme situations none took 7 ms.
    """
    started = perf_counter()
    found = exact_plan_at_once(situation)
    return None if found is None else _answered(answer_plan(found, anchor), started)


def plan_situation(
    situation: Situation,
    anchor: Anchor,
    planner: str | Planner,
    include: tuple[Include, ...],
    deadline: Second | None,
    form: Form = "json",
) -> PlanReply:
    """Plan a situation.

    Raises:
        Refusal: if it cannot be written in this form.
    """
    started = perf_counter()
    make = planner_of(planner)
    try:
        given = answer(situation, anchor, make, include=include, deadline=deadline, form=form)
    except ContractError as error:
        raise refusal_of(error) from None
    return _answered(given, started)


def compare_planners(
    body: bytes, among: Sequence[ComparedPlanner], deadline: Second
) -> list[dict[str, Any]]:
    """What each planner would fly in the situation of a request, as JSON objects.

    Raises:
        Refusal: if it is no situation.
    """
    from relguide.learn.comparison import compare  # loads networks, which few ask for

    situation, anchor = read_situation(body)
    found = compare(situation, among=among, deadline=deadline)
    return [path_to_wire(verdict, anchor) for verdict in found]


def split_batch(body: bytes) -> list[bytes]:
    """The situations of a batch, each as JSON text.

    All are read before any is planned: it is refused as a whole or served as a whole.

    Raises:
        Refusal: for the first that is wrong.
    """
    bodies = parse_json(body)
    if not isinstance(bodies, list):
        raise Refusal(422, "The body must be a list of situations.")
    if len(bodies) > MAX_BATCH:
        raise Refusal(422, f"At most {MAX_BATCH} situations a request, not {len(bodies)}.")
    for index, content in enumerate(bodies):
        _read(content, NamedSituationBody, under=f"[{index}]")
    # not orjson: a heading may be a whole number of any size
    return [json.dumps(content).encode() for content in bodies]


def plan_lines(
    lines: Iterable[bytes],
    planner: str | Planner,
    include: tuple[Include, ...],
    deadline: Second,
    until: Second,
) -> list[PlanReply]:
    """Plan as many lines of a batch, in their order, as can be begun in some time.

    Args:
        lines: situations, each as JSON text; a wrong one gets an answer that says so.
        planner: who plans.
        include: as in `answer`.
        deadline: of each line [s].
        until: no line is begun later than this, but the first [s].
    """
    began = perf_counter()
    make = planner_of(planner)
    answers: list[PlanReply] = []
    for line in lines:
        started = perf_counter()
        if answers and started > began + until:
            break
        if len(line) > MAX_LINE:
            wrong = f"A situation may have at most {MAX_LINE:,} bytes."
            given: dict[str, Any] = {"status": "invalid", "message": wrong}
        else:
            given = answer_line(line, make, include=include, deadline=deadline)
        answers.append(_answered(given, started))
    return answers


def draw_area(
    situation: Situation,
    anchor: Anchor,
    grid: Grid,
    levels: Sequence[Second],
    planner: Literal["exact", "network"],
    exact: bool,
    times: bool,
) -> bytes:
    """A convergence area as JSON text."""
    words = area_words(_network(), situation, grid) if planner == "network" else None
    evaluate = times_around(situation, words=words)
    area = isochrones(situation, grid, levels, evaluate=evaluate, exact=exact)
    return orjson.dumps(area_to_wire(area, situation, anchor, exact=exact, times=times))


def simulate(request: str, planner: str | Planner) -> bytes:
    """Fly a request for a flight, JSON, to its end at once, and give its figures as JSON text."""
    started = perf_counter()
    wanted = _REQUEST.validate_json(request)
    name, flown, _ = scenario_of(wanted)
    ordered = ordered_in(wanted, flown)
    flight_of = partial(
        fly,
        flown,
        planner_of(planner),
        seed=wanted.seed,
        sample_period=1.0,
        engagement=ordered.engagement,
        planner_name=planner if isinstance(planner, str) else None,
    )
    documents = with_crew(ordered.script, flight_of, commands_of(ordered.orders))
    flight = summarize(documents)
    (ended,) = flight.ended
    about = {
        "scenario": name,
        "seed": wanted.seed,
        "version": version("relguide"),
        "reason": ended.reason,
        "message": ended.message,
    }
    return orjson.dumps(about | figures(flight) | {"wall_s": perf_counter() - started})


def record_flight(wanted: FlightRequest, planner: str | Planner) -> bytes:
    """Fly a flight to its end, as fast as it goes, and give its recording, gzipped."""
    _, flown, _ = scenario_of(wanted)
    documents = fly(
        flown,
        planner_of(planner),
        seed=wanted.seed,
        sample_period=1.0,
        planner_name=planner if isinstance(planner, str) else None,
        wants_fan=all_fans,
    )
    return gzip.compress(recording_of(documents), PACKING)


def _answered(given: dict[str, Any], started: float) -> PlanReply:
    text = orjson.dumps(given)
    status, seconds = given["status"], perf_counter() - started
    return PlanReply(text, status, given.get("reason", ""), seconds, _is_final(given))


def _is_final(given: dict[str, Any]) -> bool:
    match given["status"]:
        case "planned":
            proof: str = given["optimality"]["proof"]
            return proof == "relaxation" or bool(given["planner"] == "network")
        case "no_plan":
            return bool(given["reason"] != "deadline")
        case _:
            return False


def _read(
    content: object, shape: type[SituationBody], *, under: str = ""
) -> tuple[Situation, Anchor]:
    if not isinstance(content, dict):
        what = under or "The body"
        raise Refusal(422, f"{what} must be an object with fields: a situation.")
    try:
        return situation_from_body(parse(shape, content))
    except ContractError as error:
        raise refusal_of(error, under=under) from None


@cache
def _named(name: str) -> Planner:
    return make_planner(name)


@cache
def _network() -> BranchNetwork:
    """The network that comes with the program, read once."""
    return load_network()
