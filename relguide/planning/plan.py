"""plan(situation) → Plan | NoPlan: the fastest candidate that certifies, and what is proved."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from enum import StrEnum
from itertools import islice
from math import hypot, inf
from time import perf_counter_ns
from typing import Literal

from numpy.typing import ArrayLike

from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.separation.clearance import SLACK
from relguide.planning.amid import (
    MOST_TRIED,
    around,
    just_as_it_opens,
    load_kernels,
    lost_already,
    nearest_miss,
)
from relguide.planning.arrival import Arrival, arrival
from relguide.planning.at_release import first_at_release
from relguide.planning.candidate import Candidate
from relguide.planning.certificate import Certificate, OtherSeparation, certify, judge
from relguide.planning.constrained_path import constrained_path
from relguide.planning.deadline import TO_LOOK_ROUND, TO_PUT_DOWN, end_of
from relguide.planning.heights import ALWAYS, counted, heights_of
from relguide.planning.inputs import expect, number
from relguide.planning.intent import LevelChange
from relguide.planning.least_bad import (
    least_bad,
    least_bad_sentence,
    restore,
    restore_sentence,
)
from relguide.planning.levels import (
    changing_late,
    chooses_level,
    is_at_level,
    meanwhile,
    with_leader,
)
from relguide.planning.limits import DISTANCE
from relguide.planning.phrases import comes_too_close, distance
from relguide.planning.sampling import Samples
from relguide.planning.situation import Situation
from relguide.planning.straight_ahead import first_candidate
from relguide.planning.tables import leader_path, path_of
from relguide.planning.trajectory import Trajectory, pieces_text
from relguide.planning.wind import CALM
from relguide.planning.words import HORIZON, Candidates, candidates
from relguide.units import FT, KT, NM, Metre, Millisecond, Second

Proof = Literal["relaxation", "certified", "bound", "none"]
"""What proves a plan: the best plan without the limit keeps it; a lower bound within 0.1 s, which
`prove` finds; any lower bound; nothing."""
LONGEST_NAME = 40
"""Longest name of a planner [characters]: what fits on a line of the cockpit."""


class Reason(StrEnum):
    """Why there is no plan."""

    SLOT_UNREACHABLE = "slot_unreachable"
    SEPARATION_ALREADY_LOST = "separation_already_lost"
    SEPARATION_UNAVOIDABLE = "separation_unavoidable"
    BEYOND_HORIZON = "beyond_horizon"
    DEADLINE = "deadline"
    TRAFFIC = "traffic"
    LEVEL = "level"


@dataclass(frozen=True, slots=True, kw_only=True)
class Optimality:
    """What is proved of a plan's time."""

    proof: Proof
    lower_bound: Second
    """No plan that keeps d_min is faster than this [s]."""


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Plan:
    """A certified trajectory to the slot."""

    situation: Situation
    """What was asked about; the pursuer with the changes of level that were planned."""
    trajectory: Trajectory
    """In the air mass, from the pursuer's present state to the slot."""
    word: str
    """Its letters, e.g. `"LSR"`."""
    certificate: Certificate
    optimality: Optimality
    planner: str
    """Who made it: `exact`, `network`, `regular_dp`, or the name of a planner of one's own."""
    compute_time: Millisecond = field(default=0.0, compare=False)
    """Wall time it took to find [ms]."""
    fell_back: bool = field(default=False, compare=False)
    """Whether it took the place of another planner's, which was asked first."""
    status: Literal["planned"] = "planned"

    def __post_init__(self) -> None:
        """Refuse a name that does not fit on a line."""
        name = self.planner
        if name != "exact" and not (
            isinstance(name, str) and name.isprintable() and 0 < len(name.strip()) <= LONGEST_NAME
        ):
            raise ValueError(
                f"planner must be a name of 1 to {LONGEST_NAME} printable characters, not {name!r}."
            )

    @property
    def levels(self) -> tuple[LevelChange, ...]:
        """Changes of level that the pursuer makes."""
        return self.situation.pursuer.levels

    @property
    def time_to_converge(self) -> Second:
        """T: when the pursuer is at the slot, on the leader's heading [s]."""
        return self.trajectory.duration

    @classmethod
    def from_trajectory(
        cls,
        trajectory: Trajectory,
        situation: Situation,
        *,
        planner: str,
        lower_bound: Second = 0.0,
    ) -> "Plan":
        """A plan from the trajectory of a planner of one's own, with its certificate.

        Whether it may be flown is decided where it is used: `certificate.holds` and
        `arrival.holds` must both be true.

        Args:
            trajectory: in the air mass, from the pursuer's present state to the slot.
            situation: what was asked about.
            planner: its name, 1 to 40 printable characters.
            lower_bound: no plan that keeps d_min is faster than this [s]; 0 if nothing is known.
        """
        certificate, bound = certify(trajectory, situation), number("lower_bound", lower_bound)
        return cls(
            situation=situation,
            trajectory=trajectory,
            word=trajectory.letters,
            certificate=certificate,
            optimality=Optimality(proof="bound" if bound > 0.0 else "none", lower_bound=bound),
            planner=planner,
        )

    def sample(self, t: ArrayLike) -> Samples:
        """Where the pursuer is at many times at once, as `Trajectory.sample`."""
        return self.trajectory.sample(t)

    def over_ground(self, t: ArrayLike | None = None) -> Samples:
        """The same over the ground, in the situation's wind, as `Trajectory.over_ground`."""
        return self.trajectory.over_ground(self.situation.wind, t)

    def __repr__(self) -> str:
        """Three lines: the path, the separation, the proof."""
        found, proof = self.certificate, self.optimality
        spans = ", ".join(f"{kept[0]:.0f} to {kept[1]:.0f} s" for kept in found.vertical)
        height = f",\n     1,000 ft keep them apart from {spans}" if spans else ""
        return (
            f"Plan({self.word} by {self.planner}: joins in {self.time_to_converge:.1f} s, "
            f"{pieces_text(self.trajectory)},\n"
            f"     least separation {found.least_separation:.1f} m at {found.at_time:.1f} s, "
            f"proved above {found.lower_bound:.1f} m{height},\n"
            f"     proof: {proof.proof}, no plan is faster than {proof.lower_bound:.1f} s)"
        )

    def _repr_svg_(self) -> str:
        """How notebooks show it: drawn, north up."""
        from relguide.planning.drawing import plan_drawing  # most who plan draw nothing

        return plan_drawing(
            self.trajectory, self.situation, word=self.word, certificate=self.certificate
        )

    @property
    def arrival(self) -> Arrival:
        """How its end meets eq. (7); computed anew each time, from the trajectory alone."""
        return arrival(self.trajectory, self.situation)


