"""plan_amid(situation): the fastest path that keeps clear of the leader, other traffic and cells.

The plan for the leader alone is tried first: leaving others out only relaxes what is asked, so what
is proved of it holds amid them too, and if it keeps clear of all it is the answer. Otherwise paths
are searched that touch any of them (`kernels/contact/detour_search.py`). The certificate is the
judge in the end.
"""

from dataclasses import dataclass, replace
from functools import cache, partial
from itertools import islice
from math import hypot, inf, pi
from time import perf_counter_ns
from typing import assert_never

import numpy as np

from relguide.kernels.base.clock import time_is_up
from relguide.kernels.contact.detour_search import MOST_PAIRS, fastest_clear_of_all
from relguide.kernels.separation.cell import signed_distance
from relguide.kernels.separation.clearance import SLACK
from relguide.planning.aircraft import Leader, Pursuer, Traffic
from relguide.planning.candidate import SIGN_ROWS, Candidate, assemble
from relguide.planning.cells import Cell, Disc, Polygon
from relguide.planning.certificate import (
    Certificate,
    OtherSeparation,
    cell_shape,
    certify,
    judge,
)
from relguide.planning.deadline import TO_PUT_DOWN, left_until
from relguide.planning.intent import TurnTo
from relguide.planning.others_table import others_of
from relguide.planning.phrases import comes_too_close, distance
from relguide.planning.plan import (
    AS_FAST,
    Conflict,
    NoPlan,
    Optimality,
    Plan,
    Proof,
    Reason,
    plan,
)
from relguide.planning.remedies import remedies
from relguide.planning.situation import Other, Situation
from relguide.planning.slot import slot_frame
from relguide.planning.tables import leader_path
from relguide.planning.trajectory import RIGHT
from relguide.planning.words import candidates
from relguide.units import DEG, Metre

MOST_TRIED = 32
"""Of the paths that arrive just as the slot opens, so many are tried, fewest turns first."""


def plan_amid(situation: Situation, *, until: float = inf) -> Plan | NoPlan:
    """As `plan`, for a situation with others.

    Args:
        situation: what to plan.
        until: when it must have ended, by `clock.now` [s].
    """
    answer = _find(situation, until)
    if not isinstance(answer, _Blocked):
        return answer
    conflict = _nearest_miss(situation, answer.alone)
    helps = remedies(situation, partial(_plan_or_not, until=until), until=until)
    return NoPlan(
        reason=Reason.TRAFFIC,
        message=" ".join(
            (
                "No path to the slot was found that keeps clear of all: the best one "
                f"{_why(conflict)}.",
                *(remedy.message for remedy in helps),
            )
        ),
        lower_bound=answer.alone.optimality.lower_bound,
        conflict=conflict,
        remedies=helps,
    )


@dataclass(frozen=True, slots=True)
class _Blocked:
    """That no path was found, and the plan for the leader alone."""

    alone: Plan


def _plan_or_not(situation: Situation, *, until: float) -> Plan | NoPlan:
    """As `plan_amid`, without looking for what would help."""
    answer = _find(situation, until)
    if isinstance(answer, _Blocked):
        return NoPlan(reason=Reason.TRAFFIC, message="No path was found that keeps clear of all.")
    return answer


def _find(situation: Situation, until: float) -> Plan | NoPlan | _Blocked:
    """The plan, or why there is none."""
    started = perf_counter_ns()
    alone = plan(replace(situation, others=()), deadline=left_until(until))
    if isinstance(alone, NoPlan) and alone.reason == Reason.SEPARATION_ALREADY_LOST:
        return alone
    lost = _lost_already(situation)
    if lost is not None or isinstance(alone, NoPlan):
        return lost or alone
    bound = alone.optimality.lower_bound
    certificate = certify(alone.trajectory, situation)
    optimality = alone.optimality
    candidate = Candidate(word=alone.word, trajectory=alone.trajectory)
    if not certificate.holds:
        found = _just_as_it_opens(situation) or _around(situation, until - TO_PUT_DOWN)
        if found is None and time_is_up(until - TO_PUT_DOWN):
            return NoPlan(
                reason=Reason.DEADLINE,
                message="No path that keeps clear of all was found by the deadline; none is "
                f"faster than {bound:.0f} s. A later deadline may help.",
                lower_bound=bound,
            )
        if found is None:
            return _Blocked(alone)
        candidate, certificate = found
        time = candidate.time_to_converge
        proof: Proof = "relaxation" if time <= bound + AS_FAST else "bound"
        optimality = Optimality(proof=proof, lower_bound=min(bound, time))
    return Plan(
        situation=situation,
        trajectory=candidate.trajectory,
        word=candidate.word,
        certificate=certificate,
        optimality=optimality,
        planner="exact",
        compute_time=(perf_counter_ns() - started) * 1e-6,
    )


