"""What the commands do: files and streams around planning, flying, replaying and serving."""

import os
import socket
import sys
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from dataclasses import replace
from importlib import import_module
from itertools import islice
from pathlib import Path
from time import perf_counter
from typing import IO, TYPE_CHECKING

import orjson

from relguide.cli.output import say, write, write_json
from relguide.contract.answers import Include, answer, answer_line, checked
from relguide.contract.bodies import NamedSituationBody, situation_from_body
from relguide.contract.recorder import record, replay
from relguide.contract.refusal import parse
from relguide.contract.story import failures, figures, told
from relguide.contract.wire import to_wire
from relguide.flying.cards import no_plan_card, plan_card
from relguide.planning.plan import NoPlan, Plan, Planner, plan
from relguide.planning.progress import watched
from relguide.planning.situation import Situation
from relguide.units import NM

if TYPE_CHECKING:
    from relguide.flying.flight import Scenario

_WARM_UP = 40
"""Documents of a flight made for nothing, or a plan: it loads the compiled kernels, which takes
seconds where planning takes a tenth of a millisecond, and is no part of what is measured."""


def plan_one(
    file: str,
    *,
    planner_name: str,
    table: bool,
    include: Collection[Include] = (),
    prove_for: float = 0.0,
) -> bool:
    """Print the answer to a situation.

    Args:
        file: its path; - for standard input.
        planner_name: exact, network or regular_dp.
        table: for people; JSON otherwise.
        include: what to say beside the plan.
        prove_for: how long to look for a better lower bound of its time [s].

    Returns:
        whether there is a plan.
    """
    with _opened(file) as stream:
        body = parse(NamedSituationBody, stream.read())
    situation, anchor = situation_from_body(body)
    asked = _planner(planner_name)
    planner = _proving(asked, prove_for)
    asked(situation)  # see `_WARM_UP`
    if table:
        from relguide.cli.tables import print_no_plan, print_optimality, print_plan
        from relguide.planning.alternatives import alternatives

        match planned := planner(situation):
            case NoPlan():
                print_no_plan(no_plan_card(planned))
            case Plan():
                others = alternatives(planned) if "alternatives" in include else ()
                print_plan(plan_card(planned, others), min_separation=situation.min_separation)
                if "optimality" in include:
                    print_optimality(checked(planned))
        return isinstance(planned, Plan)
    reply = answer(situation, anchor, planner, include=include)
    name = {"id": body.id} if "id" in body.model_fields_set else {}
    write_json(name | reply)
    return bool(reply["status"] == "planned")


def plan_batch(
    file: str, *, planner_name: str, include: Collection[Include] = (), prove_for: float = 0.0
) -> int:
    """Print the answers to a file of situations, one a line.

    Args:
        file: its path; - for standard input.
        planner_name: exact, network or regular_dp.
        include: what to say beside each plan.
        prove_for: how long to look for a better lower bound of the time of each [s].

    Returns:
        how many lines are no situations.
    """
    invalid: list[int] = []
    read = 0
    # no bar of its own: that of the batch goes on
    planner = _proving(_planner(planner_name), prove_for, shown=False)
    with _opened(file) as stream:
        size = os.fstat(stream.fileno()).st_size if file != "-" else 0
        lines = watched(
            enumerate(stream, start=1), title="planning", total=size, done=lambda _: read
        )
        for number, line in lines:
            read += len(line)
            if not line.strip():
                continue
            reply = answer_line(line, planner, include=include)
            if reply["status"] == "invalid":
                invalid.append(number)
            sys.stdout.write(orjson.dumps(reply).decode() + "\n")
    if invalid:
        noun = "line is" if len(invalid) == 1 else "lines are"
        say(f"{len(invalid)} {noun} no valid situation, the first is line {invalid[0]}.")
    return len(invalid)


def check_one(file: str, triplets: str, *, table: bool, figure: str) -> bool:
    """Judge a regular trajectory, given as the paper's triplets, and print what is found.

    Args:
        file: path of the situation; - for standard input.
        triplets: path of the triplets; if empty, those of the fastest plan.
        table: for people; JSON otherwise.
        figure: path of a picture to draw; none if empty.

    Returns:
        whether it reaches the slot, keeps d_min and is stationary.
    """
    from relguide.contract.triplets import regular_from_json
    from relguide.flying.regular_card import regular_check
    from relguide.planning.regular import regular_from_trajectory, trajectory_from_regular

    with _opened(file) as stream:
        situation, _ = situation_from_body(parse(NamedSituationBody, stream.read()))
    if triplets:
        with _opened(triplets) as stream:
            regular = regular_from_json(stream.read())
    else:
        match planned := plan(situation):
            case NoPlan():
                say(planned.message)
                return False
            case Plan():
                radius = situation.pursuer.turn_radius
                regular = regular_from_trajectory(planned.trajectory, turn_radius=radius)
    found = regular_check(regular, situation)
    if figure:
        from relguide.figures.tracks_figure import draw

        picture = draw(
            trajectory_from_regular(regular, situation),
            situation,
            nodes=found.nodes,
            closest_at=found.separation.at,
            title=f"Regular trajectory of order {found.order}: {found.duration:,.0f} s, "
            f"least separation {found.separation.least / NM:.2f} NM",
        )
        Path(figure).write_text(picture, "utf-8")
    if table:
        from relguide.cli.tables import print_regular

        print_regular(found, min_separation=situation.min_separation)
    else:
        write_json(to_wire(found))
    return found.passed


