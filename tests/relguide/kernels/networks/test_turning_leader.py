"""The scene that eleven numbers describe is that of the situation they stand for."""

import numpy as np
import pytest

from relguide.kernels.networks.turning_leader import turning_scene
from relguide.learn.boundary.turn_labels import TurnBox, draw_turning
from relguide.planning.slot import slot_frame
from relguide.planning.tables import scene_of
from tests.relguide.learn.boundary.turning_situations import situation_of


@pytest.mark.parametrize("source", [0, 1])
def test_numbers_describe_the_scene_of_their_situation(source: int) -> None:
    rng = np.random.default_rng(source)
    for numbers in draw_turning(rng, TurnBox(), source, 50):
        pose, scene = turning_scene(numbers)
        situation = situation_of(numbers, final=float(rng.uniform(-3.0, 3.0)))
        frame = slot_frame(situation, situation.leader.trajectory)
        meant = scene_of(situation, frame)
        # 1e-9 R: rounding of positions some hundred kilometres out
        np.testing.assert_allclose(frame.pose, pose, atol=1e-9)
        off = meant.leader - scene.leader
        off[:, 3] = np.angle(np.exp(1j * off[:, 3]))
        np.testing.assert_allclose(off, 0.0, atol=1e-9)
        np.testing.assert_allclose(meant[1:], scene[1:], atol=1e-9)
