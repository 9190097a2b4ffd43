"""The planner by network: certified whatever it says, exact where it cannot say."""

import subprocess
import sys
from dataclasses import replace
from math import pi

import numpy as np
import pytest
from hypothesis import assume, given

from relguide import (
    LEFT,
    Leader,
    NoPlan,
    Plan,
    Situation,
    TurnTo,
    candidates,
    certify,
    plan,
)
from relguide.flying.documents import FlightEnded, FlightStarted
from relguide.flying.flight import fly
from relguide.flying.scenarios import scenario
from relguide.kernels.networks.branch_scores import Layers
from relguide.learn.boundary.template_network import load_template_network
from relguide.learn.network_planner import network_planner, propose
from relguide.learn.words.branch_network import BranchNetwork, load_network
from relguide.units import DEG
from tests.relguide.learn.words.networks import network
from tests.situations import golden, situations


def asked(situation: Situation) -> Plan | NoPlan:
    return network_planner(network())(situation)


FREE, _ = next(
    (situation, answer)
    for situation, answer in golden("reference")
    if propose(network(), situation) is not None
    and isinstance(plan(situation), Plan)
    and plan(situation).optimality.proof == "relaxation"  # type: ignore[union-attr]
    and not situation.leader.intent
)
"""Where the limit does not bind, in the box, behind a leader that keeps straight."""


@given(situations(with_intent=False))
def test_every_answer_is_certified_and_none_beats_the_bound(situation: Situation) -> None:
    proposal = propose(network(), situation)
    assume(proposal is not None and proposal.certificate.holds)
    planned = asked(situation)
    assert isinstance(planned, Plan)
    assert (planned.planner, planned.fell_back) == ("network", False)
    assert certify(planned.trajectory, situation).holds
    fastest = candidates(situation).bound
    assert planned.time_to_converge >= fastest - 1e-6
    assert planned.optimality.lower_bound <= fastest + 1e-6
    # it is one of the exact extremals, whole
    times = [candidate.time_to_converge for candidate in candidates(situation).later]
    assert min(abs(time - planned.time_to_converge) for time in times) < 1e-6


def test_it_mostly_finds_the_fastest() -> None:
    rng = np.random.default_rng(3)
    right = 0
    for _ in range(300):
        x, y = rng.uniform(-200e3, 200e3, 2)
        pursuer = replace(FREE.pursuer, x=x, y=y, heading=rng.uniform(0.0, 2.0 * pi))
        situation = replace(FREE, pursuer=pursuer, min_separation=0.0)
        planned = asked(situation)
        assert isinstance(planned, Plan)
        right += planned.time_to_converge <= candidates(situation).bound + 1e-6
    assert right >= 297


def test_out_of_the_box_the_exact_planner_answers() -> None:
    assert asked(FREE).planner == "network"  # type: ignore[union-attr]
    far = replace(FREE, pursuer=replace(FREE.pursuer, x=-990e3))
    slow = replace(FREE, leader=replace(FREE.leader, tas=0.2 * FREE.pursuer.tas))
    fast = replace(FREE, leader=replace(FREE.leader, tas=1.5 * FREE.pursuer.tas))
    for situation in (far, slow, fast):
        assert propose(network(), situation) is None
        planned, exact = asked(situation), plan(situation)
        if isinstance(exact, Plan):
            assert isinstance(planned, Plan)
            assert (planned.planner, planned.fell_back) == ("exact", True)
            assert planned.trajectory == exact.trajectory
        else:
            assert planned == exact


def test_where_the_limit_binds_and_no_way_is_known_the_exact_planner_answers() -> None:
    unsure = network_planner(network(), replace(load_template_network(), most=0))
    seen = 0
    for situation, _ in golden("reference"):
        exact = plan(situation)
        if isinstance(exact, Plan) and exact.optimality.proof == "bound":
            planned = unsure(situation)
            assert isinstance(planned, Plan)
            assert (planned.planner, planned.fell_back) == ("exact", True)
            assert planned.trajectory == exact.trajectory
            seen += 1
        if seen == 3:
            return
    pytest.fail("no golden situation touches the limit")


