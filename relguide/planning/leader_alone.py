"""The plan for the leader alone: the fastest candidate that keeps d_min, and what proves it."""

from collections.abc import Iterator
from itertools import islice
from math import hypot, inf
from time import perf_counter_ns

from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.separation.clearance import SLACK
from relguide.planning.amid import (
    around,
)
from relguide.planning.at_release import first_at_release
from relguide.planning.candidate import Candidate
from relguide.planning.certificate import Certificate, judge
from relguide.planning.constrained_path import constrained_path
from relguide.planning.deadline import TO_LOOK_ROUND, TO_PUT_DOWN
from relguide.planning.heights import ALWAYS, counted, heights_of
from relguide.planning.least_bad import (
    least_bad,
    least_bad_sentence,
    restore,
    restore_sentence,
)
from relguide.planning.outcome import AS_FAST, NoPlan, Optimality, Plan, Proof, Reason
from relguide.planning.phrases import distance
from relguide.planning.situation import Situation
from relguide.planning.straight_ahead import first_candidate
from relguide.planning.tables import leader_path, path_of
from relguide.planning.wind import CALM
from relguide.planning.words import HORIZON, Candidates, candidates
from relguide.units import KT, Metre, Second

Chosen = tuple[Candidate, Certificate, Optimality]
"""A path, its certificate, and what is proved of its time."""


def plan_alone(situation: Situation, until: float) -> Plan | NoPlan:
    """`plan` without others, where the pursuer's level is settled.

    Args:
        situation: what to plan.
        until: when to end, by `clock.now` [s].
    """
    started = perf_counter_ns()
    radius = situation.pursuer.turn_radius
    separation = _separation(situation)
    if separation < situation.min_separation - SLACK * radius and _counts_now(situation):
        lost = (
            f"The aircraft are {separation:,.0f} m ({distance(separation)}) apart, closer "
            f"than the minimum of {situation.min_separation:,.0f} m."
        )
        if not time_is_up(until - TO_LOOK_ROUND):
            lost += f" {restore_sentence(restore(situation))}"
        return NoPlan(reason=Reason.SEPARATION_ALREADY_LOST, message=lost)
    chosen = _plan_at_once(situation, radius) or _search(situation, radius, until)
    return chosen if isinstance(chosen, NoPlan) else plan_of(chosen, situation, started)


def plan_alone_at_once(situation: Situation) -> Plan | NoPlan | None:
    """`plan_at_once` without others, where the pursuer's level is settled."""
    started = perf_counter_ns()
    radius = situation.pursuer.turn_radius
    if _separation(situation) < situation.min_separation - SLACK * radius and _counts_now(
        situation
    ):
        return None
    chosen = _plan_at_once(situation, radius)
    if chosen is None:
        found = candidates(situation)
        beyond = _out_of_reach(found, situation)
        if beyond is not None:
            return beyond
        chosen = _fastest_extremal(found, situation, radius, path_of(found.leader), inf)
    return None if chosen is None else plan_of(chosen, situation, started)


def _separation(situation: Situation) -> Metre:
    """Between the two aircraft now [m]."""
    pursuer, leader = situation.pursuer, situation.leader
    return hypot(pursuer.x - leader.x, pursuer.y - leader.y)


def _counts_now(situation: Situation) -> bool:
    """Whether the horizontal minimum counts at t = 0."""
    when = counted(heights_of(situation.pursuer), heights_of(situation.leader))
    return when == ALWAYS or (when != () and when[0][0] <= 0.0)


def relaxed(candidate: Candidate, bound: Second) -> Optimality:
    """What the bound of a relaxed problem proves of a path."""
    time = candidate.time_to_converge
    proof: Proof = "relaxation" if time <= bound + AS_FAST else "bound"
    return Optimality(proof=proof, lower_bound=min(bound, time))


def plan_of(chosen: Chosen, situation: Situation, started: int) -> Plan:
    """A path that was chosen as a plan; `started` by `perf_counter_ns`."""
    candidate, certificate, optimality = chosen
    return Plan(
        situation=situation,
        trajectory=candidate.trajectory,
        word=candidate.word,
        certificate=certificate,
        optimality=optimality,
        planner="exact",
        compute_time=(perf_counter_ns() - started) * 1e-6,
    )


def _plan_at_once(situation: Situation, radius: Metre) -> Chosen | None:
    """The fastest extremal to an open slot, or a path just as it opens, if it keeps d_min."""
    leading = leader_path(situation)
    first = first_candidate(situation, radius) or first_at_release(situation, radius, leading)
    if first is None:
        return None
    candidate, time = first
    certificate = judge(candidate.trajectory, situation, radius, leading)
    if not certificate.holds:
        return None
    return candidate, certificate, Optimality(proof="relaxation", lower_bound=time)


