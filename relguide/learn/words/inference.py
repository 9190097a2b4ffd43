"""branch_shares(network, situations): what the branch network says of very many at once.

One question is answered fastest by the fused kernel (`kernels/networks/branch_scores`). Dense maps
ask a million: then matrices in torch are faster, in chunks that stay in the cache, or on a GPU
where there is one. Both say the same to some 1e-6; what flies is decoded from the kernel's answer.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np

from relguide.kernels.words.branches import MIRROR_OF, SIZE
from relguide.learn.training.checkpoint import device_of
from relguide.learn.words.branch_labels import Floats, canonical, lies_right
from relguide.learn.words.branch_network import BranchNetwork, Singles, features_of
from relguide.planning.extras import need
from relguide.planning.inputs import expect

CHUNK = 4096
"""Situations a chunk on a CPU: a layer of them is 2 MB; with 65,536 each takes twice as long."""
CUDA_CHUNK = 262_144
"""On a GPU: a layer of them is 134 MB."""


def branch_shares(
    network: BranchNetwork,
    situations: Floats,
    *,
    device: str = "auto",
    threads: int | None = None,
    progress: Callable[[int], object] | None = None,
) -> Singles:
    """How likely the network takes each branch to be the fastest.

    Args:
        network: to be asked. Outside its `box` what it says means nothing.
        situations: x ahead of the slot and y left of it [R], h counter-clockwise from the leader's
            heading [rad], α = V_L/V_P below 1. shape (n, 4)
        device: `cpu`, `cuda`, or `auto`: a GPU if there is one.
        threads: of torch on a CPU; as many as torch is set to if left out.
        progress: called with the number of situations done since the last call.

    Returns:
        shares in the order of `kernels.branches.BRANCHES`; each row adds up to 1. shape (n, 8)

    Raises:
        ValueError: on situations of another shape or not finite, or on a device that is not there.
    """
    need("torch")
    import torch
    from torch.nn.functional import silu

    expect("network", network, BranchNetwork)
    asked = np.ascontiguousarray(situations, dtype=np.float64)
    if asked.ndim != 2 or asked.shape[1] != 4 or not np.isfinite(asked).all():
        raise ValueError("situations must have four finite columns: x, y, h and α.")
    place = device_of(device)
    layers = network.layers
    first, first_bias, hidden, hidden_bias, last, last_bias = (
        torch.from_numpy(array).to(place) for array in layers
    )
    chunk = CUDA_CHUNK if place.type == "cuda" else CHUNK
    shares = np.empty((len(asked), SIZE), np.float32)
    with torch.inference_mode(), _threads(threads):
        for start in range(0, len(asked), chunk):
            rows = asked[start : start + chunk]
            numbers = torch.from_numpy(features_of(canonical(rows))).to(place)
            a = silu(numbers @ first + first_bias)
            for weights, bias in zip(hidden, hidden_bias, strict=True):
                a = silu(a @ weights + bias)
            scores = a @ last[:, :SIZE] + last_bias[:SIZE]
            found = torch.softmax(scores, dim=1).cpu().numpy()
            right = lies_right(rows)
            found[right] = found[right][:, MIRROR_OF]
            shares[start : start + chunk] = found
            if progress is not None:
                progress(len(rows))
    return shares


@contextmanager
def _threads(number: int | None) -> Iterator[None]:
    """So many threads of torch, for a while."""
    import torch

    before = torch.get_num_threads()
    torch.set_num_threads(number or before)
    try:
        yield
    finally:
        torch.set_num_threads(before)
