"""The template network: which template may be the fastest, and a guess that leads to its path.

    situation → features → layers → score and guess of each template

What is flown is never the network's guess: it is what solving the template exactly gives. Torch is
needed to train and to compare; to ask, `kernels/networks/template_scores` evaluates the weights.
The file is in safetensors, as that of the branches (`branch_network`).
"""

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from importlib.resources import files
from pathlib import Path
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.networks.branch_scores import Layers
from relguide.kernels.networks.template_features import FEATURES, template_feature_rows
from relguide.kernels.networks.template_scores import Decision
from relguide.kernels.networks.template_solutions import label_templates
from relguide.kernels.networks.templates import GUESS
from relguide.kernels.networks.templates import NONE as NONE
from relguide.kernels.networks.templates import TEMPLATES as TEMPLATES
from relguide.learn.boundary.template_labels import (
    ConstrainedPaths,
    Floats,
    TemplateBox,
    advance_paths,
)
from relguide.learn.training.files import load_weights, save_weights
from relguide.learn.training.options import NetworkShape
from relguide.learn.words.branch_network import Singles, as_layers

SHIPPED_TEMPLATES = Path(str(files("relguide.learn.boundary") / "templates.safetensors"))
"""The weights that come with the program."""
AT_ONCE = 65_536
"""Situations whose features are worked out at a time: they are twice as large then."""
Box = TypeVar("Box")
"""Where a network was trained."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Rules:
    """What of a network's answer is solved, and when nothing is: see `TemplateNetwork`."""

    least_share: float
    """Templates with a smaller share are left out; with one smaller still if `coverage` asks so."""
    coverage: float
    """How often the fastest template shall be among those solved, in labels not learnt from."""
    most: int
    """Of templates that are solved."""
    doubt: float
    """The largest share of what cannot be solved."""
    evened: float
    """How far shares are evened out, 0 for not at all: with 1 they are as sure as they are right
    in labels not learnt from (their logarithms are divided by what makes their cross-entropy least,
    Guo and others 2017); with more, the logarithms are divided by so many times that."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TemplateKind(Generic[Box]):
    """What networks of templates are about: leaders who keep straight, or who turn."""

    file: str
    """What a file says it is, with the version of its arrays."""
    method: str
    """Of `relguide train`."""
    templates: tuple[str, ...]
    """Their names."""
    features: int
    """How many numbers a network is given."""
    guess: int
    """How many numbers a template's guess is."""
    box: Callable[..., Box]
    """Where a network is trained."""
    write_features: Callable[[Floats, Floats], None]
    """The kernel that works them out."""
    write_targets: Callable[..., None]
    """The kernel that tells templates and guesses of paths."""
    advance: Callable[[ConstrainedPaths, np.random.Generator], ConstrainedPaths]
    """The rest of paths from some moment on."""
    rules: "Rules"
    """What of a network's answer is solved."""

    @property
    def size(self) -> int:
        """How many templates there are."""
        return len(self.templates)

    @property
    def outputs(self) -> int:
        """Score of each template, then its guess."""
        return self.size * (1 + self.guess)

    def features_of(self, situations: Floats) -> Singles:
        """What a network is given, of shape (n, features)."""
        given = np.empty((len(situations), self.features), np.float32)
        for begin in range(0, len(situations), AT_ONCE):
            part = np.ascontiguousarray(situations[begin : begin + AT_ONCE])
            numbers = np.empty((len(part), self.features))
            self.write_features(part, numbers)
            given[begin : begin + AT_ONCE] = numbers
        return given

    def targets_of(self, paths: ConstrainedPaths, within: float) -> tuple[NDArray[Any], Floats]:
        """What is to be learnt: templates, shape (n,), and guesses, shape (n, guess).

        Args:
            paths: what is learnt from.
            within: a template whose path is so much later is not the answer's [R/V_P].
        """
        n = len(paths.times)
        templates, guesses = np.empty(n), np.zeros((n, self.guess))
        self.write_targets(
            paths.situations, paths.times, paths.counts.astype(float), paths.legs, within,
            templates, guesses,
        )  # fmt: skip
        return templates.astype(np.int64), guesses


STRAIGHT = TemplateKind(
    file="relguide template network 1",
    method="templates",
    templates=TEMPLATES,
    features=FEATURES,
    guess=GUESS,
    box=TemplateBox,
    write_features=template_feature_rows,
    write_targets=label_templates,
    advance=advance_paths,
    # with more than eight, all solved, the search would hardly take longer; of what is answered
    # besides with a doubt of 0.8, 0.6 %, a third is late
    rules=Rules(least_share=0.001, coverage=0.999, most=8, doubt=0.4, evened=0.0),
)
"""Leaders who keep straight; situations on the left of the route."""


def template_features_of(situations: Floats) -> Singles:
    """What a network of `STRAIGHT` is given, of shape (n, FEATURES)."""
    return STRAIGHT.features_of(situations)


@dataclass(frozen=True, slots=True, kw_only=True)
class TemplateNetwork(Generic[Box]):
    """A trained network, ready to be asked."""

    layers: Layers
    """Its weights, with the scale of its inputs worked into the first."""
    kind: TemplateKind[Box]
    """What it is about."""
    box: Box
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


def save_template_network(network: TemplateNetwork[Any], file: Path) -> None:
    """Write a network, in one piece or not at all."""
    about = {
        "file": network.kind.file,
        "templates": network.kind.templates,
        "box": asdict(network.box),
        "least_share": network.least_share,
        "most": network.most,
        "doubt": network.doubt,
        "about": dict(network.about),
    }
    save_weights(file, about, network.layers._asdict())


def load_template_network(file: Path = SHIPPED_TEMPLATES) -> TemplateNetwork[TemplateBox]:
    """Read a network of `STRAIGHT`.

    Raises:
        ValueError: if the file holds no network, or one that does not fit this version.
    """
    return load_network_of(STRAIGHT, file)


def load_network_of(kind: TemplateKind[Box], file: Path) -> TemplateNetwork[Box]:
    """Read a network of some kind.

    Raises:
        ValueError: if the file holds no such network, or one that does not fit this version.
    """

    def network(about: dict[str, Any], arrays: dict[str, NDArray[Any]]) -> TemplateNetwork[Box]:
        if about["file"] != kind.file or tuple(about["templates"]) != kind.templates:
            raise KeyError(about["file"])
        return TemplateNetwork(
            layers=as_layers(kind.features, kind.outputs, **arrays),
            kind=kind,
            box=kind.box(**about["box"]),
            least_share=float(about["least_share"]),
            most=int(about["most"]),
            doubt=float(about["doubt"]),
            about=about["about"],
        )

    return load_weights(
        file,
        network,
        f"holds no network of relguide train --method {kind.method}, of this version, or is cut "
        "short.",
    )
