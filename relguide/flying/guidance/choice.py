"""The guidance of a name: relguide's, or a baseline."""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

from relguide.flying.belief import Belief
from relguide.flying.guidance.advise import advise
from relguide.flying.guidance.announcements import Event
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.baselines import fly_trail, navigate, pursue_slot
from relguide.flying.guidance.memory import Advice, Memory
from relguide.flying.guidance.reassign import reassign
from relguide.flying.guidances import Guidance
from relguide.planning.outcome import Planner

Advising = Callable[[Memory, Belief, Assignment], tuple[Memory, Advice]]
Reassigning = Callable[
    [Memory, Belief, Assignment, Assignment, str], tuple[Memory, list[Event]] | str
]


class Guide(NamedTuple):
    """A guidance."""

    advise: Advising
    """One act of it, once a second."""
    reassign: Reassigning
    """What becomes of its memory where the crew asks for something else; or why that cannot be."""


def guide_by(guidance: Guidance, planner: Planner) -> Guide:
    """The guidance of that name; only relguide's asks the planner."""
    baselines: dict[Guidance, Advising] = {
        "slot_pursuit": pursue_slot,
        "pronav": navigate,
        "trail": fly_trail,
    }
    if guidance in baselines:
        return Guide(baselines[guidance], _take_as_it_is)
    return Guide(partial(advise, planner=planner), partial(reassign, planner=planner))


def _take_as_it_is(
    memory: Memory, belief: Belief, was: Assignment, asked: Assignment, why: str
) -> tuple[Memory, list[Event]]:
    return memory, []
