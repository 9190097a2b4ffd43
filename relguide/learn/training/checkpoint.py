"""What trainings share: where they run, their pace, and a file to go on from after a stop."""

from collections.abc import Mapping
from math import cos, pi
from pathlib import Path
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from relguide.learn.training.files import load_weights, save_weights

if TYPE_CHECKING:
    import torch

CHECKPOINT = "relguide training 1"
"""What a checkpoint says it is."""


def pace(share: float) -> float:
    """The learning rate over its largest: up in the first 3 %, then down like a cosine."""
    return min(share / 0.03, 0.5 + 0.5 * cos(pi * min(share, 1.0)))


def device_of(name: str) -> "torch.device":
    """The device of a name; of `auto`, a GPU if there is one.

    Raises:
        ValueError: if this machine has none of that name.
    """
    import torch

    if name == "auto":
        name = "cuda" if torch.cuda.is_available() else "cpu"
    if name == "cuda" and not torch.cuda.is_available():
        raise ValueError("There is no CUDA device here: use --device cpu.")
    return torch.device(name)


def save_checkpoint(
    file: Path, digest: str, model: "torch.nn.Module", optimiser: "torch.optim.Optimizer",
    best_state: Mapping[str, "torch.Tensor"], done: int, best: int, best_accuracy: float,
) -> None:  # fmt: skip
    """Write down where a training stands.

    Args:
        file: where to.
        digest: changes with whatever the result depends on.
        model: as it is now.
        optimiser: the same.
        best_state: the model's at its best so far.
        done: epochs done.
        best: the best of them.
        best_accuracy: how good that is.
    """
    tensors = {f"model.{name}": value for name, value in model.state_dict().items()}
    tensors |= {f"best.{name}": value for name, value in best_state.items()}
    for number, moments in optimiser.state_dict()["state"].items():
        tensors |= {f"optimiser.{number}.{name}": value for name, value in moments.items()}
    about = {
        "file": CHECKPOINT, "digest": digest, "done": done, "best": best,
        "best_accuracy": best_accuracy,
    }  # fmt: skip
    save_weights(file, about, {name: value.cpu().numpy() for name, value in tensors.items()})


def load_checkpoint(
    file: Path | None, digest: str, model: "torch.nn.Module", optimiser: "torch.optim.Optimizer",
    best_state: dict[str, "torch.Tensor"],
) -> tuple[int, int, float]:  # fmt: skip
    """Put a training where a checkpoint left it.

    Returns:
        epochs done, the best of them and how good that is.

    Raises:
        ValueError: if there is no checkpoint, or it is of another training.
    """
    import torch

    def read(
        about: dict[str, Any], arrays: dict[str, NDArray[Any]]
    ) -> tuple[dict[str, Any], dict[str, "torch.Tensor"]]:
        if about["file"] != CHECKPOINT:
            raise KeyError(about["file"])
        return about, {name: torch.from_numpy(array) for name, array in arrays.items()}

    if file is None or not file.exists():
        raise ValueError(f"There is nothing to resume: {file} does not exist.")
    about, tensors = load_weights(
        file, read, "is no checkpoint of relguide train, or is cut short."
    )
    if about["digest"] != digest:
        raise ValueError(
            f"{file} was begun with other labels or options: give the same, or delete it to begin "
            "anew."
        )
    model.load_state_dict({name: tensors[f"model.{name}"] for name in model.state_dict()})
    best_state.update({name: tensors[f"best.{name}"] for name in best_state})
    moments: dict[int, dict[str, Any]] = {}
    for name, value in tensors.items():
        if name.startswith("optimiser."):
            _, number, moment = name.split(".")
            moments.setdefault(int(number), {})[moment] = value
    optimiser.load_state_dict(optimiser.state_dict() | {"state": moments})
    return int(about["done"]), int(about["best"]), float(about["best_accuracy"])
