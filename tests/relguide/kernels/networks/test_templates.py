"""Templates: recognised in exact answers, and solved again from a guess."""

from collections import Counter
from math import cos, hypot, sin

import numpy as np
import pytest

from relguide.kernels.base.records import Disc, Pose, straight_scene
from relguide.kernels.contact.chain import BOUNDARY_ARC, MAX_LEGS
from relguide.kernels.contact.constrained_rows import solve_constrained_rows
from relguide.kernels.contact.contact import contact_heading, slide_within
from relguide.kernels.networks.template_recognition import template_of
from relguide.kernels.networks.template_solutions import solve_template
from relguide.kernels.networks.templates import NONE, SEVERAL, TEMPLATES
from relguide.kernels.words.extremals import SIGNS, fly_piece
from relguide.planning.constrained_path import BEARINGS
from tests.relguide.learn.boundary.template_networks import labels

FOUND = labels()
SLACK = 1e-6  # what the certificate allows, too [R]


def solve_answer(n: int, off: float = 0.0) -> tuple[int, float, np.ndarray]:
    """Kind, time and legs of answer n, solved again from its guess, which is put off by so much."""
    x, y, h, alpha, slot, limit = FOUND.situations[n].tolist()
    guess, legs = np.zeros(2), np.zeros((MAX_LEGS, 6))
    start, scene = Pose(x, y, h), straight_scene(alpha, slot, limit)
    template = template_of(start, scene, FOUND.legs[n, : int(FOUND.counts[n])], guess)
    if template in (SEVERAL, NONE):
        return template, np.inf, legs[:0]
    time, count = solve_template(start, scene, template, guess + off, np.inf, legs)
    return template, time, legs[:count]


def test_exact_answers_lead_back_to_themselves() -> None:
    templates: Counter[str] = Counter()
    missed, late = 0, []
    for n in range(len(FOUND)):
        template, time, legs = solve_answer(n)
        templates[TEMPLATES[template]] += 1
        if template in (SEVERAL, NONE):
            continue
        missed += len(legs) == 0
        if len(legs) > 0:
            late.append(time - FOUND.times[n, 2])
    there = len(FOUND) - templates["none"]
    assert templates["several"] < 0.02 * there
    assert missed < 0.005 * there
    # a few µs, where the search ends beside the bearings that touch by themselves
    assert np.mean(np.array(late) < 1e-5) > 0.995
    for commonest in (
        "free",
        "LS left B",
        "RSR right RLR long",
        "LSL left LSL",
        "RL left LSR",
    ):
        assert templates[commonest] > 0.03 * there


def test_a_guess_that_is_off_leads_to_the_same_path() -> None:
    same = total = 0
    for n in range(0, len(FOUND), 2):
        _, time, legs = solve_answer(n)
        if len(legs) > 1:
            _, again, _ = solve_answer(n, off=0.02)
            same += abs(again - time) < 1e-5
            total += 1
    assert total > 200
    assert same > 0.97 * total


@pytest.mark.parametrize(
    "situation",
    [
        (3.266, 2.229, 2.978, 0.5763, 2.494, 2.147),
        (6.218, 4.218, 4.531, 0.9039, 2.984, 2.228),
        (13.08, 6.831, 5.44, 0.6852, 3.934, 2.616),
        (18.78, 6.799, 0.3275, 0.7271, 2.712, 2.111),
    ],
)
def test_a_straight_way_bent_a_little_is_found_from_a_guess_beside(
    situation: tuple[float, ...],
) -> None:
    x, y, h, alpha, slot, limit = situation
    times, counts, legs = np.empty((1, 3)), np.empty(1), np.zeros((1, MAX_LEGS, 6))
    solve_constrained_rows(np.array([situation]), BEARINGS, 2000.0, times, counts, legs)
    guess, found = np.empty(2), np.zeros((MAX_LEGS, 6))
    start, scene = Pose(x, y, h), straight_scene(alpha, slot, limit)
    template = template_of(start, scene, legs[0, : int(counts[0])], guess)
    assert legs[0, 0, 5] < 0.02  # before the contact it turns no more than this, and behind it
    assert legs[0, 1, 3] < 0.02
    for off in (0.0, 0.04, -0.04):
        bearing = np.arctan2(guess[1], guess[0]) + off
        beside = np.array((cos(bearing), sin(bearing)))
        time, _ = solve_template(start, scene, template, beside, np.inf, found)
        assert time == pytest.approx(times[0, 2], abs=1e-6)


def test_ways_arrive_and_keep_the_limit() -> None:
    seen = 0
    for n in range(0, len(FOUND), 3):
        _, time, legs = solve_answer(n)
        if len(legs) < 2:
            continue
        seen += 1
        x, y, h, alpha, slot, limit = FOUND.situations[n].tolist()
        t = 0.0
        for leg in legs.tolist():
            if leg[0] == BOUNDARY_ARC:
                _, side, first, last = leg[:4]
                delta = hypot(x - slot - alpha * t, y)
                assert delta > limit - SLACK
                t += slide_within(first, last, Disc(alpha, delta, side, 0.0), np.inf)[1]
                x, y = slot + alpha * t + delta * cos(last), delta * sin(last)
                h = contact_heading(last, side, alpha)
                continue
            for sign, amount in zip(SIGNS[int(leg[2])].tolist(), leg[3:], strict=True):
                for part in np.linspace(0.0, amount, 40).tolist():
                    px, py, _ = fly_piece(Pose(x, y, h), sign, part)
                    assert hypot(px - slot - alpha * (t + part), py) > limit - SLACK
                x, y, h = fly_piece(Pose(x, y, h), sign, amount)
                t += amount
        assert abs(t - time) < 1e-9
        assert hypot(x - alpha * t, y) < 1e-6
        assert cos(h) > 1.0 - 1e-9
    assert seen > 200
