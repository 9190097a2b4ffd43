"""prove(plan, seconds=…): a better lower bound of the time, for a plan that d_min made longer.

The bound is that of `contact_search`; it rises the longer the search runs. If the slot could be
reached before it opens, arriving just as it opens is a case of its own, in which no path need be an
extremal. It is ruled out, where it can be, by how soon a point can be met that moves along the
slot's track at V_P and is at the slot as it opens: a search of the same kind.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from math import inf
from time import perf_counter

from relguide.kernels.bounds.contact_bound import Goal, track_of
from relguide.planning.contact_search import Question
from relguide.planning.inputs import expect, expect_function, expect_within
from relguide.planning.plan import Optimality, Plan, Proof
from relguide.planning.tables import scene_of
from relguide.planning.words import Candidates, candidates
from relguide.units import Second

MAX_SECONDS: Second = 3_600.0
"""Longest accepted time to prove in [s]."""
TOLERANCE: Second = 1e-3
"""A gap this small ends the proof [s]: aircraft take a thousand times as long to roll."""
CERTIFIED: Second = 0.1
"""A plan this near to its bound counts as optimal [s]: half a second's roll is more."""
_GAPS: tuple[Second, ...] = (CERTIFIED, 0.01, TOLERANCE)  # closed one after another
_REPORT: Second = 0.05  # from one report to the next
_SHARE = 0.99  # of a gap that is wanted, so that rounding does not count
_PAIRED = 1e-3  # `Question.paired` of paths that arrive as the slot opens [rad]
_FINEST_PAIRED = 1e-9  # the least that is asked for with small gaps [rad]
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

    A plan already proved optimal is returned as it is. Within `CERTIFIED` of its bound a plan is
    `certified`. The search ends early once it is within `TOLERANCE`.

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
    certified = plan.time_to_converge - lower_bound <= CERTIFIED
    proof: Proof = "certified" if certified else "bound"
    return replace(plan, optimality=Optimality(proof=proof, lower_bound=lower_bound))


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
    steps = _rising_bounds(plan, time / scale, scale)
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


def _rising_bounds(plan: Plan, time: float, scale: float) -> Iterator[float]:
    """Bounds of the plan's time [R/V_P], round after round until there is no better one."""
    found = candidates(plan.situation)
    slot = question_of(found)
    _load(slot)
    yield 0.0
    if found.reachable_at_release:
        track, after = at_release(slot)
        soonest = 0.0
        for soonest in track.bounds(after):
            yield min(soonest, track.horizon)
        if soonest < after:
            return
    # paths that arrive within the gap of the plan are left out at once: so a small gap, which takes
    # a hundred times as long, does not delay a larger one
    for gap in _GAPS:
        aimed = replace(slot, paired=max(slot.paired * (gap / CERTIFIED) ** 3, _FINEST_PAIRED))
        yield from aimed.bounds(time - _SHARE * gap / scale)


def at_release(slot: Question) -> tuple[Question, float]:
    """How soon a path can come to the track of the slot, and what rules one out as it opens.

    Only one that has come to it by then can be there as it opens, see `track_of`.
    """
    t_release = slot.scene.t_release
    track = replace(
        slot,
        scene=slot.scene._replace(t_release=0.0),
        goal=track_of(slot.goal, t_release),
        horizon=t_release,
        paired=_PAIRED,
    )
    return track, t_release * (1.0 + _LATER)


def _load(question: Question) -> None:
    """Load the kernels."""
    for _ in question.bounds(0.0):
        pass


def question_of(found: Candidates) -> Question:
    """How soon the slot can be reached with d_min kept."""
    frame = found.frame
    return Question(
        start=frame.pose,
        scene=scene_of(found.situation, frame),
        goal=Goal(0.0, frame.alpha, found.reachable_at_release),
        horizon=inf,
    )
