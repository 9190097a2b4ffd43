"""By a deadline: an answer in time whatever is asked, and never a worse one for more time."""

import json
import sys
from dataclasses import replace
from itertools import pairwise
from math import inf, nan
from pathlib import Path
from time import thread_time

import numpy as np
import pytest

from benchmarks import deadline as bench
from relguide import (
    LEFT,
    RIGHT,
    Leader,
    NoPlan,
    Plan,
    Pursuer,
    Situation,
    TurnTo,
    alternatives,
    certify,
    plan,
    prove,
)
from relguide.__main__ import main
from relguide.contract.answers import answer
from relguide.learn.planners import PLANNERS, make_planner
from relguide.planning.acceptance import ask, takes_deadline
from relguide.planning.deadline import MAX_DEADLINE, load_kernels
from relguide.planning.trajectory import Turn
from relguide.units import DEG
from tests.bodies import BODY
from tests.plans import find_plan, golden_plan, straight_behind

LATE = 0.1
"""So long after its deadline each answer has come [s]: without one these take from 0.3 s to hours.
How many come 5 ms late is measured where nothing runs beside it, by `benchmarks.deadline`."""
ROUNDING = 1e-3
"""A path is flown as it was found to 2e-4 R/V_P: times of one and the same differ by less [s]."""


def behind_a_slow_turn(
    x: float, y: float, heading: float, *, turn: Turn, to: float, slot: float, limit: float
) -> Situation:
    """A leader that turns for hours: at each moment of them it can be touched all round."""
    bend = TurnTo(heading=to, turn=turn, bank=1 * DEG)
    return Situation(
        pursuer=Pursuer(x=x, y=y, heading=heading, tas=400.0, max_bank=60 * DEG),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=395.0, intent=(bend,)),
        slot_distance=slot,
        min_separation=limit,
    )


SLOW = (
    behind_a_slow_turn(-265e3, 266e3, 0.5, turn=LEFT, to=2.7, slot=141e3, limit=139e3),
    behind_a_slow_turn(103e3, 104e3, 1.6, turn=RIGHT, to=3.8, slot=78e3, limit=72e3),
)
"""Without a deadline they take from 0.3 s to several seconds."""


def cpu_time_of(situation: Situation, deadline: float) -> tuple[float, Plan | NoPlan]:
    load_kernels()
    begun = thread_time()
    reply = plan(situation, deadline=deadline)
    return thread_time() - begun, reply


def arrival(reply: Plan | NoPlan) -> float:
    return reply.time_to_converge if isinstance(reply, Plan) else inf


@pytest.mark.parametrize("deadline", [0.0, 0.02])
@pytest.mark.parametrize("situation", SLOW)
def test_the_slowest_are_answered_in_time(situation: Situation, deadline: float) -> None:
    # by CPU time: whatever else this machine does counts for nothing
    took, reply = cpu_time_of(situation, deadline)
    assert took < deadline + LATE
    match reply:
        case Plan():
            assert certify(reply.trajectory, situation).holds
            assert reply.arrival.holds
        case NoPlan():
            assert reply.reason == "deadline"
            assert 0.0 < reply.lower_bound < inf
            assert reply.message.endswith("A later deadline may help.")


@pytest.mark.slow
def test_whatever_is_drawn_is_answered_in_time() -> None:
    deadline = 0.02
    late = []
    for case in range(400):
        situation = bench.draw(np.random.default_rng([2022, case]))
        took, reply = cpu_time_of(situation, deadline)
        if took > deadline + LATE:
            late.append((took, situation))
        if isinstance(reply, Plan):
            assert certify(reply.trajectory, situation).holds
            assert reply.optimality.lower_bound <= reply.time_to_converge + 1e-6
    assert not late


@pytest.mark.slow
@pytest.mark.parametrize("situation", SLOW)
def test_more_time_never_gives_a_worse_answer(situation: Situation) -> None:
    replies = [plan(situation, deadline=deadline) for deadline in (0.0, 0.01, 0.04, 0.16, 0.64)]
    assert all(later <= sooner + ROUNDING for sooner, later in pairwise(map(arrival, replies)))
    bounds = [reply.optimality.lower_bound for reply in replies if isinstance(reply, Plan)]
    assert len(set(bounds)) <= 1


def test_with_time_enough_the_answer_is_that_without_a_deadline() -> None:
    for name in ("R053", "R068"):
        situation = golden_plan(name).situation
        whole, timed = find_plan(situation), plan(situation, deadline=60.0)
        assert isinstance(timed, Plan)
        assert timed.trajectory == whole.trajectory
        assert timed.optimality == whole.optimality


