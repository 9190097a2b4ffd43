"""Segments as callers give them: any number will do, and what is none is refused."""

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given

from relguide import (
    LEFT,
    RIGHT,
    Arc,
    BoundaryArc,
    Straight,
    Trajectory,
    certify,
)
from tests.calls import SITUATION
from tests.junk import junk


@given(amount=junk, other=junk, boundary_arc=junk)
def test_a_wrong_segment_is_refused_with_a_sentence(
    amount: Any, other: Any, boundary_arc: Any
) -> None:
    for segment in (
        Straight(length=amount),
        Arc(turn=LEFT, turn_angle=amount, radius=1e3),
        Arc(turn=LEFT, turn_angle=1.0, radius=amount),
        Arc(turn=other, turn_angle=amount, radius=1e3),
        BoundaryArc(side=LEFT, bends=boundary_arc),
        BoundaryArc(side=LEFT, bends=(boundary_arc,)),  # type: ignore[arg-type]
        BoundaryArc(side=LEFT, bends=((amount, other),)),
        BoundaryArc(side=other, bends=((1.0, 0.0),)),
        amount,
    ):
        try:
            path = Trajectory(x=0.0, y=0.0, heading=0.0, tas=200.0, segments=(segment,))
        except ValueError as refusal:
            said = str(refusal)
        else:
            certify(path, SITUATION)
            path.breakpoints()
            continue
        assert "must" in said
        assert said.endswith(".")


@pytest.mark.parametrize("value", [1, np.float32(1.0), np.int64(1), Fraction(1)])
def test_segments_are_of_floats(value: Any) -> None:
    segments = (
        Straight(length=value),
        Arc(turn=np.int64(1), turn_angle=value, radius=value),  # type: ignore[arg-type]
        BoundaryArc(side=np.int64(-1), bends=((value, value),)),  # type: ignore[arg-type]
    )
    path = Trajectory(x=0.0, y=0.0, heading=0.0, tas=200.0, segments=segments)
    assert repr(path.segments) == repr(
        (
            Straight(length=1.0),
            Arc(turn=LEFT, turn_angle=1.0, radius=1.0),
            BoundaryArc(side=RIGHT, bends=((1.0, 1.0),)),
        )
    )
