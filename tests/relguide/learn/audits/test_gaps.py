"""What explains a gap: how near the fastest branch is born, or is no longer the fastest."""

import numpy as np
import pytest

from relguide.kernels.words.branches import BRANCHES
from relguide.learn.audits.gaps import SMALL, Surfaces, surfaces
from relguide.learn.words.branch_labels import times_of

BEHIND = np.array([-5.0, 3.0, 0.0, 0.8])
"""Straight behind, well to the left: R S L, and far from every surface."""


def fastest(*situations: np.ndarray) -> list[str]:
    return [BRANCHES[number] for number in times_of(np.array(situations)).argmin(axis=1)]


def edge(of: str) -> tuple[np.ndarray, np.ndarray]:
    """A situation whose fastest branch ceases to exist next to it, and that one next to it."""
    rng = np.random.default_rng(1)
    while True:
        here = np.array([*rng.uniform(-3.0, 3.0, 2), rng.uniform(0.0, 6.28), 0.8])
        there = here + np.array([*rng.normal(size=3), 0.0])
        best = times_of(here[None]).argmin()
        if BRANCHES[best] != of or np.isfinite(times_of(there[None])[0, best]):
            continue
        for _ in range(30):
            middle = 0.5 * (here + there)
            alive = np.isfinite(times_of(middle[None])[0, best])
            here, there = (middle, there) if alive else (here, middle)
        if fastest(here) == [of]:
            return here, there


def test_far_from_every_surface_nothing_is_near() -> None:
    assert fastest(BEHIND) == ["RSL"]
    found = surfaces(BEHIND[None])
    assert found.switch[0] > 0.1
    assert not found.near[0]


@pytest.mark.parametrize("branch", ["LRL long", "RLR long"])
def test_where_a_branch_begins_to_exist_it_is_found(branch: str) -> None:
    here, there = edge(branch)
    found = surfaces(here[None])
    assert found.birth[0] <= 1e-5
    assert found.switch[0] <= found.birth[0]
    assert found.near[0]
    assert fastest(there) != [branch]


def test_distances_are_those_of_the_way_there() -> None:
    """Moved away from a birth by a distance, it is no farther than that, and not much nearer."""
    here, there = edge("LRL long")
    away = (here - there) / np.linalg.norm(here - there)
    for step in (1e-3, 1e-2):
        moved = here + step * away
        if fastest(moved) == ["LRL long"]:
            found = surfaces(moved[None])
            assert 0.01 * step < found.birth[0] <= 1.1 * step


def test_a_switch_is_where_two_strategies_are_as_fast() -> None:
    # on the leader's route, on the opposite course, left and right are alike
    found = surfaces(np.array([[4.0, 1e-3, np.pi, 0.8]]))
    assert found.switch[0] == pytest.approx(1e-3, rel=0.5)
    assert found.near[0]


def test_what_is_near_is_said() -> None:
    found = Surfaces(birth=np.array([np.inf, 0.3]), switch=np.array([0.5 * SMALL, 0.1]))
    assert found.near.tolist() == [True, False]
