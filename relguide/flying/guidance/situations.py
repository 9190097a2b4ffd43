"""What plans are asked for: all that fly, and what the assignment asks."""

from relguide.flying.belief import Belief
from relguide.flying.guidance.amid import others_after
from relguide.flying.guidance.assignment import Assignment
from relguide.kernels.base.angles import wrap
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.situation import Situation
from relguide.units import Metre, Second


def situation_now(belief: Belief, assignment: Assignment) -> Situation:
    """The situation as it is, with V_P and the bank of the plans."""
    own = belief.own
    pursuer = Pursuer(
        x=own.x,
        y=own.y,
        heading=wrap(own.heading),
        tas=assignment.tas,
        max_bank=assignment.planned_bank,
    )
    leader = belief.leader_after(0.0)
    return situation_of(assignment, pursuer, leader, belief, assignment.min_separation)


def situation_of(
    assignment: Assignment,
    pursuer: Pursuer,
    leader: Leader,
    belief: Belief,
    min_separation: Metre,
    *,
    seconds: Second = 0.0,
    aside: Metre = 0.0,
) -> Situation:
    """Both aircraft with what the assignment asks, aimed at the place in the gate.

    Args:
        assignment: what was asked.
        pursuer: where the plan begins.
        leader: at the same time.
        belief: gives the others, and the wind.
        min_separation: to be kept from the leader [m].
        seconds: how long from now that is [s].
        aside: what is to be kept beside the minimum of each of the others [m].
    """
    return Situation(
        pursuer=pursuer,
        leader=leader,
        slot_distance=assignment.aim,
        min_separation=min_separation,
        wind=belief.wind,
        others=others_after(belief, pursuer, seconds, aside),
    )
