"""The template network: the kernel says what torch says, trainings go on, files keep all."""

import argparse
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch
from safetensors.numpy import load_file, save_file

from relguide.kernels.base.records import Pose, straight_scene
from relguide.kernels.networks.template_features import FEATURES
from relguide.kernels.networks.template_scores import OUTPUTS, guess_of, template_shares
from relguide.kernels.networks.templates import SIZE
from relguide.kernels.words.extremals import MAX_ROWS, solve
from relguide.learn.boundary import train_templates as training
from relguide.learn.boundary.template_label_file import save_template_labels
from relguide.learn.boundary.template_labels import TemplateBox
from relguide.learn.boundary.template_network import (
    load_template_network,
    save_template_network,
    template_features_of,
)
from relguide.learn.boundary.train_templates import train_templates
from relguide.learn.training.options import NetworkShape, add_options
from relguide.learn.words.branch_network import layers_of, torch_model
from tests.relguide.learn.boundary.template_networks import OPTIONS, REQUEST, labels, ways

QUICK = replace(OPTIONS, epochs=3, shape=NetworkShape(width=12, depth=2))


@pytest.mark.parametrize("shape", [NetworkShape(width=8, depth=1), NetworkShape()])
def test_the_kernel_says_what_torch_says(shape: NetworkShape) -> None:
    torch.manual_seed(0)
    model = torch_model(shape, features=FEATURES, outputs=OUTPUTS)
    situations = labels().situations[:300]
    told = template_features_of(situations)
    assert np.isfinite(told).all()
    mean, deviation = told.mean(axis=0), told.std(axis=0) + np.float32(1e-6)
    with torch.no_grad():
        out = model(torch.from_numpy((told - mean) / deviation)).numpy()
    state = {name: value.numpy() for name, value in model.state_dict().items()}
    layers = layers_of(state, mean, deviation)
    rows, share, guess = np.empty((MAX_ROWS, 5)), np.empty(SIZE), np.empty(2)
    expected = torch.from_numpy(out[:, :SIZE]).softmax(dim=1).numpy()
    for n, (x, y, h, alpha, slot, limit) in enumerate(situations.tolist()):
        pose = Pose(x, y, h)
        solve(pose, alpha, 0.0, rows)
        hidden = template_shares(pose, straight_scene(alpha, slot, limit), rows[0], layers, share)
        assert np.abs(share - expected[n]).max() < 1e-5
        for template in (0, 3, SIZE - 1):
            guess_of(hidden, layers, template, guess)
            at = SIZE + 2 * template
            assert np.abs(guess - out[n, at : at + 2]).max() < 1e-5


def test_the_trained_network_has_learnt() -> None:
    assert ways().about["validation_accuracy"] > 0.5
    assert ways().shape == OPTIONS.shape


def test_a_training_that_was_stopped_goes_on_to_the_same_end(tmp_path: Path) -> None:
    part, options = tmp_path / "part", QUICK
    whole = list(train_templates(labels(), options, box=TemplateBox(), about={}))
    run = train_templates(labels(), options, box=TemplateBox(), about={}, checkpoint=part)
    next(run)
    run.close()
    rest = list(
        train_templates(
            labels(), options, box=TemplateBox(), about={}, checkpoint=part, resume=True
        )
    )
    assert [epoch.number for epoch in rest] == [2, 3]
    for name, array in whole[-1].network.layers._asdict().items():
        assert np.array_equal(array, getattr(rest[-1].network.layers, name))
    other = replace(options, seed=8)
    with pytest.raises(ValueError, match="other labels or options"):
        list(
            train_templates(
                labels(), other, box=TemplateBox(), about={}, checkpoint=part, resume=True
            )
        )
    with pytest.raises(ValueError, match="nothing to resume"):
        list(train_templates(labels(), options, box=TemplateBox(), about={}, resume=True))


def test_too_few_labels_are_refused() -> None:
    few = {name: getattr(labels(), name)[:1] for name in ("situations", "times", "counts")}
    one = replace(labels(), **few, legs=labels().legs[:1], sources=labels().sources[:1])
    with pytest.raises(ValueError, match="too few"):
        next(train_templates(one, QUICK, box=TemplateBox(), about={}))


def test_a_file_keeps_all_and_others_are_refused(tmp_path: Path) -> None:
    file = tmp_path / "w.safetensors"
    save_template_network(ways(), file)
    read = load_template_network(file)
    assert (read.box, read.least_share, read.doubt) == (
        ways().box,
        ways().least_share,
        ways().doubt,
    )
    assert all(np.array_equal(a, b) for a, b in zip(read.layers, ways().layers, strict=True))
    about = {"file": "relguide way network 1", "templates": ["free"]}
    save_file(load_file(file), file, metadata={"about": json.dumps(about)})
    for damaged in (file.read_bytes(), file.read_bytes()[:500], b""):
        file.write_bytes(damaged)
        with pytest.raises(
            ValueError, match="holds no network of relguide train --method templates"
        ):
            load_template_network(file)


def test_the_script_trains_from_a_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    save_template_labels(labels(), REQUEST, {"command": "it"}, Path("limit.npz"))
    parser = argparse.ArgumentParser()
    add_options(parser)
    chosen = parser.parse_args(
        ["limit.npz", "w.safetensors", "--epochs", "2", "--width", "8", "--threads", "1"]
    )
    epochs = list(training.run(chosen, "a test"))
    about = load_template_network(Path("w.safetensors")).about
    assert about["command"] == (
        "relguide train limit.npz w.safetensors --width 8 --epochs 2 --threads 1 --method templates"
    )
    assert about["dataset"]["seed"] == REQUEST.seed
    assert about["validation_accuracy"] == max(epoch.accuracy for epoch in epochs)
    assert sorted(path.name for path in Path().iterdir()) == ["limit.npz", "w.safetensors"]
