"""network_planner(network) → Planner: networks say what to solve, proofs say the rest.

    network → calibrated set of branches → their words, solved exactly → the fastest → certificate
    the limit binds → network of ways → kinds of ways round it, solved next to guesses → certificate

All roots of a word are found to their last digit, so there is nothing left to polish. Where the
fastest way does not keep d_min, another network is asked for the way round the limit (see
`template_paths`).
Whatever stands in the way leads to the exact planner: a situation outside of what was trained, a
set too large, no path among those words, one that arrives before the slot opens, and above all a
path that does not keep d_min. So every answer is certified, whoever gave it; a network can only
make an answer slower than the best, never unsafe.
"""

from dataclasses import dataclass, replace
from math import hypot
from time import perf_counter_ns

import numpy as np

from relguide.kernels.networks.branch_scores import choose
from relguide.kernels.words.branches import direct_time
from relguide.kernels.words.extremals import MAX_ROWS, WORDS
from relguide.learn.boundary.template_network import TemplateNetwork, load_template_network
from relguide.learn.boundary.template_paths import seen, solved
from relguide.learn.words.branch_network import BranchNetwork
from relguide.planning.certificate import Certificate, judge
from relguide.planning.inputs import expect
from relguide.planning.plan import NoPlan, Optimality, Plan, Planner, plan
from relguide.planning.situation import Situation
from relguide.planning.slot import slot_frame
from relguide.planning.tables import leader_bends
from relguide.planning.words import HORIZON, SIGN_ROWS, Candidate, candidate_of, segments_of
from relguide.units import Metre, Second


@dataclass(frozen=True, slots=True, kw_only=True)
class Proposal:
    """What a network leads to, judged."""

    candidate: Candidate
    """The fastest path of those it holds possible."""
    certificate: Certificate
    lower_bound: Second
    """No plan is faster: the time of a straight line to where the slot then is [s]."""


def network_planner(network: BranchNetwork, ways: TemplateNetwork | None = None) -> Planner:
    """A planner that asks networks what to solve, and the exact planner in need.

    A leader who turns is met on the final leg: the network of words sees a leader who has been on
    it all along, the certificate the real one. Where the limit binds then, the exact planner is
    asked.

    Args:
        network: for the words to the slot.
        ways: for the ways round the limit, where it binds; by default the one that comes with the
            program.

    Returns:
        a `Planner`; its plans say by `network_planner` who gave them, and by `fell_back` if the
        networks could not.
    """
    expect("network", network, BranchNetwork)
    round_limit = load_template_network() if ways is None else ways
    expect("ways", round_limit, TemplateNetwork)

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
    network: BranchNetwork, situation: Situation, ways: TemplateNetwork | None = None
) -> Proposal | None:
    """The fastest path of the words that the network holds possible; `None` if it cannot say.

    Where the limit binds and there is a network of ways: its way round the limit. Whether it does
    is told by the fastest way, which is found sooner than a network is asked. Of a leader who
    turns, and in a cross wind, only the certificate knows.
    """
    radius = situation.pursuer.turn_radius
    if situation.leader.intent:
        frame = slot_frame(situation, situation.leader.trajectory)
        where, t_release = (frame.x, frame.y, frame.h, frame.alpha), frame.t_release
    else:
        binds, soonest, place, free = seen(situation, radius)
        if ways is not None and binds:
            around = solved(ways, situation, radius, place, free)
            return None if around is None else _judged(around, situation, radius, soonest)
        x, y, h, _, alpha, _ = place
        where, t_release = (x, y, h, alpha), 0.0
    x, y, _, alpha = where
    box = network.box
    if not (hypot(x, y) <= box.max_range and box.min_ratio <= alpha <= box.max_ratio):
        return None
    rows = np.empty((MAX_ROWS, 5))
    _, found = choose(*where, network.layers, network.least_share, network.most, rows)
    time, word, *amounts = rows[0].tolist()
    # had another word been open before, it would be the exact planner's to find how to wait for it
    if found == 0 or time < t_release or time * radius / situation.pursuer.tas > HORIZON:
        return None
    segments = segments_of(radius, SIGN_ROWS[int(word)], amounts)
    candidate = candidate_of(situation.pursuer, segments, WORDS[int(word)])
    return _judged(candidate, situation, radius, max(direct_time(x, y, alpha), t_release))


def _judged(candidate: Candidate, situation: Situation, radius: Metre, least: float) -> Proposal:
    """With its certificate; no way arrives before `least` [R/V_P]."""
    return Proposal(
        candidate=candidate,
        certificate=judge(candidate.trajectory, situation, radius, leader_bends(situation)),
        lower_bound=least * radius / situation.pursuer.tas,
    )
