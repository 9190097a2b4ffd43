"""train_templates(labels, …) → TemplateNetwork: from labels where the limit binds to weights.

    python -m relguide.learn.boundary.train_templates labels.npz weights.safetensors

The loss has two parts: cross-entropy of the template, and how far its own guess is off. The same
labels, options and number of threads give the same weights on the same CPU.
"""

import argparse
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from relguide.kernels.networks.template_features import FEATURES
from relguide.kernels.networks.template_scores import OUTPUTS
from relguide.kernels.networks.template_solutions import label_templates
from relguide.kernels.networks.templates import NONE, SEVERAL, SIZE
from relguide.learn.boundary.template_label_file import load_template_labels
from relguide.learn.boundary.template_labels import (
    ConstrainedPaths,
    TemplateBox,
    TemplateLabels,
    advance_paths,
    pick_paths,
)
from relguide.learn.boundary.template_network import (
    TemplateNetwork,
    save_template_network,
    template_features_of,
)
from relguide.learn.training.fitting import (
    Epoch,
    Split,
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
from relguide.learn.words.branch_network import layers_of, torch_model

if TYPE_CHECKING:
    import torch

WITHIN = 1e-3
"""A template whose path is so much later is not the answer's [R/V_P]: 40 ms for an airliner."""
GUESSED = 2.0
"""Weight of the guesses; that of the cross-entropy is 1."""
BEND = 0.05
"""Guesses farther off than this count by how far they are, and no more by its square."""
LATER = 2
"""So often each path is learnt from once more, at some moment of its first turn."""
DECAY = 1e-3
"""Of the weights, each step, over the learning rate."""
COVERAGE = 0.999
"""How often the fastest template shall be among those solved, in labels not learnt from."""
LEAST_SHARE = 0.001
"""Templates with a smaller share are left out; with one smaller still if calibration asks so."""
MOST = 8
"""With more templates than this, all solved, the search would hardly take longer."""
DOUBT = 0.4
"""Paths of no template, no path, and templates without a path next to their guess may together be
this likely. With 0.8 instead 0.6 % more are answered, and a third of those late."""


def train_templates(
    labels: TemplateLabels,
    options: TrainingOptions,
    *,
    box: TemplateBox,
    about: Mapping[str, Any],
    checkpoint: Path | None = None,
    resume: bool = False,
) -> Iterator[Epoch[TemplateNetwork]]:
    """Train a network; yields after every epoch, the last is the end.

    Args:
        labels: exact answers.
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
    rows, kept = split(np.arange(len(labels)), options, of="labels")
    paths = [pick_paths(labels.paths, rows)]
    rng = np.random.default_rng(options.seed)
    paths += [advance_paths(pick_paths(labels.paths, rows[kept:]), rng) for _ in range(LATER)]
    templates, guesses = (
        np.concatenate(column) for column in zip(*map(targets_of, paths), strict=True)
    )
    situations = np.concatenate([part.situations for part in paths])
    inputs, mean, deviation = scale(template_features_of(situations), kept)
    given = torch.from_numpy(inputs).to(device)
    right = torch.from_numpy(templates).to(device)
    guess = torch.from_numpy(guesses.astype(np.float32)).to(device)
    guessed = (guess != 0.0).any(dim=1).float()
    there = (templates[:kept] != NONE) & (templates[:kept] != SEVERAL)

    model = torch_model(options.shape, features=FEATURES, outputs=OUTPUTS).to(device)

    def loss(chosen: "torch.Tensor") -> "torch.Tensor":
        """What the template is off, and its guess, of some rows."""
        score, pairs = model(given[chosen]).split((SIZE, 2 * SIZE), dim=1)
        own = pairs.view(-1, SIZE, 2)[torch.arange(len(chosen)), right[chosen]]
        off = functional.smooth_l1_loss(own, guess[chosen], reduction="none", beta=BEND)
        summed: torch.Tensor = GUESSED * (
            off.sum(dim=1) * guessed[chosen]
        ).mean() + functional.cross_entropy(score, right[chosen])
        return summed

    def shares() -> np.ndarray:
        """Of the templates, in the rows kept."""
        return shares_of(model, given[:kept], SIZE)

    def accuracy() -> float:
        """How often the right template has the highest share, where a template is right."""
        first = shares().argmax(axis=1)
        return float((first == templates[:kept])[there].mean()) if there.any() else 0.0

    def network(origin: Mapping[str, Any]) -> TemplateNetwork:
        """What the weights become, with its set calibrated."""
        right = shares()[np.arange(kept), templates[:kept]][there]
        return TemplateNetwork(
            layers=layers_of(arrays_of(model), mean, deviation),
            box=box,
            least_share=min(LEAST_SHARE, covering_share(right, COVERAGE)) if there.any() else 0.0,
            most=MOST,
            doubt=DOUBT,
            about={**about, **origin, "labels": len(labels)},
        )

    yield from fit(
        model, options, rows=Split(np.arange(len(templates)), kept), loss=loss, accuracy=accuracy,
        network=network, decay=DECAY,
        digest=digest_of(options, labels.situations, labels.times, labels.legs),
        checkpoint=checkpoint, resume=resume,
    )  # fmt: skip


def targets_of(paths: ConstrainedPaths) -> tuple[np.ndarray, np.ndarray]:
    """What is to be learnt: templates, shape (n,), and guesses, shape (n, 2)."""
    n = len(paths.times)
    templates, guesses = np.empty(n), np.empty((n, 2))
    label_templates(
        paths.situations,
        paths.times,
        paths.counts.astype(float),
        paths.legs,
        WITHIN,
        templates,
        guesses,
    )
    return templates.astype(np.int64), guesses


def run(chosen: argparse.Namespace, program: str) -> Iterator[Epoch[TemplateNetwork]]:
    """Do the training that was asked for; the weights are written at each better epoch.

    Args:
        chosen: the options of `options.add_options`.
        program: what trains, for the weights' provenance.
    """
    return run_training(
        chosen,
        program,
        load=load_template_labels,
        box=TemplateBox,
        train=train_templates,
        save=save_template_network,
        method=" --method templates",
    )


if __name__ == "__main__":
    script("relguide.learn.boundary.train_templates", run)
