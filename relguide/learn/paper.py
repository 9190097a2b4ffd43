"""The paper's network, Fig. 5: situation → (ε, θ, l) of the pairs, as numbers, by least squares.

    place and heading relative to the slot → feed-forward network → regular trajectory

As the paper writes, it is trained on the tree of reverse dynamic programming, for one encounter,
and what it gives is flown as it is: nothing holds its end in the slot. It is kept as the baseline
`paper`. The baseline `direct` is the same network on the same states, taught the exact answers in
place of the tree's: what is left of its errors is the fault of regressing parameters at all. They
jump at every switching surface, where the best network in the sense of least squares gives a mean
of two ways, which is none.

Left and right are exchanged before and after if the situation is on the right of the route.
"""

import json
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from importlib.resources import files
from math import isfinite, pi
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.extremals import MAX_ROWS, SIGNS, solve
from relguide.learn.files import whole
from relguide.learn.options import TrainingOptions
from relguide.learn.tree import (
    Floats,
    Tree,
    TreeParameters,
    pairs_of,
    parameters_as_json,
    parameters_from_json,
)

if TYPE_CHECKING:
    import torch

Method = Literal["paper", "direct"]
"""What a network is taught: the tree's ways, or the exact ones from the same states."""
Singles = NDArray[np.float32]
FILE = "relguide regular network 1"
"""What a file says it is, with the version of its arrays."""
INPUTS = 4
"""x, y [R], cos h, sin h in the slot frame."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RegularNetwork:
    """A trained network, ready to be asked about its encounter."""

    method: Method
    parameters: TreeParameters
    """Of the tree it was trained on."""
    weights: tuple[Singles, ...]
    """Of each layer, inputs along the first axis; all scales are worked in."""
    biases: tuple[Singles, ...]
    about: Mapping[str, Any]
    """Who made it, from what, with what and when."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Epoch:
    """How the training stands after an epoch."""

    number: int
    """From 1 on."""
    loss: float
    """Mean square of what is missed, each number in its deviation, in states not trained on."""
    network: RegularNetwork


def shipped(method: Method) -> Path:
    """The weights that come with the program."""
    return Path(str(files("relguide.learn") / f"{method}.safetensors"))


def pairs_given(network: RegularNetwork, x: Floats, y: Floats, h: Floats) -> Floats:
    """What a network gives for many states: (ε, θ [rad], l [R]) of each pair, forward.

    Args:
        network: whose encounter it is.
        x: ahead of the slot [R]. shape (n,)
        y: left of the route [R].
        h: heading, counter-clockwise from the leader's [rad].

    Returns:
        ε = ±1, or 0 where neither turn nor straight is left. shape (n, order − 1, 3)
    """
    right = y < 0.0
    told = _inputs(x, np.abs(y), np.where(right, -h, h))
    layers = zip(network.weights[:-1], network.biases[:-1], strict=True)
    for weights, bias in layers:
        told = np.tanh(told @ weights + bias)
    given = told @ network.weights[-1] + network.biases[-1]
    pairs = given.astype(float).reshape(len(x), -1, 3)
    pairs[:, :, 1:] = np.maximum(pairs[:, :, 1:], 0.0)
    pairs[:, :, 0] = np.where(pairs[:, :, 0] < 0.0, -1.0, 1.0)
    pairs[right, :, 0] *= -1.0
    pairs[(pairs[:, :, 1] == 0.0) & (pairs[:, :, 2] == 0.0)] = 0.0
    return pairs


