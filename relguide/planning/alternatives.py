"""alternatives(plan): each other path to the slot, with its time and why it is not flown.

Two paths differ if their words do, or the middle arcs of a three-turn word (more or less than half
a turn), or how they pass the leader. The last is a matter of topology, see `passing`.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice, takewhile
from math import pi
from typing import Literal

import numpy as np

from relguide.kernels.base.clock import time_is_up
from relguide.kernels.words.extremals import MAX_ROWS, WORDS, solve
from relguide.planning.candidate import Candidate
from relguide.planning.certificate import certify, lost_to
from relguide.planning.deadline import end_of
from relguide.planning.inputs import expect
from relguide.planning.outcome import AS_FAST, Plan
from relguide.planning.passing import Passing, Surroundings, passing, surroundings
from relguide.planning.phrases import duration, too_close, too_close_to
from relguide.planning.slot import SlotFrame
from relguide.planning.trajectory import Trajectory
from relguide.planning.words import HORIZON, Candidates, candidates
from relguide.units import Metre, Second

SAME_LENGTH: Metre = 0.01
"""Paths of the same letters whose pieces differ by less are the same path [m]."""
AT_RELEASE = 32
"""How many of the paths that arrive as the slot opens are considered, fewest turns first: there may
be a thousand, all equally fast."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Slower:
    """It arrives later than the plan, whether or not it keeps d_min."""

    by: Second
    kind: Literal["slower"] = "slower"


@dataclass(frozen=True, slots=True, kw_only=True)
class AsFast:
    """It arrives with the plan: its mirror image, the same path, or another as the slot opens."""

    kind: Literal["as_fast"] = "as_fast"


@dataclass(frozen=True, slots=True, kw_only=True)
class Faster:
    """It is faster and keeps d_min: only a planner that is not exact misses such a path."""

    by: Second
    kind: Literal["faster"] = "faster"


@dataclass(frozen=True, slots=True, kw_only=True)
class LosesSeparation:
    """It is no slower than the plan, and comes too close."""

    least_separation: Metre
    at_time: Second
    ident: str = ""
    """Of other traffic, or of a cell; empty for the leader."""
    kind: Literal["separation"] = "separation"


@dataclass(frozen=True, slots=True, kw_only=True)
class Alternative:
    """A path to the slot that is not flown, and why."""

    candidate: Candidate
    """Its word and its trajectory."""
    passing: Passing
    rejected: Slower | AsFast | Faster | LosesSeparation
    why: str
    """The same for people, e.g. `"38 s slower"`."""

    @property
    def word(self) -> str:
        """Its letters."""
        return self.candidate.word

    @property
    def time_to_converge(self) -> Second:
        """T [s]."""
        return self.candidate.time_to_converge


@dataclass(frozen=True, slots=True, kw_only=True)
class TooEarly:
    """A word that reaches the place of the slot before it opens."""

    word: str
    time_to_converge: Second
    """When it would be there first [s]."""
    release_time: Second
    """When the slot opens [s]."""
    why: str


@dataclass(frozen=True, slots=True, kw_only=True)
class NoRoot:
    """A word of which no path reaches the slot, early or late: none at all, or none in 12 hours."""

    word: str
    why: str


AnyAlternative = Alternative | TooEarly | NoRoot
"""What `alternatives` lists."""


def alternatives(plan: Plan, *, deadline: Second | None = None) -> tuple[AnyAlternative, ...]:
    """Every other path to the slot and why it is not flown, by time; words without any come last.

    These are all faster paths, and the fastest for each word, middle arc and passing of the leader.
    Where the slot opens later, also the words that would be there before, and one path for each
    passing of the many that arrive just as it opens.

    Examples:
        >>> best = rg.plan(rg.scenario("fig_6b").situation)
        >>> rg.alternatives(best)[0].why
        'reaches the slot 29 s before it opens'

    Args:
        plan: made by any planner.
        deadline: how long it may take, 0 to `MAX_DEADLINE` [s]: then the list ends early. Loading
            the kernels, once in a process, does not count.

    Raises:
        ValueError: if the deadline is out of range, or `plan` is not a plan.
    """
    expect("plan", plan, Plan)
    until = end_of(deadline)
    situation = plan.situation
    found = candidates(situation)
    scale = found.frame.radius / situation.pursuer.tas
    release_time = found.frame.t_release * scale
    first = {word: time * scale for word, time in _first_arrivals(found.frame).items()}
    late = {WORDS[int(word)] for word in found.rows[:, 1]}
    around = surroundings(found)
    listed: list[Alternative | TooEarly] = [
        *takewhile(lambda _: not time_is_up(until), _release_alternatives(plan, found, around)),
        *takewhile(lambda _: not time_is_up(until), _later_alternatives(plan, found, around)),
    ]
    for word, time in first.items():
        if time < release_time - (AS_FAST if word in late else 0.0):
            why = f"reaches the slot {duration(release_time - time)} before it opens"
            listed.append(
                TooEarly(word=word, time_to_converge=time, release_time=release_time, why=why)
            )
    rootless = [w for w in WORDS if w not in late and first.get(w, release_time) >= release_time]
    return (
        *sorted(listed, key=lambda other: other.time_to_converge),
        *(NoRoot(word=word, why=_why_rootless(first.get(word))) for word in rootless),
    )


