"""The mode without a plan: hold a heading that keeps clear of the leader."""

from dataclasses import replace

from relguide.flying.announcements import PlanMissing
from relguide.flying.assignment import Assignment, Observation, slot_of
from relguide.flying.autopilot import HoldHeading
from relguide.flying.capture import offsets
from relguide.flying.closing import SEPARATION_BUFFER
from relguide.flying.escape import escape_path
from relguide.flying.memory import Advice, Memory, enter_mode, is_slot_open
from relguide.planning.plan import NoPlan, Reason
from relguide.planning.situation import Situation
from relguide.units import Metre, Second

A_SECOND: Second = 1.0  # until guidance speaks again


def hold_heading(
    memory: Memory,
    seen: Observation,
    assignment: Assignment,
    situation: Situation,
    answer: NoPlan,
) -> tuple[Memory, Advice]:
    """Hold the present heading, or the nearest one that keeps clear of the leader.

    Args:
        memory: of a second ago.
        seen: what the pursuer knows now.
        assignment: what it was asked to do.
        situation: made of the two.
        answer: why there is no plan to fly.
    """
    slot = slot_of(situation)
    out = escape_path(
        situation,
        bank=seen.pursuer.bank,
        model=assignment.model,
        min_separation=buffered_separation(assignment),
        leader_turn_rate=seen.leader_turn_rate if seen.turning_unannounced else 0.0,
    )
    news = () if memory.missing == answer.reason else (PlanMissing(answer=answer),)
    message = f"No plan: holding a safe heading. {answer.message}"
    mode, events = enter_mode(memory, "heading", message)
    memory = replace(memory, mode=mode, committed=None, shown=None, missing=answer.reason)
    return memory, Advice(
        reference=HoldHeading(out.heading),
        commanded_tas=assignment.tas,
        mode=mode,
        slot=slot,
        slot_open=is_slot_open(memory, seen, assignment),
        to_slot=-offsets(seen.pursuer, slot).ahead,
        time_to_go=0.0,
        joined=False,
        events=(*news, *events),
    )


def reason_to_turn_away(
    memory: Memory, seen: Observation, assignment: Assignment, situation: Situation
) -> NoPlan | None:
    """Why to turn away now from a leader that turns unannounced; `None` if that can wait.

    A plan made now keeps d_min if the leader stops turning. If it goes on, there may be no way out
    a second later: then the way out is taken now, and left once there is room to spare.
    """
    spare = SEPARATION_BUFFER if memory.mode == "heading" and memory.missing else 0.0
    min_separation = buffered_separation(assignment) + spare
    out = escape_path(
        situation,
        bank=seen.pursuer.bank,
        model=assignment.model,
        min_separation=min_separation,
        leader_turn_rate=seen.leader_turn_rate,
        delay=A_SECOND,
    )
    if out.least_separation >= min_separation:
        return None
    return NoPlan(
        reason=Reason.SEPARATION_UNAVOIDABLE,
        message="The leader is turning; if it goes on, there may soon be no way to keep clear.",
    )


def buffered_separation(assignment: Assignment) -> Metre:
    """The separation that new plans should keep [m]: d_min and a buffer, but no more than D."""
    return min(assignment.min_separation + SEPARATION_BUFFER, assignment.slot_distance)
