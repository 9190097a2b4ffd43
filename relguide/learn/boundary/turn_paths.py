"""solve_behind_turn(turns, …): a constrained path behind a leader who turns once.

    situation → templates held possible, solved next to guesses → the fastest that keeps d_min

Leaders who turn several times, or are as good as on their final leg, situations outside the box,
paths that the network does not know or is not sure of, and whatever is simple where the limit does
not bind, are the exact planner's: the answer is then `None`.
"""

from typing import NamedTuple

import numpy as np

from relguide.kernels.base.angles import mirror_heading
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.networks.template_scores import constrained_turn_pieces
from relguide.kernels.networks.turning_leader import NUMBERS
from relguide.learn.boundary.template_network import TemplateNetwork
from relguide.learn.boundary.turn_labels import TurnBox
from relguide.planning.candidate import Candidate, candidate_of, segments_of_pieces
from relguide.planning.situation import Situation
from relguide.planning.slot import SlotFrame, slot_frame
from relguide.planning.tables import leader_table
from relguide.planning.words import HORIZON
from relguide.units import Metre, Second


class Behind(NamedTuple):
    """A path behind a leader who turns, not certified yet."""

    candidate: Candidate
    lower_bound: Second
    """No path arrives sooner, with or without the limit [s]."""


def numbers_of(situation: Situation, frame: SlotFrame) -> tuple[FloatArray, bool] | None:
    """A situation as the network sees it.

    Args:
        situation: its leader has declared something.
        frame: its slot frame.

    Returns:
        its numbers, as in `kernels.networks.turning_leader`, and whether they are those of the
        mirror image; `None` unless the leader turns exactly once.
    """
    table = leader_table(situation, frame)
    turning = np.flatnonzero(table[:, 4])
    if len(turning) != 1:
        return None
    at = int(turning[0])
    final, (lead, ends), rate = table[-1], table[at : at + 2, 0], float(table[at, 4])
    side = 1.0 if rate > 0.0 else -1.0
    numbers = np.empty(NUMBERS)
    numbers[0], numbers[1] = frame.x, side * frame.y
    numbers[2] = frame.h if side > 0.0 else mirror_heading(frame.h)
    numbers[3], numbers[4] = frame.alpha, situation.min_separation / frame.radius
    numbers[5], numbers[6] = final[1] - frame.alpha * final[0], side * final[2]
    numbers[7], numbers[8], numbers[9] = lead, abs(rate) * (ends - lead), abs(rate)
    numbers[10] = frame.t_release - ends
    return numbers, side < 0.0


def solve_behind_turn(
    turns: TemplateNetwork[TurnBox], situation: Situation, radius: Metre
) -> Behind | None:
    """The fastest constrained path that the network leads to, and what bounds its time.

    Args:
        turns: the network.
        situation: its leader has declared something.
        radius: R [m].
    """
    frame = slot_frame(situation, situation.leader.trajectory)
    seen = numbers_of(situation, frame)
    if seen is None:
        return None
    numbers, mirrored = seen
    if not turns.box.holds(numbers):
        return None
    unit = radius / situation.pursuer.tas
    weights = tuple(turns.layers)
    decision = turns.least_share, turns.most, turns.doubt
    bound, pieces = constrained_turn_pieces(
        numbers, -1.0 if mirrored else 1.0, radius, HORIZON / unit, weights, decision
    )
    if pieces.shape[1] == 0:
        return None
    candidate = candidate_of(situation.pursuer, segments_of_pieces(radius, pieces))
    return Behind(candidate, bound * unit)
