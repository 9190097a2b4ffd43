"""Words with a full loop: where the leader has to be let pass, and no way round him is as fast."""

from collections import Counter
from math import cos, inf, pi, sin

import numpy as np
import pytest

from benchmarks import draws
from relguide import Plan, Situation, check, plan
from relguide.kernels.base.angles import TWO_PI, wrap_signed
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.contact.clear_words import word_clears
from relguide.kernels.contact.looped_word import looped_word
from relguide.kernels.words.extremals import SIGNS, fly_piece


def crossing(rng: np.random.Generator) -> tuple[Pose, Scene]:
    """Somebody near the way of a leader that keeps straight, who is to fall in behind."""
    alpha, d_min = rng.uniform(0.5, 0.95), rng.uniform(0.3, 2.5)
    behind = d_min * rng.uniform(1.0, 2.0)
    leader = np.array([[0.0, behind, 0.0, 0.0, 0.0]])
    angle, away = rng.uniform(-pi, pi), d_min * rng.uniform(1.05, 3.0)
    start = Pose(behind + away * cos(angle), away * sin(angle), rng.uniform(0.0, TWO_PI))
    return start, Scene(leader, alpha, d_min, 0.0)


def test_they_keep_the_limit_arrive_in_time_and_turn_once_more() -> None:
    rng = np.random.default_rng(1)
    places: Counter[str] = Counter()
    for _ in range(3000):
        start, scene = crossing(rng)
        legs = np.zeros((2, 6))
        time, count = looped_word(start, scene, inf, legs)
        if count == 0:
            continue
        at, t, turned = start, 0.0, 0.0
        for leg in legs:
            assert word_clears(at, t, leg[1:], scene)
            for sign, amount in zip(SIGNS[int(leg[2])], leg[3:], strict=True):
                at, t = fly_piece(at, sign, amount), t + amount
                turned = max(turned, amount if sign != 0.0 else 0.0)
        assert t == pytest.approx(time, abs=1e-9)
        assert (at.x, at.y) == pytest.approx((scene.alpha * t, 0.0), abs=1e-6)
        assert wrap_signed(at.h) == pytest.approx(0.0, abs=1e-6)
        assert turned >= TWO_PI
        assert looped_word(start, scene, time, legs) == (time, 0)
        inside = legs[0, 4] > 0.0 and legs[1, 4] > 0.0
        places["straight" if inside else "three turns" if legs[0, 2] > 3.0 else "turn"] += 1
    assert min(places[place] for place in ("straight", "three turns", "turn")) > 2, places


def drawn(seed: int, case: int) -> Situation:
    rng = np.random.default_rng([seed, case])
    return draws.active(rng, tight=True, intent=True, slot_at_limit=False)


@pytest.mark.parametrize(
    ("seed", "case", "arrives", "round_it"),
    [(3002, 2048, 683.531, 730.4), (4001, 86, 287.89, 306.3)],
)
def test_who_flies_a_loop_is_there_before_who_goes_round(
    seed: int, case: int, arrives: float, round_it: float
) -> None:
    situation = drawn(seed, case)
    answer = plan(situation)
    assert isinstance(answer, Plan)
    assert answer.time_to_converge == pytest.approx(arrives, abs=0.01)
    assert answer.time_to_converge < round_it - 10.0
    assert answer.certificate.holds
    assert answer.arrival.holds
    assert check(answer, situation).holds
    assert max(duration * abs(rate) for duration, rate in answer.trajectory.bends()) > TWO_PI
