"""Very many questions at once: the same answers as the kernel's, one by one."""

from math import nan, pi

import numpy as np
import pytest
import torch

from relguide.kernels.base.records import Pose
from relguide.kernels.networks.branch_scores import evaluate, shares
from relguide.kernels.words.branches import MIRROR_OF, SIZE
from relguide.learn.words import inference
from relguide.learn.words.inference import branch_shares
from tests.relguide.learn.words.networks import network


def draw(count: int) -> np.ndarray:
    rng = np.random.default_rng(4)
    return np.column_stack(
        (
            rng.uniform(-20.0, 20.0, count),
            rng.uniform(-20.0, 20.0, count),
            rng.uniform(0.0, 2.0 * pi, count),
            rng.uniform(0.3, 0.97, count),
        )
    )


def test_torch_says_what_the_kernel_says(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(inference, "CHUNK", 128)
    situations = draw(1000)
    situations[:4, 1] = 0.0
    scores, one = np.empty((3, SIZE)), np.empty(SIZE)
    counted: list[int] = []
    found = branch_shares(network(), situations, device="cpu", progress=counted.append)
    for situation, row in zip(situations, found, strict=True):
        evaluate(Pose(*situation[:3]), situation[3], network().layers, scores)
        shares(scores, one)
        assert np.abs(row - one).max() < 1e-5
    assert sum(counted) == 1000
    assert max(counted) == 128


def test_mirror_images_get_mirrored_shares() -> None:
    situations = draw(300)
    found = branch_shares(network(), situations)
    mirrored = branch_shares(network(), situations * (1.0, -1.0, -1.0, 1.0))
    assert np.abs(found - mirrored[:, MIRROR_OF]).max() < 1e-5


def test_torch_keeps_its_threads() -> None:
    before = torch.get_num_threads()
    branch_shares(network(), draw(3), threads=before + 1)
    assert torch.get_num_threads() == before


def test_nothing_asked_is_nothing_said() -> None:
    assert branch_shares(network(), np.empty((0, 4))).shape == (0, SIZE)


@pytest.mark.parametrize(
    ("situations", "device"),
    [
        (np.zeros(4), "cpu"),
        (np.zeros((2, 3)), "cpu"),
        (np.array([[1.0, 2.0, nan, 0.5]]), "cpu"),
        pytest.param(
            np.zeros((1, 4)),
            "cuda",
            marks=pytest.mark.skipif(torch.cuda.is_available(), reason="there is a CUDA device"),
        ),
    ],
)
def test_what_cannot_be_answered_is_refused(situations: np.ndarray, device: str) -> None:
    with pytest.raises(ValueError, match=r"must have four finite columns|no CUDA device"):
        branch_shares(network(), situations, device=device)
