"""compare(situation): what each of four planners would fly, what it costs, and where it fails.

    exact            all words solved, nothing is faster
    network          networks pick the words, which are solved
    regular_dp       the paper's tree picks them
    printed_network  the paper's network: what comes out is flown as it is, as the paper prints it

Each is shown with its own path, even one that may not be flown; in flight the exact plan then takes
its place. The planner that is asked first is asked twice: what is measured is no loading.
"""

from collections.abc import Callable, Collection, Iterator
from functools import cache
from time import perf_counter_ns
from typing import TypeVar, get_args

import numpy as np

from relguide.flying.cards import path_segments
from relguide.flying.verdicts import ComparedPlanner, PlannerVerdict
from relguide.learn.boundary.template_network import TemplateNetwork, load_template_network
from relguide.learn.network_planner import propose as ask_networks
from relguide.learn.tree.regular_network import (
    RegularNetwork,
    load_regular,
    regress_pairs,
    shipped_weights,
)
from relguide.learn.tree.regular_planner import propose as ask_tree
from relguide.learn.tree.regular_words import SIGN, pieces_of
from relguide.learn.words.branch_network import BranchNetwork, load_network
from relguide.planning.acceptance import find_fault
from relguide.planning.candidate import Candidate, assemble
from relguide.planning.certificate import certify, lost_to
from relguide.planning.inputs import expect
from relguide.planning.levels import is_at_level
from relguide.planning.outcome import AS_FAST, NoPlan, Plan
from relguide.planning.phrases import distance, duration, too_close, too_close_to
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.planning.slot import slot_frame
from relguide.units import KT, Millisecond, Second

T = TypeVar("T")
COMPARED: tuple[ComparedPlanner, ...] = get_args(ComparedPlanner)
"""In the order they are shown."""
ALIKE = 0.01
"""By so much of itself V_L/V_P, D/R or d_min/R may differ from what the printed network learnt."""
NOTHING: dict[ComparedPlanner, str] = {
    "network": "The networks are in doubt or were not trained for this: the exact planner answers.",
    "regular_dp": "The tree knows no word from here that joins: the exact planner answers.",
    "printed_network": "It gives no path.",
}
"""Of a planner that hands over."""


def compare(
    situation: Situation,
    *,
    among: Collection[ComparedPlanner] = COMPARED,
    deadline: Second | None = None,
) -> list[PlannerVerdict]:
    """What each planner would fly.

    Args:
        situation: what to plan.
        among: the planners to ask; the exact one is asked in any case.
        deadline: of the exact plan [s].
    """
    expect("situation", situation, Situation)
    best, spent = _timed(lambda: plan(situation, deadline=deadline))
    found = [_exact(best, spent)] if "exact" in among else []
    ways: dict[ComparedPlanner, Callable[[], Candidate | None]] = {
        "network": lambda: _by_networks(situation),
        "regular_dp": lambda: _by_tree(situation),
        "printed_network": lambda: _as_printed(_printed(), situation),
    }
    for name, ask in ways.items():
        if name in among:
            candidate, spent = _timed(ask)
            found.append(_judge(name, candidate, situation, best, spent))
    return found


def _timed(ask: Callable[[], T]) -> tuple[T, Millisecond]:
    """What is answered, and how long that takes once all that it needs is loaded [ms]."""
    ask()
    began = perf_counter_ns()
    answer = ask()
    return answer, (perf_counter_ns() - began) * 1e-6


def _by_networks(situation: Situation) -> Candidate | None:
    proposal = ask_networks(_network(), situation, _templates())
    return None if proposal is None else proposal.candidate


def _by_tree(situation: Situation) -> Candidate | None:
    """The first of its paths that may be flown, or else the first."""
    paths = list[Candidate]()
    for candidate in ask_tree(situation):
        if certify(candidate.trajectory, situation).holds:
            return candidate
        paths.append(candidate)
    return paths[0] if paths else None


