"""network_planner(network) → Planner: networks say what to solve, proofs say the rest.

    branch network → calibrated set of branches → their words, solved exactly → the fastest
    d_min binds → template network → templates, solved next to their guesses → the fastest
    either → certificate

All roots of a word are found to their last digit, so nothing is left to polish. Where the fastest
path does not keep d_min, the template network is asked for a constrained path (see
`template_paths`). The exact planner answers whenever the networks cannot: a situation outside of
what was trained, too large a set, no path among those words, one that arrives before the slot
opens, and above all a path that does not keep d_min. So every answer is certified, whoever gave
it; a network can only make an answer slower than the best, never unsafe.
"""

from dataclasses import dataclass, replace
from math import hypot, inf
from time import perf_counter_ns

import numpy as np

from relguide.kernels.networks.branch_scores import choose
from relguide.kernels.words.branches import direct_time
from relguide.kernels.words.extremals import MAX_ROWS, WORDS
from relguide.learn.boundary.template_network import TemplateNetwork, load_template_network
from relguide.learn.boundary.template_paths import solve_constrained, view
from relguide.learn.words.branch_network import BranchNetwork
from relguide.planning.candidate import SIGN_ROWS, Candidate, candidate_of, segments_of
from relguide.planning.certificate import Certificate, judge
from relguide.planning.inputs import expect
from relguide.planning.plan import NoPlan, Optimality, Plan, Planner, plan
from relguide.planning.situation import Situation
from relguide.planning.slot import slot_frame
from relguide.planning.tables import leader_path
from relguide.planning.words import HORIZON
from relguide.units import Metre, Second


@dataclass(frozen=True, slots=True, kw_only=True)
class Proposal:
    """What a network leads to, with its certificate."""

    candidate: Candidate
    """The fastest path of those it holds possible."""
    certificate: Certificate
    lower_bound: Second
    """No plan is faster: the time of a straight line to where the slot then is [s]."""


def network_planner(network: BranchNetwork, templates: TemplateNetwork | None = None) -> Planner:
    """A planner that asks networks what to solve, and otherwise the exact planner.

    A leader who turns is met on the final leg: the branch network sees a leader who has been on it
    all along, the certificate the real one. Where the limit binds then, the exact planner answers.

    Args:
        network: for the words to the slot.
        templates: for the constrained paths, where the limit binds; by default the network that
            comes with the program.

    Returns:
        a `Planner`; its plans say by `network_planner` who gave them, and by `fell_back` if the
        networks could not.
    """
    expect("network", network, BranchNetwork)
    template_network = load_template_network() if templates is None else templates
    expect("templates", template_network, TemplateNetwork)

    def planner(situation: Situation) -> Plan | NoPlan:
        expect("situation", situation, Situation)
        started = perf_counter_ns()
        proposal = propose(network, situation, template_network)
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
    network: BranchNetwork, situation: Situation, templates: TemplateNetwork | None = None
) -> Proposal | None:
    """The fastest path of the words that the network holds possible; `None` if it cannot say.

    Where the limit binds and there is a template network: its constrained path. Whether the limit
    binds is seen from the fastest path, which is found sooner than a network is asked. Of a leader
    who turns, and in a cross wind, only the certificate knows.
    """
    radius = situation.pursuer.turn_radius
    if situation.leader.intent:
        frame = slot_frame(situation, situation.leader.trajectory)
        x, y, h, alpha, t_release = frame.x, frame.y, frame.h, frame.alpha, frame.t_release
        soonest = direct_time(x, y, alpha) if alpha < 1.0 else inf
    else:
        binds, soonest, place, free = view(situation, radius)
        if templates is not None and binds:
            around = solve_constrained(templates, situation, radius, place, free)
            return None if around is None else _with_certificate(around, situation, radius, soonest)
        x, y, h, _, alpha, _ = place
        t_release = 0.0
    box = network.box
    if not (hypot(x, y) <= box.max_range and box.min_ratio <= alpha <= box.max_ratio):
        return None
    rows = np.empty((MAX_ROWS, 5))
    _, found = choose(x, y, h, alpha, network.layers, network.least_share, network.most, rows)
    time, word, *amounts = rows[0].tolist()
    # had another word been open before, it would be the exact planner's to find how to wait for it
    if found == 0 or time < t_release or time * radius / situation.pursuer.tas > HORIZON:
        return None
    segments = segments_of(radius, SIGN_ROWS[int(word)], amounts)
    candidate = candidate_of(situation.pursuer, segments, WORDS[int(word)])
    return _with_certificate(candidate, situation, radius, max(soonest, t_release))


def _with_certificate(
    candidate: Candidate, situation: Situation, radius: Metre, least: float
) -> Proposal:
    """With its certificate; no path arrives before `least` [R/V_P]."""
    return Proposal(
        candidate=candidate,
        certificate=judge(candidate.trajectory, situation, radius, leader_path(situation)),
        lower_bound=least * radius / situation.pursuer.tas,
    )
