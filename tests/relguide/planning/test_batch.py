"""Many at once: the same answers as one by one, whatever the number of threads."""

from dataclasses import replace
from math import inf, nan, pi

import numpy as np
import pytest

from relguide import Leader, NoPlan, Plan, Pursuer, Situation, Wind, plan
from relguide.planning.batch import Situations, plan_arrays
from relguide.units import DEG

RNG = np.random.default_rng(3)
N = 200
COLUMNS = Situations(
    pursuer_x=RNG.uniform(-40e3, 40e3, N),
    pursuer_y=RNG.uniform(-40e3, 40e3, N),
    pursuer_heading=RNG.uniform(0.0, 2.0 * pi, N),
    pursuer_tas=RNG.uniform(180.0, 260.0, N),
    max_bank=RNG.uniform(15 * DEG, 30 * DEG, N),
    leader_heading=RNG.uniform(0.0, 2.0 * pi, N),
    leader_tas=RNG.uniform(150.0, 240.0, N),
    slot_distance=12e3,
    min_separation=9e3,
    wind_east=RNG.uniform(-30.0, 30.0, N),
    wind_north=10.0,
)


def one(i: int) -> Situation:
    px, py, psi, tas, bank, lx, ly, leading, leader_tas, distance, nearest, east, north = (
        float(column[i]) for column in COLUMNS.columns()
    )
    return Situation(
        pursuer=Pursuer(x=px, y=py, heading=psi, tas=tas, max_bank=bank),
        leader=Leader(x=lx, y=ly, heading=leading, tas=leader_tas),
        slot_distance=distance,
        min_separation=nearest,
        wind=Wind(east=east, north=north),
    )


def test_each_row_is_what_plan_says() -> None:
    answers = plan_arrays(COLUMNS)
    seen = set()
    for i in range(N):
        answer = plan(one(i))
        if isinstance(answer, NoPlan):
            assert answers.verdict[i] == answer.reason
            assert answers.time_to_converge[i] == inf
        else:
            assert isinstance(answer, Plan)
            assert answers.verdict[i] == "planned"
            assert answers.time_to_converge[i] == pytest.approx(answer.time_to_converge, abs=1e-3)
            assert answers.proved[i] == (answer.optimality.proof == "relaxation")
            assert answers.lower_bound[i] == pytest.approx(answer.optimality.lower_bound, abs=1e-3)
            if answers.proved[i]:
                assert answers.word[i] == answer.word
        seen.add(str(answers.verdict[i]))
        seen.add(str(answers.word[i]))
    assert {"planned", "separation_already_lost", "detour", "LSL"} <= seen


def test_threads_change_nothing_and_progress_counts() -> None:
    done: list[int] = []
    single = plan_arrays(COLUMNS, threads=1, progress=done.append)
    several = plan_arrays(COLUMNS, threads=4)
    assert np.array_equal(single.time_to_converge, several.time_to_converge)
    assert sum(done) == N


def test_without_the_limit_nothing_is_lost() -> None:
    free = plan_arrays(COLUMNS, limited=False)
    held = plan_arrays(COLUMNS)
    assert not np.any(free.verdict == "separation_already_lost")
    reached = np.isfinite(free.time_to_converge)
    assert np.all(free.time_to_converge[reached] <= held.time_to_converge[reached] + 1e-9)
    assert np.all(free.proved[reached])


@pytest.mark.parametrize(
    ("changes", "rule"),
    [
        ({"pursuer_x": nan}, "finite numbers"),
        ({"leader_tas": 20.0}, "leader_tas in 30 … 400 m/s"),
        ({"max_bank": 1.2}, "max_bank in 1 … 60°"),
        ({"slot_distance": 8e3}, "0 ≤ min_separation ≤ slot_distance"),
        ({"wind_east": 200.0}, "wind of at most 150 m/s"),
        ({"pursuer_y": 2e6}, "pursuer_y"),
    ],
)
def test_a_row_that_cannot_be_flown_is_named(changes: dict[str, float], rule: str) -> None:
    with pytest.raises(ValueError, match=r"^Situation 0 breaks a rule: there must be .*" + rule):
        plan_arrays(replace(COLUMNS, **changes))  # type: ignore[arg-type]
