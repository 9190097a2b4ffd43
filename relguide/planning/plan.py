"""plan(situation) → Plan | NoPlan: the fastest candidate that certifies, and what is proved."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import islice
from math import inf
from time import perf_counter_ns

from relguide.kernels.base.clock import time_is_up
from relguide.planning.amid import (
    MOST_TRIED,
    around,
    just_as_it_opens,
    load_kernels,
    lost_already,
    nearest_miss,
)
from relguide.planning.certificate import OtherSeparation, certify
from relguide.planning.deadline import TO_PUT_DOWN, end_of
from relguide.planning.heights import heights_of, time_to_level
from relguide.planning.inputs import expect
from relguide.planning.leader_alone import plan_alone, plan_alone_at_once, plan_of, relaxed
from relguide.planning.levels import (
    changing_late,
    chooses_level,
    is_at_level,
    meanwhile,
    with_leader,
)
from relguide.planning.limits import DISTANCE
from relguide.planning.outcome import (
    AS_FAST,
    Conflict,
    NoPlan,
    Plan,
    Reason,
    Remedy,
    RemedyKind,
)
from relguide.planning.phrases import comes_too_close, distance
from relguide.planning.situation import Situation
from relguide.planning.words import candidates
from relguide.units import FT, NM, Metre, Second

SLOT_CHANGES: tuple[Metre, ...] = (1.0 * NM, -1.0 * NM, 2.0 * NM, -2.0 * NM, 4.0 * NM, 8.0 * NM)
"""By how much another D is tried, in turn, until one helps [m]."""


def plan(situation: Situation, *, deadline: Second | None = None) -> Plan | NoPlan:
    """The fastest candidate that keeps d_min, with what is proved of it.

    Without the limit the candidates are all the extremals there are, so if the fastest of them
    keeps the limit it is the global optimum (`proof="relaxation"`). If it does not, paths that
    touch d_min or slide along it are searched too. The plan is then the fastest path that
    certifies, and the time of the fastest candidate is its lower bound (`proof="bound"`).

    Amid others, what is proved for the leader alone is a lower bound, and if that plan keeps clear
    of all it is the answer. If not, paths that touch any of them are searched (`planning/amid.py`).

    The work is bounded whatever the situation: contacts are searched at a fixed number of bearings
    for each piece of the leader's intent, a word has at most 96 roots, a certificate takes at most
    131,072 windows, and nothing beyond 12 hours is considered. The slowest case found takes some
    seconds: twenty turns, some of them at 1° of bank, and no path to the slot.

    Examples:
        >>> rg.plan(rg.scenario("fig_6b").situation).word
        'SRSR'

    Args:
        situation: what to plan.
        deadline: how long it may take, 0 to `MAX_DEADLINE` [s]. The search then ends early, with
            the fastest path found by then and its bound; with `NoPlan` and the reason `deadline`
            if there is none yet. Loading the kernels, once in a process, does not count. Without a
            deadline the answer depends on the situation alone.

    Raises:
        ValueError: if the deadline is out of range, or `situation` is no situation.
    """
    expect("situation", situation, Situation)
    if situation.others and deadline is not None:
        load_kernels()
    until = end_of(deadline)
    answer = _plan_at_any_level(situation, until)
    if isinstance(answer, NoPlan) and answer.reason == Reason.TRAFFIC:
        helps = tuple(_remedies(answer, situation, until))
        message = " ".join((answer.message, *(remedy.message for remedy in helps)))
        return replace(answer, message=message, remedies=helps)
    return answer


def _plan_at_any_level(situation: Situation, until: float) -> Plan | NoPlan:
    """`plan`, without looking for what would help."""
    if chooses_level(situation):
        return _plan_by_level(situation, until)
    answer = _plan(situation, until)
    if isinstance(answer, Plan) and not _joins_at_level(answer):
        return _later_at_level(answer, until)
    return answer


def _plan(situation: Situation, until: float) -> Plan | NoPlan:
    """`plan` where the pursuer's level is settled."""
    if situation.others:
        return _plan_amid_others(situation, until)
    return plan_alone(situation, until)


def plan_at_once(situation: Situation) -> Plan | NoPlan | None:
    """What `plan` answers without a search; `None` if one is needed.

    That is the plan where the limit costs nothing, or that the slot cannot be reached in time. It
    runs a small part of the planner's machine code.
    """
    expect("situation", situation, Situation)
    if situation.others:
        return _at_once_amid_others(situation)
    if chooses_level(situation):
        return None
    answer = plan_alone_at_once(situation)
    return None if isinstance(answer, Plan) and not _joins_at_level(answer) else answer


def _plan_amid_others(situation: Situation, until: float) -> Plan | NoPlan:
    """The plan for the leader alone if it keeps clear of all, or the fastest path found that does.

    Leaving others out relaxes what is asked, so the bound of the one holds for the other.
    """
    started = perf_counter_ns()
    alone = _plan(replace(situation, others=()), until)
    if isinstance(alone, NoPlan) and alone.reason == Reason.SEPARATION_ALREADY_LOST:
        return alone
    lost = lost_already(situation)
    if lost is not None:
        nearest, message = lost
        reason = Reason.SEPARATION_ALREADY_LOST
        return NoPlan(reason=reason, message=message, conflict=_conflict(nearest))
    if isinstance(alone, NoPlan):
        return alone
    certificate = certify(alone.trajectory, situation)
    if certificate.holds:
        took = (perf_counter_ns() - started) * 1e-6
        return replace(alone, situation=situation, certificate=certificate, compute_time=took)
    bound, until = alone.optimality.lower_bound, until - TO_PUT_DOWN
    found = just_as_it_opens(situation, until) or around(situation, until)
    if found is not None:
        return plan_of((*found, relaxed(found[0], bound)), situation, started)
    if time_is_up(until):
        return NoPlan(
            reason=Reason.DEADLINE,
            message="No path that keeps clear of all was found by the deadline; none is faster "
            f"than {bound:.0f} s. A later deadline may help.",
            lower_bound=bound,
        )
    later = islice(candidates(situation).later, MOST_TRIED)
    nearest = nearest_miss(
        (alone.trajectory, *(candidate.trajectory for candidate in later)), situation
    )
    why = comes_too_close(
        nearest.ident, nearest.least_separation, nearest.min_separation, nearest.at_time
    )
    return NoPlan(
        reason=Reason.TRAFFIC,
        message=f"No path to the slot was found that keeps clear of all: the best one {why}.",
        lower_bound=bound,
        conflict=_conflict(nearest),
    )


