"""prove(plan, seconds=…): a better lower bound of the time, for a plan that d_min made longer.

The bound is that of `contact_search`; it rises the longer the search runs. A faster path that is
found on the way takes the plan's place. If the slot could be
reached before it opens, arriving just as it opens is a case of its own, in which no path need be an
extremal. It is ruled out, where it can be, by how soon a point can be met that moves along the
slot's track at V_P and is at the slot as it opens: a search of the same kind.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from math import inf
from time import perf_counter

from relguide.kernels.base.clock import now
from relguide.kernels.bounds.search.probe import Find, begin_find
from relguide.kernels.bounds.words.sets import Goal, track_of
from relguide.planning.certificate import certify
from relguide.planning.constrained_path import candidate_of_legs
from relguide.planning.contact_search import Question
from relguide.planning.inputs import expect, expect_function, expect_within
from relguide.planning.outcome import Optimality, Plan, Proof
from relguide.planning.plan import plan as exact_plan
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
_PAIRED_LATE = 2e-5  # of others: late, since there are many cells of last contacts [rad]
_PAIRED_WIDE = 2e-4  # but earlier at d_min > R, where words say less than the time round [rad]
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
    plan: Plan
    """The one that was to be proved, or the fastest that was found since."""


def prove(
    plan: Plan,
    *,
    seconds: Second,
    progress: Callable[[Iterator[Bound]], Iterable[Bound]] = iter,
) -> Plan:
    """The plan with a better lower bound of its time, or a faster one that was found on the way.

    A plan already proved optimal is returned as it is. Within `CERTIFIED` of its bound a plan is
    `certified`. The search ends early once it is within `TOLERANCE`.

    Amid others the bound is that of the leader alone: leaving others out only relaxes what is
    asked. A path found on the way takes the plan's place if it keeps clear of all.

    Examples:
        >>> own = rg.Pursuer(x=30e3, y=12e3, heading=4.5, tas=240.0, max_bank=0.4)
        >>> leader = rg.Leader(x=0.0, y=0.0, heading=1.5, tas=200.0)
        >>> asked = rg.Situation(pursuer=own, leader=leader, slot_distance=10e3, min_separation=9e3)
        >>> found = rg.plan(asked)  # touches d_min
        >>> found.optimality.proof, rg.prove(found, seconds=10.0).optimality.proof
        ('bound', 'certified')

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
    best, lower_bound = plan, plan.optimality.lower_bound
    for bound in progress(bounds(plan, seconds=seconds)):
        best, lower_bound = bound.plan, bound.lower_bound
    certified = best.time_to_converge - lower_bound <= CERTIFIED
    proof: Proof = "certified" if certified else "bound"
    return replace(best, optimality=Optimality(proof=proof, lower_bound=lower_bound))


def check_seconds(seconds: object) -> Second:
    """The time that a proof may take [s].

    Raises:
        ValueError: if it is out of range, naming the range.
    """
    return expect_within("The time for a proof", seconds, 0.0, MAX_SECONDS, "s")


def bounds(plan: Plan, *, seconds: Second) -> Iterator[Bound]:
    """Reports of rising bounds, some twenty a second, and of faster plans.

    Another one comes as soon as the plan is within `CERTIFIED` of its bound.
    """
    if plan.situation.others:
        yield from _bounds_amid_others(plan, seconds)
        return
    search = _Search(plan)
    best = min(plan.optimality.lower_bound, plan.time_to_converge)

    def report(elapsed: Second) -> Bound:
        gap = search.plan.time_to_converge - best
        return Bound(elapsed=elapsed, lower_bound=best, gap=gap, plan=search.plan)

    yield report(0.0)
    steps = search.rising_bounds()
    next(steps)  # loads the kernels
    search.until = now() + seconds
    started, reported, told = perf_counter(), 0.0, False
    for proved in steps:
        elapsed = perf_counter() - started
        if elapsed > seconds:
            break
        best = min(max(best, proved * search.scale), search.plan.time_to_converge)
        gap = search.plan.time_to_converge - best
        if gap <= TOLERANCE:
            break
        if elapsed - reported > _REPORT or (gap <= CERTIFIED and not told):
            reported, told = elapsed, gap <= CERTIFIED
            yield report(elapsed)
    yield report(perf_counter() - started)


