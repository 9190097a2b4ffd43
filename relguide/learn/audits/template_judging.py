"""judge_template_chunk(ways, network, request, number) → TemplateJudged: networks against exact
answers.

Two sorts of fresh situations, with another seed than the training's: where the limit binds, drawn
as its labels are (`template_bound`), and as many whether it binds or not (`both_networks`).
"""

from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relguide.learn.audits.both_networks import Everywhere, judge_everywhere
from relguide.learn.audits.template_bound import Bound, judge_bound
from relguide.learn.boundary.template_labels import LimitRequest, limit_chunk
from relguide.learn.boundary.template_network import TemplateNetwork
from relguide.learn.training.chunks import gathered
from relguide.learn.words.branch_network import BranchNetwork


@dataclass(frozen=True, slots=True, kw_only=True)
class TemplateJudged:
    """Both."""

    bound: Bound
    everywhere: Everywhere


def template_request(ways: TemplateNetwork, count: int, seed: int) -> LimitRequest:
    """What situations to audit with, of each sort.

    Raises:
        ValueError: if they would be those of the training.
    """
    if seed == ways.about.get("dataset", {}).get("seed"):
        raise ValueError(f"The network has seen the situations of seed {seed}: use another.")
    return LimitRequest(count=count, seed=seed, box=ways.box)


def judged_templates(
    ways: TemplateNetwork, network: BranchNetwork, request: LimitRequest, executor: Executor
) -> Iterator[tuple[int, TemplateJudged]]:
    """Judge chunk by chunk, as they are ready; see `chunks.gathered`."""
    task = partial(judge_template_chunk, ways, network, request)
    return gathered(task, request.chunks, executor)


def judge_template_chunk(
    ways: TemplateNetwork, network: BranchNetwork, request: LimitRequest, number: int
) -> TemplateJudged:
    """Answer a chunk exactly and hold the networks against it; a function of its arguments."""
    labels = limit_chunk(request, number)
    rng = np.random.default_rng(np.random.SeedSequence(request.seed, spawn_key=(number, 1)))
    return TemplateJudged(
        bound=judge_bound(ways, labels.ways, labels.sources),
        everywhere=judge_everywhere(ways, network, request, rng, len(labels)),
    )


def joined_templates(chunks: Mapping[int, TemplateJudged]) -> TemplateJudged:
    """Chunks in order of their numbers."""
    parts = [chunks[number] for number in sorted(chunks)]
    return TemplateJudged(
        bound=Bound(**_columns([part.bound for part in parts])),
        everywhere=Everywhere(**_columns([part.everywhere for part in parts])),
    )


def _columns(parts: Sequence[Bound] | Sequence[Everywhere]) -> dict[str, NDArray[Any]]:
    """Their columns, one part below the other."""
    names = parts[0].__slots__
    return {name: np.concatenate([getattr(part, name) for part in parts]) for name in names}
