"""Words to a point, all at once and one by one: the same, and each leads there."""

from math import cos, hypot, sin

import numpy as np
import pytest
from hypothesis import example, given

from relguide.kernels.base.records import Pose, start_at
from relguide.kernels.words.branches import SIZE, WORD_OF
from relguide.kernels.words.extremals import SIGNS, fly_piece
from relguide.kernels.words.to_point import every_word, word_to_point
from tests.situations import headings, numbers


@given(x=numbers(-6.0, 6.0), y=numbers(-6.0, 6.0), h=headings)
@example(x=0.0, y=0.0, h=0.0)
@example(x=0.0, y=4.0, h=0.0)  # circles that touch
@example(x=-2.0, y=0.0, h=0.0)
def test_all_at_once_are_those_one_by_one_and_lead_there(x: float, y: float, h: float) -> None:
    pose, piece = Pose(x, y, h), np.empty(3)
    lengths, turns = np.empty(SIZE), np.empty((SIZE, 2))
    every_word(start_at(pose), 63, lengths, turns)
    for branch in range(SIZE):
        length = word_to_point(pose, 0.0, branch, piece)
        if length < 0.0:
            assert np.isnan(lengths[branch])
            continue
        # a turn that is a full one or none may be either, by rounding
        assert sin(lengths[branch] - length) == pytest.approx(0.0, abs=1e-7)
        end = pose
        amounts = turns[branch, 0], lengths[branch] - turns[branch].sum(), turns[branch, 1]
        for sign, amount in zip(SIGNS[WORD_OF[branch]], amounts, strict=True):
            end = fly_piece(end, sign, amount)
        assert hypot(end.x, end.y) < 1e-7
        assert cos(end.h) > 1.0 - 1e-12
