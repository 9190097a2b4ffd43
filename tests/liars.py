"""Planners whose plans must not be flown, each with what is wrong with it."""

from collections.abc import Callable
from dataclasses import replace
from math import cos, sin
from typing import cast

from relguide import (
    Arc,
    Certificate,
    Leader,
    NoPlan,
    Plan,
    Situation,
    Straight,
    plan,
)
from relguide.planning.acceptance import Fault
from relguide.planning.trajectory import Segment
from relguide.units import DEG
from tests.flights import random_start

Liar = Callable[[Situation], Plan | NoPlan]


def ends_beside(situation: Situation) -> Plan | NoPlan:
    """It flies on, past the slot."""
    return _change(situation, lambda segments: (*segments, Straight(length=4_000.0)))


def ends_askew(situation: Situation) -> Plan | NoPlan:
    """Nearly in the slot, but a degree too far round."""

    def turned(segments: tuple[Segment, ...]) -> tuple[Segment, ...]:
        last = segments[-1]
        assert isinstance(last, Arc)
        return (*segments[:-1], replace(last, turn_angle=last.turn_angle + 1.0 * DEG))

    return _change(situation, turned)


def comes_too_early(situation: Situation) -> Plan | NoPlan:
    """As if the leader had been on its final leg all along: the slot is not open by then."""
    route = situation.leader.trajectory
    end = route.breakpoints()[-1]
    straight = Leader(
        x=end.x - route.length * sin(end.heading),
        y=end.y - route.length * cos(end.heading),
        heading=end.heading,
        tas=route.tas,
    )
    return plan(replace(situation, leader=straight, min_separation=0.0))


def comes_too_close(situation: Situation) -> Plan | NoPlan:
    """It thinks nothing of the limit, and says so."""
    return plan(replace(situation, min_separation=0.0))


def forges_its_certificate(situation: Situation) -> Plan | NoPlan:
    answer = comes_too_close(situation)
    assert isinstance(answer, Plan)
    forged = Certificate(least_separation=1e5, at_time=0.0, lower_bound=1e5, holds=True)
    return replace(answer, situation=situation, certificate=forged)


def answers_another_question(situation: Situation) -> Plan | NoPlan:
    pursuer = situation.pursuer
    return plan(replace(situation, pursuer=replace(pursuer, x=pursuer.x - 5_000.0)))


def turns_too_steeply(situation: Situation) -> Plan | NoPlan:
    pursuer = situation.pursuer
    return plan(replace(situation, pursuer=replace(pursuer, max_bank=1.2 * pursuer.max_bank)))


def flies_too_fast(situation: Situation) -> Plan | NoPlan:
    pursuer = situation.pursuer
    return plan(replace(situation, pursuer=replace(pursuer, tas=1.02 * pursuer.tas)))


def answers_nothing(situation: Situation) -> Plan | NoPlan:
    return cast(Plan, None)


def _change(
    situation: Situation, change: Callable[[tuple[Segment, ...]], tuple[Segment, ...]]
) -> Plan | NoPlan:
    answer = plan(situation)
    if isinstance(answer, NoPlan):
        return answer
    segments = change(answer.trajectory.segments)
    return replace(answer, trajectory=replace(answer.trajectory, segments=segments))


LIARS: dict[Liar, Fault] = {
    ends_beside: "slot",
    ends_askew: "heading",
    comes_too_early: "too_early",
    comes_too_close: "separation",
    forges_its_certificate: "separation",
    answers_another_question: "start",
    flies_too_fast: "start",
    turns_too_steeply: "bank",
    answers_nothing: "no_answer",
}
"""All of them, and what is found wrong first in `LIED_ABOUT`."""
LIED_ABOUT = random_start(159)
"""The leader turns after four minutes, and the fastest way to its slot comes too close."""
