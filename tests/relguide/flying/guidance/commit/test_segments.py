"""Pieces of constant curvature as segments."""

import numpy as np
import pytest

from relguide.flying.guidance.commit.segments import segments_of
from relguide.planning.trajectory import LEFT, RIGHT, Arc, Straight


def test_pieces_that_go_on_across_a_cut_are_one_segment() -> None:
    bend = 1.0 / 8_000.0
    pieces = [
        [500.0, 0.0], [300.0, 0.0], [1e-6, bend], [4_000.0, bend], [4_000.0, bend],
        [800.0, -bend], [0.0, 0.0],
    ]  # fmt: skip
    straight, right, left = segments_of(np.array(pieces))
    assert straight == Straight(length=800.0)
    for segment, turn, angle in ((right, RIGHT, 1.0), (left, LEFT, 0.1)):
        assert isinstance(segment, Arc)
        assert segment.turn == turn
        assert segment.turn_angle == pytest.approx(angle)
        assert segment.radius == pytest.approx(8_000.0)
    assert segments_of(np.zeros((0, 2))) == ()
