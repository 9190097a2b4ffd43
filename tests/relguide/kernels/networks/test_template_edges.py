"""Paths that are fastest where they begin to keep the limit: found from a guess beside."""

import numpy as np
import pytest

from relguide.kernels.base.records import Pose, straight_scene, with_limit
from relguide.kernels.contact.chain import MAX_LEGS
from relguide.kernels.contact.constrained_rows import solve_constrained_rows
from relguide.kernels.contact.contact import GRAZE, disc_on
from relguide.kernels.networks.near_guess import Task, descend, empty_room
from relguide.kernels.networks.template_recognition import template_of
from relguide.kernels.networks.template_solutions import solve_template
from relguide.kernels.networks.templates import PARTS, TEMPLATES
from relguide.planning.constrained_path import BEARINGS

AT_EDGES = [
    ((3.667, 3.083, 6.258, 0.9334, 2.586, 2.49), "LRL long left LSL"),
    ((9.104, 3.441, 3.164, 0.8447, 7.288, 3.342), "LSL left LSL"),
    ((6.61, 4.05, 4.065, 0.6576, 3.075, 2.532), "RSL left LSL"),
    ((4.288, 0.6641, 5.16, 0.6185, 3.261, 0.9861), "LSR right RSR"),
    ((2.99, 3.701, 6.056, 0.8252, 3.131, 2.765), "LRL left LSL"),
]


@pytest.mark.parametrize(("situation", "name"), AT_EDGES)
def test_a_path_at_an_edge_is_found_from_a_guess_beside(
    situation: tuple[float, ...], name: str
) -> None:
    x, y, h, alpha, slot, limit = situation
    times, counts, legs = np.empty((1, 3)), np.empty(1), np.zeros((1, MAX_LEGS, 6))
    solve_constrained_rows(np.array([situation]), BEARINGS, 2000.0, times, counts, legs)
    guess, found = np.empty(2), np.zeros((MAX_LEGS, 6))
    start, scene = Pose(x, y, h), straight_scene(alpha, slot, limit)
    template = template_of(start, scene, legs[0, : int(counts[0])], guess)
    assert TEMPLATES[template] == name
    for off in (0.0, 0.02, -0.02):
        time, count = solve_template(start, scene, template, guess + off, np.inf, found)
        assert count == 2
        assert time == pytest.approx(times[0, 2], abs=1e-5)
    # it is no valley: downhill leads to where the limit is broken, or to the end of a word
    entry, side, on = (int(part) for part in PARTS[template])
    eased = with_limit(scene, limit - GRAZE)
    task = Task(start, eased, disc_on(scene, 0, float(side)), entry, on)
    bearing = float(np.arctan2(guess[1], guess[0]))
    valley, _ = descend(bearing, task, np.zeros(2), empty_room())
    assert abs(valley - times[0, 2]) > 1e-6
