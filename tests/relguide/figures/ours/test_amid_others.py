"""Cells are drawn as the hull of their corners, grown."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from relguide.figures.ours.amid_others import _hull

whole = st.integers(-50, 50)


@given(points=st.lists(st.tuples(whole, whole), min_size=3, max_size=30, unique=True))
def test_a_hull_is_convex_and_holds_all_points(points: list[tuple[int, int]]) -> None:
    hull = _hull(np.array(points, float))
    if len(hull) < 3:
        return
    following = np.roll(hull, -1, axis=0)
    edges = following - hull
    for point in np.array(points, float):
        beside = point - hull
        assert (edges[:, 0] * beside[:, 1] - edges[:, 1] * beside[:, 0] >= 0.0).all()
