"""judge_template_chunk(…) → TemplateVerdicts: networks held against exact answers.

Two sorts of fresh situations, with another seed than the training's: where the limit binds, drawn
as its labels are (`constrained_judging`), and as many whether it binds or not (`planner_judging`).
"""

from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relguide.learn.audits.constrained_judging import ConstrainedVerdicts, judge_constrained
from relguide.learn.audits.planner_judging import PlannerVerdicts, judge_planner
from relguide.learn.boundary.template_labels import TemplateLabelRequest, template_label_chunk
from relguide.learn.boundary.template_network import TemplateNetwork
from relguide.learn.training.chunks import gather
from relguide.learn.words.branch_network import BranchNetwork


@dataclass(frozen=True, slots=True, kw_only=True)
class TemplateVerdicts:
    """Both."""

    bound: ConstrainedVerdicts
    everywhere: PlannerVerdicts


def template_audit_request(
    templates: TemplateNetwork, count: int, seed: int
) -> TemplateLabelRequest:
    """What situations to audit with, of each sort.

    Raises:
        ValueError: if they would be those of the training.
    """
    if seed == templates.about.get("dataset", {}).get("seed"):
        raise ValueError(f"The network has seen the situations of seed {seed}: use another.")
    return TemplateLabelRequest(count=count, seed=seed, box=templates.box)


def judge_template_chunks(
    templates: TemplateNetwork,
    network: BranchNetwork,
    request: TemplateLabelRequest,
    executor: Executor,
) -> Iterator[tuple[int, TemplateVerdicts]]:
    """Judge chunk by chunk, as they are ready; see `chunks.gather`."""
    task = partial(judge_template_chunk, templates, network, request)
    return gather(task, request.chunks, executor)


def judge_template_chunk(
    templates: TemplateNetwork, network: BranchNetwork, request: TemplateLabelRequest, number: int
) -> TemplateVerdicts:
    """Answer a chunk exactly and hold the networks against it; a function of its arguments."""
    labels = template_label_chunk(request, number)
    rng = np.random.default_rng(np.random.SeedSequence(request.seed, spawn_key=(number, 1)))
    return TemplateVerdicts(
        bound=judge_constrained(templates, labels.paths, labels.sources),
        everywhere=judge_planner(templates, network, request, rng, len(labels)),
    )


def join_template_verdicts(chunks: Mapping[int, TemplateVerdicts]) -> TemplateVerdicts:
    """Chunks in order of their numbers."""
    parts = [chunks[number] for number in sorted(chunks)]
    return TemplateVerdicts(
        bound=ConstrainedVerdicts(**_columns([part.bound for part in parts])),
        everywhere=PlannerVerdicts(**_columns([part.everywhere for part in parts])),
    )


def _columns(
    parts: Sequence[ConstrainedVerdicts] | Sequence[PlannerVerdicts],
) -> dict[str, NDArray[Any]]:
    """Their columns, one part below the other."""
    names = parts[0].__slots__
    return {name: np.concatenate([getattr(part, name) for part in parts]) for name in names}