def test_lost_separation_is_said_as_the_exact_planner_says_it() -> None:
    inside = replace(FREE, pursuer=replace(FREE.pursuer, x=FREE.leader.x + 100.0, y=FREE.leader.y))
    assert isinstance(asked(inside), NoPlan)
    assert asked(inside) == plan(inside)


def with_score(found: BranchNetwork, *, bias: float, share: float, most: int) -> BranchNetwork:
    """A network that says the same of everything: its first branch, by so much."""
    scores = np.zeros_like(found.layers.last_bias)
    scores[0] = bias
    last = np.zeros_like(found.layers.last)
    layers = Layers(*found.layers)._replace(last=last, last_bias=scores)
    return replace(found, layers=layers, least_share=share, most=most)


def test_an_unsure_network_passes_on() -> None:
    unsure = with_score(network(), bias=0.0, share=0.1, most=4)  # all eight have 1/8
    assert propose(unsure, FREE) is None
    assert network_planner(unsure)(FREE).fell_back  # type: ignore[union-attr]


def test_a_wrong_network_is_slow_but_certified() -> None:
    wrong = network_planner(with_score(network(), bias=50.0, share=0.1, most=4))
    slower = 0
    for situation, _ in golden("reference")[:60]:
        planned = wrong(situation)
        if isinstance(planned, Plan):
            assert certify(planned.trajectory, situation).holds
            exact = plan(situation)
            assert isinstance(exact, Plan)
            slower += planned.time_to_converge > exact.time_to_converge + 1.0
    assert slower > 0


def test_a_turning_leader_is_met_on_the_final_leg() -> None:
    turning = (TurnTo(heading=45 * DEG, turn=LEFT, bank=20 * DEG),)
    leader = Leader(x=0.0, y=0.0, heading=90 * DEG, tas=200.0, intent=turning)
    far = replace(FREE, pursuer=replace(FREE.pursuer, x=-150e3, y=30e3, tas=240.0), leader=leader)
    planned, exact = asked(far), plan(far)
    assert isinstance(planned, Plan)
    assert isinstance(exact, Plan)
    assert (planned.planner, planned.fell_back) == ("network", False)
    assert certify(planned.trajectory, far).holds
    assert planned.time_to_converge == pytest.approx(exact.time_to_converge, rel=1e-9)
    # it would be there before the slot opens, and how to wait is the exact planner's to say
    pursuer = replace(far.pursuer, x=-7600.0, y=-12_200.0, heading=45 * DEG)
    near = replace(far, pursuer=pursuer, min_separation=0.0)
    assert candidates(near).reachable_at_release
    assert propose(load_network(), near) is None
    unannounced = replace(near.leader, x=7900.0, y=3300.0, heading=45 * DEG, intent=())
    assert propose(load_network(), replace(near, leader=unannounced)) is not None


@pytest.mark.slow
def test_it_flies_and_counts_where_it_fell_back() -> None:
    documents = list(fly(scenario("fig_6a"), network_planner(load_network()), sample_period=1.0))
    started, ended = documents[0], documents[-1]
    assert isinstance(started, FlightStarted)
    assert isinstance(ended, FlightEnded)
    (kept,) = ended.results
    assert kept.joined
    assert kept.least_separation >= scenario("fig_6a").situation.min_separation
    outside = replace(network().box, max_range=1e-3)
    lost = list(
        fly(scenario("fig_6a"), network_planner(replace(network(), box=outside)), sample_period=1.0)
    )[-1]
    assert isinstance(lost, FlightEnded)
    (result,) = lost.results
    assert result.fallbacks > kept.fallbacks
    assert result.joined


IMPORTS = """
import sys
import relguide
from relguide.learn.words.branch_network import load_network
from relguide.learn.network_planner import network_planner
from tests.situations import golden
network_planner(load_network())(golden("reference")[0][0])
sys.exit("torch" in sys.modules)
"""


@pytest.mark.slow
def test_asking_it_takes_no_torch() -> None:
    assert subprocess.run([sys.executable, "-c", IMPORTS], check=False).returncode == 0


def test_what_is_no_network_is_refused() -> None:
    with pytest.raises(ValueError, match="network must be a BranchNetwork"):
        network_planner(None)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="situation must be a Situation"):
        asked(None)  # type: ignore[arg-type]
