"""The loop of the trainings: what it keeps to judge by, and what it hands out stays as it was."""

from dataclasses import replace
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

from relguide.learn.training.fitting import covering_share, scale, split
from relguide.learn.training.options import TrainingOptions
from relguide.learn.words.branch_labels import Box
from relguide.learn.words.branch_network import BranchNetwork
from relguide.learn.words.train_branches import train
from tests.relguide.learn.words.networks import OPTIONS, labels


def weights_of(network: BranchNetwork) -> bytes:
    return b"".join(array.tobytes() for array in network.layers)


def test_a_share_is_kept_and_the_rest_is_scaled() -> None:
    options = TrainingOptions(validation=0.25)
    numbers = np.arange(100, 140)
    rows, kept = parted = split(numbers, options, of="rows")
    assert (kept, parted.learnt) == (10, 30)
    assert sorted(rows.tolist()) == numbers.tolist()
    assert rows.tolist() != numbers.tolist()
    assert np.array_equal(rows, split(numbers, options, of="rows").rows)
    assert not np.array_equal(rows, split(numbers, replace(options, seed=1), of="rows").rows)
    columns = np.stack([rows, np.full(40, 3.0)], axis=1).astype(np.float32)
    values, mean, deviation = scale(columns, kept)
    assert np.abs(values[kept:].mean(axis=0)).max() < 1e-5
    assert abs(values[kept:, 0].std() - 1.0) < 1e-5
    assert np.isfinite(values).all()  # a column that is always the same has no deviation
    assert np.allclose(values * deviation + mean, columns, atol=1e-4)


def test_a_set_is_calibrated_to_hold_what_is_right_as_often_as_asked() -> None:
    shares = np.random.default_rng(3).random(9999)
    for coverage in (0.9, 0.99, 0.999):
        least = covering_share(shares, coverage)
        assert np.mean(shares >= least) == pytest.approx(coverage, abs=2e-4)
        assert np.mean(shares >= least) >= coverage
    assert covering_share(shares, 1.0) == shares.min()


def test_too_few_rows_are_refused() -> None:
    with pytest.raises(ValueError, match=r"^1 states are too few to train and to validate with\.$"):
        split(np.arange(1), OPTIONS, of="states")


def test_what_was_handed_out_stays_as_it_was() -> None:
    """The training goes on with weights of its own, and tells of the best it has had."""
    options = replace(OPTIONS, epochs=6)
    handed = [
        (epoch, weights_of(epoch.network))
        for epoch in train(labels(), options, box=Box(), about={})
    ]
    assert any(epoch.best < epoch.number for epoch, _ in handed)
    for epoch, then in handed:
        assert weights_of(epoch.network) == then == handed[epoch.best - 1][1]
        assert epoch.network.about["epochs"] == epoch.best
        assert epoch.network.about["validation_accuracy"] == handed[epoch.best - 1][0].accuracy


def test_it_goes_on_from_an_epoch_that_was_not_better(tmp_path: Path) -> None:
    """Such a training begins its next epoch at its last weights, and so it must when resumed."""
    options, part = replace(OPTIONS, epochs=6), tmp_path / "part"
    whole = list(train(labels(), options, box=Box(), about={}))
    worse = next(epoch.number for epoch in whole[:-1] if epoch.best < epoch.number)
    list(islice(train(labels(), options, box=Box(), about={}, checkpoint=part), worse))
    rest = list(train(labels(), options, box=Box(), about={}, checkpoint=part, resume=True))
    assert [epoch.loss for epoch in rest] == [epoch.loss for epoch in whole[worse:]]
    assert [epoch.accuracy for epoch in rest] == [epoch.accuracy for epoch in whole[worse:]]


def test_what_was_given_up_is_not_gone_on_with(tmp_path: Path) -> None:
    hopeless, part = replace(OPTIONS, epochs=9, learning_rate=1e-30, patience=2), tmp_path / "part"
    found = list(train(labels(), hopeless, box=Box(), about={}, checkpoint=part))
    assert (found[-1].number, found[-1].best) == (3, 1)
    assert not list(train(labels(), hopeless, box=Box(), about={}, checkpoint=part, resume=True))