def _as_printed(network: RegularNetwork, situation: Situation) -> Candidate:
    """What the paper's network gives, flown as it is: nothing holds its end in the slot."""
    frame = slot_frame(situation, situation.leader.trajectory)
    state = (np.array([value]) for value in (frame.x, frame.y, frame.h))
    pieces = pieces_of(regress_pairs(network, *state)[0].tolist())
    signs, amounts = [SIGN[letter] for letter, _ in pieces], [amount for _, amount in pieces]
    return assemble(situation, frame, signs, amounts, "")


def _exact(best: Plan | NoPlan, spent: Millisecond) -> PlannerVerdict:
    if isinstance(best, NoPlan):
        return PlannerVerdict(
            planner="exact", status="no_plan", message=best.message, compute=spent
        )
    over = best.time_to_converge - best.optimality.lower_bound
    proved = best.optimality.proof in ("relaxation", "certified")
    message = "Nothing is faster." if proved else f"At most {duration(over)} above the optimum."
    return PlannerVerdict(
        planner="exact",
        status="planned",
        message=message,
        word=best.word,
        time_to_converge=best.time_to_converge,
        least=best.certificate.least_separation,
        compute=spent,
        segments=path_segments(best.trajectory, wind=best.situation.wind),
    )


def _judge(
    name: ComparedPlanner,
    candidate: Candidate | None,
    situation: Situation,
    best: Plan | NoPlan,
    spent: Millisecond,
) -> PlannerVerdict:
    """A path, whoever made it, by the conditions that all plans are held to."""
    if candidate is None:
        message = NOTHING[name]
        return PlannerVerdict(planner=name, status="handed_over", message=message, compute=spent)
    trajectory = candidate.trajectory
    certificate = certify(trajectory, situation)
    over = 0.0
    if isinstance(best, Plan):
        over = candidate.time_to_converge - best.time_to_converge
    faults = list[str]()
    if (fault := find_fault(trajectory, situation)) is not None:
        faults.append(fault[1])
    if not is_at_level(situation, candidate.time_to_converge):
        faults.append("it ends at another level than the leader's")
    if not certificate.holds:
        lost = lost_to(certificate)
        close = f"{too_close(certificate.least_separation, situation.min_separation)} of the leader"
        if lost is not None:
            close = too_close_to(lost.ident, lost.least_separation, lost.min_separation)
        faults.append(f"it comes {close}")
    if name == "printed_network" and faults:
        faults += _unlike(_printed(), situation, best)
    if faults:
        message = f"Not flown: {'; '.join(faults)}."
    elif over > AS_FAST:
        message = f"Certified; {duration(over)} slower than the exact plan."
    else:
        message = "Certified; as fast as the exact plan."
    return PlannerVerdict(
        planner=name,
        status="refused" if faults else "planned",
        message=message,
        word=candidate.word,
        time_to_converge=candidate.time_to_converge,
        over_exact=over,
        least=certificate.least_separation,
        compute=spent,
        segments=path_segments(trajectory, wind=situation.wind),
    )


def _unlike(network: RegularNetwork, situation: Situation, best: Plan | NoPlan) -> Iterator[str]:
    """What of a situation the printed network did not learn."""
    learnt, pursuer = network.parameters.encounter, situation.pursuer
    horizon, scale = network.parameters.horizon, learnt.turn_radius / pursuer.turn_radius
    alike = (
        (learnt.speed_ratio, situation.leader.tas / pursuer.tas),
        (learnt.slot_distance, situation.slot_distance * scale),
        (learnt.min_separation, situation.min_separation * scale),
    )
    if any(abs(here - there) > ALIKE * there for there, here in alike):
        yield (
            f"it learnt one encounter, {learnt.leader_tas / KT:.0f} kt ahead of "
            f"{learnt.pursuer_tas / KT:.0f} kt with D {distance(learnt.slot_distance)}"
        )
    if isinstance(best, Plan) and best.time_to_converge > horizon:
        yield f"it learnt joins within {horizon / 60.0:.0f} min"


@cache
def _network() -> BranchNetwork:
    return load_network()


@cache
def _templates() -> TemplateNetwork:
    return load_template_network()


@cache
def _printed() -> RegularNetwork:
    return load_regular(shipped_weights("paper"))
