"""The template network: which template may be the fastest, and a guess that leads to its path.

    situation → features → layers → score and guess of each template

What is flown is never the network's guess: it is what solving the template exactly gives. Torch is
needed to train and to compare; to ask, `kernels/networks/template_scores` evaluates the weights.
The file is in safetensors, as that of the branches (`branch_network`).
"""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from importlib.resources import files
from math import hypot
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.networks.branch_scores import Layers
from relguide.kernels.networks.template_features import FEATURES, template_feature_rows
from relguide.kernels.networks.template_scores import OUTPUTS, Decision
from relguide.kernels.networks.templates import NONE as NONE
from relguide.kernels.networks.templates import TEMPLATES as TEMPLATES
from relguide.learn.boundary.template_labels import Floats, TemplateBox
from relguide.learn.training.files import load_weights, save_weights
from relguide.learn.training.options import NetworkShape
from relguide.learn.words.branch_network import Singles, as_layers

FILE = "relguide template network 1"
"""What a file says it is, with the version of its arrays."""
SHIPPED_TEMPLATES = Path(str(files("relguide.learn.boundary") / "templates.safetensors"))
"""The weights that come with the program."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TemplateNetwork:
    """A trained network, ready to be asked."""

    layers: Layers
    """Its weights, with the scale of its inputs worked into the first."""
    box: TemplateBox
    """Where it was trained."""
    least_share: float
    """Templates with a smaller share are left out."""
    most: int
    """With more templates than this the network is not sure enough to be asked."""
    doubt: float
    """Nor with a larger share of paths of no such template, or of no path at all."""
    about: Mapping[str, Any]
    """Who made it, from what, with what and when."""

    @property
    def shape(self) -> NetworkShape:
        """How large it is."""
        return NetworkShape(
            width=len(self.layers.first_bias), depth=len(self.layers.hidden_bias) + 1
        )

    @property
    def decision(self) -> Decision:
        """What of its answer is solved, and when nothing is."""
        return Decision(self.least_share, self.most, self.doubt)

    def holds(self, x: float, y: float, alpha: float, slot: float, limit: float) -> bool:
        """Whether a situation lies where it was trained: x, y, D and d_min in R."""
        box = self.box
        away = hypot(x - slot, y) - limit
        return (
            box.min_ratio <= alpha <= box.max_ratio
            and box.min_limit <= limit <= box.max_limit
            and limit <= slot <= box.max_slot * limit
            and away <= box.max_range
        )


def template_features_of(situations: Floats) -> Singles:
    """What the network is given for situations on the left of the route, shape (n, FEATURES)."""
    numbers = np.empty((len(situations), FEATURES))
    template_feature_rows(np.ascontiguousarray(situations), numbers)
    return numbers.astype(np.float32)


def save_template_network(network: TemplateNetwork, file: Path) -> None:
    """Write a network, in one piece or not at all."""
    about = {
        "file": FILE,
        "templates": TEMPLATES,
        "box": asdict(network.box),
        "least_share": network.least_share,
        "most": network.most,
        "doubt": network.doubt,
        "about": dict(network.about),
    }
    save_weights(file, about, network.layers._asdict())


def load_template_network(file: Path = SHIPPED_TEMPLATES) -> TemplateNetwork:
    """Read a network.

    Raises:
        ValueError: if the file holds no network, or one that does not fit this version.
    """

    def network(about: dict[str, Any], arrays: dict[str, NDArray[Any]]) -> TemplateNetwork:
        if about["file"] != FILE or tuple(about["templates"]) != TEMPLATES:
            raise KeyError(about["file"])
        return TemplateNetwork(
            layers=as_layers(FEATURES, OUTPUTS, **arrays),
            box=TemplateBox(**about["box"]),
            least_share=float(about["least_share"]),
            most=int(about["most"]),
            doubt=float(about["doubt"]),
            about=about["about"],
        )

    return load_weights(
        file,
        network,
        "holds no network of relguide train --method templates, of this version, or is cut short.",
    )
