"""network_planner(network) → Planner: networks say what to solve, proofs say the rest.

    network → calibrated set of strategies → their words, solved exactly → the fastest → certificate
    the limit binds → network of ways → kinds of ways round it, solved next to guesses → certificate

All roots of a word are found to their last digit, so there is nothing left to polish. Where the
fastest way does not keep d_min, another network is asked for the way round the limit (see
`way_round`).
Whatever stands in the way leads to the exact planner: a situation outside of what was trained, a
set too large, no path among those words, one that arrives before the slot opens, and above all a
path that does not keep d_min. So every answer is certified, whoever gave it; a network can only
make an answer slower than the best, never unsafe.
"""

from dataclasses import dataclass, replace
from math import hypot
from time import perf_counter_ns

import numpy as np

from relguide.kernels.clearance import SLACK
from relguide.kernels.extremals import MAX_ROWS, WORDS
from relguide.kernels.limited import limit_binds
from relguide.kernels.network import choose
from relguide.kernels.strategies import direct_time
from relguide.learn.labels import Box
from relguide.learn.network import StrategyNetwork
from relguide.learn.way_network import WayNetwork, load_way_network
from relguide.learn.way_round import slot_ahead, way_round
from relguide.planning.certificate import Certificate, judge, kernel_arrays
from relguide.planning.inputs import expect
from relguide.planning.plan import NoPlan, Optimality, Plan, Planner, plan
from relguide.planning.situation import Situation
from relguide.planning.slot import SlotFrame, slot_frame
from relguide.planning.trajectory import Trajectory
from relguide.planning.words import HORIZON, SIGN_ROWS, Candidate, assemble
from relguide.units import Second


@dataclass(frozen=True, slots=True, kw_only=True)
class Proposal:
    """What a network leads to, judged."""

    candidate: Candidate
    """The fastest path of those it holds possible."""
    certificate: Certificate
    lower_bound: Second
    """No plan is faster: the time of a straight line to where the slot then is [s]."""


def network_planner(network: StrategyNetwork, ways: WayNetwork | None = None) -> Planner:
    """A planner that asks networks what to solve, and the exact planner in need.

    A leader who turns is met on the final leg: the network of words sees a leader who has been on
    it all along, the certificate the real one. Where the limit binds then, the exact planner is
    asked.

    Args:
        network: for the words to the slot.
        ways: for the ways round the limit, where it binds; by default the one that comes with the
            program.

    Returns:
        a `Planner`; its plans say by `planner` who gave them, and by `fell_back` if the networks
        could not.
    """
    expect("network", network, StrategyNetwork)
    round_limit = load_way_network() if ways is None else ways
    expect("ways", round_limit, WayNetwork)

    def planner(situation: Situation) -> Plan | NoPlan:
        expect("situation", situation, Situation)
        started = perf_counter_ns()
        proposal = propose(network, situation, round_limit)
        if proposal is None or not proposal.certificate.holds:
            exact = plan(situation)
            if isinstance(exact, NoPlan):
                return exact
            spent = (perf_counter_ns() - started) * 1e-6
            return replace(exact, fell_back=True, compute_time=spent)
        return Plan(
            situation=situation,
            trajectory=proposal.candidate.trajectory,
            word=proposal.candidate.word,
            certificate=proposal.certificate,
            optimality=Optimality(proof="bound", lower_bound=proposal.lower_bound),
            planner="network",
            compute_time=(perf_counter_ns() - started) * 1e-6,
        )

    return planner


def propose(
    network: StrategyNetwork, situation: Situation, ways: WayNetwork | None = None
) -> Proposal | None:
    """The fastest path of the words that the network holds possible; `None` if it cannot say.

    Where the limit binds and there is a network of ways: its way round the limit.
    """
    leader = situation.leader.trajectory
    frame = slot_frame(situation, leader)
    if ways is not None and _binds(situation, frame):
        return _round(ways, situation, frame, leader)
    if not _within(network.box, frame):
        return None
    rows = np.empty((MAX_ROWS, 5))
    _, found = choose(
        frame.x, frame.y, frame.h, frame.alpha,
        network.layers, network.least_share, network.most, rows,
    )  # fmt: skip
    time, word, *amounts = rows[0].tolist()
    scale = frame.radius / situation.pursuer.tas
    # had another word been open before, it would be the exact planner's to find how to wait for it
    if found == 0 or time < frame.t_open or time * scale > HORIZON:
        return None
    candidate = assemble(situation, frame, SIGN_ROWS[int(word)], amounts, WORDS[int(word)])
    return _judged(candidate, situation, frame, leader)


def _round(
    ways: WayNetwork, situation: Situation, frame: SlotFrame, leader: Trajectory
) -> Proposal | None:
    around = way_round(ways, situation, frame)
    return None if around is None else _judged(around, situation, frame, leader)


def _judged(
    candidate: Candidate, situation: Situation, frame: SlotFrame, leader: Trajectory
) -> Proposal:
    least = max(direct_time(frame.x, frame.y, frame.alpha), frame.t_open)
    return Proposal(
        candidate=candidate,
        certificate=judge(candidate.trajectory, situation, kernel_arrays(leader)),
        lower_bound=least * frame.radius / situation.pursuer.tas,
    )


def _binds(situation: Situation, frame: SlotFrame) -> bool:
    """Whether the limit binds behind a leader that keeps straight.

    That takes the fastest way, which is found sooner than a network is asked. Of a leader who
    turns, and in a cross wind, only the certificate knows.
    """
    slot = slot_ahead(situation, frame)
    if slot is None:
        return False
    limit = situation.min_separation / frame.radius - SLACK
    return limit_binds(frame.x, frame.y, frame.h, frame.alpha, slot, limit)


def _within(box: Box, frame: SlotFrame) -> bool:
    return (
        hypot(frame.x, frame.y) <= box.max_range and box.min_ratio <= frame.alpha <= box.max_ratio
    )
