"""`python -m relguide.warm_up`: compile every kernel once, at installation, and keep the result.

Numba compiles a kernel when it is first called, which takes a minute for all of them, and reads it
from disk ever after (`kernels/cache.py`). So here everything that calls a kernel is done once, on
situations that lead through all branches. `tests/relguide/test_warm_up.py` sees that none is
missing.
"""

import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import islice
from math import pi

from relguide.kernels import cache
from relguide.planning.progress import watched
from relguide.planning.situation import (
    FlyStraight,
    IntentPiece,
    Leader,
    Pursuer,
    Situation,
    TurnTo,
    Wind,
)
from relguide.planning.trajectory import LEFT, RIGHT
from relguide.units import DEG

Step = tuple[str, float, Callable[[], object]]
"""What is compiled, how long that takes [s], and what does it."""
SAMPLES = 100
"""Documents of a flight after which its every kernel has been called."""


def main() -> None:
    """Compile what is not compiled yet, and say where it is kept."""
    if cache.filled(cache.folder()):
        sys.stdout.write("The kernels are compiled.\n")
        return
    warm_up()
    sys.stdout.write(f"The kernels are compiled and kept in {cache.folder()}.\n")


def warm_up() -> None:
    """Call every kernel, with a progress bar if that takes long; at once if all are on disk."""
    if cache.filled(cache.folder()):
        return
    steps = _steps()
    total = sum(seconds for _, seconds, _ in steps)
    for _ in watched(_done(steps), title="compiling the kernels", total=total, done=float):
        pass
    cache.record(cache.folder())


def _done(steps: tuple[Step, ...]) -> Iterator[float]:
    """Take the steps; yields how far each has brought us [s]."""
    reached = 0.0
    yield reached
    for name, seconds, step in steps:
        if not sys.stderr.isatty():
            sys.stderr.write(f"compiling {name} …\n")
        step()
        reached += seconds
        yield reached


def _steps() -> tuple[Step, ...]:
    return (
        ("the extremals and the certificate", 11.0, _plan_free),
        ("the ways round the limit", 30.0, _plan_limited),
        ("what to do where there is none", 4.0, _plan_none),
        ("the proofs of optimality", 15.0, _conditions),
        ("plans in bulk", 30.0, _bulk),
        ("the convergence area", 6.0, _area),
        ("reverse dynamic programming", 4.0, _tree),
        ("the networks", 40.0, _network),
        ("the closed loop", 3.0, _flight),
    )


def _plan_free() -> None:
    from relguide.planning.plan import plan

    plan(_situation(-40e3, 40e3, 90.0))
    plan(_situation(-20e3, 5e3, 0.0, intent=TURNING))


def _plan_limited() -> None:
    from relguide.planning.plan import plan

    for situation in LIMITED:
        plan(situation)


def _plan_none() -> None:
    from relguide.planning.plan import plan

    plan(_situation(10.0, 500.0, 0.0))
    plan(_situation(-9200.0, 16_300.0, 136.0, tas=205.0))


def _conditions() -> None:
    from relguide.planning.alternatives import alternatives
    from relguide.planning.optimality import check
    from relguide.planning.plan import Plan, plan
    from relguide.planning.prove import prove
    from relguide.planning.regular import regular_from_trajectory
    from relguide.planning.regular_evaluation import evaluate

    for situation in (_situation(-40e3, 40e3, 90.0), *LIMITED):
        planned = plan(situation)
        if isinstance(planned, Plan):
            alternatives(planned)
            check(planned, situation)
            prove(planned, seconds=0.1)
            if "B" not in planned.word and not situation.leader.intent:
                radius = situation.pursuer.turn_radius
                regular = regular_from_trajectory(planned.trajectory, turn_radius=radius)
                evaluate(regular, situation)


def _bulk() -> None:
    from relguide.planning.batch import Situations, plan_arrays

    plan_arrays(
        Situations(
            pursuer_x=-20e3, pursuer_y=9e3, pursuer_heading=0.0, pursuer_tas=240.0,
            max_bank=25 * DEG, leader_tas=200.0, slot_distance=12e3, min_separation=9e3,
        )
    )  # fmt: skip


def _area() -> None:
    from relguide.learn.words.area_words import area_words
    from relguide.learn.words.branch_network import load_network
    from relguide.maps.isochrones import Grid, isochrones

    grid = Grid(x=0.0, y=0.0, columns=9, rows=9)
    isochrones(LIMITED[1], grid)
    area_words(load_network(), LIMITED[1], grid)


