"""How a network is trained: the options, and how the command line gives them.

Apart from the training, so that `--help` need not load it.
"""

import argparse
from dataclasses import dataclass, field
from math import isfinite
from pathlib import Path


@dataclass(frozen=True, slots=True, kw_only=True)
class NetworkShape:
    """How large a network is."""

    width: int = 128
    """Numbers a layer has."""
    depth: int = 3
    """Layers before the last."""

    def __post_init__(self) -> None:
        """Refuse what is no network."""
        if not (4 <= self.width <= 4096 and 1 <= self.depth <= 16):
            raise ValueError(
                "A network has 4 … 4096 numbers a layer and 1 … 16 layers, not "
                f"{self.width} and {self.depth}."
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class TrainingOptions:
    """How a network is trained, whatever it learns."""

    shape: NetworkShape = field(default_factory=NetworkShape)
    epochs: int = 40
    """At most; the learning rate falls to nothing over them."""
    batch: int = 4096
    learning_rate: float = 4e-3
    patience: int = 15
    """Epochs without a better validation before it is given up."""
    validation: float = 0.05
    """Share of the labels that are kept to stop by, and to calibrate by."""
    seed: int = 0
    threads: int = 2
    device: str = "auto"
    """`cpu`, `cuda`, or what there is."""

    def __post_init__(self) -> None:
        """Refuse what cannot be done."""
        for name in ("epochs", "batch", "patience", "threads"):
            if getattr(self, name) < 1:
                raise ValueError(f"{name} must be 1 or more, not {getattr(self, name)}.")
        if not (isfinite(self.learning_rate) and self.learning_rate > 0.0):
            raise ValueError(f"learning_rate must be above 0, not {self.learning_rate}.")
        if not 0.0 < self.validation < 1.0:
            raise ValueError(f"validation must lie between 0 and 1, not {self.validation}.")


NUMBERS = (
    ("width", "numbers a layer"),
    ("depth", "layers"),
    ("epochs", "at most"),
    ("batch", "labels a step"),
    ("patience", "epochs without a better one before it ends"),
    ("seed", "of the weights and the order"),
    ("threads", "of torch"),
)
"""Options that are whole numbers, and what they are."""


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of a training, for its script and for `relguide train`."""
    parser.add_argument("labels", metavar="LABELS.npz", type=Path)
    parser.add_argument("weights", metavar="WEIGHTS.safetensors", type=Path)
    for name, purpose in NUMBERS:
        parser.add_argument(
            f"--{name}",
            metavar="N",
            type=int,
            default=_default(name),
            help=f"{purpose}; default: %(default)s",
        )
    parser.add_argument(
        "--learning-rate",
        metavar="R",
        type=float,
        default=_default("learning_rate"),
        help="at its highest; default: %(default)s",
    )
    parser.add_argument(
        "--device",
        choices=("auto", "cpu", "cuda"),
        default=_default("device"),
        help="auto: a GPU if there is one; default: %(default)s",
    )
    parser.add_argument(
        "--resume",
        action="store_true",
        help="go on from WEIGHTS.safetensors.part, which a stopped run leaves; same result",
    )


def options_of(chosen: argparse.Namespace) -> TrainingOptions:
    """The options chosen.

    Raises:
        ValueError: if they cannot be.
    """
    return TrainingOptions(
        shape=NetworkShape(width=chosen.width, depth=chosen.depth),
        epochs=chosen.epochs,
        batch=chosen.batch,
        patience=chosen.patience,
        seed=chosen.seed,
        threads=chosen.threads,
        learning_rate=chosen.learning_rate,
        device=chosen.device,
    )


def command_of(chosen: argparse.Namespace) -> str:
    """The command that makes the same again, with the options that differ from the default."""
    names = [name for name, _ in NUMBERS] + ["learning_rate", "device"]
    given = [
        f" --{name.replace('_', '-')} {getattr(chosen, name)}"
        for name in names
        if getattr(chosen, name) != _default(name)
    ]
    return f"relguide train {chosen.labels.name} {chosen.weights.name}{''.join(given)}"


def _default(name: str) -> object:
    default = TrainingOptions()
    return getattr(default.shape if name in ("width", "depth") else default, name)
