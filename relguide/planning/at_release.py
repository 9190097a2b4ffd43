"""first_at_release(situation): the path that arrives just as the slot opens, if one keeps d_min.

Where the leader's last turn is still to come and there is time to spare, a path of exactly that
length is the plan. So the paths that a straight makes long enough are tried before all others.
"""

import numpy as np

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.clearest_delay import clearest_delay
from relguide.kernels.separation.clearance import SLACK
from relguide.kernels.words.delay import DELAY_PIECES
from relguide.planning.candidate import Candidate, assemble
from relguide.planning.certificate import TOLERANCE
from relguide.planning.situation import Situation
from relguide.planning.slot import slot_frame
from relguide.planning.words import HORIZON
from relguide.units import Metre, Second


def first_at_release(
    situation: Situation, radius: Metre, leading: FloatArray
) -> tuple[Candidate, Second] | None:
    """The first of `candidates(situation).at_release` that keeps d_min, and when the slot opens.

    Args:
        situation: what is to be planned.
        radius: R, which callers have at hand [m].
        leading: the situation's `leader_path`.

    Returns:
        `None` where the slot is open from the start, where there is no path within the horizon, and
        where a straight alone does not delay one.
    """
    pursuer, leader = situation.pursuer, situation.leader
    if not leader.intent:
        return None
    frame = slot_frame(situation, leader.trajectory)
    opens = frame.t_release * radius / pursuer.tas
    if not 0.0 < opens <= HORIZON:
        return None
    chosen = np.empty((2, DELAY_PIECES))
    start = np.array((pursuer.x, pursuer.y, pursuer.heading, pursuer.tas))
    limit = situation.min_separation - SLACK * radius
    if not clearest_delay(
        frame.x, frame.y, frame.h, frame.alpha, frame.t_release, start, radius,
        leading, limit, TOLERANCE * radius, chosen,
    ):  # fmt: skip
        return None
    signs, amounts = chosen.tolist()
    return assemble(situation, frame, signs, amounts, ""), opens