@dataclass(frozen=True, slots=True, kw_only=True)
class Conflict:
    """What the best path that was found comes too close to."""

    ident: str
    """Of other traffic, or of a cell."""
    at_time: Second
    """When it is nearest [s]."""
    least_separation: Metre
    """How near it comes; negative inside a cell [m]."""
    min_separation: Metre
    """What is to be kept [m]; 0 for a cell."""


RemedyKind = Literal["slot_distance", "later", "level", "side"]
"""Another D; the same asked later; another level; the other way round."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Remedy:
    """A change with which there is a plan: it was tried."""

    kind: RemedyKind
    value: float
    """D [m], how much later [s], or the level [m]; 0 for the other way round."""
    time_to_converge: Second
    """T of the plan there is then, from the time that it is asked [s]."""
    message: str
    """The same for people."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NoPlan:
    """Why there is no plan, and what would help."""

    reason: Reason
    message: str
    """A sentence for people."""
    lower_bound: Second = 0.0
    """No plan that keeps d_min is faster than this [s]; 0 where nothing is known."""
    conflict: Conflict | None = None
    """With `Reason.TRAFFIC`: what is in the way of the best path that was found."""
    remedies: tuple[Remedy, ...] = ()
    """With `Reason.TRAFFIC`: what would help."""
    status: Literal["no_plan"] = "no_plan"


