"""The network of turning leaders: certified answers, mirrored alike, and what it passes on."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from relguide import FlyStraight, Plan, Situation, plan
from relguide.learn.boundary.turn_labels import TurnBox, draw_turning
from relguide.learn.boundary.turn_paths import numbers_of, solve_behind_turn
from relguide.learn.network_planner import network_planner
from relguide.learn.words.branch_network import load_network
from relguide.planning.slot import slot_frame
from tests.relguide.learn.boundary.turn_networks import labels, turns
from tests.relguide.learn.boundary.turning_situations import situation_of

PLANNER = network_planner(load_network())


def answers(mirrored: bool) -> list[tuple[Situation, Plan]]:
    found = []
    for n in range(0, len(labels()), 4):
        situation = situation_of(labels().situations[n], final=1.0, mirrored=mirrored)
        answer = PLANNER(situation)
        if isinstance(answer, Plan) and answer.planner == "network":
            found.append((situation, answer))
    return found


def test_answers_are_certified_arrive_and_are_rarely_late() -> None:
    found, late = answers(mirrored=False), 0
    assert len(found) > 30
    for situation, answer in found:
        assert answer.certificate.holds
        assert answer.arrival.holds
        exact = plan(situation)
        assert isinstance(exact, Plan)
        assert answer.optimality.lower_bound == pytest.approx(exact.optimality.lower_bound)
        assert answer.optimality.lower_bound <= answer.time_to_converge
        if answer.optimality.proof == "relaxation":
            assert answer.time_to_converge == pytest.approx(exact.time_to_converge, abs=1e-5)
        late += answer.time_to_converge > exact.time_to_converge + 0.1
    assert late <= 2
    assert {"relaxation", "bound"} == {answer.optimality.proof for _, answer in found}


def test_mirror_images_are_answered_alike() -> None:
    pairs = zip(answers(mirrored=False), answers(mirrored=True), strict=True)
    for (_, answer), (_, image) in pairs:
        assert image.time_to_converge == pytest.approx(answer.time_to_converge, abs=1e-6)


def test_numbers_are_read_back_from_situations() -> None:
    rng = np.random.default_rng(3)
    for k, numbers in enumerate(draw_turning(rng, TurnBox(), 1, 40)):
        situation = situation_of(numbers, final=0.1 * k, mirrored=k % 2 == 1)
        frame = slot_frame(situation, situation.leader.trajectory)
        read = numbers_of(situation, frame)
        assert read is not None
        assert read[1] == (k % 2 == 1)
        np.testing.assert_allclose(read[0], numbers, atol=1e-9)


def test_other_leaders_and_situations_outside_the_box_are_passed_on() -> None:
    ask = partial(solve_behind_turn, turns())
    situation, _ = answers(mirrored=False)[0]
    radius = situation.pursuer.turn_radius
    assert ask(situation, radius) is not None
    leader = situation.leader
    turn = leader.intent[-1]
    straight_only = replace(leader, intent=(FlyStraight(duration=10.0),))
    back = replace(turn, heading=leader.heading)
    for other in (straight_only, replace(leader, intent=(*leader.intent, back))):
        assert ask(replace(situation, leader=other), radius) is None
    far = replace(situation.pursuer, x=situation.pursuer.x + 40.0 * radius)
    assert ask(replace(situation, pursuer=far), radius) is None
    unsure = replace(turns(), doubt=-1.0)
    assert solve_behind_turn(unsure, situation, radius) is None