def fly_one(
    name: str, *, planner_name: str, record_to: str | None, seed: int, as_json: bool
) -> bool:
    """Fly a scenario, or a file, and print how it went.

    Args:
        name: of a scenario, or the path of a situation (.json) or a recorded track (.csv).
        planner_name: exact, network or regular_dp.
        record_to: where to write the recording, if anywhere.
        seed: of the flight's random numbers.
        as_json: one JSON object; a table otherwise.

    Returns:
        whether it joined and kept d_min.
    """
    from relguide.flying.flight import fly

    scenario = _scenario(name)
    planner = _planner(planner_name)
    for _ in islice(fly(scenario, planner, sample_period=1.0), _WARM_UP):
        pass
    started = perf_counter()
    if record_to is None:
        # nobody looks at the samples: one a second is enough for the progress bar
        documents = fly(scenario, planner, seed=seed, sample_period=1.0)
    else:
        documents = record(fly(scenario, planner, seed=seed), record_to)
    flight = told(
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
    if as_json:
        write_json(result)
    else:
        from relguide.cli.tables import print_flight

        print_flight(flight, result)
    failed = failures(flight)
    for sentence in failed:
        say(sentence)
    return not failed


def replay_one(file: str, *, as_json: bool) -> bool:
    """Print what a recording holds; of a damaged one, what is good.

    Returns:
        whether it is whole.
    """
    flight = told(watched(replay(file), title="reading", total=0.0, done=lambda _: 0.0))
    whole = bool(flight.ended) and not flight.broken
    result = figures(flight.ended[0]) if flight.ended else {"simulated_s": flight.last_time}
    if as_json:
        about = {
            "scenario": "".join(started.scenario for started in flight.started),
            "title": "".join(started.title for started in flight.started),
            "documents": flight.documents,
            "complete": whole,
        }
        write_json(about | result)
    else:
        from relguide.cli.tables import print_flight

        print_flight(flight, result)
    if not whole:
        say(flight.broken or f"{file} ends before its flight does; it may still be written.")
    return whole


def serve(*, host: str, port: int) -> None:
    """Run the service until it is stopped.

    Raises:
        OSError: if the address cannot be used.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    with socket.socket(family) as probe:  # uvicorn would say it in a log line, and exit
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((host, port))
        except OSError as error:
            raise OSError(error.errno, error.strerror, f"{host}, port {port}") from None
    # By name: the library knows nothing of the service that stands on it; its command starts it.
    uvicorn, settings = import_module("uvicorn"), import_module("relguide_server.settings")
    app = import_module("relguide_server.app").app
    shown = f"[{host}]" if ":" in host else host
    write(f"relguide is on http://{shown}:{port} (Ctrl-C stops it)\n")
    uvicorn.run(app, **settings.uvicorn_options(host=host, port=port))


def _planner(name: str) -> Planner:
    """A planner by its name on the command line."""
    if name == "exact":
        return plan
    if name == "regular_dp":
        from relguide.learn.tree.regular_planner import regular_planner

        return regular_planner
    from relguide.learn.network_planner import network_planner
    from relguide.learn.words.branch_network import load_network

    return network_planner(load_network())


def _proving(asked: Planner, seconds: float, *, shown: bool = True) -> Planner:
    """A planner which then looks for a better lower bound for so long."""
    if seconds == 0.0:
        return asked
    from relguide.planning.prove import Bound, prove

    def progress(bounds: Iterator[Bound]) -> Iterator[Bound]:
        return watched(
            bounds,
            title="proving",
            total=seconds,
            done=lambda bound: bound.elapsed,
            state=lambda bound: f"gap {bound.gap:.3f} s",
        )

    def planner(situation: Situation) -> Plan | NoPlan:
        planned = asked(situation)
        if isinstance(planned, NoPlan):
            return planned
        return prove(planned, seconds=seconds, progress=progress if shown else iter)

    return planner


def _scenario(name: str) -> "Scenario":
    from relguide.flying.scenarios import own_scenario, recorded, scenario

    path = Path(name)
    if path.suffix == ".csv":
        from relguide.flying.tracks import load_csv

        return recorded(load_csv(path))
    if path.suffix == ".json" or name == "-" or path.is_file():
        with _opened(name) as stream:
            situation, _ = situation_from_body(parse(NamedSituationBody, stream.read()))
        title = (
            "The situation of standard input" if name == "-" else f"The situation of {path.name}"
        )
        return replace(own_scenario(situation), title=title)
    return scenario(name)


@contextmanager
def _opened(file: str) -> Iterator[IO[bytes]]:
    if file == "-":
        yield sys.stdin.buffer
    else:
        with Path(file).open("rb") as stream:
            yield stream
