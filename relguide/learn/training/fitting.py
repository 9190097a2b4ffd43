"""fit(model, …): the loop of a training, from its first epoch to its last.

What is learnt is the business of `train_branches` and `train_templates`: the rows, the loss, the
accuracy, and the network that the weights become. The same for each is here: what is kept to stop
by, the steps and their pace, the best weights so far, when to end, a file to go on from, and the
script.
"""

import argparse
import json
import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from relguide.learn.training.checkpoint import device_of, load_checkpoint, pace, save_checkpoint
from relguide.learn.training.files import expect_part
from relguide.learn.training.options import (
    TrainingOptions,
    add_options,
    command_of,
    options_of,
)
from relguide.planning.extras import need

if TYPE_CHECKING:
    import torch

Singles = NDArray[np.float32]
N = TypeVar("N")
"""The network that is trained."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Epoch(Generic[N]):
    """How the training stands after an epoch."""

    number: int
    """From 1 on."""
    loss: float
    """Mean over its batches."""
    accuracy: float
    """In the rows kept."""
    network: N
    """The best so far."""
    best: int
    """The epoch it is of."""


class Split(NamedTuple):
    """What is learnt from, and what is kept to judge by."""

    rows: NDArray[Any]
    """Both, mixed: those kept come first."""
    kept: int
    """How many they are."""

    @property
    def learnt(self) -> int:
        """How many are learnt from."""
        return len(self.rows) - self.kept


class Scaled(NamedTuple):
    """Columns less their mean over their deviation, which are those of the rows learnt from."""

    values: Singles
    mean: Singles
    deviation: Singles


def begin(options: TrainingOptions) -> "torch.device":
    """Make what torch draws and adds up the same each time.

    Returns:
        where to train.
    """
    need("torch")
    import torch

    torch.set_num_threads(options.threads)
    torch.manual_seed(options.seed)
    return device_of(options.device)


def split(rows: NDArray[Any], options: TrainingOptions, *, of: str) -> Split:
    """Keep a share of the rows apart.

    Args:
        rows: numbers of what there is.
        options: how large the share is, and its seed.
        of: what they are rows of.

    Raises:
        ValueError: if they are too few.
    """
    kept = max(1, round(options.validation * len(rows)))
    if len(rows) < 2 * kept:
        raise ValueError(f"{len(rows)} {of} are too few to train and to validate with.")
    return Split(np.random.default_rng(options.seed).permutation(rows), kept)


def scale(columns: Singles, kept: int) -> Scaled:
    """Scale columns, whose first rows are kept."""
    mean = columns[kept:].mean(axis=0)
    deviation = columns[kept:].std(axis=0) + np.float32(1e-6)
    return Scaled((columns - mean) / deviation, mean, deviation)


def fit(
    model: "torch.nn.Module",
    options: TrainingOptions,
    *,
    rows: Split,
    loss: Callable[["torch.Tensor"], "torch.Tensor"],
    accuracy: Callable[[], float],
    network: Callable[[Mapping[str, Any]], N],
    decay: float,
    digest: str,
    checkpoint: Path | None = None,
    resume: bool = False,
) -> Iterator[Epoch[N]]:
    """Train a model; yields after every epoch, the last is the end.

    Args:
        model: on its device.
        options: how.
        rows: how many there are; those learnt from follow those kept.
        loss: of the rows whose places are given, from the model as it is.
        accuracy: of the model as it is, in the rows kept.
        network: what the model's weights become; it is given how they came about.
        decay: of the weights, each step, over the learning rate.
        digest: of whatever the result depends on.
        checkpoint: a file written after every epoch, to go on from.
        resume: go on from it; the result is the same.
    """
    import torch

    optimiser = torch.optim.AdamW(model.parameters(), lr=options.learning_rate, weight_decay=decay)
    done, best, best_accuracy = 0, 0, -1.0
    best_state = _copy(model)
    if resume:
        done, best, best_accuracy = load_checkpoint(
            checkpoint, digest, model, optimiser, best_state
        )
    device = device_of(options.device)
    batches = -(-rows.learnt // options.batch)
    for epoch in range(done, options.epochs):
        if epoch - best >= options.patience:
            return
        shuffle = torch.Generator().manual_seed(options.seed * 1_000_003 + epoch)
        order = torch.randperm(rows.learnt, generator=shuffle).to(device) + rows.kept
        total = 0.0
        model.train()
        for number in range(batches):
            share = (epoch * batches + number + 1) / (options.epochs * batches)
            for group in optimiser.param_groups:
                group["lr"] = options.learning_rate * pace(share)
            missed: Any = loss(order[number * options.batch : (number + 1) * options.batch])
            optimiser.zero_grad(set_to_none=True)
            missed.backward()
            torch.nn.utils.clip_grad_norm_(model.parameters(), 1.0)
            optimiser.step()
            total += float(missed.detach())

        # How good it is on what it has not seen.
        model.eval()
        with torch.no_grad():
            reached = accuracy()
        if reached > best_accuracy:
            best, best_accuracy, best_state = epoch + 1, reached, _copy(model)
        if checkpoint is not None:
            save_checkpoint(
                checkpoint, digest, model, optimiser, best_state, epoch + 1, best, best_accuracy
            )
        current = _copy(model)
        model.load_state_dict(best_state)
        with torch.no_grad():
            made = network(
                origin_of(options)
                | {
                    "trained_on": rows.learnt,
                    "epochs": best,
                    "validation_accuracy": best_accuracy,
                }
            )
        model.load_state_dict(current)
        yield Epoch(
            number=epoch + 1, loss=total / batches, accuracy=reached, network=made, best=best
        )


def covering_share(shares: NDArray[Any], coverage: float) -> float:
    """A share that the right answer reaches this often (split conformal prediction).

    Args:
        shares: that a network gives to what is right, in rows it has not learnt from.
        coverage: how often.
    """
    missed = int((1.0 - coverage) * (len(shares) + 1))
    return float(np.sort(shares)[max(missed - 1, 0)])


def origin_of(options: TrainingOptions) -> dict[str, Any]:
    """When, where and how a network is trained, for those who ask later."""
    import torch

    return {
        "made": datetime.now(UTC).isoformat(timespec="seconds"),
        "torch": torch.__version__,
        "device": str(device_of(options.device)),
        "options": asdict(options),
    }


def arrays_of(model: "torch.nn.Module") -> dict[str, Singles]:
    """A model's weights as arrays of their own, in its order: the model may go on learning."""
    return {name: value.cpu().numpy().copy() for name, value in model.state_dict().items()}