def _lost_already(situation: Situation) -> NoPlan | None:
    """That the pursuer is too close to one of the others now."""
    for other in situation.others:
        apart, limit = _separation_now(situation, other)
        if apart >= limit - SLACK * situation.pursuer.turn_radius:
            continue
        if isinstance(other, Cell):
            message = (
                f"The pursuer is {distance(-apart)} inside {other.ident}. A plan must begin "
                "outside all cells."
            )
        else:
            message = (
                f"The pursuer is {distance(apart)} from {other.ident}, closer than the minimum "
                f"of {distance(limit)} that is to be kept from it."
            )
        return NoPlan(
            reason=Reason.SEPARATION_ALREADY_LOST,
            message=message,
            conflict=Conflict(
                ident=other.ident, at_time=0.0, least_separation=apart, min_separation=limit
            ),
        )
    return None


def _separation_now(situation: Situation, other: Other) -> tuple[Metre, Metre]:
    """How far the pursuer is from one of the others, and how far it should be at least [m]."""
    x, y = situation.pursuer.x, situation.pursuer.y
    match other:
        case Traffic():
            return hypot(x - other.x, y - other.y), other.min_separation
        case Cell():
            corners, cell = cell_shape(other, situation.wind)
            return float(signed_distance(x, y, corners, float(cell[0]))[0]), 0.0
        case _:
            assert_never(other)


def _just_as_it_opens(situation: Situation) -> tuple[Candidate, Certificate] | None:
    """A path that arrives just as the slot opens: none is faster."""
    found = candidates(situation)
    if not found.reachable_at_release:
        return None
    radius, leading = situation.pursuer.turn_radius, leader_path(situation)
    for candidate in islice(found.at_release, MOST_TRIED):
        certificate = judge(candidate.trajectory, situation, radius, leading)
        if certificate.holds:
            return candidate, certificate
    return None


def _around(situation: Situation, until: float) -> tuple[Candidate, Certificate] | None:
    """The fastest path found that keeps clear of all, and its certificate."""
    frame = slot_frame(situation, situation.leader.trajectory)
    others = others_of(situation, frame, until=until)
    pairs, row = np.zeros((MOST_PAIRS, 3)), np.empty(5)
    _, n = fastest_clear_of_all(frame.pose, others, pairs, row)
    if n < 0:
        return None
    signs, amounts = [], []
    for sign, turned, straight in pairs[:n].tolist():
        signs += [sign, 0.0]
        amounts += [turned, straight]
    _, word, *lasts = row.tolist()
    signs, amounts = signs + SIGN_ROWS[int(word)], amounts + lasts
    candidate = assemble(situation, frame, signs, amounts, "")
    certificate = certify(candidate.trajectory, situation)
    return (candidate, certificate) if certificate.holds else None


def _nearest_miss(situation: Situation, alone: Plan) -> Conflict:
    """What comes in the way of the path to the slot that keeps clear best."""
    radius, leading = situation.pursuer.turn_radius, leader_path(situation)
    tried = [alone.trajectory]
    tried += [candidate.trajectory for candidate in islice(candidates(situation).later, MOST_TRIED)]
    judged = [judge(trajectory, situation, radius, leading) for trajectory in tried]
    nearest = max((certificate.others[0] for certificate in judged), key=_margin)
    return Conflict(
        ident=nearest.ident,
        at_time=nearest.at_time,
        least_separation=nearest.least_separation,
        min_separation=nearest.min_separation,
    )


def _why(conflict: Conflict) -> str:
    return comes_too_close(
        conflict.ident, conflict.least_separation, conflict.min_separation, conflict.at_time
    )


def _margin(other: OtherSeparation) -> Metre:
    return other.lower_bound - other.min_separation


@cache
def load_kernels() -> None:
    """Call all kernels of a search amid others once."""
    _around(LOADING, inf)
    _lost_already(LOADING)


LOADING = Situation(
    pursuer=Pursuer(x=-30e3, y=20e3, heading=0.5 * pi, tas=240.0, max_bank=25.0 * DEG),
    leader=Leader(x=0.0, y=0.0, heading=0.0, tas=200.0),
    slot_distance=12e3,
    min_separation=9_260.0,
    others=(
        Traffic(
            ident="TURNING", x=0.0, y=40e3, heading=4.0, tas=200.0, min_separation=9_260.0,
            intent=(TurnTo(heading=1.0, turn=RIGHT, bank=25.0 * DEG),),
        ),
        Cell(ident="DISC", shape=Disc(x=20e3, y=50e3, radius=5e3), east=10.0, growth=1.0),
        Cell(ident="POLYGON", shape=Polygon(corners=((8e3, 20e3), (9e3, 20e3), (9e3, 21e3)))),
    ),
)  # fmt: skip
"""One with others of each kind in the way."""