def test_with_no_time_at_all_the_fastest_extremal_is_still_looked_at() -> None:
    free = plan(straight_behind(), deadline=0.0)
    assert isinstance(free, Plan)
    assert free.optimality.proof == "relaxation"
    bound = golden_plan("R053")
    reply = plan(bound.situation, deadline=0.0)
    assert arrival(reply) >= bound.time_to_converge
    if isinstance(reply, NoPlan):
        assert reply.lower_bound == bound.optimality.lower_bound


def test_a_lost_separation_is_said_at_once() -> None:
    lost = replace(golden_plan("R053").situation, min_separation=0.0)
    distance = np.hypot(lost.pursuer.x - lost.leader.x, lost.pursuer.y - lost.leader.y) + 100.0
    lost = replace(lost, slot_distance=distance, min_separation=distance)
    whole, hurried = plan(lost), plan(lost, deadline=0.0)
    assert isinstance(whole, NoPlan)
    assert isinstance(hurried, NoPlan)
    assert hurried.reason == whole.reason == "separation_already_lost"
    assert whole.message.startswith(hurried.message)
    assert len(whole.message) > len(hurried.message)


@pytest.mark.parametrize("wrong", [-0.1, nan, inf, 2.0 * MAX_DEADLINE, "soon", True])
def test_a_deadline_that_makes_no_sense_is_refused(wrong: object) -> None:
    with pytest.raises(ValueError, match="The deadline must"):
        plan(golden_plan("R051").situation, deadline=wrong)  # type: ignore[arg-type]


def test_alternatives_end_in_time_too() -> None:
    flown = golden_plan("R053")
    everything = alternatives(flown)
    assert alternatives(flown, deadline=60.0) == everything
    assert len(alternatives(flown, deadline=0.0)) < len(everything)


def test_a_proof_ends_in_time_where_paths_take_days() -> None:
    """They were looked at step by step, for hours."""
    followed = bench.draw(np.random.default_rng([55, 15]))
    flown = find_plan(followed)
    assert flown.optimality.proof == "bound"
    prove(flown, seconds=0.0)  # loads the kernels

    begun = thread_time()
    prove(flown, seconds=0.02)
    assert thread_time() - begun < 0.02 + LATE


def test_planners_that_take_a_deadline_get_it() -> None:
    situation = SLOW[0]
    given = []

    def own(asked: Situation, *, deadline: float | None = None) -> NoPlan:
        given.append(deadline)
        raise AssertionError

    with pytest.raises(AssertionError):
        ask(own, situation, deadline=0.25)
    assert given[0] == pytest.approx(0.25, abs=0.05)
    assert [name for name in PLANNERS if takes_deadline(make_planner(name))] == ["exact", "network"]


@pytest.mark.parametrize("name", ["exact", "network"])
def test_named_planners_keep_it(name: str) -> None:
    planner = make_planner(name)
    ask(planner, SLOW[0], deadline=0.0)  # loads the kernels
    for situation in SLOW:
        begun = thread_time()
        ask(planner, situation, deadline=0.02)
        assert thread_time() - begun < 0.02 + LATE


def test_one_that_takes_none_is_let_finish_and_then_the_exact_planner_has_what_is_left() -> None:
    reply = ask(lambda situation: "no plan", SLOW[0], deadline=0.0)  # type: ignore[arg-type, return-value]
    assert reply.fell_back
    assert isinstance(reply.plan, NoPlan | Plan)


def test_an_answer_in_json_says_the_bound() -> None:
    reply = answer(SLOW[0], None, plan, deadline=0.0)
    if reply["status"] == "no_plan":
        assert reply["reason"] == "deadline"
        assert reply["lower_bound_s"] > 0.0


def test_the_command_line_keeps_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "situation.json"
    file.write_text(json.dumps(BODY))
    for more in (["--deadline", "5"], ["--deadline", "5", "--table"]):
        assert main(["plan", str(file), *more]) == 0
    capsys.readouterr()
    assert main(["plan", "--batch", str(file), "--deadline", "5", "--prove", "0.1"]) == 0
    assert json.loads(capsys.readouterr().out)["status"] == "planned"
    monkeypatch.setattr(sys, "argv", ["relguide"])
    assert main(["plan", str(file), "--deadline", "5", "--planner", "regular_dp"]) == 2
    assert "keeps no deadline" in capsys.readouterr().err
    for wrong in ("-1", "soon"):
        with pytest.raises(SystemExit):
            main(["plan", str(file), "--deadline", wrong])
