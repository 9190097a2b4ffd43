"""Situations by the column."""

from collections.abc import Sequence

import numpy as np

from relguide import Situation
from relguide.planning.batch import Situations


def columns_of(many: Sequence[Situation]) -> Situations:
    """All of them, without the intents of their leaders."""
    return Situations(
        pursuer_x=np.array([s.pursuer.x for s in many]),
        pursuer_y=[s.pursuer.y for s in many],
        pursuer_heading=[s.pursuer.heading for s in many],
        pursuer_tas=[s.pursuer.tas for s in many],
        max_bank=[s.pursuer.max_bank for s in many],
        leader_x=[s.leader.x for s in many],
        leader_y=[s.leader.y for s in many],
        leader_heading=np.array([s.leader.heading for s in many]),
        leader_tas=[s.leader.tas for s in many],
        slot_distance=[s.slot_distance for s in many],
        min_separation=[s.min_separation for s in many],
        wind_east=[s.wind.east for s in many],
        wind_north=[s.wind.north for s in many],
    )
