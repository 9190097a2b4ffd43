"""solved(ways, …): a way round the limit, of a kind that a network holds possible.

    situation → kinds held possible → solved next to their guesses → the fastest that keeps d_min

The network sees a leader who keeps straight, and a slot straight behind it. Whatever else is in the
way is a `None`, and the exact planner's: a leader who turns (met on its final leg as if it had been
on it all along, one answer in eleven was late, for a better way led through where that leader never
was), a cross wind, which puts the slot aside of the leader's heading, a situation outside the box,
and ways that the network does not know or is not sure of.
"""

from math import hypot

import numpy as np

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.networks import network_view as kernel
from relguide.kernels.networks import template_scores as template_network
from relguide.kernels.networks.network_view import Where
from relguide.learn.boundary.template_network import TemplateNetwork
from relguide.planning.situation import Situation
from relguide.planning.words import HORIZON, Candidate, candidate_of, segments_flown
from relguide.units import Metre


def seen(situation: Situation, radius: Metre) -> tuple[bool, float, Where, FloatArray]:
    """A situation as networks see it, behind a leader that keeps straight.

    Args:
        situation: what is to be planned.
        radius: R, which callers have at hand [m].

    Returns:
        whether the limit binds, when nobody can be at the slot yet [R/V_P], where all are, and the
        fastest way without the limit: see `kernels.seen`.
    """
    pursuer, leader, wind = situation.pursuer, situation.leader, situation.wind
    free = np.empty(5)
    binds, soonest, where = kernel.seen(
        pursuer.x, pursuer.y, pursuer.heading, pursuer.tas, radius,
        leader.x, leader.y, leader.heading, leader.tas,
        situation.slot_distance, situation.min_separation, wind.east, wind.north, free,
    )  # fmt: skip
    return binds, soonest, where, free


def solved(
    ways: TemplateNetwork, situation: Situation, radius: Metre, where: Where, free: FloatArray
) -> Candidate | None:
    """The fastest way round the limit that the network leads to, not certified yet.

    Args:
        ways: the network.
        situation: in which the limit binds, and the leader keeps straight.
        radius: R [m].
        where: of `seen`.
        free: of `seen`.
    """
    x, y, _, slot, alpha, limit = where
    pursuer = situation.pursuer
    if not ways.holds(x, y, alpha, slot, limit) or hypot(x - slot, y) < limit:
        return None
    pieces = template_network.way_round(
        *where, free, radius, HORIZON * pursuer.tas / radius,
        tuple(ways.layers), ways.least_share, ways.most, ways.doubt,
    )  # fmt: skip
    if pieces.shape[1] == 0:
        return None
    return candidate_of(pursuer, segments_flown(radius, pieces))
