"""Times behind leaders that turn: what is decided at once is what `plan` says."""

from collections.abc import Sequence
from dataclasses import replace
from math import inf

import numpy as np
import pytest
from hypothesis import given

from relguide import (
    LEFT,
    FlyStraight,
    Leader,
    NoPlan,
    Plan,
    Pursuer,
    Reason,
    Situation,
    TurnTo,
    plan,
)
from relguide.planning.batch import Situations
from relguide.planning.turning_batch import Intents, TurningTimes, can_be_flown, turning_times
from relguide.units import DEG
from tests.columns import columns_of
from tests.situations import coincidences, situations

BEHIND = Situation(
    pursuer=Pursuer(x=-30e3, y=20e3, heading=1.0, tas=240.0, max_bank=25 * DEG),
    leader=Leader(
        x=0.0,
        y=0.0,
        heading=0.0,
        tas=200.0,
        intent=(FlyStraight(duration=60.0), TurnTo(heading=1.0, turn=LEFT, bank=20 * DEG)),
    ),
    slot_distance=12e3,
    min_separation=9e3,
)


def columns_with_intents(many: Sequence[Situation]) -> tuple[Situations, Intents]:
    pieces = [
        (0.0, piece.duration, 0.0)
        if isinstance(piece, FlyStraight)
        else (piece.turn, piece.heading, piece.bank)
        for s in many
        for piece in s.leader.intent
    ]
    counts = np.array([len(s.leader.intent) for s in many], np.int64)
    return columns_of(many), Intents(counts=counts, pieces=np.array(pieces, float).reshape(-1, 3))


def check_against_plan(many: Sequence[Situation]) -> TurningTimes:
    """Each that is decided is what `plan` says, and the others at least have no time."""
    found = turning_times(*columns_with_intents(many))
    for i, situation in enumerate(many):
        answer = plan(situation)
        lost = isinstance(answer, NoPlan) and answer.reason == Reason.SEPARATION_ALREADY_LOST
        assert found.already_lost[i] == lost
        if not found.decided[i]:
            assert found.time_to_converge[i] == inf
            continue
        assert isinstance(answer, Plan)
        assert answer.optimality.proof == "relaxation"
        assert found.time_to_converge[i] == pytest.approx(answer.time_to_converge, abs=1e-6)
    return found


@given(situations(reach=25_000.0))
def test_what_is_decided_is_what_plan_says(situation: Situation) -> None:
    check_against_plan([situation])


@given(coincidences(with_intent=True, with_wind=True))
def test_where_numbers_coincide_as_well(situation: Situation) -> None:
    check_against_plan([situation])


def test_near_the_leader_nine_of_ten_optima_are_decided() -> None:
    rng = np.random.default_rng(8)
    cases = []
    for _ in range(400):
        intent = (
            FlyStraight(duration=float(rng.uniform(0.0, 60.0))),
            TurnTo(heading=float(rng.uniform(0.0, 6.0)), turn=LEFT, bank=25 * DEG),
        )
        x, y = rng.uniform(-40e3, 40e3, 2)
        away = replace(BEHIND.pursuer, x=float(x), y=float(y), heading=float(rng.uniform(0, 6)))
        leader = replace(BEHIND.leader, intent=intent)
        cases.append(replace(BEHIND, pursuer=away, leader=leader))
    found = check_against_plan(cases)
    proved = [
        isinstance(answer, Plan) and answer.optimality.proof == "relaxation"
        for answer in map(plan, cases)
    ]
    assert np.count_nonzero(found.decided) >= 0.88 * np.count_nonzero(proved) > 200


def test_what_arrives_beyond_the_horizon_is_left_to_plan() -> None:
    late = replace(BEHIND.leader, intent=(FlyStraight(duration=86_400.0), *BEHIND.leader.intent))
    found = turning_times(*columns_with_intents([BEHIND, replace(BEHIND, leader=late), BEHIND]))
    assert found.decided.tolist() == [True, False, True]


@pytest.mark.parametrize(
    "piece",
    [
        (1.0, 1.0, 61.0 * DEG),
        (1.0, 1.0, 0.5 * DEG),
        (1.0, 2e6, 20 * DEG),
        (0.0, -1.0, 0.0),
        (0.0, 1e5, 0.0),
        (0.0, float("nan"), 0.0),
    ],
)
def test_which_intents_can_be_flown(piece: tuple[float, float, float]) -> None:
    situations, intents = columns_with_intents([BEHIND, BEHIND, BEHIND])
    assert can_be_flown(situations, intents).all()
    intents.pieces[3] = piece
    assert can_be_flown(situations, intents).tolist() == [True, False, True]


def test_headway_is_made_on_the_final_leg_alone() -> None:
    against = replace(BEHIND.leader, tas=80.0)
    situations, intents = columns_with_intents([replace(BEHIND, leader=against)])
    for north, flown in ((-79.5, True), (-30.0, True)):
        blown = replace(situations, wind_north=[north])
        assert can_be_flown(blown, intents).tolist() == [flown]
    out = replace(situations, wind_east=[-80.0 * np.sin(1.0)], wind_north=[-80.0 * np.cos(1.0)])
    assert can_be_flown(out, intents).tolist() == [False]


def test_the_last_turn_alone_says_where_an_intent_leads() -> None:
    _, intents = columns_with_intents(
        [BEHIND, replace(BEHIND, leader=replace(BEHIND.leader, intent=()))]
    )
    assert intents.final_headings(np.array([0.5, 0.25])).tolist() == [1.0, 0.25]
    assert intents[np.array([True, False])].counts.tolist() == [2]
    assert len(intents[np.array([False, True])].pieces) == 0


def test_turns_that_rounding_makes_full_are_none_here_too() -> None:
    """Alone, after another turn, and beside a leader whose turn is meant."""
    near, far = np.float32(90.1) * DEG, 90.1 * DEG
    turn = TurnTo(heading=far, turn=LEFT, bank=20 * DEG)
    other = TurnTo(heading=float(near), turn=LEFT, bank=20 * DEG)
    leader = replace(BEHIND.leader, heading=float(near), intent=(turn,))
    many = [
        replace(BEHIND, leader=leader),
        replace(BEHIND, leader=replace(leader, heading=2.0, intent=(turn, other, turn))),
        BEHIND,
    ]
    straight = replace(BEHIND, leader=replace(leader, intent=()))
    found = check_against_plan(many)
    assert found.decided[0]
    answer = plan(straight)
    assert isinstance(answer, Plan)
    assert found.time_to_converge[0] == pytest.approx(answer.time_to_converge, abs=1e-2)
