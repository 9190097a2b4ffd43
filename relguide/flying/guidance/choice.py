"""The guidance of a name: relguide's, or a baseline."""

from collections.abc import Callable
from functools import partial

from relguide.flying.belief import Belief
from relguide.flying.guidance.advise import advise
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.baselines import fly_trail, navigate, pursue_slot
from relguide.flying.guidance.memory import Advice, Memory
from relguide.flying.guidances import Guidance
from relguide.planning.outcome import Planner

Guide = Callable[[Memory, Belief, Assignment], tuple[Memory, Advice]]
"""One act of guidance, once a second."""


def guide_by(guidance: Guidance, planner: Planner) -> Guide:
    """The guidance of that name; only relguide's asks the planner."""
    guides: dict[Guidance, Guide] = {
        "relguide": partial(advise, planner=planner),
        "slot_pursuit": pursue_slot,
        "pronav": navigate,
        "trail": fly_trail,
    }
    return guides[guidance]
