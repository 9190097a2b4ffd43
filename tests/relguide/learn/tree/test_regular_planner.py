"""The paper's tree as a planner: certified whatever it says, exact where it cannot say."""

from dataclasses import replace
from math import hypot, pi

import numpy as np
import pytest
from hypothesis import given, settings

from relguide import Leader, NoPlan, Plan, Pursuer, Situation, candidates, certify, plan
from relguide.flying.documents import FlightEnded
from relguide.flying.flight import fly
from relguide.flying.scenarios import scenario
from relguide.kernels.words.extremals import WORDS
from relguide.learn.tree import regular_planner as module
from relguide.learn.tree.regular_planner import ratios_of, regular_planner, tree_for
from relguide.learn.tree.regular_words import RegularPiece, merge, pieces_of, words_like
from relguide.planning.slot import slot_frame
from relguide.units import DEG
from tests.situations import situations


def a300(x: float, y: float, heading: float, leader_tas: float = 200.0) -> Situation:
    return Situation(
        pursuer=Pursuer(x=x, y=y, heading=heading, tas=240.0, max_bank=25.0 * DEG),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=leader_tas),
        slot_distance=12_000.0,
        min_separation=9_260.0,
    )


def draw(count: int) -> list[Situation]:
    rng = np.random.default_rng(4)
    found = []
    while len(found) < count:
        x, y = rng.uniform(-55e3, 55e3, 2)
        if hypot(x, y) > 25e3:
            found.append(a300(x, y, rng.uniform(0.0, 2.0 * pi)))
    return found


def likely(letters: str) -> set[str]:
    return {
        WORDS[number] for number in words_like([RegularPiece(letter, 1.0) for letter in letters])
    }


def test_letters_spell_words() -> None:
    assert likely("LSR") == {"LSR"}
    assert likely("RLR") == {"RLR"}
    assert likely("LS") == {"LSL", "LSR"}
    assert likely("RL") == {"RSL", "LRL", "RLR"}
    assert likely("") == set(WORDS)
    assert likely("LL") == {"LSL", "LSR", "RSL", "LRL", "RLR"}


def test_what_is_like_no_word_loses_its_shortest_pieces() -> None:
    pieces = [
        RegularPiece("L", 1.0),
        RegularPiece("S", 3.0),
        RegularPiece("R", 0.2),
        RegularPiece("S", 0.5),
        RegularPiece("R", 0.3),
    ]
    # L S R S R: without the short turn the straights are one
    assert [WORDS[number] for number in words_like(pieces)] == ["LSR"]
    assert merge([RegularPiece("S", 1.0), RegularPiece("S", 2.0)]) == [RegularPiece("S", 3.0)]
    assert pieces_of([[1.0, 0.5, 0.0], [-1.0, 0.0, 2.0], [1.0, 0.1, 3.0], [0.0, 0.0, 0.0]]) == [
        RegularPiece("L", 0.5),
        RegularPiece("S", 2.0),
        RegularPiece("L", 0.1),
        RegularPiece("S", 3.0),
    ]


@settings(max_examples=20, deadline=None)  # a tree may have to be grown first
@given(situations(speed_ratio=(0.8, 0.83)))
def test_every_answer_is_certified_and_none_beats_the_bound(situation: Situation) -> None:
    planned, exact = regular_planner(situation), plan(situation)
    assert isinstance(planned, NoPlan) == isinstance(exact, NoPlan)
    if isinstance(planned, Plan):
        assert certify(planned.trajectory, situation).holds
        fastest = candidates(situation).bound
        assert planned.time_to_converge >= fastest - 1e-6
        assert planned.planner == ("exact" if planned.fell_back else "regular_dp")
        if not planned.fell_back:
            assert planned.optimality.proof == "bound"
            assert planned.optimality.lower_bound <= fastest + 1e-6


def test_its_paths_end_in_the_slot_and_most_are_the_fastest() -> None:
    gaps = []
    for situation in draw(150):
        planned, exact = regular_planner(situation), plan(situation)
        assert isinstance(planned, Plan)
        assert isinstance(exact, Plan)
        end = planned.trajectory.pose_at(planned.time_to_converge)
        slot = 200.0 * planned.time_to_converge - 12_000.0
        assert hypot(end.x, end.y - slot) < 0.1
        assert abs((end.heading + pi) % (2.0 * pi) - pi) < 1e-6
        if not planned.fell_back:
            gaps.append(planned.time_to_converge / exact.time_to_converge - 1.0)
    assert len(gaps) > 135
    assert np.mean(np.array(gaps) < 1e-6) > 0.85


def test_the_limit_is_gone_round_as_the_tree_did() -> None:
    """From ahead, on the opposite course: the word alone passes the leader at 2 NM."""
    situation = a300(-2_000.0, 60e3, pi)
    planned, exact = regular_planner(situation), plan(situation)
    assert isinstance(planned, Plan)
    assert isinstance(exact, Plan)
    assert exact.optimality.proof == "bound"
    assert not planned.fell_back
    assert len(planned.word) > 3
    assert certify(planned.trajectory, situation).holds
    assert exact.time_to_converge <= planned.time_to_converge < 1.5 * exact.time_to_converge


@pytest.mark.parametrize(
    "situation",
    [a300(0.0, -400e3, 0.0), a300(20e3, 20e3, 0.0, leader_tas=239.0)],
    ids=["far", "as fast"],
)
def test_beyond_the_tree_the_exact_planner_answers(situation: Situation) -> None:
    planned, exact = regular_planner(situation), plan(situation)
    assert isinstance(planned, Plan)
    assert isinstance(exact, Plan)
    assert (planned.planner, planned.fell_back) == ("exact", True)
    assert planned.trajectory == exact.trajectory


def test_one_tree_serves_what_is_alike() -> None:
    def ratios(situation: Situation) -> module.Ratios:
        return ratios_of(situation, slot_frame(situation, situation.leader.trajectory))

    here = ratios(a300(20e3, 20e3, 1.0))
    assert ratios(a300(-20e3, 30e3, 2.0, leader_tas=199.0)) == here
    assert (here.speed, here.slot, here.limit) == (pytest.approx(0.825), 1.0, 0.75)
    assert tree_for(here) is tree_for(replace(here))
    far = replace(a300(20e3, 20e3, 1.0), slot_distance=200e3, min_separation=190e3)
    assert ratios(far).slot == module.FARTHEST_LEADER
    assert ratios(far).limit == 15.0 - 0.75


@pytest.mark.slow
def test_it_flies() -> None:
    *_, ended = fly(scenario("fig_6b"), regular_planner, sample_period=1.0)
    assert isinstance(ended, FlightEnded)
    (result,) = ended.results
    assert result.joined
    assert result.least_separation >= 9_260.0
    assert result.join_time < 930.0
