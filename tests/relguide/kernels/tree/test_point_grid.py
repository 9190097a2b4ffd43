"""Nearest points by a grid: the same as by looking at all of them."""

import numpy as np
import pytest

from relguide.kernels.tree.point_grid import nearest_points, point_grid


def nearest(points: np.ndarray, asked: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    distances, numbers = np.empty(len(asked)), np.empty(len(asked), np.int64)
    nearest_points(point_grid(points), asked, distances, numbers)
    return distances, numbers


@pytest.mark.parametrize("spread", [(1.0, 1.0), (30.0, 1.0), (0.0, 5.0), (0.0, 0.0)])
@pytest.mark.parametrize("count", [1, 7, 3000])
def test_no_point_is_nearer(spread: tuple[float, float], count: int) -> None:
    rng = np.random.default_rng(2)
    scale = np.array([*spread, 0.3, 0.3])
    points = scale * rng.normal(size=(count, 4))
    # a hole in the middle, so that whole rings are empty
    points[:, 0] += np.where(points[:, 0] > 0.0, spread[0], -spread[0])
    asked = np.concatenate((2.0 * (scale + 0.1) * rng.normal(size=(300, 4)), points[:20]))
    asked[:40] *= 20.0  # far outside
    distances, numbers = nearest(points, asked)
    by_all = np.linalg.norm(points[None] - asked[:, None], axis=2)
    np.testing.assert_allclose(distances, by_all.min(axis=1), rtol=1e-12, atol=1e-15)
    np.testing.assert_array_equal(by_all[np.arange(len(asked)), numbers], by_all.min(axis=1))
    assert (distances[300:] == 0.0).all()