def _remedies(unable: NoPlan, situation: Situation, until: float) -> Iterator[Remedy]:
    """What would help where no path was found that keeps clear of all, each tried.

    To ask later, or to pass on the other side, is none: a path that first flies on, or round the
    other side, is a path now, and was searched.
    """
    for change in SLOT_CHANGES:
        slot_distance = situation.slot_distance + change
        if not situation.min_separation <= slot_distance <= DISTANCE.high or time_is_up(until):
            continue
        answer = _plan_at_any_level(replace(situation, slot_distance=slot_distance), until)
        if isinstance(answer, Plan):
            behind = f"{distance(slot_distance)} behind the leader"
            yield _remedy("slot_distance", slot_distance, answer, behind)
            break
    pursuer, leader = situation.pursuer, situation.leader
    if pursuer.levels or chooses_level(situation) or None in (pursuer.altitude, leader.altitude):
        return
    for level in meanwhile(situation):
        for answer in _by_way_of(level, situation, unable.lower_bound, until):
            yield _remedy("level", level, answer, f"At {level / FT:,.0f} ft until it joins")
            return


def _remedy(kind: RemedyKind, value: float, answer: Plan, what: str) -> Remedy:
    time = answer.time_to_converge
    message = f"{what} there is a plan of {time:.0f} s."
    return Remedy(kind=kind, value=value, time_to_converge=time, message=message)


def _conflict(nearest: OtherSeparation) -> Conflict:
    return Conflict(
        ident=nearest.ident,
        at_time=nearest.at_time,
        least_separation=nearest.least_separation,
        min_separation=nearest.min_separation,
    )


def _at_once_amid_others(situation: Situation) -> Plan | NoPlan | None:
    """As `plan_at_once`: what is so for the leader alone, if it keeps clear of all others."""
    alone = plan_at_once(replace(situation, others=()))
    if not isinstance(alone, Plan):
        return alone
    certificate = certify(alone.trajectory, situation)
    return (
        replace(alone, situation=situation, certificate=certificate) if certificate.holds else None
    )


def _plan_by_level(situation: Situation, until: float) -> Plan | NoPlan:
    """The fastest plan of those with each choice of level; the first of equally fast ones.

    With the leader first: where the distance alone keeps them apart, no other is faster.
    """
    first = _plan(with_leader(situation), until)
    best = first if isinstance(first, Plan) and _joins_at_level(first) else None
    bound = first.optimality.lower_bound if isinstance(first, Plan) else first.lower_bound
    own = situation.pursuer.altitude
    for level in () if own is None else (own, *meanwhile(situation)):
        if best is not None and best.time_to_converge <= bound + AS_FAST:
            break
        for answer in _by_way_of(level, situation, bound, until):
            if best is None or answer.time_to_converge < best.time_to_converge - AS_FAST:
                best = answer
            if best.time_to_converge <= bound + AS_FAST:
                break
    if best is not None:
        return best
    if isinstance(first, NoPlan):
        return first
    return _later_at_level(first, until)


def _by_way_of(level: Metre, situation: Situation, time: Second, until: float) -> Iterator[Plan]:
    """Plans that stay at a level [m] as long as possible: first to join at a time [s], then later.

    Each later one changes the level as late as the one before it allows.
    """
    while not time_is_up(until):
        asked = changing_late(situation, level, time)
        answer = None if asked is None else _plan(asked, until)
        if not isinstance(answer, Plan) or not _joins_at_level(answer):
            return
        yield answer
        if answer.time_to_converge <= time + AS_FAST:
            return
        time = answer.time_to_converge


def _joins_at_level(answer: Plan) -> bool:
    return is_at_level(answer.situation, answer.time_to_converge)


def _later_at_level(early: Plan, until: float) -> Plan | NoPlan:
    """A path that joins once the pursuer is at the leader's level, where the fastest is earlier."""
    situation = early.situation
    found = around(situation, until)
    if found is not None:
        candidate, certificate = found
        return replace(
            early,
            trajectory=candidate.trajectory,
            word=candidate.word,
            certificate=certificate,
            optimality=replace(early.optimality, proof="bound"),
        )
    joins = early.time_to_converge
    level = time_to_level(heights_of(situation.pursuer), heights_of(situation.leader), joins)
    why = (
        f"the leader's level only in {level:.0f} s, and no path that takes so long was found: "
        "change the level first."
        if level < inf
        else "the leader's level never: the pursuer's changes of level must end at that level."
    )
    return NoPlan(
        reason=Reason.LEVEL,
        message=f"The slot is reached in {joins:.0f} s, but {why}",
        lower_bound=early.optimality.lower_bound,
    )
