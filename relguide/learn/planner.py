"""network_planner(network) → Planner: the network says which words to solve, proofs say the rest.

    network → calibrated set of strategies → their words, solved exactly → the fastest → certificate

All roots of a word are found to their last digit, so there is nothing left to polish. Whatever
stands in the way leads to the exact planner: a situation outside the box the network was trained
in, a set too large, no path among those words, one that arrives before the slot opens, and above
all a path that does not keep d_min. So every answer is certified, whoever gave it; the network can
only make an answer slower than the best, never unsafe.

Ways that touch or ride along d_min are not learnt: where the limit binds, the search of `plan` is
asked, and the network has cost its 10 µs.
"""

from dataclasses import dataclass, replace
from math import hypot
from time import perf_counter_ns

import numpy as np

from relguide.kernels.extremals import MAX_ROWS, WORDS
from relguide.kernels.network import choose
from relguide.kernels.strategies import direct_time
from relguide.learn.labels import Box
from relguide.learn.network import StrategyNetwork
from relguide.planning.certificate import Certificate, certify
from relguide.planning.inputs import expect
from relguide.planning.plan import NoPlan, Optimality, Plan, Planner, plan
from relguide.planning.situation import Situation
from relguide.planning.slot import SlotFrame, slot_frame
from relguide.planning.words import HORIZON, SIGN_ROWS, Candidate, assemble
from relguide.units import Second


@dataclass(frozen=True, slots=True, kw_only=True)
class Proposal:
    """What the network's words lead to, judged."""

    candidate: Candidate
    """The fastest of them."""
    certificate: Certificate
    lower_bound: Second
    """No plan is faster: the time of a straight line to where the slot then is [s]."""


def network_planner(network: StrategyNetwork) -> Planner:
    """A planner that asks a network which words to solve, and the exact planner in need.

    A leader who turns is met on the final leg: the network sees a leader who has been on it all
    along, the certificate the real one.

    Returns:
        a `Planner`; its plans say by `planner` who gave them, and by `fell_back` if the network
        could not.
    """
    expect("network", network, StrategyNetwork)

    def planner(situation: Situation) -> Plan | NoPlan:
        expect("situation", situation, Situation)
        started = perf_counter_ns()
        proposal = propose(network, situation)
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


def propose(network: StrategyNetwork, situation: Situation) -> Proposal | None:
    """The fastest path of the words that the network holds possible; `None` if it cannot say."""
    frame = slot_frame(situation, situation.leader.trajectory)
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
    least = max(direct_time(frame.x, frame.y, frame.alpha), frame.t_open)
    return Proposal(
        candidate=candidate,
        certificate=certify(candidate.trajectory, situation),
        lower_bound=least * scale,
    )


def _within(box: Box, frame: SlotFrame) -> bool:
    return (
        hypot(frame.x, frame.y) <= box.max_range and box.min_ratio <= frame.alpha <= box.max_ratio
    )
