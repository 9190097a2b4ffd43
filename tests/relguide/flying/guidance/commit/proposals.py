"""Proposals that tests look at."""

from dataclasses import replace

from relguide.flying.guidance.commit.committed import Committed
from relguide.flying.guidance.commit.proposal import Proposal
from relguide.flying.guidance.commit.propose import propose
from relguide.planning.outcome import Planner
from relguide.planning.plan import plan
from relguide.planning.wind import wind_from
from relguide.units import DEG
from tests.relguide.flying.guidance.beliefs import FIG_6B, Watched, observe

WINDY = replace(FIG_6B, situation=replace(FIG_6B.situation, wind=wind_from(300.0 * DEG, 30.0)))


def committed_at(watched: Watched, committed: Committed | None = None) -> Proposal:
    found = propose(watched.belief, watched.assignment, committed, plan)
    assert isinstance(found, Proposal)
    return found


def propose_with(planner: Planner = plan) -> Proposal:
    found = propose(*observe(FIG_6B), None, planner)
    assert isinstance(found, Proposal)
    return found
