"""Training: the same each time, stopped and resumed too; it stops early; its options are judged."""

import sys
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from relguide.learn.training.checkpoint import device_of
from relguide.learn.training.fitting import Epoch, script
from relguide.learn.training.options import TrainingOptions, command_of, options_of
from relguide.learn.words.branch_labels import Box, save_labels
from relguide.learn.words.branch_network import BranchNetwork, load_network
from relguide.learn.words.train_branches import run, train
from tests.relguide.learn.words.networks import OPTIONS, REQUEST, labels, options

SHORT = replace(OPTIONS, epochs=3)


def epochs(
    options: TrainingOptions, checkpoint: Path, *, resume: bool = False
) -> list[Epoch[BranchNetwork]]:
    return list(train(labels(), options, box=Box(), about={}, checkpoint=checkpoint, resume=resume))


def same(a: BranchNetwork, b: BranchNetwork) -> bool:
    return a.least_share == b.least_share and all(
        np.array_equal(one, other) for one, other in zip(a.layers, b.layers, strict=True)
    )


def test_a_stopped_training_is_resumed_to_the_same_weights(tmp_path: Path) -> None:
    whole = epochs(SHORT, tmp_path / "whole")
    assert [epoch.number for epoch in whole] == [1, 2, 3]
    assert whole[-1].loss < whole[0].loss
    part = tmp_path / "part"
    stopped = train(labels(), SHORT, box=Box(), about={}, checkpoint=part)
    list(islice(stopped, 2))
    rest = epochs(SHORT, part, resume=True)
    assert [epoch.number for epoch in rest] == [3]
    assert same(rest[-1].network, whole[-1].network)
    assert rest[-1].best == whole[-1].best
    with pytest.raises(ValueError, match="was begun with other labels or options"):
        epochs(replace(SHORT, seed=1), part, resume=True)
    part.write_bytes(b"{}")
    with pytest.raises(ValueError, match="is no checkpoint of relguide train"):
        epochs(SHORT, part, resume=True)
    with pytest.raises(ValueError, match="There is nothing to resume"):
        epochs(SHORT, tmp_path / "none", resume=True)


def test_it_ends_when_it_gets_no_better(tmp_path: Path) -> None:
    hopeless = replace(SHORT, epochs=50, learning_rate=1e-30, patience=2)
    found = epochs(hopeless, tmp_path / "part")
    assert (found[-1].number, found[-1].best) == (3, 1)


def test_the_script_writes_weights_with_their_origin(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    save_labels(labels(), REQUEST, {"command": "relguide dataset"}, Path("labels.npz"))
    arguments = ["labels.npz", "w.safetensors", "--width", "8", "--epochs", "2", "--threads", "1"]
    monkeypatch.setattr(sys, "argv", ["train", *arguments])
    script("relguide.learn.words.train_branches", run)
    assert "epoch 2 of 2: loss " in capsys.readouterr().err
    about = load_network(Path("w.safetensors")).about
    assert about["command"] == (
        "relguide train labels.npz w.safetensors --width 8 --epochs 2 --threads 1"
    )
    assert about["dataset"]["seed"] == REQUEST.seed
    assert about["trained_on"] < about["labels"] == REQUEST.count
    assert sorted(path.name for path in Path().iterdir()) == ["labels.npz", "w.safetensors"]
    next(run(options(*arguments), "test"))
    with pytest.raises(SystemExit, match=r"left from a run that was stopped: --resume goes on"):
        script("relguide.learn.words.train_branches", run)
    monkeypatch.setattr(sys, "argv", ["train", "labels.npz", "none/w.safetensors"])
    with pytest.raises(SystemExit, match="No such file or directory"):
        script("relguide.learn.words.train_branches", run)


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        ({"epochs": 0}, "epochs must be 1 or more"),
        ({"learning_rate": float("inf")}, "learning_rate must be above 0"),
        ({"validation": 1.0}, "validation must lie between 0 and 1"),
    ],
)
def test_options_that_cannot_be_are_refused(wrong: dict[str, Any], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        replace(OPTIONS, **wrong)


def test_the_command_is_kept_as_it_was_typed() -> None:
    typed = options("folder/labels.npz", "w.safetensors", "--learning-rate", "0.001")
    assert command_of(typed) == "relguide train labels.npz w.safetensors --learning-rate 0.001"
    assert options_of(typed).learning_rate == 0.001
    assert options_of(options("a", "b")) == TrainingOptions()


def test_too_few_labels_and_a_missing_gpu_are_said() -> None:
    few = replace(
        labels(),
        situations=labels().situations[:1],
        times=labels().times[:1],
        sources=labels().sources[:1],
    )
    with pytest.raises(ValueError, match="too few to train"):
        next(train(few, OPTIONS, box=Box(), about={}))
    if not device_of("auto").type == "cuda":
        with pytest.raises(ValueError, match="no CUDA device here: use --device cpu"):
            next(train(labels(), replace(OPTIONS, device="cuda"), box=Box(), about={}))
