"""train(labels, …) → StrategyNetwork: from labels to weights, one script from top to bottom.

    python -m relguide.learn.train labels.npz weights.safetensors

The loss has four parts: cross-entropy toward softmax(−(τ_s − τ*)/temperature), so that near a
switching surface both answers are right; regret, the time lost on average if a strategy were drawn
by its share, where one that does not exist loses all of it; existence; and the time of those that
exist. The same labels, options and number of threads give the same weights on the same CPU.
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

from relguide.kernels.strategies import SIZE
from relguide.learn.checkpoint import device_of, load_checkpoint, pace, save_checkpoint
from relguide.learn.files import expect_part
from relguide.learn.labels import Box, Labels, held_out, load_labels
from relguide.learn.network import (
    StrategyNetwork,
    features_of,
    layers_of,
    save_network,
    torch_model,
)
from relguide.learn.options import TrainingOptions, add_options, command_of, options_of

if TYPE_CHECKING:
    import torch

NEAR = 1e-6
"""A strategy this close to the fastest is as fast, relative."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Epoch:
    """How the training stands after an epoch."""

    number: int
    """From 1 on."""
    loss: float
    """Mean over its batches."""
    accuracy: float
    """How often the fastest strategy has the highest score, in the validation labels."""
    network: StrategyNetwork
    """The best so far."""
    best: int
    """The epoch it is of."""