def _bounds_amid_others(plan: Plan, seconds: Second) -> Iterator[Bound]:
    """The same where others are in the way, by the bounds of a plan for the leader alone."""
    best, least = plan, plan.optimality.lower_bound
    began = now()
    alone = exact_plan(replace(plan.situation, others=()), deadline=seconds)
    seconds = max(seconds - (now() - began), 0.0)
    if not isinstance(alone, Plan):
        yield Bound(elapsed=0.0, lower_bound=least, gap=best.time_to_converge - least, plan=best)
        return
    reports: Iterator[Bound] = bounds(alone, seconds=seconds)
    if alone.optimality.proof == "relaxation" or plan.situation.min_separation == 0.0:
        bound = alone.optimality.lower_bound
        reports = iter((Bound(elapsed=0.0, lower_bound=bound, gap=0.0, plan=alone),))
    for report in reports:
        certificate = certify(report.plan.trajectory, plan.situation)
        if certificate.holds and report.plan.time_to_converge < best.time_to_converge:
            best = replace(report.plan, situation=plan.situation, certificate=certificate)
        least = min(max(least, report.lower_bound), best.time_to_converge)
        gap = best.time_to_converge - least
        yield Bound(elapsed=report.elapsed, lower_bound=least, gap=gap, plan=best)


class _Search:
    """A proof, and the fastest plan that it has found."""

    def __init__(self, plan: Plan) -> None:
        pursuer = plan.situation.pursuer
        self.plan = plan
        self.scale = pursuer.turn_radius / pursuer.tas
        """R/V_P [s]."""
        self.until = inf
        """When no more is wanted, by `clock.now` [s]."""
        self._found = candidates(plan.situation)
        self._slot = question_of(self._found)
        time = plan.time_to_converge / self.scale
        start, scene, gain = self._slot.start, self._slot.scene, TOLERANCE / self.scale
        self._find = begin_find(start, scene, time, gain, False)
        self._find_at_release = begin_find(start, scene, inf, 0.0, True)

    def rising_bounds(self) -> Iterator[float]:
        """Bounds of the plan's time [R/V_P], round after round until there is no better one."""
        self._slot.load()
        yield 0.0
        gaps = iter(_GAPS)
        if self._found.reachable_at_release:
            track, after = at_release(self._slot)
            beyond, later, soonest = self._later_bounds(next(gaps)), 0.0, 0.0
            # arrivals at that moment and later ones by turns: a faster path may be among these
            for soonest in track.search(after, self._find_at_release, 0.0, self.until):
                if self._take_faster(self._find_at_release):
                    yield track.horizon
                    return
                later = next(beyond, later)
                yield min(soonest, later, track.horizon)
            is_excluded = soonest >= after
            for later in beyond:
                yield later if is_excluded else min(later, track.horizon)
            if not is_excluded:
                return
            yield later
        # paths that arrive within the gap of the plan are left out at once: so a small gap, which
        # takes a hundred times as long, does not delay a larger one
        for gap in gaps:
            yield from self._later_bounds(gap)

    def _later_bounds(self, gap: Second) -> Iterator[float]:
        """Bounds of the time of paths that arrive later than just as the slot opens [R/V_P]."""
        slot, left_out = self._slot, _SHARE * gap / self.scale
        aimed = replace(slot, paired=max(slot.paired * (gap / CERTIFIED) ** 3, _FINEST_PAIRED))
        incumbent = self.plan.time_to_converge / self.scale - left_out
        for bound in aimed.search(incumbent, self._find, left_out, self.until):
            self._take_faster(self._find)
            yield bound

    def _take_faster(self, find: Find) -> bool:
        """Whether a faster path has been found and certifies: it takes the plan's place."""
        time, count = find.best.tolist()
        if count == 0.0 or time * self.scale >= self.plan.time_to_converge:
            return False
        situation, legs = self.plan.situation, find.legs[: int(count)]
        path = candidate_of_legs(self._found, find.scene, time, legs)
        if path is None:
            return False
        certificate = certify(path.trajectory, situation)
        if certificate.holds:
            trajectory, word = path.trajectory, path.word
            self.plan = replace(
                self.plan,
                trajectory=trajectory, word=word, certificate=certificate, planner="exact",
            )  # fmt: skip
        return certificate.holds


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


def question_of(found: Candidates) -> Question:
    """How soon the slot can be reached with d_min kept."""
    frame = found.frame
    scene = scene_of(found.situation, frame)
    return Question(
        start=frame.pose,
        scene=scene,
        paired=_PAIRED_WIDE if scene.d_min > 1.0 else _PAIRED_LATE,
        goal=Goal(0.0, frame.alpha, found.reachable_at_release),
        horizon=inf,
    )
