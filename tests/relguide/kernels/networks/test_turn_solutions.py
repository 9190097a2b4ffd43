"""From the template and the guess of an exact answer the same path comes out again."""

from math import inf

import numpy as np

from relguide.kernels.networks.turn_solutions import label_turn_templates, solve_turn_template
from relguide.kernels.networks.turn_templates import (
    GUESS,
    NONE,
    SEVERAL,
    TEMPLATES,
    turn_template_of,
)
from relguide.kernels.networks.turning_leader import turning_scene
from tests.relguide.learn.boundary.turn_networks import labels

FOUND = labels()


def test_templates_have_different_names() -> None:
    assert len(set(TEMPLATES)) == len(TEMPLATES)


def test_an_answers_own_guess_leads_back_to_it_and_a_rough_one_mostly_too() -> None:
    rng, legs, guess = np.random.default_rng(0), np.zeros((3, 6)), np.zeros(GUESS)
    told, back, rough, seen = 0, 0, 0, set()
    for n in range(len(FOUND)):
        count = int(FOUND.counts[n])
        start, scene = turning_scene(FOUND.situations[n])
        template = turn_template_of(start, scene, FOUND.legs[n, : min(count, 6)], guess)
        if template in (NONE, SEVERAL):
            continue
        told, best = told + 1, FOUND.times[n, 2]
        seen.add(TEMPLATES[template].split()[-1])
        time, _ = solve_turn_template(start, scene, template, guess, inf, True, legs)
        back += time <= best + 1e-3
        assert time >= best - 1e-3  # the search misses nothing here
        off = guess + 0.03 * rng.normal(size=GUESS)
        time, _ = solve_turn_template(start, scene, template, off, inf, True, legs)
        rough += time <= best + 1e-3
    assert told > 150
    assert back > 0.97 * told
    assert rough > 0.88 * told
    assert {"free", "delayed", "B", "D", "LR", "RL", "LSL"} <= seen


def test_arrivals_that_are_to_be_beaten_are() -> None:
    legs, guess = np.zeros((3, 6)), np.zeros(GUESS)
    for n in range(0, len(FOUND), 7):
        start, scene = turning_scene(FOUND.situations[n])
        legs_there = FOUND.legs[n, : min(int(FOUND.counts[n]), 6)]
        template = turn_template_of(start, scene, legs_there, guess)
        if template not in (NONE, SEVERAL):
            beat = FOUND.times[n, 2] - 0.01
            time, _ = solve_turn_template(start, scene, template, guess, beat, True, legs)
            assert time == inf


def test_paths_that_no_guess_leads_back_to_are_of_several_contacts() -> None:
    paths, size = FOUND.paths, len(FOUND)
    templates, guesses = np.empty(size), np.empty((size, GUESS))
    label_turn_templates(
        paths.situations, paths.times, paths.counts.astype(float), paths.legs, 1e-3,
        templates, guesses,
    )  # fmt: skip
    none = paths.counts == 0
    assert (templates[none] == NONE).all()
    assert 0.0 < np.mean(templates[~none] == SEVERAL) < 0.12
    later = paths.times - 0.1
    label_turn_templates(
        paths.situations, later, paths.counts.astype(float), paths.legs, 1e-3, templates, guesses
    )
    assert (templates[~none] == SEVERAL).all()
