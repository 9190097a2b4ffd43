"""train_templates(labels, …) → TemplateNetwork: from labels where the limit binds to weights.

    python -m relguide.learn.boundary.train_templates labels.npz weights.safetensors

The loss has two parts: cross-entropy of the template, and how far its own guess is off. The same
labels, options and number of threads give the same weights on the same CPU.
"""

import argparse
from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from relguide.kernels.networks.templates import NONE, SEVERAL
from relguide.learn.boundary.template_label_file import load_template_labels
from relguide.learn.boundary.template_labels import (
    ConstrainedPaths,
    TemplateLabels,
    pick_paths,
)
from relguide.learn.boundary.template_network import (
    STRAIGHT,
    Box,
    TemplateKind,
    TemplateNetwork,
    save_template_network,
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
EVENED = np.arange(1.0, 6.0, 0.05)
"""By one of these logarithms of shares are divided where they are evened out."""


def train_templates(
    labels: TemplateLabels,
    options: TrainingOptions,
    *,
    box: Box,
    about: Mapping[str, Any],
    kind: TemplateKind[Any] = STRAIGHT,
    checkpoint: Path | None = None,
    resume: bool = False,
) -> Iterator[Epoch[TemplateNetwork[Box]]]:
    """Train a network; yields after every epoch, the last is the end.

    Args:
        labels: exact answers.
        options: how.
        box: of the labels.
        about: what is to be said of the weights' origin.
        kind: what the labels are about.
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
    paths += [kind.advance(pick_paths(labels.paths, rows[kept:]), rng) for _ in range(LATER)]
    targets = [kind.targets_of(part, WITHIN) for part in paths]
    templates, guesses = (np.concatenate(column) for column in zip(*targets, strict=True))
    situations = np.concatenate([part.situations for part in paths])
    inputs, mean, deviation = scale(kind.features_of(situations), kept)
    given = torch.from_numpy(inputs).to(device)
    right = torch.from_numpy(templates).to(device)
    guess = torch.from_numpy(guesses.astype(np.float32)).to(device)
    guessed = (guess != 0.0).any(dim=1).float()
    there = (templates[:kept] != NONE) & (templates[:kept] != SEVERAL)

    model = torch_model(options.shape, features=kind.features, outputs=kind.outputs).to(device)

    def loss(chosen: "torch.Tensor") -> "torch.Tensor":
        """What the template is off, and its guess, of some rows."""
        score, told = model(given[chosen]).split((kind.size, kind.guess * kind.size), dim=1)
        own = told.view(-1, kind.size, kind.guess)[torch.arange(len(chosen)), right[chosen]]
        off = functional.smooth_l1_loss(own, guess[chosen], reduction="none", beta=BEND)
        summed: torch.Tensor = GUESSED * (
            off.sum(dim=1) * guessed[chosen]
        ).mean() + functional.cross_entropy(score, right[chosen])
        return summed

    def shares() -> np.ndarray:
        """Of the templates, in the rows kept."""
        return shares_of(model, given[:kept], kind.size)

    def accuracy() -> float:
        """How often the right template has the highest share, where a template is right."""
        first = shares().argmax(axis=1)
        return float((first == templates[:kept])[there].mean()) if there.any() else 0.0

    def network(origin: Mapping[str, Any]) -> TemplateNetwork[Box]:
        """What the weights become, with its set calibrated."""
        rules, told = kind.rules, shares()
        layers = layers_of(arrays_of(model), mean, deviation)
        if rules.evened > 0.0:
            told, by = even_out(told, templates[:kept], rules.evened)
            last, last_bias = layers.last.copy(), layers.last_bias.copy()
            last[:, : kind.size] /= by
            last_bias[: kind.size] /= by
            layers = layers._replace(last=last, last_bias=last_bias)
        right = told[np.arange(kept), templates[:kept]][there]
        least = covering_share(right, rules.coverage) if there.any() else 0.0
        return TemplateNetwork(
            layers=layers,
            kind=kind,
            box=box,
            least_share=min(rules.least_share, least),
            most=rules.most,
            doubt=rules.doubt,
            about={**about, **origin, "labels": len(labels)},
        )

    yield from fit(
        model, options, rows=Split(np.arange(len(templates)), kept), loss=loss, accuracy=accuracy,
        network=network, decay=DECAY,
        digest=digest_of(options, labels.situations, labels.times, labels.legs),
        checkpoint=checkpoint, resume=resume,
    )  # fmt: skip


def even_out(shares: np.ndarray, right: np.ndarray, beyond: float) -> tuple[np.ndarray, np.float32]:
    """Shares that are less sure, and by what their logarithms are divided.

    Args:
        shares: of the templates, in some rows. shape (n, templates)
        right: the template of each. shape (n,)
        beyond: with 1 they become as sure as they are right; as in `Rules`.
    """
    scores, rows = np.log(np.maximum(shares, 1e-30)), np.arange(len(right))

    def evened(divisor: float) -> np.ndarray:
        less_sure: np.ndarray = np.exp(scores / divisor)
        less_sure /= less_sure.sum(axis=1, keepdims=True)
        return less_sure

    missed = [-np.log(evened(divisor)[rows, right]).mean() for divisor in EVENED]
    by = beyond * float(EVENED[int(np.argmin(missed))])
    return evened(by), np.float32(by)


def targets_of(paths: ConstrainedPaths) -> tuple[np.ndarray, np.ndarray]:
    """What is to be learnt behind leaders who keep straight: templates, and guesses."""
    return STRAIGHT.targets_of(paths, WITHIN)


def run(
    chosen: argparse.Namespace, program: str, kind: TemplateKind[Any] = STRAIGHT
) -> Iterator[Epoch[TemplateNetwork[Any]]]:
    """Do the training that was asked for; the weights are written at each better epoch.

    Args:
        chosen: the options of `options.add_options`.
        program: what trains, for the weights' provenance.
        kind: what the labels are about.
    """
    return run_training(
        chosen,
        program,
        load=partial(load_template_labels, kind=kind.method),
        box=kind.box,
        train=partial(train_templates, kind=kind),
        save=save_template_network,
        method=f" --method {kind.method}",
    )


if __name__ == "__main__":
    script("relguide.learn.boundary.train_templates", run)
