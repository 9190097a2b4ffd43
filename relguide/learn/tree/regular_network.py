"""The paper's network, Fig. 5: situation → (ε, θ, l) of the pairs, as numbers, by least squares.

    place and heading relative to the slot → feed-forward network → regular trajectory

As the paper writes, it is trained on the tree of reverse dynamic programming, for one encounter,
and what it gives is flown as it is: nothing holds its end in the slot. It is kept as the baseline
`paper`. The baseline `direct` is the same network on the same states, which learns the exact
answers in place of the tree's: the errors that remain come from regressing parameters at all. They
jump at every switching surface, where the best network in the sense of least squares gives a mean
of two paths, which leads nowhere.

Left and right are exchanged before and after if the situation is on the right of the route.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from math import isfinite
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from relguide.learn.training.files import load_weights, save_weights
from relguide.learn.tree.tree import (
    Floats,
    TreeParameters,
    parameters_as_json,
    parameters_from_json,
)

Method = Literal["paper", "direct"]
"""What a network learns: the tree's paths, or the exact ones from the same states."""
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


def shipped_weights(method: Method) -> Path:
    """The weights that come with the program."""
    return Path(str(files("relguide.learn.tree") / f"{method}.safetensors"))


def regress_pairs(network: RegularNetwork, x: Floats, y: Floats, h: Floats) -> Floats:
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
    numbers = inputs_of(x, np.abs(y), np.where(right, -h, h))
    layers = zip(network.weights[:-1], network.biases[:-1], strict=True)
    for weights, bias in layers:
        numbers = np.tanh(numbers @ weights + bias)
    given = numbers @ network.weights[-1] + network.biases[-1]
    pairs = given.astype(float).reshape(len(x), -1, 3)
    pairs[:, :, 1:] = np.maximum(pairs[:, :, 1:], 0.0)
    pairs[:, :, 0] = np.where(pairs[:, :, 0] < 0.0, -1.0, 1.0)
    pairs[right, :, 0] *= -1.0
    pairs[(pairs[:, :, 1] == 0.0) & (pairs[:, :, 2] == 0.0)] = 0.0
    return pairs


def save_regular(network: RegularNetwork, file: Path) -> None:
    """Write a network, in one piece or not at all."""
    about = {
        "file": FILE,
        "method": network.method,
        "tree": parameters_as_json(network.parameters),
        "about": dict(network.about),
    }
    arrays = {f"weights.{i}": array for i, array in enumerate(network.weights)}
    arrays |= {f"biases.{i}": array for i, array in enumerate(network.biases)}
    save_weights(file, about, arrays)


def load_regular(file: Path) -> RegularNetwork:
    """Read a network.

    Raises:
        ValueError: if the file does not hold such a network.
    """

    def network(about: dict[str, Any], arrays: dict[str, NDArray[Any]]) -> RegularNetwork:
        if about["file"] != FILE or about["method"] not in ("paper", "direct"):
            raise KeyError(about["file"])
        depth = len(arrays) // 2
        found = RegularNetwork(
            method=about["method"],
            parameters=parameters_from_json(about["tree"]),
            weights=tuple(arrays[f"weights.{i}"] for i in range(depth)),
            biases=tuple(arrays[f"biases.{i}"] for i in range(depth)),
            about=about["about"],
        )
        _check(found)
        return found

    return load_weights(
        file,
        network,
        "holds no network of relguide train --method paper or direct, of this version, or is cut "
        "short.",
    )


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


def inputs_of(x: Floats, y: Floats, h: Floats) -> Singles:
    """What a network is given for states on the left of the route, shape (n, INPUTS)."""
    return np.column_stack((x, y, np.cos(h), np.sin(h))).astype(np.float32)
