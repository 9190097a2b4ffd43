"""constrained_path(candidates): the fastest path that touches d_min, or slides along it."""

from math import inf
from typing import NamedTuple

import numpy as np

from relguide.kernels.base.clock import now, time_is_up
from relguide.kernels.base.records import Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.any_path import any_path
from relguide.kernels.contact.chain import MAX_LEGS
from relguide.kernels.contact.constrained_search import (
    best_constrained_path,
    ease_to_start,
)
from relguide.kernels.contact.path_pieces import pieces_of
from relguide.kernels.contact.tangent import tangents
from relguide.planning.candidate import (
    SIGN_ROWS,
    Candidate,
    assemble,
    candidate_of,
    segments_of_pieces,
)
from relguide.planning.tables import scene_of
from relguide.planning.words import HORIZON, Candidates
from relguide.units import Second

BEARINGS = 60
"""How finely the disc is scanned round a leader that keeps straight: every 6°."""
TURNING_BEARINGS = 72
"""Round one that turns: every 5°, since contacts must fall into the time of one piece."""
HARDER = 5
"""So many times the bearings round a leader that keeps straight, where nothing is found at first:
one as fast as the pursuer is met in windows narrower than 6°."""

_LEFT_FOR_ANY = 0.25  # of the time to search, for `any_path` where nothing else was found


class FoundAround(NamedTuple):
    """What was found of paths that touch d_min."""

    path: Candidate | None
    """The fastest; `None` if none was found."""
    cut_short: bool
    """Whether the search ended before all was looked at, since its time was up."""


def constrained_path(found: Candidates, *, beat: Second, until: float = inf) -> FoundAround:
    """The fastest path through contacts with d = d_min, if it arrives before `beat` [s].

    Up to the first contact, between contacts and from the last one on, the path is an extremal
    without the limit, from the same complete enumeration of words, or it slides along d_min. The
    contacts' bearings are searched round the leader, for each piece of its intent and both sides.
    If there is none, and nothing to beat, any path that begins with a turn and a straight will do.

    Args:
        found: all candidates of the situation.
        beat: an arrival already known [s]; only earlier ones are looked for.
        until: when to end, by `clock.now` [s]: the best path found by then is given.
    """
    situation, frame = found.situation, found.frame
    if situation.min_separation <= 0.0:
        return FoundAround(None, cut_short=False)
    start = frame.pose
    scene = ease_to_start(start, scene_of(situation, frame))
    all_ways = scene._replace(until=until)
    if beat >= HORIZON and until < inf:
        # that there is a path at all matters more than its time
        until -= _LEFT_FOR_ANY * max(until - now(), 0.0)
    scene = scene._replace(until=until)
    around = _through_contacts(found, scene, beat)
    cut_short = bool(time_is_up(until))
    if beat < HORIZON or (around is not None and not cut_short):
        return FoundAround(around, cut_short)
    if around is not None:
        beat = around.time_to_converge
    longest, row = beat * situation.pursuer.tas / frame.radius, np.zeros(5)
    time, sign, turned, straight = any_path(start, all_ways, longest, row)
    if time < longest:
        signs = [sign, 0.0, *SIGN_ROWS[int(row[1])]]
        amounts = [turned, straight, *row[2:].tolist()]
        around = assemble(situation, frame, signs, amounts, "")
    return FoundAround(around, cut_short)


def _through_contacts(found: Candidates, scene: Scene, beat: Second) -> Candidate | None:
    """The fastest path through contacts that arrives before `beat` [s]."""
    situation, frame = found.situation, found.frame
    longest = beat / (frame.radius / situation.pursuer.tas)
    start, keeps_straight = frame.pose, len(scene.leader) == 1
    bearings = BEARINGS if keeps_straight else TURNING_BEARINGS
    legs, near = np.zeros((MAX_LEGS, 6)), tangents(start, scene)
    time, count = best_constrained_path(start, scene, bearings, near, longest, legs)
    if count == 0 and beat >= HORIZON and keeps_straight:
        bearings *= HARDER
        time, count = best_constrained_path(start, scene, bearings, near, longest, legs)
    return None if count == 0 else candidate_of_legs(found, scene, time, legs[:count])


def candidate_of_legs(
    found: Candidates, scene: Scene, time: float, legs: FloatArray
) -> Candidate | None:
    """A path through contacts as it is flown; `None` if that takes longer than it should.

    Args:
        found: all candidates of the situation.
        scene: of `tables.scene_of`, with the limit that the start keeps.
        time: when it arrives [R/V_P].
        legs: as in `chain.Chain`. shape (n, 6)
    """
    situation, frame = found.situation, found.frame
    pieces = pieces_of(frame.pose, scene, frame.radius, 1.0, time, legs)
    if pieces.shape[1] == 0:
        return None
    return candidate_of(situation.pursuer, segments_of_pieces(frame.radius, pieces))
