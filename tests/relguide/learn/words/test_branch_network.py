"""The network: the kernel says what torch says, mirrors are exact, files come back."""

from dataclasses import replace
from math import inf, pi
from pathlib import Path

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st

from relguide.kernels.base.records import Pose
from relguide.kernels.networks.branch_scores import Layers, choose, evaluate, judge_branches
from relguide.kernels.words.branches import MIRROR_OF, SIZE, branch_of
from relguide.kernels.words.extremals import MAX_ROWS
from relguide.learn.words.branch_network import (
    BranchNetwork,
    NetworkShape,
    features_of,
    layers_of,
    load_network,
    save_network,
    torch_model,
)
from tests.relguide.learn.words.networks import labels, network


def scores_of(found: BranchNetwork, situations: np.ndarray) -> np.ndarray:
    scores, decoded = np.empty((len(situations), 3, SIZE)), np.empty((len(situations), 3))
    judge_branches(situations, found.layers, found.least_share, found.most, scores, decoded)
    return scores


@pytest.mark.parametrize("shape", [NetworkShape(width=8, depth=1), NetworkShape()])
def test_the_kernel_says_what_torch_says(shape: NetworkShape) -> None:
    torch.manual_seed(0)
    model = torch_model(shape)
    situations = labels().situations[:2000]
    told = features_of(situations)
    mean, deviation = told.mean(axis=0), told.std(axis=0)
    with torch.no_grad():
        out = model(torch.from_numpy((told - mean) / deviation)).numpy()
    state = {name: value.numpy() for name, value in model.state_dict().items()}
    layers = layers_of(state, mean, deviation)
    by_kernel = scores_of(replace(network(), layers=layers), situations)
    assert np.abs(by_kernel.reshape(out.shape) - out).max() < 1e-5


def test_the_trained_network_has_learnt() -> None:
    assert network().about["validation_accuracy"] > 0.8
    assert 0.0 < network().least_share < 0.2


def test_situations_judged_together_are_judged_as_one_by_one() -> None:
    found, situations = network(), labels().situations[:200]
    scores, decoded = np.empty((200, 3, SIZE)), np.empty((200, 3))
    judge_branches(situations, found.layers, found.least_share, 4, scores, decoded)
    rows = np.empty((MAX_ROWS, 5))
    for situation, told in zip(situations, decoded, strict=True):
        x, y, h, alpha = situation
        held, n = choose(x, y, h, alpha, found.layers, found.least_share, 4, rows)
        assert told.tolist() == [held, *((rows[0, 0], branch_of(rows[0])) if n else (inf, -1))]
    assert len(set(decoded[:, 0])) > 2


def test_the_weights_that_come_along_know_existence_and_time_too() -> None:
    found = load_network()
    scores = scores_of(found, labels().situations)
    exists = np.isfinite(labels().times)
    assert np.mean((scores[:, 1] > 0.0) == exists) > 0.95
    error = np.abs(np.expm1(scores[:, 2]) / np.where(exists, labels().times, 1.0) - 1.0)
    assert np.median(error[exists]) < 0.2
    assert found.about["dataset"]["command"].startswith("relguide dataset --method exact ")
    assert found.shape == NetworkShape()


@given(
    st.floats(-40.0, 40.0),
    st.floats(0.0, 20.0),
    st.floats(pi, 2.0 * pi, exclude_min=True, exclude_max=True),
    st.floats(0.3, 0.97),
)
def test_mirror_images_get_mirrored_answers(x: float, y: float, h: float, alpha: float) -> None:
    # 2π − h is exact for h ≥ π, so the two situations are mirror images to the last bit
    here, there = np.empty((3, SIZE)), np.empty((3, SIZE))
    evaluate(Pose(x, y, h), alpha, network().layers, here)
    evaluate(Pose(x, -y, 2.0 * pi - h), alpha, network().layers, there)
    assert np.isfinite(here).all()
    assert np.array_equal(here, there[:, MIRROR_OF])


def test_on_the_route_both_sides_are_one() -> None:
    for h in (0.0, pi):
        scores = np.empty((3, SIZE))
        evaluate(Pose(-3.0, 0.0, h), 0.8, network().layers, scores)
        assert np.isfinite(scores).all()


def test_the_slot_itself_is_no_trap() -> None:
    scores = np.empty((3, SIZE))
    evaluate(Pose(0.0, 0.0, 0.0), 0.8, network().layers, scores)
    assert np.isfinite(scores).all()


def test_a_file_comes_back_whole(tmp_path: Path) -> None:
    file = tmp_path / "weights.safetensors"
    save_network(network(), file)
    read = load_network(file)
    assert all(np.array_equal(a, b) for a, b in zip(read.layers, network().layers, strict=True))
    assert (read.box, read.least_share, read.most) == (
        network().box, network().least_share, network().most,
    )  # fmt: skip
    assert read.about["options"]["epochs"] == 10
    assert read.about["dataset"] == {"seed": 5}
    assert read.shape == NetworkShape(width=24, depth=2)
    assert [path.name for path in tmp_path.iterdir()] == [file.name]


def test_what_is_no_network_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "weights.safetensors"
    with pytest.raises(FileNotFoundError):
        load_network(file)
    save_network(network(), file)
    whole = file.read_bytes()
    for content in (b"", b"[]", whole[:-8], whole.replace(b"branch network", b"another network")):
        file.write_bytes(content)
        with pytest.raises(ValueError, match="holds no network of relguide train"):
            load_network(file)
    bad = network().layers._replace(first_bias=np.full(24, np.nan, np.float32))
    save_network(replace(network(), layers=Layers(*bad)), file)
    with pytest.raises(ValueError, match="holds no network of relguide train"):
        load_network(file)


def test_a_shape_that_is_none_is_refused() -> None:
    with pytest.raises(ValueError, match="4 … 4096 numbers a layer"):
        NetworkShape(width=2)
