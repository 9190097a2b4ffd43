"""prove(plan, seconds=…): a better lower bound of the time, for a plan that d_min made longer.

The bound is that of `contact_search`; it rises the longer the search runs. If the slot could be
reached before it opens, arriving just as it opens is a case of its own, in which no path need be an
extremal: it is ruled out, where it can be, by the shortest path to where the slot is then, which is
a search of the same kind.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from math import inf
from time import perf_counter

from relguide.kernels.bounds.contact_bound import Goal
from relguide.planning.contact_search import Question
from relguide.planning.inputs import expect, expect_function, expect_within
from relguide.planning.plan import Optimality, Plan
from relguide.planning.tables import scene_of
from relguide.planning.words import Candidates, candidates
from relguide.units import Second

MAX_SECONDS: Second = 3_600.0
"""Longest accepted time to prove in [s]."""
TOLERANCE: Second = 1e-3
"""A gap this small ends the proof [s]: aircraft take a thousand times as long to roll."""
_REPORT: Second = 0.05  # from one report to the next
_LATER = 1e-9  # a path longer than t_release by this part of it arrives after the slot opens


@dataclass(frozen=True, slots=True, kw_only=True)
class Bound:
    """What is proved of a plan's time so far."""

    elapsed: Second
    """Since the proof began [s]."""
    lower_bound: Second
    """No plan that keeps d_min is faster than this [s]."""
    gap: Second
    """How much slower the plan is [s]."""


def prove(
    plan: Plan,
    *,
    seconds: Second,
    progress: Callable[[Iterator[Bound]], Iterable[Bound]] = iter,
) -> Plan:
    """The plan with a better lower bound of its time; the longer it may take, the better.

    A plan already proved optimal is returned as it is. The search ends early once the bound is
    within `TOLERANCE` of the plan's time.

    Args:
        plan: made by any planner.
        seconds: how long to search at most, 0 to `MAX_SECONDS` [s], without loading the kernels.
        progress: passes the reports through, to show them.

    Raises:
        ValueError: if `seconds` is out of range, or `plan` is not a plan.
    """
    expect("plan", plan, Plan)
    seconds = check_seconds(seconds)
    expect_function("progress", progress)
    if plan.optimality.proof == "relaxation" or plan.situation.min_separation == 0.0:
        return plan
    lower_bound = plan.optimality.lower_bound
    for bound in progress(bounds(plan, seconds=seconds)):
        lower_bound = bound.lower_bound
    return replace(plan, optimality=Optimality(proof="bound", lower_bound=lower_bound))


def check_seconds(seconds: object) -> Second:
    """The time that a proof may take [s].

    Raises:
        ValueError: if it is out of range, naming the range.
    """
    return expect_within("The time for a proof", seconds, 0.0, MAX_SECONDS, "s")


def bounds(plan: Plan, *, seconds: Second) -> Iterator[Bound]:
    """Reports of rising bounds, some twenty a second."""
    pursuer = plan.situation.pursuer
    scale = pursuer.turn_radius / pursuer.tas
    time = plan.time_to_converge
    best = min(plan.optimality.lower_bound, time)
    yield Bound(elapsed=0.0, lower_bound=best, gap=time - best)
    steps = _rising_bounds(plan, time / scale)
    next(steps)  # loads the kernels
    started = reported = perf_counter()
    for proved in steps:
        now = perf_counter()
        if now - started > seconds:
            break
        best = min(max(best, proved * scale), time)
        if time - best <= TOLERANCE:
            break
        if now - reported > _REPORT:
            reported = now
            yield Bound(elapsed=now - started, lower_bound=best, gap=time - best)
    yield Bound(elapsed=perf_counter() - started, lower_bound=best, gap=time - best)


def _rising_bounds(plan: Plan, time: float) -> Iterator[float]:
    """Bounds of the plan's time [R/V_P], round after round until there is no better one."""
    found = candidates(plan.situation)
    frame, slot = found.frame, question_of(found)
    slot.warm_up()
    yield 0.0
    if found.reachable_at_release:
        place = replace(
            slot,
            scene=slot.scene._replace(t_release=0.0),
            goal=Goal(frame.alpha * frame.t_release, 0.0),
            horizon=frame.t_release,
        )
        after = frame.t_release * (1.0 + _LATER)
        shortest = 0.0
        for shortest in place.bounds(after):
            yield min(shortest, frame.t_release)
        if shortest < after:
            return
    yield from slot.bounds(time)


def question_of(found: Candidates) -> Question:
    """How soon the slot can be reached with d_min kept."""
    frame = found.frame
    return Question(
        start=frame.pose,
        scene=scene_of(found.situation, frame),
        goal=Goal(0.0, frame.alpha),
        never_at_release=not found.reachable_at_release,
        horizon=inf,
    )
