"""train(labels, …) → BranchNetwork: from labels to weights, one script from top to bottom.

    python -m relguide.learn.words.train_branches labels.npz weights.safetensors

The loss has four parts: cross-entropy toward softmax(−(τ_s − τ*)/TEMPERATURE), so that near a
switching surface both answers are right; regret, the time lost on average if a branch were drawn
by its share, where one that does not exist loses all of it; existence; and the time of those that
exist. The same labels, options and number of threads give the same weights on the same CPU.
"""

import argparse
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from relguide.kernels.words.branches import SIZE
from relguide.learn.training.fitting import (
    Epoch,
    arrays_of,
    begin,
    covering_share,
    digest_of,
    fit,
    run_training,
    scale,
    script,
    shares_of,
    split,
)
from relguide.learn.training.options import TrainingOptions
from relguide.learn.words.branch_labels import Box, Labels, held_out_regions, load_labels
from relguide.learn.words.branch_network import (
    BranchNetwork,
    features_of,
    layers_of,
    save_network,
    torch_model,
)

if TYPE_CHECKING:
    import torch

TEMPERATURE = 1e-4
"""Of the soft targets [R/V_P]: 5 ms for an airliner."""
REGRET, EXISTENCE, TIME = 1.0, 0.05, 0.1
"""Weights of these parts of the loss; that of the cross-entropy is 1."""
COVERAGE = 0.9999
"""How often the set shall hold the fastest branch, at the share it is calibrated to."""
MARGIN = 100.0
"""The set takes in what has a share this many times smaller: a word more is solved in 1 µs."""
NEAR = 1e-6
"""A branch this close to the fastest is as fast, relative."""
DECAY = 1e-4
"""Of the weights, each step, over the learning rate."""


def train(
    labels: Labels,
    options: TrainingOptions,
    *,
    box: Box,
    about: Mapping[str, Any],
    checkpoint: Path | None = None,
    resume: bool = False,
) -> Iterator[Epoch[BranchNetwork]]:
    """Train a network; yields after every epoch, the last is the end.

    Args:
        labels: exact answers. Those in the regions of `held_out_regions` are left out.
        options: how.
        box: of the labels.
        about: what is to be said of the weights' origin.
        checkpoint: a file written after every epoch, to go on from.
        resume: go on from it; the result is the same.
    """
    import torch
    from torch.nn import functional

    device = begin(options)

    # What is learnt from, and what is kept to stop by.
    regions = held_out_regions(labels.situations)
    outside = np.flatnonzero(~np.logical_or.reduce(list(regions.values())))
    rows, kept = parted = split(outside, options, of="labels outside the regions held out")
    inputs, mean, deviation = scale(features_of(labels.situations[rows]), kept)
    given = torch.from_numpy(inputs).to(device)
    times = labels.times[rows]
    targets = {
        name: torch.from_numpy(value.astype(np.float32)).to(device)
        for name, value in _targets(times).items()
    }
    fastest = times[:kept] <= times[:kept].min(axis=1, keepdims=True) * (1.0 + NEAR)

    model = torch_model(options.shape).to(device)

    def loss(chosen: "torch.Tensor") -> "torch.Tensor":
        """What the branches chosen, existence and time are off, of some rows."""
        score, exists, time = model(given[chosen]).split(SIZE, dim=1)
        target = {name: value[chosen] for name, value in targets.items()}
        summed: torch.Tensor = (
            functional.cross_entropy(score, target["soft"])
            + REGRET * (score.softmax(dim=1) * target["regret"]).sum(dim=1).mean()
            + EXISTENCE * functional.binary_cross_entropy_with_logits(exists, target["exists"])
            + TIME
            * (functional.smooth_l1_loss(time, target["time"], reduction="none")
               * target["exists"]).mean()
        )  # fmt: skip
        return summed

    def shares() -> np.ndarray:
        """Of the branches, in the rows kept."""
        return shares_of(model, given[:kept], SIZE)

    def accuracy() -> float:
        """How often the fastest branch has the highest score."""
        return float(fastest[np.arange(kept), shares().argmax(axis=1)].mean())

    def network(origin: Mapping[str, Any]) -> BranchNetwork:
        """What the weights become, with its set calibrated."""
        return BranchNetwork(
            layers=layers_of(arrays_of(model), mean, deviation),
            box=box,
            least_share=covering_share(np.where(fastest, shares(), 0.0).max(axis=1), COVERAGE)
            / MARGIN,
            most=SIZE,
            about={**about, **origin, "labels": len(labels), "held_out": sorted(regions)},
        )

    yield from fit(
        model, options, rows=parted, loss=loss, accuracy=accuracy, network=network, decay=DECAY,
        digest=digest_of(options, labels.situations, labels.times),
        checkpoint=checkpoint, resume=resume,
    )  # fmt: skip


def _targets(times: np.ndarray) -> dict[str, np.ndarray]:
    """What each part of the loss asks for; a branch that does not exist loses all."""
    least = times.min(axis=1, keepdims=True)
    exists = np.isfinite(times)
    late = np.where(exists, times, 0.0) - least
    soft = np.where(exists, np.exp(-np.maximum(late, 0.0) / TEMPERATURE), 0.0)
    return {
        "soft": soft / soft.sum(axis=1, keepdims=True),
        "regret": np.where(exists, np.minimum(late / np.maximum(least, 1e-3), 1.0), 1.0),
        "exists": exists,
        "time": np.log1p(np.where(exists, times, 0.0)),
    }


def run(chosen: argparse.Namespace, program: str) -> Iterator[Epoch[BranchNetwork]]:
    """Do the training that was asked for; the weights are written at each better epoch.

    Args:
        chosen: the options of `add_options`.
        program: what trains, for the weights' provenance.
    """
    return run_training(chosen, program, load=load_labels, box=Box, train=train, save=save_network)


if __name__ == "__main__":
    script("relguide.learn.words.train_branches", run)
