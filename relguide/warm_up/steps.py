"""What each step of a warm-up calls, so that its kernels are compiled: all branches, once."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import islice
from math import pi, radians

import numpy as np

from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.intent import FlyStraight, IntentPiece, TurnTo
from relguide.planning.situation import Situation
from relguide.planning.trajectory import LEFT, RIGHT
from relguide.planning.wind import Wind

SAMPLES = 400
"""Documents of a flight after which its every kernel has been called."""
SETS = {
    "plan": ("flying", "limited", "amid"),
    "serve": ("flying", "limited", "amid", "areas", "bulk"),
    "all": (
        "flying", "limited", "amid", "areas", "proofs", "bulk", "networks", "tree", "learning",
    ),
}  # fmt: skip
"""What `--for` may name, and its steps in the order they are begun."""


@dataclass(frozen=True, slots=True)
class Step:
    """Kernels that are compiled together."""

    title: str
    kernels: int
    """How many it compiles, about, after those it builds on: what its progress is told by."""
    run: Callable[[], None]
    """Calls the kernels."""
    after: tuple[str, ...] = ()
    """Steps whose kernels these are built on."""
    packages: tuple[str, ...] = ()
    """What it needs beside numpy and numba; without them it is left out."""


def _compile_flying() -> None:
    from relguide.flying.flight import IntentKnown, LeaderHeading, fly
    from relguide.flying.scenarios import scenario
    from relguide.planning.plan import plan

    flight = scenario("fig_6b")
    for _ in fly(flight, plan, sample_period=1.0):  # joins, and follows
        pass
    # a leader that turns unannounced is planned for anew, watched, and escaped from
    orders = {2.0: (IntentKnown(known=False), LeaderHeading(heading=0.5))}
    surprised = fly(flight, plan, commands=lambda t: orders.get(t, ()), sample_period=1.0)
    for _ in islice(surprised, SAMPLES):
        pass
    plan(_situation(-40e3, 40e3, 90.0))
    plan(_situation(-20e3, 5e3, 0.0, intent=TURNING))


def _compile_limited() -> None:
    from relguide.flying.flight import fly
    from relguide.flying.scenarios import scenario
    from relguide.planning.alternatives import alternatives
    from relguide.planning.deadline import load_kernels
    from relguide.planning.outcome import Plan
    from relguide.planning.plan import plan

    load_kernels()
    for situation in LIMITED:
        planned = plan(situation)
        if isinstance(planned, Plan):
            alternatives(planned)
    plan(_situation(10.0, 500.0, 0.0))
    plan(_situation(-9200.0, 16_300.0, 136.0, tas=205.0))
    lost = replace(scenario("fig_6b"), situation=_situation(10.0, 500.0, 0.0))
    for _ in islice(fly(lost, plan), SAMPLES):
        pass


def _compile_amid() -> None:
    from relguide.planning import amid
    from relguide.planning.plan import plan

    amid.load_kernels()
    plan(amid.LOADING)


def _compile_areas() -> None:
    from relguide.learn.words.area_words import area_words
    from relguide.learn.words.branch_network import load_network
    from relguide.maps.isochrones import Grid, isochrones

    grid = Grid(x=0.0, y=0.0, columns=9, rows=9)
    isochrones(LIMITED[1], grid)
    area_words(load_network(), LIMITED[1], grid)


def _compile_proofs() -> None:
    from relguide.planning.optimality import check
    from relguide.planning.outcome import Plan
    from relguide.planning.plan import plan
    from relguide.planning.prove import prove
    from relguide.planning.regular import regular_from_trajectory
    from relguide.planning.regular_evaluation import evaluate

    for situation in (_situation(-40e3, 40e3, 90.0), *LIMITED):
        planned = plan(situation)
        if isinstance(planned, Plan):
            check(planned, situation)
            prove(planned, seconds=0.1)
            if "B" not in planned.word and not situation.leader.intent:
                radius = situation.pursuer.turn_radius
                regular = regular_from_trajectory(planned.trajectory, turn_radius=radius)
                evaluate(regular, situation)


def _compile_bulk() -> None:
    from relguide.maps.isochrones import Grid, isochrones
    from relguide.planning.batch import Situations, plan_arrays
    from relguide.planning.turning_batch import Intents, turning_times

    one = Situations(
        pursuer_x=-20e3, pursuer_y=9e3, pursuer_heading=0.0, pursuer_tas=240.0,
        max_bank=radians(25), leader_tas=200.0, slot_distance=12e3, min_separation=9e3,
    )  # fmt: skip
    plan_arrays(one)
    turn = np.array([[1.0, 1.0, radians(20)]])
    turning_times(one, Intents(counts=np.array([1]), pieces=turn))
    isochrones(LIMITED[0], Grid(x=0.0, y=0.0, columns=3, rows=3), exact=True)


def _compile_networks() -> None:
    from relguide.learn.planners import make_planner

    planner = make_planner("network")
    for situation in (_situation(-40e3, 40e3, 90.0), *LIMITED):
        planner(situation)


def _compile_tree() -> None:
    from relguide.learn.tree.regular_planner import regular_planner
    from relguide.learn.tree.reverse_dp import reverse_tree
    from relguide.learn.tree.tree import TreeParameters
    from relguide.maps.area import Encounter

    encounter = Encounter(
        pursuer_tas=240.0,
        max_bank=radians(25),
        leader_tas=200.0,
        slot_distance=12e3,
        min_separation=9e3,
    )
    reverse_tree(
        TreeParameters(encounter=encounter, order=2, delta_theta=0.5 * pi, delta_l=12e3, cell=12e3)
    )
    regular_planner(_situation(-40e3, 40e3, 90.0))
    regular_planner(_situation(0.0, 30e3, 180.0))


def _compile_learning() -> None:
    from numpy.random import default_rng

    from relguide.learn.audits.branch_judging import branch_audit_request, judge_chunk, latencies
    from relguide.learn.audits.constrained_judging import template_latencies
    from relguide.learn.audits.template_judging import judge_template_chunk, template_audit_request
    from relguide.learn.boundary.template_labels import (
        TemplateLabelRequest,
        advance_paths,
        template_label_chunk,
    )
    from relguide.learn.boundary.template_network import load_template_network, template_features_of
    from relguide.learn.boundary.train_templates import targets_of
    from relguide.learn.words.branch_labels import LabelRequest, label_chunk
    from relguide.learn.words.branch_network import features_of, load_network

    network = load_network()
    limited = template_label_chunk(TemplateLabelRequest(count=10), 0)
    template_features_of(limited.situations)
    targets_of(advance_paths(limited.paths, default_rng(0)))
    features_of(label_chunk(LabelRequest(count=10), 0).situations)
    judge_chunk(network, branch_audit_request(network, 10, 1), 0)
    latencies(network, branch_audit_request(network, 10, 1))
    ways = load_template_network()
    judge_template_chunk(ways, network, template_audit_request(ways, 10, 1), 0)
    template_latencies(ways, limited.situations)


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
        pursuer=Pursuer(
            x=x, y=y, heading=radians(heading_deg), tas=tas, max_bank=radians(bank_deg)
        ),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=200.0, intent=intent),
        slot_distance=12e3,
        min_separation=9260.0,
    )


TURNING: tuple[IntentPiece, ...] = (
    FlyStraight(duration=60.0),
    TurnTo(heading=0.5 * pi, turn=RIGHT, bank=radians(20)),
    TurnTo(heading=0.25 * pi, turn=LEFT, bank=radians(20)),
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
STEPS = {
    "flying": Step("flights and plans without the limit", 112, _compile_flying),
    "limited": Step("the limited search", 227, _compile_limited, after=("flying",)),
    "amid": Step("plans amid others", 47, _compile_amid, after=("limited",)),
    "areas": Step("areas", 19, _compile_areas, after=("flying",), packages=("contourpy",)),
    "proofs": Step("proofs of optimality", 222, _compile_proofs, after=("limited",)),
    "bulk": Step("plans in bulk", 5, _compile_bulk, after=("limited",), packages=("contourpy",)),
    "networks": Step("networks", 64, _compile_networks, after=("limited",)),
    "tree": Step("the tree", 9, _compile_tree, after=("flying",)),
    "learning": Step("learning", 25, _compile_learning, after=("networks",), packages=("torch",)),
}
"""All of them, by name."""