def train(
    labels: Labels,
    options: TrainingOptions,
    *,
    box: Box,
    about: Mapping[str, Any],
    checkpoint: Path | None = None,
    resume: bool = False,
) -> Iterator[Epoch]:
    """Train a network; yields after every epoch, the last is the end.

    Args:
        labels: exact answers. Those in the regions of `held_out` are left out.
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
    outside = ~np.logical_or.reduce(list(held_out(labels.situations).values()))
    rows = np.flatnonzero(outside)
    rows = np.random.default_rng(options.seed).permutation(rows)
    kept = max(1, round(options.validation * len(rows)))
    if len(rows) < 2 * kept:
        raise ValueError(f"{len(labels)} labels are too few to train and to validate with.")
    inputs, times = features_of(labels.situations[rows]), labels.times[rows]
    mean, deviation = inputs[kept:].mean(axis=0), inputs[kept:].std(axis=0) + np.float32(1e-6)
    scaled = torch.from_numpy((inputs - mean) / deviation).to(device)
    targets = {
        name: torch.from_numpy(value.astype(np.float32)).to(device)
        for name, value in _targets(times, options.temperature).items()
    }
    fastest = times <= times.min(axis=1, keepdims=True) * (1.0 + NEAR)

    # The model and where it stands.
    model = torch_model(options.shape).to(device)
    optimiser = torch.optim.AdamW(model.parameters(), lr=options.learning_rate, weight_decay=1e-4)
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
            score, exists, time = model(scaled[chosen]).split(SIZE, dim=1)
            target = {name: value[chosen] for name, value in targets.items()}
            loss = (
                functional.cross_entropy(score, target["soft"])
                + options.regret * (score.softmax(dim=1) * target["regret"]).sum(dim=1).mean()
                + options.existence
                * functional.binary_cross_entropy_with_logits(exists, target["exists"])
                + options.time
                * (functional.smooth_l1_loss(time, target["time"], reduction="none")
                   * target["exists"]).mean()
            )  # fmt: skip
            optimiser.zero_grad(set_to_none=True)
            loss.backward()
            torch.nn.utils.clip_grad_norm_(model.parameters(), 1.0)
            optimiser.step()
            total += float(loss.detach())

        # How good it is on what it has not seen.
        share_of = _shares(model, scaled[:kept])
        right = fastest[np.arange(kept), share_of.argmax(axis=1)]
        accuracy = float(right.mean())
        if accuracy > best_accuracy:
            best, best_accuracy = epoch + 1, accuracy
            best_state = {name: value.clone() for name, value in model.state_dict().items()}
        if checkpoint is not None:
            save_checkpoint(
                checkpoint, digest, model, optimiser, best_state, epoch + 1, best, best_accuracy
            )
        current = model.state_dict()
        model.load_state_dict(best_state)
        shares = _shares(model, scaled[:kept])
        model.load_state_dict(current)
        yield Epoch(
            number=epoch + 1,
            loss=total / batches,
            accuracy=accuracy,
            best=best,
            network=StrategyNetwork(
                layers=layers_of(
                    {name: value.cpu().numpy() for name, value in best_state.items()},
                    mean, deviation,
                ),
                box=box,
                least_share=_calibrated(shares, fastest[:kept], options.coverage) / options.margin,
                most=SIZE,
                about={
                    **about,
                    "made": datetime.now(UTC).isoformat(timespec="seconds"),
                    "torch": torch.__version__,
                    "device": str(device),
                    "labels": len(labels),
                    "trained_on": len(rows) - kept,
                    "held_out": sorted(held_out(labels.situations)),
                    "options": asdict(options),
                    "epochs": best,
                    "validation_accuracy": best_accuracy,
                },
            ),
        )  # fmt: skip
        if epoch + 1 - best >= options.patience:
            return


def _targets(times: np.ndarray, temperature: float) -> dict[str, np.ndarray]:
    """What each part of the loss asks for; a strategy that does not exist loses all."""
    least = times.min(axis=1, keepdims=True)
    exists = np.isfinite(times)
    late = np.where(exists, times, 0.0) - least
    soft = np.where(exists, np.exp(-np.maximum(late, 0.0) / temperature), 0.0)
    return {
        "soft": soft / soft.sum(axis=1, keepdims=True),
        "regret": np.where(exists, np.minimum(late / np.maximum(least, 1e-3), 1.0), 1.0),
        "exists": exists,
        "time": np.log1p(np.where(exists, times, 0.0)),
    }


def _shares(model: "torch.nn.Module", inputs: "torch.Tensor") -> np.ndarray:
    """Shares of the strategies, in chunks."""
    import torch

    model.eval()
    with torch.no_grad():
        parts = [model(part)[:, :SIZE].softmax(dim=1).cpu() for part in torch.split(inputs, 8192)]
    shares: np.ndarray = torch.cat(parts).numpy()
    return shares


def _calibrated(shares: np.ndarray, fastest: np.ndarray, coverage: float) -> float:
    """The share that the fastest strategy reaches this often (split conformal prediction)."""
    reached = np.sort(np.where(fastest, shares, 0.0).max(axis=1))
    missed = int((1.0 - coverage) * (len(reached) + 1))
    return float(reached[max(missed - 1, 0)])


def _digest(labels: Labels, options: TrainingOptions) -> str:
    """Changes with whatever the result depends on."""
    digest = sha256(json.dumps(asdict(options), sort_keys=True).encode())
    for column in (labels.situations, labels.times):
        digest.update(np.ascontiguousarray(column).data)
    return digest.hexdigest()


def run(chosen: argparse.Namespace, program: str) -> Iterator[Epoch]:
    """Do the training that was asked for; the weights are written at each better epoch.

    Args:
        chosen: the options of `add_options`.
        program: what trains, for the weights' provenance.
    """
    labels, made = load_labels(chosen.labels)
    chosen.weights.parent.stat()  # nothing is trained that could not be written
    part = chosen.weights.with_name(f"{chosen.weights.name}.part")
    expect_part(part, resume=chosen.resume)
    for epoch in train(
        labels,
        options_of(chosen),
        box=Box(**made["request"]["box"]),
        about={
            "program": program,
            "command": command_of(chosen),
            "dataset": made["request"] | made["provenance"],
        },
        checkpoint=part,
        resume=chosen.resume,
    ):
        if epoch.best == epoch.number:
            save_network(epoch.network, chosen.weights)
        yield epoch
    part.unlink(missing_ok=True)


def told(epoch: Epoch) -> str:
    """An epoch in a few words."""
    return f"loss {epoch.loss:.4f}, accuracy {100.0 * epoch.accuracy:.3f} %"


def main() -> None:
    """Train, a line an epoch."""
    parser = argparse.ArgumentParser(prog="python -m relguide.learn.train")
    add_options(parser)
    chosen = parser.parse_args()
    try:
        for epoch in run(chosen, parser.prog):
            sys.stderr.write(f"epoch {epoch.number} of {chosen.epochs}: {told(epoch)}\n")
    except (OSError, ValueError) as error:
        raise SystemExit(f"{error}") from None


if __name__ == "__main__":
    main()