def train_regular(
    tree: Tree, options: TrainingOptions, *, method: Method, about: Mapping[str, Any]
) -> Iterator[Epoch]:
    """Train on the states of a tree; yields after every epoch, the last is the end.

    Args:
        tree: gives the states, one a cell.
        options: how; those of the loss of strategies play no part.
        method: what is taught.
        about: what shall be told of the weights' origin.
    """
    import torch

    torch.set_num_threads(options.threads)
    torch.manual_seed(options.seed)
    there = torch.cuda.is_available()
    if options.device == "cuda" and not there:
        raise ValueError("There is no CUDA device here: use --device cpu.")
    device = torch.device("cuda" if there and options.device != "cpu" else "cpu")

    # What is learnt from, and what is kept to judge by.
    nodes = np.random.default_rng(options.seed).permutation(tree.minima)
    kept = max(1, round(options.validation * len(nodes)))
    if len(nodes) < 2 * kept:
        raise ValueError(f"A tree of {len(nodes)} states is too small to train with.")
    radius = tree.parameters.encounter.turn_radius
    place = tree.x[nodes] / radius, tree.y[nodes] / radius, tree.heading[nodes]
    inputs = _inputs(*place)
    if method == "paper":
        pairs = pairs_of(tree, nodes)
        pairs[:, :, 2] /= radius
    else:
        pairs = exact_pairs(*place, tree.parameters)
    targets = pairs.reshape(len(nodes), -1).astype(np.float32)
    scales = [
        (part[kept:].mean(axis=0), part[kept:].std(axis=0) + np.float32(1e-6))
        for part in (inputs, targets)
    ]
    told, wanted = (
        torch.from_numpy((part - mean) / deviation).to(device)
        for part, (mean, deviation) in zip((inputs, targets), scales, strict=True)
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
            loss = (model(told[chosen]) - wanted[chosen]).square().mean()
            optimiser.zero_grad(set_to_none=True)
            loss.backward()
            optimiser.step()
            pace.step()
        with torch.no_grad():
            missed = float((model(told[:kept]) - wanted[:kept]).square().mean())
        weights, biases = _layers(model, *scales[0], *scales[1])
        yield Epoch(
            number=epoch + 1,
            loss=missed,
            network=RegularNetwork(
                method=method,
                parameters=tree.parameters,
                weights=weights,
                biases=biases,
                about={
                    **about,
                    "made": datetime.now(UTC).isoformat(timespec="seconds"),
                    "torch": torch.__version__,
                    "device": str(device),
                    "trained_on": len(nodes) - kept,
                    "options": asdict(options),
                    "validation_loss": missed,
                },
            ),
        )


def exact_pairs(x: Floats, y: Floats, h: Floats, parameters: TreeParameters) -> Floats:
    """The fastest paths without the limit in the form of `pairs_given`, C S C as (C, S) and C."""
    alpha = parameters.encounter.speed_ratio
    pairs, rows = np.zeros((len(x), parameters.order - 1, 3)), np.empty((MAX_ROWS, 5))
    for i, (ahead, left, heading) in enumerate(
        zip(x.tolist(), y.tolist(), h.tolist(), strict=True)
    ):
        solve(ahead, left, heading % (2.0 * pi), alpha, 0.0, rows)
        at = 0
        signs = SIGNS[int(rows[0, 1])]
        for sign, amount in zip(signs, rows[0, 2:], strict=True):
            if sign == 0.0:
                pairs[i, at - 1, 2] = amount
            elif at < len(pairs[i]):
                pairs[i, at, :2] = sign, amount
                at += 1
    return pairs


def save_regular(network: RegularNetwork, file: Path) -> None:
    """Write a network, in one piece or not at all."""
    from safetensors.numpy import save

    about = {
        "file": FILE,
        "method": network.method,
        "tree": parameters_as_json(network.parameters),
        "about": dict(network.about),
    }
    arrays = {f"weights.{i}": array for i, array in enumerate(network.weights)}
    arrays |= {f"biases.{i}": array for i, array in enumerate(network.biases)}
    content = save(arrays, metadata={"about": json.dumps(about, ensure_ascii=False)})
    with whole(file) as stream:
        stream.write(content)


def load_regular(file: Path) -> RegularNetwork:
    """Read a network.

    Raises:
        ValueError: if the file is none.
    """
    from safetensors import SafetensorError, safe_open

    file.stat()  # says that a file is missing in the system's words
    try:
        with safe_open(file, framework="numpy") as content:
            about = json.loads(content.metadata()["about"])
            if about["file"] != FILE or about["method"] not in ("paper", "direct"):
                raise KeyError(about["file"])
            depth = len(content.keys()) // 2
            arrays = [
                tuple(content.get_tensor(f"{name}.{i}") for i in range(depth))
                for name in ("weights", "biases")
            ]
        network = RegularNetwork(
            method=about["method"],
            parameters=parameters_from_json(about["tree"]),
            weights=arrays[0],
            biases=arrays[1],
            about=about["about"],
        )
        _check(network)
    except (SafetensorError, KeyError, TypeError, ValueError):
        raise ValueError(
            f"{file} holds no network of relguide train --method paper or direct, of this "
            "version, or is cut short."
        ) from None
    return network


def _check(network: RegularNetwork) -> None:
    width = INPUTS
    for weights, bias in zip(network.weights, network.biases, strict=True):
        if weights.shape != (width, len(bias)):
            raise ValueError(f"A layer of {weights.shape} does not follow one of {width}.")
        if not all(map(isfinite, [*weights.ravel().tolist(), *bias.tolist()])):
            raise ValueError("A weight is not finite.")
        width = len(bias)
    if width != 3 * (network.parameters.order - 1):
        raise ValueError(f"{width} numbers are no pairs of order {network.parameters.order}.")


def _inputs(x: Floats, y: Floats, h: Floats) -> Singles:
    return np.column_stack((x, y, np.cos(h), np.sin(h))).astype(np.float32)


def _model(options: TrainingOptions, outputs: int) -> "torch.nn.Sequential":
    from torch import nn

    layers: list[nn.Module] = [nn.Linear(INPUTS, options.shape.width), nn.Tanh()]
    for _ in range(options.shape.depth - 1):
        layers += [nn.Linear(options.shape.width, options.shape.width), nn.Tanh()]
    return nn.Sequential(*layers, nn.Linear(options.shape.width, outputs))


def _layers(
    model: "torch.nn.Module", mean: Singles, deviation: Singles, shift: Singles, stretch: Singles
) -> tuple[tuple[Singles, ...], tuple[Singles, ...]]:
    """Weights with the scales of inputs and outputs worked in."""
    state = {name: value.cpu().numpy() for name, value in model.state_dict().items()}
    weights = [value.T.astype(float) for name, value in state.items() if name.endswith("weight")]
    biases = [value.astype(float) for name, value in state.items() if name.endswith("bias")]
    weights[0] = weights[0] / deviation[:, None]
    biases[0] = biases[0] - mean @ weights[0]
    weights[-1], biases[-1] = weights[-1] * stretch, biases[-1] * stretch + shift
    single = np.float32
    return tuple(np.ascontiguousarray(w, single) for w in weights), tuple(
        b.astype(single) for b in biases
    )
