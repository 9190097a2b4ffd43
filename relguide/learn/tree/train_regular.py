"""train_regular(tree, …) → RegularNetwork: the paper's network, trained on its tree.

The same tree, options and number of threads give the same weights on the same CPU.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.records import Pose
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, solve
from relguide.learn.training.fitting import Scaled, arrays_of, begin, origin_of, scale, split
from relguide.learn.training.options import TrainingOptions
from relguide.learn.tree.regular_network import INPUTS, Method, RegularNetwork, Singles, inputs_of
from relguide.learn.tree.tree import Floats, RegularTree, TreeParameters, pairs_of

if TYPE_CHECKING:
    import torch


@dataclass(frozen=True, slots=True, kw_only=True)
class RegularEpoch:
    """How the training stands after an epoch."""

    number: int
    """From 1 on."""
    loss: float
    """Mean square of what is missed, each number in its deviation, in states not trained on."""
    network: RegularNetwork


def train_regular(
    tree: RegularTree, options: TrainingOptions, *, method: Method, about: Mapping[str, Any]
) -> Iterator[RegularEpoch]:
    """Train on the states of a tree; yields after every epoch, the last is the end.

    Args:
        tree: gives the states, one a cell.
        options: how; it ends with its last epoch, whatever the patience.
        method: what is learnt.
        about: what shall be numbers of the weights' origin.
    """
    import torch

    device = begin(options)

    # What is learnt from, and what is kept to judge by.
    nodes, kept = split(tree.minima, options, of="states of the tree")
    radius = tree.parameters.encounter.turn_radius
    place = tree.x[nodes] / radius, tree.y[nodes] / radius, tree.heading[nodes]
    inputs = inputs_of(*place)
    if method == "paper":
        pairs = pairs_of(tree, nodes)
        pairs[:, :, 2] /= radius
    else:
        pairs = exact_pairs(*place, tree.parameters)
    targets = pairs.reshape(len(nodes), -1).astype(np.float32)
    from_inputs, from_targets = scale(inputs, kept), scale(targets, kept)
    numbers, wanted = (
        torch.from_numpy(part.values).to(device) for part in (from_inputs, from_targets)
    )

    model = _model(options, targets.shape[1]).to(device)
    optimiser = torch.optim.AdamW(model.parameters(), lr=options.learning_rate, weight_decay=1e-4)
    batches = -(-(len(nodes) - kept) // options.batch)
    pace = torch.optim.lr_scheduler.OneCycleLR(
        optimiser, options.learning_rate, total_steps=options.epochs * batches, pct_start=0.03
    )
    for epoch in range(options.epochs):
        order = torch.randperm(len(nodes) - kept).to(device) + kept
        for chosen in torch.split(order, options.batch):
            loss = (model(numbers[chosen]) - wanted[chosen]).square().mean()
            optimiser.zero_grad(set_to_none=True)
            loss.backward()
            optimiser.step()
            pace.step()
        with torch.no_grad():
            missed = float((model(numbers[:kept]) - wanted[:kept]).square().mean())
        weights, biases = _layers(arrays_of(model), from_inputs, from_targets)
        yield RegularEpoch(
            number=epoch + 1,
            loss=missed,
            network=RegularNetwork(
                method=method,
                parameters=tree.parameters,
                weights=weights,
                biases=biases,
                about={
                    **about,
                    **origin_of(options),
                    "trained_on": len(nodes) - kept,
                    "validation_loss": missed,
                },
            ),
        )


def exact_pairs(x: Floats, y: Floats, h: Floats, parameters: TreeParameters) -> Floats:
    """The fastest paths without the limit in the form of `regress_pairs`, C S C as (C, S) and C."""
    alpha = parameters.encounter.speed_ratio
    pairs, rows = np.zeros((len(x), parameters.order - 1, 3)), np.empty((MAX_ROWS, 5))
    for i, (ahead, left, heading) in enumerate(
        zip(x.tolist(), y.tolist(), h.tolist(), strict=True)
    ):
        solve(Pose(ahead, left, wrap(heading)), alpha, 0.0, rows)
        at = 0
        signs = SIGNS[int(rows[0, 1])]
        for sign, amount in zip(signs, rows[0, 2:], strict=True):
            if sign == 0.0:
                pairs[i, at - 1, 2] = amount
            elif at < len(pairs[i]):
                pairs[i, at, :2] = sign, amount
                at += 1
    return pairs


def _model(options: TrainingOptions, outputs: int) -> "torch.nn.Sequential":
    from torch import nn

    layers: list[nn.Module] = [nn.Linear(INPUTS, options.shape.width), nn.Tanh()]
    for _ in range(options.shape.depth - 1):
        layers += [nn.Linear(options.shape.width, options.shape.width), nn.Tanh()]
    return nn.Sequential(*layers, nn.Linear(options.shape.width, outputs))


def _layers(
    state: Mapping[str, Singles], given: Scaled, asked: Scaled
) -> tuple[tuple[Singles, ...], tuple[Singles, ...]]:
    """Weights with the scales of inputs and outputs worked in."""
    weights = [value.T.astype(float) for name, value in state.items() if name.endswith("weight")]
    biases = [value.astype(float) for name, value in state.items() if name.endswith("bias")]
    weights[0] = weights[0] / given.deviation[:, None]
    biases[0] = biases[0] - given.mean @ weights[0]
    weights[-1] = weights[-1] * asked.deviation
    biases[-1] = biases[-1] * asked.deviation + asked.mean
    single = np.float32
    return tuple(np.ascontiguousarray(w, single) for w in weights), tuple(
        b.astype(single) for b in biases
    )
