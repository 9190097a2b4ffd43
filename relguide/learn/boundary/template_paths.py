"""solve_constrained(templates, …): a constrained path that the template network leads to.

    situation → templates held possible, solved next to guesses → the fastest that keeps d_min

The network sees a leader who keeps straight, and a slot straight behind it. In every other case the
answer is `None`, and the exact planner's to find: a leader who turns (met on its final leg as if it
had been on it all along, one answer in eleven was late, for a better path led through where that
leader never was), a cross wind, which puts the slot aside of the leader's heading, a situation
outside the box, and paths that the network does not know or is not sure of.
"""

from math import hypot, inf

import numpy as np

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.networks import network_view
from relguide.kernels.networks.network_view import Where
from relguide.kernels.networks.template_scores import constrained_pieces
from relguide.kernels.words.branches import needs_mirror
from relguide.kernels.words.extremals import WORDS
from relguide.learn.boundary.template_network import TemplateNetwork
from relguide.planning.candidate import (
    SIGN_ROWS,
    Candidate,
    candidate_of,
    segments_of,
    segments_of_pieces,
)
from relguide.planning.situation import Situation
from relguide.planning.words import HORIZON
from relguide.units import Metre, Second

NO_PATH = np.full(5, inf)
"""The fastest path without the limit, until one is found."""


def view(situation: Situation, radius: Metre) -> tuple[bool, Where, FloatArray]:
    """A situation as networks see it, behind a leader that keeps straight.

    Args:
        situation: what is to be planned.
        radius: R, which callers have at hand [m].

    Returns:
        whether the limit binds, where all are, and the fastest path without the limit, at an
        infinite time if there is none or the slot lies aside: see `network_view.view`.
    """
    pursuer, leader, wind = situation.pursuer, situation.leader, situation.wind
    free = NO_PATH.copy()
    binds, where = network_view.view(
        pursuer.x, pursuer.y, pursuer.heading, pursuer.tas, radius,
        leader.x, leader.y, leader.heading, leader.tas,
        situation.slot_distance, situation.min_separation, wind.east, wind.north, free,
    )  # fmt: skip
    return binds, where, free


def free_path(
    situation: Situation, radius: Metre, where: Where, free: FloatArray
) -> tuple[Candidate, Second] | None:
    """The fastest path without the limit that `view` has found, and when it arrives [s].

    Arguments as `solve_constrained`; `None` if there is none within the horizon.
    """
    time, word, *amounts = free.tolist()
    seconds = time * radius / situation.pursuer.tas
    if seconds > HORIZON:
        return None
    # the words of three letters and their mirror images are neighbours
    number = int(word) ^ needs_mirror(where[1], where[2])
    segments = segments_of(radius, SIGN_ROWS[number], amounts)
    return candidate_of(situation.pursuer, segments, WORDS[number]), seconds


def solve_constrained(
    templates: TemplateNetwork, situation: Situation, radius: Metre, where: Where, free: FloatArray
) -> Candidate | None:
    """The fastest constrained path that the network leads to, not certified yet.

    Args:
        templates: the network.
        situation: in which the limit binds, and the leader keeps straight.
        radius: R [m].
        where: of `view`.
        free: of `view`.
    """
    x, y, _, slot, alpha, limit = where
    pursuer = situation.pursuer
    if not templates.holds(x, y, alpha, slot, limit) or hypot(x - slot, y) < limit:
        return None
    longest = HORIZON * pursuer.tas / radius
    weights = tuple(templates.layers)
    decision = templates.least_share, templates.most, templates.doubt
    pieces = constrained_pieces(where, free, radius, longest, weights, decision)
    if pieces.shape[1] == 0:
        return None
    return candidate_of(pursuer, segments_of_pieces(radius, pieces))