def shares_of(model: "torch.nn.Module", inputs: "torch.Tensor", size: int) -> Singles:
    """The shares that the first `size` outputs of a model give to as many answers, of each row."""
    import torch

    # as many rows at once as fit everywhere
    scores = torch.cat([model(part).cpu()[:, :size] for part in torch.split(inputs, 8192)])
    shares: Singles = scores.softmax(dim=1).numpy()
    return shares


def digest_of(options: TrainingOptions, *columns: NDArray[Any]) -> str:
    """Changes with whatever the result of the same program depends on."""
    digest = sha256(json.dumps(asdict(options), sort_keys=True).encode())
    for column in columns:
        digest.update(np.ascontiguousarray(column).data)
    return digest.hexdigest()


def part_of(chosen: argparse.Namespace) -> Path:
    """The file to go on from, beside the weights; nothing is trained that could not be written.

    Args:
        chosen: the options of `add_options`.

    Raises:
        ValueError: if a stopped run has left one, or none where one is to be resumed.
    """
    weights: Path = chosen.weights
    weights.parent.stat()
    part = weights.with_name(f"{weights.name}.part")
    expect_part(part, resume=chosen.resume)
    return part


def run_training(
    chosen: argparse.Namespace,
    program: str,
    *,
    load: Callable[[Path], tuple[Any, dict[str, Any]]],
    box: Callable[..., Any],
    train: Callable[..., Iterator[Epoch[N]]],
    save: Callable[[N, Path], None],
    method: str = "",
) -> Iterator[Epoch[N]]:
    """Do the training that was asked for; the weights are written at each better epoch.

    Args:
        chosen: the options of `add_options`.
        program: what trains, for the weights' provenance.
        load: reads the labels.
        box: makes the box that they are of.
        train: trains a network of them.
        save: writes it.
        method: what the command that does the same says besides.
    """
    labels, made = load(chosen.labels)
    part = part_of(chosen)
    for epoch in train(
        labels,
        options_of(chosen),
        box=box(**made["request"]["box"]),
        about={
            "program": program,
            "command": command_of(chosen) + method,
            "dataset": made["request"] | made["provenance"],
        },
        checkpoint=part,
        resume=chosen.resume,
    ):
        if epoch.best == epoch.number:
            save(epoch.network, chosen.weights)
        yield epoch
    part.unlink(missing_ok=True)  # of no use any more


def summary_of(epoch: Epoch[Any]) -> str:
    """An epoch in a few words."""
    return f"loss {epoch.loss:.4f}, accuracy {100.0 * epoch.accuracy:.3f} %"


def script(name: str, run: Callable[[argparse.Namespace, str], Iterator[Epoch[Any]]]) -> None:
    """Train, a line an epoch: what `python -m NAME` does.

    Args:
        name: of the module.
        run: does the training chosen, given what trains.
    """
    parser = argparse.ArgumentParser(prog=f"python -m {name}")
    add_options(parser)
    chosen = parser.parse_args()
    try:
        for epoch in run(chosen, parser.prog):
            sys.stderr.write(f"epoch {epoch.number} of {chosen.epochs}: {summary_of(epoch)}\n")
    except (OSError, ValueError) as error:
        raise SystemExit(f"{error}") from None


def _copy(model: "torch.nn.Module") -> dict[str, "torch.Tensor"]:
    return {name: value.clone() for name, value in model.state_dict().items()}
