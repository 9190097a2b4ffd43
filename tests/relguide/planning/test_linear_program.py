"""Linear programmes of few unknowns, against scipy's."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import linprog

from relguide.planning.linear_program import highest_corner

BOX = 10.0


def box(rows: np.ndarray, due: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Inequalities within a box, and the numbers of those that make its first corner."""
    m = rows.shape[1]
    walls = np.vstack((np.eye(m), -np.eye(m)))
    return np.vstack((walls, rows)), np.concatenate((np.full(2 * m, BOX), due)), np.arange(m)


@given(
    seed=st.integers(0, 2**32 - 1),
    m=st.integers(1, 5),
    n=st.integers(0, 60),
    met=st.booleans(),
    alike=st.booleans(),
)
def test_the_highest_corner_is_as_high_as_scipys(
    seed: int, m: int, n: int, met: bool, alike: bool
) -> None:
    rng = np.random.default_rng(seed)
    rows, inside = rng.normal(size=(n, m)), rng.uniform(-BOX, BOX, m)
    due = rows @ inside + rng.exponential(size=n) if met else rng.normal(size=n)
    if alike:  # many through one point, and each of them twice
        rows, due = np.vstack((rows, rows)), np.tile(rows @ inside, 2)
    rows, due, start = box(rows, due)
    found = highest_corner(rows, due, start)
    goal = np.zeros(m)
    goal[-1] = -1.0
    oracle = linprog(goal, A_ub=rows, b_ub=due, bounds=[(None, None)] * m)
    assert (found is not None) == oracle.success
    if found is not None:
        assert np.all(rows @ found <= due + 1e-8)
        assert abs(found[-1] + oracle.fun) < 1e-7 * BOX


def test_what_contradicts_itself_has_no_corner() -> None:
    rows, due = np.array([[1.0, 0.0], [-1.0, 0.0]]), np.array([1.0, -2.0])
    assert highest_corner(*box(rows, due)) is None