def _search(situation: Situation, radius: Metre, until: float) -> Chosen | NoPlan:
    """The fastest of all extremals and of all paths that touch d_min, or why there is none."""
    found = candidates(situation)
    beyond = _out_of_reach(found, situation)
    if beyond is not None:
        return beyond
    chosen, cut_short = _find_certified(found, situation, radius, until)
    if chosen is not None:
        return chosen
    if cut_short:
        return NoPlan(
            reason=Reason.DEADLINE,
            message="No path that keeps the minimum separation was found by the deadline; none is "
            f"faster than {found.bound:.0f} s. A later deadline may help.",
            lower_bound=found.bound,
        )
    return NoPlan(
        reason=Reason.SEPARATION_UNAVOIDABLE,
        message=f"Each of the {len(found)} direct trajectories to the slot comes closer "
        f"than {distance(situation.min_separation)} to the leader, and "
        f"{_why_none_round(situation)} {least_bad_sentence(least_bad(situation))}",
        lower_bound=found.bound,
    )


def _out_of_reach(found: Candidates, situation: Situation) -> NoPlan | None:
    """That the slot is never reached, or too late; `None` if it is in time."""
    if not found:
        return NoPlan(reason=Reason.SLOT_UNREACHABLE, message=_unreachable(situation))
    if found.bound > HORIZON:
        return NoPlan(
            reason=Reason.BEYOND_HORIZON,
            message=f"The slot is reached only after {found.bound / 3600.0:,.0f} h, beyond the "
            f"horizon of {HORIZON / 3600.0:.0f} h: a larger speed difference helps.",
            lower_bound=found.bound,
        )
    return None


def _why_none_round(situation: Situation) -> str:
    """Why no path round the leader is known.

    Into the slot of a leader that is faster the pursuer falls back, from less than D. With equal
    speeds, let h be the heading from the leader's, and s the time to go: it comes from y = ∫h to
    the side and x = ∫h²/2 ahead, to second order, so d ≥ D asks for (∫h)² ≥ D ∫h². But (∫h)² is at
    most s ∫h², by Cauchy and Schwarz.
    """
    pursuer, leader = situation.pursuer, situation.leader
    if (
        leader.tas >= pursuer.tas
        and situation.slot_distance <= situation.min_separation
        and situation.wind == CALM
    ):
        return (
            "no path does otherwise: a pursuer that is no faster falls back into the slot from "
            "nearer the leader, so the slot distance must be more than the minimum separation."
        )
    return "no path round it was found."


def _find_certified(
    found: Candidates, situation: Situation, radius: Metre, until: float
) -> tuple[Chosen | None, bool]:
    """The fastest candidate that certifies, and whether the search was cut short."""
    bound, leading = found.bound, path_of(found.leader)
    fastest = _fastest_extremal(found, situation, radius, leading, until)
    if fastest is not None:
        return fastest, False
    chosen: tuple[Candidate, Certificate] | None = None
    refused = 0 if found.reachable_at_release else 1
    for candidate in islice(found.later, refused, None):
        if time_is_up(until):
            break
        certificate = judge(candidate.trajectory, situation, radius, leading)
        if certificate.holds:
            chosen = candidate, certificate
            break
    beat = chosen[0].time_to_converge if chosen else HORIZON
    touching, cut_short = constrained_path(found, beat=beat, until=until - TO_PUT_DOWN)
    if touching is not None:
        certificate = judge(touching.trajectory, situation, radius, leading)
        if certificate.holds:
            chosen = touching, certificate
    if counted(heights_of(situation.pursuer), heights_of(situation.leader)) != ALWAYS:
        # where height keeps them apart for a while, paths may pass through the disc meanwhile
        passing = around(situation, until - TO_PUT_DOWN)
        if passing and (chosen is None or passing[0].time_to_converge < chosen[0].time_to_converge):
            chosen = passing
    if chosen is None:
        return None, cut_short
    # a path that touches d_min and arrives as the slot opens is as fast as any without the limit
    return (*chosen, relaxed(chosen[0], bound)), cut_short


def _fastest_extremal(
    found: Candidates, situation: Situation, radius: Metre, leading: FloatArray, until: float
) -> Chosen | None:
    """The fastest of all extremals, if it keeps d_min."""
    fastest = found.at_release if found.reachable_at_release else islice(found.later, 1)
    best = _canonical(fastest, situation, radius, leading, until)
    if best is None:
        return None
    return *best, Optimality(proof="relaxation", lower_bound=found.bound)


def _canonical(
    equally_fast: Iterator[Candidate],
    situation: Situation,
    radius: Metre,
    leading: FloatArray,
    until: float,
) -> tuple[Candidate, Certificate] | None:
    """The best of equally fast candidates: fewest turns, then separation, then least turning."""
    best: tuple[Candidate, Certificate] | None = None
    for candidate in equally_fast:
        if best is not None and candidate.trajectory.turns > best[0].trajectory.turns:
            break
        if time_is_up(until):
            break
        certificate = judge(candidate.trajectory, situation, radius, leading)
        # 1 m: separations this close count as equal, and the one with less turning stays
        if certificate.holds and (
            best is None or certificate.least_separation > best[1].least_separation + 1.0
        ):
            best = candidate, certificate
    return best


def _unreachable(situation: Situation) -> str:
    pursuer, leader = situation.pursuer.tas / KT, situation.leader.tas / KT
    return (
        f"The leader flies {leader:.0f} kt and the pursuer {pursuer:.0f} kt, and from here the "
        "slot cannot be caught: a pursuer faster than the leader always can."
    )
