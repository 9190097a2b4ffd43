"""train_ways(labels, …) → WayNetwork: from labels where the limit binds to weights.

    python -m relguide.learn.train_ways labels.npz weights.safetensors

The loss has two parts: cross-entropy of the kind, and how far its guess is off, whose kind's two
numbers alone count. The same labels, options and number of threads give the same weights on the
same CPU.
"""

import argparse
import json
import sys
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from relguide.kernels.way_features import FEATURES
from relguide.kernels.way_network import OUTPUTS
from relguide.kernels.way_solutions import taught_kinds
from relguide.kernels.ways import NONE, SEVERAL, SIZE
from relguide.learn.checkpoint import device_of, load_checkpoint, pace, save_checkpoint
from relguide.learn.files import expect_part
from relguide.learn.limit_label_file import load_limit_labels
from relguide.learn.limit_labels import LimitBox, LimitLabels
from relguide.learn.network import layers_of, torch_model
from relguide.learn.options import TrainingOptions, add_options, command_of, options_of
from relguide.learn.way_network import WayNetwork, save_way_network, way_features_of

if TYPE_CHECKING:
    import torch

WITHIN = 1e-3
"""A kind that is solved so much later is not that of the answer [R/V_P]: 40 ms for an airliner."""
GUESSED = 2.0
"""Weight of the guesses; that of the cross-entropy is 1."""
BEND = 0.05
"""Guesses farther off than this count by how far they are, and no more by its square."""
DECAY = 1e-3
LEAST_SHARE = 0.001
"""Kinds with a smaller share are left out. Of fresh answers 0.1 % are then more than 0.1 s later
than the search's; with 0.01 it is 0.2 %."""
MOST = 8
"""With more kinds than this, all solved, the search would hardly take longer."""
DOUBT = 0.8
"""Ways of no kind, none, and kinds without a way next to their guess may together be this likely.
With 0.5 instead 1.5 % fewer are answered, and the others no better."""


@dataclass(frozen=True, slots=True, kw_only=True)
class WayEpoch:
    """How the training stands after an epoch."""

    number: int
    """From 1 on."""
    loss: float
    """Mean over its batches."""
    accuracy: float
    """How often the right kind has the highest score, in the validation labels with a way."""
    network: WayNetwork
    """The best so far."""
    best: int
    """The epoch it is of."""


