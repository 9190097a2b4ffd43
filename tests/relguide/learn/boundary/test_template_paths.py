"""The network where the limit binds: certified, fast to agree with the search, silent elsewhere."""

from dataclasses import replace
from functools import cache
from math import pi

import numpy as np
import pytest

from relguide import (
    LEFT,
    FlyStraight,
    NoPlan,
    Plan,
    Situation,
    TurnTo,
    certify,
    plan,
    wind_from,
)
from relguide.learn.boundary.template_labels import TemplateLabelRequest, template_label_chunk
from relguide.learn.boundary.template_network import TemplateNetwork, load_template_network
from relguide.learn.boundary.template_paths import solve_constrained, view
from relguide.learn.network_planner import network_planner
from relguide.learn.words.branch_network import load_network
from relguide.planning.candidate import Candidate
from relguide.units import DEG
from tests.relguide.learn.boundary.template_networks import ways
from tests.relguide.learn.boundary.test_template_labels import situation_of

SHIPPED = load_template_network()
UNSEEN = [
    situation_of(row)
    for row in template_label_chunk(TemplateLabelRequest(count=240, seed=999), 0).situations
]


def constrained_path(network: TemplateNetwork, situation: Situation) -> Candidate | None:
    """What the network leads to where the limit is seen to bind."""
    radius = situation.pursuer.turn_radius
    binds, where, free = view(situation, radius)
    return solve_constrained(network, situation, radius, where, free) if binds else None


def ask(situation: Situation, network: TemplateNetwork = SHIPPED) -> Plan | NoPlan:
    return network_planner(load_network(), network)(situation)


@cache
def answers() -> list[tuple[Situation, Plan]]:
    """Those that the network that comes along answers, with its plans."""
    plans = [(situation, ask(situation)) for situation in UNSEEN]
    return [
        (situation, planned)
        for situation, planned in plans
        if isinstance(planned, Plan) and planned.planner == "network"
    ]


def test_it_answers_nearly_all_and_hardly_ever_loses_time() -> None:
    exact = {id(situation): plan(situation) for situation in UNSEEN}
    there = sum(isinstance(answer, Plan) for answer in exact.values())
    assert len(answers()) > 0.9 * there
    late = []
    for situation, planned in answers():
        best = exact[id(situation)]
        assert isinstance(best, Plan)  # where nobody finds a way, the network does not either
        late.append(planned.time_to_converge - best.time_to_converge)
    assert np.mean(np.array(late) < 0.1) > 0.98
    assert min(late) > -0.5  # the search is hardly ever beaten


def test_every_answer_is_certified_and_none_beats_the_bound() -> None:
    for situation, planned in answers():
        assert certify(planned.trajectory, situation).holds
        assert planned.certificate.holds
        assert not planned.fell_back
        assert planned.optimality.lower_bound <= planned.time_to_converge


def test_a_tiny_network_flies_too() -> None:
    # which least share covers what is right is chance where so few labels say so
    tiny = replace(ways(), least_share=1e-3)
    flown = [ask(situation, tiny) for situation in UNSEEN[:100]]
    plans = [planned for planned in flown if isinstance(planned, Plan)]
    assert all(planned.certificate.holds for planned in plans)
    assert sum(planned.planner == "network" for planned in plans) > 0.2 * len(plans)


def test_mirror_images_get_mirrored_answers() -> None:
    for situation, planned in answers()[:60]:
        pursuer = replace(
            situation.pursuer, x=-situation.pursuer.x, heading=-situation.pursuer.heading
        )
        mirrored = ask(replace(situation, pursuer=pursuer))
        assert isinstance(mirrored, Plan)
        assert mirrored.planner == "network"
        assert mirrored.time_to_converge == pytest.approx(planned.time_to_converge, abs=1e-6)
        other = str.maketrans("LR", "RL")
        assert mirrored.word == planned.word.translate(other)


def fell_back(situation: Situation) -> bool:
    """Whether the exact planner answered, with what it says itself."""
    planned, exact = ask(situation), plan(situation)
    if isinstance(exact, NoPlan):
        return planned == exact
    assert isinstance(planned, Plan)
    return planned.fell_back and planned.trajectory == exact.trajectory


def test_out_of_the_box_the_exact_planner_answers() -> None:
    situation, _ = answers()[0]
    assert constrained_path(SHIPPED, situation) is not None
    box = SHIPPED.box
    for outside in (
        replace(box, max_ratio=box.min_ratio + 1e-3),
        replace(box, min_limit=0.999, max_limit=1.001),
        replace(box, max_slot=1.0001),
        replace(box, max_range=1.0001),
    ):
        found = [
            situation
            for situation in UNSEEN
            if constrained_path(replace(SHIPPED, box=outside), situation) is None
        ]
        assert len(found) > 100
    unsure = replace(SHIPPED, most=0)
    assert constrained_path(unsure, situation) is None
    doubtful = replace(SHIPPED, doubt=-1.0)
    assert constrained_path(doubtful, situation) is None


def test_in_a_cross_wind_the_exact_planner_answers() -> None:
    situation, _ = answers()[0]
    assert fell_back(replace(situation, wind=wind_from(90 * DEG, 20.0)))
    for other in UNSEEN[:60]:
        across = replace(other, wind=wind_from(90 * DEG, 20.0))
        assert constrained_path(SHIPPED, across) is None
    along = replace(situation, wind=wind_from(180 * DEG, 20.0))
    planned = ask(along)
    assert isinstance(planned, Plan)
    assert planned.planner == "network"


def test_inside_the_limit_and_without_a_way_it_says_what_the_exact_planner_says() -> None:
    situation, _ = answers()[0]
    inside = replace(
        situation,
        pursuer=replace(situation.pursuer, x=0.5 * situation.min_separation, y=0.0),
    )
    assert fell_back(inside)
    none = [situation for situation in UNSEEN if isinstance(plan(situation), NoPlan)]
    assert none
    assert all(fell_back(situation) for situation in none[:10])


def test_round_a_leader_who_turns_the_exact_planner_leads() -> None:
    rng = np.random.default_rng(4)
    seen = 0
    for situation in UNSEEN[:60]:
        intent = (
            FlyStraight(duration=float(rng.uniform(0.0, 60.0))),
            TurnTo(heading=float(rng.uniform(0.0, 2.0 * pi)), turn=LEFT, bank=20 * DEG),
        )
        turning = replace(situation, leader=replace(situation.leader, intent=intent))
        answer = network_planner(load_network(), SHIPPED)(turning)
        if isinstance(answer, Plan) and answer.fell_back:
            exact = plan(turning)
            assert isinstance(exact, Plan)
            assert answer.trajectory == exact.trajectory
            seen += 1
    assert seen > 10