def _why_rootless(time: Second | None) -> str:
    """What to say of a word that is there at `time` [s] at the earliest, if at all."""
    if time is None:
        return "no such path to the slot"
    return f"no such path to the slot within {HORIZON / 3600.0:.0f} hours"


def _first_arrivals(frame: SlotFrame) -> dict[str, float]:
    """When each word that reaches the slot is first there, open or not [R/V_P]."""
    rows = np.empty((MAX_ROWS, 5))
    n = solve(frame.pose, frame.alpha, 0.0, rows)
    times: dict[str, float] = {}
    for time, word in rows[:n, :2].tolist():
        times.setdefault(WORDS[int(word)], time)
    return times


def _later_alternatives(
    plan: Plan, found: Candidates, around: Surroundings
) -> Iterator[Alternative]:
    """Extremals that arrive once the slot is open."""
    seen: set[tuple[str, bool, int]] = set()
    last: dict[str, Second] = {}
    for row, candidate in zip(found.rows.tolist(), found.later, strict=True):
        word, time = candidate.word, candidate.time_to_converge
        ours = passing(candidate.trajectory, around)
        branch = (word, word[1] != "S" and row[3] > pi, ours.laps)
        faster = time < plan.time_to_converge - AS_FAST
        twice = time - last.get(word, -1.0) <= AS_FAST
        last[word] = time
        if twice or (branch in seen and not faster):
            continue
        seen.add(branch)
        if word != plan.word or not _same_time(candidate, plan):
            yield _compare(candidate, ours, plan)


def _release_alternatives(
    plan: Plan, found: Candidates, around: Surroundings
) -> Iterator[Alternative]:
    """For each passing, the path of fewest turns that arrives as the slot opens."""
    seen: set[int] = set()
    for candidate in islice(found.at_release, AT_RELEASE):
        ours = passing(candidate.trajectory, around)
        if ours.laps not in seen:
            seen.add(ours.laps)
            if candidate.trajectory != plan.trajectory:
                yield _compare(candidate, ours, plan)


def _same_time(candidate: Candidate, plan: Plan) -> bool:
    return abs(candidate.time_to_converge - plan.time_to_converge) <= AS_FAST


def _compare(candidate: Candidate, ours: Passing, plan: Plan) -> Alternative:
    certificate = certify(candidate.trajectory, plan.situation)
    lost = lost_to(certificate)
    if lost is None:
        least, at, ident = certificate.least_separation, certificate.at_time, ""
        near = too_close(least, plan.situation.min_separation)
    else:
        least, at, ident = lost.least_separation, lost.at_time, lost.ident
        near = too_close_to(ident, least, lost.min_separation)
    near = f"comes {near} at {at:.0f} s"
    by = candidate.time_to_converge - plan.time_to_converge
    rejected: Slower | AsFast | Faster | LosesSeparation
    if by > AS_FAST:
        rejected = Slower(by=by)
        why = f"{duration(by)} slower"
        if not certificate.holds:
            why += f", and {near}"
    elif not certificate.holds:
        rejected = LosesSeparation(least_separation=least, at_time=at, ident=ident)
        why = near
    elif by < -AS_FAST:
        rejected = Faster(by=-by)
        why = f"{duration(-by)} faster, and not found by the planner {plan.planner}"
    else:
        rejected = AsFast()
        why = _as_fast(candidate.trajectory, plan.trajectory)
    return Alternative(candidate=candidate, passing=ours, rejected=rejected, why=why)


def _as_fast(other: Trajectory, flown: Trajectory) -> str:
    pieces = zip(other.segments, flown.segments, strict=False)
    if other.letters == flown.letters and all(
        abs(a.length - b.length) < SAME_LENGTH for a, b in pieces
    ):
        return "as fast: the same path"
    if other.turns > flown.turns:
        return f"as fast, with {other.turns} turns in place of {flown.turns}"
    return "as fast"
