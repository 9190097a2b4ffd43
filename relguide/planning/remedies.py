"""remedies(situation, planner): with what changes there is a plan amid others, each one tried.

To ask again later, or to pass on the other side, is none of them: a path that first flies on, or
round the other side, is a path now, and was searched.
"""

from dataclasses import replace
from math import inf

from relguide.kernels.base.clock import time_is_up
from relguide.planning.limits import DISTANCE
from relguide.planning.phrases import distance
from relguide.planning.plan import Plan, Planner, Remedy
from relguide.planning.situation import Situation
from relguide.units import NM, Metre

SLOT_CHANGES: tuple[Metre, ...] = (1.0 * NM, -1.0 * NM, 2.0 * NM, -2.0 * NM, 4.0 * NM, 8.0 * NM)
"""Tried in turn, until one helps [m]."""


def remedies(situation: Situation, planner: Planner, *, until: float = inf) -> tuple[Remedy, ...]:
    """What would help where no path keeps clear of all.

    Args:
        situation: for which none was found.
        planner: asked each time.
        until: when to end, by `clock.now` [s].
    """
    for change in SLOT_CHANGES:
        slot_distance = situation.slot_distance + change
        if not situation.min_separation <= slot_distance <= DISTANCE.high:
            continue
        if time_is_up(until):
            break
        answer = planner(replace(situation, slot_distance=slot_distance))
        if isinstance(answer, Plan):
            return (
                Remedy(
                    kind="slot_distance",
                    value=slot_distance,
                    time_to_converge=answer.time_to_converge,
                    message=f"At {distance(slot_distance)} behind the leader there is a plan of "
                    f"{answer.time_to_converge:.0f} s.",
                ),
            )
    return ()
