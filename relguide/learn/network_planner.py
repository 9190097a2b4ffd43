"""network_planner(network) → Planner: networks say what to solve, proofs say the rest.

    leader keeps straight, limit does not bind → the fastest extremal, which is solved to see that
    leader keeps straight, limit binds → template network → templates, solved next to their guesses
    leader turns → branch network → calibrated set of branches → their words, solved exactly
    any of them → certificate

Where the limit does not bind every answer is proved optimal: behind a leader that keeps straight
the fastest extremal is at hand before a network could be asked, and behind one that turns a branch
network is believed only if nothing is faster than what it leads to. Where the limit binds, the
template network is asked for a constrained path (see `template_paths`). The exact planner answers
whenever the networks cannot: a situation outside of what was trained, too large a set, no path
among those words or not the fastest, one that arrives before the slot opens, and above all a path
that does not keep d_min. So every answer is certified, whoever gave it.
"""

from dataclasses import dataclass, replace
from functools import cache
from math import hypot
from time import perf_counter_ns

import numpy as np

from relguide.kernels.contact.path_pieces import NO_TURN
from relguide.kernels.networks.branch_scores import choose
from relguide.kernels.words.extremals import MAX_ROWS, WORDS, solve_and_measure
from relguide.learn.boundary.template_network import TemplateNetwork, load_template_network
from relguide.learn.boundary.template_paths import free_path, solve_constrained, view
from relguide.learn.words.branch_network import BranchNetwork
from relguide.planning.candidate import SIGN_ROWS, Candidate, candidate_of, segments_of
from relguide.planning.certificate import Certificate, judge
from relguide.planning.deadline import LOADING, end_of, left_until
from relguide.planning.inputs import expect
from relguide.planning.levels import chooses_level
from relguide.planning.outcome import AS_FAST, NoPlan, Optimality, Plan, Planner
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.planning.slot import slot_frame
from relguide.planning.straight_ahead import first_candidate
from relguide.planning.tables import leader_path
from relguide.planning.words import HORIZON
from relguide.units import Metre, Second


@dataclass(frozen=True, slots=True, kw_only=True)
class NetworkPath:
    """What a network leads to, with its certificate."""

    candidate: Candidate
    """The fastest path of those it holds possible."""
    certificate: Certificate
    lower_bound: Second
    """No plan is faster: the time of the fastest extremal [s]."""

    @property
    def optimality(self) -> Optimality:
        """What is proved of it where it is certified."""
        time = self.candidate.time_to_converge
        return Optimality(
            proof="relaxation" if time <= self.lower_bound + AS_FAST else "bound",
            lower_bound=min(self.lower_bound, time),
        )


def network_planner(network: BranchNetwork, templates: TemplateNetwork | None = None) -> Planner:
    """A planner that asks networks what to solve, and otherwise the exact planner.

    A leader who turns is met on the final leg: the branch network sees a leader who has been on it
    all along, the certificate the real one. Where the limit binds then, the exact planner answers.

    Args:
        network: for the words to the slot behind a leader who turns.
        templates: for the constrained paths, where the limit binds; by default the network that
            comes with the program.

    Returns:
        a `Planner` that takes a `deadline` as `plan` does; its plans say by `planner` who gave
        them, and by `fell_back` if the networks could not.
    """
    expect("network", network, BranchNetwork)
    template_network = load_template_network() if templates is None else templates
    expect("templates", template_network, TemplateNetwork)

    @cache
    def load() -> None:
        for situation in LOADING:
            planner(situation)

    def planner(situation: Situation, *, deadline: Second | None = None) -> Plan | NoPlan:
        expect("situation", situation, Situation)
        if deadline is not None:
            load()
        until = end_of(deadline)
        started = perf_counter_ns()
        proposal = propose(network, situation, template_network)
        if proposal is None or not proposal.certificate.holds:
            exact = plan(situation, deadline=left_until(until))
            if isinstance(exact, NoPlan):
                return exact
            spent = (perf_counter_ns() - started) * 1e-6
            return replace(exact, fell_back=True, compute_time=spent)
        return Plan(
            situation=situation,
            trajectory=proposal.candidate.trajectory,
            word=proposal.candidate.word,
            certificate=proposal.certificate,
            optimality=proposal.optimality,
            planner="network",
            compute_time=(perf_counter_ns() - started) * 1e-6,
        )

    return planner


def propose(
    network: BranchNetwork, situation: Situation, templates: TemplateNetwork | None = None
) -> NetworkPath | None:
    """The fastest path that is known without the exact planner; `None` if there is none.

    Behind a leader who keeps straight that is the fastest extremal, and where it breaks the limit
    the constrained path of the template network, if there is one. Of a leader who turns, and in a
    cross wind, only the certificate knows whether the limit binds. Levels are the exact planner's.
    """
    if chooses_level(situation):
        return None
    radius = situation.pursuer.turn_radius
    if situation.leader.intent:
        return _propose_behind_turns(network, situation, radius)
    binds, place, free = view(situation, radius)
    if binds:
        if templates is None:
            return None
        around = solve_constrained(templates, situation, radius, place, free)
        unlimited = float(free[0]) * radius / situation.pursuer.tas
        return None if around is None else _with_certificate(around, situation, radius, unlimited)
    first = free_path(situation, radius, place, free) or first_candidate(situation, radius)
    return None if first is None else _with_certificate(first[0], situation, radius, first[1])


def _propose_behind_turns(
    network: BranchNetwork, situation: Situation, radius: Metre
) -> NetworkPath | None:
    """The fastest path of the words that the network holds possible, if no extremal is faster."""
    frame = slot_frame(situation, situation.leader.trajectory)
    x, y, h, alpha, t_release = frame.x, frame.y, frame.h, frame.alpha, frame.t_release
    box = network.box
    if not (hypot(x, y) <= box.max_range and box.min_ratio <= alpha <= box.max_ratio):
        return None
    rows = np.empty((MAX_ROWS, 5))
    _, found = choose(x, y, h, alpha, network.layers, network.least_share, network.most, rows)
    scale = radius / situation.pursuer.tas
    time, word, *amounts = rows[0].tolist()
    if found == 0 or time < t_release or time * scale > HORIZON:
        return None
    count, shortest = solve_and_measure(x, y, h, alpha, t_release, rows)
    # had another word been open before, it would be the exact planner's to find how to wait for it
    if count == 0 or shortest <= t_release + NO_TURN or (time - rows[0, 0]) * scale > AS_FAST:
        return None
    segments = segments_of(radius, SIGN_ROWS[int(word)], amounts)
    candidate = candidate_of(situation.pursuer, segments, WORDS[int(word)])
    return _with_certificate(candidate, situation, radius, float(rows[0, 0]) * scale)


def _with_certificate(
    candidate: Candidate, situation: Situation, radius: Metre, unlimited: Second
) -> NetworkPath:
    """With its certificate; the fastest extremal arrives at `unlimited` [s]."""
    return NetworkPath(
        candidate=candidate,
        certificate=judge(candidate.trajectory, situation, radius, leader_path(situation)),
        lower_bound=unlimited,
    )
