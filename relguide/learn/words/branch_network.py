"""The branch network: which words may be the fastest. Its torch model, its file, its set.

    situation → features → layers → score, existence and log(1 + τ) of each branch

What flies is never the network's number: the words it holds possible are solved exactly. Torch is
needed to train and to compare; who only asks evaluates the weights with
`kernels/networks/branch_scores`.

The file is in safetensors: arrays, and in its header one JSON text that says all the rest.
"""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from importlib.resources import files
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.networks.branch_scores import Layers
from relguide.kernels.networks.margins import INPUTS, input_rows
from relguide.kernels.words.branches import BRANCHES, SIZE
from relguide.learn.training.files import load_weights, save_weights
from relguide.learn.training.options import NetworkShape
from relguide.learn.words.branch_labels import Box, Floats

if TYPE_CHECKING:
    from torch import nn

Singles = NDArray[np.float32]
FILE = "relguide branch network 2"
"""What a file says it is, with the version of its arrays."""
OUTPUTS = 3 * SIZE
"""Score, logit of existence and log(1 + τ) of each branch."""
SHIPPED = Path(str(files("relguide.learn.words") / "branches.safetensors"))
"""The weights that come with the program."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BranchNetwork:
    """A trained network, ready to be asked."""

    layers: Layers
    """Its weights, with the scale of its inputs worked into the first."""
    box: Box
    """Where it was trained."""
    least_share: float
    """Branches with a smaller share are left out: calibrated, so that the fastest seldom is."""
    most: int
    """With more branches than this the network is not sure enough to be asked."""
    about: Mapping[str, Any]
    """Who made it, from what, with what and when."""

    @property
    def shape(self) -> NetworkShape:
        """How large it is."""
        return NetworkShape(
            width=len(self.layers.first_bias), depth=len(self.layers.hidden_bias) + 1
        )


def features_of(situations: Floats) -> Singles:
    """What the network is given for situations on the left of the route, shape (n, INPUTS)."""
    numbers = np.empty((len(situations), INPUTS))
    input_rows(np.ascontiguousarray(situations), numbers)
    return numbers.astype(np.float32)


def torch_model(
    shape: NetworkShape, *, features: int = INPUTS, outputs: int = OUTPUTS
) -> "nn.Sequential":
    """A network to be trained, on features less their mean over their deviation."""
    from torch import nn

    layers: list[nn.Module] = [nn.Linear(features, shape.width), nn.SiLU()]
    for _ in range(shape.depth - 1):
        layers += [nn.Linear(shape.width, shape.width), nn.SiLU()]
    return nn.Sequential(*layers, nn.Linear(shape.width, outputs))


def layers_of(state: Mapping[str, Singles], mean: Singles, deviation: Singles) -> Layers:
    """A trained model's weights as the kernels take them, for features as they are.

    Args:
        state: of the torch model, as arrays, in its order.
        mean: of each feature.
        deviation: of each feature.
    """
    weights = [value.T for name, value in state.items() if name.endswith("weight")]
    biases = [value for name, value in state.items() if name.endswith("bias")]
    width = len(biases[0])
    first = weights[0].astype(float) / deviation[:, None]
    middle, bias = weights[1:-1], biases[1:-1]
    return as_layers(
        first.shape[0],
        len(biases[-1]),
        first=first,
        first_bias=biases[0] - mean @ first,
        hidden=np.stack(middle) if middle else np.empty((0, width, width)),
        hidden_bias=np.stack(bias) if bias else np.empty((0, width)),
        last=weights[-1],
        last_bias=biases[-1],
    )


def save_network(network: BranchNetwork, file: Path) -> None:
    """Write a network, in one piece or not at all."""
    about = {
        "file": FILE,
        "branches": BRANCHES,
        "box": asdict(network.box),
        "least_share": network.least_share,
        "most": network.most,
        "about": dict(network.about),
    }
    save_weights(file, about, network.layers._asdict())


def load_network(file: Path = SHIPPED) -> BranchNetwork:
    """Read a network.

    Raises:
        ValueError: if the file holds no network, or one that does not fit this version.
    """

    def network(about: dict[str, Any], arrays: dict[str, NDArray[Any]]) -> BranchNetwork:
        if about["file"] != FILE or tuple(about["branches"]) != BRANCHES:
            raise KeyError(about["file"])
        return BranchNetwork(
            layers=as_layers(INPUTS, OUTPUTS, **arrays),
            box=Box(**about["box"]),
            least_share=float(about["least_share"]),
            most=int(about["most"]),
            about=about["about"],
        )

    return load_weights(
        file, network, "holds no network of relguide train, of this version, or is cut short."
    )


def as_layers(features: int, outputs: int, **arrays: NDArray[Any]) -> Layers:
    """Weights in the kernels' form.

    Args:
        features: how many numbers go in.
        outputs: and come out.
        arrays: the weights, by their names in `Layers`.

    Raises:
        ValueError: if they do not fit together, or are not finite.
    """
    layers = Layers(
        **{name: np.ascontiguousarray(a, dtype=np.float32) for name, a in arrays.items()}
    )
    width, depth = layers.first_bias.shape[0], layers.hidden_bias.shape[0]
    shapes = {
        "first": (features, width),
        "first_bias": (width,),
        "hidden": (depth, width, width),
        "hidden_bias": (depth, width),
        "last": (width, outputs),
        "last_bias": (outputs,),
    }
    for name, array in layers._asdict().items():
        if array.shape != shapes[name] or not all(map(isfinite, array.ravel().tolist())):
            raise ValueError(f"{name} has not the shape {shapes[name]}, or is not finite.")
    return layers
