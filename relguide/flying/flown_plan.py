"""flown_card(plan, planner): what guidance would make of a plan's situation, engaged at once.

A plan is ideal: it turns at once and keeps its speed to the slot. An aircraft rolls into its turns,
keeps a berth beside d_min, and brakes at the end. So the flight of the situation is begun as any
other: the first act of guidance commits to a path, and flies the closed loop ahead on it.
"""

from math import inf

from relguide.flying.cards import path_segments
from relguide.flying.fleet import Fleet
from relguide.flying.flight import world_of
from relguide.flying.guidance.advise import advise
from relguide.flying.guidance.announcements import NewPlan, PlanMissing, UnableTo
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.commit.committed import Committed
from relguide.flying.guidance.forecast import Forecast, rows_to_draw
from relguide.flying.guidance.memory import Advice
from relguide.flying.plan_documents import FlownCard, FlownPoint, NotFlownCard
from relguide.flying.pursuit import begin_pursuit
from relguide.flying.scenarios import own_scenario
from relguide.flying.sky import Sky
from relguide.kernels.base.angles import wrap
from relguide.planning.acceptance import with_deadline
from relguide.planning.deadline import left_until
from relguide.planning.outcome import NoPlan, Plan, Planner
from relguide.planning.phrases import distance, duration
from relguide.planning.situation import Situation
from relguide.units import KT, Second

STEP: Second = 0.05
"""Of the flight, as `fly` has it [s]: none of it is flown but ahead."""
ALIKE: Second = 1.0
"""Times that differ by less need no reason [s]."""
WORTH_A_WORD: Second = 0.5
"""What takes less is not named as a reason [s]."""


def flown_card(plan: Plan, planner: Planner, *, until: float = inf) -> FlownCard | NotFlownCard:
    """The flight of a plan's situation: when it joins, how close it comes, where it goes.

    Args:
        plan: the ideal one, which it is compared with.
        planner: plans the flight, as it made the plan.
        until: when planning ends, of `end_of` [s].
    """

    def timed(situation: Situation) -> Plan | NoPlan:
        return with_deadline(planner, left_until(until))(situation)

    try:
        world = world_of(own_scenario(plan.situation))
    except ValueError as error:  # no level at which the aircraft can fly so
        return NotFlownCard(reason=str(error))
    fleet = Fleet(world, STEP)
    one = begin_pursuit(world, fleet, world.links[0])
    belief = Sky(world, fleet).seen_by(one, (one,), one.belief(fleet, 0.0))
    memory, advice = advise(one.memory, belief, one.assignment, planner if until == inf else timed)
    made = [event for event in advice.events if isinstance(event, NewPlan)]
    if not made or memory.mode in ("heading", "escape"):
        return NotFlownCard(reason=_refusal(advice))
    committed, shown = made[-1].committed, made[-1].shown
    ahead = committed.forecast
    if not ahead.joins:
        after = duration(ahead.until)
        return NotFlownCard(reason=f"Flown ahead for {after}, it does not join by {plan.word}.")
    rows = ahead.own[: int(ahead.join_time) + 1]
    least, at = ahead.least(0.0, within=ahead.join_time)
    return FlownCard(
        join=ahead.join_time,
        least=least,
        at=at,
        word=committed.plan.word,
        reason=_reason(plan, committed, ahead, one.assignment),
        segments=path_segments(shown.trajectory, wind=shown.situation.wind),
        points=tuple(
            FlownPoint(t=float(k), x=x, y=y, heading=wrap(heading), tas=tas)
            for k in rows_to_draw(rows)
            for x, y, heading, _, _, tas, _ in [rows[k].tolist()]
        ),
    )


def _refusal(advice: Advice) -> str:
    """Why guidance commits to nothing."""
    for event in advice.events:
        match event:
            case PlanMissing(answer=answer):
                return answer.message
            case UnableTo(message=message):
                return message
            case _:
                pass
    return "Guidance holds a heading."


def _reason(plan: Plan, committed: Committed, ahead: Forecast, assignment: Assignment) -> str:
    """Why it takes another time than the plan, in sentences; empty if it does not."""
    if abs(ahead.join_time - plan.time_to_converge) <= ALIKE:
        return ""
    by_path = committed.due - plan.time_to_converge
    by_speed = ahead.join_time - committed.due
    said: list[str] = []
    if abs(by_path) >= WORTH_A_WORD:
        how = [f"begins to turn {committed.begins:.0f} s later"]
        if committed.plan.word != plan.word:
            how.append(f"flies {committed.plan.word} in place of {plan.word}")
        if plan.certificate.least_separation < assignment.buffered_separation:
            how.append(f"keeps {distance(assignment.buffered_separation)}")
        said.append(f"It {_listed(how)}: {_more(by_path)}.")
    if abs(by_speed) >= WORTH_A_WORD:
        fast, slow = assignment.planned_tas / KT, ahead.own[int(ahead.join_time), 5] / KT
        does = "slows" if slow < fast else "speeds up"
        how_late = _more(by_speed)
        said.append(f"It {does} from {fast:.0f} to {slow:.0f} kt before it joins: {how_late}.")
    return " ".join(said)


def _listed(parts: list[str]) -> str:
    *first, last = parts
    return f"{', '.join(first)} and {last}" if first else last


def _more(time: Second) -> str:
    return f"{duration(abs(time))} {'more' if time > 0.0 else 'less'}"