AS_FAST: Second = 1e-6
"""Times closer than this count as equal: the same path found twice differs by rounding [s]."""
SLOT_CHANGES: tuple[Metre, ...] = (1.0 * NM, -1.0 * NM, 2.0 * NM, -2.0 * NM, 4.0 * NM, 8.0 * NM)
"""By how much another D is tried, in turn, until one helps [m]."""
Planner = Callable[[Situation], Plan | NoPlan]
"""The one protocol of all planners."""
_Chosen = tuple[Candidate, Certificate, Optimality]


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
    return _plan(situation, until)


def _plan(situation: Situation, until: float) -> Plan | NoPlan:
    """`plan` where the pursuer's level is settled."""
    if situation.others:
        return _plan_amid_others(situation, until)
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
    return chosen if isinstance(chosen, NoPlan) else _plan_of(chosen, situation, started)


def plan_at_once(situation: Situation) -> Plan | NoPlan | None:
    """What `plan` answers without a search; `None` if one is needed.

    That is the plan where the limit costs nothing, or that the slot cannot be reached in time. It
    runs a small part of the planner's machine code.
    """
    expect("situation", situation, Situation)
    if situation.others:
        return _at_once_amid_others(situation)
    started = perf_counter_ns()
    radius = situation.pursuer.turn_radius
    if chooses_level(situation) or (
        _separation(situation) < situation.min_separation - SLACK * radius
        and _counts_now(situation)
    ):
        return None
    chosen = _plan_at_once(situation, radius)
    if chosen is None:
        found = candidates(situation)
        beyond = _out_of_reach(found, situation)
        if beyond is not None:
            return beyond
        chosen = _fastest_extremal(found, situation, radius, path_of(found.leader), inf)
    return None if chosen is None else _plan_of(chosen, situation, started)


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
    found = just_as_it_opens(situation) or around(situation, until)
    if found is not None:
        return _plan_of((*found, _relaxed(found[0], bound)), situation, started)
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


def _relaxed(candidate: Candidate, bound: Second) -> Optimality:
    """What the bound of a relaxed problem proves of a path."""
    time = candidate.time_to_converge
    proof: Proof = "relaxation" if time <= bound + AS_FAST else "bound"
    return Optimality(proof=proof, lower_bound=min(bound, time))


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


def _separation(situation: Situation) -> Metre:
    """Between the two aircraft now [m]."""
    pursuer, leader = situation.pursuer, situation.leader
    return hypot(pursuer.x - leader.x, pursuer.y - leader.y)


def _counts_now(situation: Situation) -> bool:
    """Whether the horizontal minimum counts at t = 0."""
    when = counted(heights_of(situation.pursuer), heights_of(situation.leader))
    return when == ALWAYS or (when != () and when[0][0] <= 0.0)


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
    settled, joins = heights_of(situation.pursuer).settled(), early.time_to_converge
    return NoPlan(
        reason=Reason.LEVEL,
        message=f"The slot is reached in {joins:.0f} s, but the leader's level only in "
        f"{settled:.0f} s, and no path that takes so long was found: change the level first.",
        lower_bound=early.optimality.lower_bound,
    )


def _plan_of(chosen: _Chosen, situation: Situation, started: int) -> Plan:
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


def _plan_at_once(situation: Situation, radius: Metre) -> _Chosen | None:
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


def _search(situation: Situation, radius: Metre, until: float) -> _Chosen | NoPlan:
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
) -> tuple[_Chosen | None, bool]:
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
    return (*chosen, _relaxed(chosen[0], bound)), cut_short


def _fastest_extremal(
    found: Candidates, situation: Situation, radius: Metre, leading: FloatArray, until: float
) -> _Chosen | None:
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
