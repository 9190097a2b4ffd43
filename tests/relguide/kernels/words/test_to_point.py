"""Words to a point: each leads there."""

from math import cos, hypot

import numpy as np
import pytest
from hypothesis import example, given

from relguide.kernels.base.records import Pose
from relguide.kernels.words.branches import SIZE, WORD_OF
from relguide.kernels.words.extremals import SIGNS, fly_piece
from relguide.kernels.words.to_point import word_to_point
from tests.situations import headings, numbers


@given(x=numbers(-6.0, 6.0), y=numbers(-6.0, 6.0), h=headings)
@example(x=0.0, y=0.0, h=0.0)
@example(x=0.0, y=4.0, h=0.0)  # circles that touch
@example(x=-2.0, y=0.0, h=0.0)
def test_each_word_that_reaches_leads_there(x: float, y: float, h: float) -> None:
    pose, piece = Pose(x, y, h), np.empty(3)
    for branch in range(SIZE):
        length = word_to_point(pose, 0.0, branch, piece)
        if length < 0.0:
            continue
        assert length == pytest.approx(piece.sum())
        end = pose
        for sign, amount in zip(SIGNS[WORD_OF[branch]], piece, strict=True):
            end = fly_piece(end, sign, amount)
        assert hypot(end.x, end.y) < 1e-7
        assert cos(end.h) > 1.0 - 1e-12
