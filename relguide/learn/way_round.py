"""way_round(ways, …): a way round the limit, of a kind that a network holds possible.

    situation → kinds held possible → solved next to their guesses → the fastest that keeps d_min

The network sees a leader who keeps straight, and a slot straight behind it. Whatever else is in the
way is a `None`, and the exact planner's: a leader who turns (met on its final leg as if it had been
on it all along, one answer in eleven was late, for a better way led through where that leader never
was), a cross wind, which puts the slot aside of the leader's heading, a situation outside the box,
and ways that the network does not know or is not sure of.
"""

from math import hypot

import numpy as np

from relguide.kernels.chain import WORD
from relguide.kernels.way_network import LEGS, choose_way
from relguide.learn.way_network import WayNetwork
from relguide.planning.detour import SAME, flown
from relguide.planning.situation import Situation
from relguide.planning.slot import SlotFrame
from relguide.planning.words import HORIZON, SIGN_ROWS, Candidate, assemble

_ASIDE = 1e-9  # the slot counts as straight behind the leader [R]: 10 µm for an airliner


def way_round(ways: WayNetwork, situation: Situation, frame: SlotFrame) -> Candidate | None:
    """The fastest way round the limit that the network leads to, not certified yet.

    Args:
        ways: the network.
        situation: what is to be planned.
        frame: its slot frame.
    """
    limit = situation.min_separation / frame.radius
    slot = slot_ahead(situation, frame)
    if slot is None or not ways.holds(frame.x, frame.y, frame.alpha, slot, limit):
        return None
    if hypot(frame.x - slot, frame.y) < limit:
        return None
    legs = np.zeros((LEGS, 6))
    _, _, time, count = choose_way(
        frame.x, frame.y, frame.h, slot, frame.alpha, limit,
        ways.layers, ways.least_share, ways.most, ways.doubt, legs,
    )  # fmt: skip
    scale = frame.radius / situation.pursuer.tas
    if count == 0 or time * scale > HORIZON:
        return None
    flight = legs[:count].tolist()
    if all(leg[0] == WORD for leg in flight):
        signs = [sign for leg in flight for sign in SIGN_ROWS[int(leg[2])]]
        amounts = [amount for leg in flight for amount in leg[3:]]
        return assemble(situation, frame, signs, amounts, "")
    leader = np.array([[0.0, slot, 0.0, 0.0, 0.0]])
    candidate = flown(situation, frame, leader, limit, legs[:count])
    # where a ride ends another word may have to lead on: then it is not what was looked for
    if candidate is None or candidate.time_to_converge > (time + SAME) * scale:
        return None
    return candidate


def slot_ahead(situation: Situation, frame: SlotFrame) -> float | None:
    """How far ahead of the slot a leader is [R]; `None` if he turns, or is aside of it too."""
    if situation.leader.intent:
        return None
    if situation.wind.east == situation.wind.north == 0.0:
        return situation.slot_distance / frame.radius
    along, aside = frame.to_slot(situation.leader.x, situation.leader.y)
    return along if abs(aside) <= _ASIDE else None