def train_ways(
    labels: LimitLabels,
    options: TrainingOptions,
    *,
    box: LimitBox,
    about: Mapping[str, Any],
    checkpoint: Path | None = None,
    resume: bool = False,
) -> Iterator[WayEpoch]:
    """Train a network; yields after every epoch, the last is the end.

    Args:
        labels: exact answers.
        options: how.
        box: of the labels.
        about: what shall be told of the weights' origin.
        checkpoint: a file written after every epoch, to go on from.
        resume: go on from it; the result is the same.
    """
    import torch
    from torch.nn import functional

    torch.set_num_threads(options.threads)
    torch.manual_seed(options.seed)
    device = device_of(options.device)

    # What is learnt from, and what is kept to stop by.
    rows = np.random.default_rng(options.seed).permutation(len(labels))
    kept = max(1, round(options.validation * len(rows)))
    if len(rows) < 2 * kept:
        raise ValueError(f"{len(labels)} labels are too few to train and to validate with.")
    kinds, guesses = taught(labels)
    kinds, guesses = kinds[rows], guesses[rows]
    inputs = way_features_of(labels.situations[rows])
    mean, deviation = inputs[kept:].mean(axis=0), inputs[kept:].std(axis=0) + np.float32(1e-6)
    scaled = torch.from_numpy((inputs - mean) / deviation).to(device)
    right = torch.from_numpy(kinds).to(device)
    guess = torch.from_numpy(guesses.astype(np.float32)).to(device)
    guessed = (guess != 0.0).any(dim=1).float()

    # The model and where it stands.
    model = torch_model(options.shape, features=FEATURES, outputs=OUTPUTS).to(device)
    optimiser = torch.optim.AdamW(model.parameters(), lr=options.learning_rate, weight_decay=DECAY)
    digest = _digest(labels, options)
    done, best, best_accuracy = 0, 0, -1.0
    best_state = {name: value.clone() for name, value in model.state_dict().items()}
    if resume:
        done, best, best_accuracy = load_checkpoint(
            checkpoint, digest, model, optimiser, best_state
        )

    batches = -(-(len(rows) - kept) // options.batch)
    for epoch in range(done, options.epochs):
        shuffle = torch.Generator().manual_seed(options.seed * 1_000_003 + epoch)
        order = torch.randperm(len(rows) - kept, generator=shuffle).to(device) + kept
        total = 0.0
        model.train()
        for number in range(batches):
            share = (epoch * batches + number + 1) / (options.epochs * batches)
            for group in optimiser.param_groups:
                group["lr"] = options.learning_rate * pace(share)
            chosen = order[number * options.batch : (number + 1) * options.batch]
            score, pairs = model(scaled[chosen]).split((SIZE, 2 * SIZE), dim=1)
            own = pairs.view(-1, SIZE, 2)[torch.arange(len(chosen)), right[chosen]]
            off = functional.smooth_l1_loss(own, guess[chosen], reduction="none", beta=BEND)
            loss: Any = GUESSED * (
                off.sum(dim=1) * guessed[chosen]
            ).mean() + functional.cross_entropy(score, right[chosen])
            optimiser.zero_grad(set_to_none=True)
            loss.backward()
            torch.nn.utils.clip_grad_norm_(model.parameters(), 1.0)
            optimiser.step()
            total += float(loss.detach())

        # How good it is on what it has not seen.
        accuracy = _accuracy(model, scaled[:kept], kinds[:kept])
        if accuracy > best_accuracy:
            best, best_accuracy = epoch + 1, accuracy
            best_state = {name: value.clone() for name, value in model.state_dict().items()}
        if checkpoint is not None:
            save_checkpoint(
                checkpoint, digest, model, optimiser, best_state, epoch + 1, best, best_accuracy
            )
        yield WayEpoch(
            number=epoch + 1,
            loss=total / batches,
            accuracy=accuracy,
            best=best,
            network=WayNetwork(
                layers=layers_of(
                    {name: value.cpu().numpy() for name, value in best_state.items()},
                    mean, deviation,
                ),
                box=box,
                least_share=LEAST_SHARE,
                most=MOST,
                doubt=DOUBT,
                about={
                    **about,
                    "made": datetime.now(UTC).isoformat(timespec="seconds"),
                    "torch": torch.__version__,
                    "device": str(device),
                    "labels": len(labels),
                    "trained_on": len(rows) - kept,
                    "options": asdict(options),
                    "epochs": best,
                    "validation_accuracy": best_accuracy,
                },
            ),
        )  # fmt: skip
        if epoch + 1 - best >= options.patience:
            return


def taught(labels: LimitLabels) -> tuple[np.ndarray, np.ndarray]:
    """What is to be learnt: kinds, shape (n,), and guesses, shape (n, 2)."""
    n = len(labels)
    kinds, guesses = np.empty(n), np.empty((n, 2))
    taught_kinds(
        labels.situations, np.ascontiguousarray(labels.times[:, 2]), labels.counts.astype(float),
        labels.legs, WITHIN, kinds, guesses,
    )  # fmt: skip
    return kinds.astype(np.int64), guesses


def _accuracy(model: "torch.nn.Module", inputs: "torch.Tensor", kinds: np.ndarray) -> float:
    """How often the right kind has the highest score, where there is a way of some kind."""
    import torch

    model.eval()
    with torch.no_grad():
        parts = [model(part)[:, :SIZE].argmax(dim=1).cpu() for part in torch.split(inputs, 8192)]
    there = (kinds != NONE) & (kinds != SEVERAL)
    return float((torch.cat(parts).numpy() == kinds)[there].mean()) if there.any() else 0.0


def _digest(labels: LimitLabels, options: TrainingOptions) -> str:
    """Changes with whatever the result depends on."""
    digest = sha256(json.dumps(asdict(options), sort_keys=True).encode())
    for column in (labels.situations, labels.times, labels.legs):
        digest.update(np.ascontiguousarray(column).data)
    return digest.hexdigest()


def run(chosen: argparse.Namespace, program: str) -> Iterator[WayEpoch]:
    """Do the training that was asked for; the weights are written at each better epoch.

    Args:
        chosen: the options of `options.add_options`.
        program: what trains, for the weights' provenance.
    """
    labels, made = load_limit_labels(chosen.labels)
    chosen.weights.parent.stat()  # nothing is trained that could not be written
    part = chosen.weights.with_name(f"{chosen.weights.name}.part")
    expect_part(part, resume=chosen.resume)
    for epoch in train_ways(
        labels,
        options_of(chosen),
        box=LimitBox(**made["request"]["box"]),
        about={
            "program": program,
            "command": f"{command_of(chosen)} --method ways",
            "dataset": made["request"] | made["provenance"],
        },
        checkpoint=part,
        resume=chosen.resume,
    ):
        if epoch.best == epoch.number:
            save_way_network(epoch.network, chosen.weights)
        yield epoch
    part.unlink(missing_ok=True)


def main() -> None:
    """Train, a line an epoch."""
    parser = argparse.ArgumentParser(prog="python -m relguide.learn.train_ways")
    add_options(parser)
    chosen = parser.parse_args()
    try:
        for epoch in run(chosen, parser.prog):
            sys.stderr.write(
                f"epoch {epoch.number} of {chosen.epochs}: loss {epoch.loss:.4f}, accuracy "
                f"{100.0 * epoch.accuracy:.3f} %\n"
            )
    except (OSError, ValueError) as error:
        raise SystemExit(f"{error}") from None


if __name__ == "__main__":
    main()
