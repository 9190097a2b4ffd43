"""judge_planner(…) → PlannerVerdicts: both networks, whether the limit binds or not.

Situations are drawn as the source `far` of the labels is, of speeds and places that both networks
are for; in most the limit does not bind. There the branch network names what is fastest, and where
it binds, the template network does. And the planner by networks is asked as in flight, with the
certificate.
"""

from dataclasses import dataclass, replace
from math import inf

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.base.turn import bank_for_turn_radius
from relguide.kernels.contact.constrained_rows import limit_binds_rows
from relguide.kernels.networks.branch_scores import judge_branches
from relguide.kernels.words.branches import SIZE
from relguide.learn.audits.constrained_judging import judge_constrained
from relguide.learn.boundary.template_labels import (
    DRAWN,
    ConstrainedPaths,
    Floats,
    TemplateBox,
    TemplateLabelRequest,
    answers_of,
    draw_situations,
)
from relguide.learn.boundary.template_network import TemplateNetwork
from relguide.learn.network_planner import propose
from relguide.learn.words.branch_labels import times_of
from relguide.learn.words.branch_network import BranchNetwork
from relguide.learn.words.train_branches import NEAR
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.situation import Situation
from relguide.planning.words import HORIZON
from relguide.units import MetrePerSecond, Second

UNIT: Second = 40.0
"""R/V_P of the airliner that the planner is asked about, and in whose seconds delays are given."""
TAS: MetrePerSecond = 200.0
"""Its V_P; it turns at 27° of bank then."""
FAR = 2
"""The source that situations everywhere are drawn as: its number."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannerVerdicts:
    """What is found of situations whether the limit binds or not, as columns."""

    binds: NDArray[np.bool_]
    """Whether it does."""
    named: NDArray[np.bool_]
    """Whether the first choice of the network that is for it, solved, is the fastest path."""
    exact: Floats
    """When the fastest path arrives [R/V_P]; infinite if none does within `HORIZON`."""
    given: Floats
    """When the planner by networks does [R/V_P]; infinite if it asks the exact planner."""

    def __len__(self) -> int:
        return len(self.binds)


def judge_planner(
    templates: TemplateNetwork,
    network: BranchNetwork,
    request: TemplateLabelRequest,
    rng: np.random.Generator,
    size: int,
) -> PlannerVerdicts:
    """Draw situations that both networks are for, answer them exactly, and ask.

    Args:
        templates: where the limit binds.
        network: where it does not.
        request: gives the box.
        rng: the source of chance.
        size: how many.
    """
    box = _common_box(request.box, network)
    situations = np.empty((0, 6))
    while len(situations) < size:
        drawn = draw_situations(rng, box, FAR, DRAWN)
        near = np.hypot(drawn[:, 0], drawn[:, 1]) <= network.box.max_range
        situations = np.concatenate((situations, drawn[near]))
    situations = situations[:size]
    answer = np.empty(size)
    limit_binds_rows(situations, answer)
    binds = answer == 1.0
    named, exact = np.empty(size, dtype=bool), np.empty(size)
    named[~binds], exact[~binds] = _judge_first_choice(network, situations[~binds, :4])
    times, counts, legs = answers_of(situations[binds])
    there = np.ascontiguousarray(times[:, 2])
    found = judge_constrained(
        templates,
        ConstrainedPaths(situations[binds], there, counts, legs),
        np.full(len(there), FAR, dtype=np.int8),
    )
    named[binds], exact[binds] = found.named, found.exact
    exact[exact * UNIT > HORIZON] = inf
    given = np.array([_planned_time(templates, network, row) for row in situations])
    return PlannerVerdicts(binds=binds, named=named, exact=exact, given=given)


def _judge_first_choice(
    network: BranchNetwork, situations: Floats
) -> tuple[NDArray[np.bool_], Floats]:
    """Whether the first choice is the fastest branch, and when that arrives [R/V_P]."""
    n = len(situations)
    rows = np.ascontiguousarray(situations)
    scores, decoded = np.empty((n, 3, SIZE)), np.empty((n, 3))
    judge_branches(rows, network.layers, network.least_share, network.most, scores, decoded)
    times = times_of(rows)
    first = np.take_along_axis(times, scores[:, 0].argmax(axis=1)[:, None], axis=1)[:, 0]
    return first <= times.min(axis=1) * (1.0 + NEAR), times.min(axis=1)


def _planned_time(templates: TemplateNetwork, network: BranchNetwork, row: Floats) -> float:
    """When the path arrives that the networks lead to, if it is certified [R/V_P]."""
    proposal = propose(network, situation_of(row), templates)
    if proposal is None or not proposal.certificate.holds:
        return inf
    return proposal.candidate.trajectory.duration / UNIT


def situation_of(row: Floats) -> Situation:
    """An airliner there: the leader at the origin, on heading north."""
    x, y, h, alpha, slot, limit = row.tolist()
    bank = bank_for_turn_radius(TAS, TAS * UNIT)
    radius = TAS * UNIT
    return Situation(
        pursuer=Pursuer(
            x=-y * radius, y=(x - slot) * radius, heading=-h, tas=TAS, max_bank=bank
        ),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=alpha * TAS),
        slot_distance=slot * radius,
        min_separation=limit * radius,
    )  # fmt: skip


def _common_box(box: TemplateBox, network: BranchNetwork) -> TemplateBox:
    """Speeds that both networks know."""
    return replace(
        box,
        min_ratio=max(box.min_ratio, network.box.min_ratio),
        max_ratio=min(box.max_ratio, network.box.max_ratio),
    )