def _tree() -> None:
    from relguide.learn.tree.regular_planner import regular_planner
    from relguide.learn.tree.reverse_dp import reverse_tree
    from relguide.learn.tree.tree import TreeParameters
    from relguide.maps.area import Encounter

    encounter = Encounter(
        pursuer_tas=240.0,
        max_bank=25 * DEG,
        leader_tas=200.0,
        slot_distance=12e3,
        min_separation=9e3,
    )
    reverse_tree(
        TreeParameters(encounter=encounter, order=2, delta_theta=0.5 * pi, delta_l=12e3, cell=12e3)
    )
    regular_planner(_situation(-40e3, 40e3, 90.0))
    regular_planner(_situation(0.0, 30e3, 180.0))


def _network() -> None:
    from numpy.random import default_rng

    from relguide.learn.audits.branch_judging import audit_request, judge_chunk, latencies
    from relguide.learn.audits.template_bound import template_latencies
    from relguide.learn.audits.template_judging import judge_template_chunk, template_request
    from relguide.learn.boundary.template_labels import LimitRequest, later, limit_chunk
    from relguide.learn.boundary.template_network import load_template_network, template_features_of
    from relguide.learn.boundary.train_templates import taught
    from relguide.learn.network_planner import network_planner
    from relguide.learn.words.branch_labels import LabelRequest, label_chunk
    from relguide.learn.words.branch_network import features_of, load_network

    network = load_network()
    planner = network_planner(network)
    for situation in (_situation(-40e3, 40e3, 90.0), *LIMITED):
        planner(situation)
    limited = limit_chunk(LimitRequest(count=10), 0)
    template_features_of(limited.situations)
    taught(later(limited.ways, default_rng(0)))
    features_of(label_chunk(LabelRequest(count=10), 0).situations)
    judge_chunk(network, audit_request(network, 10, 1), 0)
    latencies(network, audit_request(network, 10, 1))
    ways = load_template_network()
    judge_template_chunk(ways, network, template_request(ways, 10, 1), 0)
    template_latencies(ways, limited.situations)


def _flight() -> None:
    from relguide.flying.flight import fly
    from relguide.flying.scenarios import scenario
    from relguide.planning.plan import plan

    flown = scenario("fig_6b")
    lost = replace(flown, situation=_situation(10.0, 500.0, 0.0))
    for flight in (flown, lost):
        for _ in islice(fly(flight, plan), SAMPLES):
            pass


def _situation(
    x: float,
    y: float,
    heading_deg: float,
    *,
    tas: float = 240.0,
    bank_deg: float = 25.0,
    intent: tuple[IntentPiece, ...] = (),
) -> Situation:
    return Situation(
        pursuer=Pursuer(x=x, y=y, heading=heading_deg * DEG, tas=tas, max_bank=bank_deg * DEG),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=200.0, intent=intent),
        slot_distance=12e3,
        min_separation=9260.0,
    )


TURNING: tuple[IntentPiece, ...] = (
    FlyStraight(duration=60.0),
    TurnTo(heading=0.5 * pi, turn=RIGHT, bank=20 * DEG),
    TurnTo(heading=0.25 * pi, turn=LEFT, bank=20 * DEG),
)
"""An intent with all there is in one."""
LIMITED = (
    _situation(0.0, 30e3, 180.0),
    _situation(-300.0, 11e3, 3.0, tas=205.0, intent=TURNING),
    _situation(-2800.0, 24.7e3, 310.0, tas=205.0, bank_deg=60.0),
    Situation(
        pursuer=Pursuer(x=0.0, y=0.0, heading=1.438, tas=189.58, max_bank=0.3291),
        leader=Leader(
            x=3_975.0,
            y=-63_096.0,
            heading=4.5376,
            tas=122.58,
            intent=(
                FlyStraight(duration=104.67),
                TurnTo(heading=0.0231, turn=LEFT, bank=0.3117),
            ),
        ),
        slot_distance=68_297.0,
        min_separation=42_018.0,
        wind=Wind(east=2.52, north=3.99),
    ),
)
"""Where d_min is touched: once, while the leader turns, along a boundary arc, before the slot
opens.
"""

if __name__ == "__main__":
    main()
